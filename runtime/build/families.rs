//! Families of feature sets: in each, one group of features takes all its values, and all others are there.

use pack::abi::{
    CameraKind, FilterKind, LightKind, LightSurface, MaterialKind, SamplerKind, SkyKind,
    TextureFormat,
};
use pack::features as bit;
use shaders::{FeatureSet, NodeLayout};
use std::collections::BTreeSet;

/// A family: the feature bits that vary, and every member with its bits.
pub(crate) struct Family {
    pub(crate) mask: u64,
    pub(crate) members: Vec<(u64, FeatureSet)>,
}

/// Index of the family of [`materials`].
pub(crate) const MATERIALS: usize = 0;
/// Index of the family of [`media`].
pub(crate) const MEDIA: usize = 1;

/// Index of the family of [`geometry`].
pub(crate) const GEOMETRY: usize = 2;

/// All families.
pub(crate) fn all() -> [Family; 17] {
    [
        materials(),
        media(),
        geometry(),
        views(),
        formats(),
        asked(),
        normals(),
        samplers(),
        filters(),
        lengths(),
        tints(),
        unseen(),
        choices(),
        layers(),
        motion(),
        instances(),
        layouts(),
    ]
}

/// Every subset of `all`.
fn subsets<T: Copy + Ord>(all: &[T]) -> Vec<BTreeSet<T>> {
    (0..1_u32 << all.len())
        .map(|bits| {
            all.iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1).map(|(_, t)| *t).collect()
        })
        .collect()
}

/// Materials, and media that scatter: whatever has a case of its own where light is scattered.
fn materials_mask() -> u64 {
    MaterialKind::ALL.into_iter().map(MaterialKind::feature).sum::<u64>() | bit::SCATTERING
}

/// No material, and each alone: these dispatch without a `switch`.
fn materials() -> Family {
    let clear = FeatureSet { scattering: false, ..FeatureSet::full() };
    let none = FeatureSet { materials: BTreeSet::new(), ..clear.clone() };
    let mut members = vec![(0, none)];
    members.extend(
        MaterialKind::ALL
            .into_iter()
            .map(|kind| (kind.feature(), FeatureSet { materials: [kind].into(), ..clear.clone() })),
    );
    Family { mask: materials_mask(), members }
}

/// Media, fog, and what shadow rays go through.
fn media() -> Family {
    let mut members = Vec::new();
    for (media, scattering) in [(false, false), (true, false), (true, true)] {
        let behind = [(false, false), (true, false), (true, true)];
        let both = behind.map(|behind| [(false, behind), (true, behind)]);
        for (fog, (through, sheets)) in both.into_iter().flatten() {
            let rows = [
                (media, bit::MEDIA),
                (scattering, bit::SCATTERING),
                (fog, bit::FOG),
                (through, bit::THROUGH),
                (sheets, bit::SHEETS),
            ];
            let bits = rows.iter().filter(|row| row.0).map(|row| row.1).sum();
            let features =
                FeatureSet { media, scattering, fog, through, sheets, ..FeatureSet::full() };
            members.push((bits, features));
        }
    }
    Family { mask: bit::MEDIA | bit::SCATTERING | bit::FOG | bit::THROUGH | bit::SHEETS, members }
}

/// A feature that is there or not and depends on no other: `with` has it or has it not, and everything else.
fn alone(mask: u64, with: fn(bool) -> FeatureSet) -> Family {
    Family { mask, members: vec![(0, with(false)), (mask, with(true))] }
}

/// What materials ask of a surface point. Tangents depend on the shapes too. Projected textures have no bit: their code
/// asks whether there are any.
fn asked() -> Family {
    let set = |objects, projection| FeatureSet { objects, projection, ..FeatureSet::full() };
    let members = vec![
        (0, set(false, false)),
        (bit::OBJECTS, set(true, false)),
        (bit::OBJECTS, set(true, true)),
    ];
    Family { mask: bit::OBJECTS, members }
}

/// Layers of principled surfaces.
fn layers() -> Family {
    let bits = [
        bit::PRINCIPLED_SPECULAR,
        bit::PRINCIPLED_COAT,
        bit::PRINCIPLED_TRANSMISSION,
        bit::PRINCIPLED_SHEEN,
        bit::PRINCIPLED_ANISOTROPY,
    ];
    let member = |rows: BTreeSet<u64>| {
        let [
            principled_specular,
            principled_coat,
            principled_transmission,
            principled_sheen,
            principled_anisotropy,
        ] = bits.map(|bit| rows.contains(&bit));
        let features = FeatureSet {
            principled_specular,
            principled_coat,
            principled_transmission,
            principled_sheen,
            principled_anisotropy,
            ..FeatureSet::full()
        };
        (rows.iter().sum(), features)
    };
    Family { mask: bits.iter().sum(), members: subsets(&bits).into_iter().map(member).collect() }
}

/// What tilts shading normals.
fn normals() -> Family {
    alone(bit::NORMAL_MAPS, |normal_maps| FeatureSet { normal_maps, ..FeatureSet::full() })
}

/// Whether anything moves. Ways of several pieces and cameras with keys have no bits: their code asks whether they are
/// there, and is as sound where they are not.
fn motion() -> Family {
    let set =
        |motion, keys, camera_keys| FeatureSet { motion, keys, camera_keys, ..FeatureSet::full() };
    let ways = [(false, false), (true, false), (false, true), (true, true)];
    let mut members = vec![(0, set(false, false, false))];
    members.extend(ways.map(|(keys, camera)| (bit::MOTION, set(true, keys, camera))));
    Family { mask: bit::MOTION, members }
}

/// Whether paths may have any length.
fn lengths() -> Family {
    alone(bit::UNLIMITED, |unlimited| FeatureSet { unlimited, ..FeatureSet::full() })
}

/// Whether meshes have instances.
fn instances() -> Family {
    alone(bit::INSTANCES, |instances| FeatureSet { instances, ..FeatureSet::full() })
}

/// How nodes are stored.
fn layouts() -> Family {
    let members = [(0, NodeLayout::Binary), (bit::WIDE_NODES, NodeLayout::Wide)];
    let member =
        |(bits, layout)| (bits, FeatureSet { layouts: [layout].into(), ..FeatureSet::full() });
    Family { mask: bit::WIDE_NODES, members: members.map(member).into() }
}

fn skies_and_cameras() -> Vec<(u64, FeatureSet)> {
    let mut members = Vec::new();
    for (camera, lens, blades) in [
        (CameraKind::Perspective, false, false),
        (CameraKind::Perspective, true, false),
        (CameraKind::Perspective, true, true),
        (CameraKind::Orthographic, false, false),
        (CameraKind::Panoramic, false, false),
    ] {
        for skies in subsets(&SkyKind::ALL) {
            let bits = skies.iter().map(|sky| sky.feature()).sum::<u64>()
                | if lens { bit::LENS } else { 0 }
                | if blades { bit::BLADES } else { 0 }
                | camera.feature();
            let cameras = [camera].into();
            let features = FeatureSet { cameras, lens, blades, skies, ..FeatureSet::full() };
            members.push((bits, features));
        }
    }
    members
}

/// What the camera does not see.
fn unseen() -> Family {
    alone(bit::UNSEEN, |unseen| FeatureSet { unseen, ..FeatureSet::full() })
}

/// Lights that depend on direction: tinted ones, spots, and those with a profile.
fn tints() -> Family {
    let bits = [bit::TINT, bit::SPOT, bit::PROFILE];
    let member = |rows: BTreeSet<u64>| {
        let [tint, spot, profile] = bits.map(|bit| rows.contains(&bit));
        (rows.iter().sum(), FeatureSet { tint, spot, profile, ..FeatureSet::full() })
    };
    Family { mask: bits.iter().sum(), members: subsets(&bits).into_iter().map(member).collect() }
}

/// Several lights, the tree of lights, and light linking, which has no bit: its code asks whether there is any.
fn choices() -> Family {
    let member = |(light_choice, light_tree), links| {
        let choice = if light_choice { bit::LIGHT_CHOICE } else { 0 };
        let tree = if light_tree { bit::LIGHT_TREE } else { 0 };
        (choice | tree, FeatureSet { light_choice, light_tree, links, ..FeatureSet::full() })
    };
    let all = [(false, false), (true, false), (true, true)];
    let members = all.into_iter().flat_map(|choice| [false, true].map(|on| member(choice, on)));
    Family { mask: bit::LIGHT_CHOICE | bit::LIGHT_TREE, members: members.collect() }
}

fn views() -> Family {
    let mask = SkyKind::ALL.into_iter().map(SkyKind::feature).sum::<u64>()
        | bit::CAMERAS
        | bit::LENS
        | bit::BLADES;
    Family { mask, members: skies_and_cameras() }
}

fn formats() -> Family {
    let mask = TextureFormat::ALL.into_iter().map(TextureFormat::feature).sum();
    let mut members = Vec::new();
    for textures in subsets(&TextureFormat::ALL) {
        // Whether there are textures at all belongs to the family of shapes.
        if !textures.is_empty() {
            let bits = textures.iter().map(|format| format.feature()).sum();
            members.push((bits, FeatureSet { textures, ..FeatureSet::full() }));
        }
    }
    Family { mask, members }
}

fn samplers() -> Family {
    let members = SamplerKind::ALL
        .map(|kind| (kind.feature(), FeatureSet { samplers: [kind].into(), ..FeatureSet::full() }));
    Family { mask: bit::SAMPLER_PCG, members: members.into() }
}

/// How the samples of a pixel are spread.
fn filters() -> Family {
    let members = FilterKind::ALL
        .map(|kind| (kind.feature(), FeatureSet { filters: [kind].into(), ..FeatureSet::full() }));
    Family { mask: bit::FILTERS, members: members.into() }
}

/// Whether there are textures, and what they cut out; whether surfaces are there in part, and have tangents.
fn coverages() -> impl Iterator<Item = ((bool, bool), [bool; 2])> {
    let cut = [(false, false), (true, false), (true, true)];
    let rest = [[false, false], [false, true], [true, false], [true, true]];
    cut.into_iter().flat_map(move |cut| rest.map(|rest| (cut, rest)))
}

/// Shapes, lights, cut-outs, and whether there are textures at all. Any formats of textures stand
/// for all: their own family covers them.
fn geometry() -> Family {
    let format_bits: Vec<u64> = subsets(&TextureFormat::ALL.map(TextureFormat::feature))
        .iter()
        .map(|bits| bits.iter().sum())
        .collect();
    let mut members = Vec::new();
    for (triangles, smooth_normals, spheres) in [
        (false, false, false),
        (false, false, true),
        (true, false, false),
        (true, true, false),
        (true, false, true),
        (true, true, true),
    ] {
        for ((textures, alpha_clip), [alpha_blend, tangents]) in coverages() {
            for lights in subsets(&LightKind::ALL) {
                let mut bits = lights.iter().map(|kind| kind.feature()).sum::<u64>();
                bits |= if triangles { bit::TRIANGLES } else { 0 };
                bits |= if spheres { bit::SPHERES } else { 0 };
                bits |= if alpha_clip { bit::ALPHA_CLIP } else { 0 };
                bits |= if alpha_blend { bit::ALPHA_BLEND } else { 0 };
                bits |= if tangents { bit::TANGENTS } else { 0 };
                let possible = lights.iter().all(|kind| match kind.surface() {
                    Some(LightSurface::Sphere) => spheres,
                    Some(LightSurface::Triangles) => triangles,
                    // The camera sees a directional light where nothing else is.
                    None => triangles || spheres || *kind == LightKind::Directional,
                });
                if !possible {
                    continue;
                }
                let full = FeatureSet::full();
                let formats = if textures { full.textures.clone() } else { BTreeSet::new() };
                let features = FeatureSet {
                    triangles,
                    smooth_normals,
                    spheres,
                    lights,
                    alpha_clip,
                    alpha_blend,
                    tangents,
                    textures: formats,
                    ..full
                };
                for format in format_bits.iter().filter(|format| textures == (**format != 0)) {
                    members.push((bits | format, features.clone()));
                }
            }
        }
    }
    let mask = bit::TRIANGLES
        | bit::SPHERES
        | bit::ALPHA_CLIP
        | bit::ALPHA_BLEND
        | bit::TANGENTS
        | LightKind::ALL.into_iter().map(LightKind::feature).sum::<u64>()
        | TextureFormat::ALL.into_iter().map(TextureFormat::feature).sum::<u64>();
    Family { mask, members }
}
