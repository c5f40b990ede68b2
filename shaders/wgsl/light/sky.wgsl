// The sky as a light: a direction by a row, then a column, of a table of cells, and uniform by solid angle in the
// cell. The table holds sums of shares that are whole multiples of 2^-24, as the random numbers are, so that
// the density is exactly what the choice gives. Its layout: `sky_table_values` of the pack.

#import "light/light_sample.wgsl"
#import "math/vector.wgsl"
#import "scene/bindings.wgsl"
#import "scene/records.wgsl"
#import "sky/lat_long.wgsl"
#import "trace/ray.wgsl"

// A direction to the sky; `u` in [0, 1 - 2^-24]^2.
fn sky_light_sample(u: vec2f) -> LightSample {
    let n_rows = load_sky_rows();
    let n_columns = load_sky_columns();
    let row = sky_light_find(0u, n_rows, u.y);
    let cells = sky_light_cells(row, n_rows, n_columns);
    let column = sky_light_find(cells, n_columns, u.x);
    let across = f32(column) + sky_light_within(cells, column, u.x);
    let top = sky_light_value(n_rows + row);
    let height = top - sky_light_value(n_rows + row + 1u);
    let y = top - height * sky_light_within(0u, row, u.y);
    let wi = lat_long_direction(across / f32(n_columns), y, load_sky_rotation());
    return LightSample(wi, RAY_FAR, sky_light_density(row, column), true);
}

// Density of `sky_light_sample` along the unit vector `dir`, per steradian.
fn sky_light_pdf(dir: vec3f) -> f32 {
    let n_rows = load_sky_rows();
    let n_columns = load_sky_columns();
    let place = lat_long_place(dir, load_sky_rotation());
    let row = min(u32(place.y * f32(n_rows)), n_rows - 1u);
    let column = min(u32(place.x * f32(n_columns)), n_columns - 1u);
    return sky_light_density(row, column);
}

// Density in a cell: its share over its solid angle.
fn sky_light_density(row: u32, column: u32) -> f32 {
    let n_rows = load_sky_rows();
    let n_columns = load_sky_columns();
    let cells = sky_light_cells(row, n_rows, n_columns);
    let share = sky_light_share(0u, row) * sky_light_share(cells, column);
    let height = sky_light_value(n_rows + row) - sky_light_value(n_rows + row + 1u);
    return share * f32(n_columns) / (2.0 * PI * height);
}

// Index of the first of `n` sums from `first` on that exceeds `u`; the last is exactly 1.
fn sky_light_find(first: u32, n: u32, u: f32) -> u32 {
    var low = 0u;
    var high = n - 1u;
    loop {
        if (low >= high) { break; }
        let middle = (low + high) / 2u;
        if (sky_light_value(first + middle) > u) {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    return low;
}

// The sum before entry `i` of the sums from `first` on.
fn sky_light_before(first: u32, i: u32) -> f32 {
    if (i == 0u) {
        return 0.0;
    }
    return sky_light_value(first + i - 1u);
}

// Probability of entry `i` of the sums from `first` on, exact.
fn sky_light_share(first: u32, i: u32) -> f32 {
    return sky_light_value(first + i) - sky_light_before(first, i);
}

// Where in entry `i` the number `u` falls, 0 .. 1; in the middle of its step of 2^-24, so that an entry of few
// steps is covered evenly.
fn sky_light_within(first: u32, i: u32, u: f32) -> f32 {
    let share = sky_light_share(first, i);
    return min((u - sky_light_before(first, i)) / share + 2.9802322e-8 / share, 0.99999994);
}

// Number of the first value of a row's columns.
fn sky_light_cells(row: u32, n_rows: u32, n_columns: u32) -> u32 {
    return 2u * n_rows + 1u + row * n_columns;
}

// Value `k` of the table, four a word.
fn sky_light_value(k: u32) -> f32 {
    let word = heap_word(load_frame_sky_table_at() + (k >> 2u));
    let low = select(word.x, word.y, (k & 1u) == 1u);
    let high = select(word.z, word.w, (k & 1u) == 1u);
    return bitcast<f32>(select(low, high, (k & 2u) == 2u));
}
