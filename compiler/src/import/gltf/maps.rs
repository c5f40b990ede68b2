//! Textures of a material → images to load and how they are looked up; and what is noted about all materials.

use super::super::error::{ErrorKind, ImportError};
use super::super::image_set::{Alpha, ImageSet};
use super::super::material::MapUse;
use super::super::report::ImportReport;
use super::container::Images;
use ::gltf::json::material::NormalTexture;
use ::gltf::json::texture::{Info, Texture, WrappingMode};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Image, Index, Value, deserialize};
use lang::scene::{ColorSpace, Wrap};

/// Textures with images in WebP.
pub(super) const WEBP: &str = "EXT_texture_webp";
/// Textures with images in KTX2.
pub(super) const KTX2: &str = "KHR_texture_basisu";

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

/// What is counted over all materials.
#[derive(Default)]
pub(super) struct Notes {
    pub(super) coat_normals: u64,
    pub(super) coats_on_maps: u64,
    pub(super) absorbing: u64,
    pub(super) tinted_glass: u64,
    pub(super) uv_sets: u64,
    pub(super) brushed_by_maps: u64,
    pub(super) too_brushed: u64,
    pub(super) sheen_over_others: u64,
}

impl Notes {
    pub(super) fn report(&self, file: &str, report: &mut ImportReport) {
        let notes = [
            (self.coat_normals, "normal maps of coats are not used"),
            (self.coats_on_maps, "coats follow the normal map of what is under them"),
            (
                self.tinted_glass,
                "colour, roughness, coat and opaque part of solid glass are not used",
            ),
            (self.absorbing, "absorption inside is left out of what is mostly opaque"),
            (
                self.brushed_by_maps,
                "brushing by a texture is approximate between round and brushed, or smooth and rough",
            ),
            (
                self.too_brushed,
                "highlights more than ten times as long as wide are ten times as long",
            ),
            (self.sheen_over_others, "sheen is left out of what is coated or brushed"),
            (self.uv_sets, "images of one material at different UVs all use those of the first"),
        ];
        for (count, what) in notes {
            report.warn_of(file, what, count, ["material", "materials"]);
        }
    }
}

/// Asks for the images of one material.
pub(super) struct Maps<'m, 'a, 'r> {
    pub(super) source: &'m mut Images<'a, 'r>,
    pub(super) images: &'m mut ImageSet<'a>,
    pub(super) what: &'m str,
    /// Of the first image.
    pub(super) lookup: Option<Lookup>,
    /// A later image is looked up elsewhere.
    pub(super) differ: bool,
}

impl Maps<'_, '_, '_> {
    pub(super) fn error(&self, kind: ErrorKind, message: &str) -> ImportError {
        self.source.document.error(kind, self.what, message)
    }

    /// A normal map as any other texture; its extensions are not parsed yet.
    pub(super) fn normal_info(&self, normal: &NormalTexture) -> Result<Info, ImportError> {
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
        self.load_as(info, space, Alpha::Own)
    }

    /// The same, with what is to be made of its alpha.
    pub(super) fn load_as(
        &mut self,
        info: Option<&Info>,
        space: ColorSpace,
        alpha: Alpha,
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
        let source = self.image_of(texture)?;
        let name = self.source.name(source);
        let image = if let Some(image) = self.images.find(&name, alpha) {
            image
        } else {
            let (bytes, place) = self.source.bytes(source)?;
            self.images.add(name, place, alpha, bytes)?
        };
        Ok(Some(MapUse { image, space, wrap }))
    }

    /// Its image: that of an extension, or its own, which programs without the extension would take.
    fn image_of(&self, texture: &Texture) -> Result<Index<Image>, ImportError> {
        let found = |name| Some((name, texture.extensions.as_ref()?.others.get(name)?));
        let Some((name, extension)) = found(WEBP).or_else(|| found(KTX2)) else {
            return Ok(texture.source);
        };
        let source = extension.get("source").and_then(Value::as_u64);
        let source = source.and_then(|index| u32::try_from(index).ok());
        let message = || format!("one of its textures is not what {name} says");
        source.map(Index::new).ok_or_else(|| self.error(ErrorKind::Format, &message()))
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
