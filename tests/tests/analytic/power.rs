//! Lamps of any shape that say their power: radiance times pi times the area that shines is what they say.

use std::f64::consts::PI;
use tests::scene;

/// A cube of 2 m, closed, and one without its top.
fn cube(open: bool) -> String {
    let corner = |k: u32| {
        let at = |bit: u32| if k >> bit & 1 == 1 { 1 } else { -1 };
        format!("v {} {} {}\n", at(0), at(1), at(2))
    };
    let corners: String = (0..8).map(corner).collect();
    let sides = "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 1 3 4 2\nf 5 6 8 7\n";
    format!("{corners}{sides}{}", if open { "" } else { "f 3 7 8 4\n" })
}

/// The radiance of the one thing that glows in a scene with these lines.
fn radiance(lines: &str) -> [f64; 3] {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    for (name, open) in [("cube.obj", false), ("tray.obj", true)] {
        std::fs::write(dir.path().join(name), cube(open)).expect("a file can be written");
    }
    let text = format!(
        "rts 1
asset cube = obj(\"cube.obj\", unit: m, up: +y)
asset tray = obj(\"tray.obj\", unit: m, up: +y)
material grey: diffuse {{ color = linear(0.5) }}
instance floor {{ shape = rectangle(size: (9, 9)m), material = grey }}
object block {{ shape = cube }}
object slab {{ shape = cube, scale = (1, 1, 0.5) }}
instance other {{ shape = tray, material = grey, at = (0, -9, 0)m }}
instance another {{ shape = [block, slab], material = grey, at = (0, -9, 0)m }}
{lines}
camera eye: perspective {{ from = (0, 2, 9)m, to = (0, 1, 0)m }}
film f {{ size = (8, 8)px }}
render main: path {{ samples = 1 }}
"
    );
    let compiled = scene::compile_in(dir.path(), &text);
    let lit: Vec<_> =
        compiled.lowered.materials.iter().filter(|m| m.emission.iter().any(|c| *c > 0.0)).collect();
    assert_eq!(lit.len(), 1, "{lines}");
    lit[0].emission.map(f64::from)
}

#[test]
fn any_shape_gives_off_the_power_that_it_says() {
    let grow = "scale = (1, 0.5, 2)";
    // Of a box of 2 x 1 x 4 m.
    let area = 2.0 * (2.0 + 8.0 + 4.0);
    for (shape, shines) in [
        ("shape = sphere(radius: 50cm), scale = 3", 4.0 * PI * 2.25),
        ("shape = box(size: (1, 2, 3)m)", 22.0),
        ("shape = rectangle(size: (1, 2)m)", 4.0),
        ("shape = rectangle(size: (1, 2)m), sides = front", 2.0),
        (&format!("shape = cube, {grow}"), area),
        (&format!("shape = cube, {grow}, rotate = (10, 20, 30)deg, sides = front"), area),
        // Without its top of 2 x 4 m, and from within.
        (&format!("shape = tray, {grow}"), 2.0 * (area - 8.0)),
        (&format!("shape = tray, {grow}, sides = front"), area - 8.0),
        ("shape = [block, slab]", 24.0 + 16.0),
    ] {
        for (says, watts) in [
            ("power = 60W", [60.0; 3]),
            ("power = 60W, color = linear(1, 0.5, 0.25)", [60.0, 30.0, 15.0]),
            ("power = 683lm", [1.0; 3]),
            // Of luminance 0.7152.
            ("power = 683lm, color = linear(0, 3, 0)", [0.0, 1.0 / 0.7152, 0.0]),
        ] {
            let lamp = format!("light lamp: mesh {{ {shape}, {says} }}");
            for (found, watts) in radiance(&lamp).into_iter().zip(watts) {
                let expected = watts / (PI * shines);
                assert!((found - expected).abs() <= 2e-4 * expected, "{lamp}: {found}, {expected}");
            }
        }
    }
}

/// The power of a material is that of all that is made of it.
#[test]
fn a_material_shares_its_power() {
    let lamps = "material glow: emissive { color = linear(2, 1, 0), power = 10W }
instance a { shape = sphere(radius: 1m), material = glow, at = (0, 3, 0)m }
instance b[i in 0..2] { shape = rectangle(size: (1, 2)m), material = glow, at = (2 + i, 3, 0)m }
";
    let area = 4.0 * PI + 2.0 * 4.0;
    for (found, watts) in radiance(lamps).into_iter().zip([20.0, 10.0, 0.0]) {
        let expected = watts / (PI * area);
        assert!((found - expected).abs() <= 1e-6 * expected, "{found}, {expected}");
    }
}
