// What a scattering model needs of a surface point, read once per vertex, and what it answers.

#import "abi/material_head.wgsl"
#import "math/vector.wgsl"
#import "sampler/key.wgsl"
#import "scene/brushing.wgsl"
#import "scene/place.wgsl"
#import "scene/texture.wgsl"
#import "surface/place.wgsl"
#import "surface/surface.wgsl"
#import "texture/texture_point.wgsl"

// World frame; colours linear Rec. 709.
struct Scatter {
    // Normal of the surface that divides the sides, `Surface::horizon`, and shading normal; unit, on the side of `wo`.
    ng: vec3f,
    ns: vec3f,
    // Reflectance or base colour, textures applied.
    color: vec3f,
    // `MaterialKind`.
    kind: u32,
    // Index of the `Material`, for what only one model reads.
    material: u32,
    // Along which u grows, as in `Surface`; only for materials that ask. Wood: its grain, projected on the surface, as
    // long as the sine between grain and normal. Brushed principled surfaces: the direction of brushing.
    tangent: vec3f,
    // How far a principled surface is brushed, texture applied.
    anisotropy: f32,
    // As in `Surface`.
    at: TexturePoint,
    // The point in its object, and the object's key; only for materials that ask.
    place: Place,
    fuzz: f32,
    // Perceptual roughness and metallic weight, textures applied.
    roughness: f32,
    metallic: f32,
    // Refractive index of the inside over the outside, and the same less one.
    ior: f32,
    ior_minus_1: f32,
    // The path comes from the front side.
    front: bool,
    // Numbers for models that are found by a random walk.
    key: SampleKey,
}

// A sampled direction. `weight` is f |cos| / pdf; 0 ends the path.
struct Scattered {
    // Unit, world frame.
    wi: vec3f,
    // Density of `wi` per steradian over all lobes; 0 marks a delta lobe.
    pdf: f32,
    weight: vec3f,
    // Square of the refractive index behind the surface over the one before it; 1 for reflection.
    eta2: f32,
}

// What a model says of two directions, delta lobes left out.
struct Evaluated {
    // f |cos|.
    f: vec3f,
    // Density of its samples, per steradian of `wi`.
    pdf: f32,
}

// The parameters of material `m` at `s`; `key`: the vertex.
fn scatter_at(m: MaterialHead, s: Surface, key: SampleKey) -> Scatter {
    let color = m.color * texture_fetch(m.color_texture, s.at).xyz;
    let mr = texture_fetch(m.metallic_roughness_texture, s.at);
    let brushing = dispatch_brushing(s, m.kind);
    return Scatter(
        s.horizon, s.ns, color, m.kind, s.material,
        brushing.xyz, brushing.w, s.at, dispatch_place(s.object, m.flags, s.rest), m.fuzz,
        m.roughness * mr.y, m.metallic * mr.z,
        m.ior, m.ior_minus_1, s.front, key,
    );
}

// No light goes from one direction to the other, and none is sampled.
fn scatter_nothing() -> Evaluated {
    return Evaluated(vec3f(0.0), 0.0);
}

// `e` where `reached`, as far as light is concerned: the density counts what is sampled and lost.
fn scatter_only(e: Evaluated, reached: bool) -> Evaluated {
    return Evaluated(select(vec3f(0.0), e.f, reached), e.pdf);
}

// No direction: the path ends here.
fn scatter_absorb() -> Scattered {
    return Scattered(vec3f(0.0, 0.0, 1.0), 0.0, vec3f(0.0), 1.0);
}

// Whether reflection into `wi` is possible: above both the shading and the geometric surface. Without
// the second test smooth normals would let light through closed meshes.
fn scatter_above(s: Scatter, wi: vec3f) -> bool {
    return dot(wi, s.ns) > 0.0 && dot(wi, s.ng) > 0.0;
}

// A direction whose value and density are still to be worked out: `pdf` is 1, and `weight` 0.
fn scatter_toward(wi: vec3f) -> Scattered {
    return Scattered(wi, 1.0, vec3f(0.0), 1.0);
}

// Whether transmission into `wi` is possible: below both the shading and the geometric surface.
fn scatter_below(s: Scatter, wi: vec3f) -> bool {
    return dot(wi, s.ns) < 0.0 && dot(wi, s.ng) < 0.0;
}

// `wo` mirrored at the shading normal, or at the surface's where the former would go below the surface, as at a wave of
// water. Models see no other surface than that of their shading normal (`fold.wgsl`). Unit.
fn scatter_mirror(s: Scatter, wo: vec3f) -> vec3f {
    let r = s.ns * (2.0 * dot(s.ns, wo)) - wo;
    if (dot(r, s.ng) > 0.0) {
        return vector_unit(r);
    }
    return vector_unit(s.ng * (2.0 * dot(s.ng, wo)) - wo);
}
