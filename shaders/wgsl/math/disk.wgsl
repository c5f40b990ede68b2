// A point uniform on the unit disk from one of the unit square.
// Shirley & Chiu 1997, "A Low Distortion Map Between Disk and Square", JGT 2(3): neighbours stay neighbours and
// cells stay compact, so that samples that are spread evenly over the square are so over the disk. Angle and radius
// from a coordinate each would tear the disk along a ray and make slivers of the cells at its middle.

#import "math/sincos.wgsl"

// A point of the disk in polar form.
struct Disk {
    // (cos, sin) of the angle.
    turn: vec2f,
    // Distance to the middle, in (0, 1 - 2^-24].
    r: f32,
}

// The point for `u` in [0, 1 - 2^-24]^2, of which a coordinate is a multiple of 2^-24. Its `r * r` is as uniform as a
// coordinate of `u`, and independent of `turn`.
fn disk_concentric(u: vec2f) -> Disk {
    // 2 u - 1 and half a step of `u`: both signs alike, never 0 for a multiple of 2^-24, and exact.
    let q = 2.0 * u - vec2f(0.999999940395355225);
    let wide = abs(q.x) > abs(q.y);
    let far = select(q.y, q.x, wide);
    let near = select(q.x, q.y, wide);
    // The angle from the axis that is nearer, at most an eighth of a turn.
    let sc = sincos_pi(0.25 * (near / far));
    let turn = select(sc, sc.yx, wide);
    return Disk(select(turn, -turn, far < 0.0), abs(far));
}
