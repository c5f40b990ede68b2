//! Materials as mesh files describe them: factors and images of the metallic-roughness model.

use super::image::Image;
use lang::scene::{ColorSpace, Rgb, Wrap};
use serde::{Deserialize, Serialize};

/// An image that belongs to a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedImage {
    /// Path as the mesh file writes it, or `image 3` for one inside a GLB.
    pub name: String,
    /// The texels.
    pub image: Image,
}

/// An image in one role of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MapUse {
    /// Index into `MeshFile::images`.
    pub image: u32,
    /// How its colour channels are encoded.
    #[serde(with = "SpaceName")]
    pub space: ColorSpace,
    /// Outside 0..1 along u and v.
    #[serde(with = "wraps")]
    pub wrap: [Wrap; 2],
}

/// `ColorSpace`, which does not know how it is kept.
#[derive(Serialize, Deserialize)]
#[serde(remote = "ColorSpace")]
enum SpaceName {
    Srgb,
    Linear,
    Data,
}

/// `Wrap`, twice, by its place in [`wraps::ALL`].
mod wraps {
    use lang::scene::Wrap;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    const ALL: [Wrap; 3] = [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror];

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for it")]
    pub(super) fn serialize<S: Serializer>(
        wraps: &[Wrap; 2],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        wraps.map(|wrap| ALL.iter().position(|known| *known == wrap)).serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<[Wrap; 2], D::Error> {
        let wrap = |place: Option<usize>| place.and_then(|place| ALL.get(place).copied());
        let [Some(u), Some(v)] = <[Option<usize>; 2]>::deserialize(deserializer)?.map(wrap) else {
            return Err(D::Error::custom("no such way to wrap"));
        };
        Ok([u, v])
    }
}

/// A material of a mesh file. Every map multiplies the factor of the same name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(clippy::struct_excessive_bools, reason = "each is a property of its own in the file")]
pub struct ImportedMaterial {
    /// Name in the file; `material 3` where it has none.
    pub name: String,
    /// No specular reflection at all: lower to `diffuse` (MTL without highlights).
    pub diffuse_only: bool,
    /// Emits `color` and does not scatter (`KHR_materials_unlit`).
    pub unlit: bool,
    /// Base colour, linear Rec. 709, 0 ..= 1.
    pub color: Rgb,
    /// Red, green and blue of this image are factors on `color`.
    pub color_map: Option<MapUse>,
    /// 0 dielectric … 1 metal.
    pub metallic: f64,
    /// Perceptual roughness, 0 ..= 1.
    pub roughness: f64,
    /// Green is a factor on `roughness`, blue on `metallic`.
    pub metallic_roughness_map: Option<MapUse>,
    /// 0 opaque … 1 clear: share of the light entering the dielectric part that goes through
    /// (`KHR_materials_transmission`, MTL glass).
    pub transmission: f64,
    /// Red of this image is a factor on `transmission`.
    pub transmission_map: Option<MapUse>,
    /// The mesh encloses the material, which bends light (`KHR_materials_volume`, MTL glass); otherwise it is a
    /// thin sheet.
    pub solid: bool,
    /// Absorption inside of what is solid, per metre (attenuation of `KHR_materials_volume`).
    pub sigma_a: Rgb,
    /// Factor on the reflectance of the dielectric part, 0 ..= 1.
    pub specular: f64,
    /// The fourth channel of this image is a factor on `specular`.
    pub specular_map: Option<MapUse>,
    /// Colour of that reflectance at normal incidence, linear Rec. 709, >= 0.
    pub specular_color: Rgb,
    /// Red, green and blue of this image are factors on `specular_color`.
    pub specular_color_map: Option<MapUse>,
    /// Share under a clear coat, 0 ..= 1.
    pub coat: f64,
    /// Red of this image is a factor on `coat`.
    pub coat_map: Option<MapUse>,
    /// Perceptual roughness of the coat, 0 ..= 1.
    pub coat_roughness: f64,
    /// Green of this image is a factor on `coat_roughness`.
    pub coat_roughness_map: Option<MapUse>,
    /// Colour of the sheen, linear Rec. 709, 0 ..= 1.
    pub sheen: Rgb,
    /// Red, green and blue of this image are factors on `sheen`.
    pub sheen_map: Option<MapUse>,
    /// Perceptual roughness of the sheen, 0 ..= 1.
    pub sheen_roughness: f64,
    /// The fourth channel of this image is a factor on `sheen_roughness`.
    pub sheen_roughness_map: Option<MapUse>,
    /// How much narrower the highlight is across the direction of brushing than along it, 0 ..= 1.
    pub anisotropy: f64,
    /// From the tangent to that direction, radians.
    pub anisotropy_rotation: f64,
    /// Red and green of this image turn that direction, blue is a factor on `anisotropy`.
    pub anisotropy_map: Option<MapUse>,
    /// Refractive index of the dielectric part, >= 1.
    pub ior: f64,
    /// Emitted radiance, linear Rec. 709, any strength already multiplied in; >= 0.
    pub emission: Rgb,
    /// Red, green and blue of this image are factors on `emission`.
    pub emission_map: Option<MapUse>,
    /// Tangent-space normals, green up.
    pub normal_map: Option<MapUse>,
    /// Factor on the tilt of `normal_map`, finite.
    pub normal_strength: f64,
    /// Coverage, 0 ..= 1; 1 when the file says that alpha is to be ignored.
    pub alpha: f64,
    /// The fourth channel of this image is a factor on `alpha`.
    pub alpha_map: Option<MapUse>,
    /// Points with coverage below this do not exist, all others are opaque; `None`: coverage is the share that is there.
    pub alpha_clip: Option<f64>,
    /// The file asks for alpha; otherwise `alpha` is 1 whatever colours of vertices say.
    pub covers: bool,
    /// Colours of vertices are factors on `color`.
    pub vertex_colors: bool,
    /// Their alpha is a factor on `alpha`; only with `vertex_colors`.
    pub vertex_alpha: bool,
    /// Seen from both sides. The renderer shades both sides of every surface, so this is only a note.
    pub double_sided: bool,
}

impl ImportedMaterial {
    /// The default material of glTF, with a name: white, fully rough metal of factor 1.
    pub(super) fn named(name: String) -> Self {
        Self {
            name,
            diffuse_only: false,
            unlit: false,
            color: [1.0; 3],
            color_map: None,
            metallic: 1.0,
            roughness: 1.0,
            metallic_roughness_map: None,
            transmission: 0.0,
            transmission_map: None,
            solid: false,
            sigma_a: [0.0; 3],
            specular: 1.0,
            specular_map: None,
            specular_color: [1.0; 3],
            specular_color_map: None,
            coat: 0.0,
            coat_map: None,
            coat_roughness: 0.0,
            coat_roughness_map: None,
            sheen: [0.0; 3],
            sheen_map: None,
            sheen_roughness: 0.0,
            sheen_roughness_map: None,
            anisotropy: 0.0,
            anisotropy_rotation: 0.0,
            anisotropy_map: None,
            ior: 1.5,
            emission: [0.0; 3],
            emission_map: None,
            normal_map: None,
            normal_strength: 1.0,
            alpha: 1.0,
            alpha_map: None,
            alpha_clip: None,
            covers: false,
            vertex_colors: false,
            vertex_alpha: false,
            double_sided: false,
        }
    }

    /// Most of it is solid glass: lower to `dielectric`, which has neither colour nor metal in it.
    #[must_use]
    pub fn is_glass(&self) -> bool {
        self.solid && self.transmission * (1.0 - self.metallic) > 0.5
    }

    /// Glass of which `is_glass` loses nothing: clear, smooth, uncoated.
    #[must_use]
    pub fn is_plain_glass(&self) -> bool {
        self.is_glass()
            && self.color_map.is_none()
            && self.color.iter().all(|c| *c >= 1.0)
            && self.roughness <= 0.0
            && self.transmission * (1.0 - self.metallic) >= 1.0
            && self.coat <= 0.0
    }
}
