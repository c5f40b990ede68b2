//! Little memory, few threads, few files, a small stack.

use std::io;

use super::lab::SCENE;
use super::{Lab, Row};

pub(super) fn rows(lab: &Lab) -> io::Result<Vec<Row>> {
    lab.pack("limits", SCENE)?;
    // Files and folders of the cache are made, so that every run does the same.
    let commands: [&[&str]; 3] = [
        &["rtc", "limits.rts", "-o", "l.pack", "--no-cache"],
        &["rtr", "limits.pack", "--spp", "1", "--size", "64x36", "--device", "cpu", "-o", "l.png"],
        &[
            "rtr",
            "limits.pack",
            "--spp",
            "1",
            "--size",
            "16384x16384",
            "--crop",
            "0,0,16384,8192",
            "--device",
            "cpu",
            "--time",
            "1s",
            "-o",
            "l.png",
        ],
    ];
    let memory: Vec<String> = [20, 30, 40, 60, 100, 150, 200, 300, 500, 1000, 2000, 4000, 8000]
        .iter()
        .map(|mb| format!("ulimit -v {};", mb * 1000))
        .collect();
    let others: Vec<String> =
        ["-u 1", "-u 2", "-n 4", "-n 8", "-n 16", "-s 32", "-s 64", "-s 128", "-s 1024"]
            .iter()
            .map(|limit| format!("ulimit {limit};"))
            .collect();
    let mut rows = Vec::new();
    for (name, limits, commands) in [
        ("address space of 20 MB to 8 GB, films up to 134 million pixels", memory, &commands[..]),
        ("one or two threads, 4 to 16 files, stacks of 32 kB to 1 MB", others, &commands[..2]),
    ] {
        let mut row = Row::new(name, "exit 0 or 3");
        for limit in &limits {
            for args in commands {
                let outcome = lab.run(limit, args)?;
                row.note(&format!("{limit} {}", args.join(" ")), &outcome, outcome.unless(&[0, 3]));
            }
        }
        rows.push(row);
    }
    Ok(rows)
}
