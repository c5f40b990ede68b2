//! What cameras of every kind see, where it is known exactly.

#![expect(clippy::float_cmp, reason = "what is nothing, or the same number twice, is exact")]

use std::f64::consts::PI;
use std::path::Path;

use pack::abi::Camera;
use pack::{Checked, Pack};
use runtime::layers::Layer;
use runtime::pick::pick;
use runtime::view::View;
use runtime::{Job, Scene};
use tests::exr_file::File;
use tests::picture::{self, channel};
use tests::scene::{bytes, compile_in};

fn pack_in(dir: &Path, text: &str) -> Pack<Checked> {
    Pack::from_bytes(bytes(&compile_in(dir, text))).expect("what was written can be read")
}

/// A glowing ball of radius 1 m at `at`, and the camera.
fn ball(at: &str, camera: &str, film: &str) -> Pack<Checked> {
    let text = format!(
        "rts 1
material glow: emissive {{ color = linear(1) }}
instance ball {{ shape = sphere(radius: 1m), material = glow, at = {at} }}
camera eye: {camera}
film f {{ size = {film} }}
render main: path {{ camera = eye, film = f, samples = 64, depth = 2, seed = 3 }}
"
    );
    pack_in(Path::new("."), &text)
}

fn mean(pack: Pack<Checked>, size: Option<[u32; 2]>) -> f64 {
    let outcome = picture::cpu(pack, |job| {
        if let Some([w, h]) = size {
            job.resize([w, h]);
        }
    });
    let values = channel(outcome.film(), 1);
    values.iter().sum::<f64>() / values.len() as f64
}

/// Of the pixels that the edge crosses, about `sqrt(n)`, each is right to about 1 / 64.
const TOLERANCE: f64 = 1e-3;

#[test]
fn a_ball_covers_its_disk_of_an_orthographic_picture_at_every_distance() {
    for at in ["(0, 0, 0)m", "(0.7, -0.4, -30)m", "(-1, 1, 7)m"] {
        let camera = "orthographic { from = (0, 0, 10)m, to = (0, 0, 0)m, height = 5m }";
        let share = mean(ball(at, camera, "(96, 64)px"), None);
        let expected = PI / (5.0 * 7.5);
        assert!((share / expected - 1.0).abs() < TOLERANCE, "{at}: {share}, {expected} expected");
    }
    // Behind the plane of the camera it is not seen, and half of it where it reaches through.
    let camera = "orthographic { from = (0, 0, 0)m, to = (0, 0, -1)m, width = 5m }";
    assert_eq!(mean(ball("(0, 0, 2)m", camera, "(32, 32)px"), None), 0.0);
    let share = mean(ball("(0, 0, 0)m", camera, "(64, 64)px"), None);
    assert!((share / (PI / 25.0) - 1.0).abs() < TOLERANCE, "{share}");
}

#[test]
fn another_aspect_keeps_the_width_of_the_view() {
    let camera = "orthographic { from = (0, 0, 10)m, to = (0, 0, 0)m, width = 6m }";
    let share = mean(ball("(0, 0, 0)m", camera, "(64, 64)px"), Some([96, 48]));
    let expected = PI / (6.0 * 3.0);
    assert!((share / expected - 1.0).abs() < TOLERANCE, "{share}, {expected} expected");
}

/// Texels of the panorama: smooth, of another colour everywhere.
fn texel(x: usize, y: usize) -> f32 {
    let turn = 2.0 * std::f32::consts::PI * (x as f32 + 0.5) / 32.0;
    2.0 + turn.cos() + 0.5 * turn.sin() + 0.05 * y as f32
}

#[test]
fn a_panorama_shows_the_sky_as_it_is_stored() {
    let dir = tempfile::tempdir().expect("a folder");
    let rgb = |x: usize, y: usize| (texel(x, y), texel(x, y), texel(x, y));
    exr::prelude::write_rgb_file(dir.path().join("sky.exr"), 32, 16, rgb).expect("written");
    // What bilinear interpolation is on the mean over a pixel that is a texel.
    let blur = |row: usize, column: usize| {
        let weights = [(-1_i32, 0.125), (0, 0.75), (1, 0.125)];
        let near = |at: usize, step: i32| i32::try_from(at).expect("small") + step;
        weights
            .iter()
            .flat_map(|(dy, wy)| weights.iter().map(move |(dx, wx)| (dy, dx, wx * wy)))
            .map(|(dy, dx, weight)| {
                let y = near(row, *dy).clamp(0, 15) as usize;
                let x = near(column, *dx).rem_euclid(32) as usize;
                weight * f64::from(texel(x, y))
            })
            .sum::<f64>()
    };
    for (fov, width, first) in [(360, 32, 0), (90, 8, 12)] {
        let text = format!(
            "rts 1
sky s: image {{ file = \"sky.exr\" }}
camera eye: panoramic {{ from = (3, 1, 2)m, to = (3, 1, -9)m, fov.horizontal = {fov}deg }}
film f {{ size = ({width}, 16)px }}
render main: path {{ camera = eye, film = f, samples = 256, seed = 11 }}
"
        );
        let outcome = picture::cpu(pack_in(dir.path(), &text), |_| {});
        for (i, value) in channel(outcome.film(), 1).into_iter().enumerate() {
            let (row, column) = (i / width, i % width + first);
            let expected = blur(row, column);
            let off = (value - expected).abs();
            assert!(off < 3e-3, "{fov} deg, row {row}, column {column}: {value}, {expected}");
        }
    }
}

/// Cameras of the page, and their texts, are those that they were made of.
#[test]
fn a_view_and_its_text_are_the_camera() {
    for declared in [
        "orthographic { from = (2, 1, 10)m, to = (1, 0, 0)m, height = 8m }",
        "orthographic { from = (0, 0, 0.01)m, to = (0, 0, 0)m, width = 90m }",
        "panoramic { from = (1, 0, 0)m, to = (0, 0, -1)m, fov.horizontal = 200deg }",
        "perspective { from = (2, 1, 10)m, to = (1, 0, 0)m, f_stop = 2, blades = 6, rotation = 20deg }",
    ] {
        let own = Scene::new(ball("(0, 0, 0)m", declared, "(60, 40)px"));
        let view = View::of(&own);
        let camera = *own.pack().camera();
        let seen = view.camera(&own).expect("a camera");
        let text = view.text("eye", &camera);
        let written = text.strip_prefix("camera eye: ").expect("a declaration");
        let read = *Scene::new(ball("(0, 0, 0)m", written, "(60, 40)px")).pack().camera();
        for other in [seen, read] {
            let numbers = |c: &Camera| {
                let rows = [c.origin, c.right, c.up, c.forward].concat();
                let rest = [c.half_width, c.half_height, c.lens_radius];
                [rows, rest.into(), vec![c.blade_rotation, c.blade_reach]].concat()
            };
            for (a, b) in numbers(&other).into_iter().zip(numbers(&camera)) {
                assert!((a - b).abs() < 1e-4, "{declared}: {text} {other:?} instead of {camera:?}");
            }
            assert_eq!([other.kind, other.blades], [camera.kind, camera.blades], "{declared}");
        }
    }
}

/// The layer `depth`: along the view, but of a panorama the distance.
#[test]
fn depths_are_along_the_view_or_all_around() {
    for (camera, expected) in [
        ("orthographic { from = (0, 0, 10)m, to = (0, 0, 0)m, height = 8m }", 9.0),
        ("panoramic { from = (0, 0, 3)m, to = (0, 0, 9)m, fov.horizontal = 360deg }", 2.0),
    ] {
        let outcome = picture::cpu(ball("(0, 0, 0)m", camera, "(64, 32)px"), |job| {
            job.wanted.layers = [Layer::Depth].into();
        });
        let file = File::written(&outcome.picture, false);
        let depth = &file.channels["ViewLayer.Depth.Z"];
        let nearest = depth.iter().copied().fold(f32::INFINITY, f32::min);
        assert!((f64::from(nearest) - expected).abs() < 0.01, "{camera}: {nearest}");
    }
}

/// A glowing ball of radius 2 cm, 2 m away, through an opening of 20 cm that focuses at 1 m.
fn blurred(lens: &str) -> Vec<f64> {
    let camera = format!(
        "perspective {{ from = (0, 0, 2)m, to = (0, 0, 0)m, fov.horizontal = 17deg, aperture = 20cm, focus = 1m, {lens} }}"
    );
    let text = format!(
        "rts 1
material glow: emissive {{ color = linear(1) }}
instance spark {{ shape = sphere(radius: 2cm), material = glow }}
camera eye: {camera}
film f {{ size = (64, 64)px }}
render main: path {{ camera = eye, film = f, samples = 256, depth = 1, seed = 3 }}
"
    );
    channel(picture::cpu(pack_in(Path::new("."), &text), |_| {}).film(), 1)
}

/// What is out of focus shows the opening: at the film, at distance 1, a polygon half as large as the opening, which is
/// a disk of radius 5 cm where there are no blades, and everywhere as bright.
#[test]
fn what_is_out_of_focus_shows_the_blades() {
    let half_width = (8.5_f64).to_radians().tan();
    let place = |i: usize| 2.0 * half_width * ((i as f64 + 0.5) / 64.0 - 0.5);
    let disk = PI * 0.05 * 0.05;
    for (blades, rotation) in [(0, 0.0_f64), (3, 0.0), (3, 90.0), (3, 200.0), (6, 0.0)] {
        let lens = if blades == 0 {
            String::new()
        } else {
            format!("blades = {blades}, rotation = {rotation}deg")
        };
        let values = blurred(&lens);
        let at = |i: usize| [place(i % 64), -place(i / 64)];
        // A moment of the light, divided by all of it.
        let all: f64 = values.iter().sum();
        let moment = |of: &dyn Fn([f64; 2]) -> f64| {
            values.iter().enumerate().map(|(i, value)| value * of(at(i))).sum::<f64>() / all
        };
        // As bright as in the middle, so much area.
        let inner: Vec<f64> = (0..values.len())
            .filter(|i| at(*i)[0].hypot(at(*i)[1]) < 0.024)
            .map(|i| values[i])
            .collect();
        let middle = inner.iter().sum::<f64>() / inner.len() as f64;
        let area = all / middle * (2.0 * half_width / 64.0).powi(2);
        assert!((area / disk - 1.0).abs() < 0.03, "{lens}: area {area}, {disk} expected");
        // Of a regular polygon with n corners at r: r^2 (2 + cos(2 pi / n)) / 6, and a quarter of the square of the
        // ball's own radius along both axes; without blades r^2 / 2.
        let n = f64::from(blades);
        let r = match blades {
            0 => 0.05,
            _ => (2.0 * disk / (n * (2.0 * PI / n).sin())).sqrt(),
        };
        let polar = if blades == 0 { 0.5 } else { (2.0 + (2.0 * PI / n).cos()) / 6.0 };
        let expected = r * r * polar + 0.5 * 0.01 * 0.01;
        let found = moment(&|[x, y]| x * x + y * y);
        assert!((found / expected - 1.0).abs() < 0.02, "{lens}: {found}, {expected} expected");
        // The third moment along an axis through a corner of a triangle is r^3 / 40; it turns clockwise.
        let (sin, cos) = rotation.to_radians().sin_cos();
        let skew = moment(&|[x, y]| (x * sin + y * cos).powi(3)) / r.powi(3);
        let expected = if blades == 3 { 1.0 / 40.0 } else { 0.0 };
        assert!((skew - expected).abs() < 0.0025, "{lens}: {skew}, {expected} expected");
    }
}

#[test]
fn what_is_picked_is_where_parallel_rays_and_panoramas_see_it() {
    let camera = "orthographic { from = (2, 0, 10)m, to = (2, 0, 0)m, height = 8m }";
    let scene = Scene::new(ball("(0, 0, 0)m", camera, "(8, 8)px"));
    let seen = pick(&scene, &Job::of_scene(&scene), [2, 3]).expect("a pixel").surface;
    let seen = seen.expect("the ball");
    let (x, y) = (0.5, 0.5_f64);
    let z = (1.0 - x * x - y * y).sqrt();
    for (found, expected) in seen.position.into_iter().zip([x, y, z]) {
        assert!((found - expected).abs() < 1e-5, "{:?}", seen.position);
    }
    assert!((seen.depth - (10.0 - z)).abs() < 1e-4 && (seen.distance - seen.depth).abs() < 1e-9);
    // Straight behind a panorama is its left edge, and depth is distance.
    let camera = "panoramic { from = (0, 0, 0)m, to = (0, 0, -1)m }";
    let scene = Scene::new(ball("(0, 0, 5)m", camera, "(64, 32)px"));
    let seen = pick(&scene, &Job::of_scene(&scene), [0, 15]).expect("a pixel").surface;
    let seen = seen.expect("the ball");
    assert!((seen.distance - 4.05).abs() < 0.02 && seen.depth == seen.distance, "{seen:?}");
    let ahead = pick(&scene, &Job::of_scene(&scene), [32, 15]).expect("a pixel").surface;
    assert!(ahead.is_none(), "{ahead:?}");
}

/// Share of a filter, of this width, below `x` pixels from the middle of the pixel.
fn below(filter: &str, width: f64, x: f64) -> f64 {
    let weight = |t: f64| match filter {
        "box" => 1.0,
        "tent" => 1.0 - t.abs(),
        // Along an axis, of a normal distribution within the circle of three standard deviations.
        "gaussian" => {
            let reach = (1.0 - t * t).sqrt();
            let steps = 64;
            let along = |i: i32| {
                let s = reach * (2.0 * (f64::from(i) + 0.5) / f64::from(steps) - 1.0);
                (-4.5 * (t * t + s * s)).exp()
            };
            reach * (0..steps).map(along).sum::<f64>() / f64::from(steps)
        }
        _ => {
            let angle = PI * (t + 1.0);
            0.35875 - 0.48829 * angle.cos() + 0.14128 * (2.0 * angle).cos()
                - 0.01168 * (3.0 * angle).cos()
        }
    };
    let (mut lower, mut all) = (0.0, 0.0);
    let steps = 4000;
    for i in 0..steps {
        let t = 2.0 * (f64::from(i) + 0.5) / f64::from(steps) - 1.0;
        let value = weight(t);
        all += value;
        lower += if 0.5 * width * t < x { value } else { 0.0 };
    }
    lower / all
}

/// A glowing half-plane whose edge is at column 4.3 of a picture of 10 columns.
fn edge(film: &str) -> Pack<Checked> {
    let text = format!(
        "rts 1
material glow: emissive {{ color = linear(1) }}
instance half {{ shape = box(size: (10, 40, 1)m), material = glow, at = (-5.7, 0, 0)m }}
camera eye: orthographic {{ from = (0, 0, 10)m, to = (0, 0, 0)m, width = 10m }}
film f {{ size = (10, 10)px, {film} }}
render main: path {{ camera = eye, film = f, samples = 1024, depth = 2, seed = 5 }}
"
    );
    pack_in(Path::new("."), &text)
}

#[test]
fn an_edge_is_as_soft_as_the_filter_says() {
    for (filter, width, film) in [
        ("box", 1.0, String::from("filter = box")),
        ("tent", 2.0, String::from("filter = tent")),
        ("gaussian", 3.0, String::from("filter = gaussian")),
        ("blackman_harris", 3.0, String::from("filter = blackman_harris")),
        ("box", 2.5, String::from("filter.width = 2.5px")),
        ("blackman_harris", 4.0, String::from("filter = blackman_harris, filter.width = 4px")),
    ] {
        let outcome = picture::cpu(edge(&film), |_| {});
        for (i, value) in channel(outcome.film(), 1).into_iter().enumerate() {
            let column = (i % 10) as f64;
            let expected = below(filter, width, 4.3 - (column + 0.5));
            let off = (value - expected).abs();
            assert!(off < 4e-3, "{film}, column {column}: {value}, {expected} expected");
        }
    }
}

fn assert_merges(name: &str, pack: impl Fn() -> Pack<Checked>) {
    let part = |start, end| {
        picture::cpu(pack(), |job| job.samples = runtime::SampleRange { start, end }).picture
    };
    let merged = runtime::output::merge(vec![part(64, 96), part(0, 64)]).expect("parts");
    let whole = part(0, 96);
    let bits = |film: &runtime::Film| -> Vec<_> {
        film.sums.iter().map(|rgb| rgb.map(f64::to_bits)).collect()
    };
    assert_eq!(bits(&merged.film), bits(&whole.film), "{name}");
}

#[test]
fn parts_of_a_picture_merge_to_its_bits() {
    for camera in [
        "panoramic { from = (0, 0, 0)m, to = (0, 0, -1)m }",
        "orthographic { from = (0, 0, 9)m, to = (0, 0, 0)m, height = 3m }",
    ] {
        assert_merges(camera, || ball("(0, 0, 5)m", camera, "(32, 16)px"));
    }
    for filter in ["tent", "gaussian", "blackman_harris"] {
        assert_merges(filter, || edge(&format!("filter = {filter}")));
    }
}

#[test]
fn a_box_of_one_pixel_is_what_there_is_without_a_filter() {
    let plain = |film: &str| {
        bytes(&compile_in(
            Path::new("."),
            &format!(
                "rts 1\nsky s: constant {{ }}\ncamera c: perspective {{ from = (0, 0, 1)m, to = (0, 0, 0)m }}\n\
         film f {{ size = (8, 8)px{film} }}\nrender r: path {{ }}\n"
            ),
        ))
    };
    let kernel = |film: &str| {
        let pack = Pack::from_bytes(plain(film)).expect("a pack");
        (pack.features(), pack.kernel().to_owned())
    };
    assert_eq!(kernel(""), kernel(", filter = box, filter.width = 1px"));
    assert_ne!(kernel(""), kernel(", filter = tent"));
}

#[test]
fn blades_leave_the_opening_its_area() {
    for blades in [3, 7, 16] {
        let camera = compile_in(Path::new("."), &format!(
            "rts 1\nsky s: constant {{ }}\nfilm f {{ size = (8, 8)px }}\nrender r: path {{ }}\n\
             camera c: perspective {{ from = (0, 0, 1)m, to = (0, 0, 0)m, aperture = 1m, blades = {blades} }}\n"
        ))
        .lowered
        .camera;
        let reach = f64::from(camera.blade_reach);
        let area = 0.5 * f64::from(blades) * reach * reach * (2.0 * PI / f64::from(blades)).sin();
        assert_eq!(camera.blades, blades);
        assert!((area / PI - 1.0).abs() < 1e-6, "{blades}: {area}");
    }
}
