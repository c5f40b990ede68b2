// Where on the film a sample looks.

#import "abi/camera.wgsl"
#import "scene/records.wgsl"

// A camera ray; `dir` is unit.
struct CameraRay {
    origin: vec3f,
    dir: vec3f,
}

// From the camera's origin to the point at distance 1 along `forward` that the film shows at `at`, pixels
// from the top left corner of the image. Not unit. World frame.
fn film_plane_point(camera: Camera, at: vec2f) -> vec3f {
    let size = vec2f(load_frame_image_size());
    let x = (2.0 * at.x / size.x - 1.0) * camera.tan_half_width;
    let y = (1.0 - 2.0 * at.y / size.y) * camera.tan_half_height;
    return camera.forward + camera.right * x + camera.up * y;
}
