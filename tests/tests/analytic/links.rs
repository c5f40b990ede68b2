//! Light linking: a light that is linked to a thing lights it as any light does, and gives nothing to what it is not
//! linked to, by either way of finding it. Shadows and the camera's view of the light are not linked.

use super::{Check, all, lit_floor, sun, view};
use std::f64::consts::PI;
use tests::picture;
use tests::scene;

/// Something else that a light may be linked to, away from the floor and from the light.
const OTHER: &str = "material grey: diffuse { color = linear(0.5) }\ninstance other { shape = sphere(radius: 5cm), material = grey, at = (9, -3, 0)m }\n";

/// A lamp of each kind, and what it gives the floor.
fn lamps() -> Vec<(String, f64)> {
    let lamp = 1.0 / (4.0 * PI);
    vec![
        ("light l: point { at = (0, 2, 0)m, intensity = 683cd }".to_owned(), lamp),
        ("light l: sphere { center = (0, 2, 0)m, radius = 1m }".to_owned(), 0.25),
        ("light l: spot { at = (0, 2, 0)m, intensity = 683cd, cone = 30deg }".to_owned(), lamp),
        ("light l: rectangle { at = (0, 1, 0)m, size = (2, 2)m }".to_owned(), 0.554_126_424),
        // The share of the cosine that a disk fills: r^2 / (r^2 + h^2).
        ("light l: disk { at = (0, 1, 0)m, radius = 1m }".to_owned(), 0.5),
        ("light l: mesh { shape = sphere(radius: 1m), at = (0, 2, 0)m }".to_owned(), 0.25),
        (sun(0.0, 2.0), 1.0),
    ]
}

/// With one more field.
fn with(lamp: &str, field: &str) -> String {
    lamp.replacen("{ ", &format!("{{ {field}, "), 1)
}

#[test]
fn linked_lights_light_what_they_are_linked_to() {
    let mut checks = Vec::new();
    for (lamp, expected) in lamps() {
        let cases = [
            ("only = floor", expected),
            ("only = [other, floor]", expected),
            ("except = other", expected),
            ("only = [other]", 0.0),
            ("except = [other, floor]", 0.0),
        ];
        for (field, expected) in cases {
            let text = format!("{OTHER}{}", with(&lamp, field));
            let name = format!("{field}: {lamp}");
            checks.push(lit_floor(&name, expected, &text).samples(if expected > 0.0 {
                512
            } else {
                16
            }));
        }
    }
    // One that does and one that does not, chosen by the table and, of four, by the tree; and a sky, which is never linked.
    let [point, ball] = [0, 1].map(|k| lamps()[k].clone());
    let two = format!(
        "{OTHER}{}\n{}",
        with(&point.0, "only = floor"),
        with(&ball.0.replace("l:", "k:").replace("(0, 2, 0)", "(4, 2, 0)"), "only = other")
    );
    checks.push(lit_floor("one of two", point.1, &two).samples(1024));
    // Lamps so small that they hide nothing of the sky.
    let fields = ["only = floor", "except = floor", "only = other", "except = other"];
    let places = ["(1, 2, 0)", "(-1, 2, 0)", "(0, 2, 1)", "(0, 2, -1)"];
    let lamp = |name, field, at| {
        format!("light {name}: point {{ {field}, at = {at}m, radius = 1mm, intensity = 683cd }}\n")
    };
    let names = ["a", "b", "c", "d"].into_iter();
    let four: Vec<String> =
        names.zip(fields).zip(places).map(|((name, field), at)| lamp(name, field, at)).collect();
    let four = four.concat();
    let text = format!("{OTHER}{four}sky s: constant {{ color = linear(0.5) }}\n");
    let lamp = (1.0 / PI) * 2.0 / 5.0_f64.powf(1.5);
    checks.push(lit_floor("two of four, and the sky", 2.0 * lamp + 0.5, &text).samples(4096));
    all(&checks);
}

/// Shadow rays and scattered ones find a lamp each for itself.
#[test]
fn links_hold_for_either_way_of_finding_a_light() {
    let lit = |field: &str, expected: f64, estimator: u32| {
        let lamp = format!("light l: sphere {{ center = (0, 2, 0)m, radius = 1m, {field} }}");
        let name = format!("{field} by estimator {estimator}");
        let check = lit_floor(&name, expected, &format!("{OTHER}{lamp}"));
        Check { estimator, ..check }.samples(if expected > 0.0 { 4096 } else { 64 })
    };
    let both =
        (1..=2).flat_map(|way| [lit("only = floor", 0.25, way), lit("only = other", 0.0, way)]);
    all(&both.collect::<Vec<_>>());
}

#[test]
fn shadows_mirrors_and_the_camera() {
    let lamp = "light l: rectangle { at = (0, 3, 0)m, size = (2, 2)m, strength = 3, sides = both";
    let sky = "sky s: constant { color = linear(0.25) }";
    let shade = "instance lid { shape = sphere(radius: 1m), material = white, at = (0, 1.5, 0)m }";
    let point = "light l: point { at = (0, 3, 0)m, intensity = 683cd, only = floor }";
    let mirror = "material m: metal { color = linear(1) }
instance floor { shape = rectangle(size: (4, 4)m), material = m }";
    let seen = |field: &str| {
        let view = view([-0.1, 1.0, 0.0], [0.0; 3], 3);
        format!("rts 1\n{mirror}\n{OTHER}{lamp}, {field} }}\n{sky}\n{view}")
    };
    let above = format!(
        "rts 1\n{mirror}\n{lamp}, except = floor }}\n{sky}\n{}",
        view([0.0, 1.0, 0.0], [0.0, 3.0, 0.0], 2)
    );
    all(&[
        lit_floor("a shadow of what is not linked", 0.0, &format!("{shade}\n{point}")).samples(16),
        Check::new("a mirror that is linked", 3.0, seen("only = floor")),
        // It reflects nothing there, not what is behind the light.
        Check::new("a mirror that is not", 0.0, seen("except = floor")).samples(16),
        Check::new("the camera", 3.0, above),
    ]);
}

/// The picture of a filled ball in a lamp's light, whose light is linked so.
fn filled(field: &str, air: &str) -> Vec<u64> {
    let text = format!(
        "rts 1
medium milk: homogeneous {{ mean_free_path = 30cm, albedo = linear(0.9) }}
medium smoke: homogeneous {{ mean_free_path = 3m, albedo = linear(0.9) }}
material glass: dielectric {{ ior = 1, interior = milk }}
material grey: diffuse {{ color = linear(0.5) }}
instance ball {{ shape = sphere(radius: 1m), material = glass }}
instance other {{ shape = sphere(radius: 1m), material = grey, at = (0, 0, 50)m }}
light l: sphere {{ center = (0, 3, 0)m, radius = 30cm, strength = 30, visible = off{field} }}
camera eye: perspective {{ from = (0, 1, 5)m, to = (0, 0, 0)m, fov.vertical = 20deg }}
film f {{ size = (16, 16)px }}
render main: path {{ camera = eye, film = f, samples = 8, depth = 12, seed = 3{air} }}
"
    );
    let outcome = picture::cpu(scene::pack(&text), |_| {});
    picture::channel(outcome.film(), 1).into_iter().map(f64::to_bits).collect()
}

#[test]
fn media_are_lit_as_what_they_fill() {
    let plain = filled("", "");
    assert!(plain.iter().any(|bits| *bits != 0));
    assert!(plain == filled(", only = ball", ""), "linked to the ball");
    assert!(plain == filled(", except = other", ""), "not linked to another");
    for field in [", only = other", ", except = ball"] {
        assert!(filled(field, "").iter().all(|bits| *bits == 0), "{field}");
    }
    // Air has no name.
    let air = ", atmosphere = smoke";
    let plain = filled("", air);
    assert!(plain == filled(", except = other", air), "air, and everything but another thing");
    let some = filled(", except = ball", air);
    assert!(some.iter().any(|bits| *bits != 0) && some != plain, "air alone");
}
