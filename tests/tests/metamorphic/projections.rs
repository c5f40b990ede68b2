//! A texture that is projected on a thing lies where texture coordinates would put it, and goes with the thing.

use std::path::Path;

use compiler::pipeline::Compiled;
use tests::picture::Estimate;
use tests::scene;

use crate::compare::{Means, SIZE, assert_exact, assert_same_mean, film};

/// What is projected, and how its pictures are placed.
struct Material<'a> {
    placed: &'a str,
    projection: &'a str,
}

/// The texture coordinates of a rectangle of two by two metres, as metres around its middle.
const OWN: Material<'static> = Material { placed: "", projection: "uv" };

fn projected(projection: &str) -> Material<'_> {
    Material { placed: ", scale: 0.5, offset_u: 0.5, offset_v: 0.5", projection }
}

/// Two pictures that no symmetry maps to themselves.
fn write_images(folder: &Path) {
    let save = |name: &str, pixel: fn(u32, u32) -> [u32; 4]| {
        let texel = |x, y| image::Rgba(pixel(x, y).map(|c| u8::try_from(c).unwrap_or(u8::MAX)));
        image::RgbaImage::from_fn(8, 8, texel).save(folder.join(name)).expect("it can be written");
    };
    save("paint.png", |x, y| [x * 30, y * 30, (x ^ y) * 30, 255]);
    save("bumps.png", |x, y| [80 + x * 20, 230 - y * 27, 200 + (x ^ y) * 7, 255]);
}

/// A thing lit from everywhere and by a lamp, and seen from a place.
fn compiled(material: &Material<'_>, thing: &str, lamp: &str, eye: &str) -> Compiled {
    let [width, height] = SIZE;
    let Material { placed, projection } = material;
    let text = format!(
        "rts 1
texture paint = image(\"paint.png\", space: srgb{placed})
texture bumps = image(\"bumps.png\", space: data{placed})
material m: principled {{
  color = paint.rgb, roughness = 0.5, normal = bumps.rgb, projection = {projection}
}}
sky day: constant {{ color = linear(0.5) }}
light bulb: sphere {{ center = {lamp}m, radius = 40cm, strength = 8 }}
instance thing {{ {thing}, material = m }}
camera eye: perspective {{ {eye}, fov.vertical = 40deg }}
film f {{ size = ({width}, {height})px }}
render main: path {{ camera = eye, film = f, samples = 128, depth = 2, seed = 1 }}
"
    );
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    write_images(dir.path());
    scene::compile_in(dir.path(), &text)
}

const TILE: &str = "shape = rectangle(size: (2, 2)m)";
const ABOVE: &str = "from = (0.5, 2.6, 1.2)m, to = (0, 0, 0)m";

#[test]
fn what_is_projected_lies_where_coordinates_put_it() {
    let of = |material: &Material<'_>| compiled(material, TILE, "(1, 2, 0.5)", ABOVE);
    let along_y = of(&projected("y"));
    let means = Means::of(&of(&OWN), 100);
    assert_same_mean("along y", &Means::of(&along_y, 100), &means);
    // Of three planes that is the only one that a flat tile faces.
    assert_exact("box", &film(&along_y), &film(&of(&projected("box"))), 1.0);
    // What faces +z or -z is as the tile stood up, and not mirrored.
    let up = "shape = rectangle(size: (2, 2)m), rotate = (90, 0, 0)deg";
    let eye = |z: f64| format!("from = ({}, 1.2, {})m, to = (0, 0, 0)m", 0.5 * z, 2.6 * z);
    let own = Means::of(&compiled(&OWN, up, "(1, 0.5, 2)", &eye(1.0)), 500);
    for (name, z, faces) in
        [("box, +z", 1.0, "(0, 1, 2), (0, 2, 3)"), ("box, -z", -1.0, "(0, 2, 1), (0, 3, 2)")]
    {
        let points = "(-1, -1, 0)m, (1, -1, 0)m, (1, 1, 0)m, (-1, 1, 0)m";
        let wall = format!("shape = mesh(points: [{points}], faces: [{faces}])");
        let lamp = format!("({z}, 0.5, {})", 2.0 * z);
        let wall = compiled(&projected("box"), &wall, &lamp, &eye(z));
        assert_same_mean(name, &Means::of(&wall, 500), &own);
    }
}

/// A thing that is moved, turned and enlarged, and seen from as far round, is the same; textures keep their size.
#[test]
fn what_is_projected_goes_with_its_thing() {
    let thing = |place: &str| format!("shape = sphere(radius: 1m){place}");
    let still = "from = (2, 2, 3)m, to = (0, 0, 0)m";
    let still = compiled(&projected("box"), &thing(""), "(3, 2, 1)", still);
    let still = Means::of(&still, 11_000);
    // A quarter turn about y: (x, y, z) goes to (z, y, -x).
    let turned = ", rotate = (0, 90, 0)deg, at = (5, 1, -2)m";
    let eye = "from = (8, 3, -4)m, to = (5, 1, -2)m";
    let turned = compiled(&projected("box"), &thing(turned), "(6, 3, -5)", eye);
    assert_same_mean("turned", &Means::of(&turned, 17_000), &still);
    let small = compiled(
        &projected("box"),
        "shape = sphere(radius: 25cm), scale = 4",
        "(3, 2, 1)",
        "from = (2, 2, 3)m, to = (0, 0, 0)m",
    );
    assert_same_mean("enlarged", &Means::of(&small, 19_000), &still);
}

/// What a thing and a mix of two materials on it are carved from goes with them, too.
#[test]
fn what_is_carved_goes_with_its_thing() {
    let compiled = |thing: &str, eye: &str| {
        let [width, height] = SIZE;
        let text = format!(
            "rts 1
material veined: diffuse {{ color = mix(linear(0.1), linear(0.9), noise(3)), projection = solid }}
material grey: diffuse {{ color = linear(0.4) }}
material m: mix {{ a = veined, b = grey, amount = checker(2), projection = solid }}
sky day: constant {{ color = linear(1) }}
instance thing {{ {thing}, material = m }}
camera eye: perspective {{ {eye}, fov.vertical = 40deg }}
film f {{ size = ({width}, {height})px }}
render main: path {{ camera = eye, film = f, samples = 128, depth = 2, seed = 1 }}
"
        );
        scene::compile(&text)
    };
    let ball = "shape = sphere(radius: 1m)";
    let still = Means::of(&compiled(ball, "from = (2, 2, 3)m, to = (0, 0, 0)m"), 23_000);
    // A quarter turn about y: (x, y, z) goes to (z, y, -x).
    let turned = format!("{ball}, rotate = (0, 90, 0)deg, at = (5, 1, -2)m");
    let turned = compiled(&turned, "from = (8, 3, -4)m, to = (5, 1, -2)m");
    assert_same_mean("turned", &Means::of(&turned, 29_000), &still);
    let small = "shape = sphere(radius: 25cm), scale = 4";
    let small = compiled(small, "from = (2, 2, 3)m, to = (0, 0, 0)m");
    assert_same_mean("enlarged", &Means::of(&small, 31_000), &still);
    // Another part of the block.
    let other = compiled(ball, "from = (2, 2, -3)m, to = (0, 0, 0)m");
    assert!(Means::of(&other, 37_000).distance(&still) > 20.0);
}

/// Where a surface faces two axes alike it is half of each plane's texture.
#[test]
fn planes_blend_where_they_meet() {
    let text = |projection: &str| {
        format!(
            "rts 1
material m: diffuse {{ color = linear(0.8) * checker(1), projection = {projection} }}
sky day: constant {{ color = linear(1) }}
instance slope {{
  shape = mesh(points: [(0, 2, 0)m, (0, 2, -1)m, (1, 1, -1)m, (1, 1, 0)m], faces: [(0, 3, 2), (0, 2, 1)])
  material = m
}}
camera eye: orthographic {{ from = (2, 3, -0.5)m, to = (0.5, 1.5, -0.5)m, height = 0.5m }}
film f {{ size = (16, 16)px }}
render main: path {{ camera = eye, film = f, samples = 256, depth = 2 }}
"
        )
    };
    // On the planes across x and z a square of the board, which is a metre wide, is 1, and on that across y it is 0; so
    // is the cube that the surface cuts.
    let cases = [("x", 0.8), ("y", 0.0), ("z", 0.8), ("box", 0.4), ("solid", 0.0)];
    for (projection, expected) in cases {
        let compiled = scene::compile(&text(projection));
        let found: Vec<f64> = film(&compiled).means().iter().map(|rgb| rgb[1]).collect();
        let Estimate { mean, error } = Estimate::of(&found);
        assert!((mean - expected).abs() <= 4.5 * error + 1e-6, "{projection}: {mean} +- {error}");
    }
}
