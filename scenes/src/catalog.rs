//! The table of example scenes: name, what it shows, and the assets to generate first.

use std::path::{Path, PathBuf};

use crate::generate::{Extent, Generated, generate};

/// An example scene: `scenes/NAME/NAME.rts`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Example {
    /// Folder and file stem.
    pub name: &'static str,
    /// One line for `demo --list` and the README.
    pub about: &'static str,
    /// Files to generate into `scenes/NAME/generated`.
    pub assets: &'static [&'static str],
}

/// Every example: first what `cargo demo` renders without a name, then in the order in which a
/// newcomer should try them.
pub const EXAMPLES: &[Example] = &[
    Example {
        name: "shrine",
        about: "a shrine at dusk: 1,500,000 triangles, cherry blossom, a pond, lanterns",
        assets: &["shrine"],
    },
    Example {
        name: "weekend",
        about: "many spheres in the three classic materials, under a gradient sky",
        assets: &[],
    },
    Example { name: "cornell", about: "the classic box with a rectangle light", assets: &[] },
    Example {
        name: "cornell_sphere",
        about: "the box lit by a sphere, with glass and metal",
        assets: &[],
    },
    Example {
        name: "materials",
        about: "a ball of every material, on three steps under a soft lamp",
        assets: &[],
    },
    Example {
        name: "mesh",
        about: "a knotted rope of 256,000 triangles, generated and read as OBJ",
        assets: &["knot.obj"],
    },
    Example {
        name: "gltf",
        about: "a tea table from a generated GLB: textures, brass, alpha, a glowing lamp",
        assets: &["tea_table.glb"],
    },
    Example {
        name: "terrace",
        about: "an evening sky from an HDR image, whose sun is sampled as a light",
        assets: &["evening.hdr"],
    },
];

/// The example called `name`.
#[must_use]
pub fn find(name: &str) -> Option<&'static Example> {
    EXAMPLES.iter().find(|example| example.name == name)
}

impl Example {
    /// The scene text below the folder of all scenes.
    #[must_use]
    pub fn source(&self, scenes: &Path) -> PathBuf {
        scenes.join(self.name).join(format!("{}.rts", self.name))
    }

    /// Writes the files that the scene needs; returns what was written.
    ///
    /// # Errors
    /// Any failure to write a file.
    pub fn generate(&self, scenes: &Path, extent: Extent) -> std::io::Result<Vec<Generated>> {
        let dir = scenes.join(self.name).join("generated");
        self.assets.iter().map(|asset| generate(asset, &dir, extent)).collect()
    }
}
