//! What a pixel sees of a moving thing: its share of time.

use std::f64::consts::PI;

use glam::DVec3;
use tests::picture::Estimate;
use tests::scene;

use crate::{LAMP, front, judge, mean, mean_of, moving};

#[test]
fn a_moving_ball_covers_its_share_of_time() {
    // Across; towards the camera, sideways and up.
    let paths = [
        (0.5, DVec3::new(-2.0, 0.5, 0.0), DVec3::new(2.0, 0.5, 0.0)),
        (0.4, DVec3::new(-1.5, -0.5, -2.0), DVec3::new(1.0, 0.5, 2.0)),
    ];
    for (radius, from, to) in paths {
        let place = moving("at", from, to);
        let text = format!(
            "{LAMP}instance ball {{ shape = sphere(radius: {radius}m), material = lamp, {place} }}\n{}",
            front([48, 32], 5.0)
        );
        // A ball is seen as an ellipse of this area, in the plane at distance 1.
        let area = |c: DVec3| {
            let (z, d2) = (10.0 - c.z, c.x * c.x + c.y * c.y + (10.0 - c.z) * (10.0 - c.z));
            let r2: f64 = radius * radius;
            PI * r2 * (d2 - r2).sqrt() / (z * z - r2).powf(1.5)
        };
        let film = 0.5 * 0.75;
        let truth = mean_of(|t| area(from.lerp(to, t))) / film;
        // Pixels are not alike: the error is that of counting.
        let samples = 1024;
        let found = mean(&scene::bytes(&scene::compile(&text)), samples, 0);
        let error = (truth * (1.0 - truth) / (48.0 * 32.0 * f64::from(samples))).sqrt();
        judge("ball", Estimate { mean: found.mean, error }, truth, 0.01);
    }
}

#[test]
fn a_ball_that_comes_ten_thousand_times_its_size_covers_its_share_of_time() {
    let place = moving("at", DVec3::new(-5.0, 0.0, 0.0), DVec3::new(5.0, 0.0, 0.0));
    // A second ball, so that boxes matter.
    let text = format!(
        "{LAMP}instance ball {{ shape = sphere(radius: 0.5mm), material = lamp, {place} }}
instance wall {{ shape = box(size: (1, 1, 1)m), material = lamp, at = (0, 3, 0)m }}
instance other {{ shape = box(size: (1, 1, 1)m), material = lamp, at = (0, -3, 0)m }}
{}",
        front([1024, 1], 1e-3)
    );
    let samples = 4096;
    let found = mean(&scene::bytes(&scene::compile(&text)), samples, 0);
    // The film is as high as the ball: it passes each point for the length of a chord.
    let truth = PI * 0.25e-6 / (10.0 * 1e-3);
    let error = (truth / (1024.0 * f64::from(samples))).sqrt();
    judge("fast ball", Estimate { mean: found.mean, error }, truth, 0.06);
}

#[test]
fn a_moving_rectangle_covers_its_share_of_time() {
    // It comes into the picture from the left, turned over on the way into the world.
    let (from, to) = (DVec3::new(-6.0, 0.3, 0.0), DVec3::new(2.0, -0.7, 0.0));
    let place = moving("at", from, to);
    let text = format!(
        "{LAMP}instance card {{ shape = rectangle(size: (1.5, 1)m), material = lamp, rotate = (90, 0, 0)deg, {place} }}\n{}",
        front([48, 32], 5.0)
    );
    let inside = |x: f64| ((x + 0.75).min(3.75) - (x - 0.75).max(-3.75)).max(0.0);
    let truth = mean_of(|t| inside(from.lerp(to, t).x)) / (7.5 * 5.0);
    let samples = 1024;
    let found = mean(&scene::bytes(&scene::compile(&text)), samples, 0);
    let error = (truth * (1.0 - truth) / (48.0 * 32.0 * f64::from(samples))).sqrt();
    judge("card", Estimate { mean: found.mean, error }, truth, 0.01);
}
