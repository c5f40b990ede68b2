//! What does not move does not change.

use pack::Pack;
use tests::picture;
use tests::scene;

/// A room with a ball inside a closed box, which nobody sees.
fn room(ball: &str, shutter: &str) -> String {
    format!(
        "rts 1
material white: diffuse {{ color = linear(0.7) }}
material brass: metal {{ color = linear(0.8, 0.6, 0.3), fuzz = 0.4 }}
instance floor {{ shape = rectangle(size: (6, 6)m), material = white }}
instance crate {{ shape = box(size: (1.2, 1.2, 1.2)m), material = white, at = (0, 0.6, 0)m }}
instance ball {{ shape = sphere(radius: 20cm), material = brass, at = (0, 0.6, 0)m{ball} }}
light bulb: sphere {{ center = (2, 4, 2)m, radius = 30cm, strength = 20 }}
sky dim: constant {{ color = linear(0.2) }}
camera eye: perspective {{ from = (0, 1.6, 5)m, to = (0, 1, 0)m{shutter} }}
film f {{ size = (24, 24)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 8, seed = 1 }}
"
    )
}

#[test]
fn what_does_not_move_keeps_every_bit() {
    let bits = |text: &str| {
        let pack = Pack::from_bytes(scene::bytes(&scene::compile(text))).expect("valid");
        let features = pack.features();
        let outcome = picture::cpu(pack, |_| {});
        let rgb: Vec<u64> = outcome.film().means().iter().flatten().map(|x| x.to_bits()).collect();
        (rgb, features & pack::features::MOTION != 0)
    };
    let open = ", shutter = 0ms..20ms";
    let (expected, moves) = bits(&room("", ""));
    assert!(!moves);
    let zero = ", velocity = (0, 0, 0)m/s";
    let moving = ", velocity = (10, 0, 0)m/s";
    for (ball, shutter, moves) in [
        (zero, "", false),
        ("", open, false),
        (zero, open, false),
        (moving, "", false),
        (moving, open, true),
    ] {
        let found = bits(&room(ball, shutter));
        assert_eq!(found.1, moves, "{ball}{shutter}");
        assert!(found.0 == expected, "{ball}{shutter}: another picture");
    }
}
