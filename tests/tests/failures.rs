//! The disk fails at every step of every program that writes, one step after the other.
//!
//! Afterwards each file is the old one or the new one, whole; nothing else is left behind; the exit code says
//! that an output failed; and a picture that was rendered is somewhere, unless no step ever succeeds again.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::{Mutex, MutexGuard, PoisonError};

use files::inject::{Lasts, arm};
use pack::Pack;
use runtime::Checkpoint;
use tempfile::TempDir;

/// What is there before a program writes it.
const OLD: &[u8] = b"what was there before\n";
/// More steps than any of these programs takes.
const MOST_STEPS: u64 = 500;
const DONE: u8 = 0;
const WORLD: u8 = 3;

const SCENE: &str = "rts 1
material clay: diffuse { color = linear(0.5) }
instance ball { shape = sphere(radius: 1m), material = clay }
sky air: constant { }
camera eye: perspective { from = (0, 1, 5)m, to = (0, 0, 0)m }
film small { size = (8, 8)px }
render main: path { camera = eye, film = small, samples = 1 }
";

/// One at a time: failures are armed for the process, and rescued pictures go to the working folder.
static TURN: Mutex<()> = Mutex::new(());

/// The folders of one test.
struct Desk {
    root: TempDir,
    _turn: MutexGuard<'static, ()>,
}

impl Desk {
    fn new() -> Self {
        let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        let root = tempfile::tempdir().expect("a temporary folder");
        for folder in ["in", "out", "here"] {
            fs::create_dir(root.path().join(folder)).expect("a folder");
        }
        std::env::set_current_dir(root.path().join("here")).expect("a working folder");
        let desk = Self { root, _turn: turn };
        fs::write(desk.input("a.rts"), SCENE).expect("the scene");
        desk
    }

    fn input(&self, name: &str) -> PathBuf {
        self.root.path().join("in").join(name)
    }

    fn out(&self) -> PathBuf {
        self.root.path().join("out")
    }

    /// Names and bytes in a folder.
    fn files(&self, folder: &str) -> BTreeMap<String, Vec<u8>> {
        let entries = fs::read_dir(self.root.path().join(folder)).expect("the folder");
        let file = |entry: fs::DirEntry| {
            let name = entry.file_name().to_string_lossy().into_owned();
            (name, fs::read(entry.path()).expect("a file"))
        };
        entries.map(|entry| file(entry.expect("an entry"))).collect()
    }

    fn clear(&self) {
        for folder in ["out", "here"] {
            for name in self.files(folder).keys() {
                fs::remove_file(self.root.path().join(folder).join(name)).expect("it can go");
            }
        }
    }

    /// A word of a command line: `@name` is an input, `=name` an output.
    fn word(&self, word: &str) -> String {
        let path = match word.split_at_checked(1) {
            Some(("@", name)) => self.input(name),
            Some(("=", name)) => self.out().join(name),
            _ => return word.to_owned(),
        };
        path.to_string_lossy().into_owned()
    }

    /// Runs a command line in this process.
    fn run(&self, line: &str) -> u8 {
        let words: Vec<String> = line.split(' ').map(|word| self.word(word)).collect();
        if words[0] == "rtc" {
            return compiler::cli::run(&words);
        }
        let code = format!("{:?}", runtime::cli::run(&words));
        let known = (0..=u8::MAX).find(|n| format!("{:?}", ExitCode::from(*n)) == code);
        known.expect("an exit code")
    }

    /// The same without a failure, for what a test needs.
    fn make(&self, line: &str) {
        assert_eq!(self.run(line), DONE, "{line}");
    }
}

/// Whether this is a file of its kind, complete.
fn is_whole(name: &str, bytes: &[u8]) -> bool {
    let file = |check: &dyn Fn(&Path) -> bool| {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join(name);
        fs::write(&path, bytes).expect("a copy");
        check(&path)
    };
    let text = || std::str::from_utf8(bytes).unwrap_or_default();
    match Path::new(name).extension().and_then(|e| e.to_str()) {
        Some("pack") => {
            file(&|path| Pack::read(path).is_ok_and(|pack| pack.verify_hashes().is_ok()))
        }
        Some("exr") => file(&|path| runtime::output::read_exr(path).is_ok()),
        Some("checkpoint") => file(&|path| Checkpoint::read(path).is_ok()),
        Some("png") => image::load_from_memory(bytes).is_ok(),
        Some("json") => serde_json::from_slice::<serde_json::Value>(bytes).is_ok(),
        Some("svg") => text().contains("<svg") && text().trim_end().ends_with("</svg>"),
        Some("csv") => text().lines().count() > 1 && text().ends_with('\n'),
        // Compared with what a run without a failure writes.
        _ => true,
    }
}

fn is_picture(name: &str) -> bool {
    [".png", ".exr"].iter().any(|end| name.ends_with(end))
}

/// Fails every step of a command line that writes `outputs`. `fixed`: those whose bytes are always the same.
fn check(desk: &Desk, line: &str, outputs: &[&str], fixed: &[&str]) {
    desk.clear();
    desk.make(line);
    let good = desk.files("out");
    assert_eq!(good.keys().collect::<Vec<_>>(), outputs, "{line}");
    for (lasts, exists) in [(Lasts::Once, true), (Lasts::Once, false), (Lasts::Always, true)] {
        let mut rendered = false;
        for n in 1.. {
            assert!(n < MOST_STEPS, "{line}: it never ends");
            desk.clear();
            let before = if exists { outputs } else { &[] };
            for name in before {
                fs::write(desk.out().join(name), OLD).expect("an old file");
            }
            let armed = arm(n, lasts);
            let code = desk.run(line);
            let came = armed.came();
            drop(armed);
            let at = format!("{line}: step {n}, {lasts:?}, exists: {exists}, exit {code}");
            let (found, rescued) = (desk.files("out"), desk.files("here"));
            let is_new = |name: &str| found.get(name).is_some_and(|bytes| bytes != OLD);
            for (name, bytes) in found.iter().chain(&rescued) {
                let known = outputs.contains(&name.as_str()) || name.ends_with(".checkpoint");
                assert!(known, "{at}: {name} was left behind");
                let is_old = exists && bytes == OLD;
                assert!(is_old || is_whole(name, bytes), "{at}: {name} is not whole");
                if !is_old && fixed.contains(&name.as_str()) {
                    assert!(*bytes == good[name], "{at}: {name} is another one");
                }
            }
            assert!(
                outputs.iter().all(|name| !exists || found.contains_key(*name)),
                "{at}: a file is gone"
            );
            let complete = outputs.iter().all(|name| is_new(name));
            assert!(complete || code == WORLD, "{at}: an output is not there");
            assert!(code == DONE || code == WORLD, "{at}");
            // Before the first sample nothing is lost; after the first picture was seen, all are.
            let pictures: Vec<&str> =
                outputs.iter().copied().filter(|name| is_picture(name)).collect();
            let is_there = |name: &&&str| is_new(name) || rescued.contains_key(**name);
            let n_there = pictures.iter().filter(is_there).count();
            rendered |= n_there > 0 && !complete;
            if lasts == Lasts::Once && rendered {
                assert_eq!(n_there, pictures.len(), "{at}: a picture is lost");
            }
            if !came {
                assert_eq!(code, DONE, "{at}");
                assert!(complete && rescued.is_empty(), "{at}");
                assert!(n > 3 * outputs.len() as u64, "{at}: steps were not counted");
                break;
            }
        }
    }
}

/// A desk with `a.pack`.
fn with_pack() -> Desk {
    let desk = Desk::new();
    desk.make("rtc @a.rts -o @a.pack --no-cache");
    desk
}

#[test]
fn compiling() {
    let desk = Desk::new();
    let line = "rtc @a.rts -o =a.pack --depfile =a.d --emit-wgsl =a.wgsl --no-cache";
    check(&desk, line, &["a.d", "a.pack", "a.wgsl"], &["a.d", "a.pack", "a.wgsl"]);
}

#[test]
fn tidying() {
    let desk = Desk::new();
    let tidy = lang::format::format(SCENE).expect("the scene has no faults");
    let untidy = SCENE.replace(" = ", "  =  ");
    let path = desk.out().join("a.rts");
    for lasts in [Lasts::Once, Lasts::Always] {
        for n in 1..MOST_STEPS {
            fs::write(&path, &untidy).expect("an untidy text");
            let armed = arm(n, lasts);
            let code = desk.run("rtc fmt =a.rts");
            let came = armed.came();
            drop(armed);
            let found = fs::read_to_string(&path).expect("the text");
            assert_eq!(
                (&found, code),
                if came { (&untidy, WORLD) } else { (&tidy, DONE) },
                "step {n}"
            );
            assert_eq!(desk.files("out").len(), 1, "step {n}");
            if !came {
                assert!(n > 3);
                break;
            }
        }
    }
}

#[test]
fn rendering() {
    let desk = with_pack();
    let line =
        "rtr @a.pack -o =a.png -o =a.exr --spp 40 --checkpoint-every 1ms --device cpu --quiet";
    check(&desk, line, &["a.exr", "a.png"], &["a.png"]);
}

#[test]
fn measuring() {
    let desk = with_pack();
    let line = "rtr @a.pack -o =a.exr --report =b.json --report =b.csv --plot =c.svg --plot =d.png --spp 4 \
                --device cpu --quiet";
    check(&desk, line, &["a.exr", "b.csv", "b.json", "c.svg", "d.png"], &[]);
}

#[test]
fn merging() {
    let desk = with_pack();
    for (samples, part) in [("0..16", "@a.exr"), ("16..32", "@b.exr")] {
        desk.make(&format!("rtr @a.pack --samples {samples} -o {part} --device cpu --quiet"));
    }
    let line = "rtr merge @a.exr @b.exr -o =c.exr -o =c.png --quiet";
    check(&desk, line, &["c.exr", "c.png"], &["c.png"]);
}

#[test]
fn comparing_precisions() {
    let desk = with_pack();
    check(&desk, "rtr check @a.pack --heat =a.png --spp 1 --quiet", &["a.png"], &["a.png"]);
}

#[test]
fn comparing_packs() {
    let desk = with_pack();
    desk.make("rtc @a.rts -o @b.pack --no-cache --bvh fast");
    let line =
        "rtr bench @a.pack @b.pack --time 5ms --runs 1 --device cpu --report =a.json --quiet";
    check(&desk, line, &["a.json"], &[]);
}
