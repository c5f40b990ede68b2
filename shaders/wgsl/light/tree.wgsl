// Many lights: one is chosen by walking down a tree of lights, at each node towards the child that may send more to
// the point. Conty Estevez & Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting".

#import "abi/light_node.wgsl"
#import "light/light_choice.wgsl"
#import "scene/constants.wgsl"
#import "scene/directional.wgsl"
#import "scene/records.wgsl"

// Lights up to which each is weighed by itself: bounds of nodes are coarse where lights are near.
const TREE_FEW: u32 = 8u;

// A light for the point `p` of a receiver, see `scene/receiver.wgsl`; `u` in [0, 1 - 2^-24]. Probability 0: none can
// light it.
fn tree_choose(p: vec3f, receiver: vec4f, u: f32) -> LightChoice {
    let few = tree_few();
    if (few > 0u) {
        return tree_few_choose(few, p, receiver, u);
    }
    var at = 0u;
    var child = load_light_node_child(at);
    var pmf = 1.0;
    var rest = u;
    loop {
        if ((child & LIGHT_LEAF) != 0u) { break; }
        let split = tree_split(at, child, p, receiver);
        let share = split.share;
        if (share < 0.0) {
            return LightChoice(0u, 0.0, 0.0);
        }
        if (rest < share) {
            at = at + 1u;
            child = split.first;
            rest = light_choice_unit(rest / share);
            pmf = pmf * share;
        } else {
            at = child;
            child = split.second;
            rest = light_choice_unit((rest - share) / (1.0 - share));
            pmf = pmf * (1.0 - share);
        }
    }
    return LightChoice(child & LIGHT_LEAF_INDEX, pmf, rest);
}

// Probability with which `tree_choose` finds light `index` from `p`, whose way from the root is in its `trail`: bit
// 0 is the first turn, 1 for the second child.
fn tree_pmf(index: u32, p: vec3f, receiver: vec4f) -> f32 {
    let few = tree_few();
    if (few > 0u) {
        return tree_few_pmf(few, index, p, receiver);
    }
    var trail = load_light_trail(index);
    var at = 0u;
    var child = load_light_node_child(at);
    var pmf = 1.0;
    loop {
        if ((child & LIGHT_LEAF) != 0u || pmf <= 0.0) { break; }
        let split = tree_split(at, child, p, receiver);
        if (split.share < 0.0) {
            return 0.0;
        }
        if ((trail & 1u) == 0u) {
            at = at + 1u;
            child = split.first;
            pmf = pmf * split.share;
        } else {
            at = child;
            child = split.second;
            pmf = pmf * (1.0 - split.share);
        }
        trail = trail >> 1u;
    }
    return pmf;
}

// Nodes of a tree of few lights; 0 of a larger one.
fn tree_few() -> u32 {
    let n_lights = load_frame_n_lights();
    if (n_lights > TREE_FEW + 1u) {
        return 0u;
    }
    let n = n_lights - select(0u, 1u, tree_sky().pmf > 0.0) - dispatch_n_directional();
    return select(0u, 2u * n - 1u, n <= TREE_FEW);
}

// One of the leaves of `n_nodes` nodes, by its own importance; as `tree_choose`.
fn tree_few_choose(n_nodes: u32, p: vec3f, receiver: vec4f, u: f32) -> LightChoice {
    var importance: array<f32, TREE_FEW>;
    var leaves: array<u32, TREE_FEW>;
    var n = 0u;
    var sum = 0.0;
    for (var i = 0u; i < n_nodes; i += 1u) {
        let node = load_light_node(i);
        if ((node.child & LIGHT_LEAF) == 0u) { continue; }
        let own = tree_importance(node, p, receiver);
        if (own <= 0.0) { continue; }
        sum += own;
        importance[n] = own;
        leaves[n] = node.child & LIGHT_LEAF_INDEX;
        n += 1u;
    }
    if (n == 0u) {
        return LightChoice(0u, 0.0, 0.0);
    }
    let goal = u * sum;
    var before = 0.0;
    var k = 0u;
    loop {
        if (k + 1u >= n || goal < before + importance[k]) { break; }
        before += importance[k];
        k += 1u;
    }
    return LightChoice(leaves[k], importance[k] / sum, light_choice_unit((goal - before) / importance[k]));
}

// Probability with which `tree_few_choose` finds light `index`.
fn tree_few_pmf(n_nodes: u32, index: u32, p: vec3f, receiver: vec4f) -> f32 {
    var importance = 0.0;
    var sum = 0.0;
    for (var i = 0u; i < n_nodes; i += 1u) {
        let node = load_light_node(i);
        if ((node.child & LIGHT_LEAF) == 0u) { continue; }
        let own = tree_importance(node, p, receiver);
        sum += own;
        if ((node.child & LIGHT_LEAF_INDEX) == index) {
            importance = own;
        }
    }
    if (importance <= 0.0) {
        return 0.0;
    }
    return importance / sum;
}

// The two children of an inner node.
struct TreeSplit {
    // Probability of the first; -1 if neither can light the point.
    share: f32,
    // `LightNode::child` of each.
    first: u32,
    second: u32,
}

// Splits inner node `at`, whose second child is `second`, for the point `p`.
fn tree_split(at: u32, second: u32, p: vec3f, receiver: vec4f) -> TreeSplit {
    let first_node = load_light_node(at + 1u);
    let second_node = load_light_node(second);
    // Where both are seen in nearly the same direction the receiver has the same cosine for both.
    let apart = second_node.center - first_node.center;
    let v = p - first_node.center;
    let wide = dot(apart, apart) + max(first_node.radius2, second_node.radius2);
    let own = select(vec4f(0.0), receiver, wide > 0.02 * dot(v, v));
    let a = tree_importance(first_node, p, own);
    let b = tree_importance(second_node, p, own);
    let sum = a + b;
    let share = select(a / sum, -1.0, sum <= 0.0);
    return TreeSplit(share, first_node.child, second_node.child);
}

// The sky, which is not in the tree, with its share of the table; share 0 where it is no light.
fn tree_sky() -> LightChoice {
    if (load_frame_sky_at() == NONE) {
        return LightChoice(0u, 0.0, 0.0);
    }
    let index = load_sky_light();
    if (index == NONE) {
        return LightChoice(0u, 0.0, 0.0);
    }
    return LightChoice(index, load_light_pmf(index), 0.0);
}

// An upper estimate of what the lights of a node send to `p`: power over squared distance, times the largest cosine
// that any of their normals can have with a direction to `p`, times the largest cosine at the receiver. Distances
// are no less than the radius of the node's ball; in the ball every cosine may be 1.
fn tree_importance(node: LightNode, p: vec3f, receiver: vec4f) -> f32 {
    let v = p - node.center;
    let d2 = dot(v, v);
    if (d2 <= node.radius2) {
        return node.power / node.radius2;
    }
    let v_unit = v / sqrt(d2);
    let sin2_ball = node.radius2 / d2;
    let sin_ball = sqrt(sin2_ball);
    let cos_ball = sqrt(max(1.0 - sin2_ball, 0.0));
    var cosine = tree_receiver_cos(receiver, v_unit, sin_ball, cos_ball);
    // Unless they face all ways: the angle between axis and `v`, less that of the cone of normals, less that under
    // which the ball is seen.
    if (node.cos_spread > -1.0) {
        let cos_v = dot(node.axis, v_unit);
        let sin_v = sqrt(max(1.0 - cos_v * cos_v, 0.0));
        let cos_rest = tree_cos_less(sin_v, cos_v, node.sin_spread, node.cos_spread);
        let sin_rest = tree_sin_less(sin_v, cos_v, node.sin_spread, node.cos_spread);
        cosine *= max(tree_cos_less(sin_rest, cos_rest, sin_ball, cos_ball), 0.0);
    }
    return node.power * cosine / d2;
}

// The largest cosine at the receiver of a direction to a ball that is seen from there along -`v`, unit, under this
// angle; 1 in a medium. A surface that transmits has two sides.
fn tree_receiver_cos(receiver: vec4f, v: vec3f, sin_ball: f32, cos_ball: f32) -> f32 {
    if (all(receiver.xyz == vec3f(0.0))) {
        return 1.0;
    }
    let c = -dot(receiver.xyz, v);
    let cos_v = select(abs(c), c, receiver.w > 0.0);
    let sin_v = sqrt(max(1.0 - c * c, 0.0));
    return max(tree_cos_less(sin_v, cos_v, sin_ball, cos_ball), 0.0);
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
