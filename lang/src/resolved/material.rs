//! Materials as they would be written with every field said.

use super::{Declared, Fields, length, medium_name, number, texture_name, vector};
use crate::scene::{
    Color, Inside, Leaf, MaterialModel, Pattern, Petal, Principled, Rgb, Scalar, Scene,
};
use crate::schema::color_text;

/// Type and fields of a material, as they would be written.
pub(super) fn model(scene: &Scene, model: &MaterialModel) -> Declared {
    match model {
        MaterialModel::Diffuse { color: c } => ("diffuse", vec![("color", color(scene, c))]),
        MaterialModel::Metal { color: c, fuzz } => {
            ("metal", vec![("color", color(scene, c)), ("fuzz", number(*fuzz))])
        }
        MaterialModel::Emissive { color: c, strength, both_sides } => {
            let sides = if *both_sides { "both" } else { "front" };
            let fields = vec![
                ("color", color(scene, c)),
                ("strength", number(*strength)),
                ("sides", sides.to_owned()),
            ];
            ("emissive", fields)
        }
        MaterialModel::Principled(p) => ("principled", principled(scene, p)),
        MaterialModel::Dielectric { ior, roughness, inside } => {
            let fields = vec![
                ("ior", number(*ior)),
                ("roughness", scalar(scene, roughness)),
                ("interior", medium_name(scene, inside.medium)),
                ("priority", inside.priority.to_string()),
            ];
            ("dielectric", fields)
        }
        MaterialModel::Conductor { color: c, roughness, anisotropy, compensation } => {
            ("conductor", conductor(scene, c, roughness, *anisotropy, *compensation))
        }
        MaterialModel::Clearcoat { color: c, fuzz, coat_ior, coat_tint } => {
            let fields = vec![
                ("color", color(scene, c)),
                ("fuzz", number(*fuzz)),
                ("coat.ior", number(*coat_ior)),
                ("coat.tint", color_text(*coat_tint)),
            ];
            ("clearcoat", fields)
        }
        MaterialModel::Water { ior, inside, sigma_a, depth_color, waves } => {
            ("water", water(scene, *ior, *inside, (*sigma_a, *depth_color), *waves))
        }
        MaterialModel::Stone { color, vein, pattern, gloss } => {
            let mut fields = vec![("color", color_text(*color))];
            fields.extend(vein.map(|vein| ("color.vein", color_text(vein))));
            fields.extend(bumps(pattern));
            fields.push(("gloss", number(*gloss)));
            ("stone", fields)
        }
        MaterialModel::Wood { color, late, grain, grain_span: _, pattern, gloss, anisotropy } => {
            let mut fields = vec![("color", color_text(*color))];
            fields.extend(late.map(|late| ("color.late", color_text(late))));
            fields.push(("grain", ["x", "y", "z"][(*grain).min(2)].to_owned()));
            fields.extend(bumps(pattern));
            fields.push(("gloss", number(*gloss)));
            fields.push(("anisotropy", number(*anisotropy)));
            ("wood", fields)
        }
        MaterialModel::Fabric { color: c, pattern, roughness, gloss, translucency } => {
            let mut fields = vec![("color", color(scene, c))];
            fields.extend(bumps(pattern));
            fields.push(("roughness", number(*roughness)));
            fields.push(("gloss", number(*gloss)));
            fields.push(("translucency", number(*translucency)));
            ("fabric", fields)
        }
        MaterialModel::Leaf(l) => ("leaf", leaf(scene, l)),
        MaterialModel::Petal(p) => ("petal", petal(scene, p)),
    }
}

/// Fields of `principled`.
fn principled(scene: &Scene, p: &Principled) -> Fields {
    let clip = p.alpha_clip.map_or("none".to_owned(), number);
    vec![
        ("color", color(scene, &p.color)),
        ("metallic", scalar(scene, &p.metallic)),
        ("roughness", scalar(scene, &p.roughness)),
        ("ior", number(p.ior)),
        ("specular", scalar(scene, &p.specular)),
        ("specular.color", color(scene, &p.specular_color)),
        ("coat.weight", scalar(scene, &p.coat)),
        ("coat.roughness", scalar(scene, &p.coat_roughness)),
        ("transmission", scalar(scene, &p.transmission)),
        ("emission.color", color(scene, &p.emission)),
        ("emission.strength", number(p.emission_strength)),
        ("alpha", scalar(scene, &p.alpha)),
        ("alpha.clip", clip),
    ]
}

/// Fields of `leaf`.
fn leaf(scene: &Scene, leaf: &Leaf) -> Fields {
    vec![
        ("color", color(scene, &leaf.color)),
        ("alpha", scalar(scene, &leaf.alpha)),
        ("alpha.clip", leaf.alpha_clip.map_or("none".to_owned(), number)),
        ("translucency", number(leaf.translucency)),
        ("sigma_a", vector(leaf.sigma_a, "/m")),
        ("thickness", length(leaf.thickness)),
        ("forward", number(leaf.forward)),
        ("g", number(leaf.g)),
        ("gap", number(leaf.gap)),
    ]
}

/// Fields of `petal`.
fn petal(scene: &Scene, petal: &Petal) -> Fields {
    let [edge, middle] = petal.thickness.map(length);
    vec![
        ("color", color(scene, &petal.color)),
        ("alpha", scalar(scene, &petal.alpha)),
        ("alpha.clip", petal.alpha_clip.map_or("none".to_owned(), number)),
        ("fuzz.weight", number(petal.fuzz_weight)),
        ("fuzz.radius", number(petal.fuzz)),
        ("ior", number(petal.ior)),
        ("wax", number(petal.wax)),
        ("sigma_a", vector(petal.sigma_a, "/m")),
        ("sigma_s", format!("{}/m", number(petal.sigma_s))),
        ("g", number(petal.g)),
        ("thickness", format!("{edge}..{middle}")),
        ("pillow", number(petal.pillow)),
        ("tilt", number(petal.tilt)),
    ]
}

/// Fields of `water`; it is filled with a medium, or with `(sigma_a, depth_color)`.
fn water(
    scene: &Scene,
    ior: f64,
    inside: Inside,
    (sigma_a, depth_color): (Rgb, Rgb),
    waves: Option<[f64; 2]>,
) -> Fields {
    let mut fields = vec![("ior", number(ior)), ("priority", inside.priority.to_string())];
    if inside.medium.is_some() {
        fields.push(("interior", medium_name(scene, inside.medium)));
    } else {
        fields.push(("sigma_a", vector(sigma_a, "/m")));
        fields.push(("depth.color", color_text(depth_color)));
    }
    if let Some([scale, height]) = waves {
        fields.push(("waves.scale", number(scale)));
        fields.push(("waves.height", number(height)));
    } else {
        fields.push(("waves", "off".to_owned()));
    }
    fields
}

/// Fields of `conductor`.
fn conductor(
    scene: &Scene,
    metal: &Color,
    roughness: &Scalar,
    anisotropy: f64,
    compensation: bool,
) -> Fields {
    vec![
        ("color", color(scene, metal)),
        ("roughness", scalar(scene, roughness)),
        ("anisotropy", number(anisotropy)),
        ("compensation", if compensation { "on" } else { "off" }.to_owned()),
    ]
}

fn bumps(pattern: &Pattern) -> [(&'static str, String); 3] {
    [
        ("scale", number(pattern.scale)),
        ("bump.eps", length(pattern.step)),
        ("bump.strength", length(pattern.height)),
    ]
}

fn color(scene: &Scene, color: &Color) -> String {
    match color {
        Color::Constant(rgb) => color_text(*rgb),
        Color::Texture(texture) => format!("{}.rgb", texture_name(scene, *texture)),
    }
}

fn scalar(scene: &Scene, scalar: &Scalar) -> String {
    match scalar {
        Scalar::Constant(value) => number(*value),
        Scalar::Texture { texture, channel } => {
            let channel = ["r", "g", "b", "a"][usize::from(*channel).min(3)];
            format!("{}.{channel}", texture_name(scene, *texture))
        }
    }
}
