//! Material fields become the material of the scene.

use super::fields::Fields;
use super::pattern;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::eval::value::Value;
use crate::resolve::ItemId;
use crate::scene::{Color, MaterialModel, NormalMap, Principled, Scalar};

/// Above this no real surface is white: fresh snow and barium sulphate stay below.
const WHITEST: f64 = 0.95;

/// Warns of a surface that reflects more than any real one.
pub(super) fn check(ev: &mut Evaluator<'_>, fields: &Fields) {
    pattern::check(ev, fields);
    let scatters =
        matches!(fields.schema.name, "diffuse" | "principled" | "stone" | "wood" | "fabric");
    let (Some(Value::Color(rgb)), Some(span)) = (fields.get("color"), fields.value_span("color"))
    else {
        return;
    };
    if scatters && rgb.iter().all(|c| *c > WHITEST && *c <= 1.0) {
        let text = "this surface is whiter than any real one";
        let warning = Diagnostic::warning(Code("W0401"), "white_albedo", text)
            .at(span, "reflects over 95% of the light")
            .with_note("paper reflects about 0.8, fresh snow 0.9; light then fades sooner, and so does noise");
        ev.diagnostics.push(warning);
    }
}

/// Builds the model; `textures` gives the index of a texture. `None` only for fields with faults.
pub(super) fn model(fields: &Fields, textures: &dyn Fn(ItemId) -> usize) -> Option<MaterialModel> {
    let color = |name: &str| match fields.get(name) {
        Some(Value::Color(rgb)) => Some(Color::Constant(rgb)),
        Some(Value::TextureColor(id)) => Some(Color::Texture(textures(id))),
        _ => None,
    };
    let scalar = |name: &str| match fields.get(name) {
        Some(Value::Number(value, _)) => Some(Scalar::Constant(value)),
        Some(Value::TextureChannel(id, channel)) => {
            Some(Scalar::Texture { texture: textures(id), channel })
        }
        _ => None,
    };
    Some(match fields.schema.name {
        "diffuse" => MaterialModel::Diffuse { color: color("color")? },
        "metal" => MaterialModel::Metal { color: color("color")?, fuzz: fields.number("fuzz")? },
        "dielectric" => MaterialModel::Dielectric { ior: fields.number("ior")? },
        "emissive" => MaterialModel::Emissive {
            color: color("color")?,
            strength: fields.number("strength")?,
            both_sides: fields.word("sides")? == "both",
        },
        "stone" | "wood" | "fabric" => pattern::model(fields, &color)?,
        _ => MaterialModel::Principled(Principled {
            color: color("color")?,
            metallic: scalar("metallic")?,
            roughness: scalar("roughness")?,
            ior: fields.number("ior")?,
            emission: color("emission.color")?,
            emission_strength: fields.number("emission.strength")?,
            alpha: scalar("alpha")?,
            alpha_clip: fields.number("alpha.clip"),
        }),
    })
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
        .filter_map(|field| match fields.get(field.name) {
            Some(Value::TextureColor(id) | Value::TextureChannel(id, _)) => Some(id),
            _ => None,
        })
        .collect()
}

/// Does it give off light?
pub(super) fn emits(model: &MaterialModel) -> bool {
    let (color, strength) = match model {
        MaterialModel::Emissive { color, strength, .. } => (color, *strength),
        MaterialModel::Principled(p) => (&p.emission, p.emission_strength),
        _ => return false,
    };
    let dark = matches!(color, Color::Constant(rgb) if rgb.iter().all(|c| *c == 0.0));
    strength > 0.0 && !dark
}
