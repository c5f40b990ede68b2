//! The rules of a pack, grouped by what they judge: one variant a rule.
//!
//! Turns a broken rule into words; [`crate::PackError`] says where.

use std::fmt;

use crate::abi::{self, ChildRef};
use crate::kind::Kind;

/// What the header can have wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HeaderFault {
    /// Shorter than a header.
    #[error("the file ends after {len} bytes, a pack has at least 128")]
    Short {
        /// Length of the file.
        len: u64,
    },
    /// `RTP` is there, the bytes around it are not.
    #[error("the first bytes were altered, perhaps by a transfer in text mode")]
    Altered,
    /// Not the expected byte order.
    #[error("byte order tag is {found:#010x}, expected 0x01020304")]
    Endian {
        /// The tag.
        found: u32,
    },
    /// Another format.
    #[error(
        "format {found}, this program reads format {expected}: compile the scene again: rtc X -o X.pack"
    )]
    Major {
        /// Format of the file.
        found: u16,
        /// Format of this program.
        expected: u16,
    },
    /// Unknown feature bits.
    #[error("unknown features {bits:#018x}: the pack needs a newer program")]
    UnknownFeatures {
        /// The unknown ones.
        bits: u64,
    },
    /// Features that are not those of the contents.
    #[error("features are {found:#018x}, but the contents have {expected:#018x}")]
    Features {
        /// In the header.
        found: u64,
        /// Derived.
        expected: u64,
    },
    /// Other records.
    #[error(
        "record layout {found:#010x}, this program has {expected:#010x}: compile the scene again: rtc X -o X.pack"
    )]
    Layout {
        /// Of the file.
        found: u32,
        /// Of this program.
        expected: u32,
    },
    /// A field that has one legal value has another.
    #[error("{field} is {found}, expected {expected}")]
    Fixed {
        /// Which.
        field: &'static str,
        /// In the file.
        found: u64,
        /// The only legal value.
        expected: u64,
    },
    /// Truncated or extended.
    #[error("the header says {said} bytes, the file has {actual}: {}", if said > actual { "truncated" } else { "bytes follow the pack" })]
    FileLen {
        /// In the header.
        said: u64,
        /// Of the file.
        actual: u64,
    },
    /// No sections, or too many.
    #[error("{found} sections, expected 1 to 256")]
    SectionCount {
        /// In the file.
        found: u32,
    },
    /// The table does not fit.
    #[error("the section table needs {needed} bytes, the file has {actual}")]
    Table {
        /// Header and table.
        needed: u64,
        /// Of the file.
        actual: u64,
    },
    /// The sections end elsewhere than the file.
    #[error("the last section ends at byte {end:#x}, the file at byte {actual:#x}")]
    End {
        /// End of the last section.
        end: u64,
        /// Of the file.
        actual: u64,
    },
    /// Not the hash of the table.
    #[error("render_id does not match the section table")]
    RenderId,
}

/// What a section or its entry can have wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SectionFault {
    /// A name that must be understood and is not.
    #[error("unknown mandatory section: the pack needs a newer program")]
    Unknown,
    /// A name that this format does not have.
    #[error("unknown section in format {major}.{minor}")]
    NotInFormat {
        /// Format of the file.
        major: u16,
        /// Format of the file.
        minor: u16,
    },
    /// A name that is not printable ASCII.
    #[error("the name is not ASCII")]
    Name,
    /// Out of the canonical order.
    #[error("out of order: it must come before {after}")]
    Order {
        /// The section before it.
        after: Kind,
    },
    /// Twice.
    #[error("the section is duplicated")]
    Twice,
    /// Elements of another version.
    #[error(
        "version {found}, this program reads version {expected}: compile the scene again: rtc X -o X.pack"
    )]
    Version {
        /// In the file.
        found: u32,
        /// Of this program.
        expected: u32,
    },
    /// Flags other than those of the kind.
    #[error("flags are {found:#x}, expected {expected:#x}")]
    Flags {
        /// In the file.
        found: u32,
        /// Of the kind.
        expected: u32,
    },
    /// Reserved bytes in use.
    #[error("the reserved field is {found:#x}, expected 0")]
    Reserved {
        /// In the file.
        found: u32,
    },
    /// Elements of another size.
    #[error("element size is {found} bytes, expected {expected}")]
    ElemSize {
        /// In the file.
        found: u32,
        /// Of the kind.
        expected: u32,
    },
    /// Too few or too many elements.
    #[error("{found} elements, expected {min} to {max}")]
    Count {
        /// In the file.
        found: u64,
        /// Fewest.
        min: u64,
        /// Most.
        max: u64,
    },
    /// The length is not count times size.
    #[error("length is {found} bytes, but {count} elements of {size} bytes make {}", Product(*count, *size))]
    Length {
        /// In the file.
        found: u64,
        /// Elements.
        count: u64,
        /// Bytes of one.
        size: u32,
    },
    /// Not where the section before it ends.
    #[error("offset is {found:#x}, expected {expected:#x}")]
    Offset {
        /// In the file.
        found: u64,
        /// First boundary after the section before.
        expected: u64,
    },
    /// Beyond the end of the file.
    #[error("{length} bytes at {offset:#x} reach beyond the end of the file at {file_len:#x}")]
    Beyond {
        /// First byte.
        offset: u64,
        /// Bytes.
        length: u64,
        /// Of the file.
        file_len: u64,
    },
}

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

/// What the tree can have wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BvhFault {
    /// Geometry, but no root.
    #[error("root is none, but there is geometry")]
    NoRoot,
    /// Inner nodes, but the root is not node 0.
    #[error("root is {}, but a tree with nodes starts at node 0", Reference(*found))]
    Root {
        /// The reference word.
        found: u32,
    },
    /// A child that is nothing.
    #[error("{side} is none: an inner node has two children")]
    NoChild {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
    },
    /// The place of a child that is not there has a box that could be hit.
    #[error("{side} is none, but its box is not 255 to 0")]
    EmptyBox {
        /// `child2` or `child3`.
        side: &'static str,
    },
    /// A child behind one that is not there.
    #[error("{side} is none, but a child follows it")]
    Gap {
        /// `child2`.
        side: &'static str,
    },
    /// A node that comes before its parent.
    #[error("{side} is node {child}, a child must come after its parent")]
    Backwards {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
        /// The child.
        child: u32,
    },
    /// A node that does not exist.
    #[error("{side} is node {child}, but {kind} has {count} elements")]
    NoSuchNode {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
        /// The child.
        child: u32,
        /// NODE or WIDENODE.
        kind: Kind,
        /// Of the section.
        count: usize,
    },
    /// A leaf beyond the primitives.
    #[error("{side} is {}, but {target} has {count} elements", Reference(*word))]
    Leaf {
        /// `left`, `right`, `child0` to `child3` or `root`.
        side: &'static str,
        /// The reference word.
        word: u32,
        /// TRIANGLE or SPHERE.
        target: Kind,
        /// Its elements.
        count: usize,
    },
    /// A node with two parents.
    #[error("{side} is node {child}, which already has a parent")]
    SharedNode {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
        /// The child.
        child: u32,
    },
    /// A primitive in two leaves.
    #[error("{side} is {}, but a primitive of it is in another leaf already", Reference(*word))]
    SharedLeaf {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
        /// The reference word.
        word: u32,
    },
    /// A reference to an instance that does not exist.
    #[error("{side} is instance {index}, but INSTANCE has {count} elements")]
    NoSuchInstance {
        /// `left`, `right` or `root`.
        side: &'static str,
        /// The instance.
        index: u32,
        /// Of the section.
        count: usize,
    },
    /// An instance in two leaves.
    #[error("{side} is instance {index}, which is in another leaf already")]
    SharedInstance {
        /// `left`, `right` or `root`.
        side: &'static str,
        /// The instance.
        index: u32,
    },
    /// The root of an instance that is neither a node nor triangles.
    #[error("root is {}, an instance shows a node or triangles", Reference(*found))]
    MeshRoot {
        /// The reference word.
        found: u32,
    },
    /// Spheres or an instance in the tree of an instance.
    #[error("{side} is {}, but the tree of an instance holds triangles", Reference(*word))]
    InMesh {
        /// `left` or `right`.
        side: &'static str,
        /// The reference word.
        word: u32,
    },
    /// Triangles of an instance outside of it, or others inside, or a light inside.
    #[error(
        "{side} is {}, of which one {}", Reference(*word),
        if *inside { "belongs to no instance, or is a light" } else { "belongs to an instance" }
    )]
    Frame {
        /// `left`, `right` or `root`.
        side: &'static str,
        /// The reference word.
        word: u32,
        /// Whether the leaf is in the tree of an instance.
        inside: bool,
    },
    /// A node that no parent names.
    #[error("no parent refers to this node")]
    Unreachable,
    /// A primitive in no leaf.
    #[error("no leaf holds this primitive")]
    Lost,
    /// A box whose lower corner is above its upper one.
    #[error("the {side} box is inverted on axis {}", axis(*axis_index))]
    Inverted {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
        /// 0, 1, 2.
        axis_index: usize,
    },
    /// A child's boxes reach out of the parent's box for that child.
    #[error("the boxes of node {child} exceed the {side} box on axis {}", axis(*axis_index))]
    NotNested {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
        /// The child.
        child: u32,
        /// 0, 1, 2.
        axis_index: usize,
    },
    /// Deeper than any stack.
    #[error("the tree needs {need} stack entries, at most {} are allowed", abi::MAX_STACK)]
    TooDeep {
        /// Recomputed.
        need: u32,
    },
    /// The stored need is not the real one.
    #[error("stack_need is {found}, but the tree needs {need}")]
    StackNeed {
        /// In the file.
        found: u32,
        /// Recomputed.
        need: u32,
    },
}

/// An optional index in words.
fn index_or_none(index: u32) -> String {
    if index == abi::NONE { "none".to_owned() } else { index.to_string() }
}

fn axis(index: usize) -> &'static str {
    ["x", "y", "z"].get(index).copied().unwrap_or("?")
}

/// A product that may not fit.
struct Product(u64, u32);

impl fmt::Display for Product {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}", u128::from(self.0) * u128::from(self.1))
    }
}

/// A child reference in words.
struct Reference(u32);

impl fmt::Display for Reference {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut leaf = |kind: &str, first: u32, count: u32| {
            write!(out, "{kind} {first}..{}", u64::from(first) + u64::from(count))
        };
        match ChildRef::decode(self.0) {
            ChildRef::Triangles { first, count } => leaf("triangles", first, count),
            ChildRef::Spheres { first, count } => leaf("spheres", first, count),
            ChildRef::Inner(index) => write!(out, "node {index}"),
            ChildRef::Instance(index) => write!(out, "instance {index}"),
            ChildRef::Empty => write!(out, "none"),
        }
    }
}

/// `0, 1, 4`.
fn list(tags: &[u32]) -> String {
    tags.iter().map(u32::to_string).collect::<Vec<_>>().join(", ")
}
