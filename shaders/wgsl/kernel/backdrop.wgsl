// The kernel of a scene without geometry: every camera ray sees what is behind it.

#import "kernel/film.wgsl"
#import "sampler/key.wgsl"
#import "scene/dispatch.wgsl"
#import "scene/receiver.wgsl"
#import "scene/records.wgsl"

@compute @workgroup_size(8, 8, 1)
fn render(@builtin(global_invocation_id) gid: vec3<u32>) {
    let frame = load_frame();
    let pixel = frame.tile_origin + gid.xy;
    if (any(gid.xy >= frame.tile_size) || any(pixel >= frame.image_size)) {
        return;
    }
    var film = film_empty();
    var sample = frame.sample_first;
    let end = frame.sample_first + frame.sample_count;
    loop {
        if (sample == end) { break; }
        let key = sample_key(pixel, sample, frame.seed);
        let ray = dispatch_camera(key, dispatch_film(key, pixel));
        film_add(&film, dispatch_miss(ray.dir, 0.0, receiver_none(), true), sample - frame.sample_first, 1u);
        film.rays += 1u;
        sample += 1u;
    }
    film_store(gid.y * frame.tile_size.x + gid.x, film);
}
