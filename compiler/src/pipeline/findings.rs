//! What reading files found → diagnostics where the scene names them.

use std::path::Path;

use lang::diagnostic::{Code, Diagnostic, Fix};
use lang::scene::{Asset, Parts, Scene, Shape};
use lang::source::Span;

use crate::counted::counted;
use crate::import::{ErrorKind, ImportError, ImportReport, MeshFacts, Studio};

/// A file that cannot be used, where the scene names it; `written`: its path there.
pub(super) fn failed(error: &ImportError, span: Span, written: &str) -> Diagnostic {
    let code = match error.kind {
        ErrorKind::Missing | ErrorKind::Io | ErrorKind::Outside => "E0514",
        ErrorKind::Format => "E0503",
        ErrorKind::Number => "E0504",
        ErrorKind::Index => "E0505",
        ErrorKind::Accessor => "E0506",
        ErrorKind::Extension => "E0507",
        ErrorKind::Empty => "E0508",
        ErrorKind::Choice => "E0521",
        ErrorKind::Limit | ErrorKind::Memory => "E0509",
        ErrorKind::Image => "E0602",
    };
    let itself = Path::new(&error.place).ends_with(written);
    let message = match error.kind {
        ErrorKind::Missing if itself => format!("there is no file `{written}`"),
        ErrorKind::Missing => format!("`{written}` needs a file that is not there"),
        ErrorKind::Io
        | ErrorKind::Format
        | ErrorKind::Number
        | ErrorKind::Index
        | ErrorKind::Accessor
        | ErrorKind::Extension
        | ErrorKind::Choice
        | ErrorKind::Empty
        | ErrorKind::Limit
        | ErrorKind::Image
        | ErrorKind::Outside
        | ErrorKind::Memory => format!("`{written}` cannot be used"),
    };
    let found = Diagnostic::error(Code(code), message).at(span, "named here");
    let found = found.with_note(error.to_string());
    if error.help.is_empty() { found } else { found.with_help(error.help.clone()) }
}

/// Things that were counted during import and that the user should know.
pub(super) fn report(report: &ImportReport, span: Span, diagnostics: &mut Vec<Diagnostic>) {
    let mut warn = |code, lint, message: String, first: &Option<String>| {
        let warning = Diagnostic::warning(Code(code), lint, message).at(span, "");
        diagnostics.push(match first {
            Some(place) => warning.with_note(format!("the first is at {place}")),
            None => warning,
        });
    };
    let zero = &report.zero_area;
    if zero.count > 0 {
        let what = counted(zero.count, "triangle without area was", "triangles without area were");
        warn("W0520", "zero_area", format!("{what} left out"), &zero.first);
    }
    let needles = &report.needles;
    if needles.count > 0 {
        let what = counted(needles.count, "triangle is", "triangles are");
        let message =
            format!("{what} a needle, more than 1e5 times as long as high: expect noise there");
        warn("W0521", "needles", message, &needles.first);
    }
    let normals = &report.zero_normals;
    if normals.count > 0 {
        let what = counted(normals.count, "normal has", "normals have");
        warn("W0522", "zero_normals", format!("{what} no length and was replaced"), &normals.first);
    }
    if report.clamped_texels > 0 {
        let what = counted(report.clamped_texels, "texel channel was", "texel channels were");
        warn(
            "W0523",
            "clamped_texels",
            format!("{what} clamped to what a half float holds"),
            &None,
        );
    }
    for warning in &report.warnings {
        let message = format!("{}: {}", warning.place, warning.message);
        warn("W0524", "import", message, &None);
    }
    if report.n_untold > 0 {
        let message = format!("{} more things like these are odd in this file", report.n_untold);
        warn("W0524", "import", message, &None);
    }
}

/// That lights and cameras of a file are left out, and where they are to be had. Who takes one of its cameras knows that
/// it has some.
pub(super) fn left_out(studio: &Studio, asset: &Asset, takes_camera: bool) -> Option<Diagnostic> {
    let cameras = if takes_camera { 0 } else { studio.cameras.len() };
    let counts = [(studio.lights.len(), "light", "lights"), (cameras, "camera", "cameras")];
    let found = counts.into_iter().filter(|(n, ..)| *n > 0);
    let list: Vec<String> = found.map(|(n, one, several)| counted(n, one, several)).collect();
    if list.is_empty() {
        return None;
    }
    let one = studio.lights.len() + cameras == 1;
    let (verb, them) = if one { ("is", "it") } else { ("are", "them") };
    let message = format!(
        "{}: {} {verb} left out: `rtc show --assets` prints {them} as text for the scene",
        asset.path,
        list.join(" and ")
    );
    let warning = Diagnostic::warning(Code("W0524"), "import", message).at(asset.path_span, "");
    let named = studio.cameras.iter().find(|camera| !camera.name.contains(['"', '\n']));
    Some(match named.filter(|_| cameras > 0) {
        Some(camera) => {
            let (asset, name) = (&asset.name.text, &camera.name);
            let like = format!("camera eye like {asset}.camera(\"{name}\") {{ }}");
            warning.with_help(format!("to look through its camera: `{like}`"))
        }
        None => warning,
    })
}

/// A part that a file does not have is an unknown name, with the names it has.
pub(super) fn find_parts(
    scene: &Scene,
    assets: &[Option<MeshFacts>],
    diagnostics: &mut Vec<Diagnostic>,
) {
    for instance in &scene.instances {
        let Shape::Mesh { asset, parts: Parts::Named(part) } = &instance.shape else { continue };
        let Some(file) = &assets[*asset] else { continue };
        if !file.find_parts(part).is_empty() {
            continue;
        }
        let names = file.part_names();
        let asset = &scene.assets[*asset];
        let message = format!("`{}` has no part named `{part}`", asset.name.text);
        let mut found = Diagnostic::error(Code("E0521"), message)
            .at(instance.shape_span, "not in the file")
            .because(asset.path_span, "the file");
        if let [similar, ..] = lang::suggest::suggest(part, names.iter().copied()).as_slice() {
            let text = format!("{}.{similar}", asset.name.text);
            let message = format!("a part with a similar name exists: `{similar}`");
            found = found.with_fix(Fix::guess(message, instance.shape_span, text));
        } else {
            found = found.with_note(listed(&names));
        }
        diagnostics.push(found);
    }
}

fn listed(names: &[&str]) -> String {
    const MOST: usize = 12; // a screen line or two
    match names.len() {
        0 => "the file names no parts; use the asset as a whole".to_owned(),
        n if n <= MOST => format!("its parts: {}", names.join(", ")),
        n => format!("its parts: {}, and {} more", names[..MOST].join(", "), n - MOST),
    }
}
