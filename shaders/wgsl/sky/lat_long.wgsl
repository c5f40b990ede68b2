// Directions and their places on a map of all directions whose rows are polar angles and whose columns are
// azimuths. World frame, y up; without rotation the first column lies towards -z and columns go on to +x.

#import "math/atan.wgsl"
#import "math/sincos.wgsl"

// Column and row of the unit vector `dir` as shares, 0 ..= 1 from the top left. `rotation`: turns.
// Straight up and down every column is the same point, and the answer is that of azimuth 0.
fn lat_long_place(dir: vec3f, rotation: f32) -> vec2f {
    let turn = atan_turns(dir.x, -dir.z) + rotation;
    let across = sqrt(dir.x * dir.x + dir.z * dir.z);
    return vec2f(turn - floor(turn), 2.0 * atan_turns(across, dir.y));
}

// The unit vector at column share `u` in 0 ..= 1 and cosine `y` of the polar angle.
fn lat_long_direction(u: f32, y: f32, rotation: f32) -> vec3f {
    let turn = u - rotation;
    let across = sqrt(max(1.0 - y * y, 0.0));
    let sc = sincos_2pi(turn - floor(turn)) * across;
    return vec3f(sc.x, y, -sc.y);
}
