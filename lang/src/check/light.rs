//! `light` fields become radiance and a place.

use super::brightness::{self, Emitter};
use super::exclusive::one_of;
use super::fields::Fields;
use super::linked;
use super::transform::{self, Pose, Way};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::eval::Evaluator;
use crate::material::{Brightness, Color, Emissive, Scalar};
use crate::resolve::ItemId;
use crate::scene::{
    Beam, ColorSpace, Directional, Light, LightLinks, Name, Profile, Rgb, Shape, Tint,
};
use crate::schema::Kind;
use crate::schema::light::LightType;
use std::f64::consts::PI;

/// What a declared light is in the scene.
pub(super) enum Lit {
    /// A sphere light.
    Ball(Box<Light>),
    /// A light at infinity.
    Directional(Box<Directional>),
    /// A thing that glows.
    Panel(Box<Panel>),
    /// What a thing in the world is made of that glows.
    Glow(Box<Emissive>),
}

/// A flat light: an instance and its material.
pub(super) struct Panel {
    pub(super) name: Name,
    pub(super) shape: Shape,
    pub(super) pose: Pose,
    pub(super) material: Emissive,
    /// Only the largest disk in it is there.
    pub(super) round: bool,
    pub(super) group: Option<String>,
    pub(super) links: Option<LightLinks>,
}

/// Whether these are the fields of a light that is placed in the world as instances are.
pub(super) fn is_thing(fields: &Fields) -> bool {
    fields.schema.kind == Kind::Light && matches!(LightType::of(fields.schema), LightType::Mesh)
}

/// Checks how the fields of a light go together.
pub(super) fn check_light(ev: &mut Evaluator<'_>, id: ItemId, fields: &Fields) {
    brightness::check(ev, fields);
    linked::check(ev, fields);
    match LightType::of(fields.schema) {
        LightType::Sphere => check_sphere(ev, id, fields),
        LightType::Point => check_point(ev, id, fields),
        LightType::Spot => {
            check_brightness(ev, id, fields);
            check_facing(ev, fields);
            check_edge(ev, fields);
        }
        LightType::Directional => {
            check_named_brightness(ev, id, fields, ["illuminance", "strength"]);
            check_direction(ev, fields, "direction");
        }
        LightType::Rectangle | LightType::Disk => check_facing(ev, fields),
        LightType::Mesh => {}
    }
}

fn check_brightness(ev: &mut Evaluator<'_>, id: ItemId, fields: &Fields) {
    check_named_brightness(ev, id, fields, ["power", "intensity"]);
}

/// Reports a light that has neither of two fields, where nothing is a good default.
fn check_named_brightness(
    ev: &mut Evaluator<'_>,
    id: ItemId,
    fields: &Fields,
    [one, other]: [&'static str; 2],
) {
    if fields.span(one).or(fields.span(other)).is_none() {
        let text = format!("`{}` is missing `{one}` or `{other}`", ev.program.name(id));
        let error = Diagnostic::error(Code("E0207"), text)
            .at(ev.program.name_span(id), "how bright is it?")
            .with_help(format!("for example: {}", fields.schema.example));
        ev.fault(error);
    }
}

/// A bulb, or a luminaire.
fn check_point(ev: &mut Evaluator<'_>, id: ItemId, fields: &Fields) {
    let Some(profile) = fields.item("profile") else {
        check_brightness(ev, id, fields);
        for name in ["profile.scale", "to", "direction", "spin"] {
            if let Some(span) = fields.span(name) {
                let text = format!("`{name}` does nothing without `profile`");
                let error = Diagnostic::error(Code("E0207"), text)
                    .at(span, "this light is the same in all directions")
                    .with_help("leave it out; a `spot` is a lamp that shines into a cone");
                ev.fault(error);
            }
        }
        return;
    };
    for name in ["power", "intensity"] {
        one_of(ev, fields, &["profile", name], "how bright the light is");
    }
    check_facing(ev, fields);
    if let (Some(info), Some(span)) = (ev.textures.get(&profile), fields.value_span("profile"))
        && info.space != ColorSpace::Linear
    {
        let text = "`profile` wants linear values";
        let error = Diagnostic::error(Code("E0601"), text)
            .at(span, "used as light by direction here")
            .because(info.space_span, "tagged here")
            .with_fix(Fix::guess("write `space: linear`", info.space_value, "linear"));
        ev.fault(error);
    }
}

fn check_edge(ev: &mut Evaluator<'_>, fields: &Fields) {
    if let (Some(cone), Some(edge), Some(span)) =
        (fields.number("cone"), fields.number("edge"), fields.span("edge").or(fields.span("cone")))
        && edge > cone
    {
        let error = Diagnostic::error(Code("E0401"), "`edge` is larger than `cone`");
        let text = "the light falls off inside of the cone";
        ev.fault(error.at(span, text).with_help("write an `edge` of at most `cone`"));
    }
}

fn check_facing(ev: &mut Evaluator<'_>, fields: &Fields) {
    one_of(ev, fields, &["to", "direction"], "which way the light faces");
    check_direction(ev, fields, "direction");
    if let (Some(at), Some(to), Some(span)) =
        (fields.vector::<3>("at"), fields.vector::<3>("to"), fields.value_span("to"))
        && length([0, 1, 2].map(|axis| to[axis] - at[axis])) == 0.0
    {
        let error = Diagnostic::error(Code("E0401"), "`to` is where the light is");
        ev.fault(error.at(span, "faces nothing"));
    }
}

fn check_sphere(ev: &mut Evaluator<'_>, id: ItemId, fields: &Fields) {
    for (pair, what) in [
        (["center", "direction"], "where the light is"),
        (["center", "distance"], "where the light is"),
        (["radius", "angular_radius"], "how large the light is"),
    ] {
        if !one_of(ev, fields, &pair, what) {
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
pub(super) fn light(ev: &mut Evaluator<'_>, name: Name, fields: &Fields) -> Option<Lit> {
    match LightType::of(fields.schema) {
        LightType::Sphere => {
            let (center, radius) = place(fields)?;
            ball(ev, name, fields, (center, radius), (tint(fields, center), None))
        }
        LightType::Point => {
            let place = (fields.vector("at")?, fields.number("radius")?);
            if fields.has("profile") {
                return luminaire(ev, name, fields, place);
            }
            ball(ev, name, fields, place, (None, None))
        }
        LightType::Spot => {
            let place = (fields.vector("at")?, fields.number("radius")?);
            let (cone, edge) = (fields.number("cone")?, fields.number("edge")?);
            let direction = facing(fields, place.0)?;
            let (inner, outer) = (libm::cos(cone - edge), libm::cos(cone).max(0.0));
            ball(ev, name, fields, place, (None, Some(Beam { direction, inner, outer })))
        }
        LightType::Directional => directional(ev, name, fields),
        LightType::Rectangle => {
            let size: [f64; 2] = fields.vector("size")?;
            let form = Form { size, area: size[0] * size[1], spin: fields.number("spin")? };
            panel(ev, name, fields, &form).map(|panel| Lit::Panel(Box::new(panel)))
        }
        LightType::Disk => {
            let radius = fields.number("radius")?;
            let form = Form { size: [2.0 * radius; 2], area: PI * radius * radius, spin: 0.0 };
            let panel = Panel { round: true, ..panel(ev, name, fields, &form)? };
            Some(Lit::Panel(Box::new(panel)))
        }
        LightType::Mesh => {
            if fields.has("power") {
                let (color, watts) = brightness::watts(ev, fields)?;
                let brightness = Brightness::Power(watts);
                return Some(Lit::Glow(Box::new(Emissive { brightness, ..glow(fields, color)? })));
            }
            let radiance = brightness::radiance(ev, &name, fields, Emitter::default())?;
            Some(Lit::Glow(Box::new(glow(fields, radiance)?)))
        }
    }
}

fn directional(ev: &mut Evaluator<'_>, name: Name, fields: &Fields) -> Option<Lit> {
    let direction = unit(fields.vector("direction")?)?;
    let half_angle = 0.5 * fields.number("angular_diameter")?;
    // The integral of the cosine over a cone around the normal.
    let sine = libm::sin(half_angle);
    let emitter = Emitter { irradiance: PI * sine * sine, ..Emitter::default() };
    let radiance = brightness::radiance(ev, &name, fields, emitter)?;
    let group = fields.text("group");
    let links = linked::links(ev, fields);
    let visible = fields.word("visible")? == "on";
    let light = Directional { name, direction, half_angle, radiance, visible, group, links };
    Some(Lit::Directional(Box::new(light)))
}

fn ball(
    ev: &mut Evaluator<'_>,
    name: Name,
    fields: &Fields,
    (center, radius): ([f64; 3], f64),
    (tint, beam): (Option<Tint>, Option<Beam>),
) -> Option<Lit> {
    // A disk of radiance L seen from everywhere.
    let (flux, intensity) = (4.0 * PI * PI * radius * radius, PI * radius * radius);
    let flux = flux * beam.map_or(1.0, |beam| beam.share());
    let emitter = Emitter { flux, intensity, ..Emitter::default() };
    let radiance = brightness::radiance(ev, &name, fields, emitter)?;
    let velocity = fields.vector("velocity")?;
    let group = fields.text("group");
    let visible = fields.word("visible")? == "on";
    let light = Light {
        name,
        center,
        velocity,
        radius,
        radiance,
        tint,
        beam,
        profile: None,
        visible,
        group,
        links: linked::links(ev, fields),
    };
    Some(Lit::Ball(Box::new(light)))
}

/// A small sphere whose brightness by direction is an image, of which only the scene knows the index.
fn luminaire(
    ev: &mut Evaluator<'_>,
    name: Name,
    fields: &Fields,
    (center, radius): ([f64; 3], f64),
) -> Option<Lit> {
    let radiance = brightness::of_profile(ev, fields, PI * radius * radius)?;
    let direction = facing(fields, center)?;
    let matrix = transform::facing(center, direction, fields.number("spin")?);
    let first = matrix.map(|row| row[0]);
    Some(Lit::Ball(Box::new(Light {
        name,
        center,
        velocity: fields.vector("velocity")?,
        radius,
        radiance,
        tint: None,
        beam: None,
        profile: Some(Profile { texture: 0, direction, first }),
        visible: fields.word("visible")? == "on",
        group: fields.text("group"),
        links: linked::links(ev, fields),
    })))
}

/// The unit vector along which a light at `at` shines.
fn facing(fields: &Fields, at: [f64; 3]) -> Option<[f64; 3]> {
    unit(match fields.vector::<3>("to") {
        Some(to) => [0, 1, 2].map(|axis| to[axis] - at[axis]),
        None => fields.vector("direction")?,
    })
}

/// What a flat light looks like.
struct Form {
    /// Width and height, metres.
    size: [f64; 2],
    /// What of it shines, square metres.
    area: f64,
    /// Radians.
    spin: f64,
}

fn panel(ev: &mut Evaluator<'_>, name: Name, fields: &Fields, form: &Form) -> Option<Panel> {
    let Form { size, area, spin } = *form;
    let both_sides = fields.word("sides")? == "both";
    // A side of radiance L gives off pi L watts for each square metre.
    let flux = PI * area * if both_sides { 2.0 } else { 1.0 };
    let emitter = Emitter { flux, intensity: area, ..Emitter::default() };
    let radiance = brightness::radiance(ev, &name, fields, emitter)?;
    let at = fields.vector::<3>("at")?;
    let pose = Pose {
        matrix: transform::facing(at, facing(fields, at)?, spin),
        velocity: fields.vector("velocity")?,
        way: Way::Still,
    };
    let material = glow(fields, radiance)?;
    let (group, links) = (fields.text("group"), linked::links(ev, fields));
    let shape = Shape::Rectangle { size };
    Some(Panel { name, shape, pose, material, round: false, group, links })
}

/// The material of a thing of this radiance.
fn glow(fields: &Fields, radiance: Rgb) -> Option<Emissive> {
    Some(Emissive {
        color: Color::Constant(radiance),
        brightness: Brightness::Strength(1.0),
        both_sides: fields.word("sides")? == "both",
        visible: fields.word("visible")? == "on",
        alpha: Scalar::Constant(1.0),
        alpha_clip: None,
    })
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
