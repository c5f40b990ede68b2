//! What a scene needs of the kernel, and why: read off the records, so that it cannot be wrong.

use std::collections::BTreeSet;

use pack::abi::{
    LightKind, Material, MaterialKind, NONE, SamplerKind, SkyKind, TRI_SMOOTH, TextureFormat,
    material_flag,
};
use shaders::{FeatureSet, NodeLayout, WINDOW_WORDS, Windows};

use crate::lower::Lowered;

/// The features that the records use.
pub(super) fn of(lowered: &Lowered) -> FeatureSet {
    let materials = &lowered.materials;
    let words = |bytes: usize| {
        let windows = (bytes / 16).div_ceil(WINDOW_WORDS as usize).max(1);
        u32::try_from(windows).expect("sections hold at most 2^33 words")
    };
    FeatureSet {
        triangles: !lowered.triangles.is_empty(),
        spheres: !lowered.spheres.is_empty(),
        smooth_normals: lowered.shades.iter().any(|shade| shade.object & TRI_SMOOTH != 0),
        materials: MaterialKind::ALL
            .into_iter()
            .filter(|kind| materials.iter().any(|m| m.kind == *kind as u32))
            .collect(),
        lights: LightKind::ALL
            .into_iter()
            .filter(|kind| lowered.lights.iter().any(|light| light.kind == *kind as u32))
            .collect(),
        light_choice: lowered.lights.len() > 1,
        light_tree: !lowered.light_nodes.is_empty(),
        tint: materials.iter().any(|m| m.flags & material_flag::EMIT_TINT != 0),
        skies: lowered
            .sky
            .iter()
            .filter_map(|sky| SkyKind::from_tag(sky.kind))
            .collect::<BTreeSet<_>>(),
        lens: lowered.camera.lens_radius > 0.0,
        samplers: SamplerKind::from_tag(lowered.render.sampler).into_iter().collect(),
        textures: FORMATS
            .into_iter()
            .filter(|format| lowered.textures.iter().any(|t| t.format == *format as u32))
            .collect(),
        alpha_clip: materials.iter().any(|m| m.flags & material_flag::ALPHA_CLIP != 0),
        tangents: materials.iter().any(|m| m.flags & material_flag::TANGENT != 0),
        principled_specular: materials.iter().any(Material::has_specular),
        principled_coat: materials.iter().any(Material::has_coat),
        principled_transmission: materials.iter().any(Material::has_transmission),
        normal_maps: materials.iter().any(|m| m.normal_texture != NONE),
        objects: materials.iter().any(|m| m.flags & material_flag::OBJECT != 0),
        media: lowered.render.air != NONE
            || materials.iter().any(|m| m.flags & material_flag::INTERIOR != 0),
        scattering: lowered.media.iter().any(|m| m.sigma_s.iter().any(|sigma| *sigma > 0.0)),
        fog: lowered.render.fog != NONE,
        through: materials.iter().any(|m| m.flags & material_flag::THROUGH != 0),
        sheets: materials.iter().any(Material::is_sheet),
        instances: !lowered.instances.is_empty(),
        motion: lowered.objects.iter().any(pack::abi::Object::moves),
        layouts: [layout(lowered)].into(),
        stack_size: lowered.render.stack_need.max(1),
        windows: Windows {
            node: words(
                size_of_val(lowered.nodes.as_slice()) + size_of_val(lowered.wide_nodes.as_slice()),
            ),
            tri: words(size_of_val(lowered.triangles.as_slice())),
            shade: words(size_of_val(lowered.shades.as_slice())),
            sphere: words(size_of_val(lowered.spheres.as_slice())),
            texel: words(size_of_val(lowered.texels.as_slice())),
        },
    }
}

/// How the nodes are stored; a tree without any has no layout, which is the binary one.
fn layout(lowered: &Lowered) -> NodeLayout {
    if lowered.wide_nodes.is_empty() { NodeLayout::Binary } else { NodeLayout::Wide }
}

const FORMATS: [TextureFormat; 3] =
    [TextureFormat::Rgba8Srgb, TextureFormat::Rgba8Linear, TextureFormat::Rgba16Float];

type Reasons = Vec<(String, String)>;

/// Features that are in, and features that are not, each with its reason.
pub(super) fn explain(features: &FeatureSet, lowered: &Lowered) -> (Reasons, Reasons) {
    let mut rows: Vec<(String, bool, String)> = vec![
        row("triangles", features.triangles, format!("{} triangles", lowered.triangles.len())),
        row("spheres", features.spheres, format!("{} spheres", lowered.spheres.len())),
        row("smooth normals", features.smooth_normals, "a mesh has normals".to_owned()),
        row("light tree", features.light_tree, format!("{} lights", lowered.lights.len())),
        row("tint", features.tint, "a light is tinted".to_owned()),
        row("lens", features.lens, "the aperture is open".to_owned()),
        row("alpha clip", features.alpha_clip, "a material cuts out by alpha".to_owned()),
    ];
    rows.push(row("tangents", features.tangents, "a material has a direction".to_owned()));
    rows.push(row("objects", features.objects, "a material depends on the thing".to_owned()));
    let of = |what: &str| format!("a principled material has {what}");
    rows.push(row("specular factor", features.principled_specular, of("one")));
    rows.push(row("coat", features.principled_coat, of("one")));
    rows.push(row("transmission", features.principled_transmission, of("some")));
    rows.push(row("normal maps", features.normal_maps, "a material has one".to_owned()));
    rows.push(row("media", features.media, "light must know what it is inside of".to_owned()));
    rows.push(row("scattering media", features.scattering, "a medium scatters".to_owned()));
    rows.push(row("fog", features.fog, "the atmosphere is fog".to_owned()));
    rows.push(row(
        "shadow rays through",
        features.through,
        "things have an inside, or are thin".to_owned(),
    ));
    rows.push(row("sheets", features.sheets, "light goes straight through thin things".to_owned()));
    rows.push(row(
        "instances",
        features.instances,
        format!("{} of meshes", lowered.instances.len()),
    ));
    rows.push(row("motion", features.motion, "things move while the shutter is open".to_owned()));
    let wide = features.layouts.contains(&NodeLayout::Wide);
    let n_wide = lowered.wide_nodes.len();
    rows.push(row("wide nodes", wide, format!("{n_wide} nodes with up to four children")));
    for kind in MaterialKind::ALL {
        let users: Vec<&str> = (lowered.materials.iter().zip(&lowered.material_names))
            .filter(|(material, _)| material.kind == kind as u32)
            .map(|(_, (name, _))| name.as_str())
            .collect();
        let name = format!("material {}", format!("{kind:?}").to_lowercase());
        let reason = match users.as_slice() {
            [] => String::new(),
            [one] => format!("used by `{one}`"),
            [first, rest @ ..] => format!("used by `{first}` and {} more", rest.len()),
        };
        rows.push((name, features.materials.contains(&kind), reason));
    }
    for kind in LightKind::ALL {
        let count = lowered.lights.iter().filter(|light| light.kind == kind as u32).count();
        let name = format!("light {}", format!("{kind:?}").to_lowercase());
        rows.push((name, count > 0, format!("{count} in the light table")));
    }
    for kind in SkyKind::ALL {
        let name = format!("sky {}", format!("{kind:?}").to_lowercase());
        rows.push((name, features.skies.contains(&kind), "declared".to_owned()));
    }
    for kind in SamplerKind::ALL {
        let name = format!("sampler {}", format!("{kind:?}").to_lowercase());
        rows.push((name, features.samplers.contains(&kind), "the render's choice".to_owned()));
    }
    for format in FORMATS {
        let count = lowered.textures.iter().filter(|t| t.format == format as u32).count();
        let name = format!("texture {}", format!("{format:?}").to_lowercase());
        rows.push((name, count > 0, format!("{count} images")));
    }
    let (kept, left): (Vec<_>, Vec<_>) = rows.into_iter().partition(|(_, kept, _)| *kept);
    let kept = kept.into_iter().map(|(name, _, reason)| (name, reason)).collect();
    let left = left.into_iter().map(|(name, ..)| (name, "nothing uses it".to_owned())).collect();
    (kept, left)
}

fn row(name: &str, kept: bool, reason: String) -> (String, bool, String) {
    (name.to_owned(), kept, reason)
}
