//! Who looks, and what becomes of it.

use super::common::Name;
use super::file::FileBase;
use super::lens::{Lens, LensSpec};
use super::motion::CameraKey;
use crate::schema::words;

/// Sine of the smallest angle between view and `Camera::up` at which the image has an upper side.
pub const MIN_UP_SINE: f64 = 1e-6;

/// A camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Declared name.
    pub name: Name,
    /// What it is to frame; then `from`, `to` and, where it is not declared, what `projection` says of distance or
    /// size follow from where that is.
    pub fit: Option<Fit>,
    /// Eye, metres.
    pub from: [f64; 3],
    /// Point in the middle of the image, metres.
    pub to: [f64; 3],
    /// Which way is up in the image; not parallel to the view.
    pub up: [f64; 3],
    /// How directions become places on the film.
    pub projection: Projection,
    /// Shutter opens and closes, seconds relative to the frame.
    pub shutter: [f64; 2],
    /// Where it is when, in order of time, two or more; none where it stands still. `from` and `to` are those of the
    /// moment when the shutter opens.
    pub keys: Vec<CameraKey>,
    /// The distance of what is sharp follows the keys.
    pub follows: bool,
    /// The camera of a mesh file that it is like; then what the declaration does not say of place and view is not known
    /// yet.
    pub of_file: Option<CameraOfFile>,
}

/// What a camera takes from a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraOfFile {
    /// The camera.
    pub base: FileBase,
    /// What the declaration says of its lens; `view` counts if the declaration says it.
    pub lens: LensSpec,
}

/// How directions become places on the film.
#[derive(Clone, Debug, PartialEq)]
pub enum Projection {
    /// Through one point, or a lens around it.
    Perspective(Lens),
    /// Along parallel rays.
    Orthographic {
        /// Width and height of what is seen, metres; `None` where `fit` decides.
        size: Option<[f64; 2]>,
        /// Height over width of the film.
        aspect: f64,
    },
    /// All around, on a lat-long map from straight up to straight down.
    Panoramic {
        /// Angle between the left and the right edge, radians, in (0, 2 pi].
        fov_horizontal: f64,
    },
}

/// What a camera frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The instance, as scenes name it without an index, and where the camera says so.
    pub instance: Name,
    /// From which side it is seen.
    pub side: Side,
    /// The camera says how far away things are sharp.
    pub has_focus: bool,
}

/// From which side a camera sees what it frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// It looks along the way from `Camera::from` to `Camera::to`.
    Along,
    /// It looks from `Camera::from` to the middle of what it frames.
    From,
}

impl Fit {
    /// Whether an instance of this name is what is framed, or a part of it.
    #[must_use]
    pub fn frames(&self, instance: &str) -> bool {
        self.instance.covers(instance)
    }
}

/// What the picture is written to.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Declared name.
    pub name: Name,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// How the samples of a pixel are spread around it.
    pub filter: Filter,
    /// Side of the square outside of which the filter is 0, pixels, > 0.
    pub filter_width: f64,
    /// Stops; the PNG is multiplied by `2^exposure`.
    pub exposure: f64,
    /// Response of the PNG.
    pub tone_map: ToneMap,
}

words! {
    /// How the samples of a pixel are spread around it.
    pub enum Filter {
        /// Evenly.
        Box = "box" "evenly over a square; 1px, unless `filter.width` is given",
        /// Less and less along each axis.
        Tent = "tent" "less and less along each axis; 2px",
        /// A normal distribution.
        Gaussian = "gaussian" "normally, up to three standard deviations, half of `filter.width`; 3px",
        /// A window.
        BlackmanHarris = "blackman_harris" "as the window of Blackman and Harris along each axis; 3px",
    }
}

words! {
    /// Film response of the PNG; the EXR is always linear.
    pub enum ToneMap {
        /// sRGB encoding only.
        None = "linear" "the sRGB curve only; what is brighter than 1 is white",
        /// `x / (1 + x)`.
        Reinhard = "reinhard" "`x / (1 + x)`",
        /// Filmic.
        Aces = "aces" "a filmic curve with a soft shoulder",
    }
}

words! {
    /// Where random numbers come from.
    pub enum Sampler {
        /// Owen-scrambled Sobol pairs.
        Sobol = "sobol" "evenly spread: Owen-scrambled Sobol points",
        /// Independent numbers.
        Pcg = "pcg" "independent of each other: plain Monte Carlo, for comparison",
    }
}

words! {
    /// What a picture holds beside radiance.
    pub enum Layer {
        /// For denoisers.
        Albedo = "albedo" "of the first surface that is not specular, for denoisers",
        /// For denoisers.
        Normal = "normal" "of that surface, for denoisers",
        /// Along the view axis.
        Depth = "depth" "distance along the view axis, metres",
        /// In the world.
        Position = "position" "the point in the world, metres",
        /// On the surface.
        Uv = "uv" "texture coordinates",
        /// Instances with their copies.
        Object = "object" "number of the instance with all its copies",
        /// Instances.
        Instance = "instance" "number of the instance",
        /// Materials.
        Material = "material" "number of the material",
        /// All three.
        Crypto = "crypto" "Cryptomatte of objects, instances and materials",
        /// Of the noise.
        Variance = "variance" "of the mean luminance, where the error is measured",
        /// Of each pixel.
        Samples = "samples" "of the pixel",
        /// By light group.
        Lights = "lights" "the light of each light group, see `group`; together they are the picture",
        /// Where the sky is not.
        Alpha = "alpha" "share of the samples that see the scene",
    }
}

/// How the picture is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Render {
    /// Declared name.
    pub name: Name,
    /// What is between things: index into `Scene::media`.
    pub atmosphere: Option<usize>,
    /// Samples per pixel.
    pub samples: u32,
    /// Longest path in segments; `None`: of any length.
    pub max_depth: Option<u32>,
    /// Bounce from which Russian roulette may end a path.
    pub roulette_depth: u32,
    /// Seed of the image.
    pub seed: u32,
    /// Where random numbers come from.
    pub sampler: Sampler,
    /// What the picture holds beside radiance, as declared.
    pub layers: Vec<Layer>,
    /// Where the picture goes, as written; relative to the working directory of `rtr`.
    pub output: Option<String>,
}
