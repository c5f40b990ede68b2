//! Pictures of scenes with meshes that are stored once, and of the same scenes with triangles in the world.

use compiler::bvh::Layout;
use compiler::lower::Instancing;
use compiler::pipeline::Compiled;
use pack::{Checked, Pack};
use tests::features::{CASES, Case, shared};
use tests::{console, picture, scene};

fn pack_of(compiled: &Compiled) -> Pack<Checked> {
    Pack::from_bytes(scene::bytes(compiled)).expect("what was written can be read")
}

fn both(case: &Case) -> [Compiled; 2] {
    [Instancing::Auto, Instancing::Never].map(|how| shared(case, how, Layout::default()))
}

fn with_instances() -> impl Iterator<Item = &'static Case> {
    CASES.iter().filter(|case| case.name.contains("instances") && !case.name.contains("mirrored"))
}

/// The same paths in both, but for those that rounding sends another way: the means of most pixels agree to
/// rounding, and those of all pixels as estimates of the same picture do.
#[test]
fn instances_look_like_triangles_in_the_world() {
    for case in with_instances() {
        let [one, flat] = both(case);
        let (n, places) = (&one.lowered.counters, flat.lowered.counters.triangles);
        assert!(n.instances >= 4 && n.shown == places && n.triangles < places, "{}: {n:?}", case.name);
        assert!(flat.lowered.instances.is_empty());
        let [a, b] = [&one, &flat].map(|scene| {
            let outcome = picture::cpu(pack_of(scene), |job| {
                job.samples = runtime::SampleRange { start: 0, end: 64 };
            });
            assert_eq!(outcome.film().counters.bad, 0, "{}", case.name);
            picture::channel(outcome.film(), 1)
        });
        let close = |(a, b): &(&f64, &f64)| (*a - *b).abs() <= 1e-3 * (a.abs() + b.abs());
        let same = a.iter().zip(&b).filter(close).count() as f64 / a.len() as f64;
        let mean = |p: &[f64]| p.iter().sum::<f64>() / p.len() as f64;
        let off = mean(&a) / mean(&b) - 1.0;
        console::line(&format!("{:<48} {:5.1} % of pixels the same, mean off by {off:+.5}", case.name, same * 100.0));
        assert!(same > 0.5 && off.abs() < 5e-3, "{}", case.name);
    }
}
