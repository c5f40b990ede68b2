//! `light` fields become radiance.

use super::fields::Fields;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::resolve::ItemId;
use crate::scene::{Light, Name, Rgb, Tint};
use crate::schema::light::LightType;

/// Checks how the fields of a light go together.
pub(super) fn check_light(ev: &mut Evaluator<'_>, id: ItemId, fields: &Fields) {
    let both = |a: &str, b: &str| {
        let written = fields.has(a) && fields.has(b);
        written.then_some(())?;
        Some((fields.span(a)?, fields.span(b)?))
    };
    for (a, b, what) in [
        ("strength", "power", "how bright the light is"),
        ("center", "direction", "where the light is"),
        ("center", "distance", "where the light is"),
        ("radius", "angular_radius", "how large the light is"),
    ] {
        if let Some((first, second)) = both(a, b) {
            let text = format!("`{a}` and `{b}` both set {what}");
            let error = Diagnostic::error(Code("E0703"), text)
                .at(second, "keep one of them")
                .because(first, "this says it, too");
            ev.fault(error);
            return;
        }
    }
    if let (Some(center), Some(span)) =
        (fields.vector::<3>("center"), fields.span("angular_radius"))
        && fields.has("angular_radius")
        && length(center) == 0.0
    {
        let text = "a light at the origin of the world has no `angular_radius`";
        let error = Diagnostic::error(Code("E0401"), text)
            .at(span, "seen from the origin, it is all around")
            .with_help("write its `radius`");
        ev.fault(error);
    }
    if let Some(lacks) = lacking(fields) {
        let text = format!("`{}` is missing `{lacks}`", ev.program.name(id));
        let error = Diagnostic::error(Code("E0207"), text)
            .at(ev.program.name_span(id), "where is it, and how large?")
            .with_note("a light has `center` and `radius`, or `direction`, `distance` and `angular_radius`")
            .with_help(format!("for example: {}", fields.schema.example));
        ev.fault(error);
    }
    for name in ["tint.angle", "tint.direction"] {
        if let Some(span) = fields.span(name).filter(|_| !fields.has("tint.color")) {
            let text = format!("`{name}` does nothing without `tint.color`");
            let error = Diagnostic::error(Code("E0207"), text)
                .at(span, "tinted with which colour?")
                .with_help("write `tint.color = linear(1, 0.65, 0.22)`, or leave this out");
            ev.fault(error);
        }
    }
    for name in ["direction", "tint.direction"] {
        check_direction(ev, fields, name);
    }
}

/// The first field without which place or size of a light is not known.
fn lacking(fields: &Fields) -> Option<&'static str> {
    // Fields that are wrong have been reported, and are there.
    let lacks = |name: &'static str| fields.span(name).is_none().then_some(name);
    let place = if fields.span("direction").is_some() || fields.span("distance").is_some() {
        lacks("direction").or(lacks("distance"))
    } else {
        lacks("center")
    };
    place.or_else(|| if fields.span("angular_radius").is_some() { None } else { lacks("radius") })
}

/// Reports a direction of length zero.
pub(crate) fn check_direction(ev: &mut Evaluator<'_>, fields: &Fields, name: &str) {
    if let (Some(direction), Some(span)) = (fields.vector::<3>(name), fields.value_span(name))
        && direction.iter().all(|c| *c == 0.0)
    {
        let text = format!("`{name}` has length zero");
        ev.fault(Diagnostic::error(Code("E0401"), text).at(span, "points nowhere"));
    }
}

/// Centre and radius, metres, world frame.
fn place(fields: &Fields) -> Option<([f64; 3], f64)> {
    let center = match fields.vector::<3>("direction") {
        Some(direction) => scaled(unit(direction)?, fields.number("distance")?),
        None => fields.vector("center")?,
    };
    let radius = match fields.number("angular_radius") {
        Some(angle) => libm::sin(angle) * length(center),
        None => fields.number("radius")?,
    };
    Some((center, radius))
}

fn tint(fields: &Fields, center: [f64; 3]) -> Option<Tint> {
    let color = fields.color("tint.color")?;
    // A light at the origin has no direction; any will do, the user can say another.
    let towards = fields.vector("tint.direction").unwrap_or(center);
    let direction = unit(towards).unwrap_or([0.0, 1.0, 0.0]);
    Some(Tint { color, angle: fields.number("tint.angle")?, direction })
}

/// Builds a light. `None` only for fields with faults.
pub(super) fn light(ev: &mut Evaluator<'_>, name: Name, fields: &Fields) -> Option<Light> {
    let LightType::Sphere = LightType::of(fields.schema);
    let (center, radius) = place(fields)?;
    // A sphere of radiance L gives off L * pi * 4 pi r^2 watts.
    let strength = match fields.number("power") {
        Some(power) => {
            power / (4.0 * std::f64::consts::PI * std::f64::consts::PI * radius * radius)
        }
        None => fields.number("strength")?,
    };
    let radiance = scaled(fields.color("color")?, strength);
    if !radiance.iter().all(|c| *c <= crate::schema::MAX_MAGNITUDE) {
        let text = format!("`{}` is too bright: its radiance is {:e}", name.text, radiance[0]);
        let error = Diagnostic::error(Code("E0402"), text).at(name.span, "this light");
        ev.fault(error.with_help("a larger `radius` spreads the same `power`"));
        return None;
    }
    let tint = tint(fields, center);
    let velocity = fields.vector("velocity")?;
    Some(Light { name, center, velocity, radius, radiance, tint })
}

/// Times `factor`.
pub(crate) fn scaled(rgb: Rgb, factor: f64) -> Rgb {
    rgb.map(|c| c * factor)
}

fn length(v: [f64; 3]) -> f64 {
    libm::hypot(libm::hypot(v[0], v[1]), v[2])
}

/// The unit vector of this direction, also of very short and very long ones.
pub(crate) fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    if largest == 0.0 {
        return None;
    }
    let v = v.map(|c| c / largest);
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    Some(v.map(|c| c / length))
}
