//! Light linking of a whole scene: how many lists of names its lights have, and whether the names are of something.

use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::scene::{LightLinks, Scene};

/// Most lists of names of a scene that differ.
const MAX_SETS: usize = 32;

/// Reports more lists of names than a pack can hold, and warns of names that are of nothing in the world.
pub(super) fn check(ev: &mut Evaluator<'_>, scene: &Scene) {
    let sets = LightLinks::sets(scene.light_links());
    if let Some(name) = sets.get(MAX_SETS).and_then(|links| links.names().first()) {
        let text = format!("more than {MAX_SETS} different lists of linked instances");
        let error = Diagnostic::error(Code("E0801"), text).at(name.span, "one too many");
        ev.fault(error.with_help("let some lights light the same things"));
    }
    for name in sets.into_iter().flat_map(LightLinks::names) {
        if scene.instances.iter().any(|instance| name.covers(&instance.name.text)) {
            continue;
        }
        let text = format!("`{}` is not in the world", name.text);
        let warning = Diagnostic::warning(Code("W0719"), "unlinked_light", text)
            .at(name.span, "nothing to light")
            .with_help("an instance of an imported file is in the world if it is `pub`");
        ev.tell(warning);
    }
}
