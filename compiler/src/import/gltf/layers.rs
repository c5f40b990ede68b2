//! What glTF keeps in extensions of a material: specular colour, clear coat, transmission, volume.

use super::super::error::{ErrorKind, ImportError};
use super::super::material::ImportedMaterial;
use super::maps::{Maps, Notes};
use ::gltf::json::material::Material;
use ::gltf::json::texture::Info;
use ::gltf::json::{Value, deserialize};
use lang::scene::ColorSpace;

/// The share that a file says, brought into 0 ..= 1.
pub(super) fn unit(x: impl Into<f64>) -> f64 {
    let x = x.into();
    if x.is_nan() { 0.0 } else { x.clamp(0.0, 1.0) }
}

/// Reads the layers of `material` into `out`.
pub(super) fn convert(
    material: &Material,
    out: &mut ImportedMaterial,
    maps: &mut Maps<'_, '_, '_>,
    notes: &mut Notes,
) -> Result<(), ImportError> {
    let Some(extensions) = &material.extensions else { return Ok(()) };
    if let Some(specular) = &extensions.specular {
        out.specular = unit(specular.specular_factor.0);
        let positive = |c: f32| if c.is_finite() { f64::from(c).max(0.0) } else { 0.0 };
        out.specular_color = specular.specular_color_factor.0.map(positive);
        out.specular_map = maps.load(specular.specular_texture.as_ref(), ColorSpace::Data)?;
        let color = specular.specular_color_texture.as_ref();
        out.specular_color_map = maps.load(color, ColorSpace::Srgb)?;
    }
    if let Some(coat) = extensions.others.get("KHR_materials_clearcoat") {
        clearcoat(coat, out, maps, notes)?;
        notes.coats_on_maps += u64::from(out.coat > 0.0 && out.normal_map.is_some());
    }
    if let Some(transmission) = &extensions.transmission {
        out.transmission = unit(transmission.transmission_factor.0);
        let map = transmission.transmission_texture.as_ref();
        out.transmission_map = maps.load(map, ColorSpace::Data)?;
    }
    if let Some(volume) = &extensions.volume {
        out.solid = volume.thickness_factor.0 > 0.0;
        if out.solid {
            let distance = f64::from(volume.attenuation_distance.0);
            out.sigma_a =
                volume.attenuation_color.0.map(|color| absorption(color.into(), distance));
        }
        notes.absorbing += u64::from(!out.is_glass() && out.sigma_a.iter().any(|s| *s > 0.0));
    }
    Ok(())
}

/// Absorption per metre that leaves the share `color` of white light after `distance` metres: color = exp(-sigma
/// distance), as `KHR_materials_volume` says. Nothing is quite black: at 1e-4 four hundred distances leave nothing either.
fn absorption(color: f64, distance: f64) -> f64 {
    let sigma = -libm::log(unit(color).max(1e-4)) / distance;
    if distance > 0.0 && sigma.is_finite() { sigma.max(0.0) } else { 0.0 }
}

/// `KHR_materials_clearcoat`, which the parser does not know.
fn clearcoat(
    coat: &Value,
    out: &mut ImportedMaterial,
    maps: &mut Maps<'_, '_, '_>,
    notes: &mut Notes,
) -> Result<(), ImportError> {
    let number = |key: &str| match coat.get(key) {
        None => Some(0.0),
        Some(value) => value.as_f64(),
    };
    let texture = |key: &str| -> Result<Option<Info>, String> {
        let value = coat.get(key).cloned().map(deserialize::from_value);
        value.transpose().map_err(|error| format!("its {key} is not glTF: {error}"))
    };
    let factors = (number("clearcoatFactor"), number("clearcoatRoughnessFactor"));
    let (Some(share), Some(roughness)) = factors else {
        return Err(maps.error(ErrorKind::Format, "a factor of its clear coat is not a number"));
    };
    let wrong = |maps: &Maps<'_, '_, '_>, message: String| maps.error(ErrorKind::Format, &message);
    let share_map = texture("clearcoatTexture").map_err(|message| wrong(maps, message))?;
    let roughness_map =
        texture("clearcoatRoughnessTexture").map_err(|message| wrong(maps, message))?;
    out.coat = unit(share);
    out.coat_roughness = unit(roughness);
    out.coat_map = maps.load(share_map.as_ref(), ColorSpace::Data)?;
    out.coat_roughness_map = maps.load(roughness_map.as_ref(), ColorSpace::Data)?;
    notes.coat_normals += u64::from(coat.get("clearcoatNormalTexture").is_some());
    Ok(())
}
