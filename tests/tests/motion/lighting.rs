//! Light of moving lights, and on moving things.

use std::f64::consts::PI;

use glam::DVec3;
use pack::Pack;
use tests::picture::{self, channel};
use tests::scene;

use crate::{LAMP, front, judge, mean, mean_of, moving};

/// A white floor, and a camera that sees one point of it.
fn floor_view() -> String {
    "material white: diffuse { color = linear(1) }
instance floor { shape = rectangle(size: (200, 200)m), material = white }
camera eye: perspective {
  from = (-3, 0.5, 0)m
  to = (0, 0, 0)m
  up = (0.1, 0.2, 1)
  fov.vertical = 0.001deg
  shutter = -5ms..15ms
}
film f { size = (16, 16)px }
render main: path { camera = eye, film = f, samples = 16, depth = 2, seed = 11 }
"
    .to_owned()
}

/// Each estimator against the truth.
fn by_every_estimator(name: &str, bytes: &[u8], truth: f64, samples: u32) {
    for (how, estimator) in [("both", 0), ("light", 1), ("bsdf", 2)] {
        judge(&format!("{name}, {how}"), mean(bytes, samples, estimator), truth, 0.01);
    }
}

#[test]
fn a_moving_ball_lights_as_it_does_in_the_mean_over_time() {
    let (from, to) = (DVec3::new(-2.0, 2.0, 0.5), DVec3::new(3.0, 3.0, 0.0));
    let place = moving("center", from, to);
    let text = format!("{LAMP}light sun: sphere {{ radius = 1m, {place} }}\n{}", floor_view())
        .replace("material lamp: emissive { color = linear(1) }\n", "");
    // s^2 cos(theta) of a ball above the horizon.
    let truth = mean_of(|t| {
        let c = from.lerp(to, t);
        c.y / c.length().powi(3)
    });
    by_every_estimator("ball of light", &scene::bytes(&scene::compile(&text)), truth, 1024);
}

/// Form factor of a rectangle 2 x 1 m, parallel to the floor with its centre at `c`, from the origin.
fn form(c: DVec3) -> f64 {
    let corner = |x: f64, y: f64| {
        let (a, b) = (x.hypot(c.y), y.hypot(c.y));
        (x / a * (y / a).atan() + y / b * (x / b).atan()) / (2.0 * PI)
    };
    let (x0, x1, z0, z1) = (c.x - 1.0, c.x + 1.0, c.z - 0.5, c.z + 0.5);
    corner(x1, z1) - corner(x0, z1) - corner(x1, z0) + corner(x0, z0)
}

#[test]
fn moving_panels_light_as_they_do_in_the_mean_over_time() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let quad = "v -1 0 0.5\nv 1 0 0.5\nv 1 0 -0.5\nv -1 0 -0.5\nf 1 2 3 4\n";
    std::fs::write(dir.path().join("quad.obj"), quad).expect("a mesh can be written");
    let (from, to) = (DVec3::new(-2.0, 1.0, 0.3), DVec3::new(1.5, 1.6, -0.2));
    let place = moving("at", from, to);
    let truth = mean_of(|t| form(from.lerp(to, t)));
    for (name, head, shape) in [
        ("rectangle", "", "rectangle(size: (2, 1)m)"),
        ("mesh", "asset quad = obj(\"quad.obj\", unit: m, up: +y)\n", "quad"),
    ] {
        let text = format!(
            "{LAMP}{head}instance panel {{ shape = {shape}, material = lamp, rotate = (180, 0, 0)deg, {place} }}\n{}",
            floor_view()
        );
        let bytes = scene::bytes(&scene::compile_in(dir.path(), &text));
        by_every_estimator(name, &bytes, truth, 1024);
    }
}

#[test]
fn a_moving_white_thing_is_invisible_under_a_white_sky() {
    let place = moving("at", DVec3::new(-1.0, -0.5, 0.7), DVec3::new(1.0, 1.0, -0.4));
    for shape in ["sphere(radius: 1m)", "box(size: (1.5, 1.2, 1)m)", "sphere(radius: 1mm)"] {
        let text = format!(
            "rts 1\nsky white: constant {{ color = linear(1) }}
material m: diffuse {{ color = linear(1) }}
instance thing {{ shape = {shape}, material = m, rotate = (20, 30, 40)deg, {place} }}\n{}",
            front([32, 32], 5.0).replace("depth = 1", "depth = 512")
        );
        let pack = Pack::from_bytes(scene::bytes(&scene::compile(&text))).expect("valid");
        let outcome = picture::cpu(pack, |job| job.samples.end = 256);
        for value in channel(outcome.film(), 1) {
            assert!((value - 1.0).abs() < 1e-4, "{shape}: {value}");
        }
    }
}
