//! `scene/after.wgsl`, `scene/candidate.wgsl`, `scene/leaf.wgsl`, `scene/nodes.wgsl`, `scene/instance_leaf.wgsl`,
//! `scene/placed.wgsl`: what the traversal does with a primitive, a leaf, a node and an instance.

use super::wgsl::imports;
use crate::{FeatureSet, NodeLayout};
use std::fmt::Write as _;

/// Whether a primitive that the ray meets is there: not the light that a shadow ray goes to, not cut out.
pub(crate) fn candidate(features: &FeatureSet) -> String {
    let mut text =
        String::from("// Generated: whether a primitive that a ray meets is there for it.\n\n");
    text += &imports([
        "abi/sphere.wgsl",
        "scene/constants.wgsl",
        "scene/placed.wgsl",
        "scene/records.wgsl",
        "shape/sphere.wgsl",
        "shape/triangle.wgsl",
        "texture/texture_point.wgsl",
        "trace/alpha.wgsl",
        "trace/ray.wgsl",
    ]);
    if features.alpha_blend {
        text += &imports(["trace/coverage.wgsl"]);
    }
    text += "\n// Triangle `i`, in the frame of `ray`, at barycentric weights `b`.\n\
             fn candidate_triangle(i: u32, b: vec2f, ray: Ray) -> bool {\n";
    if features.surface_lights() {
        text += "    if (ray.light != NONE && load_tri_shade_light(i) == ray.light) {\n        return false;\n    }\n";
    }
    if features.alpha_clip || features.alpha_blend {
        text += "    let material = dispatch_placed_material(ray.instance, load_tri_shade_material(i));\n";
    }
    if features.alpha_blend {
        text += "    if (coverage_is_partial(material)) {\n        \
                 let coverage = coverage_at(material, triangle_texture_point(i, b));\n        \
                 return coverage_meets(ray, coverage, coverage_triangle_id(i, ray.instance));\n    }\n";
    }
    text += if features.alpha_clip {
        "    return alpha_is_plain(material) || alpha_exists(material, triangle_texture_point(i, b));\n}\n"
    } else {
        "    return true;\n}\n"
    };
    text += "\n// A sphere at distance `t` of the ray, which starts at `origin` along `dir` for a sphere that stands still.\n\
             fn candidate_sphere(sphere: Sphere, ray: Ray, origin: vec3f, dir: vec3f, t: f32) -> bool {\n";
    if features.surface_lights() {
        text += "    if (ray.light != NONE && sphere.light == ray.light) {\n        return false;\n    }\n";
    }
    if features.alpha_blend {
        text += "    if (coverage_is_partial(sphere.material)) {\n        \
                 let n = sphere_normal(sphere, origin, dir, t);\n        \
                 let coverage = coverage_at(sphere.material, texture_point(sphere_uv(n)));\n        \
                 return coverage_meets(ray, coverage, coverage_sphere_id(sphere, dot(n, dir) < 0.0));\n    }\n";
    }
    if features.alpha_clip {
        text += "    if (alpha_is_plain(sphere.material)) {\n        return true;\n    }\n    \
                 let uv = sphere_uv(sphere_normal(sphere, origin, dir, t));\n    \
                 return alpha_exists(sphere.material, texture_point(uv));\n}\n";
    } else {
        text += "    return true;\n}\n";
    }
    text
}

/// Whether a ray has still to come to what it meets.
pub(crate) fn after(features: &FeatureSet) -> String {
    let mut text =
        String::from("// Generated: whether shadow rays of this scene go through surfaces.\n\n");
    text += &imports(["trace/order.wgsl", "trace/ray.wgsl"]);
    for (what, kind, place) in [
        ("Triangle `i`, in the frame of `ray`,", "triangle", "i"),
        ("The sphere", "sphere", "prim"),
    ] {
        let after = if features.through {
            format!("t > ray.t_min || (t == ray.t_min && order_{kind}_after(ray, {place}))")
        } else {
            "t > 0.0".to_owned()
        };
        let _ = write!(
            text,
            "\n// {what} at distance `t` is in front of the ray, and none of what the ray has gone through.\n\
             fn dispatch_{kind}_after(ray: Ray, t: f32, {place}: u32) -> bool {{\n    return {after};\n}}\n"
        );
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

/// `scene/shear.wgsl`: how a ray is sheared for a triangle that turns.
pub(crate) fn shear(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether triangles of this scene turn.\n\n");
    text += &imports(["shape/triangle.wgsl", "trace/ray.wgsl"]);
    let own = if features.keys {
        text += &imports(["scene/constants.wgsl", "scene/motion.wgsl"]);
        "    if ((id & MOVES) != 0u) {\n        \
         return triangle_shear(dispatch_triangle_dir(i, ray.dir, ray.time));\n    }\n"
    } else {
        ""
    };
    let _ = write!(
        text,
        "\n// The shear for triangle `i`, one of whose ids is `id`; `shear`: that for triangles that stand still.\n\
         fn dispatch_triangle_shear(i: u32, id: u32, ray: Ray, shear: TriangleShear) -> TriangleShear {{\n{own}    \
         return shear;\n}}\n"
    );
    text
}

/// How a walk goes into an instance and out of it.
pub(crate) fn instance_leaf(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether this scene has instances to walk into.\n\n");
    text += &imports(["scene/constants.wgsl", "trace/ray.wgsl", "trace/walk.wgsl"]);
    let (is_leaf, enter) = if features.instances {
        text += &imports(["scene/records.wgsl", "trace/instance.wgsl"]);
        (
            "(child & CHILD_INSTANCE) == CHILD_INSTANCE",
            "    if (child == CHILD_OUT) {\n        *walk = walk_begin(ray);\n        return NONE;\n    }\n    \
             let i = child & CHILD_INSTANCE_INDEX;\n    *walk = walk_begin(instance_ray(i, ray));\n    \
             return load_instance_root(i);\n",
        )
    } else {
        ("false", "    return NONE;\n")
    };
    let _ = write!(
        text,
        "\n// Whether the leaf's reference is that of an instance, or of the way out of one.\n\
         fn dispatch_is_instance_leaf(child: u32) -> bool {{\n    return {is_leaf};\n}}\n\
         \n// Enters or leaves the instance with `ray`, which is in the world: the root of the instance's tree, or `NONE`\n\
         // when the walk is back in the world.\n\
         fn dispatch_instance_leaf(child: u32, ray: Ray, walk: ptr<function, Walk>) -> u32 {{\n{enter}}}\n"
    );
    text
}

/// What hits in instances look like. Each function depends on nothing but whether there are any.
pub(crate) fn placed(features: &FeatureSet) -> String {
    let mut text =
        String::from("// Generated: whether triangles of this scene are in instances.\n\n");
    text += &imports([
        "scene/constants.wgsl",
        "shape/triangle.wgsl",
        "surface/surface.wgsl",
        "trace/ray.wgsl",
    ]);
    let with = |there: &'static str, absent: &'static str| {
        if features.instances { there } else { absent }
    };
    if features.instances {
        text += &imports(["shape/instance.wgsl"]);
    }
    let either = |function: &'static str, own: &'static str| {
        if features.instances {
            format!(
                "    if (instance == NONE) {{\n        return {own};\n    }}\n    \
                 return instance_{function}(instance, {own});\n"
            )
        } else {
            format!("    return {own};\n")
        }
    };
    let _ = write!(
        text,
        "\n// Whether the hit is in an instance.\n\
         fn dispatch_is_placed(hit: Hit) -> bool {{\n    return {};\n}}\n\
         \n// The surface that was hit in an instance.\n\
         fn dispatch_placed_surface(hit: Hit, dir: vec3f, time: f32) -> Surface {{\n    return {};\n}}\n\
         \n// The material of a triangle in `instance`, or in none, that has `own`.\n\
         fn dispatch_placed_material(instance: u32, own: u32) -> u32 {{\n{}}}\n\
         \n// In the world, the `tangent` of a triangle in `instance`, or in none.\n\
         fn dispatch_placed_tangent(instance: u32, tangent: vec4f) -> vec4f {{\n{}}}\n",
        with("hit.instance != NONE", "false"),
        with(
            "instance_surface(hit, dir, time)",
            "triangle_flat_surface(load_triangle(hit.prim), load_tri_shade(hit.prim), hit.b, dir)"
        ),
        either("material", "own"),
        either("tangent", "tangent"),
    );
    text
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
        format!("return {}(i, origin, inverse, t_min, t_max, n_stack);", visit(layout).1)
    };
    text += "\n// The child of node `i` to visit next, or `NONE`; others that the ray meets go on the stack.\n\
             fn dispatch_node(\n    i: u32, origin: vec3f, inverse: vec3f, t_min: f32, t_max: f32, n_stack: ptr<function, u32>,\n\
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
