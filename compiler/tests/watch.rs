//! `rtc --watch`: changes are compiled, errors are shown and waited out, Ctrl-C ends it.

#![cfg(unix)]

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

const SCENE: &str = "rts 1
import \"light.rts\" { glow }
texture tile = image(\"tile.png\", space: srgb)
material clay: diffuse { color = tile }
instance ball { shape = sphere(radius: 20cm), material = clay }
instance lamp { shape = sphere(radius: 10cm), material = glow, at = (0, 3, 0)m }
camera eye: perspective { from = (0, 1, 6)m, to = (0, 1, 0)m }
render main: path { samples = 1 }
";
const LIGHT: &str = "rts 1\npub material glow: emissive { color = linear(1), strength = 5 }\n";

/// A watching `rtc` whose lines arrive as it says them.
struct Watching {
    child: Child,
    lines: Receiver<String>,
}

impl Watching {
    fn start(folder: &Path) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_rtc"))
            .current_dir(folder)
            .env("RTC_CACHE_DIR", folder.join("cache"))
            .args(["scene.rts", "-o", "a.pack", "--watch", "--color", "never"])
            .stderr(Stdio::piped())
            .spawn()
            .expect("rtc starts");
        let stderr = BufReader::new(child.stderr.take().expect("piped"));
        let (send, lines) = channel();
        std::thread::spawn(move || {
            for line in stderr.lines().map_while(Result::ok) {
                if send.send(line).is_err() {
                    return;
                }
            }
        });
        Self { child, lines }
    }

    /// Everything until it waits for changes.
    fn round(&self) -> String {
        let mut log = String::new();
        loop {
            let line = self.lines.recv_timeout(Duration::from_mins(1));
            let line = line.unwrap_or_else(|_| panic!("nothing more is said after\n{log}"));
            log += &line;
            log.push('\n');
            if line.starts_with("watching ") {
                return log;
            }
        }
    }

    /// Ctrl-C; gives the exit code.
    fn interrupt(mut self) -> Option<i32> {
        let pid = self.child.id().to_string();
        Command::new("kill").args(["-INT", &pid]).status().expect("kill starts");
        self.child.wait().expect("it ends").code()
    }
}

/// A test that fails leaves nothing running.
impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.child.kill();
    }
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("scene.rts"), SCENE).expect("writable");
    std::fs::write(folder.path().join("light.rts"), LIGHT).expect("writable");
    let image = image::RgbImage::new(2, 2);
    image.save(folder.path().join("tile.png")).expect("writable");
    folder
}

#[test]
fn every_dependency_is_watched_and_what_did_not_change_is_reused() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let pack = || std::fs::read(at("a.pack")).expect("the pack is there");
    let watching = Watching::start(folder.path());
    let log = watching.round();
    assert!(
        log.contains("a.pack: ") && log.ends_with("watching 3 files; press Ctrl-C to stop\n"),
        "{log}"
    );
    assert!(!log.contains("reused"), "{log}");
    let first = pack();

    std::fs::write(at("light.rts"), LIGHT.replace("strength = 5", "strength = 6"))
        .expect("writable");
    let log = watching.round();
    assert!(log.contains("changed: light.rts"), "{log}");
    let all = "reused the geometry and the textures of the last pack, the proof of the kernel";
    assert!(log.contains(all), "{log}");
    let second = pack();
    assert_ne!(first, second);

    std::fs::write(at("light.rts"), LIGHT.replace("strength = 5", "strength = 5, sides = front"))
        .expect("writable");
    let log = watching.round();
    assert!(log.contains(all), "{log}");
    let second = {
        let larger = pack();
        assert_ne!(second, larger);
        larger
    };

    image::RgbImage::new(3, 2).save(at("tile.png")).expect("writable");
    let log = watching.round();
    assert!(log.contains("changed: tile.png"), "{log}");
    assert!(!log.contains("images") && log.contains("the proof of the kernel"), "{log}");
    let third = pack();
    assert_ne!(second, third);
    // The same pack as from nothing.
    let fresh = Command::new(env!("CARGO_BIN_EXE_rtc"))
        .current_dir(folder.path())
        .args(["scene.rts", "-o", "fresh.pack", "--no-cache"])
        .status();
    assert!(fresh.expect("rtc starts").success());
    assert_eq!(std::fs::read(at("fresh.pack")).expect("it is there"), third);
    assert_eq!(watching.interrupt(), Some(0));
}

#[test]
fn errors_are_shown_and_waited_out() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let watching = Watching::start(folder.path());
    watching.round();
    let good = std::fs::read(at("a.pack")).expect("the pack is there");

    std::fs::write(at("scene.rts"), SCENE.replace("= clay", "= cley")).expect("writable");
    let log = watching.round();
    assert!(log.contains("changed: scene.rts") && log.contains("error[E0202]"), "{log}");
    std::fs::write(at("scene.rts"), SCENE).expect("writable");
    let log = watching.round();
    assert!(log.contains("a.pack is up to date"), "{log}");

    // Files that are not there, and appear.
    for name in ["light.rts", "tile.png"] {
        std::fs::rename(at(name), at("away")).expect("it was there");
        let log = watching.round();
        assert!(log.contains(&format!("changed: {name}")) && log.contains("error"), "{log}");
        std::fs::rename(at("away"), at(name)).expect("it was there");
        let log = watching.round();
        assert!(log.contains("a.pack is up to date"), "{log}");
    }
    // A pack that was broken off never replaces a good one.
    assert_eq!(std::fs::read(at("a.pack")).expect("the pack is there"), good);
    assert_eq!(watching.interrupt(), Some(0));
}
