//! Emitting primitives become the light selection table.
//!
//! A light is chosen with a probability proportional to its power. Random numbers have 24 bits, so
//! probabilities are whole multiples of 2^-24: then the probability that the estimator divides by
//! is exactly the frequency with which the kernel chooses.

use glam::DVec3;
use lang::scene;
use pack::abi::{self, LightKind, NONE};
use std::f64::consts::PI;

/// An emitter before primitives are in leaf order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Emitter {
    pub(super) kind: LightKind,
    /// Index of its first primitive among all triangles, or among all spheres; of a light at infinity among those.
    pub(super) primitive: u32,
    /// Triangles it consists of; 1 for spheres, 0 for what is no surface.
    pub(super) count: u32,
    pub(super) material: u32,
    /// Area, less the share that leaves the scene, see `power::weigh`: times `MaterialTable::glow` of the material,
    /// or the flux of the sky, it is proportional to power.
    pub(super) area: f64,
    /// Towards where it is tinted, or against its beam, unit; the cosine of the angle of the tint or of the outer cone,
    /// and that of the inner cone. All 0 if it looks the same from everywhere.
    pub(super) facing: [f32; 5],
}

/// The tint of a light, unless it is neutral: a factor of 1 changes no bit.
pub(super) fn tint(light: &scene::Light) -> Option<scene::Tint> {
    let neutral =
        |tint: &scene::Tint| tint.color.iter().all(|c| (*c as f32).to_bits() == 1.0_f32.to_bits());
    light.tint.filter(|tint| !neutral(tint))
}

/// What a light knows of directions, as `Emitter::facing`.
pub(super) fn facing(light: &scene::Light) -> [f32; 5] {
    if let Some(beam) = light.beam {
        let [x, y, z] = beam.direction.map(|c| -c as f32);
        let outer = beam.outer as f32;
        // The kernel divides by the difference.
        return [x, y, z, outer, (beam.inner as f32).max(outer.next_up())];
    }
    if let Some(profile) = &light.profile {
        let [x, y, z] = profile.direction.map(|c| -c as f32);
        return [x, y, z, turn(profile) as f32, 0.0];
    }
    tint(light).map_or([0.0; 5], |tint| {
        let [x, y, z] = tint.direction.map(|c| c as f32);
        [x, y, z, libm::cos(tint.angle) as f32, 0.0]
    })
}

/// How far the first column of a profile lies from the x axis of the kernel's frame around the light, turns back.
fn turn(profile: &scene::Profile) -> f64 {
    let axis = DVec3::from(profile.direction).as_vec3();
    // `basis_around` of `math/basis.wgsl`.
    let n = -axis.as_dvec3();
    let s = if n.z >= 0.0 { 1.0 } else { -1.0 };
    let a = -1.0 / (s + n.z);
    let c = n.x * n.y * a;
    let t = DVec3::new(1.0 + s * n.x * n.x * a, s * c, -s * n.x);
    let b = DVec3::new(c, s + n.y * n.y * a, -n.y);
    let first = DVec3::from(profile.first);
    -libm::atan2(first.dot(b), first.dot(t)) / (2.0 * PI)
}

/// Steps of a 24-bit random number.
pub(super) const STEPS: u64 = 1 << 24;

/// Luminance of a linear Rec. 709 colour (ITU-R BT.709).
pub(super) fn luminance(color: [f64; 3]) -> f64 {
    0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]
}

/// Shares of `STEPS` by power: at least one step each, summing to `STEPS` exactly. `None` for
/// emitters that are not selected: without power, or weakest of too many.
pub(super) fn shares(powers: &[f64]) -> Vec<Option<u64>> {
    let mut order: Vec<usize> = (0..powers.len()).filter(|&i| powers[i] > 0.0).collect();
    // Strongest first, ties by index; past a quarter of the steps, one step each would distort.
    order.sort_by(|&a, &b| powers[b].total_cmp(&powers[a]).then(a.cmp(&b)));
    order.truncate((STEPS / 4) as usize);
    let total: f64 = order.iter().map(|&i| powers[i]).sum();
    let mut shares = vec![None; powers.len()];
    let mut used = 0;
    for &i in order.iter().rev() {
        let steps = libm::floor(powers[i] / total * STEPS as f64).max(1.0) as u64;
        shares[i] = Some(steps);
        used += steps;
    }
    // What rounding left over, or what the single steps took, is the strongest lights' affair.
    for &i in order.iter().cycle() {
        let share = shares[i].as_mut().expect("every light in `order` has a share");
        if used < STEPS {
            *share += STEPS - used;
            used = STEPS;
        }
        if used == STEPS {
            break;
        }
        let give = (used - STEPS).min(*share / 2);
        *share -= give;
        used -= give;
    }
    shares
}

/// Probability of each emitter, and the sum up to it; `None` for emitters that are not selected.
pub(super) fn choices(powers: &[f64]) -> Vec<Option<[f32; 2]>> {
    let mut sum = 0;
    let choice = |share: Option<u64>| {
        let share = share?;
        sum += share;
        Some([share, sum].map(|steps| (steps as f64 / STEPS as f64) as f32))
    };
    shares(powers).into_iter().map(choice).collect()
}

/// The index of the light of each emitter, or `NONE`.
pub(super) fn ids(choices: &[Option<[f32; 2]>]) -> Vec<u32> {
    let mut next = 0..;
    choices.iter().map(|choice| choice.and_then(|_| next.next()).unwrap_or(NONE)).collect()
}

/// The records: `directional` are all lights at infinity, `of_primitives` those of the surfaces that have a choice,
/// without it.
pub(super) fn table(
    emitters: &[Emitter],
    choices: &[Option<[f32; 2]>],
    directional: &[abi::Light],
    of_primitives: &[abi::Light],
) -> Vec<abi::Light> {
    let mut of_primitives = of_primitives.iter();
    let record = |(emitter, choice): (&Emitter, &Option<[f32; 2]>)| {
        let [pmf, cdf] = (*choice)?;
        let base = match emitter.kind {
            LightKind::Sky => without_primitive(emitter),
            LightKind::Directional => *directional.get(emitter.primitive as usize)?,
            LightKind::Sphere | LightKind::Rectangle | LightKind::Triangle => {
                *of_primitives.next()?
            }
        };
        Some(abi::Light { pmf, cdf, trail: 0, ..base })
    };
    emitters.iter().zip(choices).filter_map(record).collect()
}

/// The record of a light at infinity whose object has the number `object`, without how it is chosen.
pub(super) fn directional(light: &scene::Directional, object: usize) -> abi::Light {
    abi::Light {
        kind: LightKind::Directional as u32,
        origin: light.direction.map(|c| c as f32),
        edge1: light.radiance.map(|c| c as f32),
        edge2: [light.rim() as f32, f32::from(u8::from(!light.visible)), 0.0],
        primitive: object as u32,
        ..Default::default()
    }
}

/// The record of an emitter, without what a primitive says.
fn without_primitive(emitter: &Emitter) -> abi::Light {
    let (kind, material) = (emitter.kind as u32, emitter.material);
    abi::Light { kind, material, ..Default::default() }
}

/// Primitives in leaf order and where each went.
pub(super) struct Geometry<'a> {
    pub(super) triangles: &'a [abi::Triangle],
    pub(super) triangle_at: &'a [u32],
    pub(super) spheres: &'a [abi::Sphere],
    pub(super) sphere_at: &'a [u32],
}

impl Geometry<'_> {
    /// The record of an emitter, without how it is chosen.
    pub(super) fn light(&self, emitter: &Emitter) -> abi::Light {
        let base = without_primitive(emitter);
        if emitter.kind.surface().is_none() {
            return base;
        }
        if emitter.kind == LightKind::Sphere {
            let primitive = self.sphere_at[emitter.primitive as usize];
            let sphere = &self.spheres[primitive as usize];
            let [x, y, z, outer, inner] = emitter.facing;
            let (origin, edge1) = (sphere.center, [sphere.radius, outer, inner]);
            return abi::Light { origin, edge1, edge2: [x, y, z], primitive, ..base };
        }
        let primitive = self.triangle_at[emitter.primitive as usize];
        let first = &self.triangles[primitive as usize];
        let origin = glam::Vec3::from(first.v0);
        // Rectangles are (v0, v1, v2) and (v0, v2, v3): v1 of the first and v2 of the second.
        let corner = if emitter.kind == LightKind::Rectangle {
            let second = self.triangle_at[emitter.primitive as usize + 1];
            self.triangles[second as usize].v2
        } else {
            first.v2
        };
        let edge1 = glam::Vec3::from(first.v1) - origin;
        let edge2 = glam::Vec3::from(corner) - origin;
        let parallelogram = edge1.as_dvec3().cross(edge2.as_dvec3()).length();
        let share = if emitter.kind == LightKind::Rectangle { 1.0 } else { 0.5 };
        abi::Light {
            origin: origin.to_array(),
            edge1: edge1.to_array(),
            edge2: edge2.to_array(),
            area: (share * parallelogram) as f32,
            primitive,
            ..base
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_proportional_to_power_and_sum_to_all_steps() {
        let shares = shares(&[1.0, 3.0, 0.0, 4.0]);
        assert_eq!(shares, [Some(STEPS / 8), Some(3 * STEPS / 8), None, Some(STEPS / 2)]);
    }

    #[test]
    fn the_weakest_light_still_has_a_step() {
        let mut powers = vec![1e-30; 1000];
        powers.push(1e30);
        let shares = shares(&powers);
        assert!(shares[..1000].iter().all(|share| *share == Some(1)));
        assert_eq!(shares.iter().flatten().sum::<u64>(), STEPS);
    }

    #[test]
    fn many_equal_lights_share_all_steps() {
        let shares = shares(&vec![2.0; 100_000]);
        assert_eq!(shares.iter().flatten().sum::<u64>(), STEPS);
    }

    #[test]
    fn the_edge_of_a_beam_has_a_width_in_single_precision() {
        let cosine = libm::cos(0.5_f64.to_radians());
        let beam = scene::Beam { direction: [0.0, -1.0, 0.0], inner: cosine, outer: cosine };
        let span = lang::source::Span { file: lang::source::FileId(0), start: 0, end: 0 };
        let light = scene::Light {
            name: scene::Name { text: "l".to_owned(), span },
            center: [0.0; 3],
            velocity: [0.0; 3],
            radius: 0.01,
            radiance: [1.0; 3],
            tint: None,
            beam: Some(beam),
            profile: None,
            visible: true,
            group: None,
            links: None,
        };
        let [_, y, _, outer, inner] = facing(&light);
        assert!(inner > outer && y.to_bits() == 1.0_f32.to_bits(), "{outer} {inner}");
    }

    #[test]
    fn no_power_means_no_light() {
        assert_eq!(shares(&[0.0, 0.0]), [None, None]);
    }
}
