//! BVH nodes and primitives.
//!
//! Primitives are stored in leaf order, so a leaf is a range. Leaves are not nodes: a child
//! reference says directly which primitives it stands for.

use super::field::abi_struct;

/// Bit 31 of a child reference: the other 31 bits are a node index, greater than the parent's.
pub const CHILD_INNER: u32 = 1 << 31;
/// Bit 30 of a leaf reference: the range is of `Sphere`, otherwise of `Triangle`.
pub const CHILD_SPHERES: u32 = 1 << 30;
/// Most primitives in a leaf.
pub const MAX_LEAF: u32 = 8;
/// Deepest inner node allowed in one mesh's tree; the root has depth 0.
pub const MAX_DEPTH: u32 = 48;

/// Both bits of a reference to an instance: spheres have 26 bits for the first of them.
pub const CHILD_INSTANCE: u32 = CHILD_SPHERES | 1 << 26;
/// What the traversal leaves on its stack when it goes into an instance: behind it is the world again.
/// No reference of a pack.
pub const CHILD_OUT: u32 = CHILD_INNER - 1;

/// A decoded child reference. Layout of the word: inner `1iii…` (31-bit node index); leaf
/// `0s ccc i…`: `s` spheres, `ccc` count − 1, 27-bit first primitive; instance `0100 01i…`, 26-bit index;
/// `NONE` is no child at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChildRef {
    /// Index of an inner node.
    Inner(u32),
    /// Triangles `first .. first + count`, `count` in 1 ..= 8.
    Triangles {
        /// First triangle.
        first: u32,
        /// How many.
        count: u32,
    },
    /// Spheres `first .. first + count`, `count` in 1 ..= 8.
    Spheres {
        /// First sphere.
        first: u32,
        /// How many.
        count: u32,
    },
    /// An instance of a mesh that has a tree of its own.
    Instance(u32),
    /// No child: the reference of an empty tree.
    Empty,
}

impl ChildRef {
    const FIRST_MASK: u32 = (1 << 27) - 1;
    const INSTANCE_MASK: u32 = (1 << 26) - 1;

    /// Decodes a reference word; every word decodes to something.
    #[must_use]
    pub fn decode(word: u32) -> Self {
        if word == super::NONE {
            return Self::Empty;
        }
        if word & CHILD_INNER != 0 {
            return Self::Inner(word & !CHILD_INNER);
        }
        if word & !Self::INSTANCE_MASK == CHILD_INSTANCE {
            return Self::Instance(word & Self::INSTANCE_MASK);
        }
        let first = word & Self::FIRST_MASK;
        let count = ((word >> 27) & 7) + 1;
        if word & CHILD_SPHERES != 0 {
            Self::Spheres { first, count }
        } else {
            Self::Triangles { first, count }
        }
    }

    /// The reference word, or `None` when an index or a count does not fit.
    #[must_use]
    pub fn encode(self) -> Option<u32> {
        let leaf = |first: u32, count: u32, kind: u32| {
            let fits = first <= Self::FIRST_MASK && (1..=MAX_LEAF).contains(&count);
            fits.then(|| kind | ((count - 1) << 27) | first)
        };
        match self {
            // The all-ones word means `Empty`, so the largest index is not usable.
            Self::Inner(index) => (index < CHILD_INNER - 1).then_some(index | CHILD_INNER),
            Self::Triangles { first, count } => leaf(first, count, 0),
            Self::Spheres { first, count } if first <= Self::INSTANCE_MASK => {
                leaf(first, count, CHILD_SPHERES)
            }
            Self::Spheres { .. } => None,
            Self::Instance(index) => {
                (index <= Self::INSTANCE_MASK).then_some(CHILD_INSTANCE | index)
            }
            Self::Empty => Some(super::NONE),
        }
    }
}

/// Bit of `TriShade::object`: the triangle interpolates its normals.
pub const TRI_SMOOTH: u32 = 1 << 31;
/// Bit of all three ids of a `Triangle`, and of `Sphere::object`: its object moves while the shutter
/// is open.
pub const MOVES: u32 = 1 << 31;

abi_struct! {
    /// Inner node of the binary BVH, 64 bytes: the boxes of both children and where they are.
    /// Normalised world frame, or the frame of a mesh, see `Instance`.
    pub struct Node {
        /// Lower corner of the left child's box.
        pub left_lo: [f32; 3],
        /// `ChildRef` word of the left child.
        pub left: u32,
        /// Upper corner of the left child's box.
        pub left_hi: [f32; 3],
        /// `ChildRef` word of the right child.
        pub right: u32,
        /// Lower corner of the right child's box.
        pub right_lo: [f32; 3],
        /// Unused.
        pub _pad0: u32,
        /// Upper corner of the right child's box.
        pub right_hi: [f32; 3],
        /// Unused.
        pub _pad1: u32,
    }
}

/// Children that a [`WideNode`] has room for.
pub const WIDTH: usize = 4;
/// Ends of the box of an empty child, in steps: inside out, so that it cannot be mistaken for a box.
pub const EMPTY_BOX: [u8; 2] = [255, 0];

// Child `k` of a `WideNode` covers `origin + lo * scale` to `origin + hi * scale` along each axis. A step has at
// most 16 significant bits: its product with 8 bits is exact, so that the sum is rounded once, fused or not, and
// every device has the same boxes. A triangle of a mesh that is stored once is in the frame of its mesh, see
// `Instance`, and has the object `OBJECT_OF_INSTANCE`.

abi_struct! {
    /// Inner node of the wide BVH, 64 bytes: up to four children with boxes in steps of a grid of the node's own.
    /// Normalised world frame, or the frame of a mesh, see `Instance`. Child k is at byte k of the words of `lo` and
    /// `hi`, the lowest byte is 0.
    pub struct WideNode {
        /// Lower corner of the grid.
        pub origin: [f32; 3],
        /// `ChildRef` word of the first child.
        pub child0: u32,
        /// Length of a step along each axis; at most 16 significant bits.
        pub scale: [f32; 3],
        /// `ChildRef` word of the second child.
        pub child1: u32,
        /// Lower ends of the boxes along x, y and z, a byte a child; 255 for one that is not there.
        pub lo: [u32; 3],
        /// `ChildRef` word of the third child, or `NONE`.
        pub child2: u32,
        /// Upper ends of the boxes along x, y and z, a byte a child; 0 for one that is not there.
        pub hi: [u32; 3],
        /// `ChildRef` word of the fourth child, or `NONE`.
        pub child3: u32,
    }
}

impl WideNode {
    /// The `ChildRef` words of all four places; those that are not there are `NONE`.
    #[must_use]
    pub fn words(&self) -> [u32; WIDTH] {
        [self.child0, self.child1, self.child2, self.child3]
    }

    /// Ends of the box of child `slot`, 0 to 3, in steps along each axis.
    #[must_use]
    #[inline]
    pub fn steps(&self, slot: usize) -> [[u8; 3]; 2] {
        let step = |word: u32| word.to_le_bytes()[slot];
        let ([a, b, c], [x, y, z]) = (self.lo, self.hi);
        [[step(a), step(b), step(c)], [step(x), step(y), step(z)]]
    }

    /// Lower and upper corner of the box of child `slot`, as every device computes them.
    #[must_use]
    #[inline]
    pub fn corners(&self, slot: usize) -> [[f32; 3]; 2] {
        let [lo, hi] = self.steps(slot);
        [self.point(lo), self.point(hi)]
    }

    /// Lower and upper corner of the box around all children; that of a child that is not there is neutral.
    #[must_use]
    #[inline]
    pub fn hull(&self) -> [[f32; 3]; 2] {
        let least = |word: u32| {
            let [a, b, c, d] = word.to_le_bytes();
            a.min(b).min(c.min(d))
        };
        let most = |word: u32| {
            let [a, b, c, d] = word.to_le_bytes();
            a.max(b).max(c.max(d))
        };
        let ([a, b, c], [x, y, z]) = (self.lo, self.hi);
        [self.point([least(a), least(b), least(c)]), self.point([most(x), most(y), most(z)])]
    }

    /// A point of the grid. It rises with each of its steps, rounded as it is.
    #[inline]
    fn point(&self, steps: [u8; 3]) -> [f32; 3] {
        let at = |axis: usize| self.origin[axis] + f32::from(steps[axis]) * self.scale[axis];
        [at(0), at(1), at(2)]
    }
}

abi_struct! {
    /// A triangle's corners, 48 bytes, in leaf order. Normalised world frame, as when the shutter
    /// opens; the geometric normal is `cross(v1 - v0, v2 - v0)`.
    pub struct Triangle {
        /// First corner.
        pub v0: [f32; 3],
        /// Bits 0-30: id of the first corner after welding by position: equal bits, equal id. Bit 31, `MOVES`, is
        /// the same in all three.
        pub id0: u32,
        /// Second corner.
        pub v1: [f32; 3],
        /// Welded id of the second corner.
        pub id1: u32,
        /// Third corner.
        pub v2: [f32; 3],
        /// Welded id of the third corner.
        pub id2: u32,
    }
}

abi_struct! {
    /// What shading needs of a triangle, 48 bytes, same index as its `Triangle`.
    pub struct TriShade {
        /// Shading normals of the three corners, octahedral, x and y as 16-bit signed normalised
        /// integers (x in the low half); world frame, not necessarily on the geometric side.
        pub normals: [u32; 3],
        /// Index of the `Material`.
        pub material: u32,
        /// Texture coordinates of the first corner; v points up.
        pub uv0: [f32; 2],
        /// Texture coordinates of the second corner.
        pub uv1: [f32; 2],
        /// Texture coordinates of the third corner.
        pub uv2: [f32; 2],
        /// Index of the `Light` this triangle belongs to, or `NONE`.
        pub light: u32,
        /// Bits 0-30: index of the `Object`. Bit 31, `TRI_SMOOTH`: interpolate `normals`;
        /// otherwise the triangle is flat.
        pub object: u32,
    }
}

abi_struct! {
    /// A sphere, 32 bytes, in leaf order. Normalised world frame, as when the shutter opens.
    pub struct Sphere {
        /// Centre.
        pub center: [f32; 3],
        /// Radius, > 0.
        pub radius: f32,
        /// Index of the `Material`.
        pub material: u32,
        /// Index of the `Light`, or `NONE`.
        pub light: u32,
        /// Bits 0-30: index of the `Object`. Bit 31: `MOVES`.
        pub object: u32,
        /// Unused.
        pub _pad0: u32,
    }
}
