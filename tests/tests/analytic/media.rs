//! Media whose radiance is known in closed form.

use pack::Pack;
use tests::picture::{self, Estimate, channel};
use tests::scene;

use super::{Check, all, view};

/// A lamp of radiance 1 that fills the wall at `z`.
fn wall(z: f64) -> String {
    format!(
        "material lamp: emissive {{ color = linear(1) }}
instance wall {{ shape = rectangle(size: (24, 24)m), material = lamp, rotate = (90, 0, 0)deg, at = (0, 0, {z})m }}
"
    )
}

/// Looks along -z at the origin from `from`, with y up.
fn ahead(from: [f64; 3]) -> String {
    view(from, [0.0; 3], 1000).replace("up = (0.1, 0.2, 1)", "up = (0, 1, 0)")
}

/// Looks from inside along `to`.
fn from_origin(to: [f64; 3]) -> String {
    view([0.0; 3], to, 1000).replace("up = (0.1, 0.2, 1)", "up = (1, 0.3, 0)")
}

#[test]
fn absorbers_fade_by_beer_and_lambert() {
    let slab = |sigma: f64, ior: f64, from: [f64; 3]| {
        format!(
            "rts 1
medium ink: homogeneous {{ sigma_a = {sigma:.12}/m }}
material m: dielectric {{ ior = {ior}, interior = ink }}
instance slab {{ shape = box(size: (12, 12, 0.5)m), material = m }}
{}{}",
            wall(-4.0),
            ahead(from)
        )
    };
    // Transmittance 1/2 straight through: T = (1 - F)^2 t / (1 - F^2 t^2).
    let half = std::f64::consts::LN_2 / 0.5;
    let f: f64 = 0.04;
    let glass = (1.0 - f) * (1.0 - f) * 0.5 / (1.0 - f * f * 0.25);
    assert!((glass - 0.460_984_4).abs() < 1e-6);
    let ball = format!(
        "rts 1
medium ink: homogeneous {{ sigma_a = 0.4/m }}
material m: dielectric {{ ior = 1.5, interior = ink }}
instance ball {{ shape = sphere(radius: 1m), material = m }}
{}{}",
        wall(-4.0),
        ahead([0.0, 0.0, 5.0])
    );
    let t = (-0.8_f64).exp();
    let through_ball = (1.0 - f) * (1.0 - f) * t / (1.0 - f * f * t * t);
    all(&[
        Check::new("absorber, straight", (-0.7_f64).exp(), slab(1.4, 1.0, [0.0, 0.0, 5.0]))
            .depth(0.7),
        Check::new("absorber, cosine 0.6", (-0.7_f64 / 0.6).exp(), slab(1.4, 1.0, [0.0, 4.0, 3.0]))
            .depth(1.2),
        Check::new("absorber of depth 20", (-20.0_f64).exp(), slab(40.0, 1.0, [0.0, 0.0, 5.0]))
            .depth(20.0),
        Check::new("absorber of depth 1e-6", 1.0 - 1e-6, slab(2e-6, 1.0, [0.0, 0.0, 5.0])),
        Check::new("clear medium", 1.0, slab(0.0, 1.0, [0.0, 0.0, 5.0])),
        Check::new("absorbing pane 1.5", glass, slab(half, 1.5, [0.0, 0.0, 5.0])).samples(2048),
        Check::new("absorbing glass ball, central ray", through_ball, ball).samples(2048),
    ]);
}

#[test]
fn a_thick_slab_reflects_as_chandrasekhar_says() {
    // Semi-infinite, isotropic, index-matched: 1 - H(mu) sqrt(1 - a), seen under a sky of 1.
    let rows = [
        (0.5, [0.115_226, 0.160_144, 0.241_721]),
        (0.9, [0.414_947, 0.507_939, 0.629_336]),
        (0.99, [0.752_721, 0.815_140, 0.877_512]),
    ];
    let mut checks = Vec::new();
    for (albedo, values) in rows {
        for (mu, value) in [1.0_f64, 0.5, 0.1].into_iter().zip(values) {
            let side = 30.0 * (1.0 - mu * mu).sqrt();
            let text = format!(
                "rts 1
sky heaven: constant {{ color = linear(1) }}
medium milk: homogeneous {{ mean_free_path = 1m, albedo = linear({albedo}) }}
material m: dielectric {{ ior = 1, interior = milk }}
instance slab {{ shape = box(size: (400, 400, 200)m), material = m, at = (0, 0, -100)m }}
{}",
                view([side, 0.0, 30.0 * mu], [0.0; 3], 1024)
                    .replace("up = (0.1, 0.2, 1)", "up = (0, 1, 0)")
                    .replace("fov.vertical = 0.001deg", "fov.vertical = 0.0001deg"),
            );
            checks.push(
                Check::new(format!("thick slab, albedo {albedo}, cosine {mu}"), value, text)
                    .samples(if albedo < 0.9 { 4096 } else { 2048 }),
            );
        }
    }
    all(&checks);
}

/// Renders, and checks all three channels.
fn lossless(name: &str, text: &str, samples: u32) {
    let pack = Pack::from_bytes(scene::bytes(&scene::compile(text))).expect("valid");
    let outcome = picture::cpu(pack, |job| {
        job.resize([16, 16]);
        job.samples = runtime::SampleRange { start: 0, end: samples };
    });
    let counters = outcome.film().counters;
    assert_eq!((counters.bad, counters.overflows), (0, 0), "{name}");
    // Paths that slip past an edge by rounding.
    assert!(counters.leaks * 20_000 <= outcome.film().total_samples(), "{name}: {counters:?}");
    for k in 0..3 {
        let found = Estimate::of(&channel(outcome.film(), k));
        let off = (found.mean - 1.0).abs();
        tests::console::line(&format!("{name:<44} channel {k}: {} +- {}", found.mean, found.error));
        assert!(off <= 4.0 * found.error + 1e-5, "{name}, {k}: {} +- {}", found.mean, found.error);
        assert!(found.error < 3e-3, "{name}, {k}: +- {}", found.error);
    }
}

#[test]
fn what_loses_nothing_is_invisible_in_a_white_sky() {
    let scene = |things: &str, atmosphere: &str| {
        format!(
            "rts 1
sky heaven: constant {{ color = linear(1) }}
{things}
camera eye: perspective {{ from = (0, 1, 6)m, to = (0, 0, 0)m, fov.vertical = 15deg }}
film f {{ size = (16, 16)px }}
render main: path {{ camera = eye, film = f, sky = heaven, samples = 16, depth = 1024, seed = 3{atmosphere} }}
"
        )
    };
    let thing = |medium: &str, material: &str, shape: &str| {
        format!(
            "medium inner: homogeneous {{ {medium} }}
material m: dielectric {{ {material}, interior = inner }}
instance thing {{ shape = {shape}, material = m, rotate = (10, 20, 30)deg }}"
        )
    };
    let ball = "sphere(radius: 1m)";
    let cube = "box(size: (1.5, 1.5, 1.5)m)";
    let white = "material white: diffuse { color = linear(1) }
instance ball { shape = sphere(radius: 1m), material = white }";
    let grey = "sigma_s = 3/m, g = 0.7";
    let colored = "sigma_s = (0.1, 1, 10)/m, g = -0.4";
    lossless("grey ball", &scene(&thing(grey, "ior = 1", ball), ""), 256);
    lossless("coloured box", &scene(&thing(colored, "ior = 1", cube), ""), 1024);
    lossless("milk glass ball", &scene(&thing(grey, "ior = 1.5", ball), ""), 1024);
    lossless("coloured glass box", &scene(&thing(colored, "ior = 1.33", cube), ""), 1024);
    let haze = format!(
        "{white}\nmedium haze: homogeneous {{ sigma_s = 0.2/m, g = 0.6, sky_distance = 8m }}"
    );
    lossless("white ball in haze", &scene(&haze, ", atmosphere = haze"), 256);
    let fog = format!(
        "{white}\nmedium mist: fog {{ density = 0.2/m, color = linear(1), sky_distance = 9m }}"
    );
    lossless("white ball in fog of the sky's colour", &scene(&fog, ", atmosphere = mist"), 256);
    let milk = format!(
        "{}\nmedium mist: fog {{ density = 0.2/m, color = linear(1), sky_distance = 9m }}",
        thing(colored, "ior = 1", cube)
    );
    lossless("coloured box in fog of the sky's colour", &scene(&milk, ", atmosphere = mist"), 1024);
    let waves = "material wet: water { sigma_a = 0/m, waves.scale = 3, waves.height = 6 }
instance pool { shape = box(size: (1.5, 1.5, 1.5)m), material = wet }";
    lossless("clear water with waves", &scene(waves, ""), 256);
    // Nested: glass around milk, overlapping, and a bubble of air in it.
    let nested = "medium milk: homogeneous { sigma_s = 2/m }
material glass: dielectric { ior = 1.5, priority = 3 }
material milky: dielectric { ior = 1.35, interior = milk, priority = 2 }
material air: dielectric { ior = 1, priority = 4 }
instance lower { shape = box(size: (2, 0.4, 2)m), material = glass, at = (0, -0.5, 0)m }
instance drink { shape = box(size: (1.4, 1.2, 1.4)m), material = milky, at = (0, 0.1, 0)m }
instance bubble { shape = sphere(radius: 20cm), material = air, at = (0, 0.3, 0.2)m }";
    lossless("milk on glass with a bubble", &scene(nested, ""), 1024);
}

#[test]
fn interfaces_refract_against_what_is_there() {
    // Glass, water, glass, overlapping: lossless layers add up as (1 - T) / T = sum of R / (1 - R).
    let r = |a: f64, b: f64| ((a - b) / (a + b)) * ((a - b) / (a + b));
    let layers = |list: &[f64]| 1.0 / (1.0 + list.iter().map(|r| r / (1.0 - r)).sum::<f64>());
    let (outer, inner) = (r(1.5, 1.0), r(1.5, 1.333));
    let tank = format!(
        "rts 1
material glass: dielectric {{ ior = 1.5, priority = 2 }}
material water: dielectric {{ ior = 1.333, priority = 1 }}
instance front {{ shape = box(size: (12, 12, 0.1)m), material = glass, at = (0, 0, 0.5)m }}
instance back {{ shape = box(size: (12, 12, 0.1)m), material = glass, at = (0, 0, -0.5)m }}
instance fill {{ shape = box(size: (11, 11, 1)m), material = water }}
{}{}",
        wall(-4.0),
        ahead([0.0, 0.0, 5.0])
    );
    // Glass 1.5 in glass 1.5 of another name: no interface.
    let same = tank.replace("1.333", "1.5");
    // The camera is inside: radiance in the medium is n^2 times that outside.
    let n2 = 1.333 * 1.333;
    let f = r(1.333, 1.0);
    let t = (-0.3_f64).exp();
    let inside = format!(
        "rts 1
sky heaven: constant {{ color = linear(1) }}
medium blue: homogeneous {{ sigma_a = 0.3/m }}
material water: dielectric {{ ior = 1.333, interior = blue }}
instance pool {{ shape = box(size: (30, 2, 30)m), material = water }}
{}",
        from_origin([0.0, 1.0, 0.0])
    );
    let pool = n2 * (1.0 - f) * t / (1.0 - f * t * t);
    all(&[
        Check::new("tank of water", layers(&[outer, inner, inner, outer]), tank).samples(8192),
        Check::new("glass in glass", layers(&[outer, outer]), same).samples(8192),
        Check::new("camera in water", pool, inside).samples(8192),
    ]);
}

#[test]
fn light_samples_reach_through_matched_surfaces() {
    // A white floor 2 m deep in ink, under a small sun: both ways fade.
    let sine = 0.01;
    let scene = |ior: &str| {
        format!(
            "rts 1
medium ink: homogeneous {{ sigma_a = 0.25/m }}
material m: dielectric {{ {ior}, interior = ink }}
material white: diffuse {{ color = linear(1) }}
instance floor {{ shape = rectangle(size: (9, 9)m), material = white, at = (0, 0, 0)m }}
instance tank {{ shape = box(size: (10, 4, 10)m), material = m }}
light sun: sphere {{ center = (0, 100, 0)m, radius = {}m, strength = 1e4 }}
{}",
            100.0 * sine,
            view([0.0, 5.0, 0.0], [0.0; 3], 12).replace("up = (0.1, 0.2, 1)", "up = (0, 0, 1)")
        )
    };
    let expected = 1e4 * sine * sine * (-1.0_f64).exp();
    all(&[Check::new("sun through ink", expected, scene("ior = 1")).samples(1024).depth(1.0)]);
}

#[test]
fn seas_show_the_colour_of_the_deep() {
    let sea = |from: [f64; 3], water: &str| {
        format!(
            "rts 1
sky heaven: constant {{ color = linear(1) }}
material wet: water {{ waves = off, {water} }}
instance sea {{ shape = rectangle(size: (90, 90)m), material = wet }}
{}",
            view(from, [0.0, -from[1].signum(), 0.0].map(|c| c + 0.0), 64)
                .replace("up = (0.1, 0.2, 1)", "up = (0, 0, 1)")
        )
    };
    let f = (0.333_f64 / 2.333) * (0.333 / 2.333);
    let (n2, t) = (1.333 * 1.333, (-0.06_f64 * 2.0).exp());
    let above = f + (1.0 - f) * 0.06;
    // From 2 m below: the sky through the surface, and the deep mirrored in it.
    let below = n2 * ((1.0 - f) * t + f * t * 0.06);
    let down = "depth.color = linear(0.02, 0.06, 0.1)";
    let up = sea([0.0, -2.0, 0.0], down).replace("to = (0, 1, 0)m", "to = (0, 9, 0)m");
    all(&[
        Check::new("sea from above", above, sea([0.0, 5.0, 0.0], down)).samples(2048),
        Check::new("sea from below", below, up).samples(512),
    ]);
}

#[test]
fn fog_hides_things_behind_its_own_colour() {
    // A lamp of 1 behind 20 m of fog of radiance 0.5.
    let text = format!(
        "rts 1
medium mist: fog {{ density = 0.08/m, color = linear(0.5) }}
{}{}",
        wall(-15.0),
        ahead([0.0, 0.0, 5.0]).replace("depth = 1000", "depth = 4, atmosphere = mist")
    );
    let t = (-1.6_f64).exp();
    // The sky, 100 m of fog away.
    let sky = format!(
        "rts 1
medium mist: fog {{ visibility = 391.2023m, color = linear(0.2), sky_distance = 100m }}
sky day: constant {{ color = linear(3) }}
material clay: diffuse {{ color = linear(0.5) }}
instance ball {{ shape = sphere(radius: 1m), material = clay, at = (0, 0, 9)m }}
{}",
        ahead([0.0, 0.0, 5.0]).replace("depth = 1000", "depth = 4, atmosphere = mist")
    );
    let s = (-1.0_f64).exp();
    all(&[
        Check::new("lamp in fog", t + (1.0 - t) * 0.5, text).depth(1.6),
        Check::new("sky behind fog", s * 3.0 + (1.0 - s) * 0.2, sky).depth(1.0),
    ]);
}

/// A lamp of 3 behind a slab of ink, 1 m deep, all of it in fog: what fog sends inside of the slab is taken away by the
/// ink only from where it was sent. A medium that scatters straight on alone changes nothing of that.
#[test]
fn fog_in_an_absorber_fades_from_where_it_was_sent() {
    let (fog, color, lamp) = (0.3_f64, 0.2, 3.0);
    let scene = |ink: &str| {
        format!(
            "rts 1
medium mist: fog {{ density = {fog}/m, color = linear({color}) }}
medium ink: homogeneous {{ {ink} }}
material skin: dielectric {{ ior = 1, interior = ink }}
instance slab {{ shape = box(size: (60, 60, 1)m), material = skin, at = (0, 0, 0.5)m }}
{}{}",
            wall(-1.0).replace("linear(1)", &format!("linear({lamp})")),
            ahead([0.0, 0.0, 3.0]).replace("depth = 1000", "depth = 64, atmosphere = mist")
        )
    };
    let expected = |sigma: f64| {
        let part = |length: f64, sigma: f64, behind: f64| {
            let t = (-(fog + sigma) * length).exp();
            t * behind + (1.0 - t) * color * fog / (fog + sigma)
        };
        part(2.0, 0.0, part(1.0, sigma, part(1.0, 0.0, lamp)))
    };
    assert!((expected(0.5) - 0.673_74).abs() < 1e-5);
    all(&[
        Check::new("fog in ink", expected(0.5), scene("sigma_a = 0.5/m")).depth(1.7),
        Check::new("fog in thick ink", expected(9.0), scene("sigma_a = 9/m")).depth(10.0),
        Check::new(
            "fog in ink that scatters straight on",
            expected(0.5),
            scene("sigma_a = 0.5/m, sigma_s = 2/m, g = 1"),
        )
        .samples(4096)
        .depth(1.7),
    ]);
}
