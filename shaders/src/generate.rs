//! A [`FeatureSet`] becomes the `scene/…` modules: everything that differs from scene to scene.

mod bindings;
mod bsdf;
mod choice;
mod constants;
mod light;
mod media;
mod motion;
mod path;
mod principled;
mod ray;
mod receiver;
mod records;
mod sampler;
mod sky;
mod start;
mod survival;
mod texture;
mod traversal;
mod wgsl;

use crate::{FeatureSet, ShaderError};
pub use bindings::WINDOW_WORDS;

/// The structs of the records: module and text, the same for every scene.
#[must_use]
pub fn record_texts() -> Vec<(&'static str, String)> {
    records::structs()
}

/// The generated modules of a scene: name and text.
pub fn generated_texts(features: &FeatureSet) -> Result<Vec<(&'static str, String)>, ShaderError> {
    let mut texts = record_texts();
    texts.extend([
        ("scene/bare.wgsl", principled::bare(features)),
        ("scene/bindings.wgsl", bindings::text(&features.bindings()?)),
        ("scene/after.wgsl", traversal::after(features)),
        ("scene/brushing.wgsl", path::brushing(features)),
        ("scene/candidate.wgsl", traversal::candidate(features)),
        ("scene/constants.wgsl", constants::text(features)),
        ("scene/crossing.wgsl", media::crossing(features)),
        ("scene/dispatch.wgsl", path::dispatch(features)),
        ("scene/dispatch_bsdf.wgsl", bsdf::dispatch()),
        ("scene/dispatch_choice.wgsl", choice::text(features)),
        ("scene/directional.wgsl", path::directional(features)),
        ("scene/dispatch_light.wgsl", light::dispatch(features)),
        ("scene/dispatch_mix.wgsl", bsdf::mix(features)),
        ("scene/unseen.wgsl", media::unseen(features)),
        ("scene/dispatch_pattern.wgsl", bsdf::pattern(features)),
        ("scene/before.wgsl", media::before(features)),
        ("scene/instance_leaf.wgsl", traversal::instance_leaf(features)),
        ("scene/ends.wgsl", media::ends(features)),
        ("scene/fog.wgsl", media::fog(features)),
        ("scene/inside.wgsl", media::inside(features)),
        ("scene/dispatch_radiance.wgsl", sky::radiance(features)),
        ("scene/dispatch_sky.wgsl", sky::sky(features)),
        ("scene/dispatch_tint.wgsl", choice::tint(features)),
        ("scene/layers.wgsl", principled::layers(features)),
        ("scene/leaf.wgsl", traversal::leaf(features)),
        ("scene/lookup.wgsl", texture::lookup(features)),
        ("scene/model.wgsl", bsdf::model(features)),
        ("scene/motion.wgsl", motion::text(features)),
        ("scene/eye.wgsl", motion::eye(features)),
        ("scene/nodes.wgsl", traversal::nodes(features)),
        ("scene/place.wgsl", path::place(features)),
        ("scene/plain.wgsl", principled::plain(features)),
        ("scene/placed.wgsl", traversal::placed(features)),
        ("scene/probe.wgsl", start::probe(features)),
        ("scene/principled.wgsl", principled::outer(features)),
        ("scene/projection.wgsl", path::projection(features)),
        ("scene/links.wgsl", receiver::links(features)),
        ("scene/receiver.wgsl", receiver::text(features)),
        ("scene/records.wgsl", records::text()),
        ("scene/sampler.wgsl", sampler::text(features)),
        ("scene/segment.wgsl", media::segment(features)),
        ("scene/seen.wgsl", sky::seen(features)),
        ("scene/shear.wgsl", traversal::shear(features)),
        ("scene/shadow.wgsl", media::shadow(features)),
        ("scene/start.wgsl", start::start(features)),
        ("scene/straight.wgsl", bsdf::straight(features)),
        ("scene/survival.wgsl", survival::text(features)),
        ("scene/texel.wgsl", texture::texel(features)),
        ("scene/texture.wgsl", texture::texture(features)),
        ("scene/through.wgsl", media::through(features)),
    ]);
    if features.alpha_blend {
        texts.push(("trace/ray.wgsl", ray::with_key()));
    }
    Ok(texts)
}

/// Name of the module whose `render` is the entry point of the scene's kernel.
#[must_use]
pub fn root_module(features: &FeatureSet) -> &'static str {
    if features.geometry() { "kernel/render.wgsl" } else { "kernel/backdrop.wgsl" }
}
