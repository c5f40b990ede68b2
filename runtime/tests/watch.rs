//! `rtr --watch`: a new pack is rendered, a broken one is reported and waited out, Ctrl-C ends it.

#![cfg(unix)]

mod common;

use runtime::output::read_exr;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// A test that fails leaves nothing running.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
    }
}

impl Running {
    /// `rtr --watch` in `folder`, and what it says as it says it.
    fn start(folder: &Path, spp: &str) -> (Self, Receiver<String>) {
        let mut child = Command::new(env!("CARGO_BIN_EXE_rtr"))
            .current_dir(folder)
            .args(["a.pack", "--device", "cpu", "--spp", spp, "-o", "a.exr", "--watch"])
            .stderr(Stdio::piped())
            .stdout(Stdio::null())
            .spawn()
            .expect("rtr starts");
        let stderr = BufReader::new(child.stderr.take().expect("piped"));
        let (send, lines) = channel();
        std::thread::spawn(move || {
            for line in stderr.lines().map_while(Result::ok) {
                if send.send(line).is_err() {
                    return;
                }
            }
        });
        (Self(child), lines)
    }

    /// Ctrl-C; gives the exit code.
    fn interrupt(mut self) -> Option<i32> {
        let pid = self.0.id().to_string();
        Command::new("kill").args(["-INT", &pid]).status().expect("kill starts");
        self.0.wait().expect("it ends").code()
    }
}

/// Lines until one that starts so; then all of them.
fn until(lines: &Receiver<String>, start: &str) -> String {
    let mut log = String::new();
    loop {
        let line = lines.recv_timeout(Duration::from_mins(1));
        let line = line.unwrap_or_else(|_| panic!("nothing more is said after\n{log}"));
        log += &line;
        log.push('\n');
        if line.starts_with(start) {
            return log;
        }
    }
}

/// As `rtc` replaces a pack.
fn replace(folder: &Path, bytes: &[u8]) {
    std::fs::write(folder.join("new"), bytes).expect("writable");
    std::fs::rename(folder.join("new"), folder.join("a.pack")).expect("writable");
}

#[test]
fn a_new_pack_is_rendered_and_a_broken_one_is_waited_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let kernel = shaders::link(&common::features()).expect("it links").text;
    let packs = [kernel.clone(), kernel + "\n"].map(|kernel| common::pack_with_kernel(&kernel));
    replace(folder.path(), &packs[0]);
    let (child, lines) = Running::start(folder.path(), "4");
    let id = || read_exr(&folder.path().join("a.exr")).expect("a picture").meta.render_id;
    until(&lines, "watching a.pack");
    let first = id();

    // Written in place, half of it: as a copy that takes its time.
    std::fs::write(folder.path().join("a.pack"), &packs[1][..9000]).expect("writable");
    let log = until(&lines, "watching a.pack");
    assert!(log.contains("a.pack has changed") && log.contains("error: a.pack: "), "{log}");
    assert_eq!(id(), first);
    std::fs::remove_file(folder.path().join("a.pack")).expect("it was there");
    assert!(until(&lines, "watching a.pack").contains("error: "));

    replace(folder.path(), &packs[1]);
    let log = until(&lines, "watching a.pack");
    assert!(log.contains("4 of 4 spp in "), "{log}");
    assert_ne!(id(), first);

    assert_eq!(child.interrupt(), Some(0));
    assert!(!folder.path().join("a.exr.checkpoint").exists());
}

#[test]
fn a_change_while_rendering_starts_anew() {
    let folder = tempfile::tempdir().expect("a folder");
    let kernel = shaders::link(&common::features()).expect("it links").text;
    replace(folder.path(), &common::pack_with_kernel(&kernel));
    let (child, lines) = Running::start(folder.path(), "1000000");
    until(&lines, "device: ");
    replace(folder.path(), &common::pack_with_kernel(&(kernel + "\n")));
    let log = until(&lines, "device: ");
    assert!(log.contains("a.pack has changed"), "{log}");
    // The picture of the old pack is not written.
    assert!(!folder.path().join("a.exr").exists());
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(child.interrupt(), Some(130));
    assert!(folder.path().join("a.exr").exists(), "what is complete is written");
}
