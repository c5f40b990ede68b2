//! Tables of directional albedo: which of them a scene's materials read, and where each is in the ALBEDO section.
//!
//! What the values mean stands where they are read, in `shaders/wgsl/bsdf/*_albedo.wgsl`. This does not know how they
//! are made.

use super::{Material, MaterialKind};

/// A table of what one scattering at a rough surface does not give back. The order is that in the section.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum AlbedoTable {
    /// A GGX reflection lobe under Schlick's Fresnel term, by cosine and roughness.
    Gloss,
    /// A GGX reflection lobe with two widths, by roughness, anisotropy, cosine and azimuth.
    Brushed,
    /// A rough dielectric from both sides, by cosine, roughness and index.
    Glass,
    /// The forward lobe of a thin sheet, by cosine and mean cosine.
    Leaf,
    /// What a GGX reflection lobe with two widths differs by from a round one, under Schlick's Fresnel term and under a
    /// coat.
    BrushedGloss,
    /// Sheen, by cosine and roughness, and its means over what a GGX lobe reflects.
    Sheen,
}

impl AlbedoTable {
    /// Every table, in the order of the section.
    pub const ALL: [Self; 6] =
        [Self::Gloss, Self::Brushed, Self::Glass, Self::Leaf, Self::BrushedGloss, Self::Sheen];

    /// Its size in words of 16 bytes.
    #[must_use]
    pub const fn words(self) -> usize {
        match self {
            // Two tables of the cells between 16 x 16 nodes.
            Self::Gloss => 2 * 15 * 15,
            // Nodes, and cells between 12 x 6 means.
            Self::Brushed => 2 * 12 * 6 * 16 + 11 * 5,
            // Two such tables.
            Self::BrushedGloss => 2 * Self::Brushed.words(),
            Self::Glass => 16 * 16 * 12,
            Self::Leaf => 2 * 16 * 16,
            // Two tables of the cells between 16 x 32 nodes, nodes, and eight tables of the cells between 16 x 16.
            Self::Sheen => 2 * 15 * 31 + 16 * 16 + 8 * 15 * 15,
        }
    }

    /// Whether kernels read the table for `material`.
    #[must_use]
    pub fn is_read_for(self, material: &Material) -> bool {
        let Material { kind, compensation, anisotropy, weight, forward, .. } = *material;
        let (compensated, brushed) = (compensation > 0.0, anisotropy > 0.0);
        let Some(kind) = MaterialKind::from_tag(kind) else { return false };
        match self {
            Self::Gloss => kind == MaterialKind::Principled && compensated,
            Self::Brushed => {
                let reflects = [MaterialKind::Conductor, MaterialKind::Principled].contains(&kind);
                brushed && (reflects && compensated || kind == MaterialKind::Wood)
            }
            Self::Glass => kind == MaterialKind::RoughDielectric && compensated,
            Self::Leaf => kind == MaterialKind::Leaf && weight > 0.0 && forward > 0.0,
            Self::Sheen => material.has_sheen(),
            Self::BrushedGloss => kind == MaterialKind::Principled && compensated && brushed,
        }
    }
}

/// Where each table begins in the ALBEDO section of these materials, in words; `None` for those not there.
#[must_use]
pub fn albedo_tables(materials: &[Material]) -> [Option<usize>; AlbedoTable::ALL.len()] {
    let mut end = 0;
    AlbedoTable::ALL.map(|table| {
        let read = materials.iter().any(|material| table.is_read_for(material));
        let first = read.then_some(end);
        end += if read { table.words() } else { 0 };
        first
    })
}

/// Words of the ALBEDO section of these materials; without any there is no section.
#[must_use]
pub fn albedo_words(materials: &[Material]) -> usize {
    let present = AlbedoTable::ALL.into_iter().zip(albedo_tables(materials));
    present.filter(|(_, first)| first.is_some()).map(|(table, _)| table.words()).sum()
}
