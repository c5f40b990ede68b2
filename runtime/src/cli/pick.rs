//! `rtr --pick X,Y scene.pack`: what is seen in a pixel, as text or JSON.

use super::args::RenderArgs;
use super::console::Console;
use super::exit::Exit;
use super::guard::Guard;
use super::open::{How, open};
use crate::control::Control;
use crate::job::Job;
use crate::pick::{Pick, PickError, pick};
use crate::scene::Scene;
use std::fmt::Write as _;
use std::path::Path;

pub(super) fn command(args: &RenderArgs) -> Exit {
    let pixel = args.pick.unwrap_or_default();
    let console = Console::new(args.quiet);
    let path = args.pack.as_deref().unwrap_or(Path::new(""));
    let scene = match open(path, How::of(args.no_mmap)) {
        Ok(pack) => Scene::new(pack),
        Err(error) => return console.fail_about(path, &error, Exit::World),
    };
    let guard = match Guard::new(&console, path, scene.pack(), args.verify) {
        Ok(guard) => guard,
        Err(exit) => return exit,
    };
    let mut job = Job::of_scene(&scene);
    if let Some(size) = args.size {
        job.resize(size);
    }
    if let Err(error) = job.check() {
        return console.fail(&error, Exit::Usage);
    }
    match guard.during(&Control::default(), || pick(&scene, &job, pixel)) {
        Ok(Ok(pick)) => told(&console, args.json, &pick),
        Ok(Err(error @ PickError::Pixel { .. })) => console.fail(&error, Exit::Usage),
        Ok(Err(error @ PickError::Kernel(_))) => console.fail(&error, Exit::World),
        Err(exit) => exit,
    }
}

fn told(console: &Console, json: bool, pick: &Pick) -> Exit {
    if !json {
        console.result(&pick.to_string());
        return Exit::Done;
    }
    match serde_json::to_string_pretty(pick) {
        Ok(text) => {
            console.result(&shown(&text));
            Exit::Done
        }
        Err(error) => console.fail(&error, Exit::Bug),
    }
}

/// JSON in which no name steers a terminal: what is not ASCII, or a control character, is only within strings.
fn shown(json: &str) -> String {
    let mut text = String::with_capacity(json.len());
    for c in json.chars() {
        if matches!(c, '\n' | ' '..='~') {
            text.push(c);
        } else {
            let mut units = [0; 2];
            for unit in c.encode_utf16(&mut units) {
                // Writing to a string cannot fail.
                let _ = write!(text, "\\u{unit:04x}");
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_is_the_same_value_in_ascii() {
        let name = "a\u{9b}31m\u{7f} ünïcode 😀\u{202e}";
        let json = serde_json::to_string_pretty(&[name]).unwrap();
        assert!(shown(&json).is_ascii());
        assert_eq!(serde_json::from_str::<Vec<String>>(&shown(&json)).unwrap(), [name]);
    }
}
