//! What channels of an EXR are called and made of, in both styles of names, and how they are read back.

use crate::layers::LayerNames;
use ::exr::prelude::{AnyChannel, FlatSamples};

pub(super) type Channel = AnyChannel<FlatSamples>;

/// The name of a channel of the picture itself.
pub(super) fn combined(names: LayerNames, component: &str) -> String {
    match names {
        LayerNames::Blender => format!("ViewLayer.Combined.{component}"),
        LayerNames::Plain => component.to_owned(),
    }
}

/// The name of a channel of the picture before it was denoised.
pub(super) fn noisy(names: LayerNames, component: &str) -> String {
    match names {
        LayerNames::Blender => format!("ViewLayer.Noisy Image.{component}"),
        LayerNames::Plain => format!("noisy.{component}"),
    }
}

/// The name of a channel of a layer: its name in Blender, the ending there, and the plain name.
pub(super) fn channel_name(
    names: LayerNames,
    layer: &str,
    (ending, plain): (&str, &str),
) -> String {
    match names {
        LayerNames::Blender => format!("ViewLayer.{layer}.{ending}"),
        LayerNames::Plain => plain.to_owned(),
    }
}

/// The channel of what rounding left over.
pub(super) fn residual_name(plain: &str) -> String {
    format!("residual.{plain}")
}

pub(super) fn channel(name: &str, values: Vec<f32>) -> Channel {
    AnyChannel::new(name, FlatSamples::F32(values))
}

#[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose")]
pub(super) fn round(x: f64) -> f32 {
    x as f32
}

/// A file that was read: its channels and text attributes by name.
pub(super) trait Source {
    /// The values of a channel of 32-bit floats.
    fn floats(&self, channel: &str) -> Option<&[f32]>;
    /// An attribute.
    fn text(&self, attribute: &str) -> Option<String>;
}

/// The values of a channel of `n` pixels, which must be there.
pub(super) fn plane<'s>(source: &'s dyn Source, name: &str, n: usize) -> Result<&'s [f32], String> {
    let values = source.floats(name).filter(|values| values.len() == n);
    values.ok_or_else(|| format!("channel `{name}` of 32-bit floats is missing"))
}
