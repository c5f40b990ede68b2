// A camera that sees all around, on a lat-long map: columns are azimuths around `up` from `forward` to `right`, rows
// are elevations above the plane of both.

#import "abi/camera.wgsl"
#import "camera/film_plane.wgsl"
#import "math/sincos.wgsl"
#import "math/vector.wgsl"

// The ray through `at`, pixels from the top left corner. Beyond a pole it comes down on the other side.
fn panoramic_ray(camera: Camera, at: vec2f) -> CameraRay {
    let turns = film_plane_place(camera, at);
    let azimuth = sincos_2pi(turns.x - floor(turns.x));
    let elevation = sincos_2pi(turns.y - floor(turns.y));
    let level = camera.right * azimuth.x + camera.forward * azimuth.y;
    return CameraRay(camera.origin, vector_unit(level * elevation.y + camera.up * elevation.x));
}
