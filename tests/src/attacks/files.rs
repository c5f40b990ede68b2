//! Outputs that would replace something, or that cannot be written.

use std::io;
use std::process::Command;

use super::lab::SCENE;
use super::{Lab, Row};

pub(super) fn rows(lab: &Lab) -> io::Result<Vec<Row>> {
    Ok(vec![replaced(lab)?, nodes(lab)?, unwritable(lab)?, late(lab)?, unread(lab)?, names(lab)?])
}

/// Inputs and outputs, under all of their names, as outputs.
fn replaced(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "an output that is an input or another output: by name, `./name`, symbolic and hard link",
        "exit 2 or 3; nothing replaced",
    );
    lab.pack("s", SCENE)?;
    lab.put("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")?;
    let with_mesh = SCENE.replace(
        "camera",
        "asset tri = obj(\"t.obj\", unit: m, up: +y)
material paint: diffuse { color = linear(0.5) }
instance third { shape = tri, material = paint }
camera",
    );
    lab.pack("m", &with_mesh)?;
    let made = lab.run(
        "",
        &["rtr", "s.pack", "--spp", "1", "--size", "4x4", "-o", "part.exr", "--device", "cpu"],
    )?;
    assert_eq!(made.code, Some(0), "{}", made.said);
    for (name, of) in [("m.rts", "soft.rts"), ("t.obj", "soft.obj"), ("s.pack", "soft.exr")] {
        drop(std::fs::remove_file(lab.at(of)));
        std::os::unix::fs::symlink(name, lab.at(of))?;
        let hard = of.replace("soft", "hard");
        drop(std::fs::remove_file(lab.at(&hard)));
        std::fs::hard_link(lab.at(name), lab.at(&hard))?;
    }
    let inputs = ["s.rts", "m.rts", "t.obj", "s.pack", "part.exr"];
    let before: Vec<Vec<u8>> =
        inputs.iter().map(|name| std::fs::read(lab.at(name))).collect::<Result<_, _>>()?;
    let rtr = |rest: &[&'static str]| -> Vec<&'static str> {
        let common = ["rtr", "s.pack", "--spp", "1", "--size", "4x4", "--device", "cpu"];
        common.into_iter().chain(rest.iter().copied()).collect()
    };
    let mut tries: Vec<Vec<&str>> = Vec::new();
    for flag in ["-o", "--depfile", "--emit-wgsl"] {
        for name in ["m.rts", "./m.rts", "soft.rts", "hard.rts", "t.obj", "soft.obj", "hard.obj"] {
            tries.push(vec!["rtc", "m.rts", flag, name]);
        }
    }
    tries.push(vec!["rtc", "m.rts", "-o", "x", "--depfile", "x"]);
    tries.push(vec!["rtc", "m.rts", "-o", "x", "--emit-wgsl", "./x"]);
    tries.push(rtr(&["-o", "x.exr", "-o", "./x.exr"]));
    tries.push(rtr(&["-o", "soft.exr"]));
    tries.push(rtr(&["-o", "hard.exr"]));
    tries.push(rtr(&["-o", "x.png", "--plot", "x.png"]));
    tries.push(rtr(&["-o", "part.exr", "--reference", "part.exr"]));
    tries.push(vec!["rtr", "merge", "part.exr", "-o", "part.exr"]);
    tries.push(vec!["rtr", "check", "s.pack", "--heat", "s.pack"]);
    tries.push(vec!["rtr", "bench", "s.pack", "s.pack", "--report", "s.pack"]);
    for args in tries {
        let outcome = lab.run("", &args)?;
        let mut fault = outcome.unless(&[2, 3]);
        for (name, bytes) in inputs.iter().zip(&before) {
            if std::fs::read(lab.at(name))? != *bytes {
                fault = Some(format!("{name} was replaced"));
                lab.put(name, bytes)?;
            }
        }
        row.note(&args.join(" "), &outcome, fault);
    }
    Ok(row)
}

/// Devices and pipes as outputs.
fn nodes(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "devices, pipes, links and folders as outputs",
        "written to, or exit 3; still what they were",
    );
    Command::new("mkfifo").arg(lab.at("pipe")).status()?;
    std::fs::create_dir_all(lab.at("dir.png"))?;
    let kind = |name: &str| std::fs::symlink_metadata(lab.at(name)).map(|data| data.file_type());
    for (name, codes) in
        [("/dev/null", &[0][..]), ("/dev/full", &[3]), ("pipe", &[0]), ("dir.png", &[3])]
    {
        let before = kind(name)?;
        for program in ["rtc", "rtr"] {
            let pipe = lab.at("pipe");
            let reader = (name == "pipe").then(|| std::thread::spawn(move || std::fs::read(pipe)));
            let args: &[&str] = match program {
                "rtc" => &["rtc", "s.rts", "-o", name],
                _ => {
                    &["rtr", "s.pack", "--spp", "1", "--size", "4x4", "--device", "cpu", "-o", name]
                }
            };
            let outcome = lab.run("", args)?;
            let mut fault = outcome.unless(codes);
            if kind(name)? != before {
                fault = Some(format!("{name} was replaced"));
            }
            if let Some(reader) = reader {
                let read =
                    reader.join().is_ok_and(|bytes| bytes.is_ok_and(|bytes| !bytes.is_empty()));
                fault = fault.or((!read).then(|| "nothing came through the pipe".to_owned()));
            }
            row.note(&args.join(" "), &outcome, fault);
        }
    }
    Ok(row)
}

/// Places that cannot be written.
fn unwritable(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "folders that are not there, names that are too long, a name that is no folder",
        "exit 3 before the first sample",
    );
    let long = format!("{}.exr", "x".repeat(300));
    for name in ["none/a.exr", "s.rts/a.exr", &long] {
        let args = ["rtr", "s.pack", "--spp", "100000", "--device", "cpu", "-o", name];
        let outcome = lab.run("", &args)?;
        let slow = (outcome.time.as_secs() > 5).then(|| "it rendered first".to_owned());
        row.note(name, &outcome, outcome.unless(&[3]).or(slow));
    }
    Ok(row)
}

/// Folders that vanish while a picture is rendered.
fn late(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "the folder of the picture vanishes while it is rendered",
        "exit 3; the picture is elsewhere",
    );
    for _ in 0..5 {
        std::fs::create_dir_all(lab.at("gone"))?;
        drop(std::fs::remove_file(lab.at("late.exr")));
        let args = [
            "rtr",
            "s.pack",
            "--time",
            "1s",
            "--spp",
            "100000",
            "--device",
            "cpu",
            "--size",
            "64x64",
            "-o",
            "gone/late.exr",
        ];
        let started = lab.start("", &args)?;
        std::thread::sleep(std::time::Duration::from_millis(500));
        std::fs::remove_dir_all(lab.at("gone"))?;
        let outcome = started.finish()?;
        let lost = (!lab.at("late.exr").is_file()).then(|| "the picture is gone".to_owned());
        row.note("gone/late.exr", &outcome, outcome.unless(&[3]).or(lost));
    }
    Ok(row)
}

/// Standard output that takes nothing.
fn unread(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new("standard output on a full disk", "exit 3");
    for args in [
        &["rtc", "show", "--resolved", "s.rts"][..],
        &["rtc", "inspect", "s.pack"],
        &["rtc", "explain", "E0301"],
        &["rtc", "s.rts", "-o", "-"],
        &["rtr", "--list-devices"],
        &["rtr", "s.pack", "-o", "-", "--spp", "1", "--size", "4x4", "--device", "cpu"],
    ] {
        let outcome = lab.run("exec >/dev/full;", args)?;
        row.note(&args.join(" "), &outcome, outcome.unless(&[3]));
    }
    Ok(row)
}

/// Names that scenes and packs carry.
fn names(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "names with escape sequences, line breaks and `..` in scenes, packs and files",
        "printed as `\\u{1b}`; nothing replaced",
    );
    lab.put("dear.png", "dear")?;
    let named =
        |name: &str| SCENE.replace("samples = 16", &format!("samples = 1, output = \"{name}\""));
    for (i, name) in
        ["dear.png", "../dear", "/tmp/dear", "a\u{1b}[2Jb", "a\u{9b}2Jb"].iter().enumerate()
    {
        let scene = format!("n{i}");
        lab.put(&format!("{scene}.rts"), named(name))?;
        let compiled = lab.run("", &["rtc", &format!("{scene}.rts")])?;
        let raw =
            |said: &str| said.contains(['\u{1b}', '\u{9b}']).then(|| "raw escapes".to_owned());
        row.note(name, &compiled, compiled.unless(&[0, 1]).or(raw(&compiled.said)));
        if compiled.code == Some(0) {
            let pack = format!("{scene}.pack");
            let outcome = lab.run("", &["rtr", &pack, "--size", "4x4", "--device", "cpu"])?;
            let replaced = (std::fs::read(lab.at("dear.png"))? != b"dear")
                .then(|| "a file was replaced".to_owned());
            row.note(name, &outcome, outcome.unless(&[0]).or(raw(&outcome.said)).or(replaced));
        }
    }
    for name in ["evil\u{1b}[2J.rts", "evil\nerror: all is lost.rts"] {
        for program in ["rtc", "rtr"] {
            let outcome = lab.run("", &[program, name])?;
            let raw = outcome.said.contains('\u{1b}')
                || outcome.said.lines().any(|line| line == "error: all is lost.rts");
            row.note(
                name,
                &outcome,
                outcome.unless(&[3]).or(raw.then(|| "raw escapes".to_owned())),
            );
        }
    }
    Ok(row)
}
