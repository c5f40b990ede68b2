//! What was measured → the section "The cost of an 8K frame" of `docs/farm.md`.

use std::fmt::Write as _;

use runtime::Rect;

use super::cost::{Costs, FRAME, GRID, PILOT, TILE};
use super::schedule::{Farm, LOSSES, Outcome, Task, simulate};
use super::tasks::{Merging, Parts, Spent, StartUp};
use crate::benchmarks::machine;

/// Bytes a second of a machine: assumed, 1 Gbit/s.
const LINK: f64 = 1e9 / 8.0;
/// Bytes a second of the store: assumed, 10 Gbit/s.
const STORE: f64 = 1e10 / 8.0;
const MACHINES: [u32; 7] = [1, 3, 10, 30, 100, 300, 1000];
/// What tasks may be.
const SIZES: [Size; 5] = [
    Size { tiles: GRID, n_ranges: 16 },
    Size { tiles: [2, 1], n_ranges: 1 },
    Size { tiles: [1, 1], n_ranges: 1 },
    Size { tiles: [1, 1], n_ranges: 4 },
    Size { tiles: [1, 1], n_ranges: 16 },
];

/// How a frame is cut into tasks.
#[derive(Clone, Copy)]
struct Size {
    /// Tiles of a task, in a row and in a column.
    tiles: [u32; 2],
    /// Tasks that share the samples of a crop.
    n_ranges: u32,
}

/// All that was measured.
pub struct Measured {
    /// Of every tile.
    pub costs: Costs,
    /// Of a task.
    pub start_up: StartUp,
    /// Bytes of the pack.
    pub pack: f64,
    /// The crop that was rendered by tasks.
    pub crop: Rect,
    /// Its parts.
    pub parts: Parts,
    /// Putting them together.
    pub merging: Merging,
    /// Samples of every pixel of the frame.
    pub samples: u32,
}

impl Measured {
    /// Of the parts: their sum without start-up.
    fn rendering(&self) -> Spent {
        let start = self.start_up.whole();
        let sum = |of: fn(&Spent) -> f64| {
            self.parts.spent.iter().map(|spent| of(spent) - of(&start)).sum::<f64>()
        };
        Spent { wall: sum(|spent| spent.wall), cpu: sum(|spent| spent.cpu) }
    }

    /// Seconds of this machine for each CPU second.
    fn wall_of_cpu(&self) -> f64 {
        let Spent { wall, cpu } = self.rendering();
        wall / cpu
    }

    /// Times of the tasks over their mean, without start-up.
    fn spread(&self) -> Vec<f64> {
        let mean = self.rendering().wall / self.parts.spent.len() as f64;
        let start = self.start_up.whole().wall;
        self.parts.spent.iter().map(|spent| (spent.wall - start) / mean).collect()
    }

    fn farm(&self) -> Farm {
        Farm {
            pack: self.pack,
            start_up: self.start_up.whole().wall,
            part_pixel: self.bytes_a_pixel(),
            merge_part_pixel: self.merging.part_pixel,
            merge_pixel: self.merging.pixel,
            link: LINK,
            store: STORE,
            spread: self.spread(),
        }
    }

    /// Of a part.
    fn bytes_a_pixel(&self) -> f64 {
        self.parts.bytes / (self.parts.paths.len() as f64 * self.crop.pixels() as f64)
    }

    /// The frame in tasks of this size.
    fn tasks(&self, size: Size) -> Vec<Task> {
        let [columns, rows] = size.tiles;
        let mut tasks = Vec::new();
        for row in (0..GRID[1]).step_by(rows as usize) {
            for column in (0..GRID[0]).step_by(columns as usize) {
                let [x, y] = [column * TILE[0], row * TILE[1]];
                let crop = Rect { x, y, w: columns * TILE[0], h: rows * TILE[1] };
                let samples = f64::from(self.samples) / f64::from(size.n_ranges);
                let cpu = self.costs.of_crop(crop) * samples;
                let task = Task { seconds: cpu * self.wall_of_cpu(), pixels: crop.pixels() as f64 };
                tasks.extend(std::iter::repeat_n(task, size.n_ranges as usize));
            }
        }
        tasks
    }

    fn run(&self, size: Size, n_machines: u32) -> Outcome {
        simulate(&self.farm(), &self.tasks(size), n_machines, pixels())
    }

    /// The size of tasks with which so many machines are done first, and how it goes.
    fn best(&self, n_machines: u32) -> (Size, Outcome) {
        let runs = SIZES.map(|size| (size, self.run(size, n_machines)));
        let first = runs.into_iter().min_by(|a, b| a.1.seconds.total_cmp(&b.1.seconds));
        first.expect("there are sizes")
    }
}

/// Pixels of the frame.
fn pixels() -> f64 {
    Rect::whole(FRAME).pixels() as f64
}

/// The section.
#[must_use]
pub fn page(measured: &Measured) -> String {
    let mut text = format!(
        "## The cost of an 8K frame\n\n\
        Printed by `cargo run --release -p tests --bin farm`, which measures for about a quarter of an hour. CPU seconds \
        are user + system time of the process.\n\n{}\n",
        machine()
    );
    costs(&mut text, measured);
    besides(&mut text, measured);
    times(&mut text, measured);
    bounds(&mut text, measured);
    text
}

fn costs(text: &mut String, measured: &Measured) {
    let Measured { costs, samples, crop, .. } = measured;
    let Costs { tiles, frame, ratio, n_crops } = costs;
    let n = f64::from(*samples);
    let tile_samples = f64::from(TILE[0] * TILE[1]);
    let mut sorted = tiles.clone();
    sorted.sort_by(f64::total_cmp);
    let [least, median, most] = [0, sorted.len() / 2, sorted.len() - 1].map(|k| sorted[k]);
    let dearest: f64 = sorted[sorted.len() - sorted.len() / 10..].iter().sum();
    let hours = |cost: f64| cost * pixels() * n / 3600.0;
    let _ = writeln!(
        text,
        "\nThe shrine with `-D final=true`: {} x {} pixels, {samples} samples each, paths of up to 50 segments. The \
        frame was first rendered small, tile by tile, to learn how cost is spread over {} tiles of {} x {} pixels; then \
        {n_crops} crops of the frame itself with all samples, drawn at random from each eighth of the tiles by cost, more from \
        dearer ones. These cost {ratio:.2} times what the small frame says of their tiles; the tiles below are scaled by \
        that.\n\n\
        | what | CPU |\n|---|---|\n\
        | a sample, mean of the frame | {:.1} ± {:.1} µs |\n\
        | a sample of the cheapest, the median, the dearest tile | {:.1}, {:.1}, {:.1} µs |\n\
        | a batch of 16 samples of a tile: cheapest, mean, dearest | {:.1}, {:.1}, {:.1} s |\n\
        | a tile: cheapest, mean, dearest | {:.0}, {:.0}, {:.0} s |\n\
        | the dearest tenth of the tiles | {:.0} % of the frame |\n\
        | **the frame** | **{:.1} ± {:.1} h** |",
        FRAME[0],
        FRAME[1],
        tiles.len(),
        TILE[0],
        TILE[1],
        1e6 * frame.mean,
        1e6 * frame.error,
        1e6 * least,
        1e6 * median,
        1e6 * most,
        16.0 * tile_samples * least,
        16.0 * tile_samples * frame.mean,
        16.0 * tile_samples * most,
        n * tile_samples * least,
        n * tile_samples * frame.mean,
        n * tile_samples * most,
        100.0 * dearest / sorted.iter().sum::<f64>(),
        hours(frame.mean),
        hours(frame.error),
    );
    let Spent { wall, cpu } = measured.rendering();
    let guess = costs.of_crop(*crop) * n;
    let _ = writeln!(
        text,
        "\n± is one standard error, that of the ratio. A crop that had no part in that, the {} x {} pixels at \
        {}, {} that the picture shows, took {cpu:.0} CPU s as {} tasks of one batch; the table says {guess:.0} ({:+.1} %). \
        One place is known less well than the frame: of a tile the small frame has {PILOT} samples. A machine renders a \
        CPU second in {:.3} s, so one takes {} for the frame.\n\n\
        ![A crop of the frame](farm-crop.png)",
        crop.w,
        crop.h,
        crop.x,
        crop.y,
        measured.parts.spent.len(),
        100.0 * (guess / cpu - 1.0),
        wall / cpu,
        time_text(hours(frame.mean) * 3600.0 * wall / cpu),
    );
}

/// What is not rendering.
fn besides(text: &mut String, measured: &Measured) {
    let StartUp { process, tree } = measured.start_up;
    let spread = measured.spread();
    let least = spread.iter().copied().fold(f64::INFINITY, f64::min);
    let most = spread.iter().copied().fold(0.0, f64::max);
    let merging = &measured.merging;
    let [few, all] = merging.rounds;
    let _ = writeln!(
        text,
        "\n| besides rendering | measured |\n|---|---|\n\
        | a task of one sample of 8 x 8 pixels, from the start of the process to its end | {:.3} s |\n\
        | making the tree of the CPU kernel, once a task | {:.3} s |\n\
        | the pack | {:.1} MB |\n\
        | a part, each pixel | {:.1} bytes |\n\
        | merging {} parts of {} x {} pixels to EXR and PNG | {:.2} s |\n\
        | merging {} parts | {:.2} s |\n\
        | that is, each pixel of each part | {:.0} ns |\n\
        | and each pixel of the picture | {:.0} ns |\n\
        | the fastest and the slowest of {} equal tasks, against their mean | {:.3}, {:.3} |",
        process.wall,
        tree.wall,
        measured.pack / 1e6,
        measured.bytes_a_pixel(),
        few.0,
        measured.crop.w,
        measured.crop.h,
        few.1,
        all.0,
        all.1,
        1e9 * merging.part_pixel,
        1e9 * merging.pixel,
        spread.len(),
        least,
        most,
    );
}

fn times(text: &mut String, measured: &Measured) {
    *text += "\nSimulated from these numbers: N machines of this kind fetch the pack, all at once, then whoever is free \
        takes the next task of the list; a task starts a process, renders, and sends its part; one machine reads and \
        merges them all. A task takes what its tiles cost, times one of the measured ratios of equal tasks, by a fixed \
        seed. Assumed, not measured: 1 Gbit/s a machine, a store of 10 Gbit/s for all, and no machine that is lost. Time \
        to the merged picture, and share of it that all machines render:\n\n| machines |";
    for size in SIZES {
        let tasks = measured.tasks(size);
        let mean = tasks.iter().map(|task| task.seconds).sum::<f64>() / tasks.len() as f64;
        let _ = write!(
            text,
            " {}: {} tasks of {} |",
            name(size, measured.samples),
            tasks.len(),
            time_text(mean)
        );
    }
    let _ = writeln!(text, "\n|{}", "---|".repeat(SIZES.len() + 1));
    for n in MACHINES {
        let _ = write!(text, "| {n} |");
        for size in SIZES {
            let Outcome { seconds, efficiency, .. } = measured.run(size, n);
            let _ = write!(text, " {}, {:.0} % |", time_text(seconds), 100.0 * efficiency);
        }
        text.push('\n');
    }
}

fn bounds(text: &mut String, measured: &Measured) {
    let _ = writeln!(
        text,
        "\nWhere the time of the machines goes, with the tasks that are done first:\n\n\
        | machines | tasks | time | rendering | {} |\n|---|---|---|---|{}",
        LOSSES.join(" | "),
        "---|".repeat(LOSSES.len()),
    );
    for n in MACHINES {
        let (size, outcome) = measured.best(n);
        let shares = outcome.losses.map(|share| format!("{:.1} %", 100.0 * share.max(0.0)));
        let _ = writeln!(
            text,
            "| {n} | {} | {} | {:.1} % | {} |",
            name(size, measured.samples),
            time_text(outcome.seconds),
            100.0 * outcome.efficiency,
            shares.join(" | "),
        );
    }
    let runs = MACHINES.map(|n| (n, measured.best(n).1));
    let well = runs.iter().rev().find(|(_, outcome)| outcome.efficiency >= 0.9);
    let most = well.map_or(0, |(n, _)| *n);
    let _ = write!(text, "\nUp to {most} machines render nine tenths of their time or more.");
    for (n, outcome) in runs.iter().filter(|(n, _)| *n > most) {
        let share = outcome.losses.into_iter().fold(0.0, f64::max);
        let _ = write!(
            text,
            " {n} machines: {:.0} %, and {:.0} % go to {}.",
            100.0 * outcome.efficiency,
            100.0 * share,
            outcome.bound(),
        );
    }
    limits(text, measured);
}

/// What no number of machines makes shorter.
fn limits(text: &mut String, measured: &Measured) {
    let farm = measured.farm();
    let merge = |n_ranges: f64| {
        let part_pixels = pixels() * n_ranges;
        part_pixels * (farm.part_pixel / LINK + farm.merge_part_pixel) + pixels() * farm.merge_pixel
    };
    let shortest = measured.tasks(SIZES[4]);
    let longest = shortest.iter().map(|task| task.seconds).fold(0.0, f64::max);
    let _ = writeln!(
        text,
        " Three costs do not shrink with more machines. The longest task: a batch of the dearest tile takes {}, so tiles \
        must be smaller where they are dear. One machine merges: {} where a pixel is in one part, {} where it is in 16, in \
        tasks of a batch. And the store hands out the pack: {} to one machine, {} to each of {}.",
        time_text(longest),
        time_text(merge(1.0)),
        time_text(merge(16.0)),
        time_text(farm.pack / LINK),
        time_text(farm.pack * f64::from(MACHINES[6]) / STORE),
        MACHINES[6],
    );
}

fn name(size: Size, samples: u32) -> String {
    let [w, h] = [size.tiles[0] * TILE[0], size.tiles[1] * TILE[1]];
    format!("{w} x {h}, {} samples", samples / size.n_ranges)
}

/// `12.3 s`, `4.5 min`, `6.7 h`.
fn time_text(seconds: f64) -> String {
    match seconds {
        ..60.0 => format!("{seconds:.1} s"),
        60.0..3600.0 => format!("{:.1} min", seconds / 60.0),
        _ => format!("{:.1} h", seconds / 3600.0),
    }
}
