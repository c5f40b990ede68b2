//! Where things are, metres, world frame: boxes of instances, from what is known of their files or from every vertex.
//!
//! Things that move are where they are at the moment 0.

use glam::DVec3;
use lang::scene::{Instance, Shape, fourth};

use super::files::Meshes;
use crate::import::MeshFacts;

/// Lower and upper corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least coordinates.
    pub lo: [f64; 3],
    /// Greatest ones.
    pub hi: [f64; 3],
}

impl Bounds {
    /// Of some points; `None` without any, or where they are not finite.
    pub fn of(points: impl IntoIterator<Item = [f64; 3]>) -> Option<Self> {
        let (mut lo, mut hi) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for p in points.into_iter().map(DVec3::from) {
            (lo, hi) = (lo.min(p), hi.max(p));
        }
        let sound = lo.cmple(hi).all() && lo.is_finite() && hi.is_finite();
        // Zeros of either sign are one.
        sound.then(|| Self { lo: (lo + DVec3::ZERO).into(), hi: (hi + DVec3::ZERO).into() })
    }

    /// Of all of some boxes.
    pub fn union(boxes: impl IntoIterator<Item = Self>) -> Option<Self> {
        Self::of(boxes.into_iter().flat_map(|found| [found.lo, found.hi]))
    }

    /// Its middle.
    #[must_use]
    pub fn middle(&self) -> [f64; 3] {
        (0.5 * (DVec3::from(self.lo) + DVec3::from(self.hi))).into()
    }

    /// Its corners.
    pub(super) fn corners(&self) -> [[f64; 3]; 8] {
        corners_between([self.lo, self.hi])
    }

    /// Whether another box is wholly in it.
    pub(super) fn contains(&self, other: &Self) -> bool {
        DVec3::from(self.lo).cmple(other.lo.into()).all()
            && DVec3::from(other.hi).cmple(self.hi.into()).all()
    }

    /// Whether a point is in it.
    pub(super) fn has(&self, p: DVec3) -> bool {
        self.contains(&Self { lo: p.into(), hi: p.into() })
    }

    /// All of a sphere.
    pub(super) fn of_sphere(center: [f64; 3], radius: f64) -> Option<Self> {
        Self::of([center.map(|c| c - radius), center.map(|c| c + radius)])
    }
}

/// The corners of boxes around an instance, which are turned as it is; nothing where it has no extent.
pub(super) fn corners(instance: &Instance, assets: &[MeshFacts]) -> Vec<[f64; 3]> {
    let boxes: Vec<[[f64; 3]; 2]> = match &instance.shape {
        Shape::Mesh { asset, parts } => {
            let boxes = assets.get(*asset).map_or_else(Vec::new, |file| {
                let chosen = file.chosen(parts);
                chosen.iter().map(|part| file.parts[*part].bounds).collect()
            });
            let known = boxes.into_iter().filter(|[lo, hi]| lo[0] <= hi[0]);
            known.map(|corners| corners.map(|corner| corner.map(f64::from))).collect()
        }
        Shape::Quad { corners: [a, b, c] } => {
            let d = fourth([*a, *b, *c]);
            return [*a, *b, *c, d].map(|p| place(instance, p)).to_vec();
        }
        Shape::Faces { points, .. } => return points.iter().map(|p| place(instance, *p)).collect(),
        Shape::Sphere { .. } | Shape::Rectangle { .. } | Shape::Box { .. } => {
            instance.shape.bounds().into_iter().collect()
        }
    };
    boxes.into_iter().flat_map(corners_between).map(|p| place(instance, p)).collect()
}

/// What an instance of a sphere is in the world: centre and radius.
pub(super) fn ball(instance: &Instance) -> Option<([f64; 3], f64)> {
    let Shape::Sphere { radius } = instance.shape else { return None };
    // All axes are scaled alike, or it would be no sphere.
    let [x, y, z] = instance.world_from_object.map(|row| row[0]);
    Some((place(instance, [0.0; 3]), radius * DVec3::new(x, y, z).length()))
}

fn corners_between([lo, hi]: [[f64; 3]; 2]) -> [[f64; 3]; 8] {
    std::array::from_fn(|i| [0, 1, 2].map(|k| if i >> k & 1 == 0 { lo[k] } else { hi[k] }))
}

/// The box around an instance; `meshes` holds its file.
pub(super) fn tight(instance: &Instance, assets: &[MeshFacts], meshes: &Meshes) -> Option<Bounds> {
    match &instance.shape {
        Shape::Sphere { radius } => {
            let center = place(instance, [0.0; 3]);
            let reach = instance
                .world_from_object
                .map(|[x, y, z, _]| radius * DVec3::new(x, y, z).length());
            let end = |sign: f64| [0, 1, 2].map(|k| center[k] + sign * reach[k]);
            Bounds::of([end(-1.0), end(1.0)])
        }
        Shape::Rectangle { .. } | Shape::Quad { .. } | Shape::Box { .. } | Shape::Faces { .. } => {
            Bounds::of(corners(instance, assets))
        }
        Shape::Mesh { asset, parts } => {
            let (file, facts) = (meshes.get(asset)?, assets.get(*asset)?);
            let chosen = facts.chosen(parts);
            let points = chosen.iter().flat_map(|part| &file.parts[*part].positions);
            Bounds::of(points.map(|p| place(instance, p.map(f64::from))))
        }
    }
}

/// How many triangles an instance shows; `None` for a sphere, which is none.
pub(super) fn triangles(instance: &Instance, assets: &[MeshFacts]) -> Option<u64> {
    match &instance.shape {
        Shape::Sphere { .. } => None,
        Shape::Rectangle { .. } | Shape::Quad { .. } => Some(2),
        Shape::Box { .. } => Some(12),
        Shape::Faces { triangles, .. } => Some(triangles.len() as u64),
        Shape::Mesh { asset, parts } => {
            let file = assets.get(*asset)?;
            let chosen = file.chosen(parts);
            Some(chosen.iter().map(|part| file.parts[*part].n_triangles as u64).sum())
        }
    }
}

/// A point of the object in the world.
fn place(instance: &Instance, [x, y, z]: [f64; 3]) -> [f64; 3] {
    instance.world_from_object.map(|[a, b, c, d]| a * x + b * y + c * z + d)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_join_and_nothing_has_none() {
        assert_eq!(Bounds::of([]), None);
        assert_eq!(Bounds::of([[f64::NAN; 3]]), None);
        let ball = Bounds::of_sphere([1.0, 2.0, 3.0], 0.5).expect("a box");
        assert!(ball.has(DVec3::new(1.2, 2.2, 3.2)) && !ball.has(DVec3::ZERO));
        let all = Bounds::union([ball, Bounds { lo: [0.0; 3], hi: [1.0; 3] }]).expect("a box");
        assert_eq!((all.lo, all.hi), ([0.0; 3], [1.5, 2.5, 3.5]));
        assert!(all.contains(&ball) && !ball.contains(&all));
    }
}
