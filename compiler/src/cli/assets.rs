//! `rtc show --assets`: what is in the mesh files of a scene, and their lights and cameras as text to paste.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use lang::Analysis;
use lang::scene::Scene;
use lang::units::show_number;

use super::args::SceneArgs;
use super::bounds::{options, place, rounded};
use super::compile::failed;
use crate::cache::Cache;
use crate::counted::counted;
use crate::import::{FileCamera, FileLight, FileView, LightKind, MeshFacts, PartFacts};
use crate::lower::Bounds;
use crate::pipeline;
use crate::report::Reporter;

/// Lumens in a watt, as programs take it that turn the one into the other without a spectrum.
const LUMENS_PER_WATT: f64 = 683.0;
/// Radius of the ball that stands for a point, metres.
const POINT: f64 = 0.02;

/// The text; what is wrong with a file is reported and becomes an exit code.
pub(super) fn assets(
    args: &SceneArgs,
    (analysis, scene): (&Analysis, &Scene),
    reporter: &Reporter,
) -> Result<String, u8> {
    let cache = Cache::disabled();
    let options = options(args, &cache, reporter)?;
    let mut diagnostics = Vec::new();
    let found = pipeline::assets((scene, &analysis.sources), &options, &mut diagnostics);
    reporter.diagnostics(&analysis.sources, &diagnostics);
    let facts = found.map_err(|error| failed(&error, reporter))?;
    let mut text = String::new();
    for (asset, facts) in scene.assets.iter().zip(&facts) {
        describe(&mut text, &asset.name.text, &asset.path, facts);
    }
    if text.is_empty() {
        text.push_str("no instance shows a mesh file\n");
    }
    Ok(text)
}

fn describe(text: &mut String, name: &str, path: &str, facts: &MeshFacts) {
    let bounds = |part: &PartFacts| Bounds::of(part.bounds.map(|corner| corner.map(f64::from)));
    let whole = Bounds::union(facts.parts.iter().filter_map(bounds));
    let n_triangles: usize = facts.parts.iter().map(|part| part.n_triangles).sum();
    let size = whole.as_ref().map_or("nothing".to_owned(), place);
    let _ = writeln!(
        text,
        "asset {name}  \"{path}\"\n  {}  {size}",
        counted(n_triangles, "triangle", "triangles")
    );
    let material =
        |part: &PartFacts| match part.material.and_then(|i| facts.materials.get(i as usize)) {
            Some(material) => format!("material \"{}\"", shown(&material.name)),
            None => "no material".to_owned(),
        };
    let rows = facts.parts.iter().map(|part| {
        let size = bounds(part).as_ref().map_or("nothing".to_owned(), place);
        let triangles = counted(part.n_triangles, "triangle", "triangles");
        let colors = if part.has_colors { ", vertex colours" } else { "" };
        let triangles = triangles + colors;
        [format!("part \"{}\"", shown(&part.name)), material(part), triangles, size]
    });
    table(text, &rows.collect::<Vec<_>>());
    let rows = facts.materials.iter().enumerate().map(|(index, material)| {
        let of_it = |part: &&PartFacts| part.material.is_some_and(|i| i as usize == index);
        let parts: Vec<&PartFacts> = facts.parts.iter().filter(of_it).collect();
        let triangles: usize = parts.iter().map(|part| part.n_triangles).sum();
        let name = format!("material \"{}\"", shown(&material.name));
        [
            name,
            counted(parts.len(), "part", "parts"),
            counted(triangles, "triangle", "triangles"),
            String::new(),
        ]
    });
    table(text, &rows.collect::<Vec<_>>());
    let mut names = Names::default();
    let size = whole.map_or(1.0, |Bounds { lo, hi }| length([0, 1, 2].map(|k| hi[k] - lo[k])));
    let middle = whole.map_or([0.0; 3], |bounds| bounds.middle());
    for light in &facts.studio.lights {
        let what = match light.kind {
            LightKind::Point => "point",
            LightKind::Spot { .. } => "spot",
            LightKind::Directional => "directional",
        };
        let _ = writeln!(text, "  light \"{}\", {what}:", shown(&light.name));
        let _ = writeln!(text, "    {}", light_text(light, &names.of(&light.name, "lamp"), size));
    }
    for camera in &facts.studio.cameras {
        let _ = writeln!(text, "  camera \"{}\":", shown(&camera.name));
        let name = names.of(&camera.name, "eye");
        let _ = writeln!(text, "    {}", camera_text(camera, &name, size, middle));
    }
}

/// A name of a file: control characters never reach a terminal.
fn shown(name: &str) -> String {
    name.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}

/// Columns of one width each.
fn table(text: &mut String, rows: &[[String; 4]]) {
    let width = |k: usize| rows.iter().map(|row| row[k].chars().count()).max().unwrap_or(0);
    let widths = [0, 1, 2].map(width);
    for [a, b, c, d] in rows {
        let [wide_a, wide_b, wide_c] = widths;
        let line = format!("  {a:<wide_a$}  {b:<wide_b$}  {c:<wide_c$}  {d}");
        let _ = writeln!(text, "{}", line.trim_end());
    }
}

/// Names of declarations, each once.
#[derive(Default)]
struct Names(BTreeSet<String>);

impl Names {
    /// What `name` of a file becomes, or `kind` if nothing of it can be a name.
    fn of(&mut self, name: &str, kind: &str) -> String {
        let word = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
        let plain: String = name.chars().map(word).collect();
        let plain = plain.trim_matches('_');
        // With the kind in front it is neither a number nor a word of the language.
        let base = if plain.is_empty() { kind.to_owned() } else { format!("{kind}_{plain}") };
        let mut free = base.clone();
        let mut n = 1;
        while !self.0.insert(free.clone()) {
            n += 1;
            free = format!("{base}_{n}");
        }
        free
    }
}

/// Degrees: the language knows no narrower cone.
const LEAST_CONE: f64 = 0.5;

/// The least share of a cone over which its light falls off: the language knows no sharper edge.
const NARROW: f64 = 1e-3;

fn light_text(light: &FileLight, name: &str, size: f64) -> String {
    let color = light.color.map(|c| show_number(rounded(c, 1.0))).join(", ");
    let at = vector(light.at, size);
    let watts = light.intensity / LUMENS_PER_WATT;
    let number = |x: f64| show_number(rounded(x, x));
    let radius = number(100.0 * POINT);
    let lamp = format!(
        "at = {at}m, radius = {radius}cm, color = linear({color}), intensity = {}W/sr",
        number(watts)
    );
    match light.kind {
        LightKind::Point => format!("light {name}: point {{ {lamp} }}"),
        LightKind::Spot { inner, outer } => {
            let along = vector(light.along, 1.0);
            let (cone, edge) = (outer.to_degrees().max(LEAST_CONE), (outer - inner).to_degrees());
            let [cone, edge] = [cone, edge.max(NARROW * cone)].map(number);
            format!(
                "light {name}: spot {{ {lamp}, direction = {along}, cone = {cone}deg, edge = {edge}deg }}"
            )
        }
        LightKind::Directional => {
            let towards = vector(light.along.map(|x| -x), 1.0);
            format!(
                "light {name}: directional {{ direction = {towards}, color = linear({color}), \
                 illuminance = {}W/m2 }}",
                number(watts)
            )
        }
    }
}

fn camera_text(camera: &FileCamera, name: &str, size: f64, middle: [f64; 3]) -> String {
    let to = camera.target(size, middle);
    let upright = camera.up[0].abs() < 1e-4 && camera.along[1].abs() < 0.999 && camera.up[1] > 0.0;
    let level = camera.along[0] * camera.up[2] - camera.along[2] * camera.up[0];
    let up = if upright && level.abs() < 1e-4 {
        String::new()
    } else {
        format!(", up = {}", vector(camera.up, 1.0))
    };
    let (kind, seen) = match camera.view {
        FileView::Perspective(fov) => {
            let degrees = show_number(rounded(fov.to_degrees(), 100.0));
            ("perspective", format!("fov.vertical = {degrees}deg"))
        }
        FileView::Orthographic(height) => {
            ("orthographic", format!("height = {}m", show_number(rounded(height, height))))
        }
    };
    format!(
        "camera {name}: {kind} {{ from = {}m, to = {}m{up}, {seen} }}",
        vector(camera.from, size),
        vector(to, size),
    )
}

/// `(0, 1, 2.5)`, to about a ten-thousandth of `size`.
fn vector(v: [f64; 3], size: f64) -> String {
    format!("({})", v.map(|x| show_number(rounded(x, size.max(length(v))))).join(", "))
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn light(kind: LightKind) -> FileLight {
        let (color, at, along) = ([1.0, 0.5, 0.25], [2.0, 2.0, -2.0], [0.0, -1.0, 0.0]);
        FileLight { name: "Key Light".to_owned(), kind, color, intensity: 683.0, at, along }
    }

    #[test]
    fn lights_give_off_as_much_as_in_the_file() {
        let point = "light k: point { at = (2, 2, -2)m, radius = 2cm, color = linear(1, 0.5, 0.25), intensity = 1W/sr }";
        assert_eq!(light_text(&light(LightKind::Point), "k", 4.0), point);
        let spot = LightKind::Spot { inner: PI / 16.0, outer: PI / 8.0 };
        let expected = "light k: spot { at = (2, 2, -2)m, radius = 2cm, color = linear(1, 0.5, 0.25), \
                        intensity = 1W/sr, direction = (0, -1, 0), cone = 22.5deg, edge = 11.25deg }";
        assert_eq!(light_text(&light(spot), "k", 4.0), expected);
        let sharp = LightKind::Spot { inner: PI / 8.0, outer: PI / 8.0 };
        assert!(
            light_text(&light(sharp), "k", 4.0).ends_with("cone = 22.5deg, edge = 0.0225deg }")
        );
        let sun = "light k: directional { direction = (0, 1, 0), color = linear(1, 0.5, 0.25), \
                   illuminance = 1W/m2 }";
        assert_eq!(light_text(&light(LightKind::Directional), "k", 4.0), sun);
    }

    #[test]
    fn cameras_look_at_the_middle_and_say_where_up_is_if_they_are_tilted() {
        let mut camera = FileCamera {
            name: String::new(),
            view: FileView::Perspective(PI / 4.0),
            from: [0.0, 1.0, 5.0],
            along: [0.0, 0.0, -1.0],
            up: [0.0, 1.0, 0.0],
        };
        let found = camera_text(&camera, "eye", 2.0, [0.0; 3]);
        assert_eq!(
            found,
            "camera eye: perspective { from = (0, 1, 5)m, to = (0, 1, 0)m, fov.vertical = 45deg }"
        );
        camera.up = [1.0, 0.0, 0.0];
        assert!(camera_text(&camera, "eye", 2.0, [0.0; 3]).contains(", up = (1, 0, 0), fov"));
        camera.view = FileView::Orthographic(3.0);
        let found = camera_text(&camera, "eye", 2.0, [0.0; 3]);
        assert!(found.starts_with("camera eye: orthographic { from = "), "{found}");
        assert!(found.ends_with(", up = (1, 0, 0), height = 3m }"), "{found}");
    }

    #[test]
    fn names_are_words_and_differ() {
        let mut names = Names::default();
        let found = ["Key Light", "key-light", "", "7", "in"].map(|name| names.of(name, "lamp"));
        assert_eq!(found, ["lamp_key_light", "lamp_key_light_2", "lamp", "lamp_7", "lamp_in"]);
    }
}
