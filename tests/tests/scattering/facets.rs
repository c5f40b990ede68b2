//! Rough white metal beside light that walks from facet to facet.
//!
//! Heitz, Hanika, d'Eon & Dachsbacher 2016, "Multiple-Scattering Microfacet BSDFs with the Smith Model": the surface is a
//! random height field whose facets have the normals of GGX and no other relation; light is reflected by facets until it
//! comes out. What a model sends where is compared with that in cells of the hemisphere.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use tests::console;
use tests::kernel::Lobe;
use tests::statistics::stream::Stream;

use crate::albedo;

/// Cells along the cosine, and along the angle to the plane of incidence, 0 ..= pi.
const CELLS: usize = 6;
/// Walks for each direction of incidence.
const WALKS: usize = 400_000;

/// Facets of GGX with this alpha.
struct Facets {
    alpha: f64,
}

impl Facets {
    /// Smith's Lambda of a direction.
    fn lambda(&self, w: DVec3) -> f64 {
        let slope = self.alpha * w.truncate().length() / w.z.abs();
        let root = (1.0 + slope * slope).sqrt();
        0.5 * (w.z.signum() * root - 1.0)
    }

    /// A facet that is seen from `w`: Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
    fn seen(&self, w: DVec3, numbers: &mut Stream) -> DVec3 {
        let stretch = DVec3::new(self.alpha, self.alpha, 1.0);
        let v = (stretch * w).normalize();
        let phi = TAU * numbers.unit();
        let z = (1.0 - numbers.unit()) * (1.0 + v.z) - v.z;
        let r = (1.0 - z * z).max(0.0).sqrt();
        let h = DVec3::new(r * phi.cos(), r * phi.sin(), z) + v;
        (stretch * h.with_z(h.z.max(0.0))).normalize()
    }

    /// The direction in which light from `wo` comes out, and how often it was reflected. Heights are uniform in 0 ..= 1.
    fn walk(&self, wo: DVec3, numbers: &mut Stream) -> (DVec3, u32) {
        let (mut w, mut height, mut times) = (-wo, 1.0_f64, 0);
        loop {
            let u = numbers.unit();
            // The share that comes out from here: the height to the power of Lambda.
            let lambda = self.lambda(w);
            if w.z > 0.0 && u < height.powf(lambda) {
                return (w, times);
            }
            let meets = if w.z > 0.0 { u } else { 1.0 - u };
            height = (height / meets.powf(1.0 / lambda)).clamp(1e-12, 1.0);
            let facet = self.seen(-w, numbers);
            w -= 2.0 * w.dot(facet) * facet;
            times += 1;
        }
    }
}

/// Shares of light in each cell.
type Shares = [[f64; CELLS]; CELLS];

fn cell(w: DVec3) -> [usize; 2] {
    let along = w.truncate().angle_to(DVec2::X).abs() / PI;
    #[expect(clippy::cast_possible_truncation, reason = "a share of the cells")]
    [w.z, along].map(|x| ((x * CELLS as f64) as usize).min(CELLS - 1))
}

/// What walks do with light from `wo`: all of it, and what is reflected once.
fn walked(facets: &Facets, wo: DVec3) -> [Shares; 2] {
    let mut numbers = Stream::new(5, 0);
    let mut found = [[[0.0; CELLS]; CELLS]; 2];
    for _ in 0..WALKS {
        let (w, times) = facets.walk(wo, &mut numbers);
        let [i, k] = cell(w);
        found[0][i][k] += 1.0 / WALKS as f64;
        found[1][i][k] += f64::from(u32::from(times == 1)) / WALKS as f64;
    }
    found
}

/// What the kernel does, by quadrature.
fn modelled(lobe: &Lobe, wo: DVec3) -> Shares {
    const FINE: usize = 12;
    let bench = lobe.bench();
    let mut kernel = bench.double();
    let s = lobe.double();
    let mut found = [[0.0; CELLS]; CELLS];
    let n = CELLS * FINE;
    let middle = |i: usize| (i as f64 + 0.5) / n as f64;
    for (i, k) in (0..n).flat_map(|i| (0..n).map(move |k| (i, k))) {
        let (z, phi) = (middle(i), PI * middle(k));
        let r = (1.0 - z * z).sqrt();
        let wi = DVec3::new(r * phi.cos(), r * phi.sin(), z);
        // Both halves of the hemisphere are alike.
        found[i / FINE][k / FINE] += kernel.dispatch_eval(s, wo, wi).f.x * TAU / (n * n) as f64;
    }
    found
}

/// Root of the mean square of the relative differences, weighted by the truth.
fn off(found: &Shares, truth: &Shares) -> f64 {
    let cells = || found.as_flattened().iter().zip(truth.as_flattened());
    let squares: f64 = cells().map(|(a, b)| (a - b) * (a - b) / b.max(1e-9)).sum();
    (squares / cells().map(|(_, b)| b).sum::<f64>()).sqrt()
}

/// The second lobe is nearer to the walk than the first one made as bright as both, which some renderers have instead.
#[test]
fn rough_metal_sends_light_where_walks_between_facets_do() {
    for (roughness, cosine) in
        [(1.0, 1.0), (1.0, 0.8), (1.0, 0.5), (1.0, 0.2), (0.8, 0.8), (0.8, 0.3)]
    {
        let lobe = Lobe { normal: DVec3::Z, ..Lobe::conductor(roughness, 0.0) };
        let plain = Lobe { compensation: 0.0, ..lobe };
        let wo = DVec3::new((1.0_f64 - cosine * cosine).sqrt(), 0.0, cosine);
        let facets = Facets { alpha: f64::from(roughness * roughness) };
        let [truth, once] = walked(&facets, wo);
        let (ours, first) = (modelled(&lobe, wo), modelled(&plain, wo));
        let share = albedo(&mut plain.bench().double(), &plain, wo, 16);
        let scaled = first.map(|row| row.map(|x| x / share));
        let [ours, scaled, first] =
            [(&ours, &truth), (&scaled, &truth), (&first, &once)].map(|(a, b)| off(a, b));
        console::line(&format!(
            "roughness {roughness:.1} cosine {cosine:.1}: two lobes {:.1} %, one scaled {:.1} %, once reflected {:.1} %",
            100.0 * ours,
            100.0 * scaled,
            100.0 * first
        ));
        assert!(first < 0.02, "what is reflected once is known exactly: {first}");
        assert!(ours < 0.1 && ours < scaled, "{ours} and {scaled}");
    }
}
