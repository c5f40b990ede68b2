//! What a picture holds beside radiance: which layers there are, and their sums.
//!
//! Samples are a pure function of pixel, index and seed, so layers are a pass of their own (`gather.rs`) over the samples
//! that a film has: no film, checkpoint or kernel of a picture without layers knows of them. Sums are in `f64`, over
//! ascending samples; what cannot be averaged is that of the nearest sample. Parts of a picture add up in any order.
//! It knows neither devices nor files.

mod crypto;
mod group;
mod matte;
mod rows;

pub use self::crypto::{id_of, manifest_text};
pub use self::group::Group;
pub(crate) use self::group::shares;
pub(crate) use self::matte::count;
pub use self::matte::{Matte, MatteKind};

use clap::ValueEnum;
use std::collections::BTreeSet;

/// A layer. The order is that of the command line's help.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum Layer {
    /// Albedo for denoisers: of the first surface that is not specular, 0 to 1.
    Albedo,
    /// Normal for denoisers: of that surface, world frame.
    Normal,
    /// Distance of the nearest surface along the view axis, metres.
    Depth,
    /// The nearest surface, metres, world frame.
    Position,
    /// Texture coordinates of the nearest surface.
    Uv,
    /// Number of the nearest object: an instance with all its copies.
    Object,
    /// Number of the nearest instance.
    Instance,
    /// Number of the nearest material.
    Material,
    /// Cryptomatte of objects, instances and materials.
    Crypto,
    /// Variance of the mean luminance; only of runs that are measured.
    Variance,
    /// Samples of each pixel.
    Samples,
    /// The light of each light group; together they are the picture.
    Lights,
    /// Share of the samples that see the scene and not the sky.
    Alpha,
}

impl Layer {
    /// As it is written on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Albedo => "albedo",
            Self::Normal => "normal",
            Self::Depth => "depth",
            Self::Position => "position",
            Self::Uv => "uv",
            Self::Object => "object",
            Self::Instance => "instance",
            Self::Material => "material",
            Self::Crypto => "crypto",
            Self::Variance => "variance",
            Self::Samples => "samples",
            Self::Lights => "lights",
            Self::Alpha => "alpha",
        }
    }

    /// The layer of this name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::value_variants().iter().copied().find(|layer| layer.name() == name)
    }

    /// Whether it is of the nearest sample.
    #[must_use]
    pub fn is_nearest(self) -> bool {
        matches!(
            self,
            Self::Depth
                | Self::Position
                | Self::Uv
                | Self::Object
                | Self::Instance
                | Self::Material
        )
    }
}

/// How layers are named in an EXR.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum LayerNames {
    /// `ViewLayer.Combined.R`, `ViewLayer.Depth.Z`, as Blender does.
    #[default]
    Blender,
    /// `R`, `Z`.
    Plain,
}

impl LayerNames {
    /// As it is written on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Blender => "blender",
            Self::Plain => "plain",
        }
    }

    /// The style of this name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::value_variants().iter().copied().find(|names| names.name() == name)
    }
}

/// What a run is asked for beside radiance.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// The layers.
    pub layers: BTreeSet<Layer>,
    /// Whether the sky is left out of the picture where the camera sees it.
    pub transparent: bool,
    /// How the layers are named.
    pub names: LayerNames,
}

impl Wanted {
    /// Whether there is nothing to do.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.layers.is_empty() && !self.transparent
    }

    /// `albedo,normal`.
    #[must_use]
    pub fn text(&self) -> String {
        self.layers.iter().map(|layer| layer.name()).collect::<Vec<_>>().join(",")
    }

    /// Whether the kernel's AOVs are asked for.
    #[must_use]
    pub fn has_aovs(&self) -> bool {
        let others = [Layer::Variance, Layer::Samples, Layer::Lights];
        self.transparent || self.layers.iter().any(|layer| !others.contains(layer))
    }

    /// About how many bytes the layers of a pixel take, in a scene of so many light groups.
    #[must_use]
    pub fn bytes(&self, groups: u64) -> u64 {
        let has = |layer| u64::from(self.layers.contains(&layer));
        let nearest = u64::from(self.layers.iter().any(|layer| layer.is_nearest()));
        let groups = has(Layer::Lights) * groups;
        let sums = has(Layer::Albedo) + has(Layer::Normal) + u64::from(self.transparent) + groups;
        let mattes = MatteKind::ALL.len() * size_of::<Vec<(u32, u32)>>();
        let each = [
            sums * size_of::<[f64; 3]>() as u64,
            nearest * size_of::<Nearest>() as u64,
            has(Layer::Crypto) * (mattes as u64 + 48),
            has(Layer::Alpha) * 4,
        ];
        each.iter().sum()
    }
}

/// The nearest surface that any sample of a pixel shows; of two at the same depth, that of the lower sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Metres along the view axis; infinite where nothing is.
    pub depth: f32,
    /// Metres, world frame.
    pub position: [f32; 3],
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// Number of the object, of the instance and of the material, from 1; 0: none.
    pub numbers: [u32; 3],
}

impl Nearest {
    /// Nothing.
    pub const NONE: Self =
        Self { depth: f32::INFINITY, position: [0.0; 3], uv: [0.0; 2], numbers: [0; 3] };

    /// Takes what a later sample shows, if that is nearer.
    pub fn take(&mut self, other: &Self) {
        if other.depth < self.depth {
            *self = *other;
        }
    }
}

/// The layers of a film: planes of its pixels, row by row, each empty unless a layer is made of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers {
    /// What they were made for.
    pub wanted: Wanted,
    /// Samples behind each pixel.
    pub samples: u32,
    /// Sums of `Layer::Albedo`.
    pub albedo: Vec<[f64; 3]>,
    /// Sums of `Layer::Normal`.
    pub normal: Vec<[f64; 3]>,
    /// Light by light group, in the order of channels.
    pub lights: Vec<Group>,
    /// Samples that show the scene.
    pub covered: Vec<u32>,
    /// The nearest surfaces.
    pub nearest: Vec<Nearest>,
    /// Of objects, instances and materials.
    pub mattes: Vec<Matte>,
}

impl Layers {
    /// Whether a layer is in it.
    #[must_use]
    pub fn has(&self, layer: Layer) -> bool {
        self.wanted.layers.contains(&layer)
    }

    /// Share of the samples of pixel `i` that show the scene, 0 to 1; 1 where alpha is no layer.
    #[must_use]
    pub fn alpha(&self, i: usize) -> f64 {
        let share = |n: &u32| f64::from(*n) / f64::from(self.samples.max(1));
        self.covered.get(i).map_or(1.0, share)
    }

    /// Adds the layers of other samples of the same pixels, whose indices are higher.
    pub fn add(&mut self, other: &Self) {
        let lights = self.lights.iter_mut().zip(&other.lights);
        let planes = [(&mut self.albedo, &other.albedo), (&mut self.normal, &other.normal)];
        let lights = lights.map(|(group, more)| (&mut group.sums, &more.sums));
        for (sums, more) in planes.into_iter().chain(lights) {
            for (sum, more) in sums.as_flattened_mut().iter_mut().zip(more.as_flattened()) {
                *sum += more;
            }
        }
        for (n, more) in self.covered.iter_mut().zip(&other.covered) {
            *n += more;
        }
        for (nearest, more) in self.nearest.iter_mut().zip(&other.nearest) {
            nearest.take(more);
        }
        for (matte, more) in self.mattes.iter_mut().zip(&other.mattes) {
            matte.add(more);
        }
        self.samples += other.samples;
    }
}
