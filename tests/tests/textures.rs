//! Texture expressions: what a material reads at a point is what the text says, computed here in double precision.

#[path = "textures/vertex_colors.rs"]
mod vertex_colors;

use glam::Vec2;
use pack::abi::NONE;
use runtime::kernel::f32::TexturePoint;
use std::f64::consts::TAU;
use tests::kernel::Bench;
use tests::scene;

/// Texels of the image that tests read, two by two: red, green, blue, alpha.
const TEXELS: [[u8; 4]; 4] =
    [[10, 200, 30, 255], [250, 20, 90, 128], [60, 70, 180, 0], [0, 255, 128, 64]];

/// Points of the texture plane, inside of the unit square and outside.
fn points() -> impl Iterator<Item = [f64; 2]> {
    // Steps without a common measure with the patterns, so that no point lies on an edge.
    (0..400)
        .map(f64::from)
        .map(|i| [(i * 0.017_31).fract() * 3.1 - 1.05, (i * 0.031_7).fract() * 2.3 - 0.65])
}

/// What `principled` with these fields reads at points: colour, and green of the texture of its roughness.
fn read(texture: &str, fields: &str) -> Vec<([f64; 2], [f64; 3], f64)> {
    let at = points().map(|[u, v]| [u, v, 0.0]);
    let read = read_at(texture, fields, at).into_iter();
    read.map(|([u, v, _], color, roughness)| ([u, v], color, roughness)).collect()
}

/// The same at points of three coordinates.
fn read_at(
    texture: &str,
    fields: &str,
    points: impl Iterator<Item = [f64; 3]>,
) -> Vec<([f64; 3], [f64; 3], f64)> {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let image = image::RgbaImage::from_fn(2, 2, |x, y| image::Rgba(TEXELS[(2 * y + x) as usize]));
    image.save(dir.path().join("a.png")).expect("an image can be written");
    let texel = |x: usize, y: usize| {
        let [r, g, b, a] = TEXELS[2 * y + x].map(|byte| f32::from(byte) / 255.0);
        (r, g, b, a)
    };
    exr::prelude::write_rgba_file(dir.path().join("a.exr"), 2, 2, texel)
        .expect("an image can be written");
    let text = format!(
        "rts 1
{texture}
material m: principled {{ {fields} }}
instance s {{ shape = sphere(radius: 1m), material = m }}
sky day: constant {{ color = linear(1) }}
camera eye: perspective {{ from = (0, 0, 5)m, to = (0, 0, 0)m }}
film f {{ size = (8, 8)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 2 }}
"
    );
    let compiled = scene::compile_in(dir.path(), &text);
    let lowered = &compiled.lowered;
    let material = lowered.materials[0];
    let bench = Bench::new().textures(lowered);
    let mut kernel = bench.single();
    points
        .map(|at| {
            #[expect(clippy::cast_possible_truncation, reason = "the kernel's precision")]
            let [u, v, w] = at.map(|x| x as f32);
            let at = TexturePoint { uv: Vec2::new(u, v), w, prim: NONE, b: Vec2::ZERO };
            let mut fetch = |id: u32| {
                if id == NONE {
                    [1.0; 4]
                } else {
                    // Cut-outs ask for alpha alone.
                    let [alpha, same] =
                        [kernel.texture_alpha(id, at), kernel.texture_fetch(id, at).w];
                    assert_eq!(alpha.to_bits(), same.to_bits(), "{alpha}, not {same}");
                    kernel.texture_fetch(id, at).to_array()
                }
            };
            let [r, g, b, _] = fetch(material.color_texture);
            let color = [r, g, b]
                .into_iter()
                .zip(material.color)
                .map(|(a, b)| f64::from(a * b))
                .collect::<Vec<_>>();
            let roughness = fetch(material.metallic_roughness_texture)[1] * material.roughness;
            ([u, v, w].map(f64::from), [color[0], color[1], color[2]], f64::from(roughness))
        })
        .collect()
}

/// Roughness at every point, against its formula.
fn check_number(texture: &str, roughness: &str, truth: impl Fn(f64, f64) -> f64) {
    for ([u, v], _, found) in read(texture, &format!("roughness = {roughness}")) {
        let truth = truth(u, v);
        assert!((found - truth).abs() < 2e-5, "{roughness} at ({u}, {v}): {found}, not {truth}");
    }
}

/// Colour at every point, against its formula.
fn check_color(texture: &str, color: &str, truth: impl Fn(f64, f64) -> [f64; 3]) {
    for ([u, v], found, _) in read(texture, &format!("color = {color}")) {
        let truth = truth(u, v);
        let off = (0..3).map(|k| (found[k] - truth[k]).abs()).fold(0.0, f64::max);
        assert!(off < 2e-5, "{color} at ({u}, {v}): {found:?}, not {truth:?}");
    }
}

const DATA: &str = "texture a = image(\"a.png\", space: data)";
const LINEAR: &str = "texture a = image(\"a.png\", space: linear)";

/// Channel `k` of the image at (u, v): bilinear, repeated.
fn image_at(k: usize, u: f64, v: f64) -> f64 {
    let (x, y) = (u * 2.0 - 0.5, (1.0 - v) * 2.0 - 0.5);
    let (i, j) = (x.floor(), y.floor());
    let texel = |i: f64, j: f64| {
        let at = 2.0 * j.rem_euclid(2.0) + i.rem_euclid(2.0);
        TEXELS
            .iter()
            .zip(0_u32..)
            .find(|(_, n)| (f64::from(*n) - at).abs() < 0.5)
            .map_or(0.0, |(t, _)| f64::from(t[k]) / 255.0)
    };
    let (s, t) = (x - i, y - j);
    (texel(i, j) * (1.0 - s) + texel(i + 1.0, j) * s) * (1.0 - t)
        + (texel(i, j + 1.0) * (1.0 - s) + texel(i + 1.0, j + 1.0) * s) * t
}

fn odd(n: f64) -> f64 {
    n.rem_euclid(2.0)
}

#[test]
fn patterns_are_what_they_are_called() {
    check_number("", "checker(5, 3)", |u, v| odd((5.0 * u).floor() + (3.0 * v).floor()));
    check_number("", "gradient(0deg)", |u, _| u.clamp(0.0, 1.0));
    check_number("", "gradient(90deg)", |_, v| v.clamp(0.0, 1.0));
    check_number("", "wave(3, 30deg)", |u, v| {
        let (sin, cos) = 30.0_f64.to_radians().sin_cos();
        0.5 - 0.5 * (TAU * 3.0 * (cos * u + sin * v)).cos()
    });
    check_number("", "bricks(4, 8, 0.2)", |u, v| {
        // Distances to the nearest joint, in units of texture coordinates: a joint is 0.2 / 8 wide.
        let row = (8.0 * v).floor();
        let x = 4.0 * u + 0.5 * odd(row);
        let (x, y) = (x - x.floor(), 8.0 * v - row);
        let (side, edge) = (x.min(1.0 - x) / 4.0, y.min(1.0 - y) / 8.0);
        if side < 0.1 / 8.0 || edge < 0.1 / 8.0 { 0.0 } else { 1.0 }
    });
}

#[test]
fn arithmetic_is_that_of_numbers() {
    check_number(DATA, "a.r * 0.5 + 0.25", |u, v| image_at(0, u, v) * 0.5 + 0.25);
    // A factor is in the record, whether or not another lane of the texture is computed.
    check_number(DATA, "0.75 * a.g", |u, v| 0.75 * image_at(1, u, v));
    check_number(DATA, "a.b / 4, metallic = noise(3)", |u, v| image_at(2, u, v) / 4.0);
    check_number(DATA, "0.5 * a.r, metallic = a.g * 0.25", |u, v| 0.5 * image_at(0, u, v));
    check_number(DATA, "1 - a.g", |u, v| 1.0 - image_at(1, u, v));
    check_number(DATA, "-a.g / 2 + 1", |u, v| 1.0 - image_at(1, u, v) / 2.0);
    check_number(DATA, "clamp((a.b - 0.3) * 4, 0, 1)", |u, v| {
        ((image_at(2, u, v) - 0.3) * 4.0).clamp(0.0, 1.0)
    });
    check_number(DATA, "mix(a.r, a.g * a.b, a.a)", |u, v| {
        let [r, g, b, t] = [0, 1, 2, 3].map(|k| image_at(k, u, v));
        r * (1.0 - t) + g * b * t
    });
    check_number(DATA, "mix(0.1, mix(0.2, mix(a.r, 0.9, a.g), a.b), a.a)", |u, v| {
        let [r, g, b, t] = [0, 1, 2, 3].map(|k| image_at(k, u, v));
        let inner = r * (1.0 - g) + 0.9 * g;
        0.1 * (1.0 - t) + (0.2 * (1.0 - b) + inner * b) * t
    });
}

/// It is looked up alone, too, which `read` compares.
#[test]
fn the_alpha_of_half_floats_is_what_was_stored() {
    let texture = "texture a = image(\"a.exr\", space: linear)";
    for ([u, v], _, found) in read(texture, "color = a.rgb, roughness = a.a") {
        let truth = image_at(3, u, v);
        // Eleven bits.
        assert!((found - truth).abs() < 3e-4, "({u}, {v}): {found}, not {truth}");
    }
}

#[test]
fn colours_are_multiplied_mixed_and_added() {
    let rgb = |u, v| [0, 1, 2].map(|k| image_at(k, u, v));
    check_color(LINEAR, "a.rgb * linear(0.8, 0.4, 0.2)", |u, v| {
        let [r, g, b] = rgb(u, v);
        [r * 0.8, g * 0.4, b * 0.2]
    });
    check_color(LINEAR, "0.5 * a.rgb + linear(0.1, 0.2, 0.3)", |u, v| {
        let [r, g, b] = rgb(u, v);
        [r * 0.5 + 0.1, g * 0.5 + 0.2, b * 0.5 + 0.3]
    });
    check_color(LINEAR, "mix(a.rgb, linear(0.9, 0, 0), checker(4))", |u, v| {
        let odd = odd((4.0 * u).floor() + (4.0 * v).floor());
        let [r, g, b] = rgb(u, v);
        [r + (0.9 - r) * odd, g * (1.0 - odd), b * (1.0 - odd)]
    });
}

/// Scaled, turned, moved, in this order.
#[test]
fn images_lie_where_they_are_placed() {
    let placed = "texture a = image(\"a.png\", space: data, scale: 2, scale_v: -0.5, rotate: 30deg, offset_u: 0.1, offset_v: -0.3)";
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let at = move |u: f64, v: f64| {
        let (u, v) = (2.0 * u, -0.5 * v);
        (cos * u - sin * v + 0.1, sin * u + cos * v - 0.3)
    };
    check_number(placed, "a.r", move |u, v| {
        let (u, v) = at(u, v);
        image_at(0, u, v)
    });
}

/// Smooth, between 0 and 1, about 1/2, and finer with more octaves.
#[test]
fn noise_varies_as_it_should() {
    let steps = |octaves: u32| {
        let all: Vec<f64> = read("", &format!("roughness = noise(40, {octaves})"))
            .iter()
            .map(|row| row.2)
            .collect();
        assert!(all.iter().all(|x| (0.0..=1.0).contains(x)));
        let n = f64::from(u32::try_from(all.len()).expect("few points"));
        let mean = all.iter().sum::<f64>() / n;
        let deviation = (all.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n).sqrt();
        (mean, deviation)
    };
    let ((mean, one), (same, four)) = (steps(1), steps(4));
    // 400 values, of which the cells make nearly all independent.
    assert!(
        (mean - 0.5).abs() < 4.0 * one / 20.0 && (same - 0.5).abs() < 4.0 * four / 20.0,
        "{mean} {same}"
    );
    assert!(one > 0.05 && one < 0.3 && four < one, "{one} {four}");
}

/// Checks fill space, with as many along w as along u.
#[test]
fn checks_are_cubes() {
    let points = points().zip(points().skip(7)).map(|([u, v], [w, _])| [u, v, w]);
    for ([u, v, w], _, found) in read_at("", "roughness = checker(4, 7)", points) {
        let truth = odd((4.0 * u).floor() + (7.0 * v).floor() + (4.0 * w).floor());
        assert!((found - truth).abs() < 1e-6, "{found} at ({u}, {v}, {w})");
    }
}

/// Noise changes as much along w as along u. (More along v, by a tenth: of the twelve slopes of Perlin 2002 four count
/// twice, and all of these have a part along v.)
#[test]
fn noise_is_as_fine_along_w_as_along_u() {
    let values = |step: [f64; 3]| -> Vec<f64> {
        let points = (0..20_000).map(f64::from).map(|i| {
            let at = [(i * 0.754_877).fract(), (i * 0.569_840).fract(), (i * 0.437_016).fract()];
            [0, 1, 2].map(|k| 9.0 * at[k] + step[k])
        });
        let read = read_at("", "roughness = noise(8, 1)", points);
        read.into_iter().map(|(.., found)| found).collect()
    };
    let here = values([0.0; 3]);
    let [along_u, along_w] = [[0.02, 0.0, 0.0], [0.0, 0.0, 0.02]].map(|step| {
        let squares = here.iter().zip(values(step)).map(|(a, b)| (a - b) * (a - b));
        squares.sum::<f64>() / 20_000.0
    });
    assert!((along_w / along_u - 1.0).abs() < 0.05, "along u {along_u:e}, along w {along_w:e}");
}

/// A product of an image and a colour, or of a channel and a number, is a factor of the record; it needs no expression.
#[test]
fn a_tinted_image_costs_nothing() {
    let compiled = |material: &str| {
        let dir = tempfile::tempdir().expect("a temporary directory can be made");
        image::RgbaImage::new(2, 2)
            .save(dir.path().join("a.png"))
            .expect("an image can be written");
        let text = format!(
            "rts 1
texture a = image(\"a.png\", space: srgb)
material m: {material}
instance s {{ shape = sphere(radius: 1m), material = m }}
sky day: constant {{ color = linear(1) }}
camera eye: perspective {{ from = (0, 0, 5)m, to = (0, 0, 0)m }}
film f {{ size = (8, 8)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 2 }}
"
        );
        scene::compile_in(dir.path(), &text)
    };
    let [plain, tinted, mixed] = ["a.rgb", "a.rgb * linear(0.5, 0.25, 1)", "a.rgb + linear(0)"]
        .map(|color| compiled(&format!("diffuse {{ color = {color} }}")));
    assert_eq!(plain.kernel, tinted.kernel);
    assert_eq!(
        tinted.lowered.materials[0].color.map(f32::to_bits),
        [0.5_f32, 0.25, 1.0].map(f32::to_bits)
    );
    assert!(mixed.kernel.text.len() > plain.kernel.text.len());
    let [plain, scaled] = ["", "0.25 * "].map(|factor| {
        let fields = format!("roughness = {factor}n.g, metallic = n.b, alpha = {factor}n.a");
        let material =
            format!("principled {{ {fields}, sheen.roughness = 0.5 * n.r, sheen = a.rgb }}");
        compiled(&format!("{material}\ntexture n = image(\"a.png\", space: data)"))
    });
    assert_eq!(plain.kernel, scaled.kernel);
    assert_eq!(plain.lowered.textures, scaled.lowered.textures);
    let record = scaled.lowered.materials[0];
    let found = [record.roughness, record.metallic, record.alpha, record.sheen_roughness];
    assert_eq!(found.map(f32::to_bits), [0.25_f32, 1.0, 0.25, 0.5].map(f32::to_bits));
}
