//! A camera that is like one of a mesh file.

use glam::DVec3;
use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{
    Camera, CameraKey, CameraOfFile, FieldOfView, FileBase, LensSpec, MIN_UP_SINE, Projection,
    Scene, at_time,
};

use super::named::named;
use crate::import::{FileCamera, FileView, MeshFacts};
use crate::lower::Bounds;

/// Fields of the field of view.
const VIEW: [&str; 3] = ["lens", "fov.horizontal", "fov.vertical"];
/// Fields of the rest of a lens.
const LENS: [&str; 6] = ["sensor.width", "f_stop", "aperture", "focus", "blades", "rotation"];

/// The camera of the scene with what `of_file` takes from its file.
pub(super) fn complete(
    scene: &Scene,
    of_file: &CameraOfFile,
    facts: &MeshFacts,
) -> Result<Camera, Box<Diagnostic>> {
    let base = &of_file.base;
    let cameras = &facts.studio.cameras;
    let names = cameras.iter().map(|camera| camera.name.as_str());
    let file = &cameras[named((scene, base), "camera", names)?[0]];
    let camera = placed(&scene.camera, base, (file, target(file, facts)));
    let keys = camera.keys.iter().map(|key| (key.from, key.to));
    for (from, to) in keys.chain([(camera.from, camera.to)]) {
        check_view((from, to), camera.up, base)?;
    }
    let size = scene.film.size.map(f64::from);
    let aspect = size[1] / size[0];
    let projection = match file.view {
        FileView::Perspective(fov) => perspective(&camera, of_file, fov, aspect)?,
        FileView::Orthographic(height) => {
            refuse_lens(base)?;
            let size = camera.fit.is_none().then_some([height / aspect, height]);
            Projection::Orthographic { size, aspect }
        }
    };
    Ok(Camera { projection, ..camera })
}

/// The point that a camera of a file looks at.
fn target(camera: &FileCamera, facts: &MeshFacts) -> [f64; 3] {
    let bounds = facts.parts.iter();
    let bounds =
        bounds.filter_map(|part| Bounds::of(part.bounds.map(|corner| corner.map(f64::from))));
    match Bounds::union(bounds) {
        Some(whole) => {
            let size = (DVec3::from(whole.hi) - DVec3::from(whole.lo)).length();
            camera.target(size, whole.middle())
        }
        None => camera.target(1.0, [0.0; 3]),
    }
}

/// The camera where it is.
fn placed(camera: &Camera, base: &FileBase, (file, target): (&FileCamera, [f64; 3])) -> Camera {
    let or_else = |field: &str, declared: [f64; 3], own: [f64; 3]| match base.says(field) {
        Some(_) => declared,
        None => own,
    };
    let key = |key: &CameraKey| CameraKey {
        time: key.time,
        from: or_else("from", key.from, file.from),
        to: or_else("to", key.to, target),
    };
    let keys: Vec<CameraKey> = camera.keys.iter().map(key).collect();
    let (from, to) = match keys.as_slice() {
        [] => (or_else("from", camera.from, file.from), or_else("to", camera.to, target)),
        keys => {
            let key = at_time(keys, camera.shutter[0]);
            (key.from, key.to)
        }
    };
    let up = or_else("up", camera.up, file.up);
    Camera { from, to, up, keys, of_file: None, ..camera.clone() }
}

/// A view needs a direction and an upper side.
fn check_view(
    (from, to): ([f64; 3], [f64; 3]),
    up: [f64; 3],
    base: &FileBase,
) -> Result<(), Box<Diagnostic>> {
    let at = ["to", "from", "up"].into_iter().find_map(|field| base.says(field));
    let degenerate = |text: &str, label: &str| {
        let error = Diagnostic::error(Code("E0704"), text);
        Err(Box::new(error.at(at.unwrap_or(base.name.span), label.to_owned())))
    };
    let Some(along) = (DVec3::from(to) - DVec3::from(from)).try_normalize() else {
        return degenerate("the camera looks at the point where it is", "the same point");
    };
    if along.cross(DVec3::from(up).normalize_or_zero()).length() < MIN_UP_SINE {
        return degenerate("the camera looks along its own `up`", "which way is up in the image?");
    }
    Ok(())
}

fn perspective(
    camera: &Camera,
    CameraOfFile { base, lens }: &CameraOfFile,
    fov: f64,
    aspect: f64,
) -> Result<Projection, Box<Diagnostic>> {
    let sees = VIEW.iter().any(|field| base.says(field).is_some());
    let view = if sees { lens.view } else { FieldOfView::Vertical(fov) };
    let distance = DVec3::from(camera.from).distance(camera.to.into());
    let lens = LensSpec { view, ..lens.clone() }.lens(aspect, distance);
    match lens.beyond_drawing() {
        None => Ok(Projection::Perspective(lens)),
        Some(sees) => {
            let text = format!("`{}` sees {sees}, which cannot be drawn", camera.name.text);
            let error = Diagnostic::error(Code("E0704"), text).at(base.name.span, "this camera");
            let help = "choose another field of view, or a film that is less narrow";
            Err(Box::new(error.with_help(help)))
        }
    }
}

/// An orthographic camera has no lens.
fn refuse_lens(base: &FileBase) -> Result<(), Box<Diagnostic>> {
    let said = VIEW.iter().chain(&LENS).find_map(|field| Some((*field, base.says(field)?)));
    let Some((field, at)) = said else { return Ok(()) };
    let text = format!("`{field}` does not go with a camera that is orthographic");
    let error = Diagnostic::error(Code("E0703"), text)
        .at(at, "of a lens")
        .because(base.name.span, "this camera of the file has parallel rays")
        .with_help("leave it out, or declare the camera; `rtc show --assets` prints it to paste");
    Err(Box::new(error))
}
