//! What is remembered of a pack besides its sections, so that an edit need not make geometry anew.
//!
//! It holds nothing that grows with the triangles but those of things that are filled. With the sections of the
//! pack it stands for everything that lowering learns from files.

use pack::abi::LightKind;
use serde::{Deserialize, Serialize};

use super::Counters;
use super::inside::Boundary;
use super::known::KnownMaterial;
use super::light::Emitter;
use super::material::MaterialTable;
use super::texture::KnownTextures;
use crate::normalize::Normalization;

/// See the module.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sketch {
    /// Centre and exponent of the normalised frame.
    pub(super) frame: ([f64; 3], i32),
    pub(super) materials: Vec<KnownMaterial>,
    pub(super) textures: KnownTextures,
    /// What emits, the sky left out.
    pub(super) emitters: Vec<KnownEmitter>,
    /// Area of the sky as an emitter, see `power::weigh`.
    pub(super) sky_area: Option<f64>,
    /// The sky of the scene.
    pub(super) sky: KnownSky,
    /// Surfaces of filled things; empty where nobody must know what is inside of what.
    pub(super) boundaries: Vec<Boundary>,
    pub(super) counters: Counters,
    /// Trees that were built or fetched.
    pub(super) n_trees: usize,
}

/// An emitter whose light an earlier pack holds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct KnownEmitter {
    material: u32,
    area: f64,
    /// Whether it is in the light table.
    pub(super) selected: bool,
}

/// The sky that an earlier pack holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct KnownSky {
    /// All that is said of it in the text.
    pub(super) text: String,
    /// The integral of its luminance over all directions, if it is to be sampled.
    pub(super) flux: Option<f64>,
}

impl KnownEmitter {
    pub(super) fn new(emitter: &Emitter, selected: bool) -> Self {
        Self { material: emitter.material, area: emitter.area, selected }
    }

    /// The emitter without its primitive.
    pub(super) fn emitter(&self) -> Emitter {
        let Self { material, area, .. } = *self;
        let (kind, tint) = (LightKind::Sphere, [0.0; 4]);
        Emitter { kind, primitive: 0, count: 0, material, area, tint }
    }
}

impl Sketch {
    /// A sketch without emitters, sky and fillings.
    pub(super) fn of(
        frame: &Normalization,
        materials: &MaterialTable<'_>,
        counters: Counters,
    ) -> Self {
        Self {
            frame: (frame.center, frame.exponent),
            materials: materials.known(),
            textures: materials.textures.known(),
            emitters: Vec::new(),
            sky_area: None,
            sky: KnownSky::default(),
            boundaries: Vec::new(),
            counters,
            n_trees: 0,
        }
    }

    /// What a material of a mesh file, here by its index in the pack, is called there.
    pub(super) fn own_name(&self, index: usize) -> &str {
        self.materials[index].own_name.as_deref().unwrap_or_default()
    }

    /// Remembers what is said of the sky.
    pub(crate) fn set_sky(&mut self, text: &str) {
        text.clone_into(&mut self.sky.text);
    }
}

/// Records of the pack as their bytes.
pub(super) mod record {
    use bytemuck::Pod;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    pub(in super::super) fn serialize<T: Pod, S: Serializer>(
        record: &T,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(bytemuck::bytes_of(record))
    }

    pub(in super::super) fn deserialize<'de, T: Pod, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<T, D::Error> {
        let bytes = Vec::<u8>::deserialize(deserializer)?;
        bytemuck::try_pod_read_unaligned(&bytes).map_err(|_| D::Error::custom("another length"))
    }
}
