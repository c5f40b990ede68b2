//! How bright a light is said to be → its radiance.
//!
//! It knows sizes of emitters only as factors: watts, and watts per steradian, for each unit of radiance.

use super::exclusive::one_of;
use super::fields::Fields;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::eval::color::{LUMINANCE, blackbody};
use crate::scene::{Name, Rgb};
use crate::units::Dim;

/// Lumens to the watt of luminous power: the luminous efficacy of light of 540 THz, which defines the candela
/// (SI Brochure, 9th edition, 2.3.1).
pub(super) const EFFICACY: f64 = 683.0;

/// What says how bright a light is, in the order of the reference.
const FIELDS: [&str; 4] = ["strength", "intensity", "power", "illuminance"];

/// An evenly glowing surface: what it gives off for each W/(m2 sr) of radiance.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Emitter {
    /// In all directions: m2 sr.
    pub(super) flux: f64,
    /// In the direction in which it is strongest: m2.
    pub(super) intensity: f64,
    /// On a plane that faces it: sr. Of lights at infinity, which have no size.
    pub(super) irradiance: f64,
}

/// Reports a light that says its brightness or its colour twice.
pub(super) fn check(ev: &mut Evaluator<'_>, fields: &Fields) {
    one_of(ev, fields, &FIELDS, "how bright the light is");
    one_of(ev, fields, &["color", "temperature"], "the colour of the light");
}

/// The radiance of a light, W/(m2 sr) up to the scale of the scene. `None` only for fields with faults.
pub(super) fn radiance(
    ev: &mut Evaluator<'_>,
    name: &Name,
    fields: &Fields,
    emitter: Emitter,
) -> Option<Rgb> {
    let color = color(fields)?;
    let field = FIELDS.into_iter().find(|field| fields.has(field));
    let (value, dim) = fields.quantity(field.unwrap_or("strength"))?;
    let per_radiance = match field {
        Some("power") => emitter.flux,
        Some("intensity") => emitter.intensity,
        Some("illuminance") => emitter.irradiance,
        _ => 1.0,
    };
    let mut scale = value / per_radiance;
    if is_luminous(dim) {
        let luminance = luminance(color);
        if luminance == 0.0 {
            return black(ev, fields, field.unwrap_or("strength"));
        }
        scale /= EFFICACY * luminance;
    }
    let radiance = color.map(|c| c * scale);
    if !radiance.iter().all(|c| *c <= crate::schema::MAX_MAGNITUDE) {
        let text = format!("`{}` is too bright: its radiance is {:e}", name.text, radiance[0]);
        let error = Diagnostic::error(Code("E0402"), text).at(name.span, "this light");
        ev.fault(error.with_help("a larger light spreads the same `power`"));
        return None;
    }
    Some(radiance)
}

/// Colour and `power` of a light whose size only its meshes say: watts, for each channel that is 1. `None` only for fields
/// with faults.
pub(super) fn watts(ev: &mut Evaluator<'_>, fields: &Fields) -> Option<(Rgb, f64)> {
    let color = color(fields)?;
    let (value, dim) = fields.quantity("power")?;
    if !is_luminous(dim) {
        return Some((color, value));
    }
    let luminance = luminance(color);
    if luminance == 0.0 {
        return black(ev, fields, "power").map(|color| (color, 0.0));
    }
    Some((color, value / (EFFICACY * luminance)))
}

/// Candelas of the value 1 of a profile.
const PROFILE_UNIT: f64 = 1000.0;

/// The radiance of a light with a profile where that is 1; `area`: what of it is seen, m2. `None` only for fields with
/// faults.
pub(super) fn of_profile(ev: &mut Evaluator<'_>, fields: &Fields, area: f64) -> Option<Rgb> {
    let color = color(fields)?;
    let luminance = luminance(color);
    if luminance == 0.0 {
        return black(ev, fields, "profile");
    }
    let scale = fields.number("profile.scale")? * PROFILE_UNIT / (EFFICACY * luminance * area);
    Some(color.map(|c| c * scale))
}

/// `profile.scale` of a ball of this radius, in metres, whose radiance `of_profile` gave.
pub(crate) fn profile_scale(radiance: Rgb, radius: f64) -> f64 {
    luminance(radiance) * EFFICACY * std::f64::consts::PI * radius * radius / PROFILE_UNIT
}

/// The colour of a light.
fn color(fields: &Fields) -> Option<Rgb> {
    match fields.number("temperature") {
        Some(kelvin) => Some(blackbody(kelvin)),
        None => fields.color("color"),
    }
}

fn luminance(color: Rgb) -> f64 {
    color.iter().zip(LUMINANCE).map(|(c, y)| c * y).sum()
}

fn is_luminous(dim: Dim) -> bool {
    [Dim::LUMINOUS_FLUX, Dim::LUMINOUS_INTENSITY, Dim::ILLUMINANCE, Dim::LUMINANCE].contains(&dim)
}

fn black(ev: &mut Evaluator<'_>, fields: &Fields, field: &str) -> Option<Rgb> {
    let text = format!("a black light has no `{field}` in these units");
    let span = fields.span("color").or(fields.span(field))?;
    ev.fault(
        Diagnostic::error(Code("E0401"), text)
            .at(span, "black")
            .with_note("lumens, candelas and lux are what eyes see of the light's colour"),
    );
    None
}
