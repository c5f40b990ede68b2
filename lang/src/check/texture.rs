//! `asset` and `texture` declarations: a call after `=` becomes what the file needs to be told.

use super::fields::Fields;
use super::file::{AssetInfo, TextureInfo};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::eval::value::Value;
use crate::eval::{Evaluator, Scope};
use crate::resolve::{ItemId, did_you_mean};
use crate::scene::{AssetFormat, ColorSpace, FileFrame, GltfChoice, Wrap};
use crate::schema::asset::AssetType;
use crate::schema::texture::TextureType;
use crate::schema::{self, Kind};
use crate::syntax::{Binding, Expr, ExprKind, Ident};
use crate::texture::Placement;

/// Checks an `asset`.
pub(super) fn asset(ev: &mut Evaluator<'_>, id: ItemId, binding: &Binding) -> Option<AssetInfo> {
    let fields = file_call(ev, id, Kind::Asset, &binding.value)?;
    let frame = || {
        let Some(Value::Axis(up)) = fields.get("up") else { return None };
        Some(FileFrame { metres_per_unit: fields.number("unit")?, up })
    };
    let format = match AssetType::of(fields.schema) {
        AssetType::Obj => AssetFormat::Obj(frame()?),
        AssetType::Ply => AssetFormat::Ply(frame()?),
        AssetType::Stl => AssetFormat::Stl(frame()?),
        AssetType::Gltf => {
            let (animation, variant) = (fields.text("animation"), fields.text("variant"));
            let start = animation.as_ref().map(|_| 0.0);
            AssetFormat::Gltf(GltfChoice {
                time: fields.number("time").or(start),
                animation,
                variant,
            })
        }
    };
    Some(AssetInfo { path: fields.text("path")?, path_span: fields.value_span("path")?, format })
}

/// Checks a `texture`.
pub(super) fn texture(
    ev: &mut Evaluator<'_>,
    id: ItemId,
    binding: &Binding,
) -> Option<TextureInfo> {
    let fields = file_call(ev, id, Kind::Texture, &binding.value)?;
    let TextureType::Image = TextureType::of(fields.schema);
    let space = ColorSpace::of(fields.word("space")?)?;
    let wrap = |name: &str| Wrap::of(fields.word(name).or_else(|| fields.word("wrap"))?);
    Some(TextureInfo {
        path: fields.text("path")?,
        path_span: fields.value_span("path")?,
        space,
        space_span: fields.span("space")?,
        space_value: fields.value_span("space")?,
        wrap: [wrap("wrap_u")?, wrap("wrap_v")?],
        placement: placement(ev, &fields)?,
    })
}

/// Where an image lies; reports a scale of 0.
fn placement(ev: &mut Evaluator<'_>, fields: &Fields) -> Option<Placement> {
    for name in ["scale", "scale_u", "scale_v"] {
        if let (Some(0.0), Some(span)) = (fields.number(name), fields.value_span(name)) {
            let text = format!("`{name}` is zero: the image would be one texel");
            ev.number_fault(Diagnostic::error(Code("E0401"), text).at(span, "not zero"));
            return None;
        }
    }
    let scale = |name: &str| fields.number(name).or_else(|| fields.number("scale"));
    let offset = [fields.number("offset_u")?, fields.number("offset_v")?];
    Some(Placement {
        scale: [scale("scale_u")?, scale("scale_v")?],
        rotate: fields.number("rotate")?,
        offset,
    })
}

/// The fields of the call that a declaration must be.
#[expect(clippy::wildcard_enum_match_arm, reason = "any other expression is wrong here")]
fn file_call(ev: &mut Evaluator<'_>, id: ItemId, kind: Kind, expr: &Expr) -> Option<Fields> {
    let scope = Scope { module: id.module, local: None };
    match &expr.kind {
        ExprKind::Error => None,
        ExprKind::If { condition, then, otherwise } => {
            let taken = ev.condition(condition, scope);
            let first = file_call(ev, id, kind, then);
            let second = file_call(ev, id, kind, otherwise);
            if taken? { first } else { second }
        }
        ExprKind::Call { path, args } if path.segments.len() == 1 => {
            let name = &path.segments[0];
            let Some(schema) = schema::find_type(kind, &name.text) else {
                unknown_call(ev, kind, name);
                return None;
            };
            let fields = ev.call_fields(schema, name, args, scope);
            fields.ok.then_some(fields)
        }
        _ => {
            let value = ev.eval(expr, scope);
            if value != Value::Poison {
                let examples: Vec<String> = schema::types_of(kind)
                    .iter()
                    .map(|schema| format!("`{}(...)`", schema.name))
                    .collect();
                let listed = match examples.as_slice() {
                    [rest @ .., last] if !rest.is_empty() => {
                        format!("{} or {last}", rest.join(", "))
                    }
                    one => one.concat(),
                };
                let text =
                    format!("{} is {listed}, not {}", kind.with_article(), value.described());
                let error = Diagnostic::error(Code("E0305"), text).at(expr.span, value.described());
                ev.fault(error);
            }
            None
        }
    }
}

fn unknown_call(ev: &mut Evaluator<'_>, kind: Kind, name: &Ident) {
    let text = format!("unknown {} `{}(...)`", kind.name(), name.text);
    let error = Diagnostic::error(Code("E0202"), text);
    let foreign = schema::types_of(kind).iter().find_map(|schema| {
        schema.foreign.iter().find(|f| f.0 == name.text).map(|f| (schema.name, f.1))
    });
    let error = if let Some((ours, from)) = foreign {
        error
            .at(name.span, "not known")
            .with_note(format!("`{}` is the name in {from}", name.text))
            .with_fix(Fix::sure(format!("in `.rts` it is `{ours}`"), name.span, ours))
    } else {
        let names = schema::types_of(kind).iter().map(|schema| schema.name);
        did_you_mean(error, name, names)
    };
    ev.fault(error);
}
