//! Vertex ids by position.
//!
//! Turns the corners of all triangles of the scene into small integers: equal positions (equal bits
//! after -0 has become +0), equal id; different positions, different ids. The watertight
//! intersection orders the ends of a shared edge by these ids, so texture seams and meshes that only
//! touch must share them too. Ids depend on the set of positions alone, not on the order of the
//! triangles or on threads, and a sort has no bad case that a hostile mesh could provoke.

use rayon::prelude::*;

/// Ids of the corners of all triangles.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Welded {
    /// Three ids per triangle, each below `n_ids`.
    pub ids: Vec<[u32; 3]>,
    /// Number of different positions; ids are `0 .. n_ids`, ascending with (x, y, z) read as bits.
    pub n_ids: u32,
}

/// Most labels: as many as corners of the triangles that a tree allows.
const MAX_LABELS: usize = 3 << 27;

/// Welds the corners of fewer than 2^32 / 3 triangles; coordinates are in the frame in which the
/// kernel sees them.
#[must_use]
pub fn weld(triangles: &[[[f32; 3]; 3]]) -> Welded {
    let n_corners = 3 * triangles.len();
    assert!(u32::try_from(n_corners).is_ok(), "the tree allows 2^27 triangles, far fewer");
    let corners = triangles.as_flattened();
    // One number per corner: 96 bits of position, then the corner itself.
    let numbered = corners.par_iter().enumerate();
    let mut keys: Vec<u128> =
        numbered.map(|(corner, p)| position_bits(p) << 32 | corner as u128).collect();
    keys.par_sort_unstable();
    let mut ids = vec![[0; 3]; triangles.len()];
    let flat = ids.as_flattened_mut();
    let mut n_ids = 0;
    let mut previous = None;
    for key in keys {
        let (position, corner) = (key >> 32, key & 0xffff_ffff);
        if previous != Some(position) {
            previous = Some(position);
            n_ids += 1;
        }
        let corner = usize::try_from(corner).expect("32 bits");
        flat[corner] = n_ids - 1;
    }
    Welded { ids, n_ids }
}

/// As [`weld`], where most corners have labels: numbers that ascend as ids do, equal for equal positions. A triangle
/// without has `u32::MAX` three times. `None` if these cannot be such labels.
#[must_use]
pub fn weld_labelled(triangles: &[[[f32; 3]; 3]], labels: Vec<[u32; 3]>) -> Option<Welded> {
    const NEW: u32 = u32::MAX;
    let is_label = |label: &&u32| **label != NEW;
    let largest = labels.as_flattened().iter().filter(is_label).max();
    let n_labels = largest.map_or(0, |largest| *largest as usize + 1);
    // Ids are labels: no more than there are corners.
    if labels.len() != triangles.len() || n_labels > MAX_LABELS {
        return None;
    }
    let (mut ids, corners) = (labels, triangles.as_flattened());
    let mut known: Vec<Option<u128>> = vec![None; n_labels];
    let mut new: Vec<u128> = Vec::new();
    for (id, p) in ids.as_flattened().iter().zip(corners) {
        if *id == NEW {
            new.push(position_bits(p));
        } else {
            *known.get_mut(*id as usize)? = Some(position_bits(p));
        }
    }
    new.sort_unstable();
    new.dedup();
    // Both lists ascend: one walk through both gives every position its rank.
    let (mut id_of_known, mut id_of_new) = (vec![NEW; n_labels], vec![NEW; new.len()]);
    let (mut n_ids, mut next, mut last) = (0_u32, 0, None);
    for (id, position) in id_of_known.iter_mut().zip(&known) {
        let Some(position) = *position else { continue };
        if last >= Some(position) {
            return None;
        }
        last = Some(position);
        while next < new.len() && new[next] < position {
            (id_of_new[next], n_ids, next) = (n_ids, n_ids + 1, next + 1);
        }
        if new.get(next) == Some(&position) {
            (id_of_new[next], next) = (n_ids, next + 1);
        }
        (*id, n_ids) = (n_ids, n_ids + 1);
    }
    for id in &mut id_of_new[next..] {
        (*id, n_ids) = (n_ids, n_ids + 1);
    }
    for (id, p) in ids.as_flattened_mut().iter_mut().zip(corners) {
        *id = if *id == NEW {
            id_of_new[new.binary_search(&position_bits(p)).ok()?]
        } else {
            id_of_known[*id as usize]
        };
    }
    Some(Welded { ids, n_ids })
}

/// The bits of x, y, z from high to low; both zeros are the same.
fn position_bits(p: &[f32; 3]) -> u128 {
    p.iter().fold(0, |bits, x| bits << 32 | u128::from((x + 0.0).to_bits()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tri(a: f32, b: f32, c: f32) -> [[f32; 3]; 3] {
        [[a, 0.0, 0.0], [b, 0.0, 0.0], [c, 0.0, 0.0]]
    }

    #[test]
    fn nothing_welds_to_nothing() {
        assert_eq!(weld(&[]), Welded::default());
    }

    #[test]
    fn equal_bits_share_an_id_and_zeros_are_equal() {
        let w = weld(&[tri(0.0, 1.0, 2.0), tri(2.0, -0.0, 1.0), tri(3.0, 3.0, 3.0)]);
        assert_eq!(w.n_ids, 4);
        assert_eq!(w.ids[0], [0, 1, 2]);
        assert_eq!(w.ids[1], [2, 0, 1]);
        assert_eq!(w.ids[2], [3, 3, 3]);
    }

    #[test]
    fn labels_change_nothing() {
        let all: Vec<_> = (0..60_u16)
            .map(|i| {
                let at = |k: u16| f32::from(i * k % 17) - 8.0;
                tri(at(1), at(3), at(5))
            })
            .collect();
        let before = weld(&all);
        for step in 2..9 {
            let (mut moved, mut ids) = (all.clone(), before.ids.clone());
            for (i, k) in (0..all.len()).zip(0_u16..).step_by(step) {
                moved[i] = tri(0.25 * f32::from(k), all[i][0][0], -0.0);
                ids[i] = [u32::MAX; 3];
            }
            assert_eq!(weld_labelled(&moved, ids), Some(weld(&moved)));
        }
        assert_eq!(weld_labelled(&all[1..], before.ids.clone()), None);
        assert_eq!(weld_labelled(&all, vec![[u32::MAX - 1; 3]; all.len()]), None);
        let mut wrong = before.ids;
        wrong.reverse();
        assert_eq!(weld_labelled(&all, wrong), None);
    }

    #[test]
    fn the_next_float_is_another_vertex() {
        let w = weld(&[tri(1.0, 1.0_f32.next_up(), 1.0_f32.next_down())]);
        assert_eq!(w.n_ids, 3);
    }

    #[test]
    #[expect(clippy::float_cmp, reason = "exact results are the point")]
    fn ids_do_not_depend_on_order_or_threads() {
        let point = |i: u32| [(i % 7) as f32 - 3.0, (i % 11) as f32, (i % 5) as f32 * 0.1];
        let mesh: Vec<_> =
            (0..5000).map(|i| [point(i), point(i * 31 + 1), point(i * 17 + 5)]).collect();
        let welded = weld(&mesh);
        let mut reversed: Vec<_> = mesh.clone();
        reversed.reverse();
        let mut back = weld(&reversed);
        back.ids.reverse();
        assert_eq!(welded, back);
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        assert_eq!(welded, one.install(|| weld(&mesh)));
        assert_eq!(welded.n_ids, 7 * 11 * 5);
        for (t, ids) in mesh.iter().zip(&welded.ids) {
            for (u, jds) in mesh.iter().zip(&welded.ids).take(20) {
                assert_eq!(t[0] == u[1], ids[0] == jds[1]);
            }
        }
    }
}
