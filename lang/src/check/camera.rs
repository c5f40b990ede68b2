//! Camera fields become angles, radii and sizes.

use super::exclusive::{one_of, one_of_noting};
use super::fields::{Fields, moments};
use super::light::unit;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::scene::{
    Camera, CameraKey, CameraOfFile, FieldOfView, Film, Fit, LensSpec, MIN_UP_SINE, Name, Opening,
    Projection, Side, across_other, at_time,
};
use crate::schema;
use crate::schema::camera::CameraType;
use crate::units::{self, Dim};

/// Focal length when nothing is said, metres.
const DEFAULT_LENS: f64 = 0.05;

/// From where a camera looks at what it frames when nothing is said: the front, the right and above.
const FRONT: [f64; 3] = [0.6, 0.45, 1.0];

/// Checks how the fields of a camera go together.
pub(super) fn check(ev: &mut Evaluator<'_>, fields: &Fields) {
    let fov = ["lens", "fov.horizontal", "fov.vertical"];
    one_of_noting(ev, fields, &fov, "the field of view", |earlier| match earlier {
        "lens" => lens_note(fields),
        _ => String::new(),
    });
    one_of(ev, fields, &["f_stop", "aperture"], "the opening of the lens");
    one_of(ev, fields, &["width", "height"], "the size of the view");
    check_blades(ev, fields);
    let times = moments_of(fields);
    if let (Some(span), [_, ..]) = (fields.span("fit").filter(|_| fields.has("fit")), &*times) {
        let text = "a camera that frames something cannot have keys";
        let error =
            Diagnostic::error(Code("E0704"), text).at(span, "the camera is put where it fits");
        ev.fault(error.with_help("leave out `fit`, or give `from` and `to` one value each"));
        return;
    }
    let times = if times.is_empty() { vec![0.0] } else { times };
    for time in times {
        let places = ["from", "to"].map(|name| fields.triple_at(name, time));
        let [Some(from), Some(to)] = places else { return };
        if !check_view(ev, fields, from, to) {
            return;
        }
    }
}

/// The moments of the keys of a camera, none for one that stands still.
fn moments_of(fields: &Fields) -> Vec<f64> {
    let keys = ["from", "to"].map(|name| fields.keys(name));
    moments(keys.iter().flatten().map(|keys| &**keys))
}

/// Reports a view that has no direction, or no upper side; says whether there is neither.
fn check_view(ev: &mut Evaluator<'_>, fields: &Fields, from: [f64; 3], to: [f64; 3]) -> bool {
    let Some(span) = fields.span("to") else { return true };
    let Some(view) = unit(sub(to, from)) else {
        let error = Diagnostic::error(Code("E0704"), "the camera looks at the point where it is")
            .at(span, "the same point");
        let error = match fields.span("from") {
            Some(from) => error.because(from, "the camera is here"),
            None => error,
        };
        ev.fault(error);
        return false;
    };
    let Some(up) = fields.vector::<3>("up") else { return true };
    let sine = unit(up).map_or(0.0, |up| length(cross(view, up)));
    if sine < MIN_UP_SINE {
        let at = fields.span("up").unwrap_or(span);
        let text = "the camera looks along its own `up`";
        let error = Diagnostic::error(Code("E0704"), text)
            .at(at, "which way is up in the image?")
            .with_help("for a view straight down write `up = (0, 0, -1)`");
        ev.fault(error);
        return false;
    }
    true
}

/// Blades shape an opening, and are what is turned.
fn check_blades(ev: &mut Evaluator<'_>, fields: &Fields) {
    let opens = fields.has("f_stop") || fields.has("aperture");
    for (name, needs, is_there) in [
        ("blades", "`f_stop` or `aperture`", opens),
        ("rotation", "`blades`", fields.has("blades")),
    ] {
        let Some(span) = fields.span(name).filter(|_| fields.has(name) && !is_there) else {
            continue;
        };
        let error =
            Diagnostic::error(Code("E0207"), format!("`{name}` does nothing without {needs}"))
                .at(span, "nothing to shape");
        ev.fault(error.with_help(format!("write {needs}, or leave this out")));
    }
}

/// What the lens sees: `50mm on a 36mm sensor: 39.6deg across, 22.9deg up at 16:9`.
fn lens_note(fields: &Fields) -> String {
    let (Some(lens), Some(width)) = (fields.number("lens"), fields.number("sensor.width")) else {
        return String::new();
    };
    let millimetres = |metres: f64| format!("{}mm", units::show_number(round(metres * 1e3, 1e3)));
    let across = 2.0 * libm::atan(0.5 * width / lens);
    let up = across_other(across, 9.0 / 16.0);
    format!(
        "{} on a {} sensor: {} across, {} up at 16:9",
        millimetres(lens),
        millimetres(width),
        degrees(across),
        degrees(up)
    )
}

fn degrees(radians: f64) -> String {
    format!("{}deg", round(radians.to_degrees(), 10.0))
}

fn round(value: f64, steps: f64) -> f64 {
    (value * steps).round() / steps
}

/// How the camera frames an instance.
fn fit(instance: Name, fields: &Fields) -> Fit {
    let side = match (fields.has("from"), fields.has("to")) {
        (true, false) => Side::From,
        _ => Side::Along,
    };
    Fit { instance, side, has_focus: fields.has("focus") }
}

/// Where the camera is; for one that frames something where it looks from.
fn place(fields: &Fields, fit: Option<&Fit>) -> Option<[[f64; 3]; 2]> {
    match (point(fields, "from", 0.0), point(fields, "to", 0.0), fit) {
        (Some(from), Some(to), _) => Some([from, to]),
        (Some(from), None, Some(_)) => {
            let [x, y, z] = from;
            Some([from, [x - FRONT[0], y - FRONT[1], z - FRONT[2]]])
        }
        (None, _, Some(_)) => Some([FRONT, [0.0; 3]]),
        _ => None,
    }
}

/// Where `from` or `to` is at some moment; anywhere, if a file is to say it.
fn point(fields: &Fields, name: &str, time: f64) -> Option<[f64; 3]> {
    let unknown = || if name == "from" { FRONT } else { [0.0; 3] };
    fields.triple_at(name, time).or_else(|| fields.of_file.as_ref().map(|_| unknown()))
}

/// Builds the camera; `framed`: the instance that it names. `None` only for fields with faults.
pub(super) fn camera(
    name: Name,
    framed: Option<Name>,
    fields: &Fields,
    film: &Film,
) -> Option<Camera> {
    let fit = framed.map(|instance| fit(instance, fields));
    let shutter = match fields.get("shutter") {
        Some(crate::eval::value::Value::Range(open, close, _)) => [open, close],
        _ => [0.0; 2],
    };
    let keys: Vec<CameraKey> = moments_of(fields)
        .into_iter()
        .map(|time| {
            let [from, to] = ["from", "to"].map(|name| point(fields, name, time));
            Some(CameraKey { time, from: from?, to: to? })
        })
        .collect::<Option<_>>()?;
    let [from, to] = match keys.as_slice() {
        [] => place(fields, fit.as_ref())?,
        keys => {
            let key = at_time(keys, shutter[0]);
            [key.from, key.to]
        }
    };
    let aspect = f64::from(film.size[1]) / f64::from(film.size[0]);
    let projection = match CameraType::of(fields.schema) {
        CameraType::Perspective => {
            Projection::Perspective(lens_spec(fields)?.lens(aspect, length(sub(to, from))))
        }
        CameraType::Orthographic => {
            let size = match (fields.number("width"), fields.number("height")) {
                (Some(width), _) => Some([width, width * aspect]),
                (None, Some(height)) => Some([height / aspect, height]),
                (None, None) => None,
            };
            Projection::Orthographic { size, aspect }
        }
        CameraType::Panoramic => {
            Projection::Panoramic { fov_horizontal: fields.number("fov.horizontal")? }
        }
    };
    let of_file = match fields.file_base(&|_| 0) {
        Some(base) => Some(CameraOfFile { base, lens: lens_spec(fields)? }),
        None => None,
    };
    let up = fields.vector("up").or(of_file.as_ref().map(|_| [0.0, 1.0, 0.0]))?;
    let follows = !fields.has("focus");
    Some(Camera { name, fit, from, to, up, projection, shutter, keys, follows, of_file })
}

/// What a camera says of its lens. `None` only for fields with faults.
fn lens_spec(fields: &Fields) -> Option<LensSpec> {
    let view = match (fields.number("fov.horizontal"), fields.number("fov.vertical")) {
        (Some(across), _) => FieldOfView::Horizontal(across),
        (None, Some(up)) => FieldOfView::Vertical(up),
        (None, None) => FieldOfView::FocalLength(fields.number("lens").unwrap_or(DEFAULT_LENS)),
    };
    let opening = match (fields.number("aperture"), fields.number("f_stop")) {
        (Some(opening), _) => Opening::Diameter(opening),
        (None, Some(f_stop)) => Opening::FStop(f_stop),
        (None, None) => Opening::Diameter(0.0),
    };
    Some(LensSpec {
        sensor: fields.number("sensor.width")?,
        view,
        opening,
        blades: fields.integer("blades"),
        rotation: fields.number("rotation")?,
        focus_distance: fields.number("focus"),
    })
}

/// Reports angles, sizes and distances that cannot be drawn, or that the film makes impossible.
pub(super) fn check_built(ev: &mut Evaluator<'_>, camera: &Camera) {
    let (sees, help) = match &camera.projection {
        Projection::Perspective(lens) => {
            let Some(sees) = lens.beyond_drawing() else { return };
            (sees, "choose another field of view, or a film that is less narrow")
        }
        Projection::Orthographic { size: Some(size), .. } => {
            let sound = |side: &f64| (1e-9..schema::MAX_MAGNITUDE).contains(side);
            if size.iter().all(sound) {
                return;
            }
            let [across, up] = size.map(|side| units::show(side, Dim::LENGTH));
            (
                format!("{across} across and {up} up"),
                "choose another size, or a film that is less narrow",
            )
        }
        Projection::Orthographic { size: None, .. } if camera.fit.is_some() => return,
        Projection::Orthographic { size: None, .. } => {
            let text = format!("`{}` does not say how much it sees", camera.name.text);
            let error = Diagnostic::error(Code("E0704"), text).at(camera.name.span, "this camera");
            ev.fault(error.with_help("write `height = 4m`, `width = 6m`, or `fit = ` an instance"));
            return;
        }
        Projection::Panoramic { fov_horizontal } => {
            if *fov_horizontal > 1e-9 {
                return;
            }
            (units::show(*fov_horizontal, Dim::ANGLE) + " across", "choose another field of view")
        }
    };
    let text = format!("`{}` sees {sees}, which cannot be drawn", camera.name.text);
    let error = Diagnostic::error(Code("E0704"), text).at(camera.name.span, "this camera");
    ev.fault(error.with_help(help));
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn length(v: [f64; 3]) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}
