//! Files that change while they are mapped, and packs that come from a stream.

#![cfg(unix)]
#![expect(clippy::unwrap_used, reason = "helpers of tests are tests")]

mod common;

use std::fs::{self, File};
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, SystemTime};

use common::{Scene, WAYS, map};
use pack::{Alteration, Pack, PackError};

/// What is done to a file, and what the witness and the last word say of it afterwards.
type Case = (&'static str, fn(&Path), Option<&'static str>, Option<&'static str>);

fn open(path: &Path) -> File {
    File::options().write(true).open(path).unwrap()
}

fn set_len(path: &Path, len: u64) {
    open(path).set_len(len).unwrap();
}

/// Overwrites the last bytes, which are those of the manifest.
fn overwrite(path: &Path) {
    write_at_end(path, Some([0xa5; 4]));
}

/// Writes the last bytes: other ones, or those that are there.
fn write_at_end(path: &Path, bytes: Option<[u8; 4]>) {
    use std::os::unix::fs::FileExt;
    let last = *fs::read(path).unwrap().last_chunk().unwrap();
    let file = open(path);
    file.write_all_at(&bytes.unwrap_or(last), file.metadata().unwrap().len() - 4).unwrap();
}

/// A pack that was written long ago.
fn old_pack(dir: &Path) -> PathBuf {
    let path = dir.join("scene.pack");
    Scene::full().writer().write(&path).unwrap();
    open(&path).set_modified(long_ago()).unwrap();
    path
}

fn long_ago() -> SystemTime {
    SystemTime::now() - Duration::from_hours(24)
}

const CASES: &[Case] = &[
    ("nothing", |_| {}, None, None),
    (
        "another file takes its name",
        |path| assert_eq!(Scene::empty().writer().write(path).unwrap().len(), 32),
        None,
        None,
    ),
    ("it is removed", |path| fs::remove_file(path).unwrap(), None, None),
    (
        "its permissions change",
        |path| fs::set_permissions(path, fs::Permissions::from_mode(0o400)).unwrap(),
        None,
        None,
    ),
    ("touched", |path| open(path).set_modified(SystemTime::now()).unwrap(), None, None),
    ("written in place with what it had", |path| write_at_end(path, None), None, None),
    (
        "truncated",
        |path| set_len(path, 0),
        Some("it has 0 bytes, it had 65595"),
        Some("it has 0 bytes, it had 65595"),
    ),
    (
        "a byte less",
        |path| set_len(path, 65594),
        Some("it has 65594 bytes, it had 65595"),
        Some("it has 65594 bytes, it had 65595"),
    ),
    (
        "copied over, with cp",
        |path| fs::write(path, [7; 12360]).unwrap(),
        Some("it has 12360 bytes, it had 65595"),
        Some("it has 12360 bytes, it had 65595"),
    ),
    ("written in place", overwrite, Some("it was written to"), Some("it was written to")),
    (
        "written in place, and its time set back",
        |path| {
            let before = fs::metadata(path).unwrap().modified().unwrap();
            overwrite(path);
            open(path).set_modified(before).unwrap();
        },
        None,
        Some("section META: the bytes do not match their hash, the file is damaged"),
    ),
];

#[test]
fn what_becomes_of_a_mapped_file_is_noticed_and_reading_it_goes_on() {
    for (name, change, seen, settled) in CASES {
        let dir = tempfile::tempdir().unwrap();
        let path = old_pack(dir.path());
        let pack = map(&path).unwrap();
        let in_memory = Pack::read(&path).unwrap();
        let witness = pack.witness().unwrap();
        assert!(
            witness.look().is_ok() && !witness.is_in_doubt() && pack.settle().is_ok(),
            "{name}"
        );
        change(&path);
        // Nothing was read of most sections yet: pages that are gone are touched here.
        let sum: u64 = pack.sections().flat_map(|s| s.bytes).map(|byte| u64::from(*byte)).sum();
        assert!(sum > 0 || seen.is_some(), "{name}");
        for (result, expected) in [(witness.look(), seen), (pack.settle(), settled)] {
            let text = result.err().map(|error| error.to_string());
            let expected = expected.map(|how| {
                if how.starts_with("it ") {
                    format!("the file changed while it was in use: {how}")
                } else {
                    how.to_owned()
                }
            });
            assert_eq!(text, expected, "{name}");
        }
        assert!(in_memory.verify_hashes().is_ok() && in_memory.settle().is_ok(), "{name}");
        drop(pack);
        // A witness outlives its pack.
        assert_eq!(witness.look().is_err(), seen.is_some(), "{name}");
    }
}

/// Cut off, read, and put right again before anybody looks: what was read were zeros.
#[test]
fn a_file_that_was_gone_for_a_moment_is_lost() {
    let dir = tempfile::tempdir().unwrap();
    let path = old_pack(dir.path());
    let bytes = fs::read(&path).unwrap();
    let modified = fs::metadata(&path).unwrap().modified().unwrap();
    let pack = map(&path).unwrap();
    set_len(&path, 0);
    assert!(pack.kernel().bytes().all(|byte| byte == 0));
    fs::write(&path, bytes).unwrap();
    open(&path).set_modified(modified).unwrap();
    let look = pack.witness().unwrap().look();
    assert!(matches!(look, Err(PackError::Altered { how: Alteration::Lost })), "{look:?}");
    assert!(pack.verify_hashes().is_err());
}

#[test]
fn a_file_that_was_written_a_moment_ago_is_in_doubt_until_its_hashes_are_compared() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("scene.pack");
    Scene::full().writer().write(&path).unwrap();
    let pack = map(&path).unwrap();
    let modified = fs::metadata(&path).unwrap().modified().unwrap();
    assert!(pack.witness().unwrap().is_in_doubt() && pack.settle().is_ok());
    overwrite(&path);
    open(&path).set_modified(modified).unwrap();
    assert!(pack.settle().is_err());
}

#[test]
fn a_write_after_a_touch_is_noticed() {
    let dir = tempfile::tempdir().unwrap();
    let path = old_pack(dir.path());
    let pack = map(&path).unwrap();
    let witness = pack.witness().unwrap();
    for _ in 0..2 {
        open(&path).set_modified(SystemTime::now()).unwrap();
        assert!(witness.look().is_ok() && pack.settle().is_ok());
        std::thread::sleep(Duration::from_millis(20)); // longer than a tick of the file system's clock
    }
    overwrite(&path);
    for result in [witness.look(), pack.settle()] {
        let written = matches!(result, Err(PackError::Altered { how: Alteration::Written }));
        assert!(written, "{result:?}");
    }
}

/// Many threads read many mappings while their files are cut off.
#[test]
fn threads_that_read_at_once_survive() {
    let dir = tempfile::tempdir().unwrap();
    std::thread::scope(|scope| {
        for i in 0..8 {
            let path = dir.path().join(format!("{i}.pack"));
            Scene::full().writer().write(&path).unwrap();
            scope.spawn(move || {
                let pack = map(&path).unwrap();
                std::thread::scope(|scope| {
                    let read = || {
                        while pack.witness().unwrap().look().is_ok() {
                            assert!(pack.sections().map(|s| s.bytes.len()).sum::<usize>() > 0);
                            drop(pack.verify_hashes());
                        }
                    };
                    scope.spawn(read);
                    scope.spawn(read);
                    std::thread::sleep(Duration::from_millis(5 * i));
                    set_len(&path, 4096);
                });
                assert!(pack.sections().skip(1).all(|s| s.bytes.iter().all(|byte| *byte == 0)));
            });
        }
    });
}

/// Says to this very program what it is to do in a process of its own.
const CHILD: &str = "PACK_TEST_CHILD";

/// A process with a guarded mapping dies of a signal that is about something else, as it would without.
#[test]
fn bus_errors_of_others_end_the_process() {
    let Ok(what) = std::env::var(CHILD) else {
        for what in ["another mapping", "a signal that was sent"] {
            let mut child = Command::new(std::env::current_exe().unwrap());
            child.args(["--exact", "bus_errors_of_others_end_the_process"]).env(CHILD, what);
            let status = child.output().unwrap().status;
            assert_eq!(status.signal(), Some(libc::SIGBUS), "{what}: {status}");
        }
        return;
    };
    let dir = tempfile::tempdir().unwrap();
    let path = old_pack(dir.path());
    let pack = map(&path).unwrap();
    set_len(&path, 0);
    assert_eq!(pack.kernel().bytes().map(usize::from).sum::<usize>(), 0, "the handler is there");
    if what == "another mapping" {
        let other = dir.path().join("other");
        fs::write(&other, [1; 8192]).unwrap();
        #[expect(unsafe_code, reason = "a mapping that nobody guards")]
        // SAFETY: bytes; the process is to end.
        let map = unsafe { memmap2::Mmap::map(&File::open(&other).unwrap()) }.unwrap();
        set_len(&other, 0);
        assert_eq!(std::hint::black_box(map[5000]), 0);
    } else {
        #[expect(unsafe_code, reason = "what is tested")]
        // SAFETY: the process is to end; at the second, as without us: the handler of Rust that was there before takes
        // the first one for a fault, which would come again.
        unsafe {
            libc::raise(libc::SIGBUS);
            libc::raise(libc::SIGBUS);
        }
    }
    std::process::exit(0);
}

#[test]
fn a_pipe_is_refused_without_waiting() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("pipe.pack");
    assert!(Command::new("mkfifo").arg(&path).status().unwrap().success());
    for open in WAYS {
        let text = open(&path).unwrap_err().to_string();
        assert!(text.ends_with("pipe.pack is not a regular file"), "{text}");
    }
}

#[test]
fn packs_come_from_streams() {
    let bytes = Scene::full().bytes();
    let len = bytes.len() as u64;
    let pack = Pack::receive(&bytes[..], len).unwrap();
    assert_eq!(pack.render_id(), Pack::from_bytes(bytes.clone()).unwrap().render_id());
    assert!(pack.verify_hashes().is_ok() && pack.witness().is_none());
    let mut huge = bytes.clone();
    common::put64(&mut huge, 40, 1 << 60);
    let longer = [&bytes[..], &[0; 9000]].concat();
    let cases: [(&[u8], &str); 6] = [
        (&[], "not a render pack: the first bytes are none, the file is empty"),
        (b"rts 1\n", "is this a scene source? compile it first: rtc X -o X.pack"),
        (&bytes[..100], "header: the file ends after 100 bytes, a pack has at least 128"),
        (&bytes[..9000], "header: the header says 65595 bytes, the file has 9000: truncated"),
        (&longer, "header: the header says 65595 bytes, the file has 65596: bytes follow the pack"),
        (&huge, "the pack has 1152921504606846976 bytes, and 65595 fit into memory"),
    ];
    for (bytes, expected) in cases {
        assert_eq!(Pack::receive(bytes, len).unwrap_err().to_string(), expected);
    }
    let text = Pack::receive(&bytes[..], len - 1).unwrap_err().to_string();
    assert_eq!(text, "the pack has 65595 bytes, and 65594 fit into memory");
}

/// A pack that is made of another one is not written once that has changed, whatever fails because of it.
#[test]
fn what_is_taken_from_a_pack_that_changed_is_not_written() {
    for change in [|path: &Path| set_len(path, 0), overwrite] {
        let dir = tempfile::tempdir().unwrap();
        let (from, to) = (old_pack(dir.path()), dir.path().join("new.pack"));
        let pack = map(&from).unwrap();
        let write = || {
            let mut writer = pack::PackWriter::new();
            for section in pack.sections() {
                writer.section(section);
            }
            writer.taken_from(pack.witness()).write(&to)
        };
        write().unwrap();
        let before = fs::read(&to).unwrap();
        open(&from).set_modified(SystemTime::now()).unwrap();
        write().unwrap();
        change(&from);
        let error = write().unwrap_err();
        assert!(matches!(error, PackError::Altered { .. }), "{error}");
        assert_eq!(fs::read(&to).unwrap(), before);
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 2, "no temporary file stays");
    }
}
