//! What a session knows, and how the page is told.

use super::camera::{View, kind_of};
use super::curve::Point;
use super::plane::Plane;
use crate::control::Control;
use crate::scene::Scene;
use serde::Serialize;
use std::sync::Arc;

/// What is in the session's one lock.
#[derive(Default)]
pub(super) struct State {
    pub(super) scene: Option<Shown>,
    /// Instead of the pack's camera.
    pub(super) view: Option<View>,
    /// Another number means another picture: scene or camera have changed.
    pub(super) epoch: u64,
    pub(super) is_stopped: bool,
    pub(super) is_over: bool,
    /// The run that may be broken off when it is of an old epoch.
    pub(super) running: Option<Arc<Control>>,
    pub(super) shot: Option<Arc<Shot>>,
    pub(super) progress: Progress,
    /// Relative error of every pixel of this epoch, once it is known.
    pub(super) errors: Option<Arc<Plane>>,
    /// Errors of this epoch.
    pub(super) curve: Vec<Point>,
    /// The layer that is being made.
    pub(super) making: Option<Arc<Control>>,
    /// Counts changes of anything that the page is told.
    pub(super) revision: u64,
    /// What is wrong: with the text of the scene, with the pack, with the run.
    pub(super) message: Option<String>,
}

/// A scene and what is shown of it beside its picture.
#[derive(Clone)]
pub(super) struct Shown {
    pub(super) scene: Arc<Scene>,
    /// Of the file.
    pub(super) name: String,
    /// Of the camera.
    pub(super) camera: String,
    /// Image in pixels.
    pub(super) size: [u32; 2],
    /// Samples that are wanted.
    pub(super) spp: u32,
}

/// A picture at some moment.
pub(super) struct Shot {
    /// Grows from shot to shot.
    pub(super) id: u64,
    pub(super) size: [u32; 2],
    /// Samples of every pixel.
    pub(super) samples: u32,
    /// See `Sums::bytes`.
    pub(super) bytes: Vec<u8>,
}

/// How the picture comes along.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(super) struct Progress {
    /// Whether all samples are there.
    pub(super) done: bool,
    /// Relative error of the picture.
    pub(super) error: Option<f64>,
    pub(super) rays_per_second: f64,
    /// Of rendering.
    pub(super) seconds: f64,
    pub(super) seconds_left: Option<f64>,
}

/// The state as JSON.
#[derive(Serialize)]
struct Told<'a> {
    revision: u64,
    epoch: u64,
    scene: Option<&'a str>,
    size: Option<[u32; 2]>,
    spp: u32,
    /// `loading`, `rendering`, `stopped` or `done`.
    phase: &'static str,
    shot: Option<ToldShot>,
    #[serde(flatten)]
    progress: Progress,
    /// Samples of the picture whose error is known pixel by pixel.
    error_samples: Option<u32>,
    curve: &'a [Point],
    /// The camera that the picture is seen with, and that of the pack.
    view: Option<&'a View>,
    own_view: Option<View>,
    /// The type of both.
    camera: Option<String>,
    /// The declaration of the camera.
    text: Option<String>,
    /// Stops, and what the film is mapped with, as the scene says.
    exposure: f32,
    tone_map: u32,
    message: Option<&'a str>,
}

#[derive(Serialize)]
struct ToldShot {
    id: u64,
    size: [u32; 2],
    samples: u32,
}

impl State {
    /// One line of JSON.
    pub(super) fn json(&self) -> String {
        let own = self.scene.as_ref().map(|shown| View::of(&shown.scene));
        let view = self.view.as_ref().or(own.as_ref());
        let settings = self.scene.as_ref().map(|shown| *shown.scene.settings());
        let told = Told {
            revision: self.revision,
            epoch: self.epoch,
            scene: self.scene.as_ref().map(|shown| shown.name.as_str()),
            size: self.scene.as_ref().map(|shown| shown.size),
            spp: self.scene.as_ref().map_or(0, |shown| shown.spp),
            phase: self.phase(),
            shot: self.shot.as_ref().map(|shot| {
                let Shot { id, size, samples, .. } = **shot;
                ToldShot { id, size, samples }
            }),
            progress: self.progress,
            error_samples: self.errors.as_ref().map(|errors| errors.samples),
            curve: &self.curve,
            view,
            own_view: own.clone(),
            camera: self.scene.as_ref().map(|shown| kind_of(shown.scene.pack().camera()).stem()),
            text: view
                .zip(self.scene.as_ref())
                .map(|(view, shown)| view.text(&shown.camera, shown.scene.pack().camera())),
            exposure: settings.map_or(0.0, |settings| settings.exposure),
            tone_map: settings.map_or(0, |settings| settings.tone_map),
            message: self.message.as_deref(),
        };
        serde_json::to_string(&told).expect("numbers, texts and lists become JSON")
    }

    /// Whether pictures of this epoch are.
    pub(super) fn is_wanted(&self, epoch: u64) -> bool {
        self.epoch == epoch && !self.is_over
    }

    fn phase(&self) -> &'static str {
        if self.scene.is_none() {
            "loading"
        } else if self.progress.done {
            "done"
        } else if self.is_stopped {
            "stopped"
        } else {
            "rendering"
        }
    }
}
