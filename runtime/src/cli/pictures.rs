//! Pictures of a run → the outputs: those of a run that goes on, and the last one.
//!
//! Each is written whole, so whoever opens an output finds a picture in it, with more samples each time. A picture
//! that cannot be written while the run goes on is told once and costs nothing else: the last one finds its way.

use super::args::RenderArgs;
use super::console::Console;
use super::denoise::denoise;
use super::exit::Exit;
use super::outputs::{Output, save};
use super::values::Every;
use super::viewer::Viewer;
use crate::denoise::Denoiser;
use crate::job::Job;
use crate::output::{self, Picture};
use crate::preview::Preview;
use files::ShowPath as _;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Time between two pictures.
const EVERY: Duration = Duration::from_secs(5);
/// Where somebody looks on.
const EVERY_LIVE: Duration = Duration::from_secs(1);

/// Where the pictures of a run go.
pub(super) struct Pictures<'a> {
    console: &'a Console,
    outputs: &'a [Output],
    viewer: Option<Arc<Mutex<Viewer>>>,
    denoiser: Option<Denoiser>,
}

impl<'a> Pictures<'a> {
    /// Opens the viewer that is asked for.
    pub(super) fn new(
        args: &RenderArgs,
        console: &'a Console,
        outputs: &'a [Output],
        job: &Job,
        denoiser: Option<Denoiser>,
    ) -> Self {
        let name = args.pack.as_deref().and_then(Path::file_stem).unwrap_or_default();
        let name = name.to_string_lossy();
        let viewer = args
            .tev
            .as_ref()
            .map(|place| Arc::new(Mutex::new(Viewer::new(console, place, &name, job.image_size))));
        Self { console, outputs, viewer, denoiser }
    }

    /// What writes the pictures of a run that goes on, where that is wanted. A stream gets them only when
    /// `--write-every` asks for it: a file that is made of one would be several pictures.
    pub(super) fn preview(&self, args: &RenderArgs) -> Option<Preview> {
        let (every, files, streams) = match (args.write_every, &self.viewer) {
            (None, None) => (EVERY, true, false),
            (None, Some(_)) => (EVERY_LIVE, true, false),
            (Some(Every::After(every)), _) => (every, true, true),
            (Some(Every::Never), Some(_)) => (EVERY_LIVE, false, false),
            (Some(Every::Never), None) => return None,
        };
        let wanted =
            |output: &&Output| if files::is_stream(&output.path) { streams } else { files };
        let outputs: Vec<_> = self.outputs.iter().filter(wanted).cloned().collect();
        if outputs.is_empty() && self.viewer.is_none() {
            return None;
        }
        let (console, warned) = (self.console.clone(), AtomicBool::new(false));
        let viewer = self.viewer.clone();
        let show = move |picture: &Picture| {
            show_in(viewer.as_ref(), picture);
            for output in &outputs {
                if let Err(error) = replace(output, picture, true)
                    && !warned.swap(true, Ordering::Relaxed)
                {
                    let path = output.path.shown();
                    console.warn(&format!(
                        "warning: {error}; rendering continues, and {path} is written at the end"
                    ));
                }
            }
        };
        Some(Preview { every, show: Box::new(show) })
    }

    /// Denoises the last picture, where that is asked for. `None` when all is well; `residual` as for `output::encode`.
    pub(super) fn denoise(&self, picture: &mut Picture, residual: bool) -> Option<Exit> {
        let denoiser = self.denoiser.as_ref()?;
        if picture.layers.is_none() {
            self.console.note("warning: the picture is not denoised");
            return None;
        }
        // Whatever becomes of a library that is not ours, the samples are on the disk before.
        self.keep(picture, residual);
        denoise(self.console, denoiser, picture).err()
    }

    /// Puts a picture that is not the last one into the files, without a word: it is there if nothing comes after it.
    fn keep(&self, picture: &Picture, residual: bool) {
        for output in self.outputs.iter().filter(|output| !files::is_stream(&output.path)) {
            // What cannot be written now is said of the last picture.
            let _ = replace(output, picture, residual);
        }
    }

    /// Writes the last picture, to every output; `residual` as for `output::encode`. `None` when all is well.
    pub(super) fn write(&self, picture: &Picture, residual: bool) -> Option<Exit> {
        show_in(self.viewer.as_ref(), picture);
        let mut failed = None;
        for Output { path, format } in self.outputs {
            let written = match output::encode(*format, picture, residual) {
                Ok(bytes) => save(self.console, path, &bytes),
                Err(error) => Err(self.console.fail(&error, Exit::Bug)),
            };
            // The other file may still succeed.
            failed = written.err().or(failed);
        }
        failed
    }
}

fn show_in(viewer: Option<&Arc<Mutex<Viewer>>>, picture: &Picture) {
    if let Some(viewer) = viewer {
        viewer.lock().unwrap_or_else(PoisonError::into_inner).show(picture);
    }
}

/// Puts a picture of a run that goes on in the place of what is there; `residual` as for `output::encode`.
fn replace(output: &Output, picture: &Picture, residual: bool) -> Result<(), String> {
    // What is no part of a picture is never merged.
    let residual = residual && picture.film.samples().0 > 0 && picture.film.is_even();
    let bytes =
        output::encode(output.format, picture, residual).map_err(|error| error.to_string())?;
    files::write(&output.path, |out| out.write_all(&bytes)).map_err(|error| error.to_string())
}
