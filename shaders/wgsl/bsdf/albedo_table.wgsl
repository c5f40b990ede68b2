// How a table of directional albedo is read: the cell of a place between nodes, and words of the heap.

#import "scene/bindings.wgsl"

// A place between two neighbouring nodes of an axis.
struct AlbedoCell {
    // The lower node.
    node: u32,
    // How far towards the upper one, 0 ..= 1.
    part: f32,
}

// The cell of `x`, 0 ..= 1, on an axis of `n` >= 2 nodes; beyond the ends it is clamped.
fn albedo_table_cell(x: f32, n: u32) -> AlbedoCell {
    let at = clamp(x, 0.0, 1.0) * f32(n - 1u);
    let node = min(u32(at), n - 2u);
    return AlbedoCell(node, at - f32(node));
}

// Word `i` of the table that begins at heap word `first`.
fn albedo_table_load(first: u32, i: u32) -> vec4f {
    return bitcast<vec4f>(heap_word(first + i));
}

// The value at a place among cells, `columns` of them in a row, whose words hold the values at their corners.
fn albedo_table_corners(first: u32, columns: u32, row: AlbedoCell, column: AlbedoCell) -> f32 {
    let corners = albedo_table_load(first, row.node * columns + column.node);
    let low = corners.x + (corners.y - corners.x) * column.part;
    let high = corners.z + (corners.w - corners.z) * column.part;
    return low + (high - low) * row.part;
}

// Between the words of two neighbouring nodes, `stride` apart.
fn albedo_table_mix(first: u32, i: u32, stride: u32, part: f32) -> vec4f {
    let low = albedo_table_load(first, i);
    return low + (albedo_table_load(first, i + stride) - low) * part;
}
