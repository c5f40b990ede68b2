//! Colours of vertices: on whatever a mesh is, wherever it stands, a surface has the colour of the place.

use std::path::Path;

use compiler::bvh::Layout;
use compiler::lower::Instancing;
use pack::abi::VertexColors;
use pack::{Checked, Pack};
use runtime::SampleRange;
use runtime::layers::{Layer, LayerNames, Wanted};
use tests::exr_file::File;
use tests::kernel::Bench;
use tests::picture::{self, Estimate};
use tests::scene;

const SIZE: usize = 48;

/// The colour of a vertex at a point of the unit ball: affine, so that triangles have it in between.
fn color_of([x, y, z]: [f64; 3]) -> [f64; 3] {
    [0.5 + 0.4 * x, 0.5 + 0.4 * y, 0.4 - 0.3 * z]
}

/// A ball of 2 x 20 x 11 triangles as a PLY file with colours, which are linear where they are floats.
fn ball() -> String {
    use std::fmt::Write as _;
    let (n, m) = (20_u32, 12_u32);
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         property float red\nproperty float green\nproperty float blue\nelement face {}\n\
         property list uchar uint vertex_indices\nend_header\n",
        n * (m + 1),
        2 * n * (m - 1)
    );
    for j in 0..=m {
        for i in 0..n {
            let (a, b) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(m));
            let (sin, cos) = (std::f64::consts::TAU * a).sin_cos();
            let radius = (std::f64::consts::PI * b).sin();
            let p = [radius * cos, -(std::f64::consts::PI * b).cos(), radius * sin];
            let ([x, y, z], [r, g, b]) = (p, color_of(p));
            writeln!(text, "{x} {y} {z} {r} {g} {b}").expect("strings take all");
        }
    }
    for j in 0..m {
        for i in 0..n {
            let at = |i: u32, j: u32| j * n + i % n;
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            if j > 0 {
                writeln!(text, "3 {a} {c} {d}").expect("strings take all");
            }
            if j + 1 < m {
                writeln!(text, "3 {a} {b} {c}").expect("strings take all");
            }
        }
    }
    text
}

/// Balls: the file's own material, one of the scene on a mirrored and on a turned one, a channel; and what has no
/// colours.
const THINGS: &str = "rts 1
asset ball = ply(\"ball.ply\", unit: m)
material tinted: principled { color = linear(0.8) * vertex_color.rgb }
material green: diffuse { color = linear(1, 0.5, 0.25) * vertex_color.g }
instance a { shape = ball, at = (-3, 1.1, 0)m }
instance b { shape = ball, material = tinted, scale = (-1, 1, 1), at = (0, 1.1, 0)m }
instance c { shape = ball, material = tinted, rotate = (0, 90, 0)deg, at = (3, 1.1, 0)m }
instance d { shape = ball, material = green, at = (-3, -1.1, 0)m }
instance e { shape = sphere(radius: 1m), material = tinted, at = (0, -1.1, 0)m }
instance f { shape = box(size: (1.4, 1.4, 1.4)m), material = tinted, at = (3, -1.1, 0)m }
sky day: constant { color = linear(1) }
camera eye: perspective { from = (0, 0.5, 12)m, to = (0, 0, 0)m, fov.vertical = 40deg }
film small { size = (48, 48)px }
render main: path { camera = eye, film = small, samples = 1, depth = 2, seed = 3 }
";

/// What each thing has at a point of the world.
fn truth(thing: usize, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let tinted = |p: [f64; 3]| color_of(p).map(|c| 0.8 * c);
    match thing {
        0 => color_of([x + 3.0, y - 1.1, z]),
        1 => tinted([-x, y - 1.1, z]),
        // A quarter turn about y took (x, y, z) to (z, y, -x).
        2 => tinted([-z, y - 1.1, x - 3.0]),
        3 => [1.0, 0.5, 0.25].map(|c| c * (0.5 + 0.4 * (y + 1.1))),
        _ => [0.8; 3],
    }
}

#[test]
fn surfaces_have_the_colour_of_the_place() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    std::fs::write(dir.path().join("ball.ply"), ball()).expect("a mesh can be written");
    let plain =
        THINGS.replace("vertex_color.rgb", "linear(0.5)").replace("vertex_color.g", "linear(0.5)");
    let plain =
        plain.replace("instance a { shape = ball", "instance a { shape = ball, material = tinted");
    assert!(scene::compile_in(dir.path(), &plain).lowered.vertex_colors.is_empty());
    for (instancing, n_meshes) in [(Instancing::Auto, 1), (Instancing::Never, 0)] {
        for layout in [Layout::Wide, Layout::Binary] {
            let compiled = scene::compile_shared(dir.path(), THINGS, (instancing, layout), |_| {});
            assert_eq!(compiled.lowered.counters.meshes, n_meshes);
            check(Pack::from_bytes(scene::bytes(&compiled)).expect("a good pack"));
        }
    }
}

/// Every pixel of a picture of [`THINGS`] against [`truth`].
fn check(pack: Pack<Checked>) {
    let layers = [Layer::Albedo, Layer::Position, Layer::Instance];
    let outcome = picture::cpu(pack, |job| {
        let names = LayerNames::Blender;
        job.wanted = Wanted { layers: layers.into(), transparent: false, names };
        job.samples = SampleRange::new(0, 1).expect("a range");
    });
    let file = File::written(&outcome.picture, false);
    let all = |name: &str| &file.channels[&format!("ViewLayer.{name}")];
    let things = all("Instance Index.X");
    let mut seen = [0; 6];
    for (pixel, thing) in things.iter().enumerate().filter(|(_, thing)| **thing > 0.0) {
        let is = |k: &u8| (f32::from(*k) + 1.0 - *thing).abs() < 0.5;
        let thing = usize::from((0..6).find(is).expect("one of the things"));
        seen[thing] += 1;
        let place = ["X", "Y", "Z"].map(|axis| all(&format!("Position.{axis}"))[pixel]);
        let truth = truth(thing, place.map(f64::from));
        for (channel, truth) in ["R", "G", "B"].into_iter().zip(truth) {
            let found = f64::from(all(&format!("Denoising Albedo.{channel}"))[pixel]);
            let off = (found - truth).abs();
            assert!(off < 1e-3, "thing {thing}, {place:?}: {channel} {found}, not {truth}");
        }
    }
    assert!(seen.iter().all(|n| *n > 30), "{seen:?}");
    assert_eq!(things.len(), SIZE * SIZE);
}

/// A step of those in which alpha is stored.
const ALPHA: f32 = 128.0 / 511.0;

/// A square of glTF whose image, one colour, is tinted by its vertices; `more`: what else its material says.
fn write_square(dir: &Path, more: &str) {
    let corners = [[-1.0_f32, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let mut bytes: Vec<u8> = Vec::new();
    let mut list = |values: &mut dyn Iterator<Item = f32>| {
        bytes.extend(values.flat_map(f32::to_le_bytes));
    };
    list(&mut corners.iter().flat_map(|[x, y]| [*x, *y, 0.0]));
    list(&mut corners.iter().flat_map(|[x, y]| [0.5 + 0.5 * x, 0.5 - 0.5 * y]));
    list(&mut corners.iter().flat_map(|[x, y]| [0.5 + 0.4 * x, 0.5 + 0.4 * y, 1.0, ALPHA]));
    bytes.extend([0_u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes));
    std::fs::write(dir.join("square.bin"), &bytes).expect("a file can be written");
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba([188, 255, 128, 255]));
    image.save(dir.join("paint.png")).expect("an image can be written");
    let text = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "COLOR_0": 2}, "indices": 3, "material": 0}]}],
"materials": [{MORE, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}}],
"textures": [{"source": 0}], "images": [{"uri": "paint.png"}],
"buffers": [{"uri": "square.bin", "byteLength": 156}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 32},
{"buffer": 0, "byteOffset": 80, "byteLength": 64}, {"buffer": 0, "byteOffset": 144, "byteLength": 12}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
{"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC4"},
{"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}]}"#;
    let text = text.replace("MORE", more);
    std::fs::write(dir.join("square.gltf"), text).expect("a file can be written");
}

/// The square's colour: that of its image times that of its vertices.
fn square_color(x: f64, y: f64) -> [f64; 3] {
    [0.5029 * (0.5 + 0.4 * x), 0.5 + 0.4 * y, 0.2159]
}

/// The square in front of a white sky.
const SQUARE: &str = "rts 1
asset square = gltf(\"square.gltf\")
instance s { shape = square }
sky day: constant { color = linear(1) }
camera eye: perspective { from = (0, 0, 3)m, to = (0, 0, 0)m, fov.vertical = 20deg }
film f { size = (48, 48)px }
render main: path { camera = eye, film = f, samples = 16, depth = 2, seed = 5 }
";

#[test]
fn unlit_surfaces_give_off_the_colours_of_their_vertices() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    write_square(dir.path(), r#""extensions": {"KHR_materials_unlit": {}}"#);
    let compiled = scene::compile_in(dir.path(), SQUARE);
    let pack = Pack::from_bytes(scene::bytes(&compiled)).expect("a good pack");
    let outcome = picture::cpu(pack, |job| {
        let (layers, names) = ([Layer::Position].into(), LayerNames::Blender);
        job.wanted = Wanted { layers, transparent: false, names };
    });
    let file = File::written(&outcome.picture, false);
    let all = |name: &str| &file.channels[&format!("ViewLayer.{name}")];
    for pixel in 0..SIZE * SIZE {
        let [x, y] = ["X", "Y"].map(|axis| f64::from(all(&format!("Position.{axis}"))[pixel]));
        for (channel, truth) in ["R", "G", "B"].into_iter().zip(square_color(x, y)) {
            let found = f64::from(all(&format!("Combined.{channel}"))[pixel]);
            // A pixel is 0.02 m wide, and its place that of one sample.
            assert!((found - truth).abs() < 0.012, "({x}, {y}) {channel}: {found}, not {truth}");
        }
    }
}

#[test]
fn vertices_tint_images_and_their_alpha_is_coverage() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    write_square(dir.path(), r#""alphaMode": "BLEND""#);
    let compiled = scene::compile_in(dir.path(), SQUARE);
    let pack = Pack::from_bytes(scene::bytes(&compiled)).expect("a good pack");
    let outcome = picture::cpu(pack, |job| {
        let layers = [Layer::Albedo, Layer::Position, Layer::Alpha].into();
        job.wanted = Wanted { layers, transparent: true, names: LayerNames::Blender };
    });
    let file = File::written(&outcome.picture, false);
    let all = |name: &str| &file.channels[&format!("ViewLayer.{name}")];
    let alpha: Vec<f64> = all("Combined.A").iter().map(|a| f64::from(*a)).collect();
    let share = Estimate::of(&alpha);
    assert!(share.z(f64::from(ALPHA)).abs() < 4.5, "{share:?}");
    // Seen through the holes there is nothing: what is left of the albedo is its share.
    let mut n_seen = 0;
    for (pixel, alpha) in alpha.iter().enumerate().filter(|(_, alpha)| **alpha > 0.2) {
        n_seen += 1;
        let [x, y] = ["X", "Y"].map(|axis| f64::from(all(&format!("Position.{axis}"))[pixel]));
        for (channel, truth) in ["R", "G", "B"].into_iter().zip(square_color(x, y)) {
            let found = f64::from(all(&format!("Denoising Albedo.{channel}"))[pixel]) / alpha;
            // A pixel is 0.02 m wide, and its place that of one sample.
            assert!((found - truth).abs() < 0.012, "({x}, {y}) {channel}: {found}, not {truth}");
        }
    }
    assert!(n_seen > 300, "{n_seen}");
}

/// A lamp that glows in the colours of its vertices, over a floor: found by chance, and sampled.
#[test]
fn lights_have_the_colours_of_their_vertices() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    std::fs::write(dir.path().join("ball.ply"), ball()).expect("a mesh can be written");
    let text = "rts 1
asset ball = ply(\"ball.ply\", unit: m)
material lamp: emissive { color = vertex_color.rgb, strength = 3 }
material floor: diffuse { color = linear(0.7) }
instance glow { shape = ball, material = lamp, at = (0.3, 1.5, 0)m }
instance ground { shape = rectangle(size: (6, 6)m), material = floor }
camera eye: perspective { from = (3, 0.6, 0)m, to = (2, 0, 0)m, fov.vertical = 30deg }
film f { size = (24, 24)px }
render main: path { camera = eye, film = f, samples = 64, depth = 2, seed = 1 }
";
    let compiled = scene::compile_in(dir.path(), text);
    let bytes = scene::bytes(&compiled);
    let found = |estimator: u32, first_seed: u32| {
        let picture = |seed: u32| {
            let pack = Pack::from_bytes(bytes.clone()).expect("a good pack");
            let outcome = picture::cpu(pack, |job| {
                (job.estimator, job.seed) = (estimator, first_seed + seed);
            });
            // Red grows along x, where the floor is seen; the lamp is not in the picture.
            Estimate::of(&picture::channel(outcome.film(), 0)).mean
        };
        Estimate::of(&(0..24).map(picture).collect::<Vec<f64>>())
    };
    let [light, bsdf] = [found(1, 1_000), found(2, 2_000)];
    let off = (light.mean - bsdf.mean) / light.error.hypot(bsdf.error);
    assert!(off.abs() < 4.5 && light.mean > 0.05, "{light:?} {bsdf:?}");
    assert!(light.error < 0.02 * light.mean && bsdf.error < 0.02 * bsdf.mean);
}

#[test]
fn colours_come_back_as_they_were_stored() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut read = |VertexColors { high, low }: VertexColors, corner: usize| {
        kernel.vertex_color_corner(high[corner], low >> (10 * corner)).to_array()
    };
    for step in 0..=200 {
        let x = step as f32 / 200.0;
        let [a, b, c] = [[x, 0.0, 1.0, 0.5], [1.0, x, 0.0, x], [0.5, 1.0, x, 0.0]];
        let stored = VertexColors::of([a, b, c]);
        for (corner, colors) in [a, b, c].into_iter().enumerate() {
            let found = read(stored, corner);
            for (channel, limit) in [5e-4, 5e-4, 5e-4, 1e-3].into_iter().enumerate() {
                let off = (found[channel] - colors[channel]).abs();
                assert!(off <= limit, "{corner} {channel}: {found:?}, not {colors:?}");
            }
        }
    }
    let white = [1.0_f32.to_bits(); 4];
    assert!((0..3).all(|corner| read(VertexColors::WHITE, corner).map(f32::to_bits) == white));
}
