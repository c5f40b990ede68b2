//! Lights and cameras of a mesh file: what a scene may take over, in the frame of the file, metres.

use lang::scene::Rgb;
use serde::{Deserialize, Serialize};

/// Lights and cameras, in the order of the file's scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Studio {
    /// Its lights.
    pub lights: Vec<FileLight>,
    /// Its cameras.
    pub cameras: Vec<FileCamera>,
}

/// A light of a mesh file (`KHR_lights_punctual`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FileLight {
    /// Of its node, or of itself; empty where neither has one.
    pub name: String,
    /// How it shines.
    pub kind: LightKind,
    /// Linear Rec. 709.
    pub color: Rgb,
    /// Candela; lux of directional lights. At least 0, finite.
    pub intensity: f64,
    /// Where it is.
    pub at: [f64; 3],
    /// Unit vector along its light: of spots and directional lights.
    pub along: [f64; 3],
}

/// How a light of a file shines.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum LightKind {
    /// From a point into all directions.
    Point,
    /// From a point into a cone.
    Spot {
        /// Half the angle within which it is as bright as on its axis, radians.
        inner: f64,
        /// Half the angle beyond which it is dark, radians.
        outer: f64,
    },
    /// From far away.
    Directional,
}

/// How much a camera of a mesh file sees, from the lower to the upper edge of its image.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum FileView {
    /// An angle, radians.
    Perspective(f64),
    /// A length along parallel rays, metres.
    Orthographic(f64),
}

/// A camera of a mesh file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FileCamera {
    /// Of its node, or of itself; empty where neither has one.
    pub name: String,
    /// How much it sees.
    pub view: FileView,
    /// Where it is.
    pub from: [f64; 3],
    /// Unit vector into its image.
    pub along: [f64; 3],
    /// Unit vector upwards in its image.
    pub up: [f64; 3],
}

impl FileCamera {
    /// A point in the middle of its image: as far away as `middle`, that of the file, if that is in front of it, else
    /// by `size`, that of the file. Metres.
    #[must_use]
    pub fn target(&self, size: f64, middle: [f64; 3]) -> [f64; 3] {
        let to_middle = [0, 1, 2].map(|k| middle[k] - self.from[k]);
        let ahead: f64 = (0..3).map(|k| to_middle[k] * self.along[k]).sum();
        let ahead = if ahead > 1e-3 * size { ahead } else { size.max(1e-3) };
        [0, 1, 2].map(|k| self.from[k] + ahead * self.along[k])
    }
}
