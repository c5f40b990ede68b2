//! A folder to break things in, and programs run in it under limits of space and time.

use std::io::{self, Read as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A scene of one sphere over a floor.
pub(super) const SCENE: &str = "rts 1
material clay: diffuse { color = srgb(#b5533c) }
instance floor { shape = rectangle(size: (4, 4)m), material = clay }
instance ball { shape = sphere(radius: 40cm), material = clay, at = (0, 40, 0)cm }
light lamp: sphere { center = (2, 4, 3)m, radius = 25cm, color = blackbody(3200K), strength = 40 }
camera eye: perspective { from = (0, 1.2, 4)m, to = (0, 0.4, 0)m }
render main: path { samples = 16 }
";

/// No try takes longer; what does is killed.
const PATIENCE: Duration = Duration::from_mins(1);
/// More output than this is an attack on whoever reads it.
const MOST_OUTPUT: usize = 1 << 20;

/// Programs and a folder.
pub struct Lab {
    rtc: PathBuf,
    rtr: PathBuf,
    folder: tempfile::TempDir,
}

/// How a process ended.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Exit code; `None` after a signal.
    pub code: Option<i32>,
    /// It was killed because it took too long.
    pub late: bool,
    /// What it said.
    pub said: String,
    /// How long it took.
    pub time: Duration,
}

impl Outcome {
    /// A word for the table.
    pub(super) fn end(&self) -> String {
        match (self.late, self.code) {
            (true, _) => "hangs".to_owned(),
            (false, Some(0)) => "done".to_owned(),
            (false, Some(code)) => format!("exit {code}"),
            (false, None) => "killed".to_owned(),
        }
    }

    /// Signs of a crash, whatever the exit code.
    pub(super) fn trace(&self) -> Option<String> {
        let signs = ["panicked", "RUST_BACKTRACE", "overflowed its stack", "allocation of"];
        if let Some(sign) = signs.iter().find(|sign| self.said.contains(**sign)) {
            return Some(format!("says `{sign}`"));
        }
        (self.said.len() > MOST_OUTPUT).then(|| format!("prints {} bytes", self.said.len()))
    }

    /// What is wrong when it went on for longer than `most` after `since` of its life.
    pub(super) fn later_than(&self, since: Duration, most: Duration) -> Option<String> {
        let more = self.time.saturating_sub(since);
        (more > most).then(|| format!("{:.1} s later", more.as_secs_f64()))
    }

    /// What is wrong when only these codes are right.
    pub(super) fn unless(&self, codes: &[i32]) -> Option<String> {
        let well = !self.late && self.code.is_some_and(|code| codes.contains(&code));
        (!well).then(|| self.end())
    }

    pub(super) fn first_line(&self) -> String {
        let line = self.said.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
        line.chars().take(160).collect()
    }
}

impl Lab {
    /// A lab for the programs in `programs`.
    pub fn new(programs: &Path) -> io::Result<Self> {
        let find = |name: &str| {
            let path = programs.join(name).with_extension(std::env::consts::EXE_EXTENSION);
            path.is_file().then_some(path).ok_or_else(|| {
                io::Error::other(format!(
                    "there is no {name} in {}: cargo build --release first",
                    programs.display()
                ))
            })
        };
        let (rtc, rtr) = (find("rtc")?, find("rtr")?);
        Ok(Self { rtc, rtr, folder: tempfile::tempdir()? })
    }

    /// The built `rtr`.
    #[must_use]
    pub fn rtr(&self) -> &Path {
        &self.rtr
    }

    pub(super) fn at(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(super) fn put(&self, name: &str, bytes: impl AsRef<[u8]>) -> io::Result<()> {
        std::fs::write(self.at(name), bytes)
    }

    /// Compiles a text to `name.pack`.
    pub(super) fn pack(&self, name: &str, text: &str) -> io::Result<PathBuf> {
        let (scene, pack) = (format!("{name}.rts"), format!("{name}.pack"));
        self.put(&scene, text)?;
        let outcome = self.run("", &["rtc", &scene, "-o", &pack])?;
        match outcome.code {
            Some(0) => Ok(self.at(&pack)),
            _ => Err(io::Error::other(outcome.said)),
        }
    }

    /// Runs `rtc` or `rtr` to its end; `limits`: what the shell does before, such as `ulimit -v 20000;`.
    pub(super) fn run(&self, limits: &str, args: &[&str]) -> io::Result<Outcome> {
        self.start(limits, args)?.finish()
    }

    /// Starts a process.
    pub(super) fn start(&self, limits: &str, args: &[&str]) -> io::Result<Started> {
        let program = if args[0] == "rtc" { &self.rtc } else { &self.rtr };
        let mut command = Command::new("bash");
        // A shell under a small limit may not be able to start anything: the limits come last.
        command.arg("-c").arg(format!("{limits} exec \"$@\"")).arg("bash").arg(program);
        command.args(&args[1..]).current_dir(self.folder.path());
        command.env("RTC_CACHE_DIR", self.at("cache")).env_remove("RUST_BACKTRACE");
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
        let mut child = command.spawn()?;
        let mut pipe = child.stderr.take().ok_or(io::ErrorKind::BrokenPipe)?;
        let reader = std::thread::spawn(move || {
            let mut said = Vec::new();
            drop(pipe.read_to_end(&mut said));
            String::from_utf8_lossy(&said).into_owned()
        });
        Ok(Started { child, reader, start: Instant::now() })
    }
}

/// A process on its way.
pub(super) struct Started {
    child: Child,
    reader: std::thread::JoinHandle<String>,
    start: Instant,
}

impl Started {
    /// Waits for its end.
    pub(super) fn finish(mut self) -> io::Result<Outcome> {
        let mut late = false;
        let status = loop {
            if let Some(status) = self.child.try_wait()? {
                break status;
            }
            if self.start.elapsed() > PATIENCE {
                late = true;
                self.child.kill()?;
            }
            std::thread::sleep(Duration::from_millis(5));
        };
        let time = self.start.elapsed();
        let said = self.reader.join().unwrap_or_default();
        Ok(Outcome { code: status.code(), late, said, time })
    }

    /// Time since its start.
    pub(super) fn age(&self) -> Duration {
        self.start.elapsed()
    }

    /// Sends a signal: `TERM`, `INT`.
    pub(super) fn signal(&self, name: &str) -> io::Result<()> {
        let id = self.child.id().to_string();
        Command::new("kill").args([&format!("-{name}"), &id]).status().map(drop)
    }
}
