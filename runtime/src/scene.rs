//! A checked pack that can be rendered, and what its settings say.

use pack::abi::RenderSettings;
use pack::{Checked, Pack};
use std::fmt::Write as _;

/// A scene that can be rendered.
pub struct Scene {
    pack: Pack<Checked>,
}

impl Scene {
    /// The scene in a checked pack.
    #[must_use]
    pub fn new(pack: Pack<Checked>) -> Self {
        Self { pack }
    }

    /// The pack.
    #[must_use]
    pub fn pack(&self) -> &Pack<Checked> {
        &self.pack
    }

    /// Settings of the scene.
    #[must_use]
    pub fn settings(&self) -> &RenderSettings {
        self.pack.render()
    }

    /// The name of what is rendered, in hexadecimal.
    #[must_use]
    pub fn render_id(&self) -> String {
        let mut text = String::with_capacity(64);
        for byte in self.pack.render_id() {
            // Writing to a string cannot fail.
            let _ = write!(text, "{byte:02x}");
        }
        text
    }
}
