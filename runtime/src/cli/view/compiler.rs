//! `rtc --watch` as a child: what it prints → what is wrong with the scene, compilation by compilation.

use std::io::{self, BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// The compiler at work. It ends with this value.
pub(super) struct Compiler {
    child: Child,
    lines: Receiver<String>,
    /// What was printed since the last change.
    log: Log,
    is_over: bool,
}

/// What a compilation says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum News {
    /// A line, for the terminal.
    Line(String),
    /// A compilation has ended well.
    Well,
    /// It has not, and this is why.
    Wrong(String),
}

/// The `rtc` beside this program.
pub(super) fn beside() -> Option<PathBuf> {
    let own = std::env::current_exe().ok()?;
    let rtc = own.with_file_name(format!("rtc{}", std::env::consts::EXE_SUFFIX));
    rtc.is_file().then_some(rtc)
}

impl Compiler {
    /// Compiles `scene` to `pack` at every change.
    ///
    /// # Errors
    /// When the program cannot be started.
    pub(super) fn start(rtc: &Path, scene: &Path, pack: &Path) -> io::Result<Self> {
        let mut child = Command::new(rtc)
            .arg(scene)
            .arg("-o")
            .arg(pack)
            .args(["--watch", "--color", "never"])
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()?;
        let stderr = child.stderr.take().ok_or(io::ErrorKind::BrokenPipe)?;
        let (send, lines) = channel();
        let read = move || {
            let lines = BufReader::new(stderr).lines().map_while(Result::ok);
            // It ends when nobody listens any more.
            lines.map(|line| send.send(line)).find(Result::is_err)
        };
        std::thread::Builder::new().name("rtr-compiler".to_owned()).spawn(read)?;
        Ok(Self { child, lines, log: Log::default(), is_over: false })
    }

    /// What has been said since the last call.
    pub(super) fn news(&mut self) -> Vec<News> {
        let mut news = Vec::new();
        while !self.is_over {
            match self.lines.try_recv() {
                Ok(line) => {
                    news.push(News::Line(line.clone()));
                    news.extend(self.log.add(&line));
                }
                Err(TryRecvError::Empty) => break,
                Err(TryRecvError::Disconnected) => {
                    self.is_over = true;
                    news.push(News::Wrong(format!("{}rtc has ended", self.log.text)));
                }
            }
        }
        news
    }
}

impl Drop for Compiler {
    fn drop(&mut self) {
        // One that has ended already cannot be killed, and need not be.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Lines of one compilation.
#[derive(Debug, Default)]
struct Log {
    text: String,
    is_wrong: bool,
}

impl Log {
    /// What follows from a line.
    fn add(&mut self, line: &str) -> Option<News> {
        if line.starts_with("changed: ") {
            *self = Self::default();
            return None;
        }
        if line.starts_with("watching ") {
            let log = std::mem::take(self);
            return Some(if log.is_wrong {
                News::Wrong(log.text.trim().to_owned())
            } else {
                News::Well
            });
        }
        self.is_wrong |= line.starts_with("error");
        self.text.push_str(line);
        self.text.push('\n');
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_compilation_is_judged_by_what_it_prints() {
        let mut log = Log::default();
        let mut add = |lines: &[&str]| lines.iter().filter_map(|line| log.add(line)).collect();
        let watching = "watching 2 files; press Ctrl-C to stop";
        let found: Vec<News> = add(&["wrote a.pack", watching]);
        assert_eq!(found, [News::Well]);
        let found: Vec<News> = add(&[
            "",
            "changed: a.rts",
            "error[E0202]: no material named `glas`",
            " --> a.rts:5:58",
            watching,
        ]);
        let text = "error[E0202]: no material named `glas`\n --> a.rts:5:58";
        assert_eq!(found, [News::Wrong(text.to_owned())]);
        let found: Vec<News> = add(&["", "changed: a.rts", "warning: unused", watching]);
        assert_eq!(found, [News::Well]);
    }
}
