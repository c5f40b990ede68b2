//! What moves, and whether the shutter of the camera sees it move.

use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::scene::{Name, Scene};
use crate::schema::MAX_MAGNITUDE;

/// Reports things that move too far, and velocities that blur nothing.
pub(super) fn check(ev: &mut Evaluator<'_>, scene: &Scene) {
    let keyed = scene.instances.iter().find(|thing| thing.motion.is_some());
    let eye = (!scene.camera.keys.is_empty()).then_some(&scene.camera.name);
    let keyed = keyed.map(|thing| &thing.name).or(eye);
    let instances = scene.instances.iter().map(|thing| (&thing.name, thing.velocity));
    let lights = scene.lights.iter().map(|light| (&light.name, light.velocity));
    let moving: Vec<(&Name, [f64; 3])> = instances
        .chain(lights)
        .filter(|(_, velocity)| velocity.iter().any(|c| c.abs() > 0.0))
        .collect();
    let [open, close] = scene.camera.shutter;
    let far = |time: f64, v: &[f64; 3]| v.iter().any(|c| (c * time).abs() > MAX_MAGNITUDE);
    for (name, v) in &moving {
        if [open, close, close - open].iter().any(|time| far(*time, v)) {
            let text = format!("`{}` moves farther than can be drawn", name.text);
            let error = Diagnostic::error(Code("E0402"), text).at(name.span, "this is too fast");
            ev.fault(error.because(scene.camera.name.span, "for the `shutter` of this camera"));
            return;
        }
    }
    let first = moving.first().map(|(name, _)| *name);
    if let (Some(name), true) = (first.or(keyed), close <= open) {
        let text = "the shutter opens and closes at the same moment: motion does not blur";
        let warning = Diagnostic::warning(Code("W0805"), "closed_shutter", text)
            .at(scene.camera.name.span, "this camera sees one moment")
            .because(name.span, "this moves")
            .with_help(if first.is_some() {
                "write `shutter = 0ms..20ms` in the camera, or leave out `velocity`"
            } else {
                "write `shutter = 0ms..20ms` in the camera, or one value in place of the keys"
            });
        ev.tell(warning);
    }
}
