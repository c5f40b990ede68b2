//! What is remembered of the materials of a pack, and the materials of the same scene after an edit.

use lang::scene::Scene;
use pack::abi;
use serde::{Deserialize, Serialize};

use super::material::{MaterialRef, MaterialTable};
use super::medium::has_inside;
use super::sketch;
use super::texture::{KnownTextures, TextureTable};

/// A material of an earlier pack.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct KnownMaterial {
    of: MaterialRef,
    /// As `MaterialTable::records` had it.
    #[serde(with = "sketch::record")]
    record: abi::Material,
    /// Whether it gives light.
    glows: bool,
    /// How many textures there were with those of this material.
    n_textures: usize,
    /// What it is called in its mesh file.
    pub(super) own_name: Option<String>,
}

impl<'a> MaterialTable<'a> {
    /// What a later compilation may know of these materials.
    pub(super) fn known(&self) -> Vec<KnownMaterial> {
        let known = |(index, of): (u32, &MaterialRef)| KnownMaterial {
            of: *of,
            record: self.records()[index as usize],
            glows: self.glow(index) > 0.0,
            n_textures: self.n_textures[index as usize],
            own_name: self.own_name(*of).map(str::to_owned),
        };
        (0..).zip(self.refs()).map(known).collect()
    }

    /// What a material of a mesh file is called there.
    pub(super) fn own_name(&self, of: MaterialRef) -> Option<&str> {
        let MaterialRef::Asset { asset, material } = of else { return None };
        let file = self.loaded?.assets[asset].as_ref()?;
        Some(&file.materials[material].name)
    }

    /// The materials of an earlier pack as the text of the scene has them now; those of mesh files are taken over.
    /// `None` if more has changed than numbers which geometry does not know.
    pub(super) fn again(
        scene: &'a Scene,
        materials: &[KnownMaterial],
        textures: &'a KnownTextures,
    ) -> Option<Self> {
        let mut table = Self::over(scene, None, TextureTable::again(textures));
        for known in materials {
            match known.of {
                MaterialRef::Asset { .. } => {
                    table.textures.skip_to(known.n_textures);
                    table.push(known.of, known.record);
                }
                MaterialRef::Scene(index) if index >= scene.materials.len() => return None,
                MaterialRef::Light(index) if index >= scene.lights.len() => return None,
                MaterialRef::Scene(_) | MaterialRef::Light(_) | MaterialRef::Default => {
                    table.index(known.of);
                }
            }
        }
        let same = |(index, known): (u32, &KnownMaterial)| {
            let alike = is_alike(&table.records()[index as usize], &known.record);
            alike && (table.glow(index) > 0.0) == known.glows
        };
        let same = (0..).zip(materials).all(same);
        same.then_some(table)
    }
}

/// Whether geometry, and what is checked of it, is the same with both.
fn is_alike(a: &abi::Material, b: &abi::Material) -> bool {
    let inside = |material: &abi::Material| (material.medium, material.priority);
    a.flags == b.flags
        && a.textures() == b.textures()
        && inside(a) == inside(b)
        && has_inside(a) == has_inside(b)
}
