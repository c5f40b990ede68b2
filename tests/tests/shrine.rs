//! The shrine, generated with less in it: it compiles without a warning and has what it promises.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

use compiler::pipeline::Compiled;
use pack::abi::MaterialKind;
use tests::scene;

fn shrine(defines: &[(&str, &str)]) -> Compiled {
    scene::example(scenes::catalog::find("shrine").expect("it is an example"), defines)
}

/// As the scene says.
static IN_BLOOM: LazyLock<Compiled> = LazyLock::new(|| shrine(&[]));
/// Without blossom, and for the full picture.
static BARE: LazyLock<Compiled> = LazyLock::new(|| shrine(&[("petals", "0"), ("final", "true")]));

#[test]
fn the_shrine_has_13_kinds_of_material_and_53_image_files() {
    let kinds: BTreeSet<u32> = IN_BLOOM.lowered.materials.iter().map(|m| m.kind).collect();
    assert_eq!(kinds.len(), 13, "{kinds:?}");
    let images = IN_BLOOM
        .files
        .iter()
        .filter(|file| Path::new(&file.name).extension().is_some_and(|e| e == "png"))
        .count();
    assert_eq!(images, 53);
    assert_eq!(IN_BLOOM.lowered.spheres.len(), 4);
}

#[test]
fn its_wood_grows_along_all_three_axes() {
    let materials = &IN_BLOOM.lowered.materials;
    let wood = materials.iter().filter(|m| m.kind == MaterialKind::Wood as u32);
    // Sixths: 1 is y, 3 is x, 5 is z.
    let grain =
        |fuzz: f32| [1, 3, 5].into_iter().find(|k| (fuzz * 6.0 - f32::from(*k)).abs() < 0.01);
    let grains: BTreeSet<Option<u8>> = wood.map(|m| grain(m.fuzz)).collect();
    assert_eq!(grains, BTreeSet::from([Some(1), Some(3), Some(5)]));
}

#[test]
fn without_petals_there_are_fewer_triangles() {
    // Of the scene: how often leaves refer to them is the builder's affair.
    let triangles = [&BARE, &IN_BLOOM].map(|shrine| shrine.lowered.counters.triangles);
    assert!(triangles[0] + 500 < triangles[1], "{triangles:?}");
}

#[test]
fn the_final_picture_is_as_large_and_deep_as_that_of_the_source() {
    let render = &BARE.lowered.render;
    assert_eq!(render.image_size, [7680, 4320]);
    assert_eq!([render.samples, render.max_depth], [256, 50]);
}
