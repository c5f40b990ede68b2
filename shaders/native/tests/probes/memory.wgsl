// Variables, pointers, structs, arrays and resources.

struct Leaf { weight: f32, count: u32 }
struct Tree { left: Leaf, right: Leaf, table: array<u32, 3>, axis: vec3<f32> }

const PRIMES = array<u32, 5>(2u, 3u, 5u, 7u, 11u);
const CORNERS = array<vec2<f32>, 3>(vec2(0.0, 0.1), vec2(1.0, 0.2), vec2(2.0, 0.3));
const STACK_SIZE = 8u;

@group(0) @binding(0) var<uniform> frame_words: array<vec4<u32>, 2>;
@group(0) @binding(1) var<storage, read> node_words: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> weights: array<f32>;
@group(0) @binding(3) var<storage, read> leaves: array<Leaf>;
@group(0) @binding(4) var<storage, read_write> film_words: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read_write> sums: array<f32>;
@group(0) @binding(6) var<storage, read_write> total: Leaf;
@group(0) @binding(7) var<uniform> setting: Tree2;
@group(0) @binding(8) var<storage, read> points: array<vec2<f32>>;

struct Tree2 { gain: f32, offset: vec3<f32> }

var<private> stack: array<u32, STACK_SIZE>;
var<private> top: u32 = 3u;
var<private> rng: vec4<u32> = vec4<u32>(1u, 2u, 3u, 4u);

@compute @workgroup_size(8, 8, 1)
fn render(@builtin(global_invocation_id) gid: vec3<u32>) {
    // What an earlier invocation left behind must be gone.
    film_words[gid.x] = vec4<u32>(top, stack[0], rng.w, gid.y);
    top += 10u;
    stack[0] = 77u;
    rng = vec4<u32>(9u);
}

fn set_count(leaf: ptr<function, Leaf>, count: u32) {
    (*leaf).count = count;
    leaf.weight += 0.5;
}

fn bump(x: ptr<function, u32>) -> u32 {
    *x += 1u;
    return *x;
}

fn bump_twice(x: ptr<function, u32>) {
    bump(x);
    bump(x);
}

fn pointer_to_variable() -> u32 {
    var x = 5u;
    bump_twice(&x);
    let p = &x;
    *p *= 2u;
    return x;
}

// A pointer to a member writes through to the struct.
fn pointer_to_member() -> u32 {
    var tree: Tree;
    set_count(&tree.right, 4u);
    bump_twice(&tree.left.count);
    let p = &tree.table[1];
    *p = 6u;
    return tree.left.count * 100u + tree.right.count * 10u + tree.table[1];
}

fn pointer_to_element(i: u32) -> u32 {
    var list = array<u32, 4>(1u, 2u, 3u, 4u);
    bump_twice(&list[i]);
    return list[0] * 1000u + list[1] * 100u + list[2] * 10u + list[3];
}

// The index of a pointer is taken where the pointer is.
fn pointer_keeps_index() -> u32 {
    var list = array<u32, 3>(0u, 0u, 0u);
    var i = 1u;
    let p = &list[i];
    i = 2u;
    *p = 5u;
    return list[0] * 100u + list[1] * 10u + list[2];
}

fn structs_are_values() -> u32 {
    var a: Tree;
    a.left.count = 1u;
    var b = a;
    b.left.count = 2u;
    b.table[2] = 9u;
    let c = b;
    b.left.count = 3u;
    return a.left.count * 1000u + b.left.count * 100u + c.left.count * 10u + a.table[2];
}

fn changed(tree: Tree, count: u32) -> Tree {
    var result = tree;
    result.left = Leaf(2.5, count);
    result.axis.y = 3.0;
    return result;
}

fn structs_pass_by_value() -> f32 {
    var tree: Tree;
    let after = changed(tree, 7u);
    return f32(tree.left.count) + f32(after.left.count) * 10.0 + after.left.weight + after.axis.y;
}

fn locals_start_zeroed() -> u32 {
    var a: u32;
    var b: array<u32, 40>;
    var c: vec3<f32>;
    var d: Tree;
    var e: mat3x3<f32>;
    var f: bool;
    var g: vec2<bool>;
    return a + b[39] + u32(c.z) + d.table[2] + u32(e[2].y) + u32(f) + u32(g.y);
}

fn constant_array(i: u32) -> u32 { return PRIMES[i]; }
fn constant_array_signed(i: i32) -> u32 { return PRIMES[i]; }
fn constant_corner(i: u32) -> vec2<f32> { return CORNERS[i]; }

fn local_constant_array(i: u32) -> u32 {
    let list = array<u32, 3>(10u, 20u, 30u);
    return list[i];
}

fn read_outside(i: u32) -> u32 {
    var list = array<u32, 3>(10u, 20u, 30u);
    return list[i];
}

fn write_outside(i: u32) -> u32 {
    var list = array<u32, 3>(1u, 2u, 3u);
    list[i] = 9u;
    return list[0] * 100u + list[1] * 10u + list[2];
}

fn write_outside_nested(i: u32, j: u32) -> u32 {
    var grid: array<array<u32, 2>, 2>;
    grid[i][j] = 1u;
    return grid[0][0] * 1000u + grid[0][1] * 100u + grid[1][0] * 10u + grid[1][1];
}

fn lane_outside(i: u32) -> f32 {
    var v = vec3<f32>(1.0, 2.0, 3.0);
    v[i] = 5.0;
    return v.x * 100.0 + v.y * 10.0 + v.z;
}

fn lane_of_value(v: vec4<u32>, i: u32) -> u32 { return v[i]; }
fn lane_of_bools(v: vec3<bool>, i: u32) -> bool {
    var w = v;
    w[i] = !w[i];
    return w[i] && !v[i];
}

fn column_outside(i: u32) -> f32 {
    var m = mat2x2<f32>(1.0, 2.0, 3.0, 4.0);
    m[i] = vec2(5.0, 6.0);
    m[i][1] = 7.0;
    return m[0].x * 1000.0 + m[0].y * 100.0 + m[1].x * 10.0 + m[1].y;
}

fn store_lane() -> vec4<f32> {
    var v = vec4<f32>(0.0);
    v.z = 1.5;
    v.x += 2.0;
    v.w = v.z;
    return v;
}

fn frame(i: u32) -> vec4<u32> { return frame_words[i]; }
fn frame_first() -> u32 { return frame_words[0].y + frame_words[1].w; }
fn node(i: u32) -> vec4<u32> { return node_words[i]; }
fn node_lane(i: u32, lane: u32) -> u32 { return node_words[i][lane]; }
fn node_floats(i: u32) -> vec3<f32> { return bitcast<vec3<f32>>(node_words[i].yzw); }
fn node_count() -> u32 { return arrayLength(&node_words); }
fn weight(i: u32) -> f32 { return weights[i]; }
fn leaf_count(i: u32) -> u32 { return leaves[i].count; }
fn leaf_weight(i: u32) -> f32 { return leaves[i].weight; }
fn point(i: u32) -> vec2<f32> { return points[i]; }
fn point_y(i: u32) -> f32 { return points[i].y; }
fn gain() -> f32 { return setting.gain + setting.offset.z; }

fn film_write(i: u32, value: vec4<u32>) { film_words[i] = value; }
fn film_lane(i: u32, value: u32) { film_words[i].z = value; }
fn film_read(i: u32) -> vec4<u32> { return film_words[i]; }
fn film_size() -> u32 { return arrayLength(&film_words); }

fn add_sum(i: u32, x: f32) -> f32 {
    sums[i] += x;
    total.weight += x;
    total.count += 1u;
    return total.weight;
}

fn push(value: u32) {
    stack[top] = value;
    top = top + 1u;
}

fn push_and_peek(a: u32, b: u32) -> u32 {
    top = 0u;
    push(a);
    push(b);
    return stack[0] * 100u + stack[1] * 10u + top;
}

fn next_random() -> u32 {
    rng = rng * 1664525u + 1013904223u;
    rng.x += rng.y * rng.w;
    return rng.x;
}

@group(0) @binding(9) var<storage, read> transforms: array<mat4x4<f32>>;
@group(0) @binding(10) var<storage, read_write> grid: array<array<vec2<f32>, 2>, 3>;
@group(0) @binding(11) var<storage, read_write> records: array<Leaf>;
@group(0) @binding(12) var<uniform> scale: f32;

var<private> table: array<array<u32, 3>, 2>;

fn transform(i: u32, p: vec4<f32>) -> vec4<f32> { return transforms[i] * p * scale; }
fn transform_column(i: u32, c: u32) -> vec4<f32> { return transforms[i][c]; }
fn grid_set(i: u32, j: u32, x: f32) -> f32 {
    grid[i][j].y = x;
    grid[i][j] += vec2<f32>(0.5, 0.0);
    return grid[i][j].x + grid[i][j].y;
}
fn record_set(i: u32, weight: f32) -> f32 {
    let before = records[i];
    records[i] = Leaf(before.weight + weight, before.count + 1u);
    return records[i].weight;
}
fn table_set(i: u32, j: u32) -> u32 {
    table[i][j] += 3u;
    return table[i][j] + table[1][2];
}
