//! Do sheets and fillings fit the size of the things that are made of them? Both checks are for lengths in the
//! wrong unit: they ask for far more than a design could want.

use glam::DVec3;
use lang::diagnostic::{Code, Diagnostic};
use lang::material::Traits as _;
use lang::scene::{Instance, MaterialModel, MediumModel, Scene, Shape};

use crate::import::MeshFacts;

/// A slab is thin if light comes out near where it went in: a sheet thicker than this share of its width is none.
const THIN: f64 = 0.1;

/// A filling scatters if at least this share of the light is scattered on the longest way through it.
const FAINT: f64 = 0.01;

/// Warns of sheets that are not thin, and of fillings that scatter next to no light.
pub(super) fn check(scene: &Scene, assets: &[MeshFacts], diagnostics: &mut Vec<Diagnostic>) {
    for instance in &scene.instances {
        let Some(material) = instance.material else { continue };
        let name = scene.materials[material].name.text.as_str();
        let model = &scene.materials[material].model;
        let Some(size) = size(instance, assets) else { continue };
        diagnostics.extend(
            sheet(instance, name, model, size).or_else(|| filling(scene, instance, model, size)),
        );
    }
}

/// Sizes of the thing along its own axes, metres; `None` where nothing can be said.
fn size(instance: &Instance, assets: &[MeshFacts]) -> Option<DVec3> {
    let own = if let Shape::Mesh { asset, parts } = &instance.shape {
        let file = &assets[*asset];
        let parts = file.chosen(parts);
        let positions = parts.iter().flat_map(|part| &file.parts[*part].bounds);
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for p in positions.map(|p| DVec3::from(p.map(f64::from))) {
            (low, high) = (low.min(p), high.max(p));
        }
        high - low
    } else {
        DVec3::from(instance.shape.size()?)
    };
    let m = &instance.world_from_object;
    let scale = [0, 1, 2].map(|k| DVec3::new(m[0][k], m[1][k], m[2][k]).length());
    let size = own * DVec3::from(scale);
    (size.is_finite() && size.max_element() > 0.0).then_some(size)
}

fn sheet(
    instance: &Instance,
    name: &str,
    model: &MaterialModel,
    size: DVec3,
) -> Option<Diagnostic> {
    let thickness = model.sheet()?.thickness;
    let mut sides = size.to_array();
    sides.sort_by(f64::total_cmp);
    let width = sides[1];
    (thickness > THIN * width).then(|| {
        let text = format!(
            "`{name}` is {} thick, but this is only {} wide",
            length(thickness),
            length(width)
        );
        let found = Diagnostic::warning(Code("W0530"), "thick_sheet", text)
            .at(instance.shape_span, format!("a sheet should be {} thin at most", length(THIN * width)))
            .with_note("light leaves a thin sheet where it enters it; in thick things it wanders")
            .with_help("`thickness` in mm? For a thick thing take `dielectric` with a medium as `interior`");
        because_of(found, instance)
    })
}

fn filling(
    scene: &Scene,
    instance: &Instance,
    model: &MaterialModel,
    size: DVec3,
) -> Option<Diagnostic> {
    let medium = &scene.media[model.inside()?.medium?];
    let sigma_s = match medium.model {
        MediumModel::Homogeneous { sigma_s, .. } => sigma_s,
        MediumModel::Fog { .. } => return None,
    };
    let most = sigma_s.into_iter().fold(0.0, f64::max);
    let long = size.max_element();
    let share = -(-most * long).exp_m1();
    (most > 0.0 && share < FAINT).then(|| {
        let name = &medium.name.text;
        let text = format!("`{name}` scatters next to no light in here");
        let label = format!(
            "{} long; light goes {} from one scattering to the next",
            length(long),
            length(1.0 / most)
        );
        let found = Diagnostic::warning(Code("W0531"), "faint_medium", text)
            .at(instance.shape_span, label)
            .with_note(format!("{} of the light is scattered on the longest way", percent(share)))
            .with_help("`sigma_s` in /mm or /cm? Without it the medium costs no samples");
        because_of(found, instance)
    })
}

fn because_of(found: Diagnostic, instance: &Instance) -> Diagnostic {
    match instance.material_span {
        Some(span) => found.because(span, "because of this material"),
        None => found,
    }
}

/// A length in a unit in which it is readable.
fn length(metres: f64) -> String {
    let (value, unit) = match metres {
        m if m < 0.01 => (1e3 * m, "mm"),
        m if m < 1.0 => (1e2 * m, "cm"),
        m if m < 1e3 => (m, "m"),
        m => (1e-3 * m, "km"),
    };
    format!("{}{unit}", (value * 100.0).round() / 100.0)
}

fn percent(share: f64) -> String {
    let digits =
        if share < 1e-4 { "less than 0.01".to_owned() } else { format!("{:.2}", 100.0 * share) };
    format!("{digits} %")
}
