//! Signals and time limits.

use std::io;
use std::time::Duration;

use super::lab::SCENE;
use super::{Lab, Row};

/// Tries of each signal.
const TRIES: usize = 10;

pub(super) fn rows(lab: &Lab) -> io::Result<Vec<Row>> {
    lab.pack("stop", SCENE)?;
    Ok(vec![signals(lab)?, times(lab)?, kept(lab)?])
}

/// The first signal ends a run, and what is complete is written.
fn signals(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "SIGINT, SIGTERM and SIGHUP at a random moment of a run",
        "exit 130 within 2 s; the picture or a line that says there is none",
    );
    for signal in ["INT", "TERM", "HUP"] {
        for i in 0..TRIES {
            drop(std::fs::remove_file(lab.at("stop.png")));
            let started = lab.start(
                "",
                &[
                    "rtr",
                    "stop.pack",
                    "--spp",
                    "1000000",
                    "--size",
                    "320x180",
                    "--device",
                    "cpu",
                    "-o",
                    "stop.png",
                ],
            )?;
            std::thread::sleep(Duration::from_millis(300 + 70 * i as u64));
            let since = started.age();
            started.signal(signal)?;
            let outcome = started.finish()?;
            let slow = outcome.later_than(since, Duration::from_secs(2));
            let silent = !lab.at("stop.png").is_file() && !outcome.said.contains("no sample");
            row.note(
                signal,
                &outcome,
                outcome.unless(&[130]).or(slow).or(silent.then(|| "no picture".to_owned())),
            );
        }
    }
    Ok(row)
}

/// Time limits hold, whatever the size of the film.
fn times(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "`--time 2s` at 160x90 to 16384x16384",
        "2 s of rendering, 10 % or 1 s more, writing apart",
    );
    for size in ["160x90", "1920x1080", "7680x4320", "16384x16384"] {
        let outcome = lab.run(
            "",
            &[
                "rtr",
                "stop.pack",
                "--spp",
                "1000000",
                "--size",
                size,
                "--time",
                "2s",
                "--device",
                "cpu",
                "-o",
                "/dev/null",
                "--checkpoint-every",
                "never",
            ],
        )?;
        let line = outcome.said.lines().find(|line| line.contains(" spp in ")).unwrap_or_default();
        let seconds = line.split(" spp in ").nth(1).and_then(|rest| rest.split('s').next());
        let seconds: Option<f64> = seconds.and_then(|text| text.parse().ok());
        let late = match seconds {
            Some(seconds) if seconds <= 3.0 => None,
            Some(seconds) => Some(format!("{seconds} s")),
            None => Some("no time in what it says".to_owned()),
        };
        row.note(size, &outcome, outcome.unless(&[0]).or(late));
    }
    Ok(row)
}

/// A checkpoint survives a run that was not asked to go on from it.
fn kept(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "a run without `--resume` beside a checkpoint",
        "the checkpoint is kept, and a line says where",
    );
    for name in ["kept.png", "kept.png.checkpoint"] {
        drop(std::fs::remove_file(lab.at(name)));
    }
    let args = [
        "rtr",
        "stop.pack",
        "--spp",
        "1000000",
        "--size",
        "320x180",
        "--device",
        "cpu",
        "-o",
        "kept.png",
    ];
    let started = lab.start("", &args)?;
    std::thread::sleep(Duration::from_millis(1500));
    started.signal("INT")?;
    let outcome = started.finish()?;
    row.note("interrupted", &outcome, outcome.unless(&[130]));
    let before = std::fs::read(lab.at("kept.png.checkpoint"))?;
    for _ in 0..3 {
        let started = lab.start("", &args)?;
        std::thread::sleep(Duration::from_millis(700));
        started.signal("INT")?;
        let outcome = started.finish()?;
        let folder = std::fs::read_dir(lab.at("."))?.flatten();
        let mut kept = folder
            .filter(|entry| entry.file_name().to_string_lossy().starts_with("kept.png.checkpoint"));
        let there =
            kept.any(|entry| std::fs::read(entry.path()).is_ok_and(|bytes| bytes == before));
        row.note(
            "again",
            &outcome,
            outcome.unless(&[130]).or((!there).then(|| "the checkpoint is gone".to_owned())),
        );
    }
    Ok(row)
}
