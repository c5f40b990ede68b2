// Surfaces of partial coverage: a ray meets one if a random number is below its alpha, so that on average the share
// alpha of the rays does (Enderton et al. 2010, "Stochastic Transparency", I3D), shadow rays too. Each primitive has a
// number of its own on each ray. It depends on neither the order of traversal nor the place of a triangle that has
// several, so that a ray which is traced in pieces meets what it would have met in whole.

#import "abi/sphere.wgsl"
#import "sampler/key.wgsl"
#import "sampler/pcg.wgsl"
#import "scene/constants.wgsl"
#import "scene/records.wgsl"
#import "scene/sampler.wgsl"
#import "scene/texture.wgsl"
#import "texture/texture_point.wgsl"
#import "trace/ray.wgsl"

// Whether a surface of material `i` is there in part.
fn coverage_is_partial(i: u32) -> bool {
    return (load_material_flags(i) & FLAG_ALPHA_BLEND) != 0u;
}

// Coverage of a surface of material `i` at a point, 0 ..= 1; what is no number is 0.
fn coverage_at(i: u32, at: TexturePoint) -> f32 {
    let alpha = load_material_alpha(i) * texture_alpha(load_material_alpha_texture(i), at);
    return select(0.0, min(alpha, 1.0), alpha > 0.0);
}

// Whether `ray` meets the primitive `id` where its coverage is `coverage`.
fn coverage_meets(ray: Ray, coverage: f32, id: u32) -> bool {
    let purpose = select(PURPOSE_SHADOW_COVERAGE, PURPOSE_COVERAGE, ray.light == NONE);
    return sample_of(ray.key, purpose, id) < coverage;
}

// What tells triangle `i` of `instance` apart: what it is, as in `order_same`, and not where it is stored.
fn coverage_triangle_id(i: u32, instance: u32) -> u32 {
    let ids = vec4u(load_triangle_id0(i), load_triangle_id1(i), load_triangle_id2(i), instance);
    let more = vec4u(load_tri_shade_material(i), load_tri_shade_object(i), 0u, 0u);
    return pcg_hash(pcg_hash(ids) ^ more).x;
}

// The same of one end of a chord through a sphere: where the ray is `entering`, or where it comes out again.
fn coverage_sphere_id(sphere: Sphere, entering: bool) -> u32 {
    let ids = bitcast<vec4<u32>>(vec4f(sphere.center, sphere.radius));
    let more = vec4u(sphere.material, sphere.object, select(0u, 1u, entering), 0u);
    return pcg_hash(pcg_hash(ids) ^ more).x;
}
