//! What glTF keeps in extensions of a material: specular colour, clear coat, sheen, anisotropy, transmission,
//! volume.

use super::super::error::{ErrorKind, ImportError};
use super::super::material::ImportedMaterial;
use super::maps::{Maps, Notes};
use ::gltf::json::material::Material;
use ::gltf::json::texture::Info;
use ::gltf::json::{Value, deserialize};
use lang::scene::ColorSpace;

/// Fibres over the surface.
pub(super) const SHEEN: &str = "KHR_materials_sheen";
/// Brushed surfaces.
pub(super) const ANISOTROPY: &str = "KHR_materials_anisotropy";

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
    if let Some(fibres) = extensions.others.get(SHEEN) {
        sheen(fibres, out, maps)?;
    }
    if let Some(brushing) = extensions.others.get(ANISOTROPY) {
        anisotropy(brushing, out, maps, notes)?;
    }
    if out.sheen.iter().any(|c| *c > 0.0) && (out.coat > 0.0 || out.anisotropy > 0.0) {
        (out.sheen, out.sheen_map, out.sheen_roughness_map) = ([0.0; 3], None, None);
        notes.sheen_over_others += 1;
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

/// Fields of an extension that the parser does not know. `what`: of what they are, for messages.
struct Fields<'v> {
    value: &'v Value,
    what: &'static str,
}

impl Fields<'_> {
    /// A factor, 0 where it is not there.
    fn number(&self, key: &str, maps: &Maps<'_, '_, '_>) -> Result<f64, ImportError> {
        let found = self.value.get(key).map_or(Some(0.0), Value::as_f64);
        let message = format!("a factor of its {} is not a number", self.what);
        found.ok_or_else(|| maps.error(ErrorKind::Format, &message))
    }

    /// The texture that it refers to, if any.
    fn texture(&self, key: &str, maps: &Maps<'_, '_, '_>) -> Result<Option<Info>, ImportError> {
        let value = self.value.get(key).cloned().map(deserialize::from_value);
        value.transpose().map_err(|error| {
            maps.error(ErrorKind::Format, &format!("its {key} is not glTF: {error}"))
        })
    }
}

/// `KHR_materials_clearcoat`.
fn clearcoat(
    value: &Value,
    out: &mut ImportedMaterial,
    maps: &mut Maps<'_, '_, '_>,
    notes: &mut Notes,
) -> Result<(), ImportError> {
    let coat = Fields { value, what: "clear coat" };
    let share = coat.number("clearcoatFactor", maps)?;
    let roughness = coat.number("clearcoatRoughnessFactor", maps)?;
    let share_map = coat.texture("clearcoatTexture", maps)?;
    let roughness_map = coat.texture("clearcoatRoughnessTexture", maps)?;
    out.coat = unit(share);
    out.coat_roughness = unit(roughness);
    out.coat_map = maps.load(share_map.as_ref(), ColorSpace::Data)?;
    out.coat_roughness_map = maps.load(roughness_map.as_ref(), ColorSpace::Data)?;
    notes.coat_normals += u64::from(value.get("clearcoatNormalTexture").is_some());
    Ok(())
}

/// `KHR_materials_sheen`.
fn sheen(
    value: &Value,
    out: &mut ImportedMaterial,
    maps: &mut Maps<'_, '_, '_>,
) -> Result<(), ImportError> {
    let fibres = Fields { value, what: "sheen" };
    let color = value.get("sheenColorFactor").map_or(Some([0.0; 3]), |value| {
        let values = value.as_array()?;
        let [r, g, b] = values.as_slice() else { return None };
        Some([r.as_f64()?, g.as_f64()?, b.as_f64()?])
    });
    let Some(color) = color else {
        return Err(maps.error(ErrorKind::Format, "the colour of its sheen is not three numbers"));
    };
    let roughness = fibres.number("sheenRoughnessFactor", maps)?;
    let color_map = fibres.texture("sheenColorTexture", maps)?;
    let roughness_map = fibres.texture("sheenRoughnessTexture", maps)?;
    out.sheen = color.map(unit);
    out.sheen_roughness = unit(roughness);
    out.sheen_map = maps.load(color_map.as_ref(), ColorSpace::Srgb)?;
    out.sheen_roughness_map = maps.load(roughness_map.as_ref(), ColorSpace::Data)?;
    Ok(())
}

/// `KHR_materials_anisotropy`: the width along the direction of brushing is alpha + (1 - alpha) strength^2 instead of
/// alpha, the square of the roughness. Ours keeps the product of both widths, and their ratio is at most 10.
fn anisotropy(
    value: &Value,
    out: &mut ImportedMaterial,
    maps: &mut Maps<'_, '_, '_>,
    notes: &mut Notes,
) -> Result<(), ImportError> {
    let brushing = Fields { value, what: "anisotropy" };
    let strength = unit(brushing.number("anisotropyStrength", maps)?);
    let rotation = brushing.number("anisotropyRotation", maps)?;
    let map = brushing.texture("anisotropyTexture", maps)?;
    if !rotation.is_finite() {
        return Err(maps.error(ErrorKind::Number, "the rotation of its anisotropy is not finite"));
    }
    let across = out.roughness * out.roughness;
    let along = across + (1.0 - across) * strength * strength;
    if along <= 0.0 || strength <= 0.0 {
        return Ok(());
    }
    let shown = (1.0 - across / along) / 0.9;
    out.anisotropy = unit(shown);
    out.anisotropy_rotation = rotation;
    out.anisotropy_map = maps.load(map.as_ref(), ColorSpace::Data)?;
    // The wider width as it is; the narrower is a tenth of it where it would be less.
    let across = along * (1.0 - 0.9 * out.anisotropy);
    out.roughness = libm::sqrt(libm::sqrt(along * across));
    notes.brushed_by_maps +=
        u64::from(out.anisotropy_map.is_some() || out.metallic_roughness_map.is_some());
    notes.too_brushed += u64::from(shown > 1.0);
    Ok(())
}
