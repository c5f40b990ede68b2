//! Films on their way → pictures for whoever waits, every so often, on a thread of its own.
//!
//! The first one is coarse, one sample for a block of pixels, unless a batch is whole by then. After that the run offers
//! what it has after every tile, as it does to the saver; a copy is taken only when a picture is due and another batch is
//! whole, or when that takes long: then the tiles that have arrived count. So rendering waits for a copy in memory and
//! never for an encoder or a disk, and no picture depends on it. It does not know formats or files.

use crate::film::{Accumulator, Film};
use crate::job::Job;
use crate::memory;
use crate::output::{Meta, Picture};
use crate::signals::Signals;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A run that is over, or has a whole batch, before this time has no coarse picture.
const FIRST: Duration = Duration::from_millis(100);
/// Before this time of a run no other picture is shown: it may be over by then.
const SECOND: Duration = Duration::from_secs(1);
/// Time between two pictures over the time that one takes: 5 % of one thread, at most.
const PATIENCE: u32 = 20;
/// How long the end of a run that hangs waits for a picture that is being shown.
const GRACE: Duration = Duration::from_secs(1);

/// Pictures of a run that goes on.
pub struct Preview {
    /// Least time between two of them.
    pub every: Duration,
    /// Is given each of them, whole and newer than the one before, on a thread of its own.
    pub show: Box<dyn Fn(&Picture) + Send + Sync>,
}

/// What is shown of pixels that have no samples.
pub(crate) struct Coarse {
    /// Side in pixels of the blocks that share a sample.
    pub(crate) block: u32,
    /// Of the run's size, with that sample's radiance as sums, and counts of zero.
    pub(crate) film: Film,
}

/// Shows the pictures of one run.
pub(crate) struct Previewer {
    preview: Arc<Preview>,
    /// Sample after the last one: a film that has it is the picture, and shown by whoever started the run.
    last: u32,
    state: Mutex<State>,
    wake: Condvar,
    /// Break the coarse picture off.
    coarse: Signals,
}

struct State {
    /// When the next picture is due.
    next: Instant,
    /// Last sample of the newest picture that was shown, plus one.
    end: u32,
    /// The same of the newest whole batch, and when it was new.
    whole: (u32, Instant),
    coarse: Option<Arc<Coarse>>,
    task: Task,
    over: bool,
    warned: bool,
}

/// What the thread has to do.
enum Task {
    Nothing,
    Show(Box<Picture>),
    /// It is at it.
    UnderWay,
}

impl Previewer {
    /// Of a run of `job` that has all samples before `done` already.
    pub(crate) fn new(preview: Arc<Preview>, job: &Job, done: u32) -> Self {
        let now = Instant::now();
        let state = State {
            next: now + preview.every.min(SECOND),
            end: 0,
            whole: (done, now),
            coarse: None,
            task: Task::Nothing,
            over: false,
            warned: false,
        };
        let (state, wake) = (Mutex::new(state), Condvar::new());
        Self { preview, last: job.samples.end, state, wake, coarse: Signals::new(|_| ()) }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes a copy of what has arrived if it is time to, framed in what `meta` gives.
    pub(crate) fn offer(&self, sum: &Accumulator, signals: &Signals, meta: impl FnOnce() -> Meta) {
        let (mut state, now) = (self.lock(), Instant::now());
        let film = sum.film();
        let end = film.ranges.last().map_or(0, |range| range.end);
        if end > state.whole.0 {
            state.whole = (end, now);
            self.coarse.cancel();
        }
        let is_news = end > state.end;
        let is_slow = now.saturating_duration_since(state.whole.1) >= self.preview.every
            // Where nothing stands in, what has not arrived would be black.
            && (end > 0 || state.coarse.is_some());
        let is_idle = matches!(state.task, Task::Nothing) && !state.over;
        let is_due = is_idle && now >= state.next && end < self.last;
        if !is_due || !(is_news || is_slow) {
            return;
        }
        if end > 0 {
            state.coarse = None;
        }
        let coarse = state.coarse.clone();
        let stand_in = coarse.as_ref().map(|coarse| coarse.film.sums.as_slice());
        let copy = || if is_news { film.try_clone() } else { sum.so_far(stand_in) };
        let room = memory::has_room_to_write(film.region.pixels());
        let Some(film) = room.then(copy).and_then(Result::ok) else {
            state.next = now + self.preview.every;
            if !std::mem::replace(&mut state.warned, true) {
                signals
                    .note("warning: too little memory to write the picture while it is rendered");
            }
            return;
        };
        state.end = end;
        let meta = Meta { coarse_block: coarse.map(|coarse| coarse.block), ..meta() };
        state.task = Task::Show(Box::new(Picture::new(film, meta)));
        drop(state);
        self.wake.notify_all();
    }

    /// Shows what `coarse` gives first, framed in what `meta` gives, then what is offered until `close`.
    pub(crate) fn work(
        &self,
        signals: &Signals,
        coarse: impl FnOnce(&Signals) -> Option<Coarse>,
        meta: impl FnOnce() -> Meta,
    ) {
        if self.has_nothing_after(FIRST)
            && let Some(coarse) = coarse(&self.coarse)
        {
            self.begin_with(coarse, meta);
        }
        let mut state = self.lock();
        loop {
            match std::mem::replace(&mut state.task, Task::Nothing) {
                // The last picture follows, and is newer.
                _ if state.over => return,
                Task::Show(picture) => {
                    state.task = Task::UnderWay;
                    drop(state);
                    let pause = self.show(*picture, signals);
                    state = self.lock();
                    state.task = Task::Nothing;
                    state.next = Instant::now() + pause;
                    self.wake.notify_all();
                }
                _ => state = self.wake.wait(state).unwrap_or_else(PoisonError::into_inner),
            }
        }
    }

    /// Waits so long for the first batch, or the end of the run; whether neither came.
    fn has_nothing_after(&self, time: Duration) -> bool {
        let waits = |state: &mut State| !state.over && state.whole.0 == 0;
        let wait = self.wake.wait_timeout_while(self.lock(), time, waits);
        wait.unwrap_or_else(PoisonError::into_inner).1.timed_out()
    }

    /// Makes the coarse picture the next one, unless there is a better one by now.
    fn begin_with(&self, coarse: Coarse, meta: impl FnOnce() -> Meta) {
        let meta = Meta { coarse_block: Some(coarse.block), ..meta() };
        let mut state = self.lock();
        let is_wanted = matches!(state.task, Task::Nothing) && state.whole.0 == 0;
        if is_wanted && let Ok(film) = coarse.film.try_clone() {
            state.task = Task::Show(Box::new(Picture::new(film, meta)));
            state.coarse = Some(Arc::new(coarse));
        }
    }

    /// Shows a picture; the least time until the next one.
    fn show(&self, picture: Picture, signals: &Signals) -> Duration {
        let began = Instant::now();
        let is_first = picture.film.samples().1 == 0;
        // The copy was taken before this is asked, so what is wrong with it is known by now.
        if signals.may_keep() && !signals.is_cancelled() {
            (self.preview.show)(&picture);
            if let Some(block) = picture.meta.coarse_block.filter(|_| is_first) {
                signals.note(&format!(
                    "first picture: coarse, a sample for each {block}x{block} pixels"
                ));
            }
        }
        drop(picture);
        let every = self.preview.every;
        let every = if is_first { every.min(SECOND) } else { every };
        every.max(PATIENCE * began.elapsed())
    }

    /// Ends `work`: no picture is begun any more, and one that is being shown is waited for a little.
    pub(crate) fn close(&self) {
        self.coarse.cancel();
        let mut state = self.lock();
        state.over = true;
        self.wake.notify_all();
        let busy = |state: &mut State| matches!(state.task, Task::UnderWay);
        drop(self.wake.wait_timeout_while(state, GRACE, busy));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::region::{Rect, SampleRange};
    use crate::schedule::WorkItem;
    use pack::abi::FilmPixel;
    use std::sync::mpsc;

    const HOUR: Duration = Duration::from_hours(1);
    const REGION: Rect = Rect { x: 0, y: 0, w: 16, h: 8 };

    fn film() -> Film {
        Film::new([16, 8], REGION)
    }

    fn sum(end: u32) -> Accumulator {
        let ranges = SampleRange::new(0, end).into_iter().collect();
        Accumulator::new(Film { ranges, ..film() }).expect("it is small")
    }

    /// With pictures of its own: last sample of a batch plus one, radiance of the last pixel, most samples of a pixel.
    fn previewer(every: Duration) -> (Previewer, mpsc::Receiver<(u32, f64, u32)>) {
        let (send, receive) = mpsc::channel();
        let show = move |picture: &Picture| {
            let film = &picture.film;
            let end = film.ranges.last().map_or(0, |range| range.end);
            send.send((end, film.mean(127)[0], film.samples().1)).expect("somebody listens");
        };
        let now = Instant::now();
        let state = State {
            next: now,
            end: 0,
            whole: (0, now),
            coarse: None,
            task: Task::Nothing,
            over: false,
            warned: false,
        };
        let preview = Arc::new(Preview { every, show: Box::new(show) });
        let (state, wake) = (Mutex::new(state), Condvar::new());
        (Previewer { preview, last: 64, state, wake, coarse: Signals::new(|_| ()) }, receive)
    }

    fn wait_until_idle(previewer: &Previewer) {
        while !matches!(previewer.lock().task, Task::Nothing) {
            std::thread::yield_now();
        }
    }

    fn work(previewer: &Previewer, signals: &Signals) {
        previewer.work(signals, |_| None, Meta::default);
    }

    #[test]
    fn only_news_is_shown_and_not_the_last_picture() {
        let (previewer, shown) = previewer(HOUR);
        let signals = Signals::new(|_| ());
        std::thread::scope(|scope| {
            scope.spawn(|| work(&previewer, &signals));
            for end in [0, 16, 16, 32, 64] {
                previewer.offer(&sum(end), &signals, Meta::default);
                wait_until_idle(&previewer);
                previewer.lock().next = Instant::now();
            }
            previewer.close();
            previewer.offer(&sum(48), &signals, Meta::default);
        });
        drop(previewer);
        assert_eq!(shown.iter().map(|(end, ..)| end).collect::<Vec<_>>(), [16, 32]);
    }

    #[test]
    fn two_pictures_have_time_between_them() {
        let (previewer, shown) = previewer(HOUR);
        let signals = Signals::new(|_| ());
        std::thread::scope(|scope| {
            scope.spawn(|| work(&previewer, &signals));
            previewer.offer(&sum(16), &signals, Meta::default);
            assert_eq!(shown.recv().map(|(end, ..)| end), Ok(16));
            wait_until_idle(&previewer);
            previewer.offer(&sum(32), &signals, Meta::default);
            previewer.close();
        });
        drop(previewer);
        assert_eq!(shown.iter().count(), 0);
    }

    /// A batch of which half the pixels have arrived.
    fn half_a_batch() -> Accumulator {
        let mut sum = sum(0);
        let samples = SampleRange { start: 0, end: 16 };
        let (tile, _) = REGION.halves().expect("it is large");
        assert!(sum.has_room());
        sum.open(samples, 0, REGION.pixels());
        let item = WorkItem { tile, samples, replicate: 0, probe: false };
        sum.deposit(&item, &[FilmPixel::default(); 64]);
        sum
    }

    #[test]
    fn a_long_batch_is_shown_tile_by_tile_over_a_coarse_picture() {
        let (previewer, shown) = previewer(Duration::from_millis(1));
        let signals = Signals::new(|_| ());
        let coarse = |_: &Signals| {
            Some(Coarse { block: 4, film: Film { sums: vec![[7.0; 3]; 128], ..film() } })
        };
        std::thread::scope(|scope| {
            scope.spawn(|| previewer.work(&signals, coarse, Meta::default));
            assert_eq!(shown.recv(), Ok((0, 7.0, 0)));
            std::thread::sleep(Duration::from_millis(2));
            wait_until_idle(&previewer);
            previewer.lock().next = Instant::now();
            previewer.offer(&half_a_batch(), &signals, Meta::default);
            assert_eq!(shown.recv(), Ok((0, 7.0, 16)));
            previewer.close();
        });
    }

    #[test]
    fn a_run_that_has_a_batch_at_once_needs_no_coarse_picture() {
        let (previewer, shown) = previewer(HOUR);
        let signals = Signals::new(|_| ());
        previewer.offer(&sum(16), &signals, Meta::default);
        let coarse = |_: &Signals| -> Option<Coarse> { unreachable!("there is a better one") };
        std::thread::scope(|scope| {
            scope.spawn(|| previewer.work(&signals, coarse, Meta::default));
            assert_eq!(shown.recv().map(|(end, ..)| end), Ok(16));
            previewer.close();
        });
    }
}
