//! The rules of every field of every record, in one table.
//!
//! Turns a record into `None` or its first broken rule. The table below is the specification: a
//! field that is not in it may hold any value, and the comment there says why.

use crate::abi::{
    Camera, CameraKey, CameraKind, FilterKind, Instance, Light, LightKind, LightLink, LightNode,
    LightSurface, MOVES, Material, MaterialKind, Medium, MotionPiece, Node, OBJECT_OF_INSTANCE,
    Object, RenderSettings, SamplerKind, Sky, SkyKind, Sphere, TRI_SMOOTH, Texture, TextureFormat,
    ToneMap, TriShade, Triangle, UNLIMITED_DEPTH, VertexColors, WideNode, Wrap, material_flag,
};
use crate::contents::Contents;
use crate::fault::ElementFault;
use crate::kind::{Kind, PackRecord};

use super::broken::Broken;
use super::rule::{
    TableRef, bits, corner, cosine, count, direction, finite, finite64, index, index_or_none,
    indices_or_none, not_negative, positive, power_of_two, probability, refractive, rotation, step,
    tag, unit_range, unused,
};

/// A record with rules.
pub(super) trait Ruled: PackRecord + Sync {
    /// The first rule that this record breaks.
    fn broken(&self, contents: &Contents<'_>) -> Option<Broken>;
}

#[inline]
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
    // `samples` has no upper bound, `roulette_depth` (unless paths may have any length) and `seed` are free; `root` and `stack_need`
    // are the tree's, `n_lights` was compared with LIGHT.
    RenderSettings and render {
        image_size: count(1, 65_536),
        samples: at_least_one(),
        max_depth: depth(),
        exposure: finite(),
        tone_map: tag(ToneMap::ALL.len()),
        scale_bits: power_of_two(),
        center_x_bits: finite64(),
        center_y_bits: finite64(),
        center_z_bits: finite64(),
        sampler: tag(SamplerKind::ALL.len()),
        air: index_or_none(table(pack, Kind::MEDIUM)),
        inside: indices_or_none(table(pack, Kind::MATERIAL)),
        fog: index_or_none(table(pack, Kind::MEDIUM)),
        filter: tag(FilterKind::ALL.len()),
        filter_width: not_negative(),
    }
    Camera and camera {
        origin: finite(),
        lens_radius: not_negative(),
        right: direction(),
        half_height: positive(),
        up: direction(),
        focus_distance: positive(),
        forward: direction(),
        half_width: positive(),
        kind: tag(CameraKind::ALL.len()),
        blades: at_most(16),
        blade_rotation: finite(),
        blade_reach: not_negative(),
    }
    // `sun_direction` is any finite vector: a sky without a sun has none. `rows` and `columns` are compared
    // with SKYTABLE.
    Sky and sky {
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
        blend_ground: finite(),
        disc: not_negative(),
        rotation: finite(),
        texture: index_or_none(table(pack, Kind::TEXTURE)),
        light: index_or_none(table(pack, Kind::LIGHT)),
        unseen: bits(1),
        _pad0: unused(),
        _pad1: unused(),
        _pad2: unused(),
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
    // The children and the ends of their boxes are the tree's.
    WideNode and grid {
        origin: finite(),
        scale: step(),
    }
    Triangle {
        v0: finite(),
        v1: finite(),
        v2: finite(),
        id0: id(pack),
        id1: id(pack),
        id2: id(pack),
    }
    // Every word is an octahedral normal.
    TriShade {
        material: index(table(pack, Kind::MATERIAL)),
        light: index_or_none(table(pack, Kind::LIGHT)),
        object: object_of_triangle(pack),
        uv0: finite(),
        uv1: finite(),
        uv2: finite(),
    }
    // Every number of `high` is a colour.
    VertexColors {
        low: bits(VertexColors::LOW),
    }
    Sphere {
        center: finite(),
        radius: positive(),
        material: index(table(pack, Kind::MATERIAL)),
        light: index_or_none(table(pack, Kind::LIGHT)),
        object: object(pack),
        _pad0: unused(),
    }
    // `key` is any number.
    Object {
        row_x: finite(),
        offset_x: finite(),
        row_y: finite(),
        offset_y: finite(),
        row_z: finite(),
        offset_z: finite(),
        motion: finite(),
        pivot: finite(),
        path: way(table(pack, Kind::MOTION)),
    }
    // `receives` is any number.
    LightLink {
        own_set: set_of_lights(),
        _pad0: unused(),
        _pad1: unused(),
    }
    // That pieces follow each other is checked with the ways.
    MotionPiece {
        shift: finite(),
        start: unit_range(),
        travel: finite(),
        end: unit_range(),
        axis: direction(),
        turns: finite(),
        turn: rotation(),
    }
    CameraKey {
        origin: finite(),
        time: unit_range(),
        aim: finite(),
        focus_distance: not_negative(),
        up: finite(),
        _pad0: unused(),
    }
    // `root` is the tree's; `_pad` are the fourth lanes of columns.
    Instance and instance {
        row_x: finite(),
        row_y: finite(),
        row_z: finite(),
        material: index_or_none(table(pack, Kind::MATERIAL)),
        object: object(pack),
        center: finite(),
        reach: positive(),
        col_x: finite(),
        _pad0: unused(),
        col_y: finite(),
        _pad1: unused(),
        col_z: finite(),
        _pad2: unused(),
    }
    // `receives` is any number.
    Medium {
        sigma_a: not_negative(),
        g: cosine(),
        sigma_s: not_negative(),
        reach: not_negative(),
        color: not_negative(),
    }
    // `priority` is any number.
    Material and material {
        kind: material_kind(),
        flags: bits(material_flag::ALL),
        color_texture: index_or_none(table(pack, Kind::TEXTURE)),
        emission_texture: index_or_none(table(pack, Kind::TEXTURE)),
        metallic_roughness_texture: index_or_none(table(pack, Kind::TEXTURE)),
        alpha_texture: index_or_none(table(pack, Kind::TEXTURE)),
        normal_texture: index_or_none(table(pack, Kind::TEXTURE)),
        specular_texture: index_or_none(table(pack, Kind::TEXTURE)),
        coat_texture: index_or_none(table(pack, Kind::TEXTURE)),
        transmission_texture: index_or_none(table(pack, Kind::TEXTURE)),
        anisotropy_texture: index_or_none(table(pack, Kind::TEXTURE)),
        sheen_texture: index_or_none(table(pack, Kind::TEXTURE)),
        medium: index_or_none(table(pack, Kind::MEDIUM)),
        color: not_negative(),
        emission: not_negative(),
        fuzz: unit_range(),
        roughness: unit_range(),
        metallic: unit_range(),
        ior: not_negative(),
        ior_minus_1: finite(),
        alpha_cutoff: finite(),
        alpha: not_negative(),
        anisotropy: unit_range(),
        normal_strength: finite(),
        tint: not_negative(),
        weight: unit_range(),
        pattern_scale: not_negative(),
        bump_step: not_negative(),
        bump_height: not_negative(),
        gloss: unit_range(),
        sigma_a: not_negative(),
        sigma_s: not_negative(),
        g: cosine(),
        thickness_edge: not_negative(),
        thickness_middle: not_negative(),
        forward: unit_range(),
        specular: unit_range(),
        coat: unit_range(),
        coat_roughness: unit_range(),
        transmission: unit_range(),
        compensation: unit_range(),
        anisotropy_turn: unit_range(),
        sheen_roughness: unit_range(),
        sheen: unit_range(),
        _pad0: unused(),
    }
    // `child` is `light_tree`'s; so is `trail` of lights.
    LightNode {
        center: finite(),
        radius2: positive(),
        axis: direction(),
        power: positive(),
        cos_spread: cosine(),
        sin_spread: unit_range(),
        _pad0: unused(),
    }
    Light and light {
        kind: tag(LightKind::ALL.len()),
        origin: finite(),
        edge1: finite(),
        area: not_negative(),
        edge2: finite(),
        pmf: probability(),
        cdf: probability(),
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

/// The whole grid is finite.
#[inline]
fn grid(record: &WideNode, _: &Contents<'_>) -> Option<Broken> {
    let end = [0, 1, 2].map(|axis| record.origin[axis] + 255.0 * record.scale[axis]);
    finite(end).map(|fault| ("scale", fault))
}

/// Bits 0-30 are a welded id.
#[inline]
fn id(found: u32, pack: &Contents<'_>) -> Option<ElementFault> {
    corner(found & !MOVES, pack.triangles.len())
}

/// Bits 0-30 are the index of an object. A pack in which nothing depends on objects has no table of them, and the
/// number is for people only, see `Manifest::object`.
#[inline]
fn object(found: u32, pack: &Contents<'_>) -> Option<ElementFault> {
    let count = if pack.objects.is_empty() { MAX_OBJECTS } else { pack.objects.len() };
    // Those of lights come first.
    let links = pack.links.len().saturating_sub(pack.lights.len());
    if !pack.links.is_empty() && links < count {
        return index(found & !(TRI_SMOOTH | MOVES), (Kind::LIGHTLINK, links));
    }
    // Bit 31 says something else of triangles than of spheres.
    index(found & !(TRI_SMOOTH | MOVES), (Kind::OBJECT, count))
}

/// Most objects of a pack.
const MAX_OBJECTS: usize = 1 << 24;

/// As `object`, or what says that the triangle's instance has the object.
#[inline]
fn object_of_triangle(found: u32, pack: &Contents<'_>) -> Option<ElementFault> {
    if found & !TRI_SMOOTH == OBJECT_OF_INSTANCE { None } else { object(found, pack) }
}

/// The rows are the inverse of the columns.
fn instance(record: &Instance, _: &Contents<'_>) -> Option<Broken> {
    let error = record.inverse_error();
    (error > MAX_INVERSE_ERROR).then_some(("row_x", ElementFault::NotInverse(error)))
}

/// Rows and columns are rounded to 2^-24 of themselves, and sums of three products round as often.
const MAX_INVERSE_ERROR: f32 = 1e-4;

fn at_least_one(value: u32) -> Option<ElementFault> {
    count([value], 1, u32::MAX)
}

fn at_most(value: u32, max: u32) -> Option<ElementFault> {
    count([value], 0, max)
}

/// One bit or none.
fn set_of_lights(found: u32) -> Option<ElementFault> {
    (found.count_ones() > 1).then_some(ElementFault::SeveralSets(found))
}

/// 1 + an index into the pieces of ways, or 0.
fn way(value: u32, (_, count): TableRef) -> Option<ElementFault> {
    at_most(value, u32::try_from(count).unwrap_or(u32::MAX))
}

/// Longest path in segments that a pack may ask for, beside those of any length.
const MAX_DEPTH: u32 = 65_535;

fn depth(value: u32) -> Option<ElementFault> {
    if value == UNLIMITED_DEPTH { None } else { count([value], 1, MAX_DEPTH) }
}

fn dimension(value: u32) -> Option<ElementFault> {
    count([value], 1, 65_536)
}

/// Tags of materials have gaps.
fn material_kind(found: u32) -> Option<ElementFault> {
    let known = &MaterialKind::TAGS;
    (!known.contains(&found)).then_some(ElementFault::OneOf { found, known })
}

/// Kinds that refract need a real refractive index, kinds with bumps a step, and what asks about objects their table.
fn material(record: &Material, pack: &Contents<'_>) -> Option<Broken> {
    let shown = !pack.triangles.is_empty() || !pack.spheres.is_empty();
    if record.flags & material_flag::OBJECT != 0 && shown && pack.objects.is_empty() {
        return index(0, (Kind::OBJECT, 0)).map(|fault| ("flags", fault));
    }
    let traits = MaterialKind::from_tag(record.kind)?.traits();
    if traits.pattern {
        // The height of the bumps is divided by it.
        return positive(record.bump_step).map(|fault| ("bump_step", fault));
    }
    if !traits.refracts {
        return None;
    }
    if let Some(fault) = refractive(record.ior) {
        return Some(("ior", fault));
    }
    not_negative(record.ior_minus_1).map(|fault| ("ior_minus_1", fault))
}

/// Paths of any length end by Russian roulette, which must begin.
fn render(record: &RenderSettings, _: &Contents<'_>) -> Option<Broken> {
    if record.max_depth != UNLIMITED_DEPTH {
        return None;
    }
    at_most(record.roulette_depth, MAX_DEPTH).map(|fault| ("roulette_depth", fault))
}

/// Only perspective cameras have a lens.
fn camera(record: &Camera, _: &Contents<'_>) -> Option<Broken> {
    if record.kind == CameraKind::Perspective as u32 {
        return None;
    }
    unused(record.lens_radius.to_bits()).map(|fault| ("lens_radius", fault))
}

/// An image sky has an image.
fn sky(record: &Sky, pack: &Contents<'_>) -> Option<Broken> {
    if record.kind != SkyKind::Image as u32 {
        return None;
    }
    let image = index(record.texture, table(pack, Kind::TEXTURE)).or_else(|| {
        let image = &pack.textures[record.texture as usize];
        image.is_expression().then_some(ElementFault::NoImage(record.texture))
    });
    image.map(|fault| ("texture", fault))
}

/// What `primitive`, `edge1` and `area` mean depends on the kind.
fn light(record: &Light, pack: &Contents<'_>) -> Option<Broken> {
    let kind = LightKind::from_tag(record.kind)?;
    if kind == LightKind::Directional {
        return directional(record);
    }
    // What a sky is as a light, `check::sky` compares with the sky.
    let surface = kind.surface()?;
    if let Some(fault) = index(record.material, table(pack, Kind::MATERIAL)) {
        return Some(("material", fault));
    }
    let target = match surface {
        LightSurface::Sphere => Kind::SPHERE,
        LightSurface::Triangles => Kind::TRIANGLE,
    };
    if let Some(fault) = index(record.primitive, table(pack, target)) {
        return Some(("primitive", fault));
    }
    match surface {
        LightSurface::Sphere => positive(record.edge1[0]).map(|fault| ("edge1", fault)),
        LightSurface::Triangles => positive(record.area).map(|fault| ("area", fault)),
    }
}

/// The kernel divides by the solid angle, and samples around a unit vector.
fn directional(record: &Light) -> Option<Broken> {
    if let Some(fault) = direction(record.origin) {
        return Some(("origin", fault));
    }
    if let Some(fault) = not_negative(record.edge1) {
        return Some(("edge1", fault));
    }
    let [rim, unseen, _] = record.edge2;
    positive(rim).or_else(|| unit_range([rim, unseen])).map(|fault| ("edge2", fault))
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
