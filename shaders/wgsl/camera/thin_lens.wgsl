// An ideal thin lens: rays from one film point meet again in the plane of focus.

#import "abi/camera.wgsl"
#import "camera/film_plane.wgsl"
#import "math/disk.wgsl"
#import "math/vector.wgsl"

// A point uniform on a round lens, to the right and up from its middle: `u` in [0, 1)^2.
fn thin_lens_disk(camera: Camera, u: vec2f) -> vec2f {
    let at = disk_concentric(u);
    return at.turn * (at.r * camera.lens_radius);
}

// The ray through `at`, pixels from the top left corner, and the point `p` of the lens.
fn thin_lens_ray(camera: Camera, at: vec2f, p: vec2f) -> CameraRay {
    let offset = camera.right * p.x + camera.up * p.y;
    let focus = film_plane_point(camera, at) * camera.focus_distance;
    return CameraRay(camera.origin + offset, vector_unit(focus - offset));
}
