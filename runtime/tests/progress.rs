//! What is seen of a run that goes on: the picture on the disk or in a stream, and lines for programs.

mod common;

use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use runtime::output::{Picture, read_exr};

/// How a PNG begins.
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
    command.current_dir(folder).args(["marbles.pack", "--device", "cpu"]).args(args);
    command
}

/// Runs well.
fn rtr(folder: &Path, args: &[&str]) -> Output {
    let output = command(folder, args).output().expect("rtr starts");
    assert_eq!(output.status.code(), Some(0), "{args:?} {}", text(&output.stderr));
    output
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A folder with `marbles.pack`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let pack = common::pack_bytes(&common::features());
    std::fs::write(folder.path().join("marbles.pack"), pack).expect("it can be written");
    folder
}

/// A run that is ended with the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn start(folder: &Path, args: &[&str]) -> Running {
    let mut command = command(folder, args);
    Running(command.stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("rtr starts"))
}

#[test]
fn the_picture_is_there_while_it_is_rendered_and_grows() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    let outputs = ["-o", "a.exr", "-o", "a.png", "--write-every", "50ms"];
    let mut run = start(folder.path(), &[&["--spp", "10000000"], &outputs[..]].concat());
    let (mut seen, began) = (Vec::new(), Instant::now());
    while seen.len() < 3 && began.elapsed() < Duration::from_mins(1) {
        if let Ok(picture) = read_exr(&path) {
            let samples = picture.film.samples();
            assert!(!picture.meta.complete);
            assert_eq!((samples.0 % 16, samples.1 % 16), (0, 0), "{samples:?}");
            if samples.0 > 0 && seen.last() != Some(&samples.0) {
                seen.push(samples.0);
            }
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(run.0.try_wait().expect("it can be asked").is_none(), "it renders");
    assert!(seen.len() == 3 && seen.is_sorted(), "{seen:?}");
    let png = std::fs::read(folder.path().join("a.png")).expect("it is there");
    assert!(image::load_from_memory(&png).is_ok_and(|image| image.width() == common::SIZE[0]));
}

#[test]
fn pictures_on_the_way_do_not_change_the_last_one() {
    let folder = folder();
    let bits = |name: &str, every: &str| {
        let names = [format!("{name}.exr"), format!("{name}.png")];
        let [exr, png] = [&names[0], &names[1]];
        rtr(folder.path(), &["--spp", "4096", "-o", exr, "-o", png, "--write-every", every]);
        let film = read_exr(&folder.path().join(exr)).expect("a picture").film;
        let bits: Vec<_> = film.sums.iter().map(|rgb| rgb.map(f64::to_bits)).collect();
        (bits, film.counters, std::fs::read(folder.path().join(png)).expect("a picture"))
    };
    assert!(bits("often", "1ms") == bits("never", "never"));
}

/// The first picture of a run, as soon as it is there.
fn first_picture(path: &Path) -> Picture {
    let began = Instant::now();
    loop {
        match read_exr(path) {
            Ok(picture) => return picture,
            Err(error) => assert!(began.elapsed() < Duration::from_mins(1), "{error}"),
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn a_coarse_picture_comes_first_and_is_no_part_of_one() {
    let folder = folder();
    let outputs = ["-o", "a.png", "-o", "a.exr"];
    let args = [&["--spp", "10000000", "--size", "1280x720"], &outputs[..]].concat();
    let mut child =
        command(folder.path(), &args).stderr(Stdio::piped()).spawn().expect("rtr starts");
    let stderr = child.stderr.take().expect("piped");
    let run = Running(child);
    let Picture { film, meta, .. } = first_picture(&folder.path().join("a.exr"));
    assert_eq!((film.samples(), meta.coarse_block), ((0, 0), Some(11)));
    let png = std::fs::read(folder.path().join("a.png")).expect("it is there");
    let image = image::load_from_memory(&png).expect("a PNG").to_rgb8();
    assert_eq!((image.width(), image.height()), (1280, 720));
    let blocks = image.pixels().zip(image.pixels().skip(1)).filter(|(a, b)| a != b).count();
    assert!(blocks > 100 && blocks < 1280 * 720 / 8, "{blocks} edges between blocks");
    let mut lines = BufReader::new(stderr).lines().map(|line| line.expect("text"));
    assert!(lines.any(|line| line == "first picture: coarse, a sample for each 11x11 pixels"));
    drop(run);
    for (args, said) in [
        (&["merge", "a.exr", "-o", "b.exr"][..], "its pixels have between 0 and 0 samples"),
        (&["marbles.pack", "--reference", "a.exr"], "a.exr has pixels without samples"),
    ] {
        let mut rtr = Command::new(env!("CARGO_BIN_EXE_rtr"));
        let output = rtr.current_dir(folder.path()).args(args).output().expect("rtr starts");
        let log = text(&output.stderr);
        assert!(!output.status.success() && log.contains(said), "{log}");
    }
}

#[test]
fn a_long_batch_shows_in_the_picture_tile_by_tile() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    // Slow, so that a batch takes hundreds of times as long as writing a picture.
    std::fs::write(folder.path().join("marbles.pack"), common::pack_with_long_paths())
        .expect("it can be written");
    let slow = ["--precision", "f64", "--threads", "1", "--size", "1280x720", "--spp", "10000000"];
    let args = [&slow[..], &["--write-every", "50ms", "-o", "a.exr"]].concat();
    let run = start(folder.path(), &args);
    let began = Instant::now();
    let seen = std::iter::repeat_with(|| first_picture(&path))
        .take_while(|_| began.elapsed() < Duration::from_mins(1))
        .find(|picture| picture.film.samples().1 > 0)
        .expect("tiles arrive");
    drop(run);
    let film = &seen.film;
    assert_eq!((film.samples(), film.ranges.len()), ((0, 16), 0));
    let lit = (0..film.sums.len()).filter(|i| film.mean(*i).iter().any(|x| *x > 0.0));
    assert!(lit.into_iter().all(|i| film.counts[i] == 16), "only what has samples has sums");
    assert_eq!(seen.meta.coarse_block, Some(11));
}

#[test]
fn nothing_is_written_on_the_way_where_that_is_not_wanted() {
    let folder = folder();
    let run = start(folder.path(), &["--spp", "10000000", "-o", "a.png", "--write-every", "never"]);
    std::thread::sleep(Duration::from_millis(1500));
    assert!(!folder.path().join("a.png").exists());
    drop(run);
}

#[test]
fn a_stream_is_one_picture_unless_more_are_wanted() {
    let folder = folder();
    let pictures = |more: &[&str]| {
        let args = ["--spp", "10000000", "--time", "1500ms", "-o", "-"];
        let output = rtr(folder.path(), &[&args[..], more].concat());
        assert!(output.stdout.starts_with(PNG));
        output.stdout.windows(PNG.len()).filter(|window| *window == PNG).count()
    };
    assert_eq!(pictures(&[]), 1);
    assert!(pictures(&["--write-every", "50ms"]) > 2);
}

#[cfg(unix)]
#[test]
fn what_cannot_be_written_on_the_way_is_said_once_and_the_run_goes_on() {
    let folder = folder();
    let sub = folder.path().join("sub");
    std::fs::create_dir(&sub).expect("writable");
    let args = ["--spp", "10000000", "--time", "60s", "-o", "sub/a.png", "--write-every", "100ms"];
    let mut child =
        command(folder.path(), &args).stderr(Stdio::piped()).spawn().expect("rtr starts");
    let stderr = child.stderr.take().expect("piped");
    let mut lines = BufReader::new(stderr).lines().map(|line| line.expect("text"));
    assert!(lines.any(|line| line.starts_with("device: ")));
    std::fs::rename(&sub, folder.path().join("gone")).expect("writable");
    assert!(
        lines
            .any(|line| line.ends_with("rendering continues, and sub/a.png is written at the end"))
    );
    // It tries again some times.
    std::thread::sleep(Duration::from_millis(500));
    let pid = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &pid]).status().expect("kill starts").success());
    let log = lines.collect::<Vec<_>>().join("\n");
    assert_eq!(child.wait().expect("it ends").code(), Some(3), "{log}");
    assert!(!log.contains("is written at the end"), "{log}");
    assert!(log.contains(" spp in ") && log.contains("it was saved as ./a.png instead"), "{log}");
}

#[test]
fn a_program_gets_one_object_a_line() {
    let folder = folder();
    let args = ["--spp", "10000000", "--time", "2500ms", "-o", "a.png", "--progress", "json"];
    let output = rtr(folder.path(), &[&args[..], &["--until-error", "1e-9"]].concat());
    assert_eq!(text(&output.stdout), "wrote a.png\n");
    let log = text(&output.stderr);
    let lines: Vec<serde_json::Value> = log
        .lines()
        .map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{error}: {line}")))
        .collect();
    let (progress, messages): (Vec<_>, Vec<_>) =
        lines.iter().partition(|line| line["schema"] == "rtr.progress/1");
    assert!(messages.iter().all(|line| line["schema"] == "rtr.message/1"));
    assert!(messages.iter().any(|line| {
        line["message"].as_str().is_some_and(|text| text.starts_with("device: CPU"))
    }));
    assert!((2..=5).contains(&progress.len()), "{log}");
    let (last, before) = progress.split_last().expect("some");
    assert_eq!(last["stop"], "time limit");
    assert!(before.iter().all(|line| line["stop"].is_null() && line["eta"].is_number()));
    let samples: Vec<f64> =
        progress.iter().map(|line| line["seconds"].as_f64().expect("a number")).collect();
    assert!(samples.is_sorted(), "{samples:?}");
    for line in &progress {
        assert!(line["rel"].as_f64().is_some_and(|rel| rel > 0.0 && rel < 1.0), "{line}");
        assert!(line["device"].as_str().is_some_and(|device| device.starts_with("CPU kernel")));
        assert!(line["rays_per_second"].as_f64().is_some_and(|rate| rate > 1e3), "{line}");
    }
}

/// Packets of tev: what they are, and the rest of them.
fn packets(mut sent: &[u8]) -> Vec<(u8, Vec<u8>)> {
    let mut packets = Vec::new();
    while let Some((len, _)) = sent.split_first_chunk::<4>() {
        let len = u32::from_le_bytes(*len) as usize;
        let (packet, rest) = sent.split_at(len);
        packets.push((packet[4], packet[5..].to_vec()));
        sent = rest;
    }
    packets
}

#[test]
fn tev_is_sent_the_picture_until_the_last_one() {
    let folder = folder();
    let listener = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let place = listener.local_addr().expect("an address").to_string();
    let viewer = std::thread::spawn(move || {
        let mut sent = Vec::new();
        let (mut stream, _) = listener.accept().expect("rtr connects");
        std::io::Read::read_to_end(&mut stream, &mut sent).expect("it can be read");
        sent
    });
    let args = ["--spp", "10000000", "--time", "1500ms", "-o", "a.exr", "--tev", &place];
    rtr(folder.path(), &[&args[..], &["--write-every", "100ms"]].concat());
    let packets = packets(&viewer.join().expect("it ends"));
    let (first, updates) = packets.split_first().expect("some");
    let created = b"\x01marbles\0\x48\0\0\0\x28\0\0\0\x03\0\0\0R\0G\0B\0";
    assert_eq!((first.0, first.1.as_slice()), (4, &created[..]));
    assert!(updates.len() > 2 && updates.iter().all(|(kind, _)| *kind == 6));
    let film = read_exr(&folder.path().join("a.exr")).expect("a picture").film;
    let pixels = film.means();
    #[expect(clippy::cast_possible_truncation, reason = "as files hold it")]
    let values = pixels.as_flattened().iter().flat_map(|x| (*x as f32).to_le_bytes());
    let (_, last) = updates.last().expect("some");
    assert!(last.ends_with(&values.collect::<Vec<u8>>()), "the last picture");
}

#[test]
fn without_tev_there_is_one_warning_and_the_picture() {
    let folder = folder();
    // A port that was free a moment ago.
    let listener = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let place = listener.local_addr().expect("an address").to_string();
    drop(listener);
    let output = rtr(folder.path(), &["-o", "a.png", "--tev", &place]);
    let log = text(&output.stderr);
    assert_eq!(log.matches("warning: ").count(), 1, "{log}");
    assert!(log.contains(&format!("warning: cannot reach tev at {place}: ")), "{log}");
    assert!(folder.path().join("a.png").exists());
}
