// A light that shines into a cone.

// `radiance` of a light as a ray along `dir` sees it: all of it where `dir` is within an angle, given by its cosine
// `inner`, of the unit vector `axis`, which runs against the beam; nothing beyond `outer`, below `inner`; smooth
// in between.
fn spot_radiance(radiance: vec3f, axis: vec3f, outer: f32, inner: f32, dir: vec3f) -> vec3f {
    let x = clamp((dot(dir, axis) - outer) / (inner - outer), 0.0, 1.0);
    return radiance * (x * x * (3.0 - 2.0 * x));
}
