//! One view: the scene, where it is looked at from, and the picture so far, shared between the thread that renders and
//! those that serve pages.
//!
//! A change of scene or camera begins another epoch: what was rendered before it is broken off and counts no more.

use super::camera::View;
use super::curve::{self, Point};
use super::plane::{self, Absent, Kind, Plane};
use super::state::{Progress, Shot, Shown, State};
use super::sums::Sums;
use crate::control::Control;
use crate::job::Job;
use crate::pick::{Pick, PickError, pick};
use crate::region::SampleRange;
use crate::render::DeviceChoice;
use crate::scene::Scene;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// What is the same for all pictures of a session.
#[derive(Clone, Debug)]
pub struct Options {
    /// Image in pixels; `None`: as the scene says.
    pub size: Option<[u32; 2]>,
    /// Samples of every pixel; `None`: as the scene says.
    pub spp: Option<u32>,
    /// Threads of the CPU kernel; `None`: one for each logical CPU.
    pub threads: Option<usize>,
    /// Where to render.
    pub device: DeviceChoice,
}

/// A view.
pub struct Session {
    options: Options,
    state: Mutex<State>,
    changed: Condvar,
    /// Held while a layer is made: one at a time.
    making: Mutex<()>,
}

/// A picture that is wanted.
pub(super) struct Task {
    pub(super) scene: Arc<Scene>,
    /// For the whole image; samples are those of the first step.
    pub(super) job: Job,
    pub(super) spp: u32,
    pub(super) epoch: u64,
}

impl Session {
    /// A session without a scene.
    #[must_use]
    pub fn new(options: Options) -> Self {
        Self { options, state: Mutex::default(), changed: Condvar::new(), making: Mutex::new(()) }
    }

    /// Shows this scene from now on, from where the last one was looked at. `name` is that of its file.
    ///
    /// # Errors
    /// In words, when its picture cannot be rendered.
    pub fn show(&self, scene: Scene, name: &str) -> Result<(), String> {
        let mut job = Job::of_scene(&scene);
        if let Some(size) = self.options.size {
            job.resize(size);
        }
        job.check().map_err(|error| error.to_string())?;
        let camera = scene.pack().manifest().unwrap_or_default().cameras;
        let camera = camera.into_iter().next().map_or("camera".to_owned(), |camera| camera.name);
        let spp = self.options.spp.unwrap_or(job.spp());
        let shown = Shown {
            scene: Arc::new(scene),
            name: name.to_owned(),
            camera,
            size: job.image_size,
            spp,
        };
        let mut state = self.lock();
        let view = state.view.take();
        state.view = view.filter(|view| view.camera(&shown.scene).is_some());
        (state.scene, state.message) = (Some(shown), None);
        self.begin_epoch(&mut state);
        Ok(())
    }

    /// Says what is wrong, over the last good picture; `None`: nothing is.
    pub fn complain(&self, message: Option<String>) {
        self.change(|state| state.message = message);
    }

    /// Looks from there; `None`: as the scene says. False when that is no camera.
    pub fn look(&self, view: Option<View>) -> bool {
        let mut state = self.lock();
        let Some(shown) = &state.scene else { return false };
        if view.as_ref().is_some_and(|view| view.camera(&shown.scene).is_none()) {
            return false;
        }
        state.view = view;
        self.begin_epoch(&mut state);
        true
    }

    /// Stops, or goes on.
    pub fn stop(&self, is_stopped: bool) {
        self.change(|state| state.is_stopped = is_stopped);
    }

    /// Ends the session, and the run under way.
    pub fn close(&self) {
        let mut state = self.lock();
        state.is_over = true;
        state.running.iter().chain(&state.making).for_each(|run| run.cancel());
        self.tell(&mut state);
    }

    /// Whether it is closed.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.lock().is_over
    }

    /// The state as one line of JSON with its revision, once that is another one than `seen`; `None` when nothing has
    /// changed for `patience`, or the session is over.
    pub(super) fn news(&self, seen: u64, patience: Duration) -> Option<(u64, String)> {
        let same = |state: &mut State| state.revision == seen && !state.is_over;
        let waited = self.changed.wait_timeout_while(self.lock(), patience, same);
        let (state, waited) = waited.unwrap_or_else(PoisonError::into_inner);
        (!waited.timed_out() && !state.is_over).then(|| (state.revision, state.json()))
    }

    /// The newest picture.
    pub(super) fn shot(&self) -> Option<Arc<Shot>> {
        self.lock().shot.clone()
    }

    /// What is seen in a pixel of the whole image; `None` without a scene.
    pub fn pick(&self, pixel: [u32; 2]) -> Option<Result<Pick, PickError>> {
        let task = self.task(&self.lock())?;
        Some(pick(&task.scene, &task.job, pixel))
    }

    /// What the camera sees beside light. One layer is made at a time: who asks for another one breaks it off, and so
    /// does whoever changes scene or camera.
    pub(super) fn plane(&self, kind: Kind) -> Result<Arc<Plane>, Absent> {
        const NO_SCENE: Absent = Absent::Not("there is no scene yet");
        const NO_ERROR: Absent =
            Absent::Not("the error of a pixel needs a sample in each of the picture's four parts");
        let mut state = self.lock();
        let layer = match kind {
            Kind::Error => return state.errors.clone().ok_or(NO_ERROR),
            Kind::Layer(layer) => layer,
        };
        let task = self.task(&state).ok_or(NO_SCENE)?;
        let control = Arc::new(Control::default());
        if let Some(other) = state.making.replace(Arc::clone(&control)) {
            other.cancel();
        }
        drop(state);
        let _one = self.making.lock().unwrap_or_else(PoisonError::into_inner);
        if control.is_cancelled() {
            return Err(Absent::Stale);
        }
        let wanted = (layer, task.epoch);
        plane::make(&task.scene, &task.job, wanted, control.signals()).map(Arc::new)
    }

    fn task(&self, state: &State) -> Option<Task> {
        let shown = state.scene.as_ref()?;
        let mut job = Job::of_scene(&shown.scene);
        job.resize(shown.size);
        job.threads = self.options.threads;
        job.samples = SampleRange { start: 0, end: 1 };
        job.camera = state.view.as_ref().and_then(|view| view.camera(&shown.scene));
        Some(Task { scene: Arc::clone(&shown.scene), job, spp: shown.spp, epoch: state.epoch })
    }

    fn change(&self, change: impl FnOnce(&mut State)) {
        let mut state = self.lock();
        change(&mut state);
        self.tell(&mut state);
    }

    fn begin_epoch(&self, state: &mut State) {
        state.epoch += 1;
        state.progress = Progress::default();
        state.errors = None;
        state.curve.clear();
        state.running.iter().chain(&state.making).for_each(|run| run.cancel());
        self.tell(state);
    }

    fn tell(&self, state: &mut State) {
        state.revision += 1;
        self.changed.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The renderer's end.
impl Session {
    /// Where to render.
    pub(super) fn device(&self) -> &DeviceChoice {
        &self.options.device
    }

    /// The picture of a later epoch than `after`, once it is wanted; `None`: the session is over.
    pub(super) fn next_task(&self, after: u64) -> Option<Task> {
        let idle = |state: &mut State| state.epoch == after && !state.is_over;
        let state = self.changed.wait_while(self.lock(), idle);
        let state = state.unwrap_or_else(PoisonError::into_inner);
        if state.is_over { None } else { self.task(&state) }
    }

    /// Waits while the session is stopped. False when this epoch is not wanted any more.
    pub(super) fn wait_for_go(&self, epoch: u64) -> bool {
        let wait = |state: &mut State| state.is_stopped && state.is_wanted(epoch);
        let state = self.changed.wait_while(self.lock(), wait);
        state.unwrap_or_else(PoisonError::into_inner).is_wanted(epoch)
    }

    /// Announces a run of this epoch; a later one breaks it off if it has a control. False when it is not wanted any
    /// more.
    pub(super) fn begin(&self, epoch: u64, run: Option<&Arc<Control>>) -> bool {
        let mut state = self.lock();
        state.running = run.map(Arc::clone);
        state.is_wanted(epoch)
    }

    /// Shows what there is of this epoch; of an earlier one only where a picture is better than none.
    pub(super) fn publish(&self, task: &Task, size: [u32; 2], sums: &Sums, progress: Progress) {
        let (samples, bytes) = (sums.samples(), sums.bytes());
        let (channels, epoch) = (1, task.epoch);
        let errors =
            sums.errors().map(|values| Arc::new(Plane { size, channels, epoch, samples, values }));
        self.change(|state| {
            let id = state.shot.as_ref().map_or(0, |shot| shot.id) + 1;
            state.shot = Some(Arc::new(Shot { id, size, samples, bytes }));
            if state.epoch != task.epoch {
                return;
            }
            state.progress = progress;
            if let Some((errors, error)) = errors.zip(progress.error) {
                state.errors = Some(errors);
                let seconds = progress.seconds;
                curve::add(&mut state.curve, Point { samples, seconds, error });
            }
        });
    }

    /// The picture of this epoch cannot be rendered.
    pub(super) fn give_up(&self, epoch: u64, message: String) {
        self.change(|state| {
            if state.epoch == epoch {
                state.message = Some(message);
                state.progress.done = true;
            }
        });
    }
}
