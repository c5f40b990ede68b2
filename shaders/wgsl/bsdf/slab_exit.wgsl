// How light leaves a slab in which it is scattered at least once: the walk of `slab.wgsl`, until a side lets it out.
// It chooses nothing but the direction of the light: without absorption all of it comes out, whatever the numbers.

#import "bsdf/hg.wgsl"
#import "bsdf/slab.wgsl"
#import "math/vector.wgsl"
#import "sampler/key.wgsl"
#import "scene/sampler.wgsl"

// Unit direction outside in the frame of the slab, and the light that it carries, over the share of the light that
// comes in; the first crossing of the side left out. Both are 0 where nothing comes out.
struct SlabExit {
    dir: vec3f,
    share: vec3f,
}

// Below this throughput a walk may end by chance.
const SLAB_EXIT_ROULETTE: f32 = 0.25;

// The exit of light along `o`, see `slab_scattered`. `turn`: how it scatters first; `v`: where, see `slab_first`; the
// rest comes from `key`.
fn slab_exit_sample(slab: Slab, o: vec3f, turn: vec2f, v: vec2f, key: SampleKey) -> SlabExit {
    let entry = slab_entry(slab, -o.z);
    let share = (entry.share.x + entry.share.y + entry.share.z) / 3.0;
    if (share <= 0.0) {
        return SlabExit(vec3f(0.0), vec3f(0.0));
    }
    let first = slab_first(slab, o, entry, v);
    var depth = first.depth;
    var thr = first.thr;
    var dir = hg_sample(first.dir, slab.g, turn);
    // Other numbers than those of a light sample at the same vertex.
    var at = SampleKey(key.pixel, key.sample, key.bounce, key.seed ^ 0x5bd1e995u);
    var inside = true;
    loop {
        // The only exit stands first, see `slab_scattered`.
        if (!inside) { break; }
        at = slab_next(at);
        let step = slab_free_path(slab, thr, sample_2d(at, PURPOSE_SLAB));
        let rest = select(1.0 - depth, depth, dir.z < 0.0) / max(abs(dir.z), 1e-6);
        let f = slab_mirror(slab, abs(dir.z));
        let chance = sample_1d(at, PURPOSE_SLAB_END);
        if (step >= rest && f < 1.0) {
            thr *= slab_unscattered(slab, thr, rest);
            depth = select(1.0, 0.0, dir.z < 0.0);
            inside = chance < f;
            dir.z = select(dir.z, -dir.z, inside);
        } else {
            thr *= slab_scatters(slab, thr, step);
            let reached = slab_fold(depth, dir.z, step);
            depth = reached.x;
            dir = hg_sample(vec3f(dir.xy, reached.y), slab.g, sample_2d(at, PURPOSE_SLAB_TURN));
            let survives = min(vector_max(thr) / SLAB_EXIT_ROULETTE, 1.0);
            inside = chance < survives;
            thr = select(vec3f(0.0), thr / max(survives, 1e-30), vec3<bool>(inside));
        }
    }
    // Refracted: the tangential part grows by the index, and what is left is the cosine.
    let xy = dir.xy * slab.ior;
    let z = sqrt(max(1.0 - dot(xy, xy), 0.0));
    return SlabExit(vector_unit(vec3f(xy, select(z, -z, dir.z < 0.0))), thr * share);
}
