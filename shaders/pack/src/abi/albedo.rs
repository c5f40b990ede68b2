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
}

impl AlbedoTable {
    /// Every table, in the order of the section.
    pub const ALL: [Self; 4] = [Self::Gloss, Self::Brushed, Self::Glass, Self::Leaf];

    /// Its size in words of 16 bytes.
    #[must_use]
    pub const fn words(self) -> usize {
        match self {
            // Two tables of the cells between 16 x 16 nodes.
            Self::Gloss => 2 * 15 * 15,
            // Nodes, and cells between 12 x 6 means.
            Self::Brushed => 2 * 12 * 6 * 16 + 11 * 5,
            Self::Glass => 16 * 16 * 12,
            Self::Leaf => 2 * 16 * 16,
        }
    }

    /// The table that kernels read for `material`.
    #[must_use]
    pub fn of(material: &Material) -> Option<Self> {
        let Material { kind, compensation, anisotropy, weight, forward, .. } = *material;
        let reads = |asked: bool, table: Self| asked.then_some(table);
        match MaterialKind::from_tag(kind)? {
            MaterialKind::Principled => reads(compensation > 0.0, Self::Gloss),
            MaterialKind::Conductor => reads(compensation > 0.0 && anisotropy > 0.0, Self::Brushed),
            MaterialKind::Wood => reads(anisotropy > 0.0, Self::Brushed),
            MaterialKind::RoughDielectric => reads(compensation > 0.0, Self::Glass),
            MaterialKind::Leaf => reads(weight > 0.0 && forward > 0.0, Self::Leaf),
            MaterialKind::Diffuse
            | MaterialKind::Metal
            | MaterialKind::Dielectric
            | MaterialKind::Emissive
            | MaterialKind::Stone
            | MaterialKind::Fabric
            | MaterialKind::Clearcoat
            | MaterialKind::Petal
            | MaterialKind::Water
            | MaterialKind::Mix => None,
        }
    }
}

/// Where each table begins in the ALBEDO section of these materials, in words; `None` for those not there.
#[must_use]
pub fn albedo_tables(materials: &[Material]) -> [Option<usize>; 4] {
    let mut end = 0;
    AlbedoTable::ALL.map(|table| {
        let read = materials.iter().any(|material| AlbedoTable::of(material) == Some(table));
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
