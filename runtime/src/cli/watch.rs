//! `rtr --watch`: renders a pack again whenever it is replaced.
//!
//! The file is polled for size and time, as `rtc --watch` does with the files of a scene. A pack that
//! cannot be read is reported and waited out: whoever writes it may not be done.

use super::args::RenderArgs;
use super::change::Change;
use super::console::{Console, is_interrupted, reset_interrupts};
use super::exit::Exit;
use super::render::{self, Watching};
use crate::signals::Observer;
use files::ShowPath as _;
use std::path::Path;
use std::sync::OnceLock;
use std::time::Duration;

/// Between two looks at the file.
const POLL: Duration = Duration::from_millis(100);

/// Renders until Ctrl-C. What is wrong with the arguments ends it at once, what is wrong with the
/// pack does not.
pub(super) fn command(args: &RenderArgs, observer: &'static Observer) -> Exit {
    let console = Console::of_render(args);
    let path = args.pack.as_deref().unwrap_or(Path::new(""));
    reset_interrupts();
    let names = OnceLock::new();
    loop {
        let change = Change::of(path);
        let watching = Watching { change: &change, names: &names };
        let exit = render::command(args, observer, Some(watching));
        if matches!(exit, Exit::Usage | Exit::Interrupted) {
            return exit;
        }
        if !change.has_come() {
            console.note(&format!("watching {}; press Ctrl-C to stop", path.shown()));
        }
        while !change.has_come() {
            if is_interrupted() {
                return Exit::Done;
            }
            std::thread::sleep(POLL);
        }
        console.note(&format!("{} has changed", path.shown()));
    }
}
