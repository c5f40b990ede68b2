//! Work items → submissions → pixels: several tiles at once, each with a film of its own.
//!
//! Two or three submissions are under way, so that the device never waits for us; each holds four tiles, or more
//! small ones, that share no writable buffer, so that their tails overlap. Tiles are deposited as
//! their submission ends; what a lost device did not finish goes back to the run, and what a driver
//! cut short is rendered by the CPU kernel.

use super::busy::Busy;
use super::device::Device;
use super::error::GpuError;
use super::pace::{MAX_TILES, Pace};
use super::record::is_cut;
use super::slot::{Slot, Slots, submit};
use super::stopwatch::Stopwatch;
use super::work::Work;
use crate::cpu;
use crate::run::Run;
use crate::schedule::{Claim, WorkItem};
use crate::setup::Setup;
use crate::signals::Event;
use pack::abi::FilmPixel;
use std::collections::VecDeque;
use std::time::Instant;
use wgpu::SubmissionIndex;

/// Submissions under way at once.
const IN_FLIGHT: usize = 3;
/// Most tiles of a submission, where they are small: blocks that still have samples to come.
const MOST_TILES: usize = 256;

/// What the tiles of a device came to.
struct Tally {
    busy: Busy,
    tiles: u64,
    /// Those in which the driver cut loops short.
    cut: u64,
}

impl Tally {
    fn tell(&self, run: &Run<'_>) {
        let lines = [self.busy.text(Instant::now()), self.cut_text()];
        lines.iter().flatten().for_each(|line| run.note(line));
    }

    fn cut_text(&self) -> Option<String> {
        let Self { tiles, cut, .. } = self;
        (*cut > 0).then(|| {
            format!("the driver cut loops short in {cut} of {tiles} tiles; the CPU rendered them")
        })
    }
}

/// A submission under way.
struct Submission {
    index: SubmissionIndex,
    slots: Vec<Slot>,
    /// Pixel samples that it was to have: tiles at an edge have fewer.
    planned: f64,
    watch: Option<Stopwatch>,
    submitted: Instant,
}

impl Device {
    /// Renders until the run has nothing left. On an error every item that was not deposited has
    /// been given back.
    pub(super) fn render(
        &mut self,
        setup: &Setup<'_>,
        run: &Run<'_>,
        pace: &mut Pace,
    ) -> Result<(), GpuError> {
        run.signals().tell(Event::Device(&self.gpu));
        let mut under_way = VecDeque::new();
        let result = self.render_loop(setup, run, pace, &mut under_way);
        for submission in &under_way {
            for slot in &submission.slots {
                run.give_back(slot.item);
            }
        }
        result
    }

    fn render_loop(
        &mut self,
        setup: &Setup<'_>,
        run: &Run<'_>,
        pace: &mut Pace,
        under_way: &mut VecDeque<Submission>,
    ) -> Result<(), GpuError> {
        let mut free = Slots::default();
        let mut tally = Tally { busy: Busy::new(Instant::now()), tiles: 0, cut: 0 };
        loop {
            while under_way.len() < IN_FLIGHT {
                let planned = pace.next();
                let items = claim(run, pace, planned);
                if items.is_empty() {
                    break;
                }
                under_way.push_back(self.start(setup, &mut free, &items, planned));
            }
            // With nothing under way there is nothing to wait for: the run is over.
            if under_way.is_empty() {
                tally.tell(run);
                return Ok(());
            }
            self.collect((setup, run), pace, under_way, &mut free, &mut tally)?;
        }
    }

    fn start(
        &self,
        setup: &Setup<'_>,
        free: &mut Slots,
        items: &[WorkItem],
        planned: f64,
    ) -> Submission {
        let mut slots: Vec<Slot> =
            items.iter().map(|item| free.take(self, self.entry.bytes(item))).collect();
        let new = || Stopwatch::new(&self.gpu, self.queue.get_timestamp_period());
        let watch = free.watches.pop().or_else(new);
        let submitted = Instant::now();
        let index = submit(self, setup, &mut slots, items, watch.as_ref());
        Submission { index, slots, planned, watch, submitted }
    }

    /// Waits for the oldest submission and deposits its tiles. It stays in `under_way`, with the
    /// tiles that are not deposited, when that fails.
    fn collect(
        &self,
        (setup, run): (&Setup<'_>, &Run<'_>),
        pace: &mut Pace,
        under_way: &mut VecDeque<Submission>,
        free: &mut Slots,
        tally: &mut Tally,
    ) -> Result<(), GpuError> {
        let Some(oldest) = under_way.front_mut() else { return Ok(()) };
        run.signals().tell(Event::Submission);
        let waited = self.wait(oldest.index.clone());
        self.fault()?;
        waited?;
        let own = oldest.watch.as_ref().and_then(Stopwatch::read);
        run.timed(own);
        let busy = tally.busy.ended(oldest.submitted, Instant::now(), own);
        let samples = oldest.slots.iter().map(|slot| slot.item.cost()).sum();
        let mut work = Work { planned: oldest.planned, samples, rays: 0, busy };
        free.watches.extend(oldest.watch.take());
        while let Some(slot) = oldest.slots.last_mut() {
            let item = slot.item;
            let is_cut = slot.read(self, |pixels: &[FilmPixel]| {
                let is_cut = is_cut(pixels);
                if !is_cut {
                    work.rays += pixels.iter().map(|pixel| u64::from(pixel.rays)).sum::<u64>();
                    run.deposit(&item, pixels);
                }
                is_cut
            })?;
            if is_cut {
                let rendered = cpu::render_item(setup, run, &item);
                rendered
                    .map_err(|e| GpuError::Wrong(format!("the driver cut loops short, and {e}")))?;
            }
            tally.tiles += 1;
            tally.cut += u64::from(is_cut);
            free.free.extend(oldest.slots.pop());
        }
        pace.measured(work);
        under_way.pop_front();
        Ok(())
    }
}

/// Items for one submission that is to have so many pixel samples; empty when there are none now.
fn claim(run: &Run<'_>, pace: &Pace, planned: f64) -> Vec<WorkItem> {
    let mut items: Vec<WorkItem> = Vec::with_capacity(MAX_TILES);
    let mut cost = 0;
    loop {
        match run.claim(&|samples| pace.tiles(samples).1) {
            Claim::Work(item) | Claim::FirstOf(item) => {
                items.push(item);
                cost += item.cost();
                let (n, _) = pace.tiles(items[0].samples.count());
                let is_full = items.len() >= n && cost as f64 >= 0.5 * planned;
                if is_full || items.len() == MOST_TILES {
                    return items;
                }
            }
            Claim::Wait | Claim::Done => return items,
        }
    }
}
