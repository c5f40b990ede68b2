//! Scenes, meshes and images that claim, nest or repeat too much, or that are something else.

use std::io;
use std::process::Command;
use std::time::Duration;

use super::lab::SCENE;
use super::{Lab, Row};

pub(super) fn rows(lab: &Lab) -> io::Result<Vec<Row>> {
    Ok(vec![strangers(lab)?, rooted(lab)?, diagnostics(lab)?, claims(lab)?, nested(lab)?])
}

fn textured(file: &str) -> String {
    SCENE.replace(
        "camera",
        &format!(
            "texture t = image(\"{file}\", space: srgb)
material paint: diffuse {{ color = t }}
instance third {{ shape = sphere(radius: 10cm), material = paint, at = (1, 0, 0)m }}
camera"
        ),
    )
}

/// Files that are no scene, no image and no mesh.
fn strangers(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "`/etc/passwd`, pipes, devices and files of `/proc` as import, image, mesh and scene",
        "exit 1 or 3 at once; not a word of the file is shown",
    );
    drop(std::fs::remove_file(lab.at("pipe")));
    Command::new("mkfifo").arg(lab.at("pipe")).status()?;
    let import = |file: &str| format!("rts 1\nimport \"{file}\"\n");
    let mesh = |file: &str| {
        SCENE.replace("camera", &format!("asset a = obj(\"{file}\", unit: m, up: +y)\ninstance x {{ shape = a, material = clay }}\ncamera"))
    };
    for file in ["/etc/passwd", "pipe", "/dev/zero", "/proc/self/maps", "/proc/kmsg"] {
        for (kind, text) in
            [("import", import(file)), ("image", textured(file)), ("mesh", mesh(file))]
        {
            lab.put("strange.rts", text)?;
            let outcome = lab.run("", &["rtc", "strange.rts"])?;
            let slow = outcome.time > Duration::from_secs(2);
            let shown = [":x:", ":0:", "/bin"].iter().any(|text| outcome.said.contains(text));
            let fault = slow.then(|| "slow".to_owned()).or(shown.then(|| "quoted".to_owned()));
            row.note(&format!("{kind} {file}"), &outcome, outcome.unless(&[1, 3]).or(fault));
        }
        let outcome = lab.run("", &["rtc", file])?;
        let shown = outcome.said.contains("root:").then(|| "quoted".to_owned());
        row.note(&format!("scene {file}"), &outcome, outcome.unless(&[1, 3]).or(shown));
    }
    Ok(row)
}

/// Paths that leave the folder of `--root`.
fn rooted(lab: &Lab) -> io::Result<Row> {
    let mut row =
        Row::new("paths that leave the folder of `--root`, links included", "exit 1 or 3");
    std::fs::create_dir_all(lab.at("jail"))?;
    image::RgbImage::new(2, 2).save(lab.at("out.png")).map_err(io::Error::other)?;
    drop(std::fs::remove_file(lab.at("jail/link.png")));
    std::os::unix::fs::symlink("../out.png", lab.at("jail/link.png"))?;
    lab.put("out.rts", "rts 1\npub material c: diffuse { color = linear(1) }\n")?;
    let absolute = lab.at("out.png").display().to_string();
    for file in ["../out.png", "link.png", &absolute] {
        lab.put("jail/s.rts", textured(file))?;
        let outcome = lab.run("", &["rtc", "--root", "jail", "jail/s.rts"])?;
        row.note(file, &outcome, outcome.unless(&[1, 3]));
    }
    lab.put("jail/s.rts", format!("{SCENE}import \"../out.rts\" {{ c }}\n"))?;
    let outcome = lab.run("", &["rtc", "--root", "jail", "jail/s.rts"])?;
    row.note("../out.rts", &outcome, outcome.unless(&[1, 3]));
    Ok(row)
}

/// Texts that are wrong in very many or very long ways.
fn diagnostics(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "100,000 warnings, a string of 30 MB without end, 60 MB of line ends, a line of 10 MB",
        "2 s and 1 MB of text (10 s above 10 MB of input)",
    );
    let unused =
        (0..100_000).fold(String::new(), |text, i| text + &format!("let unused{i} = {i}\n"));
    let many = SCENE.replacen('\n', &format!("\n{unused}"), 1);
    let endless = format!("rts 1\nlet a = \"{}", "x".repeat(30_000_000));
    let lines = format!("rts 1\n{}", "\n".repeat(60_000_000));
    let wide = format!("rts 1\nlet a = {}1\n", "1 + ".repeat(2_500_000));
    for (name, text, seconds) in [
        ("many.rts", &many, 2),
        ("endless.rts", &endless, 10),
        ("lines.rts", &lines, 10),
        ("wide.rts", &wide, 10),
    ] {
        lab.put(name, text)?;
        for rest in [&[][..], &["--error-format", "json"], &["--max-errors", "1"]] {
            let args: Vec<&str> = ["rtc", "check", name].iter().chain(rest).copied().collect();
            let outcome = lab.run("ulimit -v 4000000;", &args)?;
            let slow = (outcome.time > Duration::from_secs(seconds))
                .then(|| format!("takes {:.1} s", outcome.time.as_secs_f64()));
            // 100,000 warnings in JSON are 100,000 lines, as they were asked for.
            row.note(&args.join(" "), &outcome, outcome.unless(&[0, 1, 3]).or(slow));
        }
        std::fs::remove_file(lab.at(name))?;
    }
    Ok(row)
}

/// Files that claim to be larger than memory.
fn claims(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "images and meshes that claim up to 2^31 pixels or 2^32 elements, under 4 GB",
        "exit 1 or 3 in one message",
    );
    let mut png = Vec::new();
    image::ImageEncoder::write_image(
        image::codecs::png::PngEncoder::new(&mut png),
        &[0; 3],
        1,
        1,
        image::ExtendedColorType::Rgb8,
    )
    .map_err(io::Error::other)?;
    // Width and height of the header; its checksum is wrong afterwards, as an attacker's may be.
    png[16..24].copy_from_slice(&[0, 0, 0x7f, 0xff, 0, 0, 0x7f, 0xff]);
    lab.put("claim.png", &png)?;
    lab.put("claim.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n")?;
    let mut exr = io::Cursor::new(Vec::new());
    let small = exr::prelude::Image::from_channels(
        (4, 4),
        exr::prelude::SpecificChannels::rgb(|_: exr::prelude::Vec2<usize>| {
            (0.5f32, 0.5f32, 0.5f32)
        }),
    );
    exr::prelude::WritableImage::write(&small).to_buffered(&mut exr).map_err(io::Error::other)?;
    let mut exr = exr.into_inner();
    // Both windows: 4 by 4 becomes 20,000 by 20,000.
    for at in 0..exr.len() - 16 {
        if exr[at..at + 16] == [0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0] {
            exr[at + 8..at + 16].copy_from_slice(&[0x1f, 0x4e, 0, 0, 0x1f, 0x4e, 0, 0]);
        }
    }
    lab.put("claim.exr", &exr)?;
    for file in ["claim.png", "claim.hdr", "claim.exr"] {
        lab.put("claim.rts", textured(file))?;
        let outcome = lab.run("ulimit -v 4000000;", &["rtc", "claim.rts"])?;
        row.note(file, &outcome, outcome.unless(&[1, 3]));
    }
    let sky = SCENE.replace("camera", "sky s: image { file = \"claim.exr\" }\ncamera");
    lab.put("claim.rts", sky)?;
    let outcome = lab.run("ulimit -v 4000000;", &["rtc", "claim.rts"])?;
    row.note("claim.exr as a sky", &outcome, outcome.unless(&[1, 3]));
    Ok(row)
}

/// Nesting, under a small stack as well.
fn nested(lab: &Lab) -> io::Result<Row> {
    let mut row = Row::new(
        "expressions nested 100 to 100,000 deep, with stacks of 32 kB to 8 MB",
        "exit 0, 1 or 3",
    );
    for depth in [100, 1_000, 10_000, 100_000] {
        let text = format!("rts 1\nlet a = {}1{}\n", "(".repeat(depth), ")".repeat(depth));
        lab.put("deep.rts", text)?;
        for stack in ["32", "64", "1024", "8192"] {
            let limit = format!("ulimit -s {stack};");
            let outcome = lab.run(&limit, &["rtc", "check", "deep.rts"])?;
            row.note(&format!("{depth} deep, {limit}"), &outcome, outcome.unless(&[0, 1, 3]));
        }
    }
    Ok(row)
}
