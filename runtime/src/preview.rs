//! Films on their way → pictures for whoever waits, every so often, on a thread of its own.
//!
//! The run offers its film after every tile, as it does to the saver; a copy is taken only when a picture is due and
//! another batch is whole. So rendering waits for a copy in memory and never for an encoder or a disk, and no
//! picture depends on it. It does not know formats or files.

use crate::film::Film;
use crate::job::Job;
use crate::memory;
use crate::output::{Meta, Picture};
use crate::signals::Signals;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Before this time of a run no picture is shown: it may be over by then.
const FIRST: Duration = Duration::from_secs(1);
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

/// Shows the pictures of one run.
pub(crate) struct Previewer {
    preview: Arc<Preview>,
    /// Sample after the last one: a film that has it is the picture, and shown by whoever started the run.
    last: u32,
    state: Mutex<State>,
    wake: Condvar,
}

struct State {
    /// When the next picture is due.
    next: Instant,
    /// Last sample of the newest picture, plus one.
    end: u32,
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
    pub(crate) fn new(preview: Arc<Preview>, job: &Job) -> Self {
        let next = Instant::now() + preview.every.min(FIRST);
        let (task, last) = (Task::Nothing, job.samples.end);
        let state = Mutex::new(State { next, end: 0, task, over: false, warned: false });
        Self { preview, last, state, wake: Condvar::new() }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes a copy of the film if it is time to, framed in what `meta` gives.
    pub(crate) fn offer(&self, film: &Film, signals: &Signals, meta: impl FnOnce() -> Meta) {
        let mut state = self.lock();
        let end = film.ranges.last().map_or(0, |range| range.end);
        let is_news = end > state.end && end < self.last;
        let is_idle = matches!(state.task, Task::Nothing) && !state.over;
        if !is_news || !is_idle || Instant::now() < state.next {
            return;
        }
        let pixels = film.region.pixels();
        let copy = if memory::has_room_to_write(pixels) { film.try_clone().ok() } else { None };
        let Some(film) = copy else {
            state.next = Instant::now() + self.preview.every;
            if !std::mem::replace(&mut state.warned, true) {
                signals
                    .note("warning: too little memory to write the picture while it is rendered");
            }
            return;
        };
        state.end = end;
        state.task = Task::Show(Box::new(Picture::new(film, meta())));
        drop(state);
        self.wake.notify_all();
    }

    /// Shows what is offered until `close`.
    pub(crate) fn work(&self, signals: &Signals) {
        let mut state = self.lock();
        loop {
            match std::mem::replace(&mut state.task, Task::Nothing) {
                // The last picture follows, and is newer.
                _ if state.over => return,
                Task::Show(picture) => {
                    state.task = Task::UnderWay;
                    drop(state);
                    let began = Instant::now();
                    // The copy was taken before this is asked, so what is wrong with it is known by now.
                    if signals.may_keep() && !signals.is_cancelled() {
                        (self.preview.show)(&picture);
                    }
                    drop(picture);
                    let pause = self.preview.every.max(PATIENCE * began.elapsed());
                    state = self.lock();
                    state.task = Task::Nothing;
                    state.next = Instant::now() + pause;
                    self.wake.notify_all();
                }
                _ => state = self.wake.wait(state).unwrap_or_else(PoisonError::into_inner),
            }
        }
    }

    /// Ends `work`: no picture is begun any more, and one that is being shown is waited for a little.
    pub(crate) fn close(&self) {
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
    use std::sync::mpsc;

    fn film(end: u32) -> Film {
        let mut film = Film::new([4, 2], Rect::whole([4, 2]));
        film.ranges = vec![SampleRange { start: 0, end }];
        film
    }

    fn previewer(every: Duration) -> (Previewer, mpsc::Receiver<u32>) {
        let (send, receive) = mpsc::channel();
        let show = move |picture: &Picture| {
            let end = picture.film.ranges.last().map_or(0, |range| range.end);
            send.send(end).expect("somebody listens");
        };
        let state =
            State { next: Instant::now(), end: 0, task: Task::Nothing, over: false, warned: false };
        let preview = Arc::new(Preview { every, show: Box::new(show) });
        (Previewer { preview, last: 64, state: Mutex::new(state), wake: Condvar::new() }, receive)
    }

    #[test]
    fn only_news_is_shown_and_not_the_last_picture() {
        let (previewer, shown) = previewer(Duration::ZERO);
        let signals = Signals::new(|_| ());
        std::thread::scope(|scope| {
            scope.spawn(|| previewer.work(&signals));
            let until_idle = || {
                while !matches!(previewer.lock().task, Task::Nothing) {
                    std::thread::yield_now();
                }
                previewer.lock().next = Instant::now();
            };
            for end in [0, 16, 16, 32, 64] {
                previewer.offer(&film(end), &signals, Meta::default);
                until_idle();
            }
            previewer.close();
            previewer.offer(&film(48), &signals, Meta::default);
        });
        drop(previewer);
        assert_eq!(shown.iter().collect::<Vec<_>>(), [16, 32]);
    }

    #[test]
    fn two_pictures_have_time_between_them() {
        let (previewer, shown) = previewer(Duration::from_hours(1));
        let signals = Signals::new(|_| ());
        std::thread::scope(|scope| {
            scope.spawn(|| previewer.work(&signals));
            previewer.offer(&film(16), &signals, Meta::default);
            assert_eq!(shown.recv(), Ok(16));
            while !matches!(previewer.lock().task, Task::Nothing) {
                std::thread::yield_now();
            }
            previewer.offer(&film(32), &signals, Meta::default);
            previewer.close();
        });
        drop(previewer);
        assert_eq!(shown.iter().count(), 0);
    }
}
