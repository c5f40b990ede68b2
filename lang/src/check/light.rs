//! `light` and `sky` fields become radiance.

use super::fields::Fields;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::scene::{Light, Name, Rgb, Sky, SkyModel};

/// Checks how the fields of a light go together.
pub(super) fn check_light(ev: &mut Evaluator<'_>, fields: &Fields) {
    if let (Some(strength), Some(power)) = (fields.span("strength"), fields.span("power"))
        && fields.has("strength")
        && fields.has("power")
    {
        let text = "`strength` and `power` both set how bright the light is";
        let error = Diagnostic::error(Code("E0703"), text)
            .at(power, "keep one of them")
            .because(strength, "this is the radiance of its surface");
        ev.fault(error);
    }
}

/// Builds a light. `None` only for fields with faults.
pub(super) fn light(ev: &mut Evaluator<'_>, name: Name, fields: &Fields) -> Option<Light> {
    let radius = fields.number("radius")?;
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
    Some(Light { name, center: fields.vector("center")?, radius, radiance })
}

/// Checks how the fields of a sky go together.
pub(super) fn check_sky(ev: &mut Evaluator<'_>, fields: &Fields) {
    if fields.schema.name != "gradient" {
        return;
    }
    if !fields.has("sun.direction") {
        for name in ["glow.color", "glow.power", "disc.color", "disc.power"] {
            if let Some(span) = fields.span(name).filter(|_| fields.has(name)) {
                let text = format!("`{name}` does nothing without `sun.direction`");
                let error = Diagnostic::error(Code("E0207"), text)
                    .at(span, "around which direction?")
                    .with_help("write `sun.direction = (0.69, 0.2, -0.69)`, or leave this out");
                ev.fault(error);
                return;
            }
        }
    }
    if let (Some(direction), Some(span)) =
        (fields.vector::<3>("sun.direction"), fields.value_span("sun.direction"))
        && direction.iter().all(|c| *c == 0.0)
    {
        let text = "`sun.direction` has length zero";
        ev.fault(Diagnostic::error(Code("E0401"), text).at(span, "points nowhere"));
    }
}

/// Builds a sky. `None` only for fields with faults.
pub(super) fn sky(name: Name, fields: &Fields) -> Option<Sky> {
    let strength = fields.number("strength")?;
    let color = |field: &str| Some(scaled(fields.color(field)?, strength));
    if fields.schema.name == "constant" {
        return Some(Sky { name, model: SkyModel::Constant(color("color")?) });
    }
    let direction = fields.vector::<3>("sun.direction");
    let around_sun = |field: &str| match direction {
        Some(_) => color(field),
        None => Some([0.0; 3]),
    };
    let model = SkyModel::Gradient {
        zenith: color("zenith")?,
        middle: color("middle")?,
        horizon: color("horizon")?,
        ground: color("ground")?,
        blend_high: fields.number("blend.high")?,
        blend_low: fields.number("blend.low")?,
        sun_direction: unit(direction.unwrap_or([0.0, 1.0, 0.0]))?,
        glow: around_sun("glow.color")?,
        glow_power: fields.number("glow.power")?,
        disc: around_sun("disc.color")?,
        disc_power: fields.number("disc.power")?,
    };
    Some(Sky { name, model })
}

/// Is it black everywhere?
pub(super) fn is_black(sky: &Sky) -> bool {
    let black = |rgb: &Rgb| rgb.iter().all(|c| *c == 0.0);
    match &sky.model {
        SkyModel::Constant(rgb) => black(rgb),
        SkyModel::Gradient { zenith, middle, horizon, ground, glow, disc, .. } => {
            [zenith, middle, horizon, ground, glow, disc].into_iter().all(black)
        }
    }
}

fn scaled(rgb: Rgb, factor: f64) -> Rgb {
    rgb.map(|c| c * factor)
}

/// The unit vector of this direction, also of very short and very long ones.
pub(super) fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    if largest == 0.0 {
        return None;
    }
    let v = v.map(|c| c / largest);
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    Some(v.map(|c| c / length))
}
