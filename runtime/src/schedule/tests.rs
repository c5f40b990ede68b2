//! What the scheduler hands out, without rendering.

use super::*;

const REGION: Rect = Rect { x: 0, y: 0, w: 64, h: 32 };
const ZERO: Duration = Duration::ZERO;

fn range(start: u32, end: u32) -> SampleRange {
    SampleRange::new(start, end).unwrap()
}

/// Runs to the end at `seconds` per pixel sample, one item at a time; returns what was claimed.
fn run(scheduler: &mut Scheduler, seconds: f64) -> (Vec<WorkItem>, Duration) {
    let (mut items, mut now) = (Vec::new(), ZERO);
    loop {
        match scheduler.claim(now, &|_| 1024) {
            Claim::Work(item) | Claim::FirstOf(item) => {
                now += Duration::from_secs_f64(item.cost() as f64 * seconds);
                scheduler.finished(&item);
                items.push(item);
            }
            Claim::Wait => panic!("nothing is under way"),
            Claim::Done => return (items, now),
        }
    }
}

#[test]
fn without_a_limit_every_sample_is_handed_out_in_order() {
    let mut scheduler = Scheduler::new(REGION, Some(range(5, 40)), None);
    let (items, _) = run(&mut scheduler, 1.0);
    let passes: Vec<_> = items.iter().map(|item| item.samples).collect();
    assert!(passes.is_sorted() && items.iter().all(|item| !item.probe));
    assert_eq!(items.iter().map(WorkItem::cost).sum::<u64>(), 2048 * 35);
    assert_eq!(scheduler.why(), Stop::Complete);
}

#[test]
fn a_time_limit_ends_with_a_part_of_a_batch_in_time() {
    let mut scheduler = Scheduler::new(REGION, Some(range(0, 1000)), Some(Duration::from_secs(1)));
    // 2048 pixels at 11 us: a sample of all takes 22.5 ms, the probes 11 ms.
    let (items, end) = run(&mut scheduler, 1.1e-5);
    assert!((0.9..=1.0).contains(&end.as_secs_f64()), "{end:?}");
    let last = items.last().unwrap().samples;
    assert_eq!((last.start, scheduler.why()), (32, Stop::TimeLimit));
    assert_eq!(last.count(), 11);
}

#[test]
fn a_film_that_is_too_large_for_one_sample_ends_in_time_all_the_same() {
    let region = Rect { x: 0, y: 0, w: 16_384, h: 16_384 };
    for (seconds, limit) in [(1e-6, 2), (1e-5, 2), (1e-3, 2), (1e-4, 60)] {
        let limit = Duration::from_secs(limit);
        let mut scheduler = Scheduler::new(region, Some(range(0, 64)), Some(limit));
        let (items, end) = run(&mut scheduler, seconds);
        let real: Vec<_> = items.iter().filter(|item| !item.probe).collect();
        assert!(real.iter().all(|item| item.samples == range(0, 1)));
        assert_eq!(scheduler.why(), Stop::TimeLimit);
        // A tile of 1024 pixels at 1 ms takes a second; a run looks at its deadline more often.
        let tile = Duration::from_secs_f64(1024.0 * seconds);
        assert!(end >= limit && end < limit + slack(limit) + tile, "{end:?}");
        let probed = items.len() - real.len();
        let cost: u64 = items.iter().take(probed).map(WorkItem::cost).sum();
        assert!(cost as f64 * seconds <= 0.13 * limit.as_secs_f64(), "{cost} {seconds}");
    }
}

#[test]
fn a_pass_that_takes_longer_than_expected_is_broken_off() {
    let limit = Duration::from_secs(2);
    let mut scheduler = Scheduler::new(REGION, Some(range(0, 1 << 20)), Some(limit));
    let mut now = ZERO;
    while let Claim::Work(item) | Claim::FirstOf(item) = scheduler.claim(now, &|_| 64) {
        // From the second pass on a hundred times as slow as before.
        let seconds = if item.samples.start < 16 { 1e-5 } else { 1e-3 };
        now += Duration::from_secs_f64(item.cost() as f64 * seconds);
        scheduler.finished(&item);
    }
    assert_eq!(scheduler.why(), Stop::TimeLimit);
    // Tiles of 64 pixels and 16 samples take a second each.
    assert!(now >= limit && now < limit + Duration::from_secs(2), "{now:?}");
}

#[test]
fn while_it_is_held_no_pass_begins() {
    let mut scheduler = Scheduler::new(REGION, Some(range(0, 32)), None);
    let Claim::FirstOf(first) = scheduler.claim(ZERO, &|_| 1024) else { panic!("no work") };
    scheduler.hold(true);
    let Claim::Work(second) = scheduler.claim(ZERO, &|_| 1024) else { panic!("no work") };
    assert_eq!(scheduler.claim(ZERO, &|_| 1024), Claim::Wait);
    scheduler.finished(&first);
    scheduler.finished(&second);
    scheduler.hold(false);
    let Claim::FirstOf(item) = scheduler.claim(ZERO, &|_| 1024) else { panic!("no work") };
    assert_eq!(item.samples, range(16, 32));
}

#[test]
fn replicates_take_turns_and_rounds_are_whole() {
    let mut scheduler = Scheduler::new(REGION, Some(range(0, 40)), None).in_rounds(4);
    let (items, _) = run(&mut scheduler, 1.0);
    let mut passes: Vec<_> =
        items.iter().map(|item| (item.samples.start, item.replicate)).collect();
    passes.dedup();
    let starts = [0, 1, 2, 4, 8, 16, 32];
    let all: Vec<_> = starts.iter().flat_map(|s| (0..4).map(move |r| (*s, r))).collect();
    assert_eq!(passes, all);
    assert_eq!(items.iter().map(WorkItem::cost).sum::<u64>(), 4 * 2048 * 40);
}

#[test]
fn a_time_limit_cuts_no_round() {
    let limit = Some(Duration::from_secs(3));
    let mut scheduler = Scheduler::new(REGION, Some(range(0, 1000)), limit).in_rounds(4);
    // 81.92 ms for a sample of all: 16 take 1.31 s, 32 take 2.62 s, 48 would take 3.9 s.
    let (items, end) = run(&mut scheduler, 1e-5);
    let last = items.last().unwrap();
    assert_eq!((last.samples, last.replicate), (range(16, 32), 3));
    assert_eq!(scheduler.why(), Stop::TimeLimit);
    assert!((2.6..3.0).contains(&end.as_secs_f64()), "{end:?}");
}

#[test]
fn a_round_that_was_begun_is_ended_unless_cancelled() {
    let mut scheduler = Scheduler::new(REGION, Some(range(0, 64)), None).in_rounds(4);
    let Claim::FirstOf(item) = scheduler.claim(ZERO, &|_| 1 << 20) else { panic!("no work") };
    scheduler.finished(&item);
    scheduler.stop(Stop::ErrorReached);
    let (items, _) = run(&mut scheduler, 1.0);
    assert!(items.iter().all(|item| item.samples == range(0, 1)));
    assert_eq!((items.last().unwrap().replicate, scheduler.why()), (3, Stop::ErrorReached));
}

#[test]
fn no_pass_goes_beyond_the_next_decision() {
    let mut scheduler = Scheduler::new(REGION, Some(range(0, 64)), None).in_rounds(4);
    scheduler.up_to(20);
    let (items, _) = run(&mut scheduler, 1.0);
    assert_eq!(items.last().map(|item| item.samples), Some(range(16, 20)));
    scheduler.up_to(1000);
    let (items, _) = run(&mut scheduler, 1.0);
    assert_eq!(items.first().map(|item| item.samples), Some(range(20, 32)));
    assert_eq!(items.last().map(|item| item.samples), Some(range(48, 64)));
    let mut scheduler = Scheduler::new(REGION, Some(range(0, 64)), None).in_rounds(4);
    scheduler.up_to(1);
    let Claim::FirstOf(_) = scheduler.claim(ZERO, &|_| 1 << 20) else { panic!("no work") };
    for _ in 1..4 {
        assert!(matches!(scheduler.claim(ZERO, &|_| 1 << 20), Claim::FirstOf(_)));
    }
    assert_eq!(scheduler.claim(ZERO, &|_| 1 << 20), Claim::Wait);
}

#[test]
fn the_shortest_limit_still_gives_one_sample() {
    let mut scheduler = Scheduler::new(REGION, Some(range(16, 64)), Some(Duration::from_nanos(1)));
    let (items, _) = run(&mut scheduler, 1e-5);
    let real: Vec<_> = items.iter().filter(|item| !item.probe).collect();
    assert!(real.iter().all(|item| item.samples == range(16, 17)));
    assert_eq!(real.iter().map(|item| item.tile.pixels()).sum::<u64>(), 2048);
}

#[test]
fn a_limit_that_is_not_reached_changes_nothing() {
    let mut scheduler = Scheduler::new(REGION, Some(range(0, 32)), Some(Duration::from_mins(15)));
    let (items, _) = run(&mut scheduler, 1e-5);
    let cost: u64 = items.iter().filter(|item| !item.probe).map(WorkItem::cost).sum();
    assert_eq!((cost, scheduler.why()), (2048 * 32, Stop::Complete));
}

#[test]
fn tiles_have_the_size_for_the_samples_of_their_pass() {
    let mut scheduler = Scheduler::new(REGION, Some(range(0, 20)), None);
    let mut costs = Vec::new();
    while let Claim::Work(item) | Claim::FirstOf(item) =
        scheduler.claim(ZERO, &|samples| 4096 / u64::from(samples))
    {
        costs.push((item.samples.count(), item.cost()));
        scheduler.finished(&item);
    }
    assert!(costs.contains(&(16, 4096)) && costs.contains(&(4, 4096)), "{costs:?}");
}

#[test]
fn what_comes_back_is_handed_out_again_in_smaller_tiles() {
    let mut scheduler = Scheduler::new(REGION, Some(range(0, 16)), None);
    let Claim::FirstOf(item) = scheduler.claim(ZERO, &|_| 1 << 20) else { panic!("no work") };
    assert_eq!(item.tile, REGION);
    assert_eq!(scheduler.claim(ZERO, &|_| 1 << 20), Claim::Wait);
    scheduler.give_back(item);
    let mut pixels = 0;
    while let Claim::Work(item) = scheduler.claim(ZERO, &|_| 300) {
        assert!(item.tile.pixels() <= 300);
        pixels += item.tile.pixels();
        scheduler.finished(&item);
    }
    assert_eq!(pixels, REGION.pixels());
    assert_eq!(scheduler.claim(ZERO, &|_| 300), Claim::Done);
}

#[test]
fn a_failure_finishes_the_pass_and_a_cancel_ends_at_once() {
    let mut scheduler = Scheduler::new(REGION, Some(range(0, 64)), None);
    let Claim::FirstOf(item) = scheduler.claim(ZERO, &|_| 1024) else { panic!("no work") };
    scheduler.stop(Stop::Failed);
    scheduler.finished(&item);
    let Claim::Work(item) = scheduler.claim(ZERO, &|_| 1024) else { panic!("the pass goes on") };
    assert_eq!(item.samples, range(0, 16));
    scheduler.stop(Stop::Cancelled);
    assert_eq!(scheduler.claim(ZERO, &|_| 1024), Claim::Done);
    assert_eq!(scheduler.why(), Stop::Cancelled);
}

#[test]
fn probes_lie_inside_any_region() {
    for (w, h) in [(1, 1), (16, 16), (17, 3), (3840, 2160)] {
        let region = Rect { x: 5, y: 7, w, h };
        for probe in [8, 16, 1024].into_iter().flat_map(|side| probes(region, range(9, 10), side)) {
            let t = probe.tile;
            assert!(t.x >= 5 && t.y >= 7 && t.x + t.w <= 5 + w && t.y + t.h <= 7 + h);
        }
    }
}
