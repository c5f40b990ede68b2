//! Fields of stone, wood and fabric become their models.

use super::fields::Fields;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::scene::{Color, MaterialModel, Pattern};

/// Slope of the field of a material at `scale` 1, per metre: its root mean square, measured.
fn slope(name: &str) -> Option<f64> {
    match name {
        "stone" => Some(STONE_SLOPE),
        "wood" => Some(WOOD_SLOPE),
        "fabric" => Some(FABRIC_SLOPE),
        _ => None,
    }
}

const STONE_SLOPE: f64 = 3.3;
const WOOD_SLOPE: f64 = 2.8;
const FABRIC_SLOPE: f64 = 7.9;

/// Differences of a field never exceed this in the mean, however long the step.
const LARGEST_DIFFERENCE: f64 = 0.15;

/// Warns of bumps that are steeper than 45 degrees on average: they look like noise, not like a surface.
pub(super) fn check(ev: &mut Evaluator<'_>, fields: &Fields) {
    let Some(slope) = slope(fields.schema.name) else { return };
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

/// The model; `color` reads a colour or a texture. `None` only for fields with faults.
pub(super) fn model(
    fields: &Fields,
    color: &dyn Fn(&str) -> Option<Color>,
) -> Option<MaterialModel> {
    let pattern = pattern(fields)?;
    let gloss = fields.number("gloss")?;
    Some(match fields.schema.name {
        "stone" => MaterialModel::Stone {
            color: fields.color("color")?,
            vein: fields.color("color.vein"),
            pattern,
            gloss,
        },
        "wood" => MaterialModel::Wood {
            color: fields.color("color")?,
            late: fields.color("color.late"),
            grain: ["x", "y", "z"].iter().position(|axis| fields.word("grain") == Some(axis))?,
            grain_span: fields.value_span("grain")?,
            pattern,
            gloss,
            anisotropy: fields.number("anisotropy")?,
        },
        _ => MaterialModel::Fabric {
            color: color("color")?,
            pattern,
            roughness: fields.number("roughness")?,
            gloss,
            translucency: fields.number("translucency")?,
        },
    })
}

fn pattern(fields: &Fields) -> Option<Pattern> {
    Some(Pattern {
        scale: fields.number("scale")?,
        step: fields.number("bump.eps")?,
        height: fields.number("bump.strength")?,
    })
}
