//! Paths of any length: closed rooms, whose light is the sum of a series.

use super::{Check, all};
use tests::picture;
use tests::scene;

/// A ball of albedo `rho` and radius 1 m around a lamp of radiance 1 and radius `s`, seen from beside the lamp.
fn room(rho: f64, s: f64, depth: &str) -> String {
    format!(
        "rts 1
material wall: diffuse {{ color = linear({rho}) }}
instance room {{ shape = sphere(radius: 1m), material = wall }}
light lamp: sphere {{ center = (0, 0, 0)m, radius = {s}m }}
camera eye: perspective {{ from = (0.4, 0.3, 0)m, to = (0.7, 0.4, 0.5)m, fov.vertical = 0.001deg }}
film f {{ size = (16, 16)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = {depth}, seed = 11 }}
"
    )
}

/// The lamp fills the share s^2 of the cosine-weighted half-space of each point of the wall, so its irradiance is
/// pi s^2; of what the wall reflects the rest comes back to it, as often as it likes: a geometric series.
fn radiance(rho: f64, s: f64) -> f64 {
    let lamp = s * s;
    rho * lamp / (1.0 - rho * (1.0 - lamp))
}

#[test]
fn a_closed_room_holds_the_sum_of_all_reflections() {
    let check = |rho, s| {
        Check::new(
            format!("unlimited depth: albedo {rho}, lamp of {s}"),
            radiance(rho, s),
            room(rho, s, "unlimited"),
        )
    };
    // Of the last, 8 % of the paths are longer than any other may be.
    all(&[
        check(0.99, 0.1).samples(1024),
        check(0.999, 0.06).samples(2048),
        check(1.0, 0.05).samples(4096),
    ]);
}

/// Or the test above would see nothing.
#[test]
fn a_limit_of_the_depth_takes_light_away() {
    let outcome = picture::cpu(scene::pack(&room(0.99, 0.1, "12")), |job| {
        job.samples = runtime::SampleRange { start: 0, end: 256 };
    });
    let values = picture::channel(outcome.film(), 1);
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    // The first 11 terms of the series: 12 segments reflect light 11 times.
    let (rho, s): (f64, f64) = (0.99, 0.1);
    let expected = radiance(rho, s) * (1.0 - (rho * (1.0 - s * s)).powi(11));
    assert!((mean / expected - 1.0).abs() < 0.02, "{mean}, {expected} expected");
    assert!(mean < 0.25 * radiance(rho, s), "{mean}");
}

/// A mirror that loses nothing, without a way out: 1024 bounces that cannot end a path, then each does with 1 in 1024.
#[test]
fn paths_that_lose_nothing_end() {
    let text = "rts 1
material mirror: metal { color = linear(1), fuzz = 0 }
instance room { shape = sphere(radius: 1m), material = mirror }
light lamp: sphere { center = (0, 9, 0)m, radius = 1m }
camera eye: perspective { from = (0.4, 0.3, 0)m, to = (0.7, 0.4, 0.5)m }
film f { size = (32, 32)px }
render main: path { camera = eye, film = f, samples = 1, depth = unlimited, seed = 11 }
";
    let outcome = picture::cpu(scene::pack(text), |_| {});
    let film = outcome.film();
    let paths = film.total_samples() as f64;
    let mean = film.counters.rays as f64 / paths;
    // A segment to the first mirror, 1024 that are sure, and a geometric number of others.
    let expected = 1.0 + 1024.0 + 1023.0;
    let error = 1023.5 / paths.sqrt();
    assert!((mean - expected).abs() < 4.0 * error, "{mean}, {expected} expected");
    assert!(film.counters.depth > 2048, "{}", film.counters.depth);
    assert_eq!(film.counters.bad, 0);
}
