//! Does the grain of wood run along the things made of it?

use glam::DVec3;
use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{Instance, MaterialModel, Scene};

use super::object::Thing;

/// A thing is a beam when it is this many times as long as it is wide.
const BEAM: f64 = 3.0;

/// Warns when `corners`, the triangles of `instance` in the world, are a beam of wood with its grain across.
pub(super) fn check(
    scene: &Scene,
    instance: &Instance,
    thing: &Thing,
    corners: &[[DVec3; 3]],
) -> Option<Diagnostic> {
    let material = &scene.materials[instance.material?];
    let MaterialModel::Wood { grain, grain_span, .. } = &material.model else { return None };
    let size = extent(thing, corners);
    let long = longest(size)?;
    if long == *grain {
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
            .because(*grain_span, "the grain is said here")
            .with_note("timber is cut along the grain; end grain would show on the long faces")
            .with_help(help),
    )
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
        };
        let at = |x, y, z| thing.origin + rotation * DVec3::new(x, y, z);
        let size = extent(&thing, &[[at(0.0, 0.0, 0.0), at(4.0, 0.2, 0.0), at(0.0, 0.0, 0.3)]]);
        assert!((size - DVec3::new(4.0, 0.2, 0.3)).abs().max_element() < 1e-12, "{size}");
    }
}
