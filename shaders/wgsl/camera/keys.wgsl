// A camera that moves while the shutter is open: the frame is built anew for each sample, of place and target between
// two keys.

#import "abi/camera.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"

// The camera at `time`: 0 where the shutter opens, 1 where it closes.
fn keys_camera(time: f32) -> Camera {
    // The last key is at 1.
    var k = 0u;
    loop {
        if (time <= load_camera_key_time(k + 1u)) { break; }
        k += 1u;
    }
    let a = load_camera_key(k);
    let b = load_camera_key(k + 1u);
    let u = (time - a.time) / (b.time - a.time);
    var camera = load_camera();
    camera.origin = a.origin + (b.origin - a.origin) * u;
    let view = a.aim + (b.aim - a.aim) * u - camera.origin;
    // Where it looks at itself, or along `up`, it looks as it did when the shutter opened.
    camera.forward = vector_unit_or(view, camera.forward);
    camera.right = vector_unit_or(vector_cross(camera.forward, a.up), camera.right);
    camera.up = vector_cross(camera.right, camera.forward);
    let focus = a.focus_distance + (b.focus_distance - a.focus_distance) * u;
    camera.focus_distance = select(focus, sqrt(dot(view, view)), focus == 0.0);
    return camera;
}
