//! `rtr view` without a browser: who is let in, what is served, how it ends.

#![cfg(unix)]

mod common;

use runtime::output::read_exr;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
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

/// Sends a request to a host and a port.
fn send(host: &str, text: &str) -> Answer {
    let mut stream = TcpStream::connect(host).expect("it listens");
    stream.set_read_timeout(Some(Duration::from_secs(20))).expect("a socket");
    stream.write_all(text.as_bytes()).expect("it reads");
    let mut bytes = Vec::new();
    stream.read_to_end(&mut bytes).expect("it answers");
    let head = bytes.windows(4).position(|end| end == b"\r\n\r\n").expect("a head") + 4;
    let status = std::str::from_utf8(&bytes[9..12]).expect("text").parse().expect("a status");
    (status, bytes.split_off(head))
}

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
        send(&self.host, text)
    }

    fn ask(&self, method: &str, route: &str, lines: &str, body: &str) -> Answer {
        self.send(&self.request(method, route, lines, body))
    }

    /// As `ask`, at another port of this machine.
    fn ask_at(&self, port: u16, method: &str, route: &str, lines: &str, body: &str) -> Answer {
        send(&format!("127.0.0.1:{port}"), &self.request(method, route, lines, body))
    }

    fn request(&self, method: &str, route: &str, lines: &str, body: &str) -> String {
        let (host, token) = (&self.host, &self.token);
        let host =
            if lines.contains("Host:") { String::new() } else { format!("Host: {host}\r\n") };
        format!(
            "{method} /{token}/{route} HTTP/1.1\r\n{host}{lines}Content-Length: {}\r\n\r\n{body}",
            body.len()
        )
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
    // One digit off.
    let digit = if token.ends_with('0') { '1' } else { '0' };
    for path in ["/".to_owned(), "/film".to_owned(), format!("/{}{digit}/", &token[..31])] {
        let answer = served.send(&format!("GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n"));
        assert_eq!(answer, (403, b"forbidden\n".to_vec()), "{path}");
    }
    for lines in ["Host: evil.example\r\n", "Origin: http://evil.example\r\n", "Origin: null\r\n"] {
        for route in ["", "film", "events", "pick?x=1&y=1"] {
            assert_eq!(served.ask("GET", route, lines, "").0, 403, "{lines}{route}");
        }
        assert_eq!(served.ask("POST", "stop", lines, "true").0, 403, "{lines}");
    }
    assert_eq!(served.get("nothing").0, 404);
    assert_eq!(served.get("camera").0, 405);
    assert_eq!(served.ask("POST", "camera", "", &" ".repeat(5000)).0, 413);
    assert_eq!(served.send("nonsense\r\n\r\n").0, 400);
}

/// What `ssh -L` does: listens at a port of its own, and passes on what comes there.
fn tunnel(to: &str) -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("an address").port();
    let to = to.to_owned();
    std::thread::spawn(move || {
        for near in listener.incoming().map_while(Result::ok) {
            let far = TcpStream::connect(&to).expect("it listens");
            let ways = [(&near, &far), (&far, &near)]
                .map(|(a, b)| (a.try_clone().expect("a socket"), b.try_clone().expect("a socket")));
            for (mut from, mut to) in ways {
                std::thread::spawn(move || {
                    let _ = std::io::copy(&mut from, &mut to);
                    let _ = to.shutdown(std::net::Shutdown::Write);
                });
            }
        }
    });
    port
}

#[test]
fn a_page_works_through_a_tunnel_and_only_under_names_of_this_machine() {
    let served = Served::start("4");
    let port = tunnel(&served.host);
    for name in ["localhost", "127.0.0.1", "LOCALHOST", "127.9.9.9", "[::1]"] {
        let ours = format!("Host: {name}:{port}\r\nOrigin: http://{name}:{port}\r\n");
        assert_eq!(served.ask_at(port, "GET", "", &ours, "").0, 200, "{name}");
        assert_eq!(served.ask_at(port, "POST", "camera", &ours, "null").0, 204, "{name}");
        let (status, page) = served.ask_at(port, "GET", "view.js", &ours, "");
        assert_eq!((status, page), served.get("view.js"), "{name}");
        // A page at another port of the same machine is somebody else's.
        let other = format!("Host: {name}:{port}\r\nOrigin: http://{name}:1\r\n");
        assert_eq!(served.ask_at(port, "POST", "camera", &other, "null").0, 403, "{name}");
    }
    for name in ["evil.example", "localhost.evil.example", "10.0.0.7", "127.0.0.1.evil.example"] {
        let foreign = format!("Host: {name}:{port}\r\nOrigin: http://{name}:{port}\r\n");
        for (method, route, body) in
            [("GET", "", ""), ("GET", "film", ""), ("POST", "stop", "true")]
        {
            let answer = served.ask_at(port, method, route, &foreign, body);
            assert_eq!(answer, (403, b"forbidden\n".to_vec()), "{name}/{route}");
        }
    }
}

/// Numbers of a plane: width, height, channels, epoch, samples; then those of the pixels.
fn plane(bytes: &[u8]) -> ([u32; 5], Vec<f32>) {
    let words: Vec<u32> = bytes
        .chunks(4)
        .map(|word| u32::from_le_bytes(word.try_into().expect("four bytes")))
        .collect();
    let (head, values) = words.split_at(5);
    (
        head.try_into().expect("five numbers"),
        values.iter().map(|bits| f32::from_bits(*bits)).collect(),
    )
}

#[test]
fn layers_are_those_of_a_render_and_follow_the_camera() {
    let served = Served::start("4");
    let state = served.state(|state| state["phase"] == "done");
    let rtr = |args: &[&str]| {
        let mut rtr = Command::new(env!("CARGO_BIN_EXE_rtr"));
        let output = rtr.current_dir(served.folder.path()).args(args).output().expect("rtr starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    };
    let render = ["marbles.pack", "--device", "cpu", "--spp", "4", "-o", "a.exr", "--layers"];
    rtr(&[&render[..], &["albedo,normal,depth,instance"]].concat());
    let picture = read_exr(&served.folder.path().join("a.exr")).expect("a picture");
    let layers = picture.layers.expect("it has layers");
    let [w, h] = common::SIZE;
    let epoch = u32::try_from(state["epoch"].as_u64().expect("a number")).expect("a few");
    let get = |name: &str, channels: u32| {
        let (status, bytes) = served.get(&format!("layer?name={name}"));
        assert_eq!(status, 200, "{name}");
        let (head, values) = plane(&bytes);
        assert_eq!(head, [w, h, channels, epoch, 4], "{name}");
        assert_eq!(values.len(), (w * h * channels) as usize, "{name}");
        values
    };
    let depths = get("depth", 1);
    let expected = layers.nearest.iter().map(|nearest| nearest.depth);
    for (found, expected) in depths.iter().zip(expected) {
        // What files hold where nothing is.
        let is_far = found.is_nan() && expected.to_bits() == 1e10_f32.to_bits();
        assert!(is_far || found.to_bits() == expected.to_bits(), "{found} {expected}");
    }
    for (name, sums) in [("albedo", &layers.albedo), ("normal", &layers.normal)] {
        for (found, sum) in get(name, 3).iter().zip(sums.as_flattened()) {
            assert!((f64::from(*found) - sum / 4.0).abs() < 1e-6, "{name}: {found} {sum}");
        }
    }
    let numbers = layers.nearest.iter().map(|nearest| nearest.numbers[1] as f32);
    assert_eq!(get("instance", 1), numbers.collect::<Vec<_>>());
    assert!(get("alpha", 1).iter().all(|alpha| (0.0..=1.0).contains(alpha)));
    assert_eq!(
        (get("uv", 2).len(), get("object", 1).len()),
        (get("material", 1).len() * 2, depths.len())
    );
    // From elsewhere, what is along the view is as far as where it is says.
    let mut view = state["view"].clone();
    view["from"] = json!([0.5, 0.4, 0.9]);
    assert_eq!(served.post("camera", &view), 204);
    let vector = |of: &Value| [0, 1, 2].map(|axis| of[axis].as_f64().expect("a number"));
    let (from, to) = (vector(&view["from"]), vector(&view["to"]));
    let along = [0, 1, 2].map(|axis| to[axis] - from[axis]);
    let length = along.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (_, depths) = plane(&served.get("layer?name=depth").1);
    let (head, places) = plane(&served.get("layer?name=position").1);
    assert_eq!(head[3], epoch + 1);
    let mut seen = 0;
    for (depth, place) in depths.iter().zip(places.chunks(3)).filter(|(depth, _)| !depth.is_nan()) {
        let away = (0..3).map(|i| (f64::from(place[i]) - from[i]) * along[i] / length).sum::<f64>();
        assert!((away - f64::from(*depth)).abs() < 1e-4 * away, "{away} {depth}");
        seen += 1;
    }
    assert!(seen > 100, "{seen} pixels show something");
    for query in ["layer", "layer?name=", "layer?name=crypto", "layer?name=../film", "layer?x=1"] {
        assert_eq!(served.get(query).0, 400, "{query}");
    }
    assert_eq!(served.post("layer?name=depth", &json!(true)), 405);
}

#[test]
fn the_error_of_every_pixel_and_its_curve_are_told() {
    let served = Served::start("64");
    let state = served.state(|state| state["phase"] == "done");
    let (head, errors) = plane(&served.get("layer?name=error").1);
    assert_eq!(head[4], 64);
    assert_eq!(state["error_samples"], 64, "{state}");
    let squares = errors.iter().map(|error| f64::from(*error).powi(2)).sum::<f64>();
    let rms = (squares / errors.len() as f64).sqrt();
    let error = state["error"].as_f64().expect("a number");
    assert!((rms / error - 1.0).abs() < 1e-5, "{rms} {error}");
    let curve = state["curve"].as_array().expect("a list");
    let of = |name: &str| -> Vec<f64> {
        curve.iter().map(|point| point[name].as_f64().expect("a number")).collect()
    };
    let (samples, seconds, errors) = (of("samples"), of("seconds"), of("error"));
    assert_eq!((samples.first(), samples.last()), (Some(&4.0), Some(&64.0)));
    assert!(samples.is_sorted() && seconds.is_sorted() && seconds[0] > 0.0, "{state}");
    assert!(errors[0] > error && errors.last() == Some(&error), "{state}");
    // Another camera begins another curve.
    assert_eq!(served.post("camera", &Value::Null), 204);
    let before = state["epoch"].as_u64();
    let state = served.state(|state| state["epoch"].as_u64() > before);
    assert!(state["curve"].as_array().is_some_and(|curve| curve.len() <= 1), "{state}");
}

#[test]
fn a_pixel_has_no_error_before_every_part_has_a_sample() {
    let served = Served::start("3");
    let state = served.state(|state| state["phase"] == "done");
    assert!(state["error_samples"].is_null(), "{state}");
    let (status, said) = served.get("layer?name=error");
    assert_eq!(status, 404);
    assert!(
        String::from_utf8_lossy(&said).contains("a sample in each of the picture's four parts")
    );
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
