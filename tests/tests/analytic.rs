//! Scenes whose radiance is known in closed form.
//!
//! Accepted when the mean is within four standard errors of the value and the standard error is
//! below 0.3 % of it. Every pixel looks at the same point (a field of view of a thousandth of a
//! degree), so pixels are independent estimates of one number: each has its own scrambles of Sobol's
//! points, and the spread of pixels says how good their mean is. Fixed seeds: a run that passes
//! always passes.

#[path = "analytic/coverage.rs"]
mod coverage;
#[path = "analytic/links.rs"]
mod links;
#[path = "analytic/media.rs"]
mod media;
#[path = "analytic/power.rs"]
mod power;
#[path = "analytic/unlimited.rs"]
mod unlimited;

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI};
use std::fmt::Write as _;
use std::path::PathBuf;

use glam::DVec3;
use pack::Pack;
use pack::abi::material_flag;
use tests::console;
use tests::picture::{self, Estimate, channel};
use tests::scene;

/// A scene, what it must give, and how many pixels and samples it takes to say so.
struct Check {
    name: String,
    text: String,
    expected: f64,
    side: u32,
    samples: u32,
    /// Relative error that rounding alone may make.
    rounding: f64,
    /// As `Frame::estimator`.
    estimator: u32,
    /// Where the files of the scene are.
    dir: PathBuf,
}

impl Check {
    fn new(name: impl Into<String>, expected: f64, text: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            text: text.into(),
            expected,
            side: 16,
            samples: 256,
            rounding: 2e-6,
            estimator: 0,
            dir: PathBuf::new(),
        }
    }

    fn samples(self, samples: u32) -> Self {
        Self { samples, ..self }
    }

    /// Positions are rounded, and `exp` magnifies that by the optical depth.
    fn depth(self, depth: f64) -> Self {
        Self { rounding: 2e-6 + 5e-6 * depth, ..self }
    }

    fn run(&self) -> Result<(), String> {
        let compiled = scene::compile_in(&self.dir, &self.text);
        self.judge(Pack::from_bytes(scene::bytes(&compiled)).expect("valid"))
    }

    fn judge(&self, pack: Pack<pack::Checked>) -> Result<(), String> {
        let outcome = picture::cpu(pack, |job| {
            job.resize([self.side, self.side]);
            job.estimator = self.estimator;
            job.samples = runtime::SampleRange { start: 0, end: self.samples };
        });
        let found = Estimate::of(&channel(outcome.film(), 1));
        let (name, expected) = (&self.name, self.expected);
        let near =
            (found.mean - expected).abs() <= 4.0 * found.error + self.rounding * expected.abs();
        let sharp = found.error <= 0.003 * expected;
        let verdict = if near && sharp { "ok" } else { "FAILED" };
        let line = format!(
            "{name:<44} expected {expected:.7} mean {:.7} +- {:.7} z {:+.2} {verdict}",
            found.mean,
            found.error,
            found.z(expected),
        );
        console::line(&line);
        if near && sharp { Ok(()) } else { Err(line) }
    }
}

fn all(checks: &[Check]) {
    let failures: Vec<String> = checks.iter().filter_map(|check| check.run().err()).collect();
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

/// A camera that sees one point.
fn view(from: [f64; 3], to: [f64; 3], depth: u32) -> String {
    let [from, to] = [from, to].map(|p| format!("({}, {}, {})m", p[0], p[1], p[2]));
    format!(
        "camera eye: perspective {{
  from = {from}
  to = {to}
  up = (0.1, 0.2, 1)
  fov.vertical = 0.001deg
}}
film f {{ size = (16, 16)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = {depth}, seed = 11 }}
"
    )
}

/// No larger than it must be: a scattered ray starts above its surface by a millionth of the largest
/// coordinate, and so sees a lamp near a vast floor too large. With 200 m and a lamp at 25 cm Sobol's
/// samples show it, at 6e-5 of the mean.
const WHITE_FLOOR: &str = "rts 1
material white: diffuse { color = linear(1) }
instance floor { shape = rectangle(size: (4, 4)m), material = white }
";

#[test]
fn a_sphere_light_over_a_plane_gives_its_form_factor() {
    // theta between normal and centre, sine s of the half angle; the last four are cut by the
    // horizon (numerical integration of the visible cap).
    let cases = [
        (0.0_f64, 0.1, None),
        (0.9, 0.05, None),
        (0.3, 0.7, None),
        (FRAC_PI_2, 0.5, Some(0.028_834_4)),
        (1.8, 0.5, Some(0.007_545_0)),
        (1.5, 0.5, Some(0.038_366_3)),
        (1.4, 0.9, Some(0.304_028_9)),
    ];
    let checks: Vec<Check> = cases
        .into_iter()
        .map(|(theta, s, cut)| {
            let distance = 4.0;
            let centre = [distance * theta.sin(), distance * theta.cos(), 0.0];
            let text = format!(
                "{WHITE_FLOOR}light sun: sphere {{
  center = ({:.12}, {:.12}, 0)m
  radius = {:.12}m
}}
{}",
                centre[0],
                centre[1],
                s * distance,
                view([-3.0, 0.5, 0.0], [0.0; 3], 2),
            );
            let expected = cut.unwrap_or(s * s * theta.cos());
            let samples = if theta >= 1.4 { 4096 } else { 256 };
            Check::new(format!("sphere light, theta {theta}, s {s}"), expected, text)
                .samples(samples)
        })
        .collect();
    all(&checks);
}

#[test]
fn a_small_sun_gives_pi_l_sine_squared() {
    // Half angles in radians; strength makes the answer 1, whatever the size.
    let checks: Vec<Check> = [1e-2, 4.65e-3, 1e-4, 1e-6]
        .into_iter()
        .map(|t: f64| {
            let distance = 1000.0;
            let sine = t.sin();
            let text = format!(
                "{WHITE_FLOOR}light sun: sphere {{
  center = (0, {distance}, 0)m
  radius = {:e}m
  strength = {:e}
}}
{}",
                sine * distance,
                1.0 / (sine * sine),
                view([-3.0, 0.5, 0.0], [0.0; 3], 2),
            );
            Check::new(format!("sun of half angle {t:e} rad"), 1.0, text)
        })
        .collect();
    all(&checks);
}

/// Radiance of a white floor under irradiance E: E / pi. A watt of white light is 683 lumens.
fn lit_floor(name: &str, expected: f64, light: &str) -> Check {
    let text = format!("{WHITE_FLOOR}{light}\n{}", view([-3.0, 0.5, 0.0], [0.0; 3], 2));
    Check::new(name, expected, text)
}

#[test]
fn spot_lights_give_what_their_units_say() {
    let check = lit_floor;
    all(&[
        // All of the beam, in its middle and at its edge, where the light is half of that.
        check(
            "spot, candelas",
            1.0 / (4.0 * PI),
            "light l: spot { at = (0, 2, 0)m, intensity = 683cd, cone = 30deg }",
        ),
        check(
            "spot, lumens",
            // 2 pi (1 - cos 60deg), and half of what lies between that and 90deg.
            1.0 / (2.0 * PI * 0.75) / (4.0 * PI),
            "light l: spot { at = (0, 2, 0)m, power = 683lm, cone = 90deg, edge = 30deg }",
        ),
        check(
            "spot, at its edge",
            0.5 / (8.0 * PI) / 2.0_f64.sqrt(),
            &format!(
                "light l: spot {{ at = (2, 2, 0)m, cone = {:.10}deg, edge = {:.10}deg, intensity = 1W/sr, radius = 1mm }}",
                (FRAC_1_SQRT_2 - 0.1).acos().to_degrees(),
                ((FRAC_1_SQRT_2 - 0.1).acos() - (FRAC_1_SQRT_2 + 0.1).acos()).to_degrees(),
            ),
        ),
        check(
            "spot that faces away",
            0.0,
            "light l: spot { at = (0, 2, 0)m, direction = (0, 1, 0), intensity = 1W/sr }",
        ),
    ]);
}

#[test]
fn declared_lights_give_what_their_units_say() {
    let form = 0.554_126_424;
    let panel = "at = (0, 1, 0)m, size = (2, 2)m";
    let check = lit_floor;
    all(&[
        // I / d^2.
        check(
            "point, candelas",
            1.0 / (4.0 * PI),
            "light l: point { at = (0, 2, 0)m, intensity = 683cd }",
        ),
        check(
            "point, W/sr",
            3.0 / (4.0 * PI),
            "light l: point { at = (0, 2, 0)m, intensity = 3W/sr }",
        ),
        // 4 pi I is the power of a sphere.
        check(
            "point, lumens",
            5.0 / (4.0 * PI * 4.0 * PI),
            "light l: point { at = (0, 2, 0)m, power = 3415lm, radius = 3cm }",
        ),
        check(
            "sphere, watts",
            5.0 / (4.0 * PI * 4.0 * PI),
            "light l: sphere { center = (0, 2, 0)m, radius = 5cm, power = 5W }",
        ),
        // pi A L is the power of one side.
        check(
            "rectangle, watts",
            form,
            &format!("light l: rectangle {{ {panel}, power = {:.12}W }}", 4.0 * PI),
        ),
        check(
            "rectangle, both sides",
            form,
            &format!("light l: rectangle {{ {panel}, sides = both, power = {:.12}W }}", 8.0 * PI),
        ),
        check(
            "rectangle, nits",
            2.0 * form,
            &format!("light l: rectangle {{ {panel}, strength = 1366nit }}"),
        ),
        check(
            "rectangle that is turned",
            form,
            &format!(
                "light l: rectangle {{ {panel}, to = (0, 0, 0)m, spin = 90deg, strength = 1W/m2/sr }}"
            ),
        ),
        check(
            "rectangle that faces away",
            0.0,
            &format!("light l: rectangle {{ {panel}, direction = (0, 1, 0) }}"),
        ),
    ]);
}

#[test]
fn disk_lights_give_what_their_units_say() {
    // A disk of radiance L and radius r at a distance d above: pi L r^2 / (r^2 + d^2), and pi^2 r^2 L is its power.
    let dish = "at = (0, 1, 0)m, radius = 50cm";
    let form = 0.25 / 1.25;
    all(&[
        lit_floor("disk, radiance", form, &format!("light l: disk {{ {dish} }}")),
        lit_floor(
            "disk, watts",
            form,
            &format!("light l: disk {{ {dish}, power = {:.12}W }}", 0.25 * PI * PI),
        ),
        lit_floor(
            "disk, both sides",
            form,
            &format!("light l: disk {{ {dish}, sides = both, power = {:.12}W }}", 0.5 * PI * PI),
        ),
        lit_floor(
            "disk that faces away",
            0.0,
            &format!("light l: disk {{ {dish}, direction = (0, 1, 0) }}"),
        ),
    ]);
}

/// A luminaire file with these horizontal angles and candelas, each for vertical angles of 0, 90 and 180 degrees.
fn ies(horizontal: &str, candelas: &[[f64; 3]]) -> String {
    let n = candelas.len();
    let values: Vec<String> = candelas.concat().iter().map(f64::to_string).collect();
    let values = values.join("\n");
    format!(
        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 {n} 1 2 0 0 0\n1 1 9\n0 90 180\n{horizontal}\n{values}\n"
    )
}

#[test]
fn luminaires_shine_as_their_files_say() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let check = |name: &str, expected: f64, file: &str, light: &str| {
        std::fs::write(dir.path().join(format!("{name}.ies")), file).expect("written");
        let texture = format!("texture t = image(\"{name}.ies\", space: linear)\n");
        let light = format!("{texture}light l: point {{ profile = t, {light} }}");
        let check = lit_floor(name, expected, &light);
        // Between the angles of the image, half a degree, and in half floats.
        Check { dir: dir.path().to_owned(), rounding: 1e-3, ..check }
    };
    let even = ies("0", &[[683.0; 3]]);
    let falling = ies("0", &[[683.0, 0.0, 0.0]]);
    let mut checks = vec![
        // I / d^2, over pi.
        check("even", 1.0 / (4.0 * PI), &even, "at = (0, 2, 0)m"),
        check("green", 1.0 / (4.0 * PI), &even, "at = (0, 2, 0)m, color = linear(0.3, 1, 0.2)"),
        check("dimmed", 0.25 / (4.0 * PI), &even, "at = (0, 2, 0)m, profile.scale = 0.25"),
        check(
            "below it, 30 degrees off the beam",
            2.0 / 3.0 / (4.0 * PI),
            &falling,
            "at = (0, 2, 0)m, direction = (0.5, -0.8660254, 0)",
        ),
        check("behind it", 0.0, &falling, "at = (0, 2, 0)m, to = (0, 3, 0)m"),
    ];
    // Green is what is seen, and what the file's candelas are, by the colour's luminance.
    checks[1].expected /= 0.2126 * 0.3 + 0.7152 + 0.0722 * 0.2;
    // Around the beam: counter-clockwise from above, from +x.
    let around = ies("0 90 180 270 360", &[[683.0; 3], [341.5; 3], [0.0; 3], [0.0; 3], [683.0; 3]]);
    for (angle, spin, share) in [
        (45.0, 0.0, 0.75),
        (135.0, 0.0, 0.25),
        (225.0, 0.0, 0.0),
        (315.0, 0.0, 0.5),
        (45.0, 90.0, 0.25),
    ] {
        let (sine, cosine) = f64::to_radians(angle).sin_cos();
        let light = format!("at = ({}, 2, {})m, spin = {spin}deg", -2.0 * cosine, 2.0 * sine);
        let expected = share * FRAC_1_SQRT_2 / 8.0 / PI;
        let name = format!("{angle} degrees around, turned by {spin}");
        checks.push(check(&name, expected, &around, &light));
    }
    // The same for beams that are not vertical, whose first column is level.
    for (i, direction) in
        [[0.6, -0.8, 0.0], [0.0, -0.6, 0.8], [-0.48, -0.64, -0.6]].into_iter().enumerate()
    {
        let at = DVec3::new(0.7, 2.0, -0.4);
        let beam = DVec3::from(direction);
        let first = DVec3::new(-beam.z, 0.0, beam.x).normalize();
        let to = -at;
        // Counter-clockwise from behind.
        let turns = to.dot(first.cross(beam)).atan2(to.dot(first)) / (2.0 * PI);
        let share = match 4.0 * turns.rem_euclid(1.0) {
            x @ 0.0..2.0 => 1.0 - 0.5 * x,
            x => (x - 3.0).max(0.0),
        };
        let [x, y, z] = direction;
        let light = format!("at = (0.7, 2, -0.4)m, direction = ({x}, {y}, {z})");
        let expected = share * at.y / at.length().powi(3) / PI;
        checks.push(check(&format!("beam {i}"), expected, &around, &light));
    }
    all(&checks);
}

/// The camera looks past lights that are not visible; mirrors, and what they light, do not.
#[test]
fn lights_that_are_not_visible_are_there_for_all_but_the_camera() {
    let lamps = [
        "light l: rectangle { at = (0, 3, 0)m, size = (2, 2)m, strength = 3, sides = both, visible = off }",
        "light l: disk { at = (0, 3, 0)m, radius = 1m, strength = 3, sides = both, visible = off }",
        "light l: sphere { center = (0, 3, 0)m, radius = 1m, strength = 3, visible = off }",
        "light l: point { at = (0, 3, 0)m, radius = 1m, power = 3W, visible = off }",
        "light l: spot { at = (0, 3, 0)m, radius = 1m, power = 3W, visible = off }",
    ];
    let sky = "sky s: constant { color = linear(0.25) }";
    let mut checks = Vec::new();
    for lamp in lamps {
        // From below, past a surface that is not there.
        let text = format!("rts 1\n{lamp}\n{sky}\n{}", view([0.0; 3], [0.0, 3.0, 0.0], 2));
        checks.push(Check::new(format!("past {lamp}"), 0.25, text));
    }
    for lamp in &lamps[..3] {
        let mirror = "material m: metal { color = linear(1) }
instance floor { shape = rectangle(size: (4, 4)m), material = m }";
        let text =
            format!("rts 1\n{mirror}\n{lamp}\n{sky}\n{}", view([-0.1, 1.0, 0.0], [0.0; 3], 3));
        checks.push(Check::new(format!("{lamp} in a mirror"), 3.0, text));
    }
    let panel = "light l: rectangle { at = (0, 1, 0)m, size = (2, 2)m, visible = off }";
    checks.push(lit_floor("a floor under a lamp that is not visible", 0.554_126_424, panel));
    all(&checks);
}

/// The same at infinity, where the camera looks into the dark.
#[test]
fn skies_and_suns_that_are_not_visible_are_there_for_all_but_the_camera() {
    let sun = "light l: directional { direction = (0, 1, 0), angular_diameter = 20deg, strength = 3, visible = off }";
    let sky = "sky s: constant { color = linear(0.25), visible = off }";
    let gradient =
        "sky s: gradient { sun.direction = (0, 1, 0), disc.color = linear(20), visible = off }";
    let image = "sky s: sun_sky { sun.direction = (0, 1, 0), strength = 0.02, visible = off }";
    let mirror = "material m: metal { color = linear(1) }
instance floor { shape = rectangle(size: (4, 4)m), material = m }";
    let mut checks = Vec::new();
    for far in [sun, sky, gradient, image] {
        let up = format!("rts 1\n{far}\n{}", view([0.0, 1.0, 0.0], [0.0, 3.0, 0.0], 2));
        checks.push(Check::new(format!("past {far}"), 0.0, up));
        let up = format!("rts 1\n{far}\n{mirror}\n{}", view([0.0, 1.0, 0.0], [0.0, 3.0, 0.0], 2));
        checks.push(Check::new(format!("past {far}, with a surface"), 0.0, up));
    }
    for (far, radiance) in [(sun, 3.0), (sky, 0.25)] {
        let text = format!("rts 1\n{mirror}\n{far}\n{}", view([-0.1, 1.0, 0.0], [0.0; 3], 3));
        checks.push(Check::new(format!("{far} in a mirror"), radiance, text));
    }
    // One of two that lie behind each other is seen.
    let behind = "sky s: constant { color = linear(0.25) }";
    let text =
        format!("rts 1\n{sun}\n{behind}\n{mirror}\n{}", view([0.0, 1.0, 0.0], [0.0, 3.0, 0.0], 2));
    checks.push(Check::new("a sky behind a sun that is not visible".to_owned(), 0.25, text));
    checks.push(lit_floor("a floor under a sky that is not visible", 0.25, sky));
    let unseen = sun_of(60.0, 0.53, ", visible = off");
    let name = "a floor under a sun that is not visible";
    checks.push(lit_floor(name, 0.5, &unseen).samples(4096));
    all(&checks);
}

/// A directional light of 683 pi lux, `tilt` degrees off the zenith, `diameter` degrees wide.
fn sun(tilt: f64, diameter: f64) -> String {
    sun_of(tilt, diameter, "")
}

/// The same, with more fields.
fn sun_of(tilt: f64, diameter: f64, fields: &str) -> String {
    let (sine, cosine) = tilt.to_radians().sin_cos();
    format!(
        "light sun: directional {{ direction = ({sine:.12}, {cosine:.12}, 0), illuminance = {:.12}lx, angular_diameter = {diameter}deg{fields} }}",
        683.0 * PI
    )
}

#[test]
fn directional_lights_give_their_illuminance_times_the_cosine() {
    let tilts = [(0.0, 0.53), (60.0, 0.53), (60.0, 0.01), (89.0, 0.1), (45.0, 40.0), (0.0, 90.0)];
    let mut checks: Vec<Check> = tilts
        .into_iter()
        .map(|(tilt, diameter): (f64, f64)| {
            let name = format!("sun, {diameter} deg wide, {tilt} deg off the zenith");
            // A scattered ray meets the sun once in 93,000 samples; a mean without any is 1e-5 too low.
            lit_floor(&name, tilt.to_radians().cos(), &sun(tilt, diameter)).samples(4096)
        })
        .collect();
    // Half of the disc is below the horizon: sin(elevation) over a half disc, 2/3 s^3 for small ones.
    let radius = 5.0_f64.to_radians();
    let cut = (radius - radius.sin() * radius.cos()) / radius.sin().powi(2) / PI;
    checks.push(lit_floor("sun that sets", cut, &sun(90.0, 10.0)).samples(1024));
    checks.push(lit_floor("sun below the ground", 0.0, &sun(120.0, 10.0)));
    // The choice of one light: by the table, and beside a tree and a sky.
    let second = sun(60.0, 1.0).replace("sun:", "moon:");
    let two = format!("{}\n{second}", sun(0.0, 20.0));
    checks.push(lit_floor("two suns", 1.5, &two).samples(1024));
    let lamps = "light a: point { at = (1, 2, 0)m, intensity = 683cd }
light b: point { at = (-1, 2, 0)m, intensity = 683cd }
light c: point { at = (0, 2, 1)m, intensity = 683cd }\n";
    let lamp = (1.0 / PI) * 2.0 / 5.0_f64.powf(1.5);
    let all_of_them = format!("{two}\n{lamps}sky s: constant {{ color = linear(0.5) }}");
    checks.push(lit_floor("suns, lamps and a sky", 2.0 + 3.0 * lamp, &all_of_them).samples(4096));
    all(&checks);
}

/// Paths find the disc by scattering, too: on a rough mirror neither way does it alone.
#[test]
fn directional_lights_are_the_same_by_either_way_of_finding_them() {
    let lit = |light: &str| {
        format!(
            "rts 1
material m: conductor {{ color = linear(0.9), roughness = 0.2 }}
instance floor {{ shape = rectangle(size: (4, 4)m), material = m }}
{light}
{}",
            view([-3.0, 3.0, 0.0], [0.0; 3], 2)
        )
    };
    let means: Vec<f64> = [
        // Nothing but the cone, once as a light and once as a ball that fills it.
        sun(45.0, 30.0),
        format!(
            "light sun: sphere {{ direction = (1, 1, 0), distance = 1000m, angular_radius = 15deg, strength = {:.12} }}",
            1.0 / 15.0_f64.to_radians().sin().powi(2)
        ),
    ]
    .iter()
    .map(|light| {
        let outcome = picture::cpu(scene::pack(&lit(light)), |job| {
            job.resize([16, 16]);
            job.samples = runtime::SampleRange { start: 0, end: 4096 };
        });
        Estimate::of(&channel(outcome.film(), 1)).mean
    })
    .collect();
    assert!((means[0] / means[1] - 1.0).abs() < 3e-3, "{means:?}");
}

#[test]
fn the_camera_sees_the_disc_of_a_directional_light() {
    let seen = |name: &str, to: [f64; 3], expected: f64| {
        let light = "light sun: directional { direction = (0, 1, 0), angular_diameter = 2deg, strength = 3 }";
        let eye = view([0.0, 1.0, 0.0], to, 2);
        Check::new(name, expected, format!("{WHITE_FLOOR}{light}\n{eye}"))
    };
    let (inside, outside) = (0.95_f64.to_radians().tan(), 1.05_f64.to_radians().tan());
    all(&[
        seen("disc, its middle", [0.0, 2.0, 1e-9], 3.0),
        seen("disc, its rim", [inside, 2.0, 0.0], 3.0),
        seen("disc, beside it", [0.0, 2.0, outside], 0.0),
    ]);
}

#[test]
fn a_rectangle_light_gives_its_form_factor() {
    let lamp = |height: f64, strength: f64| {
        format!(
            "{WHITE_FLOOR}material lamp: emissive {{ color = linear(1), strength = {strength}, sides = front }}
instance panel {{
  shape = rectangle(size: (2, 2)m)
  material = lamp
  rotate = (180, 0, 0)deg
  at = (0, {height}, 0)m
}}
{}",
            view([-3.0, 0.5, 0.0], [0.0; 3], 2),
        )
    };
    // A square of half side a at height h over its centre: 4 times the corner formula.
    let form = |a: f64, h: f64| {
        let x = a / h;
        let root = (1.0 + x * x).sqrt();
        4.0 / (2.0 * PI) * 2.0 * (x / root) * (x / root).atan()
    };
    assert!((form(1.0, 1.0) - 0.554_126_424).abs() < 1e-8);
    all(&[
        Check::new("rectangle 2x2 at height 1", 0.554_126_424, lamp(1.0, 1.0)),
        Check::new("rectangle 2x2 at height 0.25", form(1.0, 0.25), lamp(0.25, 1.0)).samples(1024),
        Check::new("rectangle 2x2 at height 20", 3.0 * form(1.0, 20.0), lamp(20.0, 3.0)),
    ]);
}

#[test]
fn glass_panes_transmit_and_reflect_as_the_series_says() {
    // A pane n at normal incidence: T = (1 - F) / (1 + F); N panes: (1 - F) / (1 + (2N - 1) F).
    let scene = |ior: f64, n: u32, emitter_z: f64| {
        let mut text = format!(
            "rts 1
material glass: dielectric {{ ior = {ior} }}
material lamp: emissive {{ color = linear(1), strength = 1 }}
instance wall {{
  shape = rectangle(size: (40, 40)m)
  material = lamp
  rotate = (90, 0, 0)deg
  at = (0, 0, {emitter_z})m
}}
"
        );
        for i in 0..n {
            let _ = writeln!(
                text,
                "instance pane_{i} {{ shape = box(size: (40, 40, 0.1)m), material = glass, at = (0, 0, {})m }}",
                -0.5 * f64::from(i),
            );
        }
        text + &view([0.0, 0.0, 5.0], [0.0; 3], 1000)
            .replace("up = (0.1, 0.2, 1)", "up = (0, 1, 0)")
    };
    let f = |n: f64| ((n - 1.0) / (n + 1.0)) * ((n - 1.0) / (n + 1.0));
    let through = |n: f64, panes: f64| (1.0 - f(n)) / (1.0 + (2.0 * panes - 1.0) * f(n));
    all(&[
        Check::new("pane 1.5, transmitted", through(1.5, 1.0), scene(1.5, 1, -20.0)),
        Check::new("pane 1.5, reflected", 1.0 - through(1.5, 1.0), scene(1.5, 1, 20.0))
            .samples(16_384),
        Check::new("pane 2.4, transmitted", through(2.4, 1.0), scene(2.4, 1, -20.0)).samples(1024),
        Check::new("ten panes 1.5, transmitted", through(1.5, 10.0), scene(1.5, 10, -20.0))
            .samples(8192),
        Check::new("pane 1.0001, transmitted", through(1.0001, 1.0), scene(1.0001, 1, -20.0)),
    ]);
}

#[test]
fn what_loses_nothing_is_invisible_under_a_white_sky() {
    let scene = |material: &str, shape: &str| {
        format!(
            "rts 1
sky white: constant {{ color = linear(1) }}
material m: {material}
instance thing {{ shape = {shape}, material = m }}
camera eye: perspective {{ from = (0, 1, 6)m, to = (0, 0, 0)m, fov.vertical = 15deg }}
film f {{ size = (16, 16)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 512, seed = 3 }}
"
        )
    };
    let ball = "sphere(radius: 1m)";
    let cube = "box(size: (1.5, 1.5, 1.5)m)";
    all(&[
        Check::new(
            "furnace: white diffuse sphere",
            1.0,
            scene("diffuse { color = linear(1) }", ball),
        ),
        Check::new("furnace: white diffuse box", 1.0, scene("diffuse { color = linear(1) }", cube)),
        Check::new("furnace: mirror", 1.0, scene("metal { color = linear(1) }", ball)),
        Check::new("furnace: glass sphere", 1.0, scene("dielectric { ior = 1.5 }", ball)),
        Check::new("furnace: glass box", 1.0, scene("dielectric { ior = 1.5 }", cube)),
        Check::new("furnace: ior 1", 1.0, scene("dielectric { ior = 1 }", ball)),
        Check::new("furnace: ior 1.000001", 1.0, scene("dielectric { ior = 1.000001 }", ball)),
        Check::new("furnace: ior 10", 1.0, scene("dielectric { ior = 10 }", ball)),
    ]);
}

#[test]
fn a_closed_sphere_gives_emission_over_one_minus_albedo() {
    let mut failures = Vec::new();
    for (rho, samples) in [(0.0, 64), (0.5, 1024), (0.9, 4096), (0.99, 2048)] {
        let text = format!(
            "rts 1
material wall: diffuse {{ color = linear({rho}) }}
material lamp: emissive {{ color = linear(1) }}
instance room {{ shape = sphere(radius: 1m), material = wall }}
instance spark {{ shape = sphere(radius: 1mm), material = lamp, at = (0, 5, 0)m }}
{}",
            view([0.2, 0.1, 0.0], [0.0, -1.0, 0.1], 1024),
        );
        let mut compiled = scene::compile(&text);
        // The language keeps scattering and emission apart in simple materials; the record does not.
        for material in &mut compiled.lowered.materials {
            if material.kind == pack::abi::MaterialKind::Diffuse as u32 {
                material.emission = [1.0; 3];
                material.flags |= material_flag::EMIT_BOTH_SIDES;
            }
        }
        let pack = Pack::from_bytes(scene::bytes(&compiled)).expect("valid");
        let name = format!("closed sphere, albedo {rho}");
        // The record holds the albedo in f32, and 1 / (1 - rho) magnifies its rounding.
        #[expect(clippy::cast_possible_truncation, reason = "as the compiler rounds it")]
        let expected = 1.0 / (1.0 - f64::from(rho as f32));
        let check = Check::new(name, expected, "").samples(samples);
        failures.extend(check.judge(pack).err());
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}
