//! An EXR → its channels and texts, as the `exr` crate finds them.

use exr::prelude::{AttributeValue, FlatSamples, ReadChannels as _, ReadLayers as _};
use runtime::output::{self, Picture};
use std::collections::BTreeMap;
use std::path::Path;

/// Channels and texts of a file.
pub struct File {
    /// Channels in 32 bits by name.
    pub channels: BTreeMap<String, Vec<f32>>,
    /// Text attributes by name.
    pub texts: BTreeMap<String, String>,
}

impl File {
    /// Reads a file.
    ///
    /// # Panics
    /// When it is none.
    #[must_use]
    pub fn of(path: &Path) -> Self {
        let image = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_file(path)
            .expect("an EXR");
        let channels = image.layer_data.channel_data.list.iter().map(|channel| {
            let values = match &channel.sample_data {
                FlatSamples::F32(values) => values.clone(),
                FlatSamples::U32(values) => values.iter().map(|n| *n as f32).collect(),
                FlatSamples::F16(_) => panic!("{} has 16 bits", channel.name),
            };
            (channel.name.to_string(), values)
        });
        let texts = image.layer_data.attributes.other.iter().filter_map(|(name, value)| {
            let AttributeValue::Text(text) = value else { return None };
            Some((name.to_string(), text.to_string()))
        });
        Self { channels: channels.collect(), texts: texts.collect() }
    }

    /// The file that a picture becomes.
    ///
    /// # Panics
    /// When it cannot be written.
    #[must_use]
    pub fn written(picture: &Picture, residual: bool) -> Self {
        let file = tempfile::Builder::new().suffix(".exr").tempfile().expect("a file");
        output::write(file.path(), picture, residual).expect("it can be written");
        Self::of(file.path())
    }

    /// The bits of a channel.
    #[must_use]
    pub fn bits(&self, channel: &str) -> Option<Vec<u32>> {
        Some(self.channels.get(channel)?.iter().map(|x| x.to_bits()).collect())
    }
}
