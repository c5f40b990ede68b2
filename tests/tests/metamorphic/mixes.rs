//! A mix is the sum of its materials, each with its share: it is as bright as the one material that is that sum.

use tests::scene::compile;

use crate::compare::{Means, SIZE, assert_exact, assert_same_mean, film};

/// A ball and a floor of the material `m`, under a lamp and a sky.
fn text(materials: &str) -> String {
    let [width, height] = SIZE;
    format!(
        "rts 1
{materials}
sky day: gradient {{ strength = 0.5 }}
instance ball {{ shape = sphere(radius: 80cm), material = m, at = (0, 0.8, 0)m }}
instance floor {{ shape = rectangle(size: (6, 6)m), material = m }}
light bulb: sphere {{ center = (1.5, 3, 2)m, radius = 40cm, strength = 8 }}
camera eye: perspective {{ from = (0, 1.6, 5)m, to = (0, 0.7, 0)m, fov.vertical = 40deg }}
film f {{ size = ({width}, {height})px }}
render main: path {{ camera = eye, film = f, samples = 128, depth = 6, seed = 1 }}
"
    )
}

const RED: &str = "material red: diffuse { color = linear(0.8, 0.2, 0.4) }\n";
const BLUE: &str = "material blue: diffuse { color = linear(0, 0.6, 0.8) }\n";

#[test]
fn a_mix_of_colours_is_their_mean() {
    let mix = |amount: &str| {
        let both = format!("material m: mix {{ a = red, b = blue, amount = {amount} }}\n");
        compile(&text(&[RED, BLUE, &both].concat()))
    };
    let mean = compile(&text("material m: diffuse { color = linear(0.6, 0.3, 0.5) }\n"));
    let mean = Means::of(&mean, 3000);
    assert_same_mean("a quarter", &Means::of(&mix("0.25"), 1000), &mean);
    // A half of a half.
    let nested = "material half: mix { a = red, b = blue }
material m: mix { a = half, b = red }\n";
    let nested = compile(&text(&[RED, BLUE, nested].concat()));
    assert_same_mean("a mix of mixes", &Means::of(&nested, 2000), &mean);
}

/// A mix of which nothing is `b` is `a`, to the last bit, and costs nothing.
#[test]
fn a_mix_with_one_part_is_that_part() {
    let red = compile(&text("material m: diffuse { color = linear(0.8, 0.2, 0.4) }\n"));
    for (a, b, amount) in [("red", "blue", "0"), ("blue", "red", "1")] {
        let mix = format!("material m: mix {{ a = {a}, b = {b}, amount = {amount} }}\n");
        let mix = compile(&text(&[RED, BLUE, &mix].concat()));
        assert_eq!(mix.lowered.materials.len(), red.lowered.materials.len());
        assert_exact("one part", &film(&red), &film(&mix), 1.0);
    }
}
