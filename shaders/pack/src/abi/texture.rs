//! Images in one texel buffer.

use super::field::abi_struct;
use super::tag::tags;

tags! {
    /// How texels are stored. The numbers are part of the pack format.
    pub enum TextureFormat {
        /// One `u32` a texel, red in the low byte; colour is sRGB-encoded, alpha linear.
        Rgba8Srgb = 0 as 7 "sRGB textures",
        /// One `u32` a texel, red in the low byte; all linear.
        Rgba8Linear = 1 as 8 "linear 8-bit textures",
        /// Two `u32` a texel: half floats red, green, then blue, alpha; linear.
        Rgba16Float = 2 as 9 "half-float textures",
        /// No texels, but `TextureOp`s: the texture is computed.
        Expression = 3 as 46 "texture expressions",
    }
}

impl TextureFormat {
    /// Bytes of one texel, or of one operation.
    #[must_use]
    pub fn texel_bytes(self) -> u64 {
        match self {
            Self::Rgba8Srgb | Self::Rgba8Linear => 4,
            Self::Rgba16Float => 8,
            Self::Expression => 48,
        }
    }
}

tags! {
    /// What lies outside 0..1. The numbers are part of the pack format.
    pub enum Wrap {
        /// The image repeats.
        Repeat = 0,
        /// The edge texel goes on.
        Clamp = 1,
        /// The image repeats mirrored.
        Mirror = 2,
    }
}

abi_struct! {
    /// An image, or an expression, 32 bytes. Row 0 is the top of an image, v = 1; bilinear filtering, texel centres at
    /// half integers.
    pub struct Texture {
        /// Width in texels, >= 1; operations of an expression.
        pub width: u32,
        /// Height in texels, >= 1; 1 for an expression.
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
