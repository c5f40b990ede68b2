//! The cheap key numbers of `docs/pitfalls.md` hold, and the page has every topic.
//!
//! Means are within four standard errors of what theory says.

use std::path::{Path, PathBuf};

use tests::pitfalls::mixture;
use tests::pitfalls::random_walk::{self, Medium, Steps};
use tests::pitfalls::sphere_light::{self, Setting, Shadow};
use tests::pitfalls::{
    TOPICS, brightness, bump, field, fog, fresnel, fuzz, offsets, phase, refraction, roulette,
    seeds, slab, traversal, triangle,
};
use tests::statistics::Mean;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn is(mean: &Mean, truth: f64, name: &str) {
    let off = (mean.value() - truth).abs();
    assert!(off < 4.0 * mean.error(), "{name}: {} ± {}", mean.value(), mean.error());
}

#[test]
fn a_whole_sphere_counts_twice_and_a_cone_once() {
    let setting = Setting { ratio: 0.1, cos: 0.8 };
    is(&sphere_light::naive(setting, Shadow::LeavesLightOut, 100_000), 2.0, "left out");
    let hidden = sphere_light::naive(setting, Shadow::SeesLight, 100_000);
    is(&hidden, 1.0, "seen");
    let cone = sphere_light::ours_lambert(setting, 100_000);
    is(&cone, 1.0, "cone");
    assert!(hidden.deviation() > 30.0 * cone.deviation());
}

#[test]
fn weights_must_sum_to_one() {
    let sums = mixture::measure(Setting { ratio: 0.8, cos: 1.0 }, 100_000);
    is(&sums.both, 1.0, "both");
    is(&sums.proxy_weights, 1.0, "proxies in weights");
    is(&sums.neither, 2.0, "neither");
    assert!(sums.light_only.value() > 1.5 && sums.proxy_divisors.value() < 0.3);
}

#[test]
fn the_metal_has_a_density() {
    for a in [0.05, 0.3, 0.999, 1.5] {
        let off = fuzz::integral(a) - 1.0;
        // A ball that holds the surface point covers all directions, which the quadrature does not.
        assert!(a > 1.0 || off.abs() < 1e-5, "fuzz {a}: {off}");
    }
    let [cosine, own] = fuzz::furnace(0.2, 10_000);
    assert!((own.value() - 1.0).abs() < 1e-6 && cosine.value() > 20.0);
}

#[test]
fn a_path_survives_with_twice_its_throughput() {
    let same = |bounce, throughput: f32| {
        let after = roulette::survivors(throughput, bounce, 1000);
        after.iter().all(|after| after.to_bits() == throughput.to_bits())
    };
    assert!(same(2, 0.01) && same(3, 0.51) && same(9, 0.9));
    let n = 4096;
    let after = roulette::survivors(0.1, 3, n);
    let mut mean = Mean::default();
    for after in &after {
        mean.add(f64::from(*after));
    }
    is(&mean, 0.1, "throughput after roulette");
    let living: Vec<f32> = after.into_iter().filter(|after| *after > 0.0).collect();
    assert!(living.iter().all(|after| (after - 0.5).abs() < 1e-6));
    assert!((living.len() as f64 / f64::from(n) - 0.2).abs() < 0.03, "{} of {n}", living.len());
}

#[test]
fn roulette_is_relative_to_the_first_bounce_and_blind_to_refraction() {
    let eta2 = 2.25;
    let into = (0.9 / eta2, eta2);
    let out = (0.9 * eta2, 1.0 / eta2);
    // The chance to survive is twice what is left of the throughput after the first bounce.
    let routes = [
        ([(0.01, 1.0), (0.5, 1.0), (0.5, 1.0), (0.5, 1.0)], 0.25),
        ([into, (0.2, 1.0), out, (0.9, 1.0)], 0.324),
        ([into, (0.2, 1.0), (0.9, 1.0), (0.9, 1.0)], 0.324),
        ([(0.1, 1.0), into, (0.2, 1.0), (0.9, 1.0)], 0.324),
    ];
    for (route, chance) in routes {
        let found = roulette::alive(&route, 4096);
        assert!((found - chance).abs() < 0.03, "{found} for {chance}: {route:?}");
    }
}

#[test]
fn seeds_repeat_24_times() {
    assert_eq!(seeds::distinct_seeds(seeds::PIXELS, seeds::SAMPLES, seeds::STRIDE), 347_992_185);
    // Counted one by one on an image of 5 x 4.
    let mut small: Vec<u64> = (0..7).flat_map(|s| (0..20).map(move |p| p + s * 9)).collect();
    small.sort_unstable();
    small.dedup();
    assert_eq!(seeds::distinct_seeds(20, 7, 9), small.len() as u64);
    assert_eq!(seeds::kernel_repeats(64, 16), 0);
    assert_eq!(seeds::ones(), 128);
    assert!(seeds::largest() < 1.0);
    assert_eq!(seeds::low_bits_cycle(4), 16);
}

#[test]
fn schlick_from_inside_is_off_by_nearly_one() {
    let back = fresnel::compare(-1.0 / 3.0);
    assert!(back.absolute[0] > 0.9 && back.absolute[2] < 2e-2, "{back:?}");
    let none = fresnel::compare(0.0);
    assert!(none.absolute[1] > 0.999 && none.absolute[2] <= 0.0, "{none:?}");
}

#[test]
fn nothing_leaves_past_the_critical_angle() {
    let [naive, ours] = refraction::past_critical(10_000);
    assert_eq!((naive.through, ours.through), (10_000, 0));
    assert!(naive.lengths[1] > 1.8 && (ours.lengths[1] - 1.0).abs() < 1e-6);
}

#[test]
fn shared_edges_are_hit_once() {
    for distance in [1.0, 1e4] {
        let [_, slack, ours] = triangle::edges(distance, 50);
        assert_eq!((ours.cracks, ours.doubles), (0, 0));
        assert!(slack.cracks + slack.doubles > slack.rays / 4, "{slack:?}");
    }
    let [naive, ours] = triangle::small(1e-7, 1000);
    assert_eq!((naive, ours), (1000, 0));
}

#[test]
fn rays_leave_their_surface_and_nothing_else() {
    let [own, _] = offsets::leave(1e5, 1e3, 1e3, 1000);
    assert!(own[0] > 300 && own[1] == 0, "{own:?}");
    let [_, missed] = offsets::leave(1.0, 0.1, 5e-4, 1000);
    assert_eq!(missed, [1000, 0]);
}

#[test]
fn fog_gives_what_it_takes() {
    let [naive, ours] = fog::room(0.5, 1e-3, 40_000);
    is(&ours, 1.0, "a white room in white fog");
    assert!(naive.value() < 0.9, "{naive:?}");
    let [naive, ours] = fog::share_errors(1e-6);
    assert!(naive > 0.01 && ours < 1e-5, "{naive} {ours}");
}

#[test]
fn patterns_stay_in_their_range_and_bumps_are_slopes() {
    let [naive, ours] = [field::stone_naive, field::stone_ours].map(|f| field::sample(f, 20_000));
    assert!(naive.range[1] > 1.5 && ours.range[0] > 0.0 && ours.range[1] < 1.0, "{ours:?}");
    let [naive, ours] = bump::measure(10_000);
    assert!(naive.error > 10.0 * ours.error, "{naive:?} {ours:?}");
}

#[test]
fn a_full_stack_loses_surfaces() {
    let [rays, dropped, _, ours] = traversal::sheets_lost(400, false, 200);
    assert!(dropped > rays / 2 && ours == 0, "{dropped} {ours} of {rays}");
    let [rays, _, capped, ours] = traversal::sheets_lost(1500, true, 100);
    assert_eq!((capped, ours), (rays, 0));
}

#[test]
fn cosines_are_cosines() {
    for g in [-0.95, -0.5, 0.0, 1e-4, 0.7, 0.9999] {
        let [_, ours] = phase::sample(g, 20_000);
        is(&ours.mean, f64::from(g), "mean cosine");
        assert!(ours.outside == 0 && ours.error < 5e-7, "{g}: {ours:?}");
        assert!(phase::density_error(g, 20_000) < 2e-6, "{g}");
    }
    let [naive, _] = phase::sample(-0.5, 1000);
    assert!(naive.range[1] > 400.0);
}

#[test]
fn walks_absorb_once() {
    let medium = Medium::grey(0.5);
    let at = |steps| random_walk::measure(&medium, steps, u32::MAX, 0, 40_000);
    let [ours, _] = at(Steps::Ours);
    is(&ours, slab::half_space(0.5), "half-space");
    let [naive, _] = at(Steps::Naive);
    assert!(naive.value() < 0.8 * ours.value());
}

#[test]
fn brighter_lamps_change_no_bit() {
    assert_eq!(brightness::pixels_that_differ(0), 0);
}

#[test]
fn the_page_has_every_topic_and_names_files_that_exist() {
    let page = std::fs::read_to_string(root().join("docs/pitfalls.md")).expect("it is committed");
    for n in 1..=TOPICS.len() {
        assert!(page.contains(&format!("\n## {n}. ")), "topic {n} has no section");
    }
    assert!(
        !page.contains(&format!("\n## {}. ", TOPICS.len() + 1)),
        "the page is of another program"
    );
    let links: Vec<&str> =
        page.split("](../").skip(1).filter_map(|rest| rest.split_once(')')).map(|p| p.0).collect();
    assert!(links.len() >= TOPICS.len());
    for link in links {
        assert!(root().join(link).is_file(), "{link}");
    }
}
