//! The CPU kernel on a small scene: whole pictures, parts, threads, limits.

mod common;

use common::{SIZE, SPP, assert_same, scene};
use runtime::output::merge;
use runtime::{
    Control, DeviceChoice, Event, Film, Job, Outcome, Precision, Rect, SampleRange, Scene, Stop,
    render,
};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

fn run(scene: &Scene, job: &Job) -> Outcome {
    render(scene, job, &DeviceChoice::Cpu, &Control::default()).expect("the CPU renders")
}

fn range(start: u32, end: u32) -> SampleRange {
    SampleRange { start, end }
}

fn mean(film: &Film) -> f64 {
    film.means().iter().flatten().sum::<f64>() / (3 * film.sums.len()) as f64
}

#[test]
fn the_scene_is_rendered_as_it_asks() {
    let outcome = run(&scene(), &Job::of_scene(&scene()));
    let film = outcome.film();
    assert_eq!((film.image_size, film.samples()), (SIZE, (SPP, SPP)));
    assert_eq!((outcome.stop, film.counters.bad), (Stop::Complete, 0));
    assert!(outcome.picture.meta.complete && outcome.failures.is_empty());
    // Sky above, shaded floor below; every pixel has seen something.
    assert!(film.means().iter().all(|rgb| rgb.iter().all(|x| *x > 0.0 && *x < 25.0)));
    assert!((0.2..1.0).contains(&mean(film)), "{}", mean(film));
    assert!(film.counters.rays > film.total_samples());
    assert!((3..=12).contains(&film.counters.depth), "{}", film.counters.depth);
}

#[test]
fn threads_do_not_change_a_bit() {
    let scene = scene();
    let job = |threads| Job { threads: Some(threads), ..Job::of_scene(&scene) };
    let one = run(&scene, &job(1));
    assert_same(one.film(), run(&scene, &job(3)).film());
}

#[test]
fn a_crop_is_a_part_of_the_whole() {
    let scene = scene();
    let whole = run(&scene, &Job::of_scene(&scene));
    let crop = Rect { x: 13, y: 9, w: 37, h: 5 };
    let part = run(&scene, &Job { crop, ..Job::of_scene(&scene) });
    for y in 0..crop.h {
        let from = ((y + crop.y) * SIZE[0] + crop.x) as usize;
        let at = (y * crop.w) as usize;
        let n = crop.w as usize;
        assert_eq!(part.film().sums[at..at + n], whole.film().sums[from..from + n]);
    }
}

#[test]
fn parts_merge_to_the_whole_up_to_the_order_of_an_f64_sum() {
    let scene = scene();
    let part = |samples| run(&scene, &Job { samples, ..Job::of_scene(&scene) }).picture;
    let whole = part(range(0, 64));
    let merged = merge(vec![part(range(32, 64)), part(range(0, 32))]).expect("they are parts");
    assert_eq!(merged.film.ranges, [range(0, 64)]);
    assert_eq!(merged.film.counters, whole.film.counters);
    for (a, b) in merged.film.sums.iter().flatten().zip(whole.film.sums.iter().flatten()) {
        assert!((a - b).abs() <= 4.0 * f64::EPSILON * b.abs(), "{a} {b}");
    }
}

#[test]
fn the_seed_and_the_samples_change_the_noise_but_not_the_mean() {
    let scene = scene();
    let job = Job::of_scene(&scene);
    let first = run(&scene, &job);
    let seed = run(&scene, &Job { seed: 8, ..job.clone() });
    let later = run(&scene, &Job { samples: range(SPP, 2 * SPP), ..job });
    for other in [&seed, &later] {
        assert_ne!(first.film().sums, other.film().sums);
        // 92 160 samples; the standard error of the difference is about 0.5 %.
        let ratio = mean(first.film()) / mean(other.film());
        assert!((ratio - 1.0).abs() < 0.03, "{ratio}");
    }
}

#[test]
fn the_estimators_agree() {
    let scene = scene();
    let job = |estimator| Job { estimator, samples: range(0, 256), ..Job::of_scene(&scene) };
    let mis = mean(run(&scene, &job(0)).film());
    let bsdf = mean(run(&scene, &job(2)).film());
    assert!((mis / bsdf - 1.0).abs() < 0.03, "{mis} {bsdf}");
}

#[test]
fn the_f64_twin_takes_the_same_decisions() {
    let scene = scene();
    let f32 = run(&scene, &Job::of_scene(&scene));
    let f64 = run(&scene, &Job { precision: Precision::F64, ..Job::of_scene(&scene) });
    let pairs = f32.film().means().into_iter().zip(f64.film().means());
    let n = pairs.filter(|(a, b)| a.iter().zip(b).any(|(a, b)| (a - b).abs() > 1e-3 * b)).count();
    // Rounding may send a path another way now and then.
    assert!(n * 50 < f32.film().sums.len(), "{n} pixels differ");
    assert_ne!(f32.film().sums, f64.film().sums);
}

#[test]
fn another_aspect_keeps_the_horizontal_field_of_view() {
    let scene = scene();
    let mut job = Job::of_scene(&scene);
    job.resize([SIZE[0], 2 * SIZE[1]]);
    let tall = run(&scene, &job);
    let whole = run(&scene, &Job::of_scene(&scene));
    // The middle of the tall picture shows what the whole of the wide one shows.
    let n = whole.film().sums.len();
    let middle = &tall.film().means()[n / 2..n / 2 + n];
    let middle = middle.iter().flatten().sum::<f64>() / (3 * n) as f64;
    let ratio = middle / mean(whole.film());
    assert!((ratio - 1.0).abs() < 0.03, "{ratio}");
}

#[test]
fn a_time_limit_gives_the_picture_of_a_sample_range() {
    let scene = scene();
    let limit = Some(Duration::from_millis(300));
    let job = Job { time_limit: limit, samples: range(0, 1 << 20), ..Job::of_scene(&scene) };
    let timed = run(&scene, &job);
    assert_eq!(timed.stop, Stop::TimeLimit);
    assert!(timed.film().is_even() && !timed.picture.meta.complete);
    let end = timed.film().samples().0;
    let exact = run(&scene, &Job { samples: range(0, end), ..Job::of_scene(&scene) });
    assert_same(timed.film(), exact.film());
}

#[test]
fn a_cancelled_run_keeps_whole_batches() {
    let scene = scene();
    let control = Control::default();
    let job = Job { samples: range(0, 1 << 20), ..Job::of_scene(&scene) };
    let batch = job.crop.pixels() * 16;
    let outcome = std::thread::scope(|scope| {
        scope.spawn(|| {
            while control.progress().done < 2 * batch {
                std::thread::yield_now();
            }
            control.cancel();
        });
        render(&scene, &job, &DeviceChoice::Cpu, &control).expect("the CPU renders")
    });
    let n = outcome.film().samples().0;
    assert_eq!(outcome.stop, Stop::Cancelled);
    assert!(outcome.film().is_even() && n >= 16 && n % 16 == 0, "{n}");
    assert_eq!(outcome.film().ranges, [range(0, n)]);
}

#[test]
fn a_run_cancelled_before_it_began_has_no_samples() {
    let scene = scene();
    let control = Control::default();
    control.cancel();
    let outcome = render(&scene, &Job::of_scene(&scene), &DeviceChoice::Cpu, &control);
    assert_eq!(outcome.expect("no error").film().samples(), (0, 0));
}

#[test]
fn impossible_jobs_are_refused() {
    let scene = scene();
    let job = Job::of_scene(&scene);
    let crop = Rect { x: 70, y: 0, w: 3, h: 1 };
    let big = [1 << 16, 1 << 16];
    for (job, expected) in [
        (Job { crop, ..job.clone() }, "crop 70,0,3,1 is empty or leaves the image of 72x40 pixels"),
        (
            Job { image_size: big, crop: Rect::whole(big), ..job.clone() },
            "an image of 65536x65536 pixels",
        ),
    ] {
        let error = render(&scene, &job, &DeviceChoice::Cpu, &Control::default());
        let text = error.expect_err("it is impossible").to_string();
        assert!(text.starts_with(expected), "{text}");
    }
}

#[test]
fn a_broken_block_is_reported_and_everything_else_is_kept() {
    let scene = scene();
    let job = Job { samples: range(0, 1 << 20), ..Job::of_scene(&scene) };
    // The second block of the second batch. A batch has 3 x 2 blocks, but the first begins with a small one, has one more
    // beside that and 3 below.
    let left = AtomicU64::new(7);
    let control = Control::new(move |event| {
        let breaks = matches!(event, Event::Block) && left.fetch_sub(1, Ordering::Relaxed) == 1;
        assert!(!breaks, "this block breaks");
    });
    let outcome = render(&scene, &Job { threads: Some(1), ..job }, &DeviceChoice::Cpu, &control);
    let outcome = outcome.expect("a picture in spite of it");
    let [failure] = outcome.failures.as_slice() else { panic!("{:?}", outcome.failures) };
    assert_eq!(failure.tile, Rect { x: 32, y: 0, w: 32, h: 32 });
    assert_eq!((failure.sample, failure.message.as_str()), (16, "this block breaks"));
    assert_eq!((outcome.stop, outcome.film().samples()), (Stop::Failed, (16, 32)));
    let n_short = outcome.film().counts.iter().filter(|n| **n == 16).count();
    assert_eq!(n_short, 32 * 32);
}
