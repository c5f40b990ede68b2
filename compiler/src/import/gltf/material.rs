//! Materials of glTF, which are metallic-roughness already.

use super::super::error::{ErrorKind, ImportError};
use super::super::image_set::{Alpha, ImageSet};
use super::super::material::{ImportedMaterial, MapUse};
use super::super::report::ImportReport;
use super::container::Images;
use super::layers::{self, unit};
use ::gltf::json::material::{AlphaMode, Material, NormalTexture};
use ::gltf::json::texture::{Info, WrappingMode};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Index, Value, deserialize};
use lang::scene::{ColorSpace, Wrap};

/// A material with what its UVs need.
pub(super) struct Converted {
    /// Index in the file.
    pub(super) index: usize,
    pub(super) imported: ImportedMaterial,
    /// The `n` of `TEXCOORD_n`.
    pub(super) uv_set: u32,
    pub(super) uv_transform: Option<UvTransform>,
}

/// `KHR_texture_transform`: scale, then rotate, then move; v downwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct UvTransform {
    offset: [f64; 2],
    /// Sine and cosine of the angle, counter-clockwise as seen in the image.
    rotation: [f64; 2],
    scale: [f64; 2],
}

impl UvTransform {
    fn is_finite(&self) -> bool {
        [self.offset, self.rotation, self.scale].iter().flatten().all(|x| x.is_finite())
    }

    pub(super) fn apply(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let [sin, cos] = self.rotation;
        let (u, v) = (u * self.scale[0], v * self.scale[1]);
        [cos * u + sin * v + self.offset[0], cos * v - sin * u + self.offset[1]]
    }
}

/// How a texture is looked up: which UVs, transformed how.
type Lookup = (u32, Option<UvTransform>);

/// Converts the materials in use and asks for their images.
pub(super) fn convert<'a>(
    used: &[Index<Material>],
    source: &mut Images<'a, '_>,
    images: &mut ImageSet<'a>,
    report: &mut ImportReport,
) -> Result<Vec<Converted>, ImportError> {
    let mut notes = Notes::default();
    let mut converted = Vec::with_capacity(used.len());
    for index in used {
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
        converted.push(Converted { index: index.value(), imported, uv_set, uv_transform });
    }
    notes.report(source.document.file, report);
    Ok(converted)
}

/// What is counted over all materials.
#[derive(Default)]
pub(super) struct Notes {
    blended: u64,
    pub(super) coat_normals: u64,
    pub(super) coats_on_maps: u64,
    pub(super) absorbing: u64,
    tinted_glass: u64,
    uv_sets: u64,
}

impl Notes {
    fn report(&self, file: &str, report: &mut ImportReport) {
        let notes = [
            (self.blended, "blend with what is behind them; coverage is cut at one half instead"),
            (self.coat_normals, "have coats with normal maps of their own, which are not used"),
            (self.coats_on_maps, "have coats that follow the normal map of what is under them"),
            (
                self.tinted_glass,
                "are solid glass, whose colour, roughness, coat and opaque part are not used",
            ),
            (self.absorbing, "absorb light inside, which is left out"),
            (
                self.uv_sets,
                "look up their images at different UVs; all use those of the first image",
            ),
        ];
        for (count, what) in notes.into_iter().filter(|(count, _)| *count > 0) {
            report.warn(file, format!("{count} materials {what}"));
        }
    }
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
    notes.tinted_glass += u64::from(out.is_glass() && !out.is_plain_glass());
    let clip = match material.alpha_mode {
        Checked::Valid(AlphaMode::Opaque) => None,
        Checked::Valid(AlphaMode::Mask) => {
            Some(material.alpha_cutoff.map_or(0.5, |cutoff| unit(cutoff.0)))
        }
        Checked::Valid(AlphaMode::Blend) => {
            notes.blended += 1;
            Some(0.5)
        }
        Checked::Invalid => {
            let document = maps.source.document;
            let message = "its alphaMode is not OPAQUE, MASK or BLEND";
            return Err(document.error(ErrorKind::Format, maps.what, message));
        }
    };
    if clip.is_some() {
        out.alpha = unit(a);
        out.alpha_map = out.color_map;
        out.alpha_clip = clip;
    }
    Ok(out)
}

/// Asks for the images of one material.
pub(super) struct Maps<'m, 'a, 'r> {
    source: &'m mut Images<'a, 'r>,
    images: &'m mut ImageSet<'a>,
    what: &'m str,
    /// Of the first image.
    lookup: Option<Lookup>,
    /// A later image is looked up elsewhere.
    differ: bool,
}

impl Maps<'_, '_, '_> {
    pub(super) fn error(&self, kind: ErrorKind, message: &str) -> ImportError {
        self.source.document.error(kind, self.what, message)
    }

    /// A normal map as any other texture; its extensions are not parsed yet.
    fn normal_info(&self, normal: &NormalTexture) -> Result<Info, ImportError> {
        let extensions = normal.extensions.clone().map(|e| Value::Object(e.others));
        let extensions = extensions.map(deserialize::from_value).transpose().map_err(|error| {
            self.error(ErrorKind::Format, &format!("its normal map is not glTF: {error}"))
        })?;
        let (index, tex_coord) = (normal.index, normal.tex_coord);
        Ok(Info { index, tex_coord, extensions, extras: normal.extras.clone() })
    }

    pub(super) fn load(
        &mut self,
        info: Option<&Info>,
        space: ColorSpace,
    ) -> Result<Option<MapUse>, ImportError> {
        let Some(info) = info else {
            return Ok(None);
        };
        let document = self.source.document;
        let missing = |message: String| Err(document.error(ErrorKind::Index, self.what, message));
        let Some(texture) = document.root.get(info.index) else {
            return missing(format!("there is no texture {}", info.index.value()));
        };
        let wrap = match texture.sampler {
            None => [Wrap::Repeat; 2],
            Some(index) => match document.root.get(index) {
                Some(sampler) => [wrap(sampler.wrap_s), wrap(sampler.wrap_t)],
                None => return missing(format!("there is no sampler {}", index.value())),
            },
        };
        let lookup = lookup(info);
        if lookup.1.is_some_and(|transform| !transform.is_finite()) {
            let message = "the transform of one of its textures is not finite";
            return Err(document.error(ErrorKind::Number, self.what, message));
        }
        self.differ |= *self.lookup.get_or_insert(lookup) != lookup;
        let name = self.source.name(texture.source);
        let image = if let Some(image) = self.images.find(&name, Alpha::Own) {
            image
        } else {
            let (bytes, place) = self.source.bytes(texture.source)?;
            self.images.add(name, place, Alpha::Own, bytes)?
        };
        Ok(Some(MapUse { image, space, wrap }))
    }
}

fn lookup(info: &Info) -> Lookup {
    let extension = info.extensions.as_ref().and_then(|e| e.texture_transform.as_ref());
    let Some(extension) = extension else {
        return (info.tex_coord, None);
    };
    let angle = f64::from(extension.rotation.0);
    let transform = UvTransform {
        offset: extension.offset.0.map(f64::from),
        rotation: [libm::sin(angle), libm::cos(angle)],
        scale: extension.scale.0.map(f64::from),
    };
    (extension.tex_coord.unwrap_or(info.tex_coord), Some(transform))
}

fn wrap(mode: Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    }
}
