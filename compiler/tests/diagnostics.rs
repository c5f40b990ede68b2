//! What `rtc` says of scenes, as a user sees it: how much, how fast, and nothing that steers a terminal.

use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

/// Runs `rtc check` in a folder.
fn check(folder: &Path, args: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_rtc"))
        .current_dir(folder)
        .arg("check")
        .args(["--color", "never"])
        .args(args)
        .output();
    said(&output.expect("rtc starts"))
}

fn said(output: &Output) -> (Option<i32>, String) {
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.stdout.is_empty());
    (output.status.code(), text)
}

fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("room for a text");
    }
    folder
}

/// A scene with nothing wrong, before which or behind which text may stand.
const GOOD: &str = "sky s: constant { }
camera c: perspective { from = (0, 1, 5)m, to = (0, 1, 0)m }
render r: path { camera = c, sky = s }
material m: diffuse { color = linear(0.5) }
instance ball { shape = sphere(radius: 1m), material = m }
";

const FORMATS: [&str; 3] = ["human", "short", "json"];

#[test]
fn a_hundred_thousand_warnings_take_little_time_and_few_are_drawn() {
    let lets = (0..100_000).map(|i| format!("let a{i} = 1m\n")).collect::<Vec<_>>().concat();
    let folder = folder(&[("a.rts", &format!("rts 1\n{GOOD}{lets}"))]);
    for format in FORMATS {
        let start = Instant::now();
        let args = ["a.rts", "--error-format", format, "--max-errors", "3"];
        let (code, text) = check(folder.path(), &args);
        assert_eq!(code, Some(0), "{text}");
        // 2 s in a release build; quadratic steps took minutes.
        assert!(start.elapsed() < Duration::from_secs(20), "{format}: {:?}", start.elapsed());
        let told = text.matches("is never used").count();
        // JSON has the message and the picture of it.
        assert_eq!(told, if format == "json" { 6 } else { 3 }, "{format}: {text}");
        let more = "not shown: 99997 warnings; --max-errors 0 shows all";
        assert_eq!(text.matches(more).count(), 1, "{text}");
    }
}

#[test]
fn errors_and_warnings_are_counted_apart() {
    let wrong = (0..9).map(|i| format!("material w{i}: metal {{ color = linear(0.5), fuzz = 0.5% }}\nlet e{i} = nothing{i}\n")).collect::<Vec<_>>().concat();
    let folder = folder(&[("a.rts", &format!("rts 1\n{GOOD}{wrong}"))]);
    let shown = |max: &str| {
        let (code, text) =
            check(folder.path(), &["a.rts", "--error-format", "short", "--max-errors", max]);
        assert_eq!(code, Some(1));
        (text.matches(" error[").count(), text.matches(" warning[").count(), text)
    };
    let (errors, warnings, text) = shown("2");
    assert_eq!((errors, warnings), (2, 2), "{text}");
    assert!(
        text.ends_with(
            "not shown: 7 errors, 7 warnings; --max-errors 0 shows all\n9 errors, 9 warnings\n"
        ),
        "{text}"
    );
    let (errors, warnings, text) = shown("0");
    assert_eq!((errors, warnings), (9, 9), "{text}");
    assert!(!text.contains("not shown"), "{text}");
}

#[test]
fn the_short_format_says_why() {
    let folder = folder(&[("a.rts", &format!("rts 1\n{GOOD}let a = 1m + 1s\n"))]);
    let (_, text) = check(folder.path(), &["a.rts", "--error-format", "short"]);
    let line = text.lines().next().unwrap_or("");
    assert!(line.starts_with("a.rts:7:"), "{text}");
    assert!(
        line.contains(" error[E0302]: ") && line.contains(" (") && line.ends_with(')'),
        "{text}"
    );
}

#[test]
fn no_line_makes_more_than_a_few_lines() {
    let n = 300_000;
    let texts = [
        format!("rts 1\n{GOOD}let a = \"{}", "x".repeat(n)),
        format!("rts 1\n{GOOD}let a = {} 1", "1 ".repeat(n / 2)),
        format!("rts 1\n{GOOD}let {} = 1", "a".repeat(n)),
        format!("rts 1\n{GOOD}let a = 1{}", "m".repeat(n)),
        format!("rts 1\n{GOOD}import \"{}\"", "x".repeat(n)),
        format!("rts 1\n{GOOD}assert 1 > 2, \"{}\"", "é".repeat(n / 2)),
        format!("rts 1\n{GOOD}film f {{ size = (1, 2){} }}", "\u{202e}".repeat(n / 3)),
        format!("rts 1\n{GOOD}let a = {}", "\r".repeat(n)),
    ];
    for text in texts {
        let folder = folder(&[("a.rts", &text)]);
        for format in FORMATS {
            let (code, said) = check(folder.path(), &["a.rts", "--error-format", format]);
            assert_eq!(code, Some(1), "{said:.2000}");
            assert!(said.len() < 20_000, "{format}: {} bytes: {:.2000}", said.len(), said);
        }
    }
}

#[test]
fn nothing_of_a_scene_steers_the_terminal() {
    let evil = "\u{1b}[31m\u{9b}2J\u{7f}\u{202e}\u{2066}";
    let text = format!(
        "rts 1\n{GOOD}// {evil}\nimport \"{evil}.rts\" as x ; {evil}\nassert 1 > 2, \"{evil}\" // {evil}\n"
    );
    let folder = folder(&[("a.rts", &text), ("b\u{9b}.rts", "rts 1\nlet a = b\n")]);
    let steers = |c: char| {
        c.is_control() && c != '\n'
            || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    for scene in ["a.rts", "b\u{9b}.rts", "\u{1b}[2J.rts"] {
        for format in FORMATS {
            let (_, text) = check(folder.path(), &[scene, "--error-format", format]);
            assert!(!text.is_empty() && !text.contains(steers), "{scene} {format}: {text:?}");
        }
    }
}

#[test]
fn a_file_that_is_no_scene_is_named_and_not_quoted() {
    let secret = "root:x:0:0:root:/root:/bin/bash\n";
    let scene = format!("rts 1\n{GOOD}import \"secret\"\nimport \"secret.rts\" as s\n");
    let folder = folder(&[("a.rts", &scene), ("secret", secret), ("secret.rts", secret)]);
    for format in FORMATS {
        for scene in ["a.rts", "secret"] {
            let (code, text) = check(folder.path(), &[scene, "--error-format", format]);
            assert_eq!(code, Some(1), "{text}");
            assert!(text.contains("secret") && !text.contains("root"), "{text}");
        }
    }
    // Who names a file that calls itself a scene is shown what is wrong with it.
    let (code, text) = check(folder.path(), &["secret.rts"]);
    assert!(code == Some(1) && text.contains("E0103"), "{text}");
}

/// A small stack of the process is no fault of the scene.
#[cfg(unix)]
#[test]
fn a_small_stack_gives_no_error() {
    let deep =
        format!("let a = {}1{}\nlet b = {}1\n", "(".repeat(64), ")".repeat(64), "1 + ".repeat(200));
    let fields = (0..390)
        .map(|i| {
            format!("material m{i}: metal {{ color = linear(0.5), fuzz = m{}.fuzz }}\n", i + 1)
        })
        .collect::<Vec<_>>()
        .concat();
    let fields = fields
        + "material m390: metal { color = linear(0.5), fuzz = 0.1 }\ninstance deep { shape = sphere(radius: 1m), material = m0 }\n";
    let folder =
        folder(&[("a.rts", &format!("rts 1\n{GOOD}{deep}assert a + b > 0, \"\"\n{fields}"))]);
    for kib in ["32", "64", "1024"] {
        let mut shell = Command::new("sh");
        shell.current_dir(folder.path()).args([
            "-c",
            "ulimit -s \"$1\" && exec \"$2\" check a.rts",
            "sh",
            kib,
        ]);
        let output = shell.arg(env!("CARGO_BIN_EXE_rtc")).output().expect("a shell");
        let (code, text) = said(&output);
        assert_eq!((code, text.as_str()), (Some(0), ""), "{kib} KiB");
    }
}

#[test]
fn what_gives_light_may_move_from_key_to_key_and_not_turn() {
    let lamp = |keys: &str| {
        let eye = "shutter = 0ms..20ms, from";
        let lamp = "material lamp: emissive { color = linear(1) }\n";
        let text = format!("rts 1\n{}{lamp}", GOOD.replacen("from", eye, 1));
        let panel = "instance panel { shape = rectangle(size: (1, 1)m), material = lamp";
        format!(
            "{text}{panel}, at = [0ms: (0, 2, 0)m, 9ms: (1, 2, 0)m, 20ms: (1, 3, 0)m]{keys} }}\n"
        )
    };
    let turns = lamp(", rotate = [0ms: (0, 0, 0)deg, 20ms: (0, 90, 0)deg]");
    let folder = folder(&[("moves.rts", &lamp("")), ("turns.rts", &turns)]);
    assert_eq!(check(folder.path(), &["moves.rts"]), (Some(0), String::new()));
    let (code, text) = check(folder.path(), &["turns.rts", "--error-format", "short"]);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("E0806") && text.contains("gives light and turns"), "{text}");
}

#[test]
fn the_guide_shows_what_is_printed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = |name: &str| std::fs::read_to_string(root.join(name)).expect("a page");
    let (readme, guide) = (page("README.md"), page("docs/guide.md"));
    let block = |text: &str, begin: &str| {
        let (_, rest) = text.split_once(begin).expect("the block begins");
        rest.split_once("```").expect("the block ends").0.to_owned()
    };
    let scene = block(&readme, "```rts\n").replace("material = glass", "material = glas");
    let folder = folder(&[("scene.rts", &scene)]);
    let (_, text) = check(folder.path(), &["scene.rts"]);
    assert!(text.starts_with(&block(&guide, "```text\n")), "{text}");
}
