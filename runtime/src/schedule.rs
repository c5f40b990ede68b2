//! What to render next: passes over the image, one canonical batch each, handed out tile by tile.
//!
//! With a time limit it measures a few probe tiles first and then starts only passes that are
//! expected to end in time; the last one may hold fewer samples than a batch, so the result is
//! the picture of a sample range `a..b` and can be repeated exactly. A pass that takes longer than it was
//! expected to is broken off a little after the limit. What it has counts only when there is no other:
//! where not even one sample of every pixel fits, some pixels have it and the others have none. It does
//! not render and reads no clock: the caller says what time it is.

use crate::allocation::Allocation;
use crate::region::{Rect, SampleRange, Tiler};
use pack::abi::BATCH;
use std::time::Duration;

/// Probe tiles of a round, before a run with a time limit.
const PROBES: u32 = 16;
/// Side of a probe tile of the first round in pixels; it doubles from round to round.
const PROBE_SIDE: u32 = 8;
/// A round of probes that took this share of the limit is good enough, and none that takes four times as
/// long is begun.
const PROBED: f64 = 0.02;
/// Share of the region that the probes of a round may have.
const PROBED_PIXELS: u64 = 4;
/// Of what probes promise, the share that the first pass may have: they are few and small.
const TRUST: f64 = 0.85;

/// A tile of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct WorkItem {
    /// Pixels, in image coordinates.
    pub(crate) tile: Rect,
    /// Samples of every pixel; inside one canonical batch.
    pub(crate) samples: SampleRange,
    /// Which of the pictures it belongs to; 0 where there is only one.
    pub(crate) replicate: u32,
    /// Rendered for its duration only; the result is thrown away.
    pub(crate) probe: bool,
}

impl WorkItem {
    /// Pixels times samples.
    pub(crate) fn cost(&self) -> u64 {
        self.tile.pixels() * u64::from(self.samples.count())
    }
}

/// Pixels of a tile whose pixels have that many samples each.
pub(crate) type TileSize<'a> = &'a dyn Fn(u32) -> u64;

/// Answer to "what next?".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Claim {
    /// Render this.
    Work(WorkItem),
    /// The same, and it is the first tile of a new batch.
    FirstOf(WorkItem),
    /// Ask again when something that is under way has ended.
    Wait,
    /// Nothing is left.
    Done,
}

/// Why no further pass was started.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// Every sample was rendered.
    Complete,
    /// The time limit.
    TimeLimit,
    /// The error that was asked for was reached.
    ErrorReached,
    /// The user interrupted.
    Cancelled,
    /// Something failed; the picture holds what was complete.
    Failed,
}

impl Stop {
    /// As reports and lines of progress name it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Complete => "complete",
            Self::TimeLimit => "time limit",
            Self::ErrorReached => "error reached",
            Self::Cancelled => "interrupted",
            Self::Failed => "failed",
        }
    }
}

/// The pass whose tiles are being handed out.
struct Pass {
    samples: SampleRange,
    replicate: u32,
    tiler: Tiler,
    /// Parts of the region that follow the one of `tiler`, the next one last.
    parts: Vec<Rect>,
}

impl Pass {
    /// Of at least one part, the first one last.
    fn new(samples: SampleRange, replicate: u32, mut parts: Vec<Rect>) -> Option<Self> {
        let tiler = Tiler::new(parts.pop()?);
        Some(Self { samples, replicate, tiler, parts })
    }

    /// The next tile.
    fn next(&mut self, size: TileSize<'_>) -> Option<WorkItem> {
        let Self { samples, replicate, tiler, parts } = self;
        loop {
            if let Some(tile) = tiler.next(size(samples.count())) {
                let (samples, replicate) = (*samples, *replicate);
                return Some(WorkItem { tile, samples, replicate, probe: false });
            }
            *tiler = Tiler::new(parts.pop()?);
        }
    }
}

/// The state of a run.
pub(crate) struct Scheduler {
    region: Rect,
    /// Pictures that take turns, pass by pass. A round gives the same samples to each of them; once
    /// begun it is carried to its end.
    replicates: u32,
    /// Samples that no pass has covered yet.
    rest: Option<SampleRange>,
    pass: Option<Pass>,
    /// Items that came back from a lost device.
    returned: Vec<WorkItem>,
    limit: Option<Duration>,
    probes: Vec<WorkItem>,
    /// Side of the probes of this round.
    probe_side: u32,
    /// Whether no further pass may begin now.
    is_held: bool,
    /// First sample that no pass may have yet.
    ceiling: Option<u32>,
    /// Which parts of the region a pass covers; `None`: all.
    allocation: Option<Allocation>,
    /// Whether nothing is handed out any more.
    is_over: bool,
    started: Option<Duration>,
    /// Cost claimed and neither finished nor returned.
    under_way: u64,
    /// Cost finished since `started`.
    finished: u64,
    probe_rate: f64,
    stop: Option<Stop>,
}

impl Scheduler {
    /// Without `samples` there is nothing to do.
    pub(crate) fn new(region: Rect, samples: Option<SampleRange>, limit: Option<Duration>) -> Self {
        let probed = samples.filter(|_| limit.is_some());
        let probes = probed.map_or_else(Vec::new, |samples| probes(region, samples, PROBE_SIDE));
        Self {
            region,
            replicates: 1,
            rest: samples,
            pass: None,
            returned: Vec::new(),
            limit,
            probes,
            probe_side: PROBE_SIDE,
            is_held: false,
            ceiling: None,
            allocation: None,
            is_over: false,
            started: None,
            under_way: 0,
            finished: 0,
            probe_rate: 0.0,
            stop: None,
        }
    }

    /// The same samples for each of `replicates` pictures, round by round. Small rounds come first,
    /// and no batch is cut short for a time limit.
    pub(crate) fn in_rounds(mut self, replicates: u32) -> Self {
        self.replicates = replicates;
        self
    }

    /// The next tile, of about as many pixels as `size` says where each has that many samples. `now` is the time
    /// since the run began.
    pub(crate) fn claim(&mut self, now: Duration, size: TileSize<'_>) -> Claim {
        if self.deadline().is_some_and(|deadline| now >= deadline) {
            self.stop(Stop::TimeLimit);
            self.is_over = true;
        }
        if self.is_over {
            return Claim::Done;
        }
        let claim = self.next(now, size);
        if let Claim::Work(item) | Claim::FirstOf(item) = &claim {
            self.under_way += item.cost();
        }
        claim
    }

    /// Whether somebody has an item and has neither finished nor returned it.
    pub(crate) fn is_under_way(&self) -> bool {
        self.under_way > 0
    }

    /// The time limit.
    pub(crate) fn limit(&self) -> Option<Duration> {
        self.limit
    }

    /// When the run is broken off, counted as `now` is.
    pub(crate) fn deadline(&self) -> Option<Duration> {
        self.limit.map(|limit| limit + slack(limit).mul_f64(0.6))
    }

    /// While it is held no pass begins: `claim` says `Wait` instead.
    pub(crate) fn hold(&mut self, is_held: bool) {
        self.is_held = is_held;
    }

    /// Passes end before sample `end`, and none begins there: `claim` says `Wait` until there is another end,
    /// and `Done` if nothing is left that could give one.
    pub(crate) fn up_to(&mut self, end: u32) {
        self.ceiling = Some(end);
    }

    /// From now on passes cover what `allocation` says.
    pub(crate) fn allocate(&mut self, allocation: Allocation) {
        self.allocation = Some(allocation);
    }

    /// Pixels of a pass over `samples`.
    pub(crate) fn pixels(&self, samples: SampleRange) -> u64 {
        self.parts(samples).iter().map(|part| part.pixels()).sum()
    }

    fn parts(&self, samples: SampleRange) -> Vec<Rect> {
        match &self.allocation {
            None => vec![self.region],
            Some(allocation) => allocation.parts(self.region, samples),
        }
    }

    fn next(&mut self, now: Duration, size: TileSize<'_>) -> Claim {
        if let Some(item) = self.next_probe(now) {
            return Claim::Work(item);
        }
        if let Some(item) = self.returned.pop() {
            let pixels = size(item.samples.count());
            return Claim::Work(self.shrunk(item, pixels));
        }
        if self.pass.is_none() && self.rest.is_some() {
            if self.probe_rate == 0.0 && self.limit.is_some() {
                if self.under_way > 0 {
                    return Claim::Wait;
                }
                self.end_probes(now);
                if let Some(item) = self.next_probe(now) {
                    return Claim::Work(item);
                }
            }
            return self.start_pass(now, size);
        }
        if let Some(item) = self.pass.as_mut().and_then(|pass| pass.next(size)) {
            return Claim::Work(item);
        }
        if let Some(Pass { samples, replicate, .. }) = self.pass
            && replicate + 1 < self.replicates
        {
            return self.begin_pass(samples, replicate + 1, size);
        }
        self.start_pass(now, size)
    }

    /// An item that came back may be larger than tiles are by now: its other half waits.
    fn shrunk(&mut self, mut item: WorkItem, pixels: u64) -> WorkItem {
        while item.tile.pixels() > pixels
            && let Some((tile, rest)) = item.tile.halves()
        {
            self.returned.push(WorkItem { tile: rest, ..item });
            item.tile = tile;
        }
        item
    }

    /// A probe of this round, unless those that have ended took long enough.
    fn next_probe(&mut self, now: Duration) -> Option<WorkItem> {
        let item = self.probes.pop()?;
        let began = *self.started.get_or_insert(now);
        let enough = 4.0 * PROBED * self.limit.unwrap_or_default().as_secs_f64();
        if self.finished > 0 && now.saturating_sub(began).as_secs_f64() > enough {
            self.probes.clear();
            return None;
        }
        Some(item)
    }

    /// Takes the rate of a round of probes, or makes another one of larger tiles: small ones say little
    /// about a large film, on a GPU nothing at all.
    fn end_probes(&mut self, now: Duration) {
        let seconds = now.saturating_sub(self.started.unwrap_or(now)).as_secs_f64();
        let rate = (self.finished as f64 / seconds.max(1e-6)).max(1.0);
        self.finished = 0;
        self.started = None;
        let side = 2 * self.probe_side;
        let cost = u64::from(PROBES * side * side);
        let limit = self.limit.unwrap_or_default().as_secs_f64();
        if let Some(rest) = self.rest
            && seconds < PROBED * limit
            && cost <= self.region.pixels() / PROBED_PIXELS
        {
            self.probe_side = side;
            self.probes = probes(self.region, rest, side);
        } else {
            self.probe_rate = rate;
        }
    }

    fn start_pass(&mut self, now: Duration, size: TileSize<'_>) -> Claim {
        let Some(rest) = self.rest.filter(|_| self.stop.is_none() && !self.is_held) else {
            return self.ended();
        };
        let Some(mut pass) = self.first_part(rest) else { return self.ended() };
        if let Some(limit) = self.limit {
            let whole = self.samples_in(limit.saturating_sub(now), now);
            let fits = whole.saturating_mul(self.region.pixels()) / self.pixels(pass).max(1);
            if fits < u64::from(pass.count()) * u64::from(self.replicates) {
                self.stop = Some(Stop::TimeLimit);
                match self.part_in_time(pass, fits) {
                    Some(part) => pass = part,
                    None => return self.ended(),
                }
            }
        }
        self.rest = rest.after(pass);
        self.started.get_or_insert(now);
        self.begin_pass(pass, 0, size)
    }

    fn begin_pass(&mut self, samples: SampleRange, replicate: u32, size: TileSize<'_>) -> Claim {
        if self.is_held {
            return self.ended();
        }
        self.pass = Pass::new(samples, replicate, self.parts(samples));
        let first = self.pass.as_mut().and_then(|pass| pass.next(size));
        Claim::FirstOf(first.expect("a region has pixels, and so has every pass"))
    }

    /// The next pass: a batch. The first batch of replicates is cut at 1, 2, 4 and 8 samples, so that
    /// there is something to see early.
    fn first_part(&self, rest: SampleRange) -> Option<SampleRange> {
        let batch = rest.first_batch();
        let batch =
            SampleRange::new(batch.start, self.ceiling.map_or(batch.end, |c| c.min(batch.end)))?;
        if self.replicates == 1 || batch.start >= BATCH {
            return Some(batch);
        }
        let end = (2 * batch.start).max(1).min(batch.end);
        Some(SampleRange { start: batch.start, end })
    }

    /// What of the last pass still fits. The very first one always has at least one sample; it is broken
    /// off when time is up.
    fn part_in_time(&self, pass: SampleRange, fits: u64) -> Option<SampleRange> {
        let first = self.pass.is_none();
        if self.replicates > 1 {
            return first.then_some(pass);
        }
        let count = u32::try_from(fits).unwrap_or(0).max(u32::from(first));
        SampleRange::new(pass.start, pass.start + count)
    }

    /// While something is under way it may still come back.
    fn ended(&self) -> Claim {
        if self.under_way > 0 { Claim::Wait } else { Claim::Done }
    }

    /// Samples of every pixel that fit into `time`, after what is under way.
    fn samples_in(&self, time: Duration, now: Duration) -> u64 {
        let seconds = self.started.map_or(0.0, |from| now.saturating_sub(from).as_secs_f64());
        let measured = self.finished as f64 / seconds.max(1e-9);
        let enough = self.finished >= self.region.pixels();
        let rate = if enough { measured } else { TRUST * self.probe_rate };
        let cost = time.as_secs_f64() * rate - self.under_way as f64;
        // Saturates; negative is 0.
        #[expect(clippy::cast_possible_truncation, reason = "saturates on purpose")]
        let samples = (cost / self.region.pixels() as f64) as u64;
        samples
    }

    /// A claimed item has ended, well or not.
    pub(crate) fn finished(&mut self, item: &WorkItem) {
        self.under_way -= item.cost();
        self.finished += item.cost();
    }

    /// A claimed item was not rendered and waits for another try.
    pub(crate) fn give_back(&mut self, item: WorkItem) {
        self.under_way -= item.cost();
        if item.probe {
            self.probes.push(item);
        } else {
            self.returned.push(item);
        }
    }

    /// Starts no further pass; the current one goes on to its end. `Cancelled` ends it at once.
    pub(crate) fn stop(&mut self, why: Stop) {
        if self.stop.is_none() || why == Stop::Cancelled {
            self.stop = Some(why);
        }
        self.is_over |= why == Stop::Cancelled;
    }

    /// Why the run ended, once `claim` has said `Done`.
    pub(crate) fn why(&self) -> Stop {
        self.stop.unwrap_or(Stop::Complete)
    }
}

/// How much longer than `limit` a run may take: 10 %, or a second.
pub(crate) fn slack(limit: Duration) -> Duration {
    (limit / 10).max(Duration::from_secs(1))
}

/// Tiles spread over the region, one sample each.
fn probes(region: Rect, samples: SampleRange, side: u32) -> Vec<WorkItem> {
    let samples = SampleRange { start: samples.start, end: samples.start + 1 };
    let side = |len: u32| side.min(len);
    let at = |len: u32, share: u32, of: u32| {
        u32::try_from(u64::from(len - side(len)) * u64::from(share) / u64::from(of)).unwrap_or(0)
    };
    (0..PROBES)
        .map(|i| {
            let tile = Rect {
                // 7 and 16 have no common factor: every row share meets its own column share.
                x: region.x + at(region.w, i * 7 % PROBES, PROBES - 1),
                y: region.y + at(region.h, i, PROBES - 1),
                w: side(region.w),
                h: side(region.h),
            };
            WorkItem { tile, samples, replicate: 0, probe: true }
        })
        .collect()
}

#[cfg(test)]
mod tests;
