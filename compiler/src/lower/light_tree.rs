//! Many lights become a tree by which the kernel chooses one for a point.
//!
//! A node knows a ball around its lights, a cone of the directions that they face, and their power. Lights are
//! split where the sum of power times surface times solid angle is least (Conty Estevez & Kulla 2018, "Importance
//! Sampling of Many Lights with Adaptive Tree Splitting", HPG), over 12 bins along each axis. Sky and lights
//! at infinity are not in the tree. Each light remembers the turns from the root to itself, so that the probability of a light that a
//! path has found by chance can be worked out.

use std::f64::consts::PI;

use glam::DVec3;
use pack::abi::{self, LIGHT_LEAF, LightKind, MAX_LIGHT_DEPTH};

/// Lights from which a tree is used.
pub(super) const FROM: usize = 2;
/// Most lights of a tree: 48 MiB of nodes, which share a binding with other small tables.
pub(super) const UP_TO: usize = 1 << 19;

const BINS: usize = 12;

/// Box, cone of normals and power of some lights.
#[derive(Clone, Copy, Debug)]
struct Bound {
    lo: DVec3,
    hi: DVec3,
    axis: DVec3,
    /// Largest angle between `axis` and a normal, 0 ..= pi.
    spread: f64,
    power: f64,
}

impl Bound {
    fn of(light: &abi::Light, both_sides: bool) -> Self {
        let v = |x: [f32; 3]| DVec3::from(x.map(f64::from));
        let origin = v(light.origin);
        let power = f64::from(light.pmf);
        if light.kind == LightKind::Sphere as u32 {
            let r = DVec3::splat(f64::from(light.edge1[0]));
            return Self { lo: origin - r, hi: origin + r, axis: DVec3::Y, spread: PI, power };
        }
        let (e1, e2) = (v(light.edge1), v(light.edge2));
        let mut corners = vec![origin, origin + e1, origin + e2];
        if light.kind == LightKind::Rectangle as u32 {
            corners.push(origin + e1 + e2);
        }
        let lo = corners.iter().copied().reduce(DVec3::min).unwrap_or(origin);
        let hi = corners.iter().copied().reduce(DVec3::max).unwrap_or(origin);
        let axis = e1.cross(e2).try_normalize().unwrap_or(DVec3::Y);
        Self { lo, hi, axis, spread: if both_sides { PI } else { 0.0 }, power }
    }

    /// Wherever the lights come that are displaced by `least` to `most`, axis by axis.
    fn swept(self, [least, most]: [DVec3; 2]) -> Self {
        Self { lo: self.lo + least, hi: self.hi + most, ..self }
    }

    fn union(self, other: Self) -> Self {
        let (axis, spread) = cone(&self, &other);
        Self {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
            axis,
            spread,
            power: self.power + other.power,
        }
    }

    fn middle(&self) -> DVec3 {
        0.5 * (self.lo + self.hi)
    }

    /// Power times surface times the solid angle that the lights shine into, for the choice of a split.
    fn cost(&self) -> f64 {
        let d = self.hi - self.lo;
        let surface = 2.0 * (d.x * d.y + d.y * d.z + d.z * d.x);
        let wide = (self.spread + PI / 2.0).min(PI);
        let (sin, cos) = (libm::sin(self.spread), libm::cos(self.spread));
        // The cone of normals, and the falling rim of cosines around it.
        let rim =
            2.0 * wide * sin - libm::cos(self.spread - 2.0 * wide) - 2.0 * self.spread * sin + cos;
        let angle = 2.0 * PI * (1.0 - cos) + PI / 2.0 * rim;
        self.power * surface * angle
    }
}

/// The smallest cone around both cones of normals.
fn cone(a: &Bound, b: &Bound) -> (DVec3, f64) {
    let (a, b) = if a.spread >= b.spread { (a, b) } else { (b, a) };
    let between = libm::acos(a.axis.dot(b.axis).clamp(-1.0, 1.0));
    if (between + b.spread).min(PI) <= a.spread {
        return (a.axis, a.spread);
    }
    let spread = 0.5 * (a.spread + between + b.spread);
    let turn = a.axis.cross(b.axis);
    if spread >= PI || turn.length_squared() == 0.0 {
        return (a.axis, PI);
    }
    let side = turn.normalize().cross(a.axis);
    let by = spread - a.spread;
    ((a.axis * libm::cos(by) + side * libm::sin(by)).normalize(), spread)
}

/// The nodes, parents before children and the first child behind its parent; and the trail of each light.
/// `motion` is by how much at least and at most a light is displaced while the shutter is open, `factor` what the power
/// of a light is multiplied with.
pub(super) fn tree(
    lights: &[abi::Light],
    both_sides: impl Fn(u32) -> bool,
    motion: impl Fn(&abi::Light) -> [DVec3; 2],
    factor: impl Fn(usize) -> f64,
) -> (Vec<abi::LightNode>, Vec<u32>) {
    let mut entries: Vec<(u32, Bound)> = (0..)
        .zip(lights)
        .filter(|(_, light)| light.has_surface())
        .map(|(index, light)| {
            let bound = Bound::of(light, both_sides(light.material)).swept(motion(light));
            (index, Bound { power: bound.power * factor(index as usize), ..bound })
        })
        .collect();
    let mut builder = Builder { nodes: Vec::new(), trails: vec![0; lights.len()] };
    if !entries.is_empty() {
        builder.node(&mut entries, 0, 0);
    }
    (builder.nodes, builder.trails)
}

struct Builder {
    nodes: Vec<abi::LightNode>,
    trails: Vec<u32>,
}

impl Builder {
    /// Appends the tree over `entries`; `trail` leads here in `depth` turns.
    fn node(&mut self, entries: &mut [(u32, Bound)], trail: u32, depth: u32) {
        let bound = entries.iter().map(|entry| entry.1).reduce(Bound::union);
        let bound = bound.expect("nodes are made of lights");
        let at = self.nodes.len();
        self.nodes.push(record(&bound));
        if let [(light, _)] = entries {
            self.nodes[at].child = LIGHT_LEAF | *light;
            self.trails[*light as usize] = trail;
            return;
        }
        let middle = split(entries, &bound, depth);
        let (left, right) = entries.split_at_mut(middle);
        self.node(left, trail, depth + 1);
        self.nodes[at].child = self.nodes.len() as u32;
        self.node(right, trail | 1 << depth, depth + 1);
    }
}

fn record(bound: &Bound) -> abi::LightNode {
    let radius = 0.5 * (bound.hi - bound.lo).length();
    // Rounded up, so that the ball holds its lights.
    let radius2 = (radius * radius * (1.0 + 1e-6)) as f32;
    abi::LightNode {
        center: bound.middle().to_array().map(|x| x as f32),
        radius2: radius2.max(f32::MIN_POSITIVE),
        axis: bound.axis.to_array().map(|x| x as f32),
        power: bound.power as f32,
        cos_spread: libm::cos(bound.spread) as f32,
        sin_spread: libm::sin(bound.spread).max(0.0) as f32,
        child: 0,
        _pad0: 0,
    }
}

/// Puts the entries of the first child first; returns how many they are, at least one and not all.
fn split(entries: &mut [(u32, Bound)], bound: &Bound, depth: u32) -> usize {
    let points = entries.iter().map(|entry| entry.1.middle());
    let (lo, hi) =
        points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
    let extent = hi - lo;
    // Where turns run short, halves are sure to fit.
    let deep = depth + usize::BITS - entries.len().leading_zeros() >= MAX_LIGHT_DEPTH;
    let best = if deep { None } else { best_plane(entries, bound, lo, extent) };
    if let Some((axis, bin)) = best {
        entries.sort_by_key(|(_, b)| bin_of(b, axis, lo, extent) > bin);
        return entries.partition_point(|(_, b)| bin_of(b, axis, lo, extent) <= bin);
    }
    let axis = extent.to_array();
    let axis = (0..3).fold(0, |best, k| if axis[k] > axis[best] { k } else { best });
    let key = |entry: &(u32, Bound)| entry.1.middle()[axis];
    entries.sort_by(|a, b| key(a).total_cmp(&key(b)).then(a.0.cmp(&b.0)));
    entries.len() / 2
}

fn bin_of(bound: &Bound, axis: usize, lo: DVec3, extent: DVec3) -> usize {
    let share = (bound.middle()[axis] - lo[axis]) / extent[axis];
    ((share * BINS as f64) as usize).min(BINS - 1)
}

/// Axis and last bin of the first child, where that is the cheapest split.
fn best_plane(
    entries: &[(u32, Bound)],
    bound: &Bound,
    lo: DVec3,
    extent: DVec3,
) -> Option<(usize, usize)> {
    let longest = (bound.hi - bound.lo).max_element();
    let mut best: Option<(f64, usize, usize)> = None;
    for axis in (0..3).filter(|axis| extent[*axis] > 0.0) {
        let mut bins: [Option<Bound>; BINS] = [None; BINS];
        for (_, b) in entries {
            let bin = &mut bins[bin_of(b, axis, lo, extent)];
            *bin = Some(bin.map_or(*b, |sum| sum.union(*b)));
        }
        // Thin nodes split across their long side.
        let thin = longest / (bound.hi[axis] - bound.lo[axis]).max(1e-9 * longest);
        let join = |a: Option<Bound>, b: Option<Bound>| match (a, b) {
            (Some(a), Some(b)) => Some(a.union(b)),
            (a, b) => a.or(b),
        };
        for last in 0..BINS - 1 {
            let left = bins[..=last].iter().copied().fold(None, join);
            let right = bins[last + 1..].iter().copied().fold(None, join);
            let (Some(left), Some(right)) = (left, right) else { continue };
            let cost = thin * (left.cost() + right.cost());
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, last));
            }
        }
    }
    best.map(|(_, axis, last)| (axis, last))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bits<const N: usize>(values: [f64; N]) -> [u64; N] {
        values.map(f64::to_bits)
    }

    /// A grid of small triangles that face up.
    fn lights(n: usize) -> Vec<abi::Light> {
        let light = |i: usize| abi::Light {
            kind: LightKind::Triangle as u32,
            origin: [(i % 37) as f32, 0.25, (i / 37) as f32],
            edge1: [0.0, 0.0, 0.5],
            edge2: [0.5, 0.0, 0.0],
            pmf: 1.0 / n as f32,
            ..Default::default()
        };
        (0..n).map(light).collect()
    }

    #[test]
    fn every_light_is_at_the_end_of_its_trail() {
        for n in [1, 2, 17, 1000] {
            let (nodes, trails) = tree(&lights(n), |_| false, |_| [DVec3::ZERO; 2], |_| 1.0);
            assert_eq!(nodes.len(), 2 * n - 1);
            for (light, mut trail) in trails.into_iter().enumerate() {
                let mut at = 0;
                while nodes[at].child & LIGHT_LEAF == 0 {
                    at = if trail & 1 == 0 { at + 1 } else { nodes[at].child as usize };
                    trail >>= 1;
                }
                assert_eq!((nodes[at].child, trail), (LIGHT_LEAF | light as u32, 0));
            }
        }
    }

    #[test]
    fn nodes_sum_power_and_keep_narrow_cones_narrow() {
        let (nodes, _) = tree(&lights(100), |_| false, |_| [DVec3::ZERO; 2], |_| 1.0);
        assert!((nodes[0].power - 1.0).abs() < 1e-6);
        let [x, y, z] = nodes[0].axis.map(f64::from);
        assert_eq!(bits([f64::from(nodes[0].cos_spread), x, y, z]), bits([1.0, 0.0, 1.0, 0.0]));
        let (nodes, _) = tree(&lights(100), |_| true, |_| [DVec3::ZERO; 2], |_| 1.0);
        assert_eq!(nodes[0].cos_spread.to_bits(), (-1.0_f32).to_bits());
    }

    #[test]
    fn balls_hold_lights_wherever_they_come() {
        let motion = DVec3::new(0.0, 8.0, 0.0);
        let (nodes, _) = tree(&lights(3), |_| false, |_| [DVec3::ZERO, motion], |_| 1.0);
        let [x, y, z] = nodes[0].center.map(f64::from);
        let far = DVec3::new(0.0, 8.25, 0.0) - DVec3::new(x, y, z);
        assert!(far.length_squared() <= f64::from(nodes[0].radius2));
    }

    #[test]
    fn cones_hold_both_cones() {
        let of = |axis: DVec3, spread| Bound {
            lo: DVec3::ZERO,
            hi: DVec3::ONE,
            axis,
            spread,
            power: 1.0,
        };
        let (axis, spread) = cone(&of(DVec3::X, 0.1), &of(DVec3::Y, 0.2));
        assert!((spread - f64::midpoint(0.5 * PI, 0.3)).abs() < 1e-12);
        let within = |of: DVec3, own: f64| libm::acos(axis.dot(of)) + own <= spread + 1e-9;
        assert!(within(DVec3::X, 0.1) && within(DVec3::Y, 0.2));
        let all = [
            cone(&of(DVec3::X, 1.0), &of(DVec3::Y, PI)).1,
            cone(&of(DVec3::X, 0.0), &of(DVec3::NEG_X, 0.0)).1,
        ];
        assert_eq!(bits(all), bits([PI, PI]));
        let (axis, spread) = cone(&of(DVec3::X, 0.0), &of(DVec3::X, 0.0));
        assert_eq!((axis, spread.to_bits()), (DVec3::X, 0));
    }

    #[test]
    fn lights_in_one_place_make_a_tree_that_trails_can_describe() {
        let mut lights = lights(5000);
        for light in &mut lights {
            light.origin = [0.0; 3];
        }
        let (nodes, trails) = tree(&lights, |_| false, |_| [DVec3::ZERO; 2], |_| 1.0);
        assert_eq!(nodes.len(), 9999);
        assert!(trails.iter().all(|trail| *trail < 1 << 13));
    }
}
