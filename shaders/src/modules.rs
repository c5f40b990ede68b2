//! The hand-written WGSL modules, embedded so that the crate works from any directory.

macro_rules! modules {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../wgsl/", $name)))),*]
    };
}

/// Name and text, sorted by name.
const MODULES: &[(&str, &str)] = modules![
    "abi/camera.wgsl",
    "abi/film.wgsl",
    "abi/frame.wgsl",
    "abi/light.wgsl",
    "abi/material.wgsl",
    "abi/medium.wgsl",
    "abi/node.wgsl",
    "abi/object.wgsl",
    "abi/sky.wgsl",
    "abi/sphere.wgsl",
    "abi/texture.wgsl",
    "abi/tri_shade.wgsl",
    "abi/triangle.wgsl",
    "bsdf/dielectric.wgsl",
    "bsdf/diffuse.wgsl",
    "bsdf/emissive.wgsl",
    "bsdf/fabric.wgsl",
    "bsdf/fresnel.wgsl",
    "bsdf/ggx.wgsl",
    "bsdf/ggx_anisotropic.wgsl",
    "bsdf/matte.wgsl",
    "bsdf/metal.wgsl",
    "bsdf/principled.wgsl",
    "bsdf/scatter.wgsl",
    "bsdf/stone.wgsl",
    "bsdf/wood.wgsl",
    "camera/film_plane.wgsl",
    "camera/pinhole.wgsl",
    "camera/thin_lens.wgsl",
    "kernel/backdrop.wgsl",
    "kernel/direct.wgsl",
    "kernel/film.wgsl",
    "kernel/path.wgsl",
    "kernel/render.wgsl",
    "kernel/state.wgsl",
    "kernel/vertex.wgsl",
    "light/choose.wgsl",
    "light/emission.wgsl",
    "light/flat.wgsl",
    "light/light_sample.wgsl",
    "light/rectangle.wgsl",
    "light/sphere.wgsl",
    "light/triangle.wgsl",
    "math/atan.wgsl",
    "math/basis.wgsl",
    "math/exp_log.wgsl",
    "math/half.wgsl",
    "math/octahedral.wgsl",
    "math/sincos.wgsl",
    "math/vector.wgsl",
    "pattern/bump.wgsl",
    "pattern/fbm.wgsl",
    "pattern/noise.wgsl",
    "sampler/pcg.wgsl",
    "shape/sphere.wgsl",
    "shape/triangle.wgsl",
    "sky/constant.wgsl",
    "sky/gradient.wgsl",
    "surface/normal_map.wgsl",
    "surface/place.wgsl",
    "surface/surface.wgsl",
    "texture/bilinear.wgsl",
    "texture/rgba16.wgsl",
    "texture/rgba8.wgsl",
    "trace/alpha.wgsl",
    "trace/box.wgsl",
    "trace/bvh.wgsl",
    "trace/ray.wgsl",
    "trace/spheres.wgsl",
    "trace/triangles.wgsl",
];

/// Every hand-written module: its name, as in `#import`, and its text; sorted by name.
#[must_use]
pub fn module_texts() -> &'static [(&'static str, &'static str)] {
    MODULES
}
