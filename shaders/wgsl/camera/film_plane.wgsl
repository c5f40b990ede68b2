// Where on the film a sample looks.

#import "abi/camera.wgsl"
#import "scene/records.wgsl"

// A camera ray; `dir` is unit.
struct CameraRay {
    origin: vec3f,
    dir: vec3f,
}

// `at`, pixels from the top left corner of the image, in units of the view: (0, 0) is its middle, `half_width` its
// right edge, `half_height` its upper edge.
fn film_plane_place(camera: Camera, at: vec2f) -> vec2f {
    let size = vec2f(load_frame_image_size());
    let x = (2.0 * at.x / size.x - 1.0) * camera.half_width;
    let y = (1.0 - 2.0 * at.y / size.y) * camera.half_height;
    return vec2f(x, y);
}

// From the camera's origin to the point at distance 1 along `forward` that the film of a perspective camera shows at
// `at`. Not unit. World frame.
fn film_plane_point(camera: Camera, at: vec2f) -> vec3f {
    let place = film_plane_place(camera, at);
    return camera.forward + camera.right * place.x + camera.up * place.y;
}
