//! `scene/candidate.wgsl`, `scene/leaf.wgsl` and `scene/nodes.wgsl`: what the traversal does with a
//! primitive, a leaf and a node.

use super::imports;
use crate::{FeatureSet, NodeLayout};
use std::fmt::Write as _;

/// Whether a primitive that the ray meets is there: not the light that a shadow ray goes to, not cut out.
pub(crate) fn candidate(features: &FeatureSet) -> String {
    let mut text =
        String::from("// Generated: whether a primitive that a ray meets is there for it.\n\n");
    text += &imports([
        "abi/sphere.wgsl",
        "scene/constants.wgsl",
        "scene/records.wgsl",
        "shape/sphere.wgsl",
        "shape/triangle.wgsl",
        "trace/alpha.wgsl",
        "trace/ray.wgsl",
    ]);
    text += "\n// Triangle `i` at barycentric weights `b`; `light`: as in `Ray`.\n\
             fn candidate_triangle(i: u32, b: vec2f, light: u32) -> bool {\n";
    if features.surface_lights() {
        text += "    if (light != NONE && load_tri_shade_light(i) == light) {\n        return false;\n    }\n";
    }
    if features.alpha_clip {
        text += "    let material = load_tri_shade_material(i);\n    \
                 return alpha_is_plain(material) || alpha_exists(material, triangle_uv(i, b));\n}\n";
    } else {
        text += "    return true;\n}\n";
    }
    text += "\n// A sphere at distance `t` of the ray, which starts at `origin` for a sphere that stands still.\n\
             fn candidate_sphere(sphere: Sphere, ray: Ray, origin: vec3f, t: f32) -> bool {\n";
    if features.surface_lights() {
        text += "    if (ray.light != NONE && sphere.light == ray.light) {\n        return false;\n    }\n";
    }
    if features.alpha_clip {
        text += "    if (alpha_is_plain(sphere.material)) {\n        return true;\n    }\n    \
                 let uv = sphere_uv(sphere_normal(sphere, origin, ray.dir, t));\n    \
                 return alpha_exists(sphere.material, uv);\n}\n";
    } else {
        text += "    return true;\n}\n";
    }
    text
}

/// What a leaf's reference stands for, and what is worked out once a ray for it.
pub(crate) fn leaf(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: the leaves of this scene's tree.\n\n");
    let mut modules = vec!["scene/constants.wgsl", "trace/ray.wgsl"];
    if features.triangles {
        modules.extend(["shape/triangle.wgsl", "trace/triangles.wgsl"]);
    }
    if features.spheres {
        modules.push("trace/spheres.wgsl");
    }
    text += &imports(modules);
    let (prepared, value) = if features.triangles {
        ("TriangleShear", "triangle_shear(ray.dir)")
    } else {
        ("u32", "0u")
    };
    let _ = write!(
        text,
        "\nalias Leaf = {prepared};\n\n\
         // What the leaves need of the ray, worked out once.\n\
         fn leaf_prepare(ray: Ray) -> Leaf {{\n    return {value};\n}}\n\n\
         // The better of `best` and the hits in the leaf with reference `child`.\n\
         fn leaf_trace(child: u32, ray: Ray, leaf: Leaf, best: Hit) -> Hit {{\n    \
         let first = child & CHILD_FIRST;\n    \
         let count = ((child >> CHILD_COUNT_SHIFT) & 7u) + 1u;\n"
    );
    let spheres = "spheres_trace(first, count, ray, best)";
    let triangles = "triangles_trace(first, count, ray, leaf, best)";
    if features.triangles && features.spheres {
        let _ = write!(
            text,
            "    if ((child & CHILD_SPHERES) != 0u) {{\n        return {spheres};\n    }}\n"
        );
    }
    let otherwise = match (features.triangles, features.spheres) {
        (true, _) => triangles,
        (false, true) => spheres,
        (false, false) => "best",
    };
    let _ = writeln!(text, "    return {otherwise};");
    text + "}\n"
}

/// What a node is. Only the full kernel asks.
pub(crate) fn nodes(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: the nodes of this scene's tree.\n\n");
    let visit = |layout: &NodeLayout| match layout {
        NodeLayout::Binary => ("trace/binary.wgsl", "binary_visit"),
        NodeLayout::Wide => ("trace/wide.wgsl", "wide_visit"),
    };
    let layouts = &features.layouts;
    let mut modules: Vec<&str> = layouts.iter().map(|layout| visit(layout).0).collect();
    modules.push("scene/records.wgsl");
    text += &imports(modules);
    let call = |layout: &NodeLayout| {
        format!("return {}(i, origin, inverse, t_max, n_stack);", visit(layout).1)
    };
    text += "\n// The child of node `i` to visit next, or `NONE`; others that the ray meets go on the stack.\n\
             fn dispatch_node(\n    i: u32, origin: vec3f, inverse: vec3f, t_max: f32, n_stack: ptr<function, u32>,\n\
             ) -> u32 {\n";
    if layouts.len() > 1 {
        let _ = writeln!(
            text,
            "    if (load_frame_wide() != 0u) {{\n        {}\n    }}",
            call(&NodeLayout::Wide)
        );
    }
    let last = layouts.first().unwrap_or(&NodeLayout::Binary);
    let _ = writeln!(text, "    {}", call(last));
    text + "}\n"
}
