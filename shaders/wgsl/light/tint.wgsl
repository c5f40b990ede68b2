// A light whose colour depends on the direction from which it comes: a low sun through thick air.

#import "scene/records.wgsl"

// `radiance` of a light of material `material` as a ray along `dir` sees it: times the material's tint if the ray
// is within an angle, given by its cosine, of the unit vector `axis`.
fn tint_radiance(radiance: vec3f, material: u32, axis: vec3f, cosine: f32, dir: vec3f) -> vec3f {
    if (dot(dir, axis) < cosine) {
        return radiance;
    }
    return radiance * load_material_tint(material);
}
