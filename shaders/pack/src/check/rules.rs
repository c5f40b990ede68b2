//! The rules of every field of every record, in one table.
//!
//! Turns a record into `None` or its first broken rule. The table below is the specification: a
//! field that is not in it may hold any value, and the comment there says why.

use crate::abi::{
    Camera, Light, LightKind, Material, MaterialKind, Node, RenderSettings, Sky, SkyKind, Sphere,
    Texture, TextureFormat, ToneMap, TriShade, Triangle, Wrap, material_flag,
};
use crate::contents::Contents;
use crate::fault::ElementFault;
use crate::kind::{Kind, PackRecord};

use super::rule::{
    bits, corner, count, direction, finite, finite64, index, index_or_none, not_negative, positive,
    power_of_two, probability, refractive, tag, unit_range, unused, unused4,
};

/// Field and fault.
pub(super) type Broken = (&'static str, ElementFault);

/// A section and its number of elements.
pub(super) type TableRef = (Kind, usize);

/// A record with rules.
pub(super) trait Ruled: PackRecord + Sync {
    /// The first rule that this record breaks.
    fn broken(&self, contents: &Contents<'_>) -> Option<Broken>;
}

fn table(contents: &Contents<'_>, kind: Kind) -> TableRef {
    (kind, contents.count(kind))
}

macro_rules! rules {
    ($pack:ident; $($record:ident $(and $more:ident)? { $($field:ident: $rule:ident($($arg:expr),*),)* })*) => {
        $(impl Ruled for $record {
            #[inline]
            fn broken(&self, $pack: &Contents<'_>) -> Option<Broken> {
                let _ = $pack;
                $(if let Some(fault) = $rule(self.$field $(, $arg)*) {
                    return Some((stringify!($field), fault));
                })*
                $(if let Some(broken) = $more(self, $pack) {
                    return Some(broken);
                })?
                None
            }
        })*
    };
}

rules! { pack;
    // `samples` has no upper bound, `roulette_depth` and `seed` are free; `root` and `stack_need`
    // are the tree's, `n_lights` was compared with LIGHT.
    RenderSettings {
        image_size: count(1, 65_536),
        samples: at_least_one(),
        max_depth: at_least_one_at_most(65_535),
        exposure: finite(),
        tone_map: tag(ToneMap::ALL.len()),
        scale_bits: power_of_two(),
        center_x_bits: finite64(),
        center_y_bits: finite64(),
        center_z_bits: finite64(),
        _pad0: unused(),
        _pad1: unused4(),
    }
    Camera {
        origin: finite(),
        lens_radius: not_negative(),
        right: direction(),
        tan_half_height: positive(),
        up: direction(),
        focus_distance: positive(),
        forward: direction(),
        tan_half_width: positive(),
    }
    // `sun_direction` is any finite vector: a sky without a sun has none.
    Sky {
        zenith: not_negative(),
        kind: tag(SkyKind::ALL.len()),
        middle: not_negative(),
        blend_high: finite(),
        horizon: not_negative(),
        blend_low: finite(),
        ground: not_negative(),
        glow_power: not_negative(),
        sun_direction: finite(),
        disc_power: not_negative(),
        glow: not_negative(),
        _pad0: unused(),
        disc: not_negative(),
        _pad1: unused(),
    }
    // `left` and `right` are the tree's; so is that `lo <= hi`.
    Node {
        left_lo: finite(),
        left_hi: finite(),
        right_lo: finite(),
        right_hi: finite(),
        _pad0: unused(),
        _pad1: unused(),
    }
    Triangle {
        v0: finite(),
        v1: finite(),
        v2: finite(),
        id0: corner(pack.triangles.len()),
        id1: corner(pack.triangles.len()),
        id2: corner(pack.triangles.len()),
    }
    // Every word is an octahedral normal.
    TriShade {
        material: index(table(pack, Kind::MATERIAL)),
        light: index_or_none(table(pack, Kind::LIGHT)),
        flags: bits(1),
        uv0: finite(),
        uv1: finite(),
        uv2: finite(),
    }
    Sphere {
        center: finite(),
        radius: positive(),
        material: index(table(pack, Kind::MATERIAL)),
        light: index_or_none(table(pack, Kind::LIGHT)),
        _pad0: unused(),
        _pad1: unused(),
    }
    Material and material {
        kind: tag(MaterialKind::ALL.len()),
        flags: bits(material_flag::EMIT_BOTH_SIDES | material_flag::ALPHA_CLIP),
        color_texture: index_or_none(table(pack, Kind::TEXTURE)),
        emission_texture: index_or_none(table(pack, Kind::TEXTURE)),
        metallic_roughness_texture: index_or_none(table(pack, Kind::TEXTURE)),
        alpha_texture: index_or_none(table(pack, Kind::TEXTURE)),
        color: not_negative(),
        emission: not_negative(),
        fuzz: unit_range(),
        roughness: unit_range(),
        metallic: unit_range(),
        ior: not_negative(),
        ior_minus_1: finite(),
        alpha_cutoff: finite(),
        alpha: not_negative(),
        _pad0: unused(),
        _pad1: unused4(),
    }
    Light and light {
        kind: tag(LightKind::ALL.len()),
        material: index(table(pack, Kind::MATERIAL)),
        origin: finite(),
        edge1: finite(),
        area: not_negative(),
        edge2: finite(),
        pmf: probability(),
        cdf: probability(),
        _pad0: unused(),
    }
    Texture and texture {
        width: dimension(),
        height: dimension(),
        format: tag(TextureFormat::ALL.len()),
        wrap_u: tag(Wrap::ALL.len()),
        wrap_v: tag(Wrap::ALL.len()),
        _pad0: unused(),
        _pad1: unused(),
    }
}

fn at_least_one(value: u32) -> Option<ElementFault> {
    count([value], 1, u32::MAX)
}

fn at_least_one_at_most(value: u32, max: u32) -> Option<ElementFault> {
    count([value], 1, max)
}

fn dimension(value: u32) -> Option<ElementFault> {
    count([value], 1, 65_536)
}

/// Kinds that refract need a real refractive index.
fn material(record: &Material, _: &Contents<'_>) -> Option<Broken> {
    let refracts = matches!(
        MaterialKind::from_tag(record.kind),
        Some(MaterialKind::Dielectric | MaterialKind::Principled)
    );
    if !refracts {
        return None;
    }
    if let Some(fault) = refractive(record.ior) {
        return Some(("ior", fault));
    }
    not_negative(record.ior_minus_1).map(|fault| ("ior_minus_1", fault))
}

/// What `primitive`, `edge1` and `area` mean depends on the kind.
fn light(record: &Light, pack: &Contents<'_>) -> Option<Broken> {
    let kind = LightKind::from_tag(record.kind)?;
    let target = match kind {
        LightKind::Sphere => Kind::SPHERE,
        LightKind::Rectangle | LightKind::Triangle => Kind::TRIANGLE,
    };
    if let Some(fault) = index(record.primitive, table(pack, target)) {
        return Some(("primitive", fault));
    }
    match kind {
        LightKind::Sphere => positive(record.edge1[0]).map(|fault| ("edge1", fault)),
        LightKind::Rectangle | LightKind::Triangle => {
            positive(record.area).map(|fault| ("area", fault))
        }
    }
}

/// The texels lie inside TEXEL.
fn texture(record: &Texture, pack: &Contents<'_>) -> Option<Broken> {
    let words = record.words()?;
    let count = pack.texels.len();
    // Both terms are far below 2^64: the first has 32 bits, the second at most 2^29.
    if u64::from(record.offset) + words <= count as u64 {
        return None;
    }
    Some(("offset", ElementFault::Texels { first: record.offset, words, count }))
}
