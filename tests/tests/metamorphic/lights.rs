//! Light adds up: lights that are off or hidden add nothing, one lamp is its two halves, and a picture by two
//! groups of lights is the sum of the pictures by each.
//!
//! Two lights of half the radiance in one place are not one light: the surface of a lamp is opaque, so a ray
//! sees one of them only. What is meant by that holds as the sum of two groups, since light times a half is
//! the picture times a half (`emission.rs`).

use compiler::pipeline::Compiled;
use lang::material::Brightness;
use lang::scene::{MaterialModel, Scene};
use tests::scene::{compile, compile_changed};

use crate::compare::{Means, SIZE, assert_exact, assert_same_mean, film};

/// A ball and a rough floor in thin smoke, with `more` things and lights.
fn text(more: &str) -> String {
    let [width, height] = SIZE;
    format!(
        "rts 1
medium haze: homogeneous {{ sigma_a = 0.01/m, sigma_s = 0.04/m, g = 0.4, sky_distance = 5m }}
material clay: diffuse {{ color = linear(0.7, 0.5, 0.3) }}
material paint: principled {{ color = linear(0.2, 0.4, 0.7), roughness = 0.5 }}
material lamp: emissive {{ color = linear(1, 0.9, 0.8), strength = 3, sides = front }}
material pearl: emissive {{ color = linear(0.5, 0.8, 1), strength = 2 }}
instance floor {{ shape = rectangle(size: (8, 8)m), material = paint }}
instance ball {{ shape = sphere(radius: 80cm), material = clay, at = (-0.8, 0.8, 0)m }}
{more}
camera eye: perspective {{ from = (0, 1.8, 5)m, to = (0, 1.1, 0)m, fov.vertical = 42deg }}
film f {{ size = ({width}, {height})px }}
render main: path {{ camera = eye, film = f, atmosphere = haze, samples = 128, depth = 6, seed = 1 }}
"
    )
}

const SKY: &str = "sky day: gradient {
  sun.direction = (0.3, 0.5, 0.4)
  disc.color = linear(4)
  disc.power = 40
}\n";
const PANEL: &str = "instance panel { shape = rectangle(size: (2, 1)m), material = lamp, rotate = (180, 0, 0)deg, at = (0, 3, 0)m }\n";
const HALVES: &str = "instance panel[i in 0..2] { shape = rectangle(size: (1, 1)m), material = lamp, rotate = (180, 0, 0)deg, at = (i - 0.5, 3, 0)m }\n";
const GLOBE: &str =
    "instance globe { shape = sphere(radius: 40cm), material = pearl, at = (1.2, 0.5, 0.4)m }\n";
const BULB: &str = "light bulb: sphere { center = (-1.5, 2.6, 1)m, radius = 40cm, color = linear(1, 0.6, 0.3), strength = 4 }\n";

/// A quad is the rectangle with its corners, to the last bit, also as a light.
#[test]
fn a_quad_is_the_rectangle_with_its_corners() {
    let panel = |shape: &str, at: &str| {
        let own = format!("instance panel {{ shape = {shape}, material = lamp{at} }}\n");
        compile(&self::text(&[SKY, GLOBE, &own].concat()))
    };
    let rectangle = panel("rectangle(size: (2, 1)m)", ", at = (0, 3, 0)m");
    let quad = panel("quad(a: (-1, 3, 0.5)m, b: (1, 3, 0.5)m, c: (1, 3, -0.5)m)", "");
    assert_eq!(quad.lowered.lights.len(), 3, "panel, globe and sky");
    assert_exact("a quad", &film(&rectangle), &film(&quad), 1.0);
    // The other way round it faces down.
    let down = panel("quad(a: (1, 3, -0.5)m, b: (1, 3, 0.5)m, c: (-1, 3, 0.5)m)", "");
    assert_ne!(film(&down).means(), film(&quad).means());
}

/// A light that is a thing is the instance with its material, to the last bit, whatever its shape.
#[test]
fn a_mesh_light_is_the_instance_that_glows() {
    let place = "rotate = (180, 0, 20)deg, at = (0, 3, 0)m, scale = 1.5";
    for shape in ["rectangle(size: (2, 1)m)", "box(size: (1, 0.2, 0.1)m)", "post"] {
        let post = "material bar: emissive { color = linear(1, 0.5, 0.25), strength = 3, sides = front }\nobject post { shape = sphere(radius: 20cm), material = clay }\n";
        let glowing = |own: &str| compile(&self::text(&[SKY, GLOBE, post, own].concat()));
        let thing = format!("instance panel {{ shape = {shape}, material = bar, {place} }}\n");
        let light = format!(
            "light panel: mesh {{ shape = {shape}, {place}, color = linear(1, 0.5, 0.25), strength = 3, sides = front }}\n"
        );
        assert_exact(shape, &film(&glowing(&thing)), &film(&glowing(&light)), 1.0);
    }
}

/// A mesh of the text is the box with its corners, to the last bit, and mirrored, too.
#[test]
fn a_mesh_of_the_text_is_the_box_with_its_corners() {
    let block = |shape: &str, scale: &str| {
        let at = "at = (0.7, 0.5, 0.9)m, rotate = (0, 30, 0)deg";
        let own = format!("instance block {{ shape = {shape}, material = clay, {at}{scale} }}\n");
        compile(&self::text(&[SKY, PANEL, &own].concat()))
    };
    let mesh = "mesh(
  points: [
    (0.25, -0.5, -0.125)m, (0.25, 0.5, -0.125)m, (0.25, 0.5, 0.125)m, (0.25, -0.5, 0.125)m,
    (-0.25, -0.5, -0.125)m, (-0.25, 0.5, -0.125)m, (-0.25, 0.5, 0.125)m, (-0.25, -0.5, 0.125)m,
  ],
  faces: [
    (0, 1, 2, 3), (4, 7, 6, 5), (5, 6, 2, 1), (4, 0, 3, 7), (7, 3, 2, 6), (4, 5, 1, 0),
  ],
)";
    for scale in ["", ", scale = (-1, 1, 2)"] {
        let boxed = film(&block("box(size: (0.5, 1, 0.25)m)", scale));
        assert_exact("a mesh of the text", &boxed, &film(&block(mesh, scale)), 1.0);
    }
    let smaller = mesh.replace("-0.125)m", "-0.0625)m");
    assert_ne!(film(&block(&smaller, "")).means(), film(&block(mesh, "")).means());
}

/// A mesh of the text that glows is lights, as bright as the rectangle with its corners.
#[test]
fn a_glowing_mesh_of_the_text_is_as_bright_as_the_rectangle() {
    let panel = |shape: &str| {
        let own = format!("instance panel {{ shape = {shape}, material = lamp }}\n");
        compile(&self::text(&[SKY, GLOBE, &own].concat()))
    };
    let corners = "[(-1, 3, -0.5)m, (1, 3, -0.5)m, (1, 3, 0.5)m, (-1, 3, 0.5)m]";
    let mesh = panel(&format!("mesh(points: {corners}, faces: [(0, 1, 2, 3)])"));
    let rectangle = panel("quad(a: (-1, 3, -0.5)m, b: (1, 3, -0.5)m, c: (1, 3, 0.5)m)");
    assert_eq!((mesh.lowered.lights.len(), rectangle.lowered.lights.len()), (4, 3));
    let means = [(&mesh, 3000), (&rectangle, 4000)].map(|(scene, seed)| Means::of(scene, seed));
    assert_same_mean("a glowing mesh", &means[0], &means[1]);
}

/// A light that is off is an opaque black thing: the compiler makes no light of it, and every number is the
/// same.
#[test]
fn a_light_that_is_off_is_a_black_thing() {
    let off = |scene: &mut Scene| scene.lights[0].radiance = [0.0; 3];
    let lights = [SKY, PANEL, GLOBE].concat();
    let dark = compile_changed("".as_ref(), &text(&[&lights, BULB].concat()), off);
    let soot = "material soot: diffuse { color = linear(0) }
instance stand_in { shape = sphere(radius: 40cm), material = soot, at = (-1.5, 2.6, 1)m }\n";
    let black = compile(&text(&[&lights, soot].concat()));
    assert_eq!(dark.lowered.lights.len(), 3);
    assert_exact("a light that is off", &film(&black), &film(&dark), 1.0);
    // On, it is a light.
    assert_eq!(compile(&text(&[&lights, BULB].concat())).lowered.lights.len(), 4);
}

/// Shadow rays to it are spent in vain; those to the other lights count for more.
#[test]
fn a_light_in_a_closed_box_adds_nothing() {
    let crate_ = "instance crate { shape = box(size: (0.6, 0.6, 0.6)m), material = clay, at = (0.4, 0.3, -0.6)m }\n";
    let inside =
        "light ember: sphere { center = (0.4, 0.3, -0.6)m, radius = 25cm, strength = 9 }\n";
    let without = compile(&text(&[SKY, PANEL, GLOBE, crate_].concat()));
    let with = compile(&text(&[SKY, PANEL, GLOBE, crate_, inside].concat()));
    let ember = with.lowered.lights.iter().map(|light| light.pmf).fold(0.0, f32::max);
    assert!(ember > 0.25 && with.lowered.lights.len() == 4, "it is chosen often: {ember}");
    let means = [(&without, 1000), (&with, 2000)].map(|(scene, seed)| Means::of(scene, seed));
    assert_same_mean("a light in a closed box", &means[0], &means[1]);
}

#[test]
fn one_lamp_is_its_two_halves() {
    let [one, two] = [PANEL, HALVES].map(|lamp| compile(&text(&[SKY, GLOBE, lamp].concat())));
    assert_eq!((one.lowered.lights.len(), two.lowered.lights.len()), (3, 4));
    assert_same_mean("one lamp in two halves", &Means::of(&one, 3000), &Means::of(&two, 4000));
}

/// The scene with every light; those of the other group are off and black.
fn group(first: bool) -> Compiled {
    let all = text(&[SKY, PANEL, GLOBE, BULB].concat());
    compile_changed("".as_ref(), &all, |scene| {
        if first {
            scene.lights[0].radiance = [0.0; 3];
        } else {
            scene.sky = None;
        }
        let off = if first { "pearl" } else { "lamp" };
        let off = scene.materials.iter_mut().find(|material| material.name.text == off);
        match off.map(|material| &mut material.model) {
            Some(MaterialModel::Emissive(emissive)) => {
                emissive.brightness = Brightness::Strength(0.0);
            }
            other => panic!("{other:?} gives no light"),
        }
    })
}

#[test]
fn light_of_two_groups_is_the_sum_of_both() {
    let all = compile(&text(&[SKY, PANEL, GLOBE, BULB].concat()));
    let [a, b] = [true, false].map(group);
    let count = |scene: &Compiled| scene.lowered.lights.len();
    assert_eq!((count(&a), count(&b), count(&all)), (2, 2, 4));
    let sum = Means::of(&a, 5000).plus(&Means::of(&b, 6000));
    assert_same_mean("the sum of two groups of lights", &Means::of(&all, 7000), &sum);
}
