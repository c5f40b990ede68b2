//! Triangles become the pieces that hang together.
//!
//! It does not know positions: a corner is any key, and equal keys are one corner.

use std::collections::BTreeMap;

/// The piece of each triangle, numbered as they come: triangles with a corner in common hang together.
pub(super) fn pieces<K: Ord>(triangles: impl Iterator<Item = [K; 3]>) -> Vec<u32> {
    let mut ids = BTreeMap::new();
    let mut parent: Vec<u32> = Vec::new();
    let mut first = Vec::new();
    for triangle in triangles {
        let corners = triangle.map(|key| {
            *ids.entry(key).or_insert_with(|| {
                parent.push(parent.len() as u32);
                parent.len() as u32 - 1
            })
        });
        for corner in corners {
            let (a, b) = (root(&mut parent, corners[0]), root(&mut parent, corner));
            parent[a.max(b) as usize] = a.min(b);
        }
        first.push(corners[0]);
    }
    let mut numbers = BTreeMap::new();
    first
        .into_iter()
        .map(|corner| {
            let next = numbers.len() as u32;
            *numbers.entry(root(&mut parent, corner)).or_insert(next)
        })
        .collect()
}

/// The representative of `id`; halves the path to it.
fn root(parent: &mut [u32], mut id: u32) -> u32 {
    while parent[id as usize] != id {
        let up = parent[parent[id as usize] as usize];
        parent[id as usize] = up;
        id = up;
    }
    id
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_what_corners_join() {
        // The third triangle joins the first two; the fourth stands alone.
        let triangles = [[0, 1, 2], [5, 6, 7], [2, 3, 5], [9, 9, 8]];
        assert_eq!(pieces(triangles.into_iter()), [0, 0, 0, 1]);
        assert_eq!(pieces(triangles[..2].iter().copied()), [0, 1]);
    }
}
