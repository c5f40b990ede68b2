//! Vertex colours: factors on the base colour, and on alpha where the file asks for it.
//!
//! Parts with colours get materials of their own that say so. Where all colours of a part are one, that is a factor of
//! the material. Parts keep their colours, for other materials.

use super::material::ImportedMaterial;
use super::mesh::{MeshFile, Part};
use std::collections::BTreeMap;

/// Gives materials to the parts that have colours.
pub(super) fn settle(mut file: MeshFile) -> MeshFile {
    let mut painter = Painter { materials: file.materials, known: BTreeMap::new() };
    for part in &mut file.parts {
        if !part.colors.is_empty() {
            painter.part(part);
        }
    }
    file.materials = painter.materials;
    file
}

/// What the parts done so far have become.
struct Painter {
    materials: Vec<ImportedMaterial>,
    /// Materials with colours, by what they were and what colours do to them.
    known: BTreeMap<(Option<u32>, Effect), u32>,
}

/// What the vertex colours of a part do to its material.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Effect {
    /// The same colour everywhere, as bits.
    Factor([u32; 4]),
    /// They differ; `alpha`: theirs is a factor on the material's.
    Colors { alpha: bool },
}

impl Painter {
    fn part(&mut self, part: &mut Part) {
        let known = part.material.and_then(|material| self.materials.get(material as usize));
        let base = known.cloned().unwrap_or_else(|| ImportedMaterial {
            diffuse_only: true,
            metallic: 0.0,
            ..ImportedMaterial::named("vertex colours".to_owned())
        });
        let effect = Effect::of(&part.colors, base.covers);
        if part.colors.iter().flatten().all(|x| *x >= 1.0) {
            part.colors = Vec::new(); // many exporters write white
        }
        if part.material.is_some() && effect == Effect::Factor([1.0_f32.to_bits(); 4]) {
            return;
        }
        let new = || {
            self.materials.push(effect.on(base));
            u32::try_from(self.materials.len() - 1).unwrap_or(u32::MAX)
        };
        part.material = Some(*self.known.entry((part.material, effect)).or_insert_with(new));
    }
}

impl Effect {
    /// Of these colours, at least one, whose alpha counts if `covers`.
    fn of(colors: &[[f32; 4]], covers: bool) -> Self {
        let seen = |[r, g, b, alpha]: [f32; 4]| [r, g, b, if covers { alpha } else { 1.0 }];
        let first = seen(colors[0]).map(f32::to_bits);
        if colors.iter().all(|color| seen(*color).map(f32::to_bits) == first) {
            return Self::Factor(first);
        }
        Self::Colors { alpha: colors.iter().any(|color| seen(*color)[3] < 1.0) }
    }

    fn on(self, base: ImportedMaterial) -> ImportedMaterial {
        match self {
            Self::Factor(bits) => {
                let [r, g, b, alpha] = bits.map(|x| f64::from(f32::from_bits(x)));
                let color = [base.color[0] * r, base.color[1] * g, base.color[2] * b];
                ImportedMaterial { color, alpha: base.alpha * alpha, ..base }
            }
            Self::Colors { alpha } => {
                ImportedMaterial { vertex_colors: true, vertex_alpha: alpha, ..base }
            }
        }
    }
}

/// The linear value of a channel with the sRGB curve (IEC 61966-2-1), between 0 and 1.
pub(super) fn linear(x: f32) -> f32 {
    let x = f64::from(x.clamp(0.0, 1.0));
    let [linear] = super::check::single([if x <= 0.04045 {
        x / 12.92
    } else {
        libm::pow((x + 0.055) / 1.055, 2.4)
    }]);
    linear
}
