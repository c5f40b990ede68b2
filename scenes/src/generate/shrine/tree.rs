//! Cherry trees: a trunk that forks into limbs, branches and twigs, and cards with blossom on the
//! twigs. Foot in the origin.

use super::kit::{Mesh, V3, add, cross, dot, normalize, scale, sub};
use super::noise::Rng;

/// How a tree grows; lengths in metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Habit {
    pub(super) seed: u64,
    /// Length and radius of the trunk below the fork.
    pub(super) trunk: [f64; 2],
    /// Which way the trunk leans.
    pub(super) lean: V3,
    /// Number and length of limbs.
    pub(super) limbs: [f64; 2],
    /// Limbs prefer this direction.
    pub(super) toward: V3,
}

/// Bark, and where blossom may grow.
#[derive(Default)]
pub(super) struct Tree {
    /// Trunk to twigs; u around, v along.
    pub(super) bark: Mesh,
    /// Ends of twig pieces.
    twigs: Vec<[V3; 2]>,
}

/// Children per level, and steps of a path per level.
const CHILDREN: [usize; 3] = [0, 7, 6];
const STEPS: [usize; 4] = [10, 12, 7, 4];

/// A tree without blossom.
pub(super) fn tree(habit: &Habit) -> Tree {
    let mut tree = Tree::default();
    let mut rng = Rng::new(habit.seed);
    let [length, radius] = habit.trunk;
    let start = normalize(add([0.0, 1.0, 0.0], scale(habit.lean, 0.35)));
    let path = wander(&mut rng, [0.0, -0.25, 0.0], start, length + 0.25, STEPS[0], [0.16, 0.1]);
    // Roots spread at the foot.
    let thick = |k: usize| {
        let t = k as f64 / STEPS[0] as f64;
        radius * (1.0 - 0.3 * t + 0.75 * libm::exp(-9.0 * t))
    };
    let radii: Vec<f64> = (0..path.len()).map(thick).collect();
    tree.bark.tube(&path, &radii, 28, 0.8);
    let fork = path[path.len() - 1];
    let n = habit.limbs[0] as usize;
    for limb in 0..n {
        let a = std::f64::consts::TAU * (limb as f64 + 0.5 * rng.unit()) / n as f64;
        let out = normalize(add([libm::cos(a), rng.range(0.45, 0.95), libm::sin(a)], habit.toward));
        let low = path[path.len() - 1 - rng.below(3)];
        let from = if limb % 3 == 2 { low } else { fork };
        let long = habit.limbs[1]
            * rng.range(0.75, 1.15)
            * (0.75 + 0.35 * dot(out, normalize(add(habit.toward, [0.0, 0.4, 0.0]))));
        let thick = radius * rng.range(0.42, 0.58);
        grow(&mut tree, &mut rng, [from, out], [long, thick], 1);
    }
    tree
}

/// A crooked path; `[wild, up]`: how crooked, and how much it bends upward (below 0: down).
fn wander(
    rng: &mut Rng,
    from: V3,
    dir: V3,
    length: f64,
    steps: usize,
    [wild, up]: [f64; 2],
) -> Vec<V3> {
    let mut path = vec![from];
    let mut dir = dir;
    let mut at = from;
    for _ in 0..steps {
        dir = normalize(add(dir, add(scale(rng.direction(), wild), [0.0, up, 0.0])));
        at = add(at, scale(dir, length / steps as f64));
        path.push(at);
    }
    path
}

/// A limb, branch or twig from a point in a direction, with all that grows on it.
fn grow(
    tree: &mut Tree,
    rng: &mut Rng,
    [from, dir]: [V3; 2],
    [length, radius]: [f64; 2],
    level: usize,
) {
    let bend = [[0.0, 0.0], [0.24, -0.035], [0.27, -0.02], [0.22, -0.05]][level];
    let steps = STEPS[level];
    let path = wander(rng, from, dir, length, steps, bend);
    let radii: Vec<f64> =
        (0..=steps).map(|k| (radius * (1.0 - 0.75 * k as f64 / steps as f64)).max(0.003)).collect();
    tree.bark.tube(&path, &radii, [0, 14, 7, 4][level], 1.2);
    if level >= 2 {
        tree.twigs.extend(path.windows(2).skip(1).map(|p| [p[0], p[1]]));
    } else {
        tree.twigs.extend(path.windows(2).skip(2 * steps / 3).map(|p| [p[0], p[1]]));
    }
    if level == 3 {
        return;
    }
    for child in 0..CHILDREN[level] {
        let t = 0.28 + 0.72 * (child as f64 + rng.unit()) / CHILDREN[level] as f64;
        let x = (t * steps as f64).min(steps as f64 - 0.01);
        let k = x as usize;
        let at = add(path[k], scale(sub(path[k + 1], path[k]), x - k as f64));
        let along = normalize(sub(path[k + 1], path[k]));
        let aside = normalize(cross(along, rng.direction()));
        // Branches of a cherry lie in tiers: flatten the spread.
        let aside = normalize([aside[0], 0.45 * aside[1] + 0.12, aside[2]]);
        let away = normalize(add(scale(along, 0.75), aside));
        let long = length * rng.range(0.36, 0.56) * (1.15 - 0.45 * t);
        let thick = radius * (1.0 - 0.75 * t) * 0.62;
        grow(tree, rng, [at, away], [long, thick.max(0.006)], level + 1);
    }
}

impl Tree {
    /// `count` cards with blossom, each `size` half as wide, give or take a third. Layers with
    /// different `layer` share the twigs and no card.
    pub(super) fn blossom(&self, count: usize, size: f64, layer: u64) -> Mesh {
        let mut mesh = Mesh::default();
        let mut rng = Rng::new(900 + layer);
        let centre = scale(
            self.twigs.iter().fold([0.0; 3], |sum, p| add(sum, p[0])),
            1.0 / self.twigs.len() as f64,
        );
        while mesh.triangles() < 2 * count {
            // Blossom comes in bunches with bare wood between them.
            let [a, b] = self.twigs[rng.below(self.twigs.len())];
            let at = add(a, scale(sub(b, a), rng.unit()));
            let bunch = 4 + rng.below(5);
            for _ in 0..bunch.min(count - mesh.triangles() / 2) {
                let p = add(at, scale(rng.direction(), 0.085 * rng.unit() + 0.03));
                let out = normalize(sub(p, centre));
                let up = normalize(add(rng.direction(), add(scale(out, 0.7), [0.0, 0.25, 0.0])));
                card(&mut mesh, p, up, size * rng.range(0.67, 1.33), &mut rng);
            }
        }
        mesh
    }
}

/// A square of two triangles with its texture on it, facing `up`, folded a little.
pub(super) fn card(mesh: &mut Mesh, at: V3, up: V3, size: f64, rng: &mut Rng) {
    let side = normalize(cross(up, rng.direction()));
    let other = cross(up, side);
    let fold = scale(up, 0.18 * size);
    let p = |i: f64, j: f64| add(at, add(scale(side, i * size), scale(other, j * size)));
    let corners = [add(p(-1.0, 1.0), fold), p(1.0, 1.0), add(p(1.0, -1.0), fold), p(-1.0, -1.0)];
    let uv = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
    let ids = [0, 1, 2, 3].map(|k| mesh.vertex(corners[k], up, uv[k]));
    mesh.0.indices.extend([0, 3, 1, 1, 3, 2].map(|k: usize| ids[k]));
}

/// A cedar of the forest: a straight trunk and drooping sprays on cards, 9 m to 15 m high.
pub(super) fn cedar(seed: u64, sprays: usize) -> (Mesh, Mesh) {
    let mut rng = Rng::new(seed);
    let height = rng.range(10.0, 15.0);
    let mut trunk = Mesh::default();
    let path: Vec<V3> = (0..=8)
        .map(|k| [0.05 * rng.bell(), height * f64::from(k) / 8.0 - 0.4, 0.05 * rng.bell()])
        .collect();
    let radius: Vec<f64> = (0..=8).map(|k| 0.26 * (1.02 - f64::from(k) / 8.0)).collect();
    trunk.tube(&path, &radius, 12, 0.6);
    let mut crown = Mesh::default();
    for _ in 0..sprays {
        let t = libm::pow(rng.unit(), 0.62);
        let y = height * (1.0 - 0.82 * t);
        let a = rng.range(0.0, std::f64::consts::TAU);
        let reach = (0.06 + 2.5 * t) * (0.8 + 0.25 * libm::sin(5.0 * a + 7.0 * y));
        let r = reach * libm::sqrt(rng.range(0.15, 1.0));
        let out = [libm::cos(a), 0.0, libm::sin(a)];
        let at = [r * out[0], y - 0.22 * r, r * out[2]];
        let up = normalize(add([0.6 * out[0], 0.7, 0.6 * out[2]], scale(rng.direction(), 0.6)));
        card(&mut crown, at, up, (0.14 + 0.4 * t) * rng.range(0.8, 1.3), &mut rng);
    }
    (trunk, crown)
}

/// A clipped shrub of radius about 1: leaves on cards around a flattened ball.
pub(super) fn shrub(seed: u64, leaves: usize) -> Mesh {
    let mut rng = Rng::new(seed);
    let mut mesh = Mesh::default();
    for _ in 0..leaves {
        let d = rng.direction();
        let d = [d[0], libm::fabs(d[1]), d[2]];
        let bump = 1.0 + 0.12 * super::noise::noise(scale(d, 3.0), seed);
        let r = bump * rng.range(0.86, 1.02);
        let at = [r * d[0], 0.72 * r * d[1], r * d[2]];
        let up = normalize(add(d, scale(rng.direction(), 0.75)));
        card(&mut mesh, at, up, rng.range(0.045, 0.085), &mut rng);
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    const HABIT: Habit = Habit {
        seed: 4,
        trunk: [2.0, 0.25],
        lean: [0.2, 0.0, 0.0],
        limbs: [5.0, 3.0],
        toward: [0.0; 3],
    };

    #[test]
    fn a_tree_spreads_and_bears_as_many_cards_as_asked() {
        let tree = tree(&HABIT);
        assert_eq!(tree.blossom(500, 0.05, 1).triangles(), 1000);
        assert!(tree.twigs.len() > 500 && tree.bark.triangles() > 5_000);
        assert_ne!(tree.blossom(9, 0.05, 1).0.positions, tree.blossom(9, 0.05, 2).0.positions);
    }

    #[test]
    fn a_card_faces_the_way_it_says() {
        let mut mesh = Mesh::default();
        card(&mut mesh, [0.0; 3], [0.0, 1.0, 0.0], 1.0, &mut Rng::new(1));
        let p = |k: usize| mesh.0.positions[mesh.0.indices[k] as usize].map(f64::from);
        for t in [0, 3] {
            assert!(cross(sub(p(t + 1), p(t)), sub(p(t + 2), p(t)))[1] > 0.0);
        }
    }
}
