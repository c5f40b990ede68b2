//! Tasks and machines → the time until the picture is merged, by simulation.
//!
//! Machines fetch the pack, all at once, and then take tasks from a list: whoever is free takes the next (list
//! scheduling; Graham 1969, "Bounds on Multiprocessing Timing Anomalies"). A task is a process that starts, renders
//! and sends its part to the store. When the last part is there, one machine reads them all and merges them. It does
//! not know how the costs were measured. The same input gives the same times.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::time::Duration;

use crate::statistics::stream::Stream;

const SEED: u64 = 8;

/// What all machines have in common. Times in seconds, sizes in bytes, bandwidths in bytes a second.
#[derive(Clone, Debug, PartialEq)]
pub struct Farm {
    /// The scene, which each machine fetches once.
    pub pack: f64,
    /// Of a task, besides rendering and sending.
    pub start_up: f64,
    /// Size of a part, for each of its pixels.
    pub part_pixel: f64,
    /// Merging, for each pixel of each part.
    pub merge_part_pixel: f64,
    /// Merging, for each pixel of the picture.
    pub merge_pixel: f64,
    /// Bandwidth of a machine.
    pub link: f64,
    /// Bandwidth of the store, which all machines share.
    pub store: f64,
    /// Measured times of equal tasks over their mean; each task is given one of them. Not empty.
    pub spread: Vec<f64>,
}

/// A crop and a range of samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Task {
    /// Rendering on one machine, in seconds.
    pub seconds: f64,
    /// Pixels of its part.
    pub pixels: f64,
}

/// What machines do when they do not render.
pub const LOSSES: [&str; 5] =
    ["fetching the pack", "start-up", "sending parts", "waiting for the last task", "merging"];

/// How a frame went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// From the first machine's start to the merged picture.
    pub seconds: f64,
    /// Share of the time of all machines in which they render.
    pub efficiency: f64,
    /// Shares of `LOSSES`; with `efficiency` they add up to 1.
    pub losses: [f64; LOSSES.len()],
}

impl Outcome {
    /// What takes most of the time that is not spent rendering.
    #[must_use]
    pub fn bound(&self) -> &'static str {
        let shares = LOSSES.into_iter().zip(self.losses);
        shares.max_by(|a, b| a.1.total_cmp(&b.1)).map_or("", |(name, _)| name)
    }
}

/// `n_machines` render `tasks` of a picture of `pixels` pixels.
#[must_use]
pub fn simulate(farm: &Farm, tasks: &[Task], n_machines: u32, pixels: f64) -> Outcome {
    let n = f64::from(n_machines);
    let fetch = farm.pack / farm.link.min(farm.store / n);
    let sent = |task: &Task| task.pixels * farm.part_pixel / farm.link;
    let mut stream = Stream::new(SEED, u64::from(n_machines));
    let mut free: BinaryHeap<_> = (0..n_machines).map(|_| Reverse(Duration::ZERO)).collect();
    let (mut rendered, mut last) = (0.0, Duration::ZERO);
    for task in tasks {
        let render = task.seconds * farm.spread[stream.index(farm.spread.len())];
        rendered += render;
        let Reverse(from) = free.pop().unwrap_or_default();
        let end = from + Duration::from_secs_f64(farm.start_up + render + sent(task));
        last = last.max(end);
        free.push(Reverse(end));
    }
    let part_pixels: f64 = tasks.iter().map(|task| task.pixels).sum();
    let bytes = part_pixels * farm.part_pixel;
    // The store takes no more than it can.
    let worked = last.as_secs_f64().max(bytes / farm.store);
    let merge = bytes / farm.link + part_pixels * farm.merge_part_pixel + pixels * farm.merge_pixel;
    let seconds = fetch + worked + merge;
    let start_up = tasks.len() as f64 * farm.start_up;
    let send: f64 = tasks.iter().map(sent).sum();
    let idle = n * worked - rendered - start_up - send;
    let share = |machine_seconds: f64| machine_seconds / (n * seconds);
    Outcome {
        seconds,
        efficiency: share(rendered),
        losses: [n * fetch, start_up, send, idle, n * merge].map(share),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIXELS: f64 = 1000.0;

    fn farm() -> Farm {
        Farm {
            pack: 500.0,
            start_up: 2.0,
            part_pixel: 10.0,
            merge_part_pixel: 1e-3,
            merge_pixel: 2e-3,
            link: 100.0,
            store: 1000.0,
            spread: vec![1.0],
        }
    }

    fn tasks(n: u64) -> Vec<Task> {
        let mut stream = Stream::new(1, n);
        (0..n).map(|_| Task { seconds: stream.between(1.0, 100.0), pixels: 20.0 }).collect()
    }

    /// Of a task: start-up, rendering, sending.
    fn whole(task: &Task) -> f64 {
        2.0 + task.seconds + 2.0
    }

    fn merge(n_tasks: f64) -> f64 {
        n_tasks * (2.0 + 0.02) + 2.0
    }

    fn is_near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-6 * b.abs()
    }

    #[test]
    fn one_machine_takes_the_sum() {
        let tasks = tasks(50);
        let sum: f64 = tasks.iter().map(whole).sum();
        let outcome = simulate(&farm(), &tasks, 1, PIXELS);
        assert!(is_near(outcome.seconds, 5.0 + sum + merge(50.0)), "{outcome:?}");
        assert!(outcome.losses[3].abs() < 1e-9, "nobody waits: {outcome:?}");
    }

    #[test]
    fn as_many_machines_as_tasks_take_the_longest_task() {
        let tasks = tasks(40);
        let longest = tasks.iter().map(whole).fold(0.0, f64::max);
        for n in [40_u32, 400] {
            let fetch = 500.0 / f64::min(100.0, 1000.0 / f64::from(n));
            let outcome = simulate(&farm(), &tasks, n, PIXELS);
            assert!(is_near(outcome.seconds, fetch + longest + merge(40.0)), "{n}: {outcome:?}");
        }
    }

    /// Graham 1969: no schedule is better than the work over the machines or the longest task; a list is no worse than
    /// both together.
    #[test]
    fn no_schedule_is_better_or_worse_than_it_can_be() {
        for n_tasks in [1, 7, 100, 333] {
            let tasks = tasks(n_tasks);
            let work: f64 = tasks.iter().map(whole).sum();
            let longest = tasks.iter().map(whole).fold(0.0, f64::max);
            for n in 1..60 {
                let machines = f64::from(n);
                let outcome = simulate(&farm(), &tasks, n, PIXELS);
                let fetch = 500.0 / f64::min(100.0, 1000.0 / machines);
                let worked = outcome.seconds - fetch - merge(tasks.len() as f64);
                assert!(worked > (work / machines).max(longest) - 1e-6, "{n_tasks} {n}");
                let most = work / machines + (1.0 - 1.0 / machines) * longest;
                assert!(worked < most + 1e-6, "{n_tasks} {n}: {worked} {most}");
            }
        }
    }

    #[test]
    fn shares_add_up_and_are_none_below_zero() {
        for n in [1, 2, 10, 1000] {
            let outcome = simulate(&farm(), &tasks(64), n, PIXELS);
            let sum = outcome.efficiency + outcome.losses.iter().sum::<f64>();
            assert!(is_near(sum, 1.0), "{outcome:?}");
            assert!(outcome.losses.iter().all(|share| *share > -1e-9), "{outcome:?}");
        }
    }

    #[test]
    fn a_store_that_is_shared_is_what_binds_many_machines() {
        let slow = Farm { store: 100.0, ..farm() };
        let outcome = simulate(&slow, &tasks(1000), 500, PIXELS);
        assert_eq!(outcome.bound(), "fetching the pack", "{outcome:?}");
        // Nor can parts come faster than it takes them.
        let slow = Farm { store: 10.0, ..farm() };
        assert!(simulate(&slow, &tasks(100), 100, PIXELS).seconds > 5000.0 + 2000.0);
    }

    #[test]
    fn stragglers_cost_time_and_the_same_time_each_run() {
        let uneven = Farm { spread: vec![0.5, 1.5], ..farm() };
        let [even, slow] = [farm(), uneven].map(|farm| simulate(&farm, &tasks(50), 50, PIXELS));
        assert!(slow.seconds > even.seconds);
        assert_eq!(
            slow,
            simulate(&Farm { spread: vec![0.5, 1.5], ..farm() }, &tasks(50), 50, PIXELS)
        );
    }
}
