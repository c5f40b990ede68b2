//! `rtr view` without a browser: who is let in, what is served, how it ends.

#![cfg(unix)]

mod common;

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A server that a failing test does not leave behind.
struct Served {
    child: Child,
    /// Host and port, and the secret.
    host: String,
    token: String,
    folder: tempfile::TempDir,
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Status, and what follows the head.
type Answer = (u16, Vec<u8>);

impl Served {
    fn start(spp: &str) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        put(folder.path(), &common::pack_bytes(&common::features()));
        let mut child = Command::new(env!("CARGO_BIN_EXE_rtr"))
            .current_dir(folder.path())
            .args(["view", "marbles.pack", "--port", "0", "--no-browser", "--spp", spp])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("rtr starts");
        let mut url = String::new();
        BufReader::new(child.stdout.take().expect("piped")).read_line(&mut url).expect("a line");
        let rest = url.trim().strip_prefix("http://").expect("a URL");
        let (host, token) = rest.trim_end_matches('/').split_once('/').expect("a secret");
        let (host, token) = (host.to_owned(), token.to_owned());
        Self { child, host, token, folder }
    }

    fn send(&self, text: &str) -> Answer {
        let mut stream = TcpStream::connect(&self.host).expect("it listens");
        stream.set_read_timeout(Some(Duration::from_secs(10))).expect("a socket");
        stream.write_all(text.as_bytes()).expect("it reads");
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).expect("it answers");
        let head = bytes.windows(4).position(|end| end == b"\r\n\r\n").expect("a head") + 4;
        let status = std::str::from_utf8(&bytes[9..12]).expect("text").parse().expect("a status");
        (status, bytes.split_off(head))
    }

    fn ask(&self, method: &str, route: &str, lines: &str, body: &str) -> Answer {
        let (host, token) = (&self.host, &self.token);
        let host =
            if lines.contains("Host:") { String::new() } else { format!("Host: {host}\r\n") };
        self.send(&format!(
            "{method} /{token}/{route} HTTP/1.1\r\n{host}{lines}Content-Length: {}\r\n\r\n{body}",
            body.len()
        ))
    }

    fn get(&self, route: &str) -> Answer {
        self.ask("GET", route, "", "")
    }

    fn post(&self, route: &str, body: &Value) -> u16 {
        self.ask("POST", route, &format!("Origin: http://{}\r\n", self.host), &body.to_string()).0
    }

    /// The first state that `is` so.
    fn state(&self, is: impl Fn(&Value) -> bool) -> Value {
        let mut stream = TcpStream::connect(&self.host).expect("it listens");
        stream.set_read_timeout(Some(Duration::from_secs(20))).expect("a socket");
        let (host, token) = (&self.host, &self.token);
        write!(stream, "GET /{token}/events HTTP/1.1\r\nHost: {host}\r\n\r\n").expect("it reads");
        let mut last = Value::Null;
        for line in BufReader::new(stream).lines() {
            let line = line.unwrap_or_else(|error| panic!("{error} after {last}"));
            let Some(text) = line.strip_prefix("data: ") else { continue };
            last = serde_json::from_str(text).expect("JSON");
            if is(&last) {
                return last;
            }
        }
        panic!("it ended after {last}");
    }
}

fn put(folder: &Path, bytes: &[u8]) {
    std::fs::write(folder.join("new"), bytes).expect("writable");
    std::fs::rename(folder.join("new"), folder.join("marbles.pack")).expect("writable");
}

#[test]
fn only_pages_of_this_machine_that_know_the_secret_get_anything() {
    let served = Served::start("4");
    let (host, token) = (&served.host, &served.token);
    for path in ["/".to_owned(), "/film".to_owned(), format!("/{}0/", &token[..31])] {
        let answer = served.send(&format!("GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n"));
        assert_eq!(answer, (403, b"forbidden\n".to_vec()), "{path}");
    }
    for lines in ["Host: evil.example\r\n", "Origin: http://evil.example\r\n", "Origin: null\r\n"] {
        for route in ["", "film", "events", "pick?x=1&y=1"] {
            assert_eq!(served.ask("GET", route, lines, "").0, 403, "{lines}{route}");
        }
        assert_eq!(served.ask("POST", "stop", lines, "true").0, 403, "{lines}");
    }
    // Through a tunnel the port is another.
    assert_eq!(served.ask("GET", "", "Host: localhost:1\r\n", "").0, 200);
    assert_eq!(served.get("nothing").0, 404);
    assert_eq!(served.get("camera").0, 405);
    assert_eq!(served.ask("POST", "camera", "", &" ".repeat(5000)).0, 413);
    assert_eq!(served.send("nonsense\r\n\r\n").0, 400);
}

#[test]
fn the_picture_grows_and_can_be_fetched_and_asked() {
    let served = Served::start("8");
    let (status, page) = served.get("");
    assert_eq!(status, 200);
    assert!(String::from_utf8_lossy(&page).contains("view.js"));
    let state = served.state(|state| state["phase"] == "done");
    assert_eq!(state["shot"]["samples"], 8, "{state}");
    assert_eq!(state["shot"]["size"], json!(common::SIZE), "{state}");
    assert!(state["error"].as_f64().is_some_and(|error| error > 0.0), "{state}");
    assert!(state["text"].as_str().is_some_and(|text| text.contains("fov.horizontal")), "{state}");
    let (status, film) = served.get("film");
    let n = (common::SIZE[0] * common::SIZE[1]) as usize;
    assert_eq!((status, film.len()), (200, 16 + 6 * n));
    let words: Vec<u32> =
        film[..16].chunks(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
    assert_eq!(words[..3], [common::SIZE[0], common::SIZE[1], 8]);
    let (status, pick) = served.get("pick?x=36&y=35");
    let pick: Value = serde_json::from_slice(&pick).expect("JSON");
    assert_eq!((status, &pick["pixel"]), (200, &json!([36, 35])));
    assert!(pick["surface"]["distance"].as_f64().is_some_and(|metres| metres > 0.0), "{pick}");
    for query in ["pick", "pick?x=1", "pick?x=-1&y=0", "pick?x=72&y=0", "pick?x=a&y=b"] {
        assert_eq!(served.get(query).0, 400, "{query}");
    }
}

#[test]
fn another_camera_shows_another_picture_and_nonsense_is_no_camera() {
    let served = Served::start("4");
    let first = served.state(|state| state["phase"] == "done");
    let film = |served: &Served| served.get("film").1.split_off(16);
    let before = film(&served);
    let mut view = first["view"].clone();
    view["from"] = json!([0.5, 0.4, 0.9]);
    assert_eq!(served.post("camera", &view), 204);
    let moved = served.state(|state| state["phase"] == "done" && state["view"] == view);
    assert_ne!(film(&served), before);
    assert!(
        moved["text"].as_str().is_some_and(|text| text.contains("from = (0.5, 0.4, 0.9)m")),
        "{moved}"
    );
    for (field, value) in [
        ("from", view["to"].clone()),
        ("from", json!([1e300, 0, 0])),
        ("up", json!([0, 0, 0])),
        ("fov", json!(0)),
        ("fov", json!(180)),
        ("focus", json!(-1)),
        ("aperture", json!(-1)),
        ("to", json!("there")),
        ("more", json!(1)),
    ] {
        let mut wrong = view.clone();
        wrong[field] = value;
        assert_eq!(served.post("camera", &wrong), 400, "{wrong}");
    }
    assert_eq!(served.post("camera", &Value::Null), 204);
    served.state(|state| state["phase"] == "done" && state["view"] == first["view"]);
    assert_eq!(film(&served), before, "the same samples again");
}

#[test]
fn it_stops_goes_on_and_shows_a_new_pack_from_the_same_place() {
    let served = Served::start("1000000");
    let state = served.state(|state| state["shot"]["size"] == json!(common::SIZE));
    assert_eq!(served.post("stop", &json!(true)), 204);
    served.state(|state| state["phase"] == "stopped");
    std::thread::sleep(Duration::from_millis(700));
    let samples = |state: &Value| state["shot"]["samples"].as_u64().expect("a number");
    let rest = samples(&served.state(|_| true));
    std::thread::sleep(Duration::from_millis(700));
    assert_eq!(samples(&served.state(|_| true)), rest);
    assert_eq!(served.post("stop", &json!(false)), 204);
    served.state(|state| samples(state) > rest);
    let mut view = state["view"].clone();
    view["from"] = json!([0.5, 0.4, 0.9]);
    assert_eq!(served.post("camera", &view), 204);
    // A broken pack is told over the picture, and a whole one takes its place.
    put(served.folder.path(), b"nothing");
    let broken = served.state(|state| state["message"].is_string());
    assert!(broken["shot"].is_object(), "{broken}");
    let kernel = shaders::link(&common::features()).expect("it links").text + "\n";
    put(served.folder.path(), &common::pack_with_kernel(&kernel));
    let state = served.state(|state| state["message"].is_null() && state["shot"]["samples"] != 0);
    assert_eq!(state["view"], view);
}

#[test]
fn an_interrupt_ends_it_whoever_listens() {
    let mut served = Served::start("1000000");
    served.state(|state| state["shot"].is_object());
    let mut listener = TcpStream::connect(&served.host).expect("it listens");
    write!(listener, "GET /{}/events HTTP/1.1\r\nHost: {}\r\n\r\n", served.token, served.host)
        .expect("it reads");
    let idle = TcpStream::connect(&served.host).expect("it listens");
    let began = Instant::now();
    Command::new("kill").args(["-INT", &served.child.id().to_string()]).status().expect("kill");
    assert_eq!(served.child.wait().expect("it ends").code(), Some(0));
    assert!(began.elapsed() < Duration::from_secs(2), "{:?}", began.elapsed());
    drop((listener, idle));
}

#[test]
fn a_port_that_is_taken_is_told_in_one_line() {
    let served = Served::start("4");
    let port = served.host.rsplit_once(':').expect("a port").1;
    let output = Command::new(env!("CARGO_BIN_EXE_rtr"))
        .current_dir(served.folder.path())
        .args(["view", "marbles.pack", "--no-browser", "--port", port])
        .output()
        .expect("rtr starts");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.starts_with("error: cannot listen at 127.0.0.1:"), "{said}");
    assert!(said.contains("--port") && said.lines().count() == 1, "{said}");
}
