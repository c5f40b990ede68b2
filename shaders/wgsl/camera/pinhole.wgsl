// A camera without a lens: everything is in focus.

#import "abi/camera.wgsl"
#import "camera/film_plane.wgsl"
#import "math/vector.wgsl"

// The ray through `at`, pixels from the top left corner.
fn pinhole_ray(camera: Camera, at: vec2f) -> CameraRay {
    return CameraRay(camera.origin, vector_unit(film_plane_point(camera, at)));
}
