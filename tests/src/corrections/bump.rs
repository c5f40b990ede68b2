//! A bump from the difference of two different fields (the guide), and of one field (ours).

use glam::Vec3;

use super::field::fbm;
use super::{Place, Topic, row};
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// The guide's weave: the field whose value the bump is given, its step and its strength.
fn weave(p: Vec3) -> f32 {
    fbm(p * 15.0 + Vec3::new(0.7, 1.3, 0.3), 2)
}

const STEP: f32 = 0.010;
const STRENGTH: f32 = 0.02;

/// The normal tilted against the gradient of differences `value` - `field` one step back along each axis.
fn tilted(p: Vec3, n: Vec3, value: f32, field: fn(Vec3) -> f32) -> Vec3 {
    let back = |axis: Vec3| value - field(p - axis * STEP);
    let gradient = Vec3::new(back(Vec3::X), back(Vec3::Y), back(Vec3::Z));
    let flat = gradient - n * n.dot(gradient);
    (n - flat * (STRENGTH / STEP)).normalize()
}

/// What a bump does to a normal.
#[derive(Clone, Copy, Debug)]
pub struct Tilt {
    /// Mean angle to the exact bump's normal, in degrees.
    pub error: f64,
    /// Mean tilt, in degrees.
    pub tilt: f64,
}

/// The guide's bump and ours on a floor, against the gradient of the weave by central differences of double
/// the accuracy.
#[must_use]
pub fn measure(n: u64) -> [Tilt; 2] {
    let mut stream = Stream::new(199, 0);
    let normal = Vec3::Y;
    let mut sums = [[Mean::default(); 2]; 2];
    for _ in 0..n {
        let p = Vec3::from([0; 3].map(|_| 8.0 * stream.unit24()));
        let exact = exact(p, normal);
        let found =
            [tilted(p, normal, weave(p), |p| fbm(p, 4)), tilted(p, normal, weave(p), weave)];
        for (sum, found) in sums.iter_mut().zip(found) {
            sum[0].add(f64::from(found.angle_between(exact)).to_degrees());
            sum[1].add(f64::from(found.angle_between(normal)).to_degrees());
        }
    }
    sums.map(|[error, tilt]| Tilt { error: error.value(), tilt: tilt.value() })
}

/// The normal of the weave's gradient, by differences over a tenth of the step to both sides.
fn exact(p: Vec3, n: Vec3) -> Vec3 {
    let h = 0.1 * STEP;
    let slope = |axis: Vec3| (weave(p + axis * h) - weave(p - axis * h)) / (2.0 * h);
    let gradient = Vec3::new(slope(Vec3::X), slope(Vec3::Y), slope(Vec3::Z));
    (n - (gradient - n * n.dot(gradient)) * STRENGTH).normalize()
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let [guided, ours] = measure(100_000);
    let degrees = |x: f64| format!("{x:.2}°");
    Topic {
        title: "A bump is the slope of one field",
        section: "4.5.3, 5.2.3, 5.2.5",
        places: &[Place::Twin("tests/src/corrections/bump.rs")],
        rows: vec![
            row(
                "angle between the bumped normal and the exact one, fabric",
                degrees(guided.error),
                degrees(ours.error),
            ),
            row("mean tilt of the normal, fabric", degrees(guided.tilt), degrees(ours.tilt)),
        ],
        says: "The bump takes the value of the material's field (wood, fabric) at the point, and subtracts \
            from it a four-octave sum one step back along each axis."
            .into(),
        wrong: "Those are two fields, of different scales and offsets. Their difference is not small with the \
            step, and it is nearly the same along all three axes: divided by the step, it tilts the normal \
            by a large angle towards one fixed direction, with a sign that changes from patch to patch. The \
            texture that the section describes is not in it."
            .into(),
        right: "The same field at both points; then the tilt is the field's slope, up to the length of the \
            step."
            .into(),
    }
}
