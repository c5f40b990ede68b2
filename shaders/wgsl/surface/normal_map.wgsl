// A normal map: tilts the shading normal by a texture.

#import "math/vector.wgsl"
#import "scene/texture.wgsl"
#import "surface/surface.wgsl"

// The least cosine between a mapped normal and the geometric one.
const NORMAL_MAP_SIDE: f32 = 1e-3;

// Tilts the shading normal of `s`, seen along `dir`, by texture `image`: its channels from 0 to 1 are -1 to 1
// along the direction in which u grows, along that in which v grows, and along the normal; the first two times
// `strength`. The map belongs to the front side: what is a bump there is a dent from behind.
fn normal_map_tilt(s: ptr<function, Surface>, image: u32, strength: f32, dir: vec3f) {
    let n = (*s).ns;
    let texel = texture_fetch(image, (*s).at).xyz * 2.0 - vec3f(1.0);
    // At a right angle to the shading normal; where there is no such direction nothing is tilted.
    let along = (*s).tangent - n * dot(n, (*s).tangent);
    let t = vector_unit_or(along, vec3f(0.0));
    let b = vector_cross(n, t) * (*s).handed;
    let tilt = texel.xy * select(-strength, strength, (*s).front);
    let mapped = vector_unit_or(t * tilt.x + b * tilt.y + n * texel.z, n);
    (*s).ns = surface_shading_normal((*s).ng, normal_map_lifted((*s).ng, mapped), dir);
}

// `n` on the side of `ng`: a steep texel may turn a normal past the geometric surface. It is moved back along `ng`,
// because turning it round would tilt it to the other side.
fn normal_map_lifted(ng: vec3f, n: vec3f) -> vec3f {
    let lift = NORMAL_MAP_SIDE - dot(n, ng);
    if (lift <= 0.0) {
        return n;
    }
    return vector_unit_or(n + ng * lift, ng);
}
