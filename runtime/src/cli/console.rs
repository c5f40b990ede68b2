//! What the user sees: results on stdout, everything else on stderr, progress while it renders.

use super::args::{ProgressArg, RenderArgs};
use super::change::Change;
use super::exit::Exit;
use super::progress::{self, Line, Wanted};
use crate::control::Control;
use files::ShowPath as _;
use indicatif::{ProgressBar, ProgressStyle};
use std::error::Error;
use std::io::{IsTerminal as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, Once};
use std::time::{Duration, Instant};

/// How often the terminal is refreshed and an interrupt is looked for.
const TICK: Duration = Duration::from_millis(100);
/// From an interrupt to the end of a run that does not end by itself: two seconds less what it takes to
/// write.
const PATIENCE: Duration = Duration::from_millis(1200);
/// Between two plain lines.
const LINE: Duration = Duration::from_secs(5);
/// Between two lines for programs.
const JSON_LINE: Duration = Duration::from_secs(1);

/// Whether a result could not be written to standard output.
static LOST: AtomicBool = AtomicBool::new(false);

/// Whether a result could not be printed since the last call.
pub(super) fn has_lost_output() -> bool {
    LOST.swap(false, Ordering::Relaxed)
}

/// Prints for one command.
#[derive(Clone)]
pub(super) struct Console {
    quiet: bool,
    /// Standard output carries a picture: results go where everything else goes.
    beside: bool,
    /// Every line on stderr is an object of JSON.
    json: bool,
    bar: ProgressBar,
}

impl Console {
    pub(super) fn new(quiet: bool) -> Self {
        Self { quiet, beside: false, json: false, bar: ProgressBar::hidden() }
    }

    /// With a bar, when stderr is a terminal.
    pub(super) fn with_progress(quiet: bool) -> Self {
        if quiet || !std::io::stderr().is_terminal() {
            return Self::new(quiet);
        }
        let bar = ProgressBar::new(1000);
        let style = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        bar.set_style(style);
        Self { quiet, beside: false, json: false, bar }
    }

    /// For a render: with a bar, or for programs that read stderr: then every line is an object of JSON, and one a
    /// second says how far the run is.
    pub(super) fn of_render(args: &RenderArgs) -> Self {
        match args.progress {
            ProgressArg::Text => Self::with_progress(args.quiet),
            ProgressArg::Json => Self { json: true, ..Self::new(false) },
        }
    }

    /// The same console for a command with these outputs.
    pub(super) fn beside(mut self, outputs: &[PathBuf]) -> Self {
        self.beside = outputs.iter().any(|path| files::is_stream(path));
        self
    }

    /// A line of the result.
    pub(super) fn result(&self, text: &str) {
        if self.quiet {
            return;
        }
        if self.beside {
            return self.note(text);
        }
        let written = self.bar.suspend(|| files::write_stdout(&format!("{text}\n")));
        if let Err(error) = written
            && !LOST.swap(true, Ordering::Relaxed)
        {
            self.warn(&format!("error: cannot write to standard output: {error}"));
        }
    }

    /// A line about the run.
    pub(super) fn note(&self, text: &str) {
        if !self.quiet {
            self.warn(text);
        }
    }

    /// A line that quiet does not silence.
    pub(super) fn warn(&self, text: &str) {
        if self.json {
            return to_stderr(&progress::message(text));
        }
        self.bar.suspend(|| to_stderr(&files::escape_lines(text)));
    }

    /// How far a run is, where programs read that.
    pub(super) fn progress(&self, line: impl FnOnce() -> Line) {
        if self.json {
            to_stderr(&line().json());
        }
    }

    /// One line for an error and its causes.
    pub(super) fn fail(&self, error: &dyn Error, exit: Exit) -> Exit {
        self.warn(&format!("error: {}", with_causes(error)));
        exit
    }

    /// As `fail`, with the file that it is about, unless the error names it itself.
    pub(super) fn fail_about(&self, path: &Path, error: &dyn Error, exit: Exit) -> Exit {
        let (path, text) = (path.shown().to_string(), with_causes(error));
        let about = if text.contains(&path) { String::new() } else { format!("{path}: ") };
        self.warn(&format!("error: {about}{text}"));
        exit
    }

    /// Passes an interrupt on, and shows nothing, until `over` is set; ends the process when nothing
    /// comes of it.
    #[cfg(feature = "gpu")]
    pub(super) fn pass_interrupts(&self, control: &Control, over: &AtomicBool) {
        let mut interrupt = Interrupt::default();
        while !over.load(Ordering::Relaxed) {
            if interrupt.pass_on(control) {
                self.note("interrupted: reporting what is complete (press again to quit at once)");
            }
            if interrupt.is_ignored() {
                self.give_up();
            }
            std::thread::park_timeout(TICK);
        }
        self.bar.finish_and_clear();
    }

    /// Ends the process although something hangs.
    pub(super) fn give_up(&self) -> ! {
        self.bar.finish_and_clear();
        self.warn("warning: the kernel or the driver hangs");
        quit(Exit::Interrupted)
    }

    /// Shows which share of some work is done, where there is a bar.
    pub(super) fn advance(&self, share: f64, text: &'static str) {
        #[expect(clippy::cast_possible_truncation, reason = "at most 1000")]
        self.bar.set_position((share * 1000.0) as u64);
        self.bar.set_message(text);
    }

    /// Takes the bar away.
    pub(super) fn end_progress(&self) {
        self.bar.finish_and_clear();
    }

    /// Shows progress and passes interrupts on until `over` is set. `rescue` is called, again and again,
    /// while a run does not end that should have.
    pub(super) fn watch(
        &self,
        control: &Control,
        watched: &Watched<'_>,
        over: &AtomicBool,
        rescue: &dyn Fn(),
    ) {
        let started = Instant::now();
        let mut interrupt = Interrupt::default();
        let mut last_line = started;
        while !over.load(Ordering::Relaxed) {
            if interrupt.pass_on(control) {
                self.note("interrupted: writing what is complete (press again to quit at once)");
            }
            if interrupt.is_ignored() || control.is_overdue() {
                rescue();
            }
            if let Some(change) = watched.change
                && !control.is_cancelled()
                && change.has_come()
            {
                control.cancel();
            }
            let elapsed = started.elapsed();
            let progress = control.progress();
            if self.json {
                if last_line.elapsed() >= JSON_LINE {
                    last_line = Instant::now();
                    let latest = control.latest();
                    self.progress(|| Line::of(progress, &watched.wanted, elapsed, latest));
                }
                std::thread::park_timeout(TICK);
                continue;
            }
            let text = progress::text(progress, &watched.wanted, elapsed);
            if self.bar.is_hidden() {
                if last_line.elapsed() >= LINE {
                    last_line = Instant::now();
                    self.note(&text);
                }
            } else {
                let share = progress.done as f64 / progress.total.max(1) as f64;
                #[expect(clippy::cast_possible_truncation, reason = "at most 1000")]
                self.bar.set_position((share * 1000.0) as u64);
                self.bar.set_message(text);
            }
            std::thread::park_timeout(TICK);
        }
        self.bar.finish_and_clear();
    }
}

/// What a run is watched for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Watched<'a> {
    /// What is wanted of it.
    pub(super) wanted: Wanted,
    /// A change that makes the run pointless.
    pub(super) change: Option<&'a Change>,
}

/// One line.
fn to_stderr(text: &str) {
    // Where errors cannot be written there is nobody to tell.
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// An interrupt on its way to a run.
#[derive(Default)]
struct Interrupt {
    passed: Option<Instant>,
}

impl Interrupt {
    /// Cancels the run when there was an interrupt; true when that is news.
    fn pass_on(&mut self, control: &Control) -> bool {
        let is_news = self.passed.is_none() && is_interrupted();
        if is_news {
            self.passed = Some(Instant::now());
            control.cancel();
        }
        is_news
    }

    /// Whether the run should have ended by now.
    fn is_ignored(&self) -> bool {
        self.passed.is_some_and(|passed| passed.elapsed() >= PATIENCE)
    }
}

/// Number of Ctrl-C, SIGTERM and SIGHUP so far. The first lets a run write what is complete, the second
/// ends the process.
fn interrupts() -> &'static Arc<AtomicU32> {
    static COUNT: std::sync::OnceLock<Arc<AtomicU32>> = std::sync::OnceLock::new();
    static HANDLER: Once = Once::new();
    let count = COUNT.get_or_init(Arc::default);
    HANDLER.call_once(|| {
        let count = Arc::clone(count);
        // Without it an interrupt ends the process at once.
        let _ = host::on_interrupt(move || {
            if count.fetch_add(1, Ordering::Relaxed) > 0 {
                quit(Exit::Interrupted);
            }
        });
    });
    count
}

/// Ends the process now, whatever hangs.
pub(super) fn quit(exit: Exit) -> ! {
    // Lines are written when they end; there is nobody to tell if that fails.
    let _ = std::io::stdout().flush();
    host::exit_now(exit as u8)
}

/// Whether there was a Ctrl-C since `reset_interrupts`.
pub(super) fn is_interrupted() -> bool {
    interrupts().load(Ordering::Relaxed) > 0
}

/// Makes the next Ctrl-C a first one again, and has them counted from now on.
pub(super) fn reset_interrupts() {
    interrupts().store(0, Ordering::Relaxed);
}

/// The error with its causes, each said once.
fn with_causes(error: &dyn Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(inner) = cause {
        let inner_text = inner.to_string();
        // Some errors repeat their cause in their own text.
        if !text.contains(&inner_text) {
            text = format!("{text}: {inner_text}");
        }
        cause = inner.source();
    }
    text
}
