// In which direction a surface is brushed, and how far.

#import "math/basis.wgsl"
#import "math/sincos.wgsl"
#import "scene/constants.wgsl"
#import "scene/records.wgsl"
#import "scene/texture.wgsl"
#import "surface/surface.wgsl"

// The direction along which the principled surface `s` is brushed, world frame, and its anisotropy. A texture has the
// direction in red, along u, and green, along v, both from -1 to 1, and a factor on the anisotropy in blue.
fn brushing_at(s: Surface) -> vec4f {
    var anisotropy = load_material_anisotropy(s.material);
    if (anisotropy <= 0.0) {
        return vec4f(s.tangent, 0.0);
    }
    let turn = sincos_2pi(load_material_anisotropy_turn(s.material));
    var along = vec2f(turn.y, turn.x);
    let texture = load_material_anisotropy_texture(s.material);
    if (texture != NONE) {
        let texel = texture_fetch(texture, s.at);
        let d = texel.xy * 2.0 - vec2f(1.0);
        along = vec2f(d.x * turn.y - d.y * turn.x, d.x * turn.x + d.y * turn.y);
        anisotropy *= clamp(texel.z, 0.0, 1.0);
    }
    let plane = basis_along(s.ns, s.tangent);
    return vec4f(plane.t * along.x + plane.b * (along.y * s.handed), anisotropy);
}
