//! Materials of glTF, which are metallic-roughness already.

use super::super::error::{ErrorKind, ImportError};
use super::super::image_set::ImageSet;
use super::super::material::ImportedMaterial;
use super::super::report::ImportReport;
use super::container::Images;
use super::layers::{self, unit};
use super::maps::{Maps, Notes, UvTransform};
use super::primitive::Table;
use super::specular_glossiness;
use ::gltf::json::material::{AlphaMode, Material};
use ::gltf::json::validation::Checked;
use lang::scene::ColorSpace;

/// The material of primitives that name none: white rough metal, as the specification has it (glTF 2.0, 3.7.2.1).
const DEFAULT: &str = "default";

/// A material with what its UVs need.
pub(super) struct Converted {
    /// Index in the file; `None`: that of primitives which name no material.
    pub(super) index: Option<usize>,
    pub(super) imported: ImportedMaterial,
    /// The `n` of `TEXCOORD_n`.
    pub(super) uv_set: u32,
    pub(super) uv_transform: Option<UvTransform>,
}

/// Converts the materials in use and asks for their images.
pub(super) fn convert<'a>(
    table: &Table,
    source: &mut Images<'a, '_>,
    images: &mut ImageSet<'a>,
    report: &mut ImportReport,
) -> Result<Vec<Converted>, ImportError> {
    let mut notes = Notes::default();
    let mut converted = Vec::with_capacity(table.used.len());
    for index in &table.used {
        let what = format!("material {}", index.value());
        let document = source.document;
        let Some(material) = document.root.get(*index) else {
            return Err(document.error(ErrorKind::Index, &what, "there is no such material"));
        };
        let mut maps = Maps { source, images, what: &what, lookup: None, differ: false };
        let name = material.name.clone().unwrap_or_else(|| what.clone());
        let imported = convert_one(material, name, &mut maps, &mut notes)?;
        notes.uv_sets += u64::from(maps.differ);
        let (uv_set, uv_transform) = maps.lookup.unwrap_or((0, None));
        let index = Some(index.value());
        converted.push(Converted { index, imported, uv_set, uv_transform });
    }
    if table.unnamed {
        let imported = ImportedMaterial::named(DEFAULT.to_owned());
        converted.push(Converted { index: None, imported, uv_set: 0, uv_transform: None });
    }
    notes.report(source.document.file, report);
    Ok(converted)
}

fn convert_one(
    material: &Material,
    name: String,
    maps: &mut Maps<'_, '_, '_>,
    notes: &mut Notes,
) -> Result<ImportedMaterial, ImportError> {
    let pbr = &material.pbr_metallic_roughness;
    let mut out = ImportedMaterial::named(name);
    let [r, g, b, a] = pbr.base_color_factor.0;
    out.color = [r, g, b].map(unit);
    out.metallic = unit(pbr.metallic_factor.0);
    out.roughness = unit(pbr.roughness_factor.0);
    out.color_map = maps.load(pbr.base_color_texture.as_ref(), ColorSpace::Srgb)?;
    out.metallic_roughness_map =
        maps.load(pbr.metallic_roughness_texture.as_ref(), ColorSpace::Data)?;
    out.emission_map = maps.load(material.emissive_texture.as_ref(), ColorSpace::Srgb)?;
    let extensions = material.extensions.as_ref();
    let strength = extensions.and_then(|e| e.emissive_strength.as_ref());
    let strength = strength.map_or(1.0, |strength| f64::from(strength.emissive_strength.0));
    let finite = |x: f64| if x.is_finite() { x.max(0.0) } else { 0.0 };
    out.emission = material.emissive_factor.0.map(|x| finite(f64::from(x) * strength));
    if let Some(ior) = extensions.and_then(|e| e.ior.as_ref()) {
        let ior = f64::from(ior.ior.0);
        // 0 is allowed by the extension and means "reflects everything", which has no index.
        out.ior = if (1.0..=100.0).contains(&ior) { ior } else { 1.5 };
    }
    out.unlit = extensions.is_some_and(|e| e.unlit.is_some());
    out.double_sided = material.double_sided;
    if let Some(normal) = &material.normal_texture {
        if !normal.scale.is_finite() {
            return Err(maps.error(ErrorKind::Number, "the scale of its normal map is not finite"));
        }
        out.normal_map = maps.load(Some(&maps.normal_info(normal)?), ColorSpace::Data)?;
        out.normal_strength = f64::from(normal.scale);
    }
    layers::convert(material, &mut out, maps, notes)?;
    // The specification: where both are there, this one is the better.
    let glossy = match extensions {
        Some(all) => specular_glossiness::convert(all, &mut out, maps)?,
        None => None,
    };
    let coverage = glossy.unwrap_or(unit(a));
    notes.tinted_glass += u64::from(out.is_glass() && !out.is_plain_glass());
    let clip = match material.alpha_mode {
        Checked::Valid(AlphaMode::Opaque) => return Ok(out),
        Checked::Valid(AlphaMode::Mask) => {
            Some(material.alpha_cutoff.map_or(0.5, |cutoff| unit(cutoff.0)))
        }
        Checked::Valid(AlphaMode::Blend) => None,
        Checked::Invalid => {
            let document = maps.source.document;
            let message = "its alphaMode is not OPAQUE, MASK or BLEND";
            return Err(document.error(ErrorKind::Format, maps.what, message));
        }
    };
    out.covers = true;
    out.alpha = coverage;
    out.alpha_map = out.color_map;
    out.alpha_clip = clip;
    Ok(out)
}
