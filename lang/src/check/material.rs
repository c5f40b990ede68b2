//! Material fields become the material of the scene.

use std::collections::BTreeMap;

use super::camera::one_of;
use super::fields::Fields;
use super::medium;
use super::pattern;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::eval::value::Value;
use crate::resolve::ItemId;
use crate::scene::{Color, Leaf, MaterialModel, NormalMap, Petal, Principled, Scalar};
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
    if let (Some(id), Some(span)) = (fields.item("interior"), fields.value_span("interior")) {
        medium::refuse_fog(ev, id, span);
    }
    for own in ["sigma_a", "depth.color"] {
        one_of(ev, fields, &["interior", own], "what this water is inside");
    }
}

/// Fields that do nothing because of what another field says, and why.
const NO_EFFECT: &[(&str, &str, f64, &str)] = &[
    ("coat.roughness", "coat.weight", 0.0, "there is no coat"),
    ("transmission", "metallic", 1.0, "metal lets nothing through"),
    ("specular", "metallic", 1.0, "what a metal reflects is its `color`"),
    ("specular.color", "metallic", 1.0, "what a metal reflects is its `color`"),
];

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
    for (name, other, value, label) in NO_EFFECT {
        let zero = fields.number(name) == Some(0.0);
        if !zero && fields.number(other) == Some(*value) {
            warn(name, label, fields.span(other));
        }
    }
    if !fields.has("normal") {
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

/// A surface that reflects more than any real one.
fn whiteness(ev: &mut Evaluator<'_>, fields: &Fields) {
    let scatters = matches!(
        fields.schema.name,
        "diffuse" | "principled" | "clearcoat" | "stone" | "wood" | "fabric"
    );
    let (Some(Value::Color(rgb)), Some(span)) = (fields.get("color"), fields.value_span("color"))
    else {
        return;
    };
    if scatters && rgb.iter().all(|c| *c > WHITEST && *c <= 1.0) {
        let text = "this surface is whiter than any real one";
        let warning = Diagnostic::warning(Code("W0401"), "white_albedo", text)
            .at(span, "reflects over 95% of the light")
            .with_note("paper reflects about 0.8, fresh snow 0.9; light then fades sooner, and so does noise");
        ev.tell(warning);
    }
}

/// Builds the model; `textures` gives the index of a texture, `media` that of a medium. `None` only for
/// fields with faults.
pub(super) fn model(
    fields: &Fields,
    textures: &dyn Fn(ItemId) -> usize,
    media: &BTreeMap<ItemId, usize>,
) -> Option<MaterialModel> {
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
        "dielectric" => MaterialModel::Dielectric {
            ior: fields.number("ior")?,
            roughness: scalar("roughness")?,
            inside: medium::inside(fields, media)?,
        },
        "conductor" => MaterialModel::Conductor {
            color: color("color")?,
            roughness: scalar("roughness")?,
            anisotropy: fields.number("anisotropy")?,
            compensation: fields.word("compensation")? == "on",
        },
        "clearcoat" => MaterialModel::Clearcoat {
            color: color("color")?,
            fuzz: fields.number("fuzz")?,
            coat_ior: fields.number("coat.ior")?,
            coat_tint: fields.color("coat.tint")?,
        },
        "water" => MaterialModel::Water {
            ior: fields.number("ior")?,
            inside: medium::inside(fields, media)?,
            sigma_a: fields.vector("sigma_a")?,
            depth_color: fields.color("depth.color")?,
            waves: match fields.word("waves")? {
                "on" => Some([fields.number("waves.scale")?, fields.number("waves.height")?]),
                _ => None,
            },
        },
        "emissive" => MaterialModel::Emissive {
            color: color("color")?,
            strength: fields.number("strength")?,
            both_sides: fields.word("sides")? == "both",
        },
        "stone" | "wood" | "fabric" => pattern::model(fields, &color)?,
        "leaf" | "petal" => sheet(fields, &color, &scalar)?,
        _ => MaterialModel::Principled(principled(fields, &color, &scalar)?),
    })
}

type Slot<'a, T> = &'a dyn Fn(&str) -> Option<T>;

fn sheet(
    fields: &Fields,
    color: Slot<'_, Color>,
    scalar: Slot<'_, Scalar>,
) -> Option<MaterialModel> {
    Some(match fields.schema.name {
        "leaf" => MaterialModel::Leaf(Leaf {
            color: color("color")?,
            alpha: scalar("alpha")?,
            alpha_clip: fields.number("alpha.clip"),
            translucency: fields.number("translucency")?,
            sigma_a: fields.vector("sigma_a")?,
            thickness: fields.number("thickness")?,
            forward: fields.number("forward")?,
            g: fields.number("g")?,
            gap: fields.number("gap")?,
        }),
        _ => MaterialModel::Petal(Petal {
            color: color("color")?,
            alpha: scalar("alpha")?,
            alpha_clip: fields.number("alpha.clip"),
            fuzz_weight: fields.number("fuzz.weight")?,
            fuzz: fields.number("fuzz.radius")?,
            wax: fields.number("wax")?,
            ior: fields.number("ior")?,
            sigma_a: fields.vector("sigma_a")?,
            sigma_s: fields.number("sigma_s")?,
            g: fields.number("g")?,
            thickness: fields.interval("thickness")?,
            pillow: fields.number("pillow")?,
            tilt: fields.number("tilt")?,
        }),
    })
}

fn principled(
    fields: &Fields,
    color: Slot<'_, Color>,
    scalar: Slot<'_, Scalar>,
) -> Option<Principled> {
    Some(Principled {
        color: color("color")?,
        metallic: scalar("metallic")?,
        roughness: scalar("roughness")?,
        ior: fields.number("ior")?,
        specular: scalar("specular")?,
        specular_color: color("specular.color")?,
        coat: scalar("coat.weight")?,
        coat_roughness: scalar("coat.roughness")?,
        transmission: scalar("transmission")?,
        emission: color("emission.color")?,
        emission_strength: fields.number("emission.strength")?,
        alpha: scalar("alpha")?,
        alpha_clip: fields.number("alpha.clip"),
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
