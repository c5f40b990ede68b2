//! Texture expressions: textures that are computed from coordinates, images and other values.
//!
//! An expression is a run of `TextureOp`s in the texel section, written as reverse Polish notation: an operation
//! takes its operands off a stack of values and leaves its result there. A value has four channels; a number is the
//! same in all of them.

use super::field::abi_struct;
use super::tag::tags;
use super::{Texture, TextureFormat};

/// Most values on the stack.
pub const MAX_TEXTURE_STACK: usize = 6;

/// Most operations of an expression.
pub const MAX_TEXTURE_OPS: u32 = 64;

tags! {
    /// What a `TextureOp` does. *Place* is a point of the texture: `p` as a 2 x 2 matrix, row by row, times uv, plus
    /// the first half of `q`. Textures that fill an object have a third coordinate, w; it is 0 on all others. The
    /// numbers are part of the pack format.
    pub enum TextureOpKind {
        /// Leaves `p`.
        Constant = 0,
        /// Leaves image `arg` at the place.
        Image = 1,
        /// Channel `arg` of a value in all four.
        Channel = 2,
        /// A value whose channel `arg` is the red of the next.
        Insert = 3,
        /// Product of two values.
        Multiply = 4,
        /// Sum of two values.
        Add = 5,
        /// `a (1 - t) + b t` of values a, b, t.
        Mix = 6,
        /// A value between `p.x` and `p.y`.
        Clamp = 7,
        /// A texel of a normal map whose x and y, encoded as 0 to 1, are turned by the matrix `p`.
        Tilt = 8,
        /// 0 and 1 in cubes of 1 x 1 x 1, at the place and `q.z` times w.
        Checker = 9,
        /// 1 in bricks of 1 x 1, every other row shifted by a half; 0 in the mortar: what is nearer than
        /// `q.z` to an end or `q.w` to the upper or lower edge.
        Bricks = 10,
        /// 0 up to x = 0, 1 from x = 1, in proportion between.
        Gradient = 11,
        /// `(1 - cos(2 pi x)) / 2`.
        Wave = 12,
        /// Fractal noise of `arg` octaves, the first with cells of 1 x 1 x 1, at the place and `q.z` times w; mean 1/2.
        Noise = 13,
        /// The colour and alpha of the corners of the triangle, `VertexColors`, mixed in between; 1 on a sphere.
        VertexColor = 14,
    }
}

impl TextureOpKind {
    /// How many values it takes off the stack; it leaves one.
    #[must_use]
    pub fn operands(self) -> usize {
        match self {
            Self::Constant
            | Self::Image
            | Self::Checker
            | Self::Bricks
            | Self::Gradient
            | Self::Wave
            | Self::Noise
            | Self::VertexColor => 0,
            Self::Channel | Self::Clamp | Self::Tilt => 1,
            Self::Insert | Self::Multiply | Self::Add => 2,
            Self::Mix => 3,
        }
    }
}

abi_struct! {
    /// One operation of a texture expression, 48 bytes.
    pub struct TextureOp {
        /// `TextureOpKind`.
        pub kind: u32,
        /// An image, a channel (0 red, 1 green, 2 blue, 3 alpha), or a number of octaves.
        pub arg: u32,
        /// Unused.
        pub _pad0: u32,
        /// Unused.
        pub _pad1: u32,
        /// See `TextureOpKind`.
        pub p: [f32; 4],
        /// See `TextureOpKind`.
        pub q: [f32; 4],
    }
}

impl TextureOp {
    /// 16-byte words of one operation; those of an expression begin at a multiple of it.
    pub const WORDS: u32 = 3;

    /// As words of the texel section.
    #[must_use]
    pub fn words(&self) -> [[u32; 4]; 3] {
        [[self.kind, self.arg, 0, 0], self.p.map(f32::to_bits), self.q.map(f32::to_bits)]
    }
}

impl Texture {
    /// The record of an expression of `n_ops` operations from word `offset` of the texels on.
    #[must_use]
    pub fn expression(n_ops: u32, offset: u32) -> Self {
        let format = TextureFormat::Expression as u32;
        Self { width: n_ops, height: 1, format, offset, ..Self::default() }
    }

    /// Whether it is computed.
    #[must_use]
    pub fn is_expression(&self) -> bool {
        self.format == TextureFormat::Expression as u32
    }
}
