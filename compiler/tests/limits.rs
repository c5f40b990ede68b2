//! Limits of the system: `rtc` compiles, or says in one line why not.

#![cfg(unix)]

use std::process::Command;

const SCENE: &str = "rts 1
sky heaven: constant { color = linear(1) }
material clay: diffuse { color = linear(0.5) }
instance ball { shape = sphere(radius: 1m), material = clay }
camera eye: perspective { from = (0, 0, 5)m, to = (0, 0, 0)m, fov.vertical = 40deg }
film f { size = (8, 8)px }
render main: path { camera = eye, film = f, samples = 1, depth = 2 }
";

#[test]
fn limits_are_one_line_and_no_panic() {
    let folder = tempfile::tempdir().expect("a folder for tests");
    std::fs::write(folder.path().join("a.rts"), SCENE).expect("it can be written");
    let rtc = env!("CARGO_BIN_EXE_rtc");
    let mut refused = 0;
    // Where there is no room for the file of the program, 23 MB without optimisation, it never starts.
    let limits = [
        "-v 40000",
        "-v 60000",
        "-v 100000",
        "-v 150000",
        "-v 250000",
        "-v 500000",
        "-d 20000",
        "-s 64",
        "-s 32",
        "-n 4",
        "-n 8",
    ];
    for limit in limits {
        for command in ["build a.rts -o a.pack --no-cache", "check a.rts"] {
            let line = format!("ulimit {limit} && exec '{rtc}' {command}");
            let output = Command::new("sh").current_dir(folder.path()).args(["-c", &line]).output();
            let output = output.expect("sh starts");
            let log = String::from_utf8_lossy(&output.stderr);
            match output.status.code() {
                Some(0) => {}
                Some(3) => {
                    let errors = log.lines().filter(|line| line.starts_with("error: ")).count();
                    assert_eq!(errors, 1, "{limit} {command}: {log}");
                    refused += 1;
                }
                code => panic!("{limit} {command}: {code:?} {:?} {log}", output.status),
            }
            assert!(!log.contains("panicked"), "{limit} {command}: {log}");
        }
    }
    assert!((3..20).contains(&refused), "{refused} of 22");
}

#[test]
fn threads_are_a_number_of_threads() {
    for threads in ["0", "4097", "x"] {
        let output = Command::new(env!("CARGO_BIN_EXE_rtc"))
            .args(["build", "a.rts", "--threads", threads])
            .output()
            .expect("rtc starts");
        assert_eq!(output.status.code(), Some(2), "{threads}");
    }
}
