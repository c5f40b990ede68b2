//! Packs that are damaged, on the disk and while they are rendered.

use std::io::{self, Write as _};
use std::time::Duration;

use pack::{Kind, Pack};

use super::lab::SCENE;
use super::{Lab, Row};
use crate::statistics::stream::Stream;

/// Tries of each change while a pack is open.
const CHANGES: usize = 10;

pub(super) fn rows(lab: &Lab) -> io::Result<Vec<Row>> {
    Ok(vec![changes(lab)?, pipes(lab)?])
}

/// Where a section begins in the file, and how long it is.
fn section(bytes: &[u8], kind: Kind) -> Option<std::ops::Range<usize>> {
    let pack = Pack::from_bytes(bytes.to_vec()).ok()?;
    let part = pack.section_bytes(kind)?;
    let start = bytes.windows(part.len()).position(|window| window == part)?;
    Some(start..start + part.len())
}

/// A change of a file, by name.
type Change<'a> = (&'a str, Box<dyn Fn() -> io::Result<()> + 'a>);

/// Changes of the file while it is rendered.
fn changes(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "a pack truncated, overwritten in place or replaced while it is rendered",
        "exit 3 within 5 s; no picture",
    );
    let pack = lab.pack("open", SCENE)?;
    let good = std::fs::read(&pack)?;
    let nodes = [Kind::WIDENODE, Kind::NODE].into_iter().find_map(|kind| section(&good, kind));
    let nodes = nodes.ok_or_else(|| io::Error::other("the pack has no nodes"))?;
    let overwrite = |bytes: &[u8], at: usize| -> io::Result<()> {
        use std::os::unix::fs::FileExt as _;
        std::fs::File::options().write(true).open(&pack)?.write_all_at(bytes, at as u64)
    };
    let all: [Change<'_>; 5] = [
        ("truncate -s 0", Box::new(|| std::fs::File::create(&pack).map(drop))),
        (
            "truncate -s half",
            Box::new(|| {
                std::fs::File::options().write(true).open(&pack)?.set_len(good.len() as u64 / 2)
            }),
        ),
        (
            "cp another",
            Box::new(|| {
                let mut file = std::fs::File::create(&pack)?;
                file.write_all(&good[..good.len() / 3])
            }),
        ),
        (
            "nodes that point to themselves",
            Box::new(|| overwrite(&vec![0; nodes.len()], nodes.start)),
        ),
        ("nodes of 0xff", Box::new(|| overwrite(&vec![0xff; nodes.len()], nodes.start))),
    ];
    let mut random = Stream::new(7, 0);
    for (what, change) in &all {
        for _ in 0..CHANGES {
            drop(std::fs::remove_file(&pack));
            std::fs::write(&pack, &good)?;
            drop(std::fs::remove_file(lab.at("open.exr")));
            let started = lab.start(
                "",
                &[
                    "rtr",
                    "open.pack",
                    "--spp",
                    "1000000",
                    "--size",
                    "320x180",
                    "--device",
                    "cpu",
                    "-o",
                    "open.exr",
                ],
            )?;
            std::thread::sleep(Duration::from_millis(150 + random.index(500) as u64));
            let since = started.age();
            change()?;
            let outcome = started.finish()?;
            let slow = outcome.later_than(since, Duration::from_secs(5));
            let picture = lab.at("open.exr").exists().then(|| "a picture was written".to_owned());
            row.note(what, &outcome, outcome.unless(&[3]).or(slow).or(picture));
        }
    }
    Ok(row)
}

/// What is no file where packs, checkpoints and parts are read.
fn pipes(lab: &Lab) -> io::Result<Row> {
    let mut row =
        Row::new("a pipe or a device as pack, part, reference or checkpoint", "exit 3 at once");
    for name in ["pipe.pack", "pipe.exr", "c.exr.checkpoint"] {
        drop(std::fs::remove_file(lab.at(name)));
        std::process::Command::new("mkfifo").arg(lab.at(name)).status()?;
    }
    for args in [
        &["rtr", "pipe.pack", "--device", "cpu"][..],
        &["rtr", "/dev/zero", "--device", "cpu"],
        &["rtr", "check", "pipe.pack"],
        &["rtr", "merge", "pipe.exr", "-o", "x.exr"],
        &["rtr", "merge", "/dev/zero", "-o", "x.exr"],
        &["rtr", "open.pack", "--reference", "pipe.exr", "--device", "cpu", "-o", "x.exr"],
        &["rtr", "open.pack", "-o", "c.exr", "--resume", "--device", "cpu"],
        &["rtc", "inspect", "pipe.pack"],
    ] {
        let outcome = lab.run("", args)?;
        row.note(&args.join(" "), &outcome, outcome.unless(&[3]));
    }
    Ok(row)
}
