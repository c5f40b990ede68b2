// The path tracer: one thread renders one pixel of a tile, sample after sample. When a path ends its
// thread begins the next one at once, so that lanes do not wait for the longest path. Each turn traces the shadow rays
// of the last vertex and then the next segment, so that lanes shade together.

#import "kernel/film.wgsl"
#import "kernel/indirect.wgsl"
#import "kernel/path.wgsl"
#import "sampler/key.wgsl"
#import "scene/crossing.wgsl"
#import "scene/records.wgsl"
#import "scene/shadow.wgsl"
#import "trace/bvh.wgsl"
#import "trace/ray.wgsl"

@compute @workgroup_size(8, 8, 1)
fn render(@builtin(global_invocation_id) gid: vec3<u32>) {
    let frame = load_frame();
    let pixel = frame.tile_origin + gid.xy;
    if (any(gid.xy >= frame.tile_size) || any(pixel >= frame.image_size) || frame.sample_count == 0u) {
        return;
    }
    let end = frame.sample_first + frame.sample_count;
    var film = film_empty();
    var path = path_begin(sample_key(pixel, frame.sample_first, frame.seed), pixel);
    // Exits stand first: Mesa's llvmpipe (seen in 22.3.6) gives wrong pictures for the same loops with their exits
    // further down.
    loop {
        if (path.key.sample == end) { break; }
        var hit = ray_miss(0.0);
        var at_vertex = false;
        loop {
            if (at_vertex || path_ended(path)) { break; }
            film.rays += dispatch_counted_rays(&path);
            hit = trace(path_ray(&path));
            at_vertex = !path_connect(&path, hit);
        }
        if (at_vertex) {
            path_extend(&path, hit);
        }
        if (path_ended(path)) {
            let sample = path.key.sample;
            let kept = indirect_clamped(&path);
            film_add(&film, kept, sample - frame.sample_first, path.segments);
            film_remove(&film, path.radiance - kept);
            film.stack_errors += dispatch_stack_errors(&path);
            path = path_begin(sample_key(pixel, sample + 1u, frame.seed), pixel);
        }
    }
    film_watch(&film, frame.sample_count + 1u);
    film_store(gid.y * frame.tile_size.x + gid.x, film);
}
