// A light with a profile: an image says how bright it is in each direction, as luminaire files do. Rows are angles from
// the beam, columns turn around it.

#import "math/basis.wgsl"
#import "scene/texture.wgsl"
#import "sky/lat_long.wgsl"

// `radiance` of a light as a ray along `dir` sees it, times what `image` holds. `axis`: unit, against the beam;
// `turn`: where the first column lies, turns back from the x axis of the frame around `axis`.
fn profile_radiance(radiance: vec3f, image: u32, axis: vec3f, turn: f32, dir: vec3f) -> vec3f {
    let out = basis_local_from_world(basis_around(axis), -dir);
    // The map has its top row straight up and goes on from -z to +x.
    let place = lat_long_place(vec3f(out.y, -out.z, -out.x), turn);
    return radiance * texture_fetch_at(image, place).xyz;
}
