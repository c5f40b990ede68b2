//! Does the grain of wood run along the things made of it?

use std::collections::BTreeMap;

use glam::DVec3;
use lang::diagnostic::{Code, Diagnostic};
use lang::material::Traits as _;
use lang::scene::{Instance, Scene};
use serde::{Deserialize, Serialize};

use super::object::Thing;
use super::pieces::pieces;

/// A thing is a beam when it is this many times as long as it is wide.
const BEAM: f64 = 3.0;

/// Whether the instance has a grain.
pub(super) fn matters(scene: &Scene, instance: &Instance) -> bool {
    let material = instance.material.map(|material| &scene.materials[material].model);
    material.is_some_and(|material| material.grain().is_some())
}

/// A thing that is long.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Beam {
    /// The axis along which it lies.
    long: usize,
    /// Along the thing's axes, metres.
    size: [f64; 3],
}

/// The beam that `corners`, the triangles of a thing in the world, are, if they are one.
pub(super) fn beam(thing: &Thing, corners: &[[DVec3; 3]]) -> Option<Beam> {
    let size = extent(thing, &longest_piece(thing, corners));
    Some(Beam { long: longest(size)?, size: size.to_array() })
}

/// Warns when the grain of an instance runs across the beam that it is.
pub(super) fn check(scene: &Scene, instance: &Instance, beam: &Beam) -> Option<Diagnostic> {
    let material = &scene.materials[instance.material?];
    let grain = material.model.grain()?;
    let Beam { long, size } = *beam;
    if long == grain.axis {
        return None;
    }
    let axes = ["x", "y", "z"];
    let [a, b] = [(long + 1) % 3, (long + 2) % 3];
    let (a, b) = (a.min(b), a.max(b));
    let text = format!("the grain of `{}` runs across this beam", material.name.text);
    let along = axes[long];
    let label = format!(
        "longest side is {along}: {:.2}m ({} {:.2}m, {} {:.2}m)",
        size[long], axes[a], size[a], axes[b], size[b]
    );
    let name = &material.name.text;
    let help = format!(
        "give it its own axis: material {}_{along} like {name} {{ grain = {along} }}",
        name.replace('.', "_")
    );
    Some(
        Diagnostic::warning(Code("W0511"), "grain_across", text)
            .at(instance.shape_span, label)
            .because(grain.span, "the grain is said here")
            .with_note("timber is cut along the grain; end grain would show on the long faces")
            .with_help(help),
    )
}

/// The triangles of the longest piece: a mesh of many planks is not one beam. Triangles with a corner
/// in common hang together. Only where the whole looks like a beam: else there is nothing to find.
fn longest_piece(thing: &Thing, corners: &[[DVec3; 3]]) -> Vec<[DVec3; 3]> {
    if longest(extent(thing, corners)).is_none() {
        return corners.to_vec();
    }
    // Equal up to rounding of where the thing stands: micrometres.
    let key = |p: DVec3| (p * 1e6).round().as_i64vec3().to_array();
    let numbers = pieces(corners.iter().map(|triangle| triangle.map(key)));
    let mut members = BTreeMap::<u32, Vec<[DVec3; 3]>>::new();
    for (piece, triangle) in numbers.into_iter().zip(corners) {
        members.entry(piece).or_default().push(*triangle);
    }
    let length = |piece: &Vec<[DVec3; 3]>| extent(thing, piece).max_element();
    let longer = |a: &Vec<[DVec3; 3]>, b: &Vec<[DVec3; 3]>| length(a).total_cmp(&length(b));
    members.into_values().max_by(longer).unwrap_or_default()
}

/// Sizes of the smallest box around the corners whose sides are the thing's axes, metres.
fn extent(thing: &Thing, corners: &[[DVec3; 3]]) -> DVec3 {
    let object_from_world = thing.rotation.transpose();
    let mut low = DVec3::INFINITY;
    let mut high = DVec3::NEG_INFINITY;
    for corner in corners.iter().flatten() {
        let q = object_from_world * (*corner - thing.origin);
        low = low.min(q);
        high = high.max(q);
    }
    high - low
}

/// The axis along which a beam lies; `None` for what is no beam, or nothing.
fn longest(size: DVec3) -> Option<usize> {
    let long = (0..3).max_by(|a, b| size[*a].total_cmp(&size[*b]))?;
    let second = size[(long + 1) % 3].max(size[(long + 2) % 3]);
    // Not for a thing without triangles, whose size is not a number of metres.
    // A box of 0.6 by 0.2 is one, however that is rounded.
    (size.is_finite() && size[long] >= BEAM * second * (1.0 - 1e-9)).then_some(long)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_beam_is_three_times_as_long_as_wide() {
        assert_eq!(longest(DVec3::new(0.2, 0.1, 0.6)), Some(2));
        assert_eq!(longest(DVec3::new(0.2, 0.1, 0.59)), None);
        assert_eq!(longest(DVec3::NEG_INFINITY), None);
    }

    #[test]
    fn a_turned_beam_is_measured_along_itself() {
        let rotation = glam::DMat3::from_rotation_y(0.7);
        let thing = Thing {
            name: "beam".to_owned(),
            origin: DVec3::new(5.0, 0.0, 1.0),
            rotation,
            motion: DVec3::ZERO,
            path: None,
        };
        let at = |x, y, z| thing.origin + rotation * DVec3::new(x, y, z);
        let size = extent(&thing, &[[at(0.0, 0.0, 0.0), at(4.0, 0.2, 0.0), at(0.0, 0.0, 0.3)]]);
        assert!((size - DVec3::new(4.0, 0.2, 0.3)).abs().max_element() < 1e-12, "{size}");
    }

    #[test]
    fn planks_side_by_side_are_not_one_beam() {
        let thing = Thing {
            name: "deck".to_owned(),
            origin: DVec3::ZERO,
            rotation: glam::DMat3::IDENTITY,
            motion: DVec3::ZERO,
            path: None,
        };
        let plank = |k: f64| {
            let at = |x: f64, z: f64| DVec3::new(x, 0.0, z + 0.3 * k);
            let (a, b, c, d) = (at(0.0, 0.0), at(1.0, 0.0), at(1.0, 0.2), at(0.0, 0.2));
            [[a, b, c], [a, c, d]]
        };
        let deck: Vec<_> = (0..20).flat_map(|k| plank(f64::from(k))).collect();
        assert_eq!(longest(extent(&thing, &deck)), Some(2));
        assert_eq!(longest(extent(&thing, &longest_piece(&thing, &deck))), Some(0));
    }
}
