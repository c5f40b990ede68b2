//! A ball of one material in a small studio: what the reference shows beside each material.

/// The scene text that shows the material which `example` declares, `size` pixels wide and high.
///
/// # Panics
/// When the example declares no material.
#[must_use]
pub fn scene(example: &str, size: u32, samples: u32) -> String {
    let at = example.find("material ").expect("the examples of materials declare one");
    let name: String = example[at + "material ".len()..]
        .chars()
        .take_while(|c| c.is_ascii_alphanumeric() || *c == '_')
        .collect();
    // What an example may refer to, unless it declares that itself.
    let parts: String =
        [STEEL, CLAY].into_iter().filter(|(part, _)| *part != name).map(|row| row.1).collect();
    format!("rts 1\n{parts}{example}\ninstance ball {{ shape = sphere(radius: 50cm), material = {name}, at = (0, 0.5, 0)m }}\n{STUDIO}\
film square {{ size = ({size}, {size})px, tone_map = aces }}
render main: path {{ camera = eye, film = square, samples = {samples}, depth = 24 }}\n")
}

/// Materials that examples may be made of.
const STEEL: (&str, &str) =
    ("steel", "material steel: conductor { color = linear(0.6, 0.62, 0.65), roughness = 0.25 }\n");
const CLAY: (&str, &str) = ("clay", "material clay: diffuse { color = srgb(#b5651d) }\n");

/// Floor with stripes to bend, a large soft light, a small hard one, a grey room.
const STUDIO: &str = "material studio_floor: diffuse { color = linear(0.35) }
material studio_stripe: diffuse { color = linear(0.08, 0.1, 0.13) }
material studio_lamp: emissive { color = linear(1, 0.96, 0.9), strength = 9, sides = front }
instance studio_ground { shape = rectangle(size: (40, 40)m), material = studio_floor }
instance studio_stripes[i in 0..12] {
  shape = rectangle(size: (0.12, 6)m)
  material = studio_stripe
  at = (0.3m * (i - 5.5), 0.001m, -1.2m)
}
instance studio_softbox {
  shape = rectangle(size: (1.6, 1.6)m)
  material = studio_lamp
  rotate = (150, 0, 40)deg
  at = (-1.5, 2.2, 1.4)m
}
light studio_bulb: sphere { center = (2.2, 1.6, -1.4)m, radius = 12cm, color = linear(0.8, 0.9, 1), strength = 60 }
sky studio_room: gradient {
  zenith = linear(0.5, 0.55, 0.6)
  middle = linear(0.35, 0.37, 0.4)
  horizon = linear(0.25)
  ground = linear(0.1)
}
camera eye: perspective {
  from = (0, 0.95, 2.4)m
  to = (0, 0.47, 0)m
  fov.vertical = 30deg
}
";
