// Rays in the frame of an instance. Their directions are not unit there: distances along the ray are those of
// the world, so that hits of all frames compare.

#import "scene/motion.wgsl"
#import "scene/records.wgsl"
#import "trace/ray.wgsl"

// `ray`, which is in the world, in the frame of instance `i`. The difference from the centre loses nothing near
// the instance, wherever that stands in the world.
fn instance_ray(i: u32, ray: Ray) -> Ray {
    let x = load_instance_row_x(i);
    let y = load_instance_row_y(i);
    let z = load_instance_row_z(i);
    let object = load_instance_object(i);
    let o = dispatch_thing_origin(object, ray.origin, ray.time) - load_instance_center(i);
    let dir = dispatch_thing_dir(object, ray.dir, ray.time);
    var inner = ray;
    inner.origin = vec3f(dot(x, o), dot(y, o), dot(z, o));
    inner.dir = vec3f(dot(x, dir), dot(y, dir), dot(z, dir));
    inner.instance = i;
    return inner;
}
