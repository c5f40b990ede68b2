// Many lights: one is chosen by walking down a tree of lights, at each node towards the child that may send more to
// the point. Conty Estevez & Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting".

#import "abi/light_node.wgsl"
#import "light/light_choice.wgsl"
#import "scene/constants.wgsl"
#import "scene/records.wgsl"

// A light for the point `p`; `u` in [0, 1 - 2^-24]. Probability 0: none can light it.
fn tree_choose(p: vec3f, u: f32) -> LightChoice {
    var at = 0u;
    var pmf = 1.0;
    var rest = u;
    loop {
        let child = load_light_node_child(at);
        if ((child & LIGHT_LEAF) != 0u) { break; }
        let share = tree_share(at, child, p);
        if (share < 0.0) {
            return LightChoice(0u, 0.0);
        }
        if (rest < share) {
            at = at + 1u;
            rest = min(rest / share, 0.99999994);
            pmf = pmf * share;
        } else {
            at = child;
            rest = min((rest - share) / (1.0 - share), 0.99999994);
            pmf = pmf * (1.0 - share);
        }
    }
    return LightChoice(load_light_node_child(at) & LIGHT_LEAF_INDEX, pmf);
}

// Probability with which `tree_choose` finds light `index` from `p`, whose way from the root is in its `trail`: bit
// 0 is the first turn, 1 for the second child.
fn tree_pmf(index: u32, p: vec3f) -> f32 {
    var trail = load_light_trail(index);
    var at = 0u;
    var pmf = 1.0;
    loop {
        let child = load_light_node_child(at);
        if ((child & LIGHT_LEAF) != 0u || pmf <= 0.0) { break; }
        let share = tree_share(at, child, p);
        if (share < 0.0) {
            return 0.0;
        }
        if ((trail & 1u) == 0u) {
            at = at + 1u;
            pmf = pmf * share;
        } else {
            at = child;
            pmf = pmf * (1.0 - share);
        }
        trail = trail >> 1u;
    }
    return pmf;
}

// Probability of the first child of inner node `at`, whose second is `second`; -1 if neither can light `p`.
fn tree_share(at: u32, second: u32, p: vec3f) -> f32 {
    let a = tree_importance(load_light_node(at + 1u), p);
    let b = tree_importance(load_light_node(second), p);
    let sum = a + b;
    if (sum <= 0.0) {
        return -1.0;
    }
    return a / sum;
}

// The sky, which is not in the tree, with its share of the table; share 0 where it is no light.
fn tree_sky() -> LightChoice {
    if (load_frame_sky_at() == NONE) {
        return LightChoice(0u, 0.0);
    }
    let index = load_sky_light();
    if (index == NONE) {
        return LightChoice(0u, 0.0);
    }
    return LightChoice(index, load_light_pmf(index));
}

// An upper estimate of what the lights of a node send to `p`: power over squared distance, times the largest cosine
// that any of their normals can have with a direction to `p`. Distances are no less than the radius of the node's
// ball; in the ball every cosine may be 1.
fn tree_importance(node: LightNode, p: vec3f) -> f32 {
    let v = p - node.center;
    let d2 = dot(v, v);
    if (d2 <= node.radius2) {
        return node.power / node.radius2;
    }
    // The angle between axis and `v`, less that of the cone of normals, less that under which the ball is seen.
    let cos_v = dot(node.axis, v) / sqrt(d2);
    let sin_v = sqrt(max(1.0 - cos_v * cos_v, 0.0));
    let cos_rest = tree_cos_less(sin_v, cos_v, node.sin_spread, node.cos_spread);
    let sin_rest = tree_sin_less(sin_v, cos_v, node.sin_spread, node.cos_spread);
    let sin2_ball = node.radius2 / d2;
    let cos_ball = sqrt(max(1.0 - sin2_ball, 0.0));
    let cos_min = tree_cos_less(sin_rest, cos_rest, sqrt(sin2_ball), cos_ball);
    return node.power * max(cos_min, 0.0) / d2;
}

// cos(max(a - b, 0)) for angles in 0 ..= pi.
fn tree_cos_less(sin_a: f32, cos_a: f32, sin_b: f32, cos_b: f32) -> f32 {
    if (cos_a > cos_b) {
        return 1.0;
    }
    return cos_a * cos_b + sin_a * sin_b;
}

// sin(max(a - b, 0)) for angles in 0 ..= pi.
fn tree_sin_less(sin_a: f32, cos_a: f32, sin_b: f32, cos_b: f32) -> f32 {
    if (cos_a > cos_b) {
        return 0.0;
    }
    return sin_a * cos_b - cos_a * sin_b;
}
