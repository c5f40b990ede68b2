//! Bumps, patterns, layers, textures and cut-outs at their limits.

use std::fmt::Write as _;

use super::tools::{
    WHITE_SKY, count, diagnose, estimates, films, films_of, lit, means, shot, sized, view,
};
use super::{Case, Row};
use crate::kernel::{Bench, Lobe};
use crate::picture::channel;
use crate::scene;
use crate::statistics::stream::Stream;
use crate::statistics::{Counts, index};

/// The cases of this file.
pub const CASES: &[Case] = &[
    Case {
        id: "X28",
        input: "bumps with a slope of 1e3",
        must: "energy at most 1 + 1e-3; no light from below",
        measure: steep,
    },
    Case {
        id: "X29",
        input: "fractal noise at coordinates of 1e6, 16 octaves",
        must: "finite, exact; no lattice (chi-square of values)",
        measure: far_noise,
    },
    Case {
        id: "X30",
        input: "clear coat over black and over white",
        must: "mean reflectance .0918 (index 1.5), at most 1; 1e-3",
        measure: coats,
    },
    Case {
        id: "X31",
        input: "textures of 1x1, 3x5, 16384x16384 texels; u = -0.0, 1.0, 1e9",
        must: "wrapped as documented, exact texel",
        measure: textures,
    },
    Case {
        id: "X32",
        input: "alpha texture all 0, all 1, exactly at the threshold",
        must: "invisible, opaque, as documented (there); camera and shadow rays alike; exact",
        measure: alpha,
    },
];

fn steep() -> Vec<Row> {
    // A few noise cells of 1 m differ by up to 300 m.
    let crags =
        "material m: stone { color = linear(1), color.vein = linear(1), bump.strength = 300m }\n";
    let ball = format!(
        "{WHITE_SKY}{crags}instance ball {{ shape = sphere(radius: 1m), material = m }}\n{}",
        shot([0.0, 1.0, 6.0], [0.0; 3], 14.0, 64)
    );
    let found = means(&ball, 32, 64);
    // A lamp below a wide floor; the camera is above.
    let below = format!(
        "{crags}material lamp: emissive {{ color = linear(1), strength = 50 }}
instance floor {{ shape = rectangle(size: (40, 40)m), material = m }}
instance sun {{ shape = sphere(radius: 1m), material = lamp, at = (0, -3, 0)m }}\n{}",
        shot([0.0, 3.0, 1.0], [0.0; 3], 40.0, 8)
    );
    let shining = count(&films(&below, 32, 64), lit);
    vec![
        Row::below("energy of a white ball", 1.0 + 1e-3, found.map(|e| e.mean - 4.0 * e.error)),
        Row::never("pixels lit from below", 1024, shining),
    ]
}

twins! {
    /// Values of the noise in 64 cells of 0 ..= 1 around points of a box of side 60 at `offset`, and how many are
    /// not finite.
    fn noise_counts(offset: f64, n: u32) -> (Vec<f64>, u64) {
        let bench = Bench::new();
        let mut kernel = open(&bench);
        let mut stream = Stream::new(149, offset as u64);
        let mut cells = vec![0.0; 64];
        let mut bad = 0;
        for _ in 0..n {
            let p = DVec3::new(stream.unit(), stream.unit(), stream.unit()) * 60.0 + offset;
            let x = f64::from(kernel.fbm_value(v3(p), 16, 7));
            bad += u64::from(!x.is_finite());
            cells[index(x, 64)] += 1.0;
        }
        (cells, bad)
    }
}

fn far_noise() -> Vec<Row> {
    let n = 200_000;
    let near = both!(noise_counts(0.0, 2_000_000));
    let far = both!(noise_counts(1e6, 200_000));
    let chance = [0, 1].map(|i| {
        let mut counts = Counts::default();
        for (found, expected) in far[i].0.iter().zip(&near[i].0) {
            counts.push(*found, expected * 0.1);
        }
        counts.p_value()
    });
    let [a, b] = chance.map(super::number);
    vec![
        Row::never("values that are not finite", n, [far[0].1, far[1].1]),
        Row {
            expected: "p > 1e-3".into(),
            double: b,
            ..Row::fact(
                "values at 1e6 are spread as at 0",
                "",
                &a,
                chance.iter().all(|p| *p > 1e-3),
            )
        },
    ]
}

twins! {
    /// Mean over a diffuse field of what a coat over a base of `color` reflects.
    fn coat_energy(color: f64, n: u32) -> f64 {
        let lobe = Lobe { color: color as f32, ..Lobe::clearcoat(0.0) };
        let bench = lobe.bench();
        let mut kernel = open(&bench);
        let s = scatter(&lobe);
        let mut stream = Stream::new(151, 0);
        let mut sum = 0.0;
        for i in 0..n {
            // Even in the square of the cosine: the measure of a diffuse field.
            let mu = ((f64::from(i) + 0.5) / f64::from(n)).sqrt();
            let wo = v3(lobe.at_cosine(mu));
            let u = stream.pair24();
            let out = kernel.clearcoat_sample(s, wo, V2::new(u.x as Real, u.y as Real), stream.unit24() as Real, stream.unit24() as Real);
            sum += f64::from(out.weight.x);
        }
        sum / f64::from(n)
    }
}

fn coats() -> Vec<Row> {
    vec![
        Row::near("over black", 0.0918, 1e-3, both!(coat_energy(0.0, 1_000_000))),
        Row::below("over white", 1.0 + 1e-3, both!(coat_energy(1.0, 1_000_000))),
    ]
}

twins! {
    /// Largest error of the place in an image of 16384 columns, in texels.
    fn lat_long_error(n: u32) -> f64 {
        let bench = Bench::new();
        let mut kernel = open(&bench);
        let mut stream = Stream::new(157, 0);
        let mut worst = 0.0_f64;
        for _ in 0..n {
            let d = stream.direction().as_vec3().as_dvec3();
            let place = kernel.lat_long_place(v3(d), 0.0);
            let back = kernel.lat_long_direction(place.x, v3(d).y, 0.0);
            // Both ways through the kernel's own functions: the angle between, in columns.
            let angle = wide(back).cross(d).length().asin();
            worst = worst.max(angle / std::f64::consts::TAU * 16384.0);
        }
        worst
    }
}

/// Radiance of a square whose texture coordinates are all `(u, 0.5)`.
fn texel(width: u32, height: u32, u: &str) -> [f64; 2] {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let at = |x: u32| u8::try_from(x).expect("small");
    let image = image::RgbImage::from_fn(width, height, |x, y| {
        image::Rgb([at(x * 50 + 20), at(y * 40 + 10), 99])
    });
    image.save(dir.path().join("t.png")).expect("writable");
    let mut obj = String::from("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n");
    let _ = writeln!(obj, "vt {u} 0.5\nf 1/1 2/1 3/1\nf 1/1 3/1 4/1");
    std::fs::write(dir.path().join("q.obj"), obj).expect("writable");
    let text = format!(
        "rts 1
texture t = image(\"t.png\", space: linear)
asset q = obj(\"q.obj\", unit: m, up: +y)
material m: emissive {{ color = t.rgb }}
instance i {{ shape = q, material = m }}\n{}",
        view([0.0, 0.3, 5.0], [0.0; 3], 1)
    );
    let bytes = scene::bytes(&scene::compile_in(dir.path(), &text));
    [0, 1].map(|i| channel(&films_of(&bytes, sized(4, 1))[i], 0)[0])
}

fn textures() -> Vec<Row> {
    // Red of column x is (50 x + 20) / 255; between the last and the first column at whole numbers.
    let red = |x: f64| (50.0 * x + 20.0) / 255.0;
    let seam = f64::midpoint(red(0.0), red(2.0));
    let mut rows = vec![Row::near("1x1, u = 1e9", red(0.0), 1e-7, texel(1, 1, "1000000000"))];
    for (u, expected) in
        [("-0.0", seam), ("1.0", seam), ("1000000000", seam), ("0.5", red(1.0)), ("-3.5", red(1.0))]
    {
        rows.push(Row::near(format!("3x5, u = {u}"), expected, 1e-7, texel(3, 5, u)));
    }
    rows.push(Row::below(
        "direction through a sky of 16384 columns, in columns, half a texel",
        0.5,
        both!(lat_long_error(200_000)),
    ));
    rows
}

fn alpha() -> Vec<Row> {
    let scene = |alpha: &str| {
        format!(
            "{WHITE_SKY}material black: principled {{ color = linear(0), specular = 0, alpha = {alpha}, alpha.clip = 50% }}
instance card {{ shape = rectangle(size: (2, 2)m), material = black }}\n{}",
            view([0.0, 5.0, 0.1], [0.0; 3], 1)
        )
    };
    let mut rows = Vec::new();
    for (alpha, radiance, side) in
        [("0", 1.0, "invisible"), ("1", 0.0, "opaque"), ("0.5", 0.0, "there")]
    {
        let found = means(&scene(alpha), 8, 4).map(|e| e.mean);
        rows.push(Row::near(
            format!("alpha {alpha} from the camera: {side}"),
            radiance,
            0.0,
            found,
        ));
    }
    for (value, truth) in [(0_u8, 0.25), (255, 0.0)] {
        rows.push(shadow(value, truth));
    }
    rows
}

/// Radiance of a floor under a light and a card with an alpha texture of one value.
fn shadow(value: u8, truth: f64) -> Row {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba([255, 255, 255, value]));
    image.save(dir.path().join("a.png")).expect("writable");
    let text = format!(
        "texture a = image(\"a.png\", space: data)
material card: principled {{ color = linear(0), specular = 0, alpha = a.a, alpha.clip = 50% }}
material white: diffuse {{ color = linear(1) }}
instance floor {{ shape = rectangle(size: (4, 4)m), material = white }}
instance cover {{ shape = rectangle(size: (4, 4)m), material = card, at = (0, 1, 0)m }}
light sun: sphere {{ center = (0, 4, 0)m, radius = 2m }}\n{}",
        view([-3.0, 0.5, 0.0], [0.0; 3], 2)
    );
    let (compiled, said) = diagnose(dir.path(), &text);
    let Some(compiled) = compiled else { return Row::fact("shadow", "a pack", &said, false) };
    let found = estimates(&films_of(&scene::bytes(&compiled), sized(16, 64)));
    Row::mean(format!("light below a card with alpha {value} / 255"), truth, 1e-6, found)
}
