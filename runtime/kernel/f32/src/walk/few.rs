//! Lists of what is in the smallest trees.
//!
//! Turns a tree over few triangles into a list of its leaves and one of all corners, each once. In a room, rays that are
//! traced together come to most of the tree: then a list costs less than nodes and a stack, and each corner is taken into
//! the frames of the rays once, for all triangles that share it.

use super::questions::Marked;
use pack::abi::Triangle;
use std::ops::Range;

/// Triangles of a list, at most.
const MOST: usize = 64;

/// Leaves of a list, at most.
const MOST_LEAVES: usize = 32;

/// Corners of a list, at most.
pub const MOST_CORNERS: usize = 64;

/// Leaves whose boxes a ray through the tree meets on average, at least: the sum of their areas over the area of the
/// box of the tree. Where they are fewer, nodes leave out more than they cost.
const MET: f32 = 0.7;

/// For each axis the lower and the upper end of a box.
pub type Ends = [[f32; 2]; 3];

/// A triangle of a list.
#[derive(Clone, Copy, Debug)]
pub struct Listed {
    /// Which one.
    pub triangle: Marked,
    /// Places in `Few::corners`.
    pub corners: [u8; 3],
    /// Ids of its corners.
    pub ids: [u32; 3],
}

/// A leaf of triangles.
#[derive(Debug)]
pub struct Leaf {
    /// Its box.
    pub ends: Ends,
    /// Which ones of `Few::corners` it has, a bit each.
    pub corners: u64,
    /// Places in `Few::triangles`.
    pub triangles: Range<usize>,
}

/// A leaf of spheres.
#[derive(Clone, Copy, Debug)]
pub struct SphereLeaf {
    /// Its box.
    pub ends: Ends,
    /// Its reference, as in the pack.
    pub child: u32,
}

/// Everything in a tree.
#[derive(Debug, Default)]
pub struct Few {
    /// Corners of triangles, no more than `MOST_CORNERS`; the last number counts for nothing.
    pub corners: Vec<[f32; 4]>,
    /// All triangles.
    pub triangles: Vec<Listed>,
    /// All leaves of triangles, the smallest first: what is behind others is large.
    pub leaves: Vec<Leaf>,
    /// All leaves of spheres.
    pub spheres: Vec<SphereLeaf>,
}

/// What lies in a leaf.
pub(super) enum Content {
    /// Triangles that stand still.
    Triangles(Vec<Marked>),
    /// Spheres: their reference.
    Spheres(u32),
}

impl Few {
    /// All that is in these leaves of a tree, of which some are over some of `triangles`, if that is little and met by
    /// most rays.
    pub(super) fn of(
        leaves: impl Iterator<Item = (Ends, Content)>,
        triangles: &[Triangle],
    ) -> Option<Self> {
        let mut few = Self::default();
        let mut all = [[f32::INFINITY, f32::NEG_INFINITY]; 3];
        let mut sum = 0.0;
        for (ends, content) in leaves {
            for (all, ends) in all.iter_mut().zip(ends) {
                *all = [all[0].min(ends[0]), all[1].max(ends[1])];
            }
            sum += area(&ends);
            match content {
                Content::Triangles(indices) => few.add(ends, &indices, triangles)?,
                Content::Spheres(child) => few.spheres.push(SphereLeaf { ends, child }),
            }
            if few.leaves.len() + few.spheres.len() > MOST_LEAVES {
                return None;
            }
        }
        few.leaves.sort_by_key(|leaf| area(&leaf.ends).to_bits());
        (sum >= MET * area(&all)).then_some(few)
    }

    /// Adds a leaf of the triangles `indices`, unless it is too much.
    fn add(&mut self, ends: Ends, indices: &[Marked], triangles: &[Triangle]) -> Option<()> {
        let (first, mut mask) = (self.triangles.len(), 0);
        for triangle in indices {
            let Triangle { v0, v1, v2, id0, id1, id2, .. } = triangles[triangle.index() as usize];
            let mut corners = [0; 3];
            for (place, [x, y, z]) in corners.iter_mut().zip([v0, v1, v2]) {
                *place = self.place([x, y, z, 0.0])?;
                mask |= 1 << *place;
            }
            self.triangles.push(Listed { triangle: *triangle, corners, ids: [id0, id1, id2] });
        }
        let end = self.triangles.len();
        self.leaves.push(Leaf { ends, corners: mask, triangles: first..end });
        (end <= MOST).then_some(())
    }

    /// The place of a corner, which may be new, unless there are too many.
    fn place(&mut self, corner: [f32; 4]) -> Option<u8> {
        let bits = |corner: &[f32; 4]| corner.map(f32::to_bits);
        let known = self.corners.iter().position(|other| bits(other) == bits(&corner));
        let place = known.unwrap_or_else(|| {
            self.corners.push(corner);
            self.corners.len() - 1
        });
        u8::try_from(place).ok().filter(|_| place < MOST_CORNERS)
    }
}

/// Half the area of a box.
fn area(ends: &Ends) -> f32 {
    let [x, y, z] = ends.map(|[low, high]| (high - low).max(0.0));
    x * y + y * z + z * x
}

#[cfg(test)]
mod tests {
    use super::super::questions::Questions;
    use super::*;

    /// Two triangles of a square of side 1.
    fn square() -> [Triangle; 2] {
        let at = |x: u8, y: u8| [f32::from(x), f32::from(y), 0.0];
        let triangle = |[a, b, c]: [(u8, u8, u32); 3]| Triangle {
            v0: at(a.0, a.1),
            id0: a.2,
            v1: at(b.0, b.1),
            id1: b.2,
            v2: at(c.0, c.1),
            id2: c.2,
        };
        let [a, b, c, d] = [(0, 0, 0), (1, 0, 1), (1, 1, 2), (0, 1, 3)];
        [triangle([a, b, c]), triangle([a, c, d])]
    }

    /// Triangle `i`, of which nothing has to be asked.
    fn plain(i: u32) -> Marked {
        Marked::new(i, Questions::default())
    }

    /// A box of which one corner is the origin.
    fn up_to(x: f32, y: f32, z: f32) -> Ends {
        [[0.0, x], [0.0, y], [0.0, z]]
    }

    #[test]
    fn triangles_share_corners_and_small_leaves_are_first() {
        let leaves = [
            (up_to(1.0, 1.0, 0.0), Content::Triangles(vec![plain(0), plain(1)])),
            (up_to(1.0, 0.5, 0.0), Content::Triangles(vec![plain(0)])),
            (up_to(0.1, 0.1, 0.1), Content::Spheres(7)),
        ];
        let few = Few::of(leaves.into_iter(), &square()).expect("a list");
        assert_eq!(few.corners.len(), 4);
        let bits: Vec<u64> = few.leaves.iter().map(|leaf| leaf.corners).collect();
        assert_eq!(bits, [0b111, 0b1111]);
        let places: Vec<[u8; 3]> = few.triangles.iter().map(|listed| listed.corners).collect();
        assert_eq!(places, [[0, 1, 2], [0, 2, 3], [0, 1, 2]]);
        assert_eq!(few.spheres.len(), 1);
    }

    #[test]
    fn there_is_no_list_of_much_or_of_what_rays_seldom_meet() {
        let leaf = |n: usize| (up_to(1.0, 1.0, 0.0), Content::Triangles(vec![plain(0); n]));
        let of = |leaves: Vec<(Ends, Content)>| Few::of(leaves.into_iter(), &square());
        let leaves = |n: usize| (0..n).map(|_| leaf(1)).collect();
        assert!(of(vec![leaf(MOST)]).is_some() && of(vec![leaf(MOST + 1)]).is_none());
        assert!(of(leaves(MOST_LEAVES)).is_some() && of(leaves(MOST_LEAVES + 1)).is_none());
        let far = [[9.0, 10.0], [9.0, 10.0], [0.0, 0.0]];
        assert!(of(vec![leaf(1), (far, Content::Triangles(vec![plain(1)]))]).is_none());
    }
}
