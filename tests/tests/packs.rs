//! Packs: the same inputs give the same bytes, and what a scene does not need is not there.

use std::path::Path;

use pack::{Kind, Pack};
use tests::scene::{bytes, compile, compile_in, pack};

const VIEW: &str = "
camera eye: perspective { from = (0, 1, 6)m, to = (0, 1, 0)m, fov.vertical = 40deg }
film tiny { size = (16, 16)px }
render main: path { camera = eye, film = tiny, samples = 16, depth = 4, seed = 1 }
";

/// A closed mesh large enough to be cached: `n` x `n` quads of a wavy sheet, as OBJ.
fn wavy_obj(n: usize) -> String {
    use std::fmt::Write as _;
    let mut text = String::new();
    for i in 0..=n {
        for j in 0..=n {
            let (x, z) = (i as f32 / n as f32, j as f32 / n as f32);
            let y = 0.1 * ((i * 7 + j * 13) % 11) as f32 / 11.0;
            let _ = writeln!(text, "v {x} {y} {z}");
        }
    }
    for i in 0..n {
        for j in 0..n {
            let corner = |a: usize, b: usize| a * (n + 1) + b + 1;
            let [a, b] = [corner(i, j), corner(i, j + 1)];
            let [c, d] = [corner(i + 1, j + 1), corner(i + 1, j)];
            let _ = writeln!(text, "f {a} {b} {c} {d}");
        }
    }
    text
}

/// A kernel in lower case without its comments.
fn code(kernel: &str) -> String {
    let lines = kernel.lines().map(|line| line.split("//").next().unwrap_or_default());
    lines.collect::<Vec<_>>().join("\n").to_lowercase()
}

fn with_mesh(dir: &Path) -> String {
    std::fs::write(dir.join("sheet.obj"), wavy_obj(120))
        .expect("a temporary directory is writable");
    format!(
        "rts 1
asset sheet = obj(\"sheet.obj\", unit: m, up: +y)
material clay: diffuse {{ color = linear(0.5, 0.3, 0.2) }}
material lamp: emissive {{ color = linear(1), strength = 5 }}
instance floor {{ shape = sheet, material = clay }}
instance ball {{ shape = sphere(radius: 20cm), material = lamp, at = (0.5, 1, 0.5)m }}
{VIEW}"
    )
}

#[test]
fn the_same_scene_gives_the_same_bytes_in_any_directory_and_with_any_number_of_threads() {
    let (here, there) = (tempfile::tempdir().expect("dir"), tempfile::tempdir().expect("dir"));
    let text = with_mesh(here.path());
    let reference = bytes(&compile_in(here.path(), &text));
    assert_eq!(text, with_mesh(there.path()));
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let again = pool.install(|| bytes(&compile_in(there.path(), &text)));
        assert!(again == reference, "other bytes with {threads} threads");
    }
}

#[test]
fn a_cached_tree_gives_the_same_bytes_as_a_built_one() {
    let dir = tempfile::tempdir().expect("dir");
    let cache = compiler::cache::Cache::at(dir.path().join("cache"));
    let build = |cache: &compiler::cache::Cache| {
        bytes(&tests::scene::compile_with(dir.path(), &with_mesh(dir.path()), cache))
    };
    let cold = build(&cache);
    assert_eq!(cache.stats().expect("readable").entries, 1, "the sheet is large enough to keep");
    assert!(build(&cache) == cold, "from the cache");
    cache.clear().expect("writable");
    assert!(build(&cache) == cold, "after the cache was deleted");
    assert!(build(&compiler::cache::Cache::disabled()) == cold, "without a cache");
}

#[test]
fn moving_declarations_does_not_change_what_is_rendered() {
    let a = "material m: diffuse { color = linear(0.5) }\n";
    let b = "instance s { shape = sphere(radius: 1m), material = m }\n";
    let c = "instance t { shape = box(size: (1, 1, 1)m), material = m, at = (2, 0, 0)m }\n";
    let d = "sky day: constant { color = linear(1) }\n";
    let id = |parts: [&str; 4]| pack(&format!("rts 1\n{}{VIEW}", parts.concat())).render_id();
    assert_eq!(id([a, b, c, d]), id([d, c, b, a]));
    assert_eq!(id([a, b, c, d]), id([c, a, d, b]));
}

#[test]
fn a_scene_without_spheres_has_no_sphere_section_no_binding_and_no_code() {
    let with = "rts 1\nsky day: constant { color = linear(1) }\n\
        material m: diffuse { color = linear(0.5) }\n\
        instance s { shape = sphere(radius: 1m), material = m }\n";
    let without = "rts 1\nsky day: constant { color = linear(1) }\n\
        material m: diffuse { color = linear(0.5) }\n\
        instance s { shape = box(size: (1, 1, 1)m), material = m }\n";
    for (text, expected) in [(with, true), (without, false)] {
        let pack = pack(&format!("{text}{VIEW}"));
        assert_eq!(pack.section_bytes(Kind::SPHERE).is_some(), expected, "section");
        let code = code(pack.kernel());
        assert_eq!(code.contains("sphere_words"), expected, "binding");
        assert_eq!(code.contains("sphere"), expected, "code");
    }
}

#[test]
fn a_scene_without_instances_has_no_instance_section_and_no_code() {
    let dir = tempfile::tempdir().expect("dir");
    std::fs::write(dir.path().join("sheet.obj"), wavy_obj(30)).expect("writable");
    let text = |places: &str| {
        format!(
            "rts 1\nsky day: constant {{ color = linear(1) }}\nmaterial m: diffuse {{ color = linear(0.5) }}
asset sheet = obj(\"sheet.obj\", unit: m, up: +y)\n{places}{VIEW}"
        )
    };
    let [a, b] = ["a", "b"].map(|name| {
        format!("instance {name} {{ shape = sheet, material = m, at = (0, 1, 0)m }}\n")
    });
    for (places, expected) in [(a.clone(), false), (a + &b, true)] {
        let compiled = compile_in(dir.path(), &text(&places));
        let pack = Pack::from_bytes(bytes(&compiled)).expect("valid");
        assert_eq!(pack.section_bytes(Kind::INSTANCE).is_some(), expected, "section");
        let code = code(pack.kernel());
        for part in ["load_instance", "instance_ray", "instance_surface", "child_instance_index"] {
            assert_eq!(code.contains(part), expected, "{part}");
        }
        let manifest = pack.manifest().expect("readable");
        let count = |name: &str| {
            manifest.counters.iter().find(|(known, _)| known == name).map(|(_, count)| *count)
        };
        assert_eq!(count("triangles"), Some(1800));
        assert_eq!(count("triangles shown"), Some(if expected { 3600 } else { 1800 }));
        assert_eq!(count("instances of them"), Some(if expected { 2 } else { 0 }));
    }
}

#[test]
fn a_scene_of_nothing_but_sky_has_no_geometry_at_all() {
    let pack = pack(&format!("rts 1\nsky day: constant {{ color = linear(1) }}\n{VIEW}"));
    for kind in [Kind::NODE, Kind::TRIANGLE, Kind::TRISHADE, Kind::SPHERE, Kind::MATERIAL] {
        assert!(pack.section_bytes(kind).is_none(), "{kind}");
    }
    assert!(!code(pack.kernel()).contains("fn trace"));
}

#[test]
fn a_black_sky_and_unused_materials_leave_nothing_behind() {
    let text = "rts 1
sky night: constant { color = linear(0) }
material used: emissive { color = linear(1) }
material unused: metal { color = linear(0.9) }
instance s { shape = sphere(radius: 1m), material = used }";
    let pack = pack(&format!("{text}{VIEW}"));
    assert!(pack.sky().is_none());
    assert_eq!(pack.records::<pack::abi::Material>().len(), 1);
    assert!(!code(pack.kernel()).contains("metal_"));
    assert!(!code(pack.kernel()).contains("load_sky"));
}

#[test]
fn the_manifest_names_materials_with_their_lines_and_no_directory() {
    let dir = tempfile::tempdir().expect("dir");
    let compiled = compile_in(dir.path(), &with_mesh(dir.path()));
    let manifest = Pack::from_bytes(bytes(&compiled)).expect("valid").manifest().expect("readable");
    let names: Vec<_> = manifest.materials.iter().map(|m| (m.name.as_str(), m.line)).collect();
    assert_eq!(names, [("lamp", 4), ("clay", 3)]);
    assert_eq!(manifest.files, ["test.rts", "sheet.obj"]);
}

#[test]
fn every_compiled_kernel_validates_and_matches_the_records() {
    let text = format!(
        "rts 1\nsky day: gradient {{ }}\nmaterial g: dielectric {{ ior = 1.5 }}\n\
        instance s {{ shape = sphere(radius: 1m), material = g }}\n{VIEW}"
    );
    let compiled = compile(&text);
    let (module, _) = shaders::validate(&compiled.kernel).expect("valid");
    shaders::check_layouts(&module).expect("the same layout");
}
