// An aperture of straight blades: its opening is a regular polygon.

#import "abi/camera.wgsl"
#import "math/sincos.wgsl"

// A point uniform in the polygon, to the right and up from the middle of the lens: `u` in [0, 1)^2 chooses one of the
// triangles between the middle and two corners, and the point in that.
fn blades_point(camera: Camera, u: vec2f) -> vec2f {
    let n = f32(camera.blades);
    let side = min(floor(u.x * n), n - 1.0);
    let reach = sqrt(u.x * n - side) * camera.blade_reach * camera.lens_radius;
    let a = blades_corner(camera, side / n);
    let b = blades_corner(camera, (side + 1.0) / n);
    return (a + (b - a) * u.y) * reach;
}

// The unit vector to the corner that is `turn` clockwise from the first one.
fn blades_corner(camera: Camera, turn: f32) -> vec2f {
    let turns = camera.blade_rotation + turn;
    return sincos_2pi(turns - floor(turns));
}
