//! Warns of patterns that cannot be meant.

use super::fields::Fields;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::material::Lints;
use crate::scene::Pattern;

/// Differences of a field never exceed this in the mean, however long the step.
const LARGEST_DIFFERENCE: f64 = 0.15;

/// Warns of bumps that are steeper than 45 degrees on average: they look like noise, not like a surface.
pub(super) fn check(ev: &mut Evaluator<'_>, fields: &Fields) {
    let Some(slope) = Lints::of(fields.schema.name).slope else { return };
    let Some(pattern) = pattern(fields) else { return };
    let steepness = pattern.height * (slope * pattern.scale).min(LARGEST_DIFFERENCE / pattern.step);
    let written = ["bump.strength", "scale", "bump.eps"];
    let Some(span) = written.iter().find_map(|name| fields.value_span(name)) else { return };
    if steepness > 1.0 {
        let degrees = steepness.atan().to_degrees();
        let most = crate::units::show_number((pattern.height / steepness * 1e4).round() * 0.1);
        let warning = Diagnostic::warning(
            Code("W0402"),
            "steep_bumps",
            "these bumps are too steep",
        )
        .at(span, format!("{degrees:.0} degrees on average"))
        .with_note(
            "bumps only tilt the normal: above 45 degrees they do not look like a surface any more",
        )
        .with_help(format!("write `bump.strength = {most}mm` or less"));
        ev.tell(warning);
    }
}

fn pattern(fields: &Fields) -> Option<Pattern> {
    Some(Pattern {
        scale: fields.number("scale")?,
        step: fields.number("bump.eps")?,
        height: fields.number("bump.strength")?,
    })
}
