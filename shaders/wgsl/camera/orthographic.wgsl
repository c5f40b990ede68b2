// A camera whose rays are parallel; they start in the plane through its origin.

#import "abi/camera.wgsl"
#import "camera/film_plane.wgsl"

// The ray through `at`, pixels from the top left corner.
fn orthographic_ray(camera: Camera, at: vec2f) -> CameraRay {
    let place = film_plane_place(camera, at);
    return CameraRay(camera.origin + camera.right * place.x + camera.up * place.y, camera.forward);
}
