//! Media: `medium NAME: TYPE { ... }`. Each is declared here: schema, value, how it is read from checked fields, and
//! how it is written.

use crate::check::Fields;
use crate::check::exclusive::one_of;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::eval::value::Value;
use crate::resolve::ItemId;
use crate::resolved::{Declared, length, number, vector};
use crate::scene::{Camera, Name, Render, Rgb};
use crate::schema::{ANY, Bounds, Default, Field, FieldType, Kind, TypeSchema, color_text, types};
use crate::source::Span;
use crate::units::{self, Dim};

/// What fills things, or the space around them.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    /// Declared name.
    pub name: Name,
    /// Model and parameters.
    pub model: MediumModel,
    /// As atmosphere: length of what lies between the scene and the sky, metres.
    pub sky_distance: f64,
}

/// What a medium does with light.
#[derive(Clone, Debug, PartialEq)]
pub enum MediumModel {
    /// Absorbs and scatters.
    Homogeneous {
        /// Absorption for each channel, per metre.
        sigma_a: Rgb,
        /// Scattering for each channel, per metre.
        sigma_s: Rgb,
        /// Mean cosine of scattering, -1 ..= 1.
        g: f64,
    },
    /// Hides light behind its own.
    Fog {
        /// Extinction, per metre.
        density: f64,
        /// Radiance where it is thick.
        color: Rgb,
    },
}

impl Medium {
    /// Name of its type, and its fields as they would be written.
    pub(crate) fn shown(&self) -> Declared {
        let (kind, mut fields) = match self.model {
            MediumModel::Homogeneous { sigma_a, sigma_s, g } => {
                let fields = vec![
                    ("sigma_a", vector(sigma_a, "/m")),
                    ("sigma_s", vector(sigma_s, "/m")),
                    ("g", number(g)),
                ];
                ("homogeneous", fields)
            }
            MediumModel::Fog { density, color } => {
                let density = units::show(density, Dim::PER_LENGTH);
                ("fog", vec![("density", density), ("color", color_text(color))])
            }
        };
        fields.push(("sky_distance", length(self.sky_distance)));
        (kind, fields)
    }
}

/// Contrast left at the distance of visibility, as its negative logarithm: -ln 0.02.
const VISIBILITY: f64 = 3.912_023_005_428_146;

/// Checks how the fields of a medium go together.
pub(crate) fn check(ev: &mut Evaluator<'_>, name: Span, fields: &Fields) {
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
        let text = "this fog has neither `visibility` nor `density`";
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
            "this medium has no coefficients",
            "for example `sigma_a = (0.35, 0.06, 0.025)/m`",
        )),
        _ => Value::None,
    };
}

/// Builds a medium. `None` only for fields with faults.
pub(crate) fn read(name: Name, fields: &Fields) -> Option<Medium> {
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
pub(crate) fn refuse_fog(ev: &mut Evaluator<'_>, id: ItemId, at: Span) {
    if ev.models.get(&id).is_some_and(|model| MediumType::of(model.schema) == MediumType::Fog) {
        let error = Diagnostic::error(Code("E0532"), "fog cannot be an interior")
            .at(at, "fog is everywhere")
            .because(ev.program.name_span(id), "declared here")
            .with_help("declare a `homogeneous` medium, or write `atmosphere` of the render");
        ev.fault(error);
    }
}

/// Warns of fog that hides what the camera looks at.
pub(crate) fn warn_of_blindness(
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

types!(MediumType { Homogeneous = HOMOGENEOUS, Fog = FOG });

pub(crate) const COEFFICIENT: Bounds = Bounds::new(Dim::PER_LENGTH, "/m", 0.0, ANY);

/// Names that other renderers give absorption.
pub(crate) const SIGMA_A_NAMES: &[(&str, &str)] = &[
    ("absorption", "LuxCore"),
    ("absorption_coefficient", "common use"),
    ("sigmaA", "Mitsuba 0.6"),
];

const SKY_DISTANCE: Field = Field::new(
    "sky_distance",
    FieldType::Number(Bounds::above(Dim::LENGTH, "m", 0.0)),
    Default::Number(1000.0),
    "As atmosphere: how much of it lies between the scene and the sky.",
)
.typical("haze that hides the horizon but not the sky 500m");

const HOMOGENEOUS: TypeSchema = TypeSchema {
    kind: Kind::Medium,
    name: "homogeneous",
    doc: "Absorbs and scatters light, the same everywhere: coloured glass, water, milk, smoke. As the `interior` \
         of a material it fills things; as the `atmosphere` of the render it fills everything around them. Give \
         either `sigma_a` and `sigma_s`, or `mean_free_path` and `albedo`.",
    example: "medium amber: homogeneous { sigma_a = (0.5, 2, 9)/m }",
    fields: &[
        Field::new(
            "sigma_a",
            FieldType::Spectrum(COEFFICIENT),
            Default::Absent("absorbs nothing, unless `mean_free_path` says otherwise"),
            "Absorption: over a length d the share exp(-sigma_a d) of the light is left.",
        )
        .typical("clear water (0.35, 0.06, 0.025)/m")
        .foreign(SIGMA_A_NAMES),
        Field::new(
            "sigma_s",
            FieldType::Spectrum(COEFFICIENT),
            Default::Absent("scatters nothing, unless `mean_free_path` says otherwise"),
            "Scattering: how often light changes its direction in one metre.",
        )
        .typical("whole milk (2550, 3210, 3770)/m")
        .foreign(&[
            ("scattering", "LuxCore"),
            ("scattering_coefficient", "common use"),
            ("sigmaS", "Mitsuba 0.6"),
        ]),
        Field::new(
            "mean_free_path",
            FieldType::Spectrum(Bounds::above(Dim::LENGTH, "m", 0.0)),
            Default::Absent("`sigma_a` and `sigma_s` decide"),
            "How far light gets on average before it is absorbed or scattered.",
        )
        .typical("murky water (0.9, 2.1, 2.6)m")
        .foreign(&[("mfp", "pbrt")]),
        Field::new(
            "albedo",
            FieldType::Color(1.0),
            Default::Absent("`sigma_a` and `sigma_s` decide"),
            "Share of that light which is scattered and not absorbed.",
        )
        .foreign(&[("single_scattering_albedo", "common use")]),
        Field::new(
            "g",
            FieldType::Number(Bounds::number(-1.0, 1.0)),
            Default::Number(0.0),
            "Mean cosine of scattering: 1 straight on, 0 evenly, -1 straight back (Henyey-Greenstein).",
        )
        .typical("fog 0.85, skin 0.8, smoke 0.4")
        .foreign(&[("anisotropy", "Blender"), ("asymmetry", "LuxCore"), ("phase_g", "common use")]),
        SKY_DISTANCE,
    ],
    foreign: &[
        ("volume", "Blender and LuxCore"),
        ("scattering", "common use"),
        ("heterogeneous", "pbrt and Mitsuba"),
        ("clear", "LuxCore"),
    ],
};

const FOG: TypeSchema = TypeSchema {
    kind: Kind::Medium,
    name: "fog",
    doc: "Haze without noise: every segment of every path loses the share 1 - exp(-density d) of its light, \
         whatever the path is inside of, and gets as much of `color` instead. Light does not scatter in it: no \
         beams, no glow around lamps; for those use `homogeneous`. Only as `atmosphere` of the render.",
    example: "medium mist: fog { visibility = 180m, color = linear(0.6, 0.65, 0.7) }",
    fields: &[
        Field::new(
            "visibility",
            FieldType::Number(Bounds::above(Dim::LENGTH, "m", 0.0)),
            Default::Absent("`density` decides"),
            "Where 2% of the contrast is left: density = 3.912 / visibility (Koschmieder 1924).",
        )
        .typical("clear air 40km, haze 5km, fog 500m, dense fog 50m"),
        Field::new(
            "density",
            FieldType::Number(COEFFICIENT),
            Default::Absent("`visibility` decides"),
            "Extinction.",
        )
        .typical("0.0001/m to 0.001/m")
        .foreign(&[("sigma_t", "Mitsuba"), ("extinction", "common use")]),
        Field::new(
            "color",
            FieldType::Color(ANY),
            Default::Required,
            "Radiance of the fog where it is thick, on the scale of the sky's.",
        )
        .typical("that of the sky at the horizon"),
        SKY_DISTANCE,
    ],
    foreign: &[("mist", "Blender"), ("haze", "common use"), ("atmosphere", "common use")],
};
