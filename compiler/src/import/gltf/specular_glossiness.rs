//! `KHR_materials_pbrSpecularGlossiness`: a dielectric whose reflectance at normal incidence is a colour.
//!
//! Principled materials have such a colour as a factor on the reflectance that their refractive index gives, so nothing is
//! guessed of metal: `metallic` is 0, diffuse and specular colours stay what they are. Glossiness is 1 - roughness.

use super::super::error::{ErrorKind, ImportError};
use super::super::image_set::Alpha;
use super::super::material::ImportedMaterial;
use super::layers::unit;
use super::maps::Maps;
use ::gltf::json::extensions::material::Material as Extensions;
use ::gltf::json::texture::Info;
use ::gltf::json::{Value, deserialize};
use lang::scene::ColorSpace;

/// Name of the extension.
const NAME: &str = "KHR_materials_pbrSpecularGlossiness";
/// Reflectance at normal incidence of the refractive index 1.5, ((n - 1) / (n + 1))^2.
const F0: f64 = 0.04;

/// Reads the extension among `all` into `out`; the coverage of the diffuse factor, or `None` if it is not there.
pub(super) fn convert(
    all: &Extensions,
    out: &mut ImportedMaterial,
    maps: &mut Maps<'_, '_, '_>,
) -> Result<Option<f64>, ImportError> {
    let Some(from) = all.others.get(NAME) else { return Ok(None) };
    let [r, g, b, a] = numbers(from, "diffuseFactor", maps)?;
    let specular: [f64; 3] = numbers(from, "specularFactor", maps)?;
    let [gloss] = match from.get("glossinessFactor") {
        None => [1.0],
        Some(value) => [value.as_f64().ok_or_else(|| wrong(maps, "glossinessFactor"))?],
    };
    let gloss = unit(gloss);
    out.color = [r, g, b].map(unit);
    out.metallic = 0.0;
    out.ior = 1.5;
    out.specular = 1.0;
    out.specular_color = specular.map(|c| unit(c) / F0);
    out.roughness = 1.0 - gloss;
    out.color_map = maps.load(texture(from, "diffuseTexture", maps)?.as_ref(), ColorSpace::Srgb)?;
    let both = texture(from, "specularGlossinessTexture", maps)?;
    if both.is_some() {
        out.specular_color_map = maps.load(both.as_ref(), ColorSpace::Srgb)?;
        out.roughness = 1.0;
        #[expect(
            clippy::cast_possible_truncation,
            reason = "a factor of the file, which has 32 bits"
        )]
        let alpha = Alpha::Gloss((gloss as f32).to_bits());
        out.metallic_roughness_map = maps.load_as(both.as_ref(), ColorSpace::Data, alpha)?;
    }
    Ok(Some(unit(a)))
}

fn wrong(maps: &Maps<'_, '_, '_>, key: &str) -> ImportError {
    maps.error(ErrorKind::Format, &format!("its {key} is not what {NAME} says"))
}

/// A list of `N` numbers; 1 each where it is not there.
fn numbers<const N: usize>(
    from: &Value,
    key: &str,
    maps: &Maps<'_, '_, '_>,
) -> Result<[f64; N], ImportError> {
    let Some(value) = from.get(key) else { return Ok([1.0; N]) };
    let list: Option<Vec<f64>> =
        value.as_array().and_then(|list| list.iter().map(Value::as_f64).collect());
    list.and_then(|list| list.try_into().ok()).ok_or_else(|| wrong(maps, key))
}

fn texture(from: &Value, key: &str, maps: &Maps<'_, '_, '_>) -> Result<Option<Info>, ImportError> {
    let info = from.get(key).cloned().map(deserialize::from_value).transpose();
    info.map_err(|_| wrong(maps, key))
}
