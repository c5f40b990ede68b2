//! Faults of files: every page of `rtc explain` whose example needs files fails with its code, and
//! the program ends with one clear line and the right exit code, never a panic.

use std::path::Path;

use compiler::cache::Cache;
use compiler::import::Limits;
use compiler::lower::Trees;
use compiler::pipeline::{self, Options};
use lang::diagnostic::{self, Diagnostic};
use lang::source::{LoadError, Loader, SourceSet};

/// What the examples read.
const FILES: &[(&str, &str)] = &[
    ("good.obj", "g rock\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    (
        "glass.obj",
        "mtllib glass.mtl\nusemtl glass\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 4 3\nf 1 2 4\nf 2 3 4\n",
    ),
    ("glass.mtl", "newmtl glass\nillum 7\nNi 1.5\n"),
    ("not_a_mesh.obj", "v 0 0\nf 1 2 3\n"),
    ("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"),
    ("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
    ("inside_out.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n"),
    ("empty.obj", "# nothing\n"),
    ("not_an_image.png", "this is text\n"),
    ("accessor.gltf", ACCESSOR),
    (
        "extension.gltf",
        r#"{"asset":{"version":"2.0"},"extensionsRequired":["KHR_meshopt_compression"],"extensionsUsed":["KHR_meshopt_compression"]}"#,
    ),
    ("huge.hdr", HUGE),
    ("tiny.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\nabcd"),
];

/// Ten positions in a buffer of twelve bytes.
const ACCESSOR: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":10,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}],
"bufferViews":[{"buffer":0,"byteLength":12}],
"buffers":[{"byteLength":12,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]}"#;

/// A header that claims ten thousand million pixels.
const HUGE: &str = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n";

const TAIL: &str = "sky tail_sky: constant { }
material tail_material: diffuse { color = linear(0.5) }
instance tail { shape = sphere(radius: 1m), material = tail_material }
camera tail_camera: perspective { from = (0, 1, 5)m, to = (0, 1, 0)m }
render tail_render: path { camera = tail_camera, sky = tail_sky }
";

struct NoImports;

impl Loader for NoImports {
    fn load(&mut self, _: &str, _: &str) -> Result<(String, String), LoadError> {
        Err(LoadError::NotFound)
    }
}

fn findings(dir: &Path, text: &str) -> (SourceSet, Vec<Diagnostic>) {
    let name = dir.join("scene.rts").display().to_string();
    let analysis = lang::analyze(&name, text, &mut NoImports, &lang::Options::default());
    let mut diagnostics = analysis.diagnostics;
    if let Some(scene) = &analysis.scene {
        let cache = Cache::disabled();
        let limits = Limits::default();
        let trees = Trees::usual(&cache);
        let options = Options { root: dir, trees, limits, defines: &[] };
        // Only what was found counts here; that nothing was written follows from it.
        let _ = pipeline::compile(scene, &analysis.sources, &options, &mut diagnostics);
    }
    (analysis.sources, diagnostics)
}

fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    for (name, content) in FILES {
        std::fs::write(dir.path().join(name), content).expect("writable");
    }
    dir
}

#[test]
fn every_page_about_files_has_an_example_that_fails_as_it_says() {
    let dir = folder();
    let mut n_pages = 0;
    for code in lang::codes() {
        let page = lang::explain(code).expect("codes() lists pages");
        // A scene of its own, or the beginning of one.
        let blocks = [("```rts compiled\n", "", ""), ("```rts files\n", "rts 1\n", TAIL)];
        let block = blocks.iter().find_map(|(fence, head, tail)| {
            let (example, _) = page.split_once(fence)?.1.split_once("```")?;
            Some(format!("{head}{example}{tail}"))
        });
        let Some(text) = block else { continue };
        n_pages += 1;
        let (sources, found) = findings(dir.path(), &text);
        // A page about a warning is about what does not stop the compiler.
        let counts = |d: &&Diagnostic| d.is_error() || code.starts_with('W');
        let codes: Vec<&str> = found.iter().filter(counts).map(|d| d.code.0).collect();
        let shown: Vec<String> = found.iter().map(|d| diagnostic::short(&sources, d)).collect();
        // `shape = rock` without a material is fine for meshes and E0207 for spheres.
        let codes: Vec<&str> = codes.into_iter().filter(|c| *c != "E0207").collect();
        assert_eq!(codes, [code], "{shown:#?}");
    }
    assert!(n_pages >= 10, "{n_pages} pages");
}

#[test]
fn odd_images_of_a_sky_are_warned_about_and_bad_ones_refused() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let save = |name: &str, size: [usize; 2], value: f32| {
        exr::prelude::write_rgb_file(dir.path().join(name), size[0], size[1], |_, _| {
            (value, value, value)
        })
        .expect("writable");
    };
    save("good.exr", [8, 4], 1.0);
    save("square.exr", [4, 4], 1.0);
    save("negative.exr", [8, 4], -1.0);
    image::RgbaImage::new(8, 4).save(dir.path().join("picture.png")).expect("writable");
    for (file, expected) in [
        ("good.exr", &[] as &[&str]),
        ("square.exr", &["W0528"]),
        ("picture.png", &["W0529"]),
        ("negative.exr", &["E0602"]),
        ("absent.hdr", &["E0514"]),
    ] {
        let tail = TAIL.replace("constant { }", &format!("image {{ file = \"{file}\" }}"));
        let (sources, found) = findings(dir.path(), &format!("rts 1\n{tail}"));
        let codes: Vec<&str> = found.iter().map(|d| d.code.0).collect();
        let shown: Vec<String> = found.iter().map(|d| diagnostic::short(&sources, d)).collect();
        // A black picture gives no light, which is said, too.
        let codes: Vec<&str> = codes.into_iter().filter(|c| *c != "E0710").collect();
        assert_eq!(codes, expected, "{file}: {shown:#?}");
    }
}

#[test]
fn the_programs_end_with_the_exit_codes_that_they_document() {
    let dir = folder();
    let path = |name: &str| dir.path().join(name).display().to_string();
    let write = |name: &str, text: &str| std::fs::write(path(name), text).expect("writable");
    write("good.rts", &format!("rts 1\n{TAIL}"));
    write("bad.rts", &format!("rts 1\nmaterial m: difuse {{ }}\n{TAIL}"));
    let rtc = |arguments: &[&str]| {
        compiler::cli::run(std::iter::once("rtc").chain(arguments.iter().copied()))
    };
    assert_eq!(rtc(&[&path("good.rts"), "-o", &path("good.pack"), "--no-cache"]), 0);
    assert_eq!(rtc(&["inspect", &path("good.pack"), "--verify"]), 0);
    let built_with = |option: &str, name: &str| {
        rtc(&[&path("good.rts"), "-o", &path("other.pack"), "--no-cache", option, name])
    };
    for name in ["fast", "default", "extreme", "object-median", "spatial-median"] {
        assert_eq!(built_with("--bvh", name), 0, "{name}");
    }
    for name in ["wide", "binary"] {
        assert_eq!(built_with("--nodes", name), 0, "{name}");
        assert_eq!(rtc(&["inspect", &path("other.pack"), "--verify"]), 0);
    }
    for (option, name) in [("--bvh", "sbvh"), ("--bvh", "Fast"), ("--bvh", ""), ("--nodes", "bvh8")]
    {
        assert_eq!(built_with(option, name), 2, "{option} {name}");
    }
    assert_eq!(rtc(&["check", &path("good.rts")]), 0);
    assert_eq!(rtc(&["fmt", "--check", &path("bad.rts")]), 1, "not tidy");
    assert_eq!(rtc(&["show", "--resolved", &path("good.rts")]), 0);
    assert_eq!(rtc(&["explain", "E0301"]), 0);
    for format in ["human", "short", "json"] {
        assert_eq!(rtc(&["check", &path("bad.rts"), "--error-format", format]), 1);
    }
    assert_eq!(rtc(&["--no-such-flag"]), 2);
    assert_eq!(rtc(&["explain", "E9999"]), 2);
    assert_eq!(rtc(&[&path("absent.rts"), "-o", &path("x.pack")]), 3);
    assert_eq!(rtc(&[&path("good.rts"), "-o", &path("no/such/dir/x.pack")]), 3);
    assert_eq!(rtc(&["inspect", &path("good.obj")]), 3);
    assert!(!Path::new(&path("x.pack")).exists(), "a failed run leaves no pack");
}
