//! What does not go together in a material of which a part is said by a mesh file. What a declaration says alone has been
//! checked with it.

use lang::diagnostic::{Code, Diagnostic};
use lang::material::{Ingredient, Traits as _, without_effect};
use lang::scene::{
    Color, Material, MaterialModel, MaterialOfFile, Principled, Scalar, TextureProjection,
};

use crate::import::ImportedMaterial;

/// Reports what is wrong with a complete material, and warns of what has no effect.
pub(super) fn check(
    material: &Material,
    (of_file, from): (&MaterialOfFile, &ImportedMaterial),
    diagnostics: &mut Vec<Diagnostic>,
) {
    let MaterialModel::Principled(principled) = &material.model else { return };
    diagnostics.extend(bare_sheen(principled, of_file));
    diagnostics.extend(projected(material, principled, of_file));
    diagnostics.extend(no_effect(&material.model, of_file));
    if from.anisotropy_map.is_some() && principled.anisotropy > 0.0 {
        let text =
            format!("`{}`: the image that turns its brushed highlight is left out", from.name);
        let warning = Diagnostic::warning(Code("W0524"), "import", text);
        diagnostics.push(warning.at(of_file.base.name.span, "of the file"));
    }
}

/// As for declared materials: fibres over a coat or a brushed surface are not known.
fn bare_sheen(of: &Principled, MaterialOfFile { base, .. }: &MaterialOfFile) -> Option<Diagnostic> {
    if matches!(of.sheen, Color::Constant(rgb) if rgb.iter().all(|c| *c <= 0.0)) {
        return None;
    }
    let is_coated = of.coat != Scalar::Constant(0.0);
    let (other, is) = match (is_coated, of.anisotropy > 0.0) {
        (true, _) => ("coat.weight", "is coated"),
        (false, true) => ("anisotropy", "is brushed"),
        (false, false) => return None,
    };
    // The file says the other of the two, or it would have been reported without it.
    let (at, is, without) = match (base.says("sheen"), base.says(other)) {
        (Some(at), _) => (at, is, format!("{other} = 0")),
        (None, Some(at)) => (at, "has sheen", "sheen = linear(0)".to_owned()),
        (None, None) => return None,
    };
    let error = Diagnostic::error(Code("E0703"), format!("`sheen` cannot go with `{other}`"))
        .at(at, "not with what the file says")
        .because(base.name.span, format!("the material of the file {is}"))
        .with_help(format!("add `{without}`, or leave this out"));
    Some(error)
}

/// As for declared materials: what gives light and what is cut out cannot be projected.
fn projected(
    material: &Material,
    of: &Principled,
    MaterialOfFile { base, .. }: &MaterialOfFile,
) -> Option<Diagnostic> {
    let at = base.says("projection").filter(|_| material.projection != TextureProjection::Uv)?;
    let glows = !matches!(of.emission, Color::Constant(_)) && of.emission_strength > 0.0;
    let covers = !matches!(of.alpha, Scalar::Constant(_));
    let name = match (glows, covers) {
        (true, _) => "emission.color",
        (false, true) => "alpha",
        (false, false) => return None,
    };
    let text = format!("a textured `{name}` cannot be projected");
    let error = Diagnostic::error(Code("E0703"), text)
        .at(at, "moves all textures of this material")
        .because(base.name.span, format!("`{name}` of the file is a texture"))
        .with_help("use the texture coordinates of the shape: `projection = uv`");
    Some(error)
}

/// Warns of fields that the declaration says and that do nothing, because of what the file says.
fn no_effect(
    model: &MaterialModel,
    MaterialOfFile { base, .. }: &MaterialOfFile,
) -> Vec<Diagnostic> {
    let mut numbers = Vec::new();
    model.clone().numbers_mut(&mut |field, values| {
        if let [value] = values {
            numbers.push((field.name, *value));
        }
    });
    let number = |name: &str| numbers.iter().find(|(known, _)| *known == name).map(|(_, x)| *x);
    let mut idle: Vec<(&str, &str, String)> = without_effect(number)
        .into_iter()
        .filter(|idle| base.says(idle.because).is_none())
        .map(|idle| (idle.field, idle.because, idle.why.to_owned()))
        .collect();
    if number("specular") == Some(0.0) && number("metallic") == Some(0.0) {
        let why = "the material of the file has no highlights; `specular = 1` gives it some";
        idle.push(("roughness", "specular", why.to_owned()));
    }
    let warning = |(field, because, why): (&str, &str, String)| {
        let at = base.says(field).filter(|_| base.says(because).is_none())?;
        let text = format!("`{field}` has no effect: {why}");
        let warning = Diagnostic::warning(Code("W0404"), "no_effect", text);
        let because = format!("`{because}` of the file");
        Some(warning.at(at, "changes nothing").because(base.name.span, because))
    };
    idle.into_iter().filter_map(warning).collect()
}

/// Reports materials that cannot be mixed: whether one that is like that of a file can be is known only now.
pub(super) fn mixes(
    declared: &[Material],
    complete: &[Material],
    diagnostics: &mut Vec<Diagnostic>,
) {
    for material in complete {
        let MaterialModel::Mix(mix) = &material.model else { continue };
        for Ingredient(part) in [mix.a, mix.b] {
            let Some(of_file) = &declared[part].of_file else { continue };
            let Some(reason) = complete[part].model.unmixable() else { continue };
            let name = &complete[part].name;
            let text = format!("`{}` cannot be mixed with another material", name.text);
            let error = Diagnostic::error(Code("E0534"), text)
                .at(of_file.base.name.span, reason)
                .because(material.name.span, "mixed here")
                .with_help("mix materials that only reflect or scatter light at their surface");
            diagnostics.push(error);
        }
    }
}
