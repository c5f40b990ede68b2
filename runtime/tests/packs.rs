//! Packs that are damaged, that change while they are rendered, or that come from elsewhere than a file: the picture
//! is right, or there is none and one line says why.

mod common;

use pack::{Kind, Pack};
use runtime::{Checkpoint, Control, DeviceChoice, Job, SampleRange, Scene, render};
use std::io::{BufRead as _, BufReader, Read as _};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant, SystemTime};

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
    command.current_dir(folder).args(args).args(["--device", "cpu"]);
    command
}

/// Exit code and what is on stderr.
fn rtr(folder: &Path, args: &[&str]) -> (Option<i32>, String) {
    let output = command(folder, args).output().expect("rtr starts");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

const NAME: &str = "marbles.pack";

fn bytes() -> Vec<u8> {
    common::pack_bytes(&common::features())
}

/// A folder with `marbles.pack`.
fn folder(bytes: &[u8]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for tests");
    std::fs::write(folder.path().join(NAME), bytes).expect("it can be written");
    folder
}

/// First byte of a section.
fn start(bytes: &[u8], kind: Kind) -> usize {
    let pack = Pack::from_bytes(bytes.to_vec()).expect("sound");
    let section = pack.section_bytes(kind).expect("it has one").to_vec();
    let at =
        bytes.chunks(4096).position(|page| page.starts_with(&section[..64.min(section.len())]));
    4096 * at.expect("sections begin at pages")
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder").map(|entry| entry.expect("one"));
    let mut names: Vec<_> =
        entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn damage_that_breaks_no_rule_gives_no_picture() {
    let mut bytes = bytes();
    // A little more red.
    let at = start(&bytes, Kind::MATERIAL) + 1;
    bytes[at] ^= 1;
    assert!(Pack::from_bytes(bytes.clone()).is_ok(), "the rules allow it");
    let line = "error: marbles.pack: section MATERIAL: the bytes do not match their hash, the file is damaged";
    for more in [&[][..], &["--no-mmap"], &["--verify", "first"], &["--report", "r.json"]] {
        let folder = folder(&bytes);
        let (code, log) = rtr(folder.path(), &[&[NAME, "--quiet"], more].concat());
        assert_eq!((code, log.as_str()), (Some(3), format!("{line}\n").as_str()), "{more:?}");
        // However long it would have rendered, and whatever it saves meanwhile.
        let often = ["--spp", "100000000", "--checkpoint-every", "1ms"];
        let often = if more.contains(&"--report") { &often[..2] } else { &often };
        let (code, log) = rtr(folder.path(), &[&[NAME], more, often].concat());
        assert_eq!((code, log.lines().last()), (Some(3), Some(line)), "{more:?}");
        assert_eq!(names(folder.path()), [NAME], "{more:?}");
    }
    let folder = folder(&bytes);
    for args in [&["check", NAME][..], &["bench", NAME, NAME]] {
        let (code, log) = rtr_of(folder.path(), args);
        assert_eq!((code, log.as_str()), (Some(3), format!("{line}\n").as_str()), "{args:?}");
    }
    let (code, log) = rtr(folder.path(), &[NAME, "--spp", "1", "--verify", "off"]);
    assert_eq!(code, Some(0), "{log}");
    assert_eq!(names(folder.path()), ["marbles.exr", NAME, "marbles.png"]);
}

/// Of a command that has no `--device`.
fn rtr_of(folder: &Path, args: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
    let output = command.current_dir(folder).args(args).output().expect("rtr starts");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

/// What happens to the file while it is rendered, and the end of the line that says so.
type Case = (&'static str, fn(&Path), &'static str);

/// Overwrites a part of the file in place.
fn overwrite(path: &Path, at: usize, words: &[u32]) {
    use std::io::{Seek as _, SeekFrom, Write as _};
    let mut file = std::fs::File::options().write(true).open(path).expect("it can be written");
    file.seek(SeekFrom::Start(at as u64)).expect("it is that long");
    file.write_all(bytemuck::cast_slice(words)).expect("it can be written");
}

/// Gives the first node, whose fourth and eighth words are its children, other ones.
fn rewire(path: &Path, children: [u32; 2]) {
    let at = start(&std::fs::read(path).expect("it is there"), Kind::NODE);
    overwrite(path, at + 12, &children[..1]);
    overwrite(path, at + 28, &children[1..]);
}

/// The word of inner node 0.
fn root() -> u32 {
    pack::abi::ChildRef::Inner(0).encode().expect("small")
}

const CASES: &[Case] = &[
    (
        "truncate -s 0",
        |path| drop(std::fs::File::create(path).expect("it can be written")),
        "it has 0 bytes, it had ",
    ),
    (
        "cp",
        |path| std::fs::write(path, [7; 9000]).expect("it can be written"),
        "it has 9000 bytes, it had ",
    ),
    ("a circle of one node", |path| rewire(path, [root(); 2]), "it was written to"),
    ("children that are not there", |path| rewire(path, [root() + 999; 2]), "it was written to"),
    ("nothing but ones", |path| rewire(path, [u32::MAX; 2]), "it was written to"),
    ("four pages of ones", |path| overwrite(path, 4096, &[u32::MAX; 4096]), "it was written to"),
];

#[test]
fn a_pack_that_changes_while_it_is_rendered_gives_no_picture() {
    for (name, change, how) in CASES {
        let folder = folder(&bytes());
        let args = [NAME, "--spp", "100000000", "--checkpoint-every", "20ms", "--threads", "2"];
        let mut child = command(folder.path(), &args)
            .stderr(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("rtr starts");
        let checkpoint = folder.path().join("marbles.exr.checkpoint");
        let began = Instant::now();
        while !checkpoint.is_file() {
            assert!(began.elapsed() < Duration::from_mins(2), "no checkpoint is written");
            std::thread::sleep(Duration::from_millis(1));
        }
        let changed = Instant::now();
        change(&folder.path().join(NAME));
        let (mut log, mut result) = (String::new(), String::new());
        child.stderr.take().expect("a pipe").read_to_string(&mut log).expect("text");
        child.stdout.take().expect("a pipe").read_to_string(&mut result).expect("text");
        let status = child.wait().expect("it ends");
        assert!(changed.elapsed() < Duration::from_secs(20), "{name}: {:?}", changed.elapsed());
        assert_eq!(status.code(), Some(3), "{name}: {status} {log}");
        let errors: Vec<_> = log.lines().filter(|line| line.starts_with("error")).collect();
        let line = format!("error: marbles.pack: the file changed while it was in use: {how}");
        assert!(errors.len() == 1 && errors[0].starts_with(&line), "{name}: {log}");
        assert!(!log.contains("panicked"), "{name}: {log}");
        assert_eq!(result, "", "{name}");
        assert_eq!(names(folder.path()), ["marbles.exr.checkpoint", NAME], "{name}");
        // What was saved before is whole; and right, as far as it goes.
        let saved = Checkpoint::read(&checkpoint).expect("whole").expect("there");
        let film = saved.film;
        let scene = Scene::new(Pack::from_bytes(bytes()).expect("sound"));
        let mut job = Job::of_scene(&scene);
        job.samples = SampleRange { start: 0, end: film.samples().1 };
        let whole = render(&scene, &job, &DeviceChoice::Cpu, &Control::default());
        // Otherwise it has samples of another pack.
        common::assert_same(&film, whole.expect("it renders").film());
    }
}

#[test]
fn a_pack_that_is_touched_while_it_is_rendered_is_rendered() {
    for more in [&[][..], &["--verify", "first"], &["--verify", "off"]] {
        let folder = folder(&bytes());
        let args = [&[NAME, "--spp", "2048", "-o", "a.exr"], more].concat();
        let mut child =
            command(folder.path(), &args).stderr(Stdio::piped()).spawn().expect("rtr starts");
        let mut log = BufReader::new(child.stderr.take().expect("a pipe")).lines();
        let device = log.find(|line| line.as_ref().is_ok_and(|line| line.starts_with("device: ")));
        assert!(device.is_some());
        let file = std::fs::File::options().write(true).open(folder.path().join(NAME));
        let file = file.expect("it can be written");
        while child.try_wait().expect("a child").is_none() {
            file.set_modified(SystemTime::now()).expect("it can be touched");
            std::thread::sleep(Duration::from_millis(5));
        }
        let rest: Vec<String> = log.map_while(Result::ok).collect();
        assert_eq!(child.wait().expect("it ends").code(), Some(0), "{more:?} {rest:?}");
        assert_eq!(names(folder.path()), ["a.exr", NAME]);
    }
}

/// `rtc` puts a new file in the place of the old one, which who has it open keeps.
#[test]
fn a_pack_that_is_replaced_while_it_is_rendered_gives_the_picture_of_the_old_one() {
    let folder = folder(&bytes());
    let args = [NAME, "--spp", "512", "-o", "a.exr"];
    let mut child =
        command(folder.path(), &args).stderr(Stdio::piped()).spawn().expect("rtr starts");
    let mut log = BufReader::new(child.stderr.take().expect("a pipe")).lines();
    let device = log.find(|line| line.as_ref().is_ok_and(|line| line.starts_with("device: ")));
    assert!(device.is_some());
    std::fs::write(folder.path().join("new"), [7; 9000]).expect("it can be written");
    std::fs::rename(folder.path().join("new"), folder.path().join(NAME))
        .expect("it can be renamed");
    let rest: Vec<String> = log.map_while(Result::ok).collect();
    assert_eq!(child.wait().expect("it ends").code(), Some(0), "{rest:?}");
    assert_eq!(names(folder.path()), ["a.exr", NAME]);
}

#[test]
fn packs_come_from_standard_input() {
    let bytes = bytes();
    let folder = folder(&bytes);
    let (code, log) = rtr(folder.path(), &[NAME, "--spp", "2", "--quiet"]);
    assert_eq!(code, Some(0), "{log}");
    let piped = |name: &str, args: &[&str]| {
        let file = std::fs::File::open(folder.path().join(name)).expect("it is there");
        let output = command(folder.path(), args).stdin(file).output().expect("rtr starts");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (code, log) = piped(NAME, &["-", "--spp", "2", "--quiet"]);
    assert_eq!((code, log.as_str()), (Some(0), ""));
    let read = |name: &str| std::fs::read(folder.path().join(name)).expect("it is there");
    assert_eq!(read("picture.png"), read("marbles.png"));
    std::fs::write(folder.path().join("cut"), &bytes[..9000]).expect("it can be written");
    let (code, log) = piped("cut", &["-", "--quiet"]);
    let line = format!(
        "error: -: header: the header says {} bytes, the file has 9000: truncated\n",
        bytes.len()
    );
    assert_eq!((code, log), (Some(3), line));
    let (code, log) = piped(NAME, &["-", "--watch"]);
    assert_eq!(
        (code, log.as_str()),
        (Some(2), "error: standard input cannot be watched, name a file\n")
    );
}

#[cfg(unix)]
#[test]
fn a_pipe_in_place_of_a_pack_is_refused_at_once() {
    let folder = folder(&bytes());
    let pipe = folder.path().join("pipe.pack");
    assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo is there").success());
    for more in [&[][..], &["--no-mmap"]] {
        let (code, log) = rtr(folder.path(), &[&["pipe.pack"], more].concat());
        assert_eq!((code, log.as_str()), (Some(3), "error: pipe.pack is not a regular file\n"));
    }
}
