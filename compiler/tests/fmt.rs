//! `rtc fmt`: files, folders and standard input.

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const UNTIDY: &str = "rts 1\r\nlet a=1\r\n";
const TIDY: &str = "rts 1\r\nlet a = 1\r\n";

fn fmt(folder: &Path, args: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_rtc"))
        .current_dir(folder)
        .arg("fmt")
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("rtc starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    // Who is not asked for its standard input may have ended already.
    let _ = stdin.write_all(input.as_bytes());
    drop(stdin);
    child.wait_with_output().expect("rtc ends")
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("no signal")
}

#[test]
fn standard_input_goes_tidy_to_standard_output() {
    let folder = tempfile::tempdir().expect("temporary folder");
    for (args, input, expected, status) in [
        (&["-"][..], UNTIDY, TIDY, 0),
        (&["-"][..], TIDY, TIDY, 0),
        (&["-", "--check"][..], UNTIDY, "", 1),
        (&["-", "--check"][..], TIDY, "", 0),
        (&["-"][..], "rts 1\nlet a =\n", "", 1),
    ] {
        let output = fmt(folder.path(), args, input);
        assert_eq!(code(&output), status, "{args:?} {input:?}");
        assert_eq!(String::from_utf8_lossy(&output.stdout), expected, "{args:?} {input:?}");
    }
}

#[test]
fn every_text_below_a_folder_is_tidied_and_nothing_else() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let at = |name: &str| folder.path().join(name);
    fs::create_dir_all(at("deep/er")).expect("writable");
    let texts = ["b.rts", "deep/c.rts", "deep/er/a.rts"];
    for name in texts.iter().chain(&["deep/notes.txt"]) {
        fs::write(at(name), UNTIDY).expect("writable");
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("../..", at("deep/er/circle")).expect("writable");
        std::os::unix::fs::symlink("no such text", at("deep/dangling.rts")).expect("writable");
    }
    let output = fmt(folder.path(), &["--check", "."], "");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let expected = texts
        .map(|name| format!("./{name} is not formatted; `rtc fmt ./{name}` would change it\n"));
    assert_eq!((code(&output), said), (1, expected.concat()));
    assert_eq!(code(&fmt(folder.path(), &["."], "")), 0);
    for name in texts {
        assert_eq!(fs::read_to_string(at(name)).expect("there"), TIDY, "{name}");
    }
    assert_eq!(fs::read_to_string(at("deep/notes.txt")).expect("there"), UNTIDY);
    assert_eq!(code(&fmt(folder.path(), &["--check", "."], "")), 0);
    assert_eq!(code(&fmt(folder.path(), &["no such folder"], "")), 3);
}

#[test]
fn the_texts_of_this_repository_are_tidy() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let output = fmt(root, &["--check", "scenes", "tests/validation", "lang/src"], "");
    assert_eq!(code(&output), 0, "{}", String::from_utf8_lossy(&output.stderr));
}
