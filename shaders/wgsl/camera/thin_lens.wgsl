// An ideal thin lens: rays from one film point meet again in the plane of focus.

#import "abi/camera.wgsl"
#import "camera/film_plane.wgsl"
#import "math/sincos.wgsl"
#import "math/vector.wgsl"

// The ray through `at`, pixels from the top left corner, and a point uniform on the lens: `u` in [0, 1)^2.
fn thin_lens_ray(camera: Camera, at: vec2f, u: vec2f) -> CameraRay {
    let sc = sincos_2pi(u.y) * (sqrt(u.x) * camera.lens_radius);
    let offset = camera.right * sc.y + camera.up * sc.x;
    let focus = film_plane_point(camera, at) * camera.focus_distance;
    return CameraRay(camera.origin + offset, vector_unit(focus - offset));
}
