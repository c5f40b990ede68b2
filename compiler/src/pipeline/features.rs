//! What a scene needs of the kernel: read off the records, so that it cannot be wrong.

use pack::abi::{
    CameraKind, FilterKind, LightKind, Material, MaterialKind, NONE, SamplerKind, SkyKind,
    TRI_SMOOTH, TextureFormat, UNLIMITED_DEPTH, material_flag,
};
use shaders::{FeatureSet, NodeLayout, WINDOW_WORDS, Windows};

use crate::lower::Lowered;

/// The features that the records use.
pub(super) fn of(lowered: &Lowered) -> FeatureSet {
    let materials = &lowered.materials;
    let some = |is: fn(&Material) -> bool| materials.iter().any(is);
    let flagged = |flag: u32| materials.iter().any(|material| material.flags & flag != 0);
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
        tint: flagged(material_flag::EMIT_TINT),
        spot: flagged(material_flag::EMIT_SPOT),
        profile: flagged(material_flag::EMIT_PROFILE),
        unseen: flagged(material_flag::UNSEEN)
            || lowered.lights.iter().any(pack::abi::Light::is_unseen)
            || lowered.sky.iter().any(|sky| sky.unseen != 0),
        skies: lowered.sky.iter().filter_map(|sky| SkyKind::from_tag(sky.kind)).collect(),
        filters: FilterKind::from_tag(lowered.render.filter).into_iter().collect(),
        cameras: CameraKind::from_tag(lowered.camera.kind).into_iter().collect(),
        blades: lowered.camera.lens_radius > 0.0 && lowered.camera.blades > 0,
        lens: lowered.camera.lens_radius > 0.0,
        unlimited: lowered.render.max_depth == UNLIMITED_DEPTH,
        samplers: SamplerKind::from_tag(lowered.render.sampler).into_iter().collect(),
        textures: TextureFormat::ALL
            .into_iter()
            .filter(|format| lowered.textures.iter().any(|t| t.format == *format as u32))
            .collect(),
        alpha_clip: flagged(material_flag::ALPHA_CLIP),
        alpha_blend: some(Material::is_partial),
        tangents: flagged(material_flag::TANGENT),
        principled_specular: some(Material::has_specular),
        principled_coat: some(Material::has_coat),
        principled_transmission: some(Material::has_transmission),
        principled_sheen: some(Material::has_sheen),
        principled_anisotropy: some(Material::is_brushed),
        normal_maps: materials.iter().any(|m| m.normal_texture != NONE),
        objects: flagged(material_flag::OBJECT),
        projection: flagged(material_flag::PROJECT),
        media: lowered.render.air != NONE || flagged(material_flag::INTERIOR),
        scattering: lowered.media.iter().any(|m| m.sigma_s.iter().any(|sigma| *sigma > 0.0)),
        fog: lowered.render.fog != NONE,
        through: flagged(material_flag::THROUGH),
        sheets: some(Material::is_sheet),
        instances: !lowered.instances.is_empty(),
        motion: lowered.objects.iter().any(pack::abi::Object::moves)
            || !lowered.camera_keys.is_empty(),
        keys: !lowered.motion.is_empty(),
        camera_keys: !lowered.camera_keys.is_empty(),
        links: !lowered.links.is_empty(),
        layouts: [layout(lowered)].into(),
        stack_size: lowered.render.stack_need.max(1),
        windows: Windows {
            node: words(size_of_val(&*lowered.nodes) + size_of_val(&*lowered.wide_nodes)),
            tri: words(size_of_val(&*lowered.triangles)),
            shade: words(size_of_val(&*lowered.shades)),
            sphere: words(size_of_val(&*lowered.spheres)),
            texel: words(size_of_val(&*lowered.texels)),
        },
    }
}

/// How the nodes are stored; a tree without any has no layout, which is the binary one.
fn layout(lowered: &Lowered) -> NodeLayout {
    if lowered.wide_nodes.is_empty() { NodeLayout::Binary } else { NodeLayout::Wide }
}
