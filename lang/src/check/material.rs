//! Material fields become the material of the scene.

use super::exclusive::one_of;
use super::fields::Fields;
use super::medium;
use super::pattern;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::eval::value::Value;
use crate::material::{Lints, NoEffect, TextureProjection, Traits as _, without_effect};
use crate::resolve::ItemId;
use crate::scene::{Color, Material, NormalMap};
use crate::source::Span;
use crate::units;

/// Above this no real surface is white: fresh snow and barium sulphate stay below.
const WHITEST: f64 = 0.95;

/// Warns of values that are allowed and hardly meant.
pub(super) fn check(ev: &mut Evaluator<'_>, fields: &Fields) {
    no_effect(ev, fields);
    pattern::check(ev, fields);
    whiteness(ev, fields);
    invisible_coat(ev, fields);
    bare_sheen(ev, fields);
    unprojected(ev, fields);
    one_of(ev, fields, &["strength", "power"], "how bright it is");
    if let (Some(id), Some(span)) = (fields.item("interior"), fields.value_span("interior")) {
        medium::refuse_fog(ev, id, span);
    }
    for own in ["sigma_a", "depth.color"] {
        one_of(ev, fields, &["interior", own], "what this water is inside");
    }
}

/// Warns of fields that are written and do nothing.
fn no_effect(ev: &mut Evaluator<'_>, fields: &Fields) {
    let mut warn = |name: &str, label: &str, because: Option<Span>| {
        let Some(span) = fields.span(name).filter(|_| fields.has(name)) else { return };
        let text = format!("`{name}` has no effect: {label}");
        let warning =
            Diagnostic::warning(Code("W0404"), "no_effect", text).at(span, "changes nothing");
        ev.tell(match because {
            Some(because) => warning.because(because, "because of this"),
            None => warning,
        });
    };
    for NoEffect { field, because, why } in without_effect(|name| fields.number(name)) {
        warn(field, why, fields.span(because));
    }
    if fields.get("sheen") == Some(Value::Color([0.0; 3])) {
        warn("sheen.roughness", "there is no sheen", fields.span("sheen"));
    }
    if !fields.has("normal") && (fields.of_file.is_none() || fields.is_none("normal")) {
        warn("normal.strength", "there is no normal map", None);
    }
}

/// A coat of the index of air reflects nothing.
fn invisible_coat(ev: &mut Evaluator<'_>, fields: &Fields) {
    let (Some(ior), Some(span)) = (fields.number("coat.ior"), fields.value_span("coat.ior")) else {
        return;
    };
    if ior < 1.001 {
        let text = format!("a coat of index {} cannot be seen", units::show_number(ior));
        let warning = Diagnostic::warning(Code("W0403"), "invisible_coat", text)
            .at(span, "reflects under 0.0001% of the light")
            .with_help("write 1.5 for lacquer, or make the material `diffuse`");
        ev.tell(warning);
    }
}

/// Fibres stand on a surface that is neither coated nor brushed: what such ones lose under them is not known.
fn bare_sheen(ev: &mut Evaluator<'_>, fields: &Fields) {
    let black = fields.get("sheen") == Some(Value::Color([0.0; 3]));
    let Some(span) = fields.span("sheen").filter(|_| fields.has("sheen") && !black) else { return };
    for (other, does) in [("coat.weight", "coats"), ("anisotropy", "brushes")] {
        if let Some(because) = fields.span(other).filter(|_| fields.number(other) != Some(0.0)) {
            let text = format!("`sheen` cannot go with `{other}`");
            let error = Diagnostic::error(Code("E0703"), text)
                .at(span, "fibres over the bare surface")
                .because(because, format!("this {does} it"))
                .with_help("leave one of them out, or `mix` two materials, each with one of them");
            ev.fault(error);
        }
    }
}

/// What gives light and what is cut out is asked for by rays that know texture coordinates alone.
fn unprojected(ev: &mut Evaluator<'_>, fields: &Fields) {
    let Some(span) = fields
        .span("projection")
        .filter(|_| TextureProjection::of(fields) != TextureProjection::Uv)
    else {
        return;
    };
    let textured = |name: &str| fields.get(name).is_some_and(|value| value.is_textured());
    for name in ["emission.color", "alpha"].into_iter().filter(|name| textured(name)) {
        let text = format!("a textured `{name}` cannot be projected");
        let error = Diagnostic::error(Code("E0703"), text)
            .at(span, "moves all textures of this material")
            .because(fields.value_span(name).unwrap_or(span), "is a texture")
            .with_help("use the texture coordinates of the shape: `projection = uv`");
        ev.fault(error);
    }
    let may_be = fields.of_file.is_some();
    if !may_be && !fields.schema.fields.iter().any(|field| textured(field.name)) {
        let text = "`projection` has no effect: nothing of this material is a texture";
        let warning =
            Diagnostic::warning(Code("W0404"), "no_effect", text).at(span, "changes nothing");
        ev.tell(warning);
    }
}

/// A surface that reflects more than any real one.
fn whiteness(ev: &mut Evaluator<'_>, fields: &Fields) {
    let (Some(Value::Color(rgb)), Some(span)) = (fields.get("color"), fields.value_span("color"))
    else {
        return;
    };
    if Lints::of(fields.schema.name).albedo && rgb.iter().all(|c| *c > WHITEST && *c <= 1.0) {
        let text = "this surface is whiter than any real one";
        let warning = Diagnostic::warning(Code("W0401"), "white_albedo", text)
            .at(span, "reflects over 95% of the light")
            .with_note("paper reflects about 0.8, fresh snow 0.9; light then fades sooner, and so does noise");
        ev.tell(warning);
    }
}

/// The normal map, if there is one.
pub(super) fn normal(fields: &Fields, textures: &dyn Fn(ItemId) -> usize) -> Option<NormalMap> {
    let Some(Value::TextureColor(id)) = fields.get("normal") else { return None };
    Some(NormalMap { texture: textures(id), strength: fields.number("normal.strength")? })
}

/// The textures that a material reads.
pub(super) fn textures(fields: &Fields) -> Vec<ItemId> {
    fields
        .schema
        .fields
        .iter()
        .flat_map(|field| match fields.get(field.name) {
            Some(Value::TextureColor(id) | Value::TextureChannel(id, _)) => vec![id],
            Some(Value::Textured(of)) => of.images().into_iter().map(|(id, _)| *id).collect(),
            _ => Vec::new(),
        })
        .collect()
}

/// Does it give off light? What is like a material of a file may.
pub(super) fn emits(material: &Material) -> bool {
    let emission = material.model.emission();
    material.of_file.is_some()
        || emission.is_some_and(|(color, strength)| {
            let dark = matches!(color, Color::Constant(rgb) if rgb.iter().all(|c| *c == 0.0));
            strength > 0.0 && !dark
        })
}
