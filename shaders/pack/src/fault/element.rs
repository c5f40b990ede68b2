//! What a field of a record can have wrong.

use super::words::{index_or_none, list};
use crate::abi;
use crate::kind::Kind;

/// What a field of a record can have wrong.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ElementFault {
    /// Rows and columns that are not each other's inverse.
    #[error("and the other rows are not the inverse of the columns: off by {0:e}")]
    NotInverse(f32),
    /// NaN or infinite.
    #[error("is {0}, expected a finite number")]
    NotFinite(f32),
    /// NaN or infinite, double precision.
    #[error("is {0}, expected a finite number")]
    NotFinite64(f64),
    /// The step of a grid, whose products with 8 bits would be rounded.
    #[error("is {0}, expected a number of at most 16 significant bits")]
    Step(f32),
    /// A number outside its range.
    #[error("is {found}, expected {expected}")]
    Range {
        /// In the file.
        found: f32,
        /// The range in words.
        expected: &'static str,
    },
    /// An integer outside its range.
    #[error("is {found}, expected {min} to {max}")]
    Count {
        /// In the file.
        found: u32,
        /// Smallest.
        min: u32,
        /// Largest.
        max: u32,
    },
    /// An index beyond its table.
    #[error("is {found}, but {target} has {count} elements")]
    Index {
        /// In the file.
        found: u32,
        /// The table.
        target: Kind,
        /// Its elements.
        count: usize,
    },
    /// A welded id beyond three a triangle.
    #[error("is {found}, but there are {corners} corners")]
    Corner {
        /// In the file.
        found: u32,
        /// Three a triangle.
        corners: usize,
    },
    /// An unknown tag.
    #[error("is {found}, expected one of 0 to {last}")]
    Tag {
        /// In the file.
        found: u32,
        /// Last known tag.
        last: u32,
    },
    /// An unknown tag where tags have gaps.
    #[error("is {found}, expected one of {}", list(known))]
    OneOf {
        /// In the file.
        found: u32,
        /// Known tags.
        known: &'static [u32],
    },
    /// Unknown flag bits.
    #[error("is {found:#x}, known bits are {known:#x}")]
    Bits {
        /// In the file.
        found: u32,
        /// The known ones.
        known: u32,
    },
    /// Padding in use.
    #[error("is {0:#x}, unused fields must be zero")]
    Unused(u32),
    /// The scale is not a positive power of two.
    #[error("is {0}, expected a power of two")]
    PowerOfTwo(f64),
    /// A direction that is not of length 1.
    #[error("has length {0}, expected 1")]
    NotUnit(f32),
    /// Texels beyond the texel section.
    #[error("is {first}, so {words} words of texels end beyond TEXEL, which has {count} elements")]
    Texels {
        /// First word.
        first: u32,
        /// Words.
        words: u64,
        /// Of the section.
        count: usize,
    },
    /// An operation of a texture expression without enough values to work on.
    #[error("takes {needs} values, but there are {found}")]
    FewValues {
        /// How many it takes.
        needs: usize,
        /// How many there are.
        found: usize,
    },
    /// An operation of a texture expression that the stack has no room for.
    #[error("is one value too many on the stack, which holds {limit}")]
    ManyValues {
        /// What it holds.
        limit: usize,
    },
    /// A texture expression with more than one result.
    #[error("leaves {0} values, expected 1")]
    ValuesLeft(usize),
    /// A texture that must be an image.
    #[error("is {0}, which is a texture expression, expected an image")]
    NoImage(u32),
    /// A place that must be a multiple of something.
    #[error("is {found}, expected a multiple of {unit}")]
    NotAligned {
        /// In the file.
        found: u32,
        /// What it must be a multiple of.
        unit: u32,
    },
    /// Bit 31 of a primitive whose object stands still.
    #[error("is marked as moving, but object {object} is not")]
    Marked {
        /// The object.
        object: u32,
    },
    /// No bit 31 of a primitive whose object moves.
    #[error("is marked as static, but object {object} moves")]
    NotMarked {
        /// The object.
        object: u32,
    },
    /// An index of an element that must come before.
    #[error("is {found}, expected an element before this one")]
    NotBefore {
        /// In the file.
        found: u32,
    },
    /// Cumulative probabilities fall.
    #[error("is {found}, less than the {before} before it")]
    Falling {
        /// In the file.
        found: f32,
        /// Of the element before.
        before: f32,
    },
    /// A light in several sets.
    #[error("is {0:#x}, expected one bit or none")]
    SeveralSets(u32),
    /// A time that does not come after another.
    #[error("is {found}, not after the {before} before it")]
    NotAfter {
        /// In the file.
        found: f32,
        /// The other.
        before: f32,
    },
    /// The last piece of a way.
    #[error("is {0}, but no piece goes on from there, expected 1")]
    NoWayOn(f32),
    /// An edge between rows of the sky's table is not below the one before.
    #[error("is {found}, not less than the {before} before it")]
    Rising {
        /// In the file.
        found: f32,
        /// Of the element before.
        before: f32,
    },
    /// The first or last of numbers in order.
    #[error("is {found}, expected exactly {expected}")]
    Edge {
        /// In the file.
        found: f32,
        /// 1 or -1.
        expected: f32,
    },
    /// A node of the tree of lights is not where a walk expects it.
    #[error("leads to nodes in another order than first child, second child")]
    LightOrder,
    /// The tree of lights is deeper than a trail is long.
    #[error("leads deeper than {} levels", abi::MAX_LIGHT_DEPTH)]
    LightDepth,
    /// A leaf names no light of a surface, or one that another leaf has.
    #[error("is a leaf with light {0}, which is no surface or has a leaf already")]
    LightLeaf(u32),
    /// A light does not know its way.
    #[error("is {found:#x}, but the way to its leaf is {expected:#x}")]
    Trail {
        /// In the file.
        found: u32,
        /// The turns.
        expected: u32,
    },
    /// No leaf holds a light.
    #[error("leads nowhere: no leaf of the light tree holds this light")]
    LightLost,
    /// A directional light behind one of another kind.
    #[error("is directional, but the light before it is not")]
    NotFirst,
    /// A light of kind sky that is not the sky's own.
    #[error("is sky, but the light of SKY is {}", index_or_none(*.0))]
    NotOfSky(u32),
    /// The sky names a light of another kind.
    #[error("is {0}, which is not a light of kind sky")]
    NotASky(u32),
    /// Cumulative probabilities do not end at 1.
    #[error("is {0}, the last must be exactly 1")]
    LastCdf(f32),
}
