//! Media fields become coefficients per metre.

use super::camera::one_of;
use super::fields::Fields;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::eval::value::Value;
use crate::resolve::ItemId;
use crate::scene::{Camera, Medium, MediumModel, Name, Render, Rgb};
use crate::schema::medium::MediumType;
use crate::source::Span;
use crate::units::{self, Dim};

/// Contrast left at the distance of visibility, as its negative logarithm: -ln 0.02.
const VISIBILITY: f64 = 3.912_023_005_428_146;

/// Checks how the fields of a medium go together.
pub(super) fn check(ev: &mut Evaluator<'_>, name: Span, fields: &Fields) {
    match MediumType::of(fields.schema) {
        MediumType::Fog => check_fog(ev, name, fields),
        MediumType::Homogeneous => check_homogeneous(ev, name, fields),
    }
}

/// The error for a medium that says too little.
fn lacks(name: Span, fields: &Fields, text: &str, help: &str) -> Diagnostic {
    Diagnostic::error(Code("E0207"), text)
        .at(name, format!("{} needs more", fields.schema.described()))
        .with_help(help)
}

fn check_fog(ev: &mut Evaluator<'_>, name: Span, fields: &Fields) {
    one_of(ev, fields, &["visibility", "density"], "how thick the fog is");
    if !fields.has("visibility") && !fields.has("density") {
        let text = "this fog says neither `visibility` nor `density`";
        ev.fault(lacks(name, fields, text, "for example `visibility = 500m`"));
    }
}

fn check_homogeneous(ev: &mut Evaluator<'_>, name: Span, fields: &Fields) {
    let lacks = |text: &str, help: &str| lacks(name, fields, text, help);
    for own in ["sigma_a", "sigma_s"] {
        for other in ["mean_free_path", "albedo"] {
            one_of(ev, fields, &[own, other], "what this medium does to light");
        }
    }
    match (fields.has("mean_free_path"), fields.has("albedo")) {
        (true, false) => ev.fault(lacks(
            "`mean_free_path` needs `albedo`: which share of the light is scattered?",
            "for example `albedo = linear(0.35, 0.55, 0.6)`",
        )),
        (false, true) => ev.fault(lacks(
            "`albedo` needs `mean_free_path`: how far does light get?",
            "for example `mean_free_path = (0.9, 2.1, 2.6)m`",
        )),
        (false, false) if !fields.has("sigma_a") && !fields.has("sigma_s") => ev.fault(lacks(
            "this medium says nothing about light",
            "for example `sigma_a = (0.35, 0.06, 0.025)/m`",
        )),
        _ => Value::None,
    };
}

/// Builds a medium. `None` only for fields with faults.
pub(super) fn medium(name: Name, fields: &Fields) -> Option<Medium> {
    let sky_distance = fields.number("sky_distance")?;
    let model = match MediumType::of(fields.schema) {
        MediumType::Fog => {
            let density = match fields.number("visibility") {
                Some(visibility) => VISIBILITY / visibility,
                None => fields.number("density")?,
            };
            MediumModel::Fog { density, color: fields.color("color")? }
        }
        MediumType::Homogeneous => homogeneous(fields)?,
    };
    Some(Medium { name, model, sky_distance })
}

fn homogeneous(fields: &Fields) -> Option<MediumModel> {
    let clear: Rgb = [0.0; 3];
    let (sigma_a, sigma_s) = match (fields.vector::<3>("mean_free_path"), fields.color("albedo")) {
        (Some(path), Some(albedo)) => {
            ([0, 1, 2].map(|k| (1.0 - albedo[k]) / path[k]), [0, 1, 2].map(|k| albedo[k] / path[k]))
        }
        _ => (fields.vector("sigma_a").unwrap_or(clear), fields.vector("sigma_s").unwrap_or(clear)),
    };
    Some(MediumModel::Homogeneous { sigma_a, sigma_s, g: fields.number("g")? })
}

/// Reports fog in a place where only a homogeneous medium can be.
pub(super) fn refuse_fog(ev: &mut Evaluator<'_>, id: ItemId, at: Span) {
    if ev.models.get(&id).is_some_and(|model| MediumType::of(model.schema) == MediumType::Fog) {
        let error = Diagnostic::error(Code("E0532"), "fog cannot fill a thing")
            .at(at, "fog is everywhere")
            .because(ev.program.name_span(id), "declared here")
            .with_help("declare a `homogeneous` medium, or write `atmosphere` of the render");
        ev.fault(error);
    }
}

/// Warns of fog that hides what the camera looks at.
pub(super) fn warn_of_blindness(
    ev: &mut Evaluator<'_>,
    fields: &Fields,
    camera: &Camera,
    render: &Render,
) {
    let (Some(visibility), Some(span)) = (fields.number("visibility"), fields.span("visibility"))
    else {
        return;
    };
    let step = |k: usize| (camera.to[k] - camera.from[k]) * (camera.to[k] - camera.from[k]);
    let distance = (step(0) + step(1) + step(2)).sqrt();
    if distance > visibility {
        let text = format!(
            "the camera looks {} far into fog of {} visibility: all will be grey",
            units::show((distance * 100.0).round() / 100.0, Dim::LENGTH),
            units::show(visibility, Dim::LENGTH),
        );
        let warning = Diagnostic::warning(Code("W0714"), "blind_fog", text)
            .at(span, "what is farther has lost 98% of its contrast")
            .because(render.name.span, "the fog of this render");
        ev.tell(warning);
    }
}
