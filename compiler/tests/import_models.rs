//! Tries the importers on well-known meshes, where a folder of them is at hand.

#![expect(clippy::print_stderr, reason = "says what is skipped, and what was found")]

use compiler::import::{Limits, MeshFile, load_gltf, load_image, load_obj, topology};
use lang::scene::{Axis, GltfChoice};
use std::path::PathBuf;

/// A file of the folder named by `RTC_TEST_MODELS`; `None`, with a message, when there is none.
fn model(name: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("RTC_TEST_MODELS").map(PathBuf::from);
    let path = folder.map(|folder| folder.join(name)).filter(|path| path.is_file());
    if path.is_none() {
        eprintln!("skipped: RTC_TEST_MODELS does not name a folder with {name}");
    }
    path
}

fn obj(name: &str) -> Option<MeshFile> {
    let path = model(name)?;
    Some(load_obj(&path, 1.0, Axis::PlusY, &Limits::default()).expect(name))
}

#[test]
fn bunny_has_its_triangles_and_is_open_at_the_base() {
    let Some(bunny) = obj("stanford-bunny.obj") else { return };
    let parts: Vec<_> = bunny.parts.iter().collect();
    let found = topology(&parts);
    eprintln!("{:?} {found:?}", bunny.report);
    assert_eq!(bunny.report.n_triangles, 69_451);
    assert_eq!(bunny.report.computed_normals, 69_451);
    assert!(found.boundary_edges > 0 && found.boundary_loops >= 1);
}

#[test]
fn spot_is_closed_and_has_uvs() {
    let Some(spot) = obj("spot.obj") else { return };
    let parts: Vec<_> = spot.parts.iter().collect();
    let found = topology(&parts);
    eprintln!("{:?} {found:?}", spot.report);
    assert_eq!(found.boundary_edges, 0);
    assert!(found.signed_volume > 0.0);
    assert!(spot.parts[0].corner_uvs(0).is_some());
}

#[test]
fn teapot_and_fandisk_load() {
    for name in ["teapot.obj", "fandisk.obj"] {
        let Some(mesh) = obj(name) else { return };
        let parts: Vec<_> = mesh.parts.iter().collect();
        eprintln!("{:?} {:?}", mesh.report, topology(&parts));
        assert!(mesh.report.n_triangles > 1000);
    }
}

#[test]
fn shader_ball_has_two_materials_and_images() {
    let Some(path) = model("usd-shaderball.glb") else { return };
    let ball = load_gltf(&path, &GltfChoice::default(), &Limits::default()).expect("shader ball");
    eprintln!("{:?} {:#?} {:?}", ball.report, ball.materials, ball.part_names());
    assert_eq!(ball.materials.len(), 2);
    assert!(ball.report.n_triangles > 60_000);
}

#[test]
fn garden_is_compressed_and_loads() {
    let Some(path) = model("japanese-bridge-garden.glb") else { return };
    let garden = load_gltf(&path, &GltfChoice::default(), &Limits::default()).expect("a garden");
    eprintln!("{:?} {:?}", garden.report, garden.part_names());
    assert_eq!(garden.report.n_triangles, 21_883);
}

#[test]
fn environment_image_loads() {
    let Some(path) = model("chinese_garden_1k.hdr") else { return };
    let image = load_image(&path, &Limits::default()).expect("hdr");
    assert_eq!((image.width, image.height), (1024, 512));
}
