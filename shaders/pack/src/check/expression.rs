//! Texture expressions: every operation is known, finds its operands, reads images that are no expressions
//! themselves, and one value is left. So a kernel evaluates them without checks of its own, in bounded time. Colours of
//! vertices are there exactly when one of them asks.

use crate::abi::{MAX_TEXTURE_OPS, MAX_TEXTURE_STACK, Texture, TextureOp, TextureOpKind};
use crate::contents::Contents;
use crate::error::{PackError, Place};
use crate::fault::ElementFault;
use crate::kind::Kind;

use super::broken::element;
use super::rule::{count, index, tag, unused};

/// Octaves of noise, at most.
const MAX_OCTAVES: u32 = 16;

/// All expressions, and what they read of triangles; every range is inside TEXEL already.
pub(super) fn check(contents: &Contents<'_>) -> Result<(), PackError> {
    let mut colored = false;
    for (at, texture) in contents.textures.iter().enumerate() {
        if texture.is_expression() {
            let broken = |field, fault| element::<Texture>(at, (field, fault));
            frame(texture).map_or(Ok(()), |(field, fault)| Err(broken(field, fault)))?;
            let (left, reads_colors) = operations(texture, contents)?;
            if left != 1 {
                return Err(broken("width", ElementFault::ValuesLeft(left)));
            }
            colored |= reads_colors;
        }
    }
    vertex_colors(contents, colored)
}

/// Whether the colours of vertices are there, if a texture reads them.
fn vertex_colors(contents: &Contents<'_>, read: bool) -> Result<(), PackError> {
    let (kind, found) = (Kind::VERTEXCOLOR, contents.vertex_colors.len());
    match (read, found == contents.triangles.len()) {
        (true, true) => Ok(()),
        (true, false) => Err(PackError::CountMismatch {
            left: "the number of VTXCOLOR elements",
            left_count: found as u64,
            right: "the number of TRIANGLE elements",
            right_count: contents.triangles.len() as u64,
        }),
        (false, _) if found == 0 => Ok(()),
        (false, _) => Err(PackError::Unwanted { kind, because: ", no texture reads it" }),
    }
}

/// Numbers of the record itself.
fn frame(texture: &Texture) -> Option<(&'static str, ElementFault)> {
    let width = count([texture.width], 1, MAX_TEXTURE_OPS).map(|fault| ("width", fault));
    let height = || count([texture.height], 1, 1).map(|fault| ("height", fault));
    let found = texture.offset;
    let aligned = found.is_multiple_of(TextureOp::WORDS);
    let offset = || (!aligned).then_some(("offset", ElementFault::NotAligned { found, unit: 3 }));
    width.or_else(height).or_else(offset)
}

/// Checks the operations; how many values they leave, and whether one is the colour of vertices.
fn operations(texture: &Texture, contents: &Contents<'_>) -> Result<(usize, bool), PackError> {
    let (mut values, mut colored) = (0, false);
    for k in 0..texture.width {
        let word = (texture.offset + TextureOp::WORDS * k) as usize;
        let fault = |field, fault| {
            let at = Place { kind: Kind::TEXEL, index: word, offset: word * 16 };
            Err(PackError::Element { at, field, fault })
        };
        let [[found, arg, pad0, pad1], p, q] = contents.texels[word..word + 3] else {
            return Ok((0, false));
        };
        let Some(kind) = TextureOpKind::from_tag(found) else {
            let unknown = tag(found, TextureOpKind::ALL.len());
            return fault("kind", unknown.unwrap_or(ElementFault::Unused(found)));
        };
        if let Some(wrong) = unused(pad0 | pad1) {
            return fault("_pad0", wrong);
        }
        if let Some(wrong) = argument(kind, arg, contents.textures) {
            return fault("arg", wrong);
        }
        for (field, words) in [("p", p), ("q", q)] {
            let wrong = words.map(f32::from_bits).into_iter().find(|x| !x.is_finite());
            if let Some(found) = wrong {
                return fault(field, ElementFault::NotFinite(found));
            }
        }
        colored |= kind == TextureOpKind::VertexColor;
        let needs = kind.operands();
        if values < needs {
            return fault("kind", ElementFault::FewValues { needs, found: values });
        }
        values = values - needs + 1;
        if values > MAX_TEXTURE_STACK {
            return fault("kind", ElementFault::ManyValues { limit: MAX_TEXTURE_STACK });
        }
    }
    Ok((values, colored))
}

fn argument(kind: TextureOpKind, arg: u32, textures: &[Texture]) -> Option<ElementFault> {
    match kind {
        TextureOpKind::Image => index(arg, (Kind::TEXTURE, textures.len())).or_else(|| {
            textures[arg as usize].is_expression().then_some(ElementFault::NoImage(arg))
        }),
        TextureOpKind::Channel | TextureOpKind::Insert => count([arg], 0, 3),
        TextureOpKind::Noise => count([arg], 1, MAX_OCTAVES),
        TextureOpKind::Constant
        | TextureOpKind::Multiply
        | TextureOpKind::Add
        | TextureOpKind::Mix
        | TextureOpKind::Clamp
        | TextureOpKind::Tilt
        | TextureOpKind::Checker
        | TextureOpKind::Bricks
        | TextureOpKind::Gradient
        | TextureOpKind::Wave
        | TextureOpKind::VertexColor => unused(arg),
    }
}
