//! Layers of principled surfaces: coat, specular colour, thin transmission.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};
use pack::abi::Material;
use runtime::kernel::{f32 as single, f64 as double};
use tests::albedo::facets;
use tests::kernel::{Bench, Lobe};
use tests::layers::Layers;
use tests::statistics::Mean;
use tests::statistics::grid::{Grid, Shape};
use tests::statistics::stream::Stream;

/// Cosines of the incident direction, down to grazing.
const MU: [f64; 6] = [1.0, 0.8, 0.5, 0.2, 0.05, 0.01];
/// Rounding of the kernel's constants, and quadrature.
const SLACK: f64 = 1e-4;
/// The light that a white surface gives back, with the errors of the tables of directional albedo.
const MOST: f64 = 1.015;

/// A white surface and its layers.
#[derive(Clone, Copy, Debug)]
struct Case {
    lobe: Lobe,
    layers: Layers,
}

impl Case {
    fn new(roughness: f32, metallic: f32, layers: Layers) -> Self {
        Self { lobe: Lobe::principled(roughness, metallic), layers }
    }

    fn bench(&self) -> Bench {
        Bench::new().materials(&[Material::from(self.layers)])
    }

    /// The surface in double precision, as the kernel brushes it.
    fn double(&self) -> double::Scatter {
        let bench = self.bench();
        let (mut kernel, s) = (bench.double(), self.lobe.double());
        let at = kernel.surface_new(DVec3::ZERO, self.lobe.normal, -self.lobe.normal, 1.0);
        let handed = if self.lobe.front { 1.0 } else { -1.0 };
        let at = double::Surface { tangent: s.tangent, handed, ..at };
        let brushing = kernel.dispatch_brushing(at, s.kind);
        double::Scatter { tangent: brushing.truncate(), anisotropy: brushing.w, ..s }
    }

    /// The same in single precision.
    #[expect(clippy::cast_possible_truncation, reason = "rounded to the kernel's precision")]
    fn single(&self) -> single::Scatter {
        let s = self.double();
        let (tangent, anisotropy) = (s.tangent.as_vec3(), s.anisotropy as f32);
        single::Scatter { tangent, anisotropy, ..self.lobe.single() }
    }

    /// Seen from the other side.
    fn behind(&self) -> Self {
        let lobe = Lobe { normal: -self.lobe.normal, front: !self.lobe.front, ..self.lobe };
        Self { lobe, ..*self }
    }

    /// `d` mirrored at the surface.
    fn across(&self, d: DVec3) -> DVec3 {
        (d - self.lobe.normal * (2.0 * d.dot(self.lobe.normal))).normalize()
    }

    /// Width of the narrowest lobe that is not a mirror.
    fn narrowest(&self) -> f64 {
        let coat = if self.layers.coat > 0.0 { self.layers.coat_roughness } else { 1.0 };
        let alphas = [self.lobe.roughness, coat].map(|r| f64::from(r * r));
        let least = alphas.into_iter().filter(|alpha| *alpha >= double::GLOSS_SMOOTH);
        // At 1 the lobe is narrower by the root of ten.
        least.fold(1.0, f64::min) * (1.0 - 0.69 * f64::from(self.layers.anisotropy))
    }

    /// Cells that resolve the lobes on the side of `wo`.
    fn grid(&self, wo: DVec3) -> Grid {
        let (mu, alpha) = (self.lobe.normal.dot(wo), self.narrowest());
        if alpha > 0.3 {
            return Grid::new(self.lobe.normal, wo, Shape::HEMISPHERE);
        }
        let ring_scale = (alpha * mu.max(0.05)).min(1.0);
        let shape = Shape { ring_scale, sector_scale: mu.clamp(0.02, 1.0), ..Shape::SPHERE };
        Grid::new(self.lobe.mirror(wo), self.lobe.normal, shape)
    }

    /// Light from `wo` that is reflected, and that goes through; by quadrature, deltas in closed form.
    fn shares(&self, wo: DVec3, fine: usize) -> [f64; 2] {
        let bench = self.bench();
        let mut kernel = bench.double();
        let (s, up, mu) = (self.double(), self.lobe.normal, self.lobe.normal.dot(wo));
        let cells = self.grid(wo);
        let mut rough = |far: bool| -> f64 {
            let to = |d| if far { self.across(d) } else { d };
            let f = |d| kernel.dispatch_eval(s, wo, to(d)).f.x;
            cells.integrate_above(fine, up, f).iter().sum()
        };
        let (mut near, mut far) = (rough(false), rough(true));
        let mut kernel = bench.double();
        let coat = kernel.layers_coat(s);
        if coat.y * coat.y < double::GLOSS_SMOOTH {
            near += kernel.coat_fresnel(coat.x, mu);
        }
        let p = kernel.principled_at(s, wo);
        if p.gloss.alpha < double::GLOSS_SMOOTH {
            near += kernel.principled_fresnel(p, mu).x * p.o.through;
            far += kernel.thin_clear(p, mu).x * p.o.through;
        }
        [near, far]
    }

    /// [`Case::shares`], with finer cells until they agree where there is a doubt about the sum being below [`MOST`].
    fn converged(&self, wo: DVec3) -> [f64; 2] {
        let mut fine = 2;
        let mut shares = self.shares(wo, fine);
        while shares[0] + shares[1] > MOST && fine < 128 {
            fine *= 2;
            let finer = self.shares(wo, fine);
            let change = finer[0] + finer[1] - shares[0] - shares[1];
            shares = finer;
            if change.abs() < 0.25 * SLACK {
                break;
            }
        }
        shares
    }
}

/// Corners of the parameters and between.
fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for layers in layers() {
        for roughness in [0.0, 0.1, 0.3, 0.6, 1.0] {
            for metallic in [0.0, 0.4, 1.0] {
                cases.push(Case::new(roughness, metallic, layers));
            }
        }
    }
    cases.extend(brushed());
    cases.extend(sheens());
    cases
}

/// Surfaces under sheen.
fn sheens() -> Vec<Case> {
    let mut cases = Vec::new();
    for (sheen, sheen_roughness) in [(1.0, 0.0), (1.0, 0.15), (1.0, 0.3), (0.5, 0.6), (1.0, 1.0)] {
        for roughness in [0.0, 0.3, 1.0] {
            for (metallic, transmission) in [(0.0, 0.0), (1.0, 0.0), (0.4, 0.5)] {
                let layers = Layers { sheen, sheen_roughness, transmission, ..Layers::PLAIN };
                cases.push(Case::new(roughness, metallic, layers));
            }
        }
    }
    cases
}

/// Surfaces that are brushed, seen along that, across it and between.
fn brushed() -> Vec<Case> {
    let mut cases = Vec::new();
    for (anisotropy, anisotropy_turn) in
        [(0.3, 0.0), (0.7, 0.25), (1.0, 0.0), (1.0, 0.1), (1.0, 0.75)]
    {
        for roughness in [0.25, 0.5, 1.0] {
            for (metallic, coat, transmission) in [
                (0.0, 0.0, 0.0),
                (1.0, 0.0, 0.0),
                (0.4, 0.0, 0.5),
                (0.0, 1.0, 0.0),
                (1.0, 1.0, 0.0),
            ] {
                let layers = Layers {
                    anisotropy,
                    anisotropy_turn,
                    coat,
                    coat_roughness: 0.3,
                    transmission,
                    ..Layers::PLAIN
                };
                cases.push(Case::new(roughness, metallic, layers));
            }
        }
    }
    cases
}

fn layers() -> Vec<Layers> {
    let mut layers = Vec::new();
    for (coat, coat_roughness) in
        [(0.0, 0.0), (1.0, 0.0), (0.5, 0.2), (1.0, 0.4), (1.0, 0.7), (1.0, 1.0)]
    {
        for transmission in [0.0, 0.5, 1.0] {
            layers.push(Layers { coat, coat_roughness, transmission, ..Layers::PLAIN });
        }
        for (specular, tint) in [(0.0, 1.0), (0.5, 1.0), (1.0, 0.0), (1.0, 30.0), (0.7, 8.0)] {
            layers.push(Layers { coat, coat_roughness, specular, tint, ..Layers::PLAIN });
        }
    }
    layers
}

#[test]
fn layers_never_give_more_light_than_they_get() {
    let mut largest: (f64, String) = (0.0, String::new());
    for mut case in cases() {
        for ior in [1.0, 1.5, 4.0] {
            case.lobe.ior = ior;
            for mu in MU {
                let [near, far] = case.converged(case.lobe.at_cosine(mu));
                let sum = near + far;
                assert!(near >= 0.0 && far >= 0.0 && sum.is_finite(), "{case:?} at {mu}");
                if sum > largest.0 {
                    largest = (sum, format!("{case:?} at {mu}: {near} + {far}"));
                }
            }
        }
    }
    assert!(largest.0 < MOST, "{}", largest.1);
    assert!(largest.0 > 1.0 - SLACK, "something white is in it: {}", largest.1);
}

/// What a white, smooth, clear sheet does not reflect goes through; a metal's part lets nothing in, and reflects all.
#[test]
fn a_clear_pane_keeps_all_light() {
    for ior in [1.0, 1.5, 2.4] {
        for metallic in [0.0, 0.6] {
            let layers = Layers { transmission: 1.0, ..Layers::PLAIN };
            let mut case = Case::new(0.0, metallic, layers);
            case.lobe.ior = ior;
            for mu in MU {
                let [near, far] = case.shares(case.lobe.at_cosine(mu), 1);
                assert!((near + far - 1.0).abs() < 1e-6, "{case:?} at {mu}: {near} + {far}");
            }
        }
    }
}

/// A rough sheet gives to both sides together what its interface would give back if it were a perfect metal.
#[test]
fn a_rough_pane_gives_both_sides_what_metal_gives_one() {
    for roughness in [0.2, 0.5, 1.0] {
        let pane = Case::new(roughness, 0.0, Layers { transmission: 1.0, ..Layers::PLAIN });
        let metal = Case::new(roughness, 1.0, Layers::PLAIN);
        for mu in MU {
            let wo = pane.lobe.at_cosine(mu);
            let ([near, far], [all, _]) = (pane.shares(wo, 4), metal.shares(wo, 4));
            assert!((near + far - all).abs() < SLACK, "{roughness} at {mu}: {near} + {far}, {all}");
        }
    }
}

/// A direction on either side, sometimes grazing; unit in double precision.
fn direction(stream: &mut Stream, normal: DVec3) -> DVec3 {
    let d = stream.direction();
    let squash = if stream.unit() < 0.3 { 0.98 } else { 0.0 };
    (d - normal * (squash * d.dot(normal))).normalize().as_vec3().as_dvec3().normalize()
}

/// f(wo, wi) = f(wi, wo), also through the sheet.
#[test]
fn light_goes_both_ways_through_layers() {
    let mut through = 0;
    for (i, case) in cases().into_iter().enumerate() {
        let bench = case.bench();
        let mut kernel = bench.double();
        let mut stream = Stream::new(47, i as u64);
        let (front, back) = (case.double(), case.behind().double());
        let mut value = |a: DVec3, b: DVec3| {
            let seen = if a.dot(case.lobe.normal) > 0.0 { front } else { back };
            let f = kernel.dispatch_eval(seen, a, b).f.x;
            f / b.dot(case.lobe.normal).abs()
        };
        for _ in 0..300 {
            let normal = case.lobe.normal;
            let (a, b) = (direction(&mut stream, normal), direction(&mut stream, normal));
            let (there, back) = (value(a, b), value(b, a));
            let crosses = a.dot(normal) * b.dot(normal) < 0.0;
            through += usize::from(crosses && there > 0.0);
            assert!((there - back).abs() <= 1e-9 * back, "{case:?} {a} {b}: {there} {back}");
        }
    }
    assert!(through > 1000, "{through} pairs lie on two sides");
}

/// The mean weight of samples is what quadrature finds, on both sides.
#[test]
fn mean_weights_are_the_shares_of_both_sides() {
    for (i, case) in cases().into_iter().enumerate().step_by(7) {
        let bench = case.bench();
        let (mut kernel, scatter) = (bench.single(), case.single());
        for (j, mu) in [0.9, 0.15].into_iter().enumerate() {
            let wo = case.lobe.at_cosine(mu);
            let truth = case.shares(wo, 6);
            let mut means = [Mean::default(); 2];
            for k in 0..60_000 {
                let key = crate::weight::key(30_000 + 2 * i + j, k);
                let out = kernel.dispatch_sample(scatter, wo.as_vec3(), key);
                let far = out.wi.as_dvec3().dot(case.lobe.normal) < 0.0;
                let weight = f64::from(out.weight.x);
                means[0].add(if far { 0.0 } else { weight });
                means[1].add(if far { weight } else { 0.0 });
            }
            for (mean, truth) in means.into_iter().zip(truth) {
                let (value, bound) = (mean.value(), 4.5 * mean.error() + 2e-4);
                assert!((value - truth).abs() < bound, "{case:?} at {mu}: {value}, not {truth}");
            }
        }
    }
}

/// Weight, value and density of a sample belong together, and the density is the one of the other side of the
/// balance heuristic.
#[test]
fn a_weight_is_value_over_density_through_layers() {
    for (i, case) in cases().into_iter().enumerate() {
        let bench = case.bench();
        let (mut kernel, scatter) = (bench.single(), case.single());
        for mu in [1.0, 0.3, 0.01] {
            let wo = case.lobe.at_cosine(mu).as_vec3();
            for k in 0..300 {
                let key = crate::weight::key(40_000 + i, k);
                let out = kernel.dispatch_sample(scatter, wo, key);
                assert!(out.weight.is_finite() && out.weight.min_element() >= 0.0, "{case:?}");
                if out.pdf > 0.0 && out.weight.x > 0.0 {
                    let found = kernel.dispatch_eval(scatter, wo, out.wi);
                    let (f, pdf) = (found.f.x, found.pdf);
                    assert!((pdf / out.pdf - 1.0).abs() < 1e-4, "{case:?} {mu}: {out:?}, {pdf}");
                    let off = (out.weight.x * out.pdf - f).abs();
                    assert!(off <= 1e-4 * f, "{case:?} at {mu}: {out:?}, f {f}");
                }
            }
        }
    }
}

/// A white surface that is brushed or under sheen gives everything back, whatever it is made of.
#[test]
fn a_surface_brushed_or_under_sheen_returns_everything() {
    let mut most = (0.0, String::new());
    for mut case in brushed().into_iter().chain(sheens()) {
        for ior in [1.05, 3.0] {
            case.lobe.ior = ior;
            for mu in [1.0, 0.5, 0.1] {
                let [near, far] = case.shares(case.lobe.at_cosine(mu), 8);
                let off = (near + far - 1.0).abs();
                if off > most.0 {
                    most = (off, format!("{case:?} at {mu}: {near} + {far}"));
                }
            }
        }
    }
    assert!(most.0 < 0.015, "{most:?}");
}

/// Turned by half a turn it is the same, by a quarter another.
#[test]
fn the_direction_of_brushing_is_a_line() {
    let value = |anisotropy_turn: f32| {
        let layers = Layers { anisotropy: 0.9, anisotropy_turn, ..Layers::PLAIN };
        let case = Case::new(0.4, 1.0, layers);
        let bench = case.bench();
        let wo = case.lobe.at_cosine(0.5);
        let wi = (case.lobe.mirror(wo) + case.lobe.tangent() * 0.2).normalize();
        bench.double().dispatch_eval(case.double(), wo, wi).f.x
    };
    let (along, half, across) = (value(0.0), value(0.5), value(0.25));
    assert!((along - half).abs() < 1e-9 * along, "{along} {half}");
    assert!(along > 1.2 * across, "{along} {across}");
}

/// What `under_coat.wgsl` says of what lobes lose under a coat, against quadrature over their normals.
#[test]
fn what_lobes_lose_under_a_coat_is_what_quadrature_gives() {
    let bench = Lobe::principled(1.0, 0.0).bench();
    let mut kernel = bench.double();
    for (roughness, anisotropy) in [(0.1, 0.0), (0.1, 1.0), (0.3, 1.0), (0.45, 0.6), (0.8, 0.0)] {
        let alpha = kernel.ggx_anisotropic_alpha(roughness, anisotropy);
        for coat_roughness in [0.0, 0.07, 0.15, 0.3, 0.5, 1.0] {
            let coat = DVec2::new(1.0, coat_roughness);
            let held: Vec<f64> = (0..=2000)
                .map(|i| 1.0 - kernel.under_coat_through(coat, true, f64::from(i) / 2000.0))
                .collect();
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
            let layer = |c: f64| held[(c.clamp(0.0, 1.0) * 2000.0).round() as usize];
            for c in [0.9, 0.5, 0.25, 0.1, 0.05, 0.02] {
                let factor = kernel.under_coat_steepness(coat, c);
                for turn in [0.0, 0.8, FRAC_PI_2] {
                    let o = facets::direction(c, turn);
                    let exact = facets::flattened_under(layer, o, alpha, [96, 48]);
                    let told = factor * facets::flattened(o, alpha, [96, 48]);
                    let off = (told - exact).abs();
                    assert!(
                        off < 0.0045,
                        "{roughness} {anisotropy} under {coat_roughness} at {c} {turn}: {told} {exact}"
                    );
                }
            }
        }
    }
}
