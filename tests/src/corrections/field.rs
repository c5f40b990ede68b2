//! A rough field of three octave sums: offsets added to results (the guide) or to points (ours).
//!
//! The noise is a value noise of [0, 1] with cubic blending on a hashed lattice; any such noise shows the
//! same.

use glam::{IVec3, Vec3};

use super::{Place, Topic, percent, row};
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// A number in [0, 1] for a lattice point.
fn lattice(p: IVec3) -> f32 {
    let mut h = (p.x as u32).wrapping_mul(0x8da6_b343)
        ^ (p.y as u32).wrapping_mul(0xd816_3841)
        ^ (p.z as u32).wrapping_mul(0xcb1a_b31f);
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    ((h ^ (h >> 16)) >> 8) as f32 / 16_777_215.0
}

/// Value noise in [0, 1].
#[must_use]
pub fn noise(p: Vec3) -> f32 {
    let cell = p.floor();
    let f = p - cell;
    let w = f * f * (3.0 - 2.0 * f);
    let at = |i: i32| {
        let corner = IVec3::new(i & 1, (i >> 1) & 1, i >> 2);
        let side = |w: f32, far: i32| if far == 1 { w } else { 1.0 - w };
        let weight = side(w.x, corner.x) * side(w.y, corner.y) * side(w.z, corner.z);
        weight * lattice(cell.as_ivec3() + corner)
    };
    (0..8).map(at).sum()
}

/// The mean of `octaves` octaves, each of twice the frequency and half the weight, in [0, 1].
#[must_use]
pub fn fbm(p: Vec3, octaves: i32) -> f32 {
    let weight = |i: i32| 0.5_f32.powi(i);
    let sum: f32 = (0..octaves).map(|i| weight(i) * noise(p * 2.0_f32.powi(i))).sum();
    sum / (0..octaves).map(weight).sum::<f32>()
}

/// Offsets of the second and third layer.
const OFFSETS: [f32; 2] = [1.7, 3.1];

fn weigh(layers: [f32; 3]) -> f32 {
    layers[0] * 0.5 + layers[1] * 0.3 + layers[2] * 0.2
}

/// The guide's stone, its vector offsets read as numbers: they are added to the octave sums.
#[must_use]
pub fn stone_guide(p: Vec3) -> f32 {
    let [fine, cracks] = OFFSETS;
    weigh([fbm(p * 3.0, 3), fbm(p * 11.0, 3) + fine, fbm(p * 25.0, 2) + cracks])
}

/// The same with the offsets added to the points.
#[must_use]
pub fn stone_ours(p: Vec3) -> f32 {
    let [fine, cracks] = OFFSETS.map(Vec3::splat);
    weigh([fbm(p * 3.0, 3), fbm(p * 11.0 + fine, 3), fbm(p * 25.0 + cracks, 2)])
}

/// What a field does.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Smallest and largest value.
    pub range: [f32; 2],
    /// Largest roughness, 0.4 to 0.75 over the field's 0 to 1.
    pub roughness: f32,
    /// Share of roughness above 1.
    pub beyond: Mean,
}

/// Samples a field in a box of side 8.
#[must_use]
pub fn sample(field: fn(Vec3) -> f32, n: u64) -> Field {
    let mut stream = Stream::new(197, 0);
    let start = [f32::MAX, f32::MIN];
    let mut found = Field { range: start, roughness: 0.0, beyond: Mean::default() };
    for _ in 0..n {
        let p = Vec3::from([0; 3].map(|_| 8.0 * stream.unit24()));
        let f = field(p);
        found.range = [found.range[0].min(f), found.range[1].max(f)];
        let roughness = 0.4 + 0.35 * f;
        found.roughness = found.roughness.max(roughness);
        found.beyond.add(if roughness > 1.0 { 1.0 } else { 0.0 });
    }
    found
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let [guided, ours] = [sample(stone_guide, 300_000), sample(stone_ours, 300_000)];
    let range = |f: &Field| format!("{:.3} to {:.3}", f.range[0], f.range[1]);
    Topic {
        title: "Offsets go into the noise, not onto it",
        section: "5.2.2",
        places: &[Place::Twin("tests/src/corrections/field.rs")],
        rows: vec![
            row("values of the stone's field; [0, 1] is announced", range(&guided), range(&ours)),
            row(
                "roughness from it: largest, and share above 1",
                format!("{:.3}, {}", guided.roughness, percent(guided.beyond.value())),
                format!("{:.3}, {}", ours.roughness, percent(ours.beyond.value())),
            ),
        ],
        says: "Three octave sums at three scales, each moved by its own offset so that they do not repeat \
            each other; roughness from 0.4 to 0.75 over the field."
            .into(),
        wrong: "The listing adds the offset behind the call, to the number that comes out. As written, a \
            vector added to a number, it does not compile; with numbers, the layers still share \
            their lattice, and the field lies above 1 everywhere, so the roughness leaves its range."
            .into(),
        right: "fbm(p * 11 + offset): another part of the same noise. (The guide's wood has it right.)".into(),
    }
}
