//! Images in one texel buffer.

use super::field::abi_struct;

/// How texels are stored. The numbers are part of the pack format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub enum TextureFormat {
    /// One `u32` a texel, red in the low byte; colour is sRGB-encoded, alpha linear.
    Rgba8Srgb = 0,
    /// One `u32` a texel, red in the low byte; all linear.
    Rgba8Linear = 1,
    /// Two `u32` a texel: half floats red, green, then blue, alpha; linear.
    Rgba16Float = 2,
}

impl TextureFormat {
    /// Bytes of one texel.
    #[must_use]
    pub fn texel_bytes(self) -> u64 {
        match self {
            Self::Rgba8Srgb | Self::Rgba8Linear => 4,
            Self::Rgba16Float => 8,
        }
    }

    /// Every format, in tag order.
    pub const ALL: [Self; 3] = [Self::Rgba8Srgb, Self::Rgba8Linear, Self::Rgba16Float];

    /// The format with this tag.
    #[must_use]
    pub fn from_tag(tag: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|format| *format as u32 == tag)
    }
}

/// What lies outside 0..1. The numbers are part of the pack format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Wrap {
    /// The image repeats.
    Repeat = 0,
    /// The edge texel goes on.
    Clamp = 1,
    /// The image repeats mirrored.
    Mirror = 2,
}

impl Wrap {
    /// Every rule, in tag order.
    pub const ALL: [Self; 3] = [Self::Repeat, Self::Clamp, Self::Mirror];

    /// The rule with this tag.
    #[must_use]
    pub fn from_tag(tag: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|wrap| *wrap as u32 == tag)
    }
}

abi_struct! {
    /// An image, 32 bytes. Row 0 is the top of the image, v = 1; bilinear filtering, texel centres at half integers.
    pub struct Texture {
        /// Width in texels, >= 1.
        pub width: u32,
        /// Height in texels, >= 1.
        pub height: u32,
        /// `TextureFormat`.
        pub format: u32,
        /// First 16-byte word of the texels; rows follow without gaps.
        pub offset: u32,
        /// `Wrap` along u.
        pub wrap_u: u32,
        /// `Wrap` along v.
        pub wrap_v: u32,
        /// Unused.
        pub _pad0: u32,
        /// Unused.
        pub _pad1: u32,
    }
}

impl Texture {
    /// 16-byte words that the texels fill, the last one perhaps in part; `None` for an unknown format.
    #[must_use]
    pub fn words(&self) -> Option<u64> {
        let format = TextureFormat::from_tag(self.format)?;
        let texels = u64::from(self.width) * u64::from(self.height);
        Some(texels.checked_mul(format.texel_bytes())?.div_ceil(16))
    }
}
