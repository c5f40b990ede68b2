//! Keys: a picture is the mean of the pictures of all moments, and two keys are a velocity.

use std::fmt::Write as _;
use std::path::Path;

use tests::console;
use tests::picture;
use tests::scene;

/// Moments of which pictures are taken.
const MOMENTS: u32 = 64;

const VIEW: &str = "film f { size = (32, 32)px }
render main: path { camera = eye, film = f, samples = SAMPLES, depth = 3, seed = 3 }
sky day: gradient { sun.direction = (0.5, 0.6, 0.4), zenith = linear(0.2, 0.4, 0.9), strength = 1 }
material clay: diffuse { color = linear(0.8, 0.5, 0.3) }
material grey: diffuse { color = linear(0.4) }
instance floor { shape = rectangle(size: (9, 9)m), material = grey, at = (0, -1, 0)m }
";

/// Red, green and blue of each pixel while the shutter is open as `shutter` says.
fn means(root: &Path, text: &str, shutter: &str, samples: u32) -> Vec<[f64; 3]> {
    let text = text.replace("SHUTTER", shutter).replace("SAMPLES", &samples.to_string());
    let pack =
        pack::Pack::from_bytes(scene::bytes(&scene::compile_in(root, &text))).expect("valid");
    picture::cpu(pack, |_| {}).film().means().iter().map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect()
}

/// Root of the mean square of the differences, over the mean.
fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let flat = |x: &[[f64; 3]]| x.as_flattened().to_vec();
    let (a, b) = (flat(a), flat(b));
    let square: f64 = a.iter().zip(&b).map(|(a, b)| (a - b) * (a - b)).sum();
    let mean = b.iter().sum::<f64>() / b.len() as f64;
    (square / b.len() as f64).sqrt() / mean
}

/// Fails unless the blurred picture is the mean of the others, which that of one moment is not.
fn is_mean_of_moments(name: &str, root: &Path, things: &str) {
    let text = format!("rts 1\n{VIEW}{things}");
    let blurred = means(root, &text, "-5ms..15ms", 4096);
    let mut mean = vec![[0.0; 3]; blurred.len()];
    for k in 0..MOMENTS {
        let moment = 20.0 * (f64::from(k) + 0.5) / f64::from(MOMENTS) - 5.0;
        let still = means(root, &text, &format!("{moment}ms..{moment}ms"), 64);
        for (sum, rgb) in mean.iter_mut().zip(still) {
            for (sum, x) in sum.iter_mut().zip(rgb) {
                *sum += x / f64::from(MOMENTS);
            }
        }
    }
    let still = means(root, &text, "5ms..5ms", 1024);
    let (same, other) = (distance(&blurred, &mean), distance(&still, &mean));
    let line = format!("{name:<32} from the mean of moments {same:.4}, of one moment {other:.4}");
    console::line(&line);
    assert!(same < 0.02 && other > 4.0 * same, "{line}");
}

const EYE: &str = "camera eye: perspective { from = (0, 1.5, 6)m, to = (0, 0, 0)m, fov.vertical = 35deg, shutter = SHUTTER }\n";

#[test]
fn a_ball_on_a_bent_way_is_blurred_along_it() {
    let ball =
        "instance ball { shape = sphere(radius: 50cm), material = clay, velocity = (0, 0, 0)m/s
  at = [-20ms: (-3, 0, 0)m, 2ms: (-0.8, 0.6, 0)m, 9ms: (0.9, 0.9, 0.4)m, 40ms: (1.5, -3, 0)m] }\n";
    let ball = ball.replace(", velocity = (0, 0, 0)m/s", "");
    is_mean_of_moments("ball on a bent way", Path::new("."), &format!("{EYE}{ball}"));
}

#[test]
fn a_box_that_turns_about_several_axes_is_blurred() {
    let crate_ =
        "instance crate { shape = box(size: (2, 0.4, 0.6)m), material = clay, at = (0.2, 0.2, 0)m
  rotate = [-5ms: (0, 0, 0)deg, 3ms: (20, 30, -10)deg, 20ms: (20, 190, 60)deg] }\n";
    is_mean_of_moments("turning box", Path::new("."), &format!("{EYE}{crate_}"));
}

#[test]
fn a_group_turns_as_a_whole_and_moves_with_what_holds_it() {
    let group = "object bead { shape = sphere(radius: 30cm), material = clay, at = (1, 0, 0)m }
object bar { shape = box(size: (2, 0.2, 0.2)m), material = clay, rotate = (0, 0, 20)deg }
object wheel { shape = [bead, bar], rotate = [0ms: (0, 0, 0)deg, 10ms: (0, 0, 100)deg], at = (0.3, 0, 0)m }
instance cart { shape = [wheel], scale = -0.8, rotate = (0, 30, 0)deg, at = [-5ms: (-0.5, 0, 0)m, 15ms: (0.5, 0.3, 0)m] }\n";
    is_mean_of_moments("wheel of a cart", Path::new("."), &format!("{EYE}{group}"));
}

#[test]
fn a_mesh_that_turns_is_stored_once_and_blurred() {
    let dir = tempfile::tempdir().expect("a folder");
    std::fs::write(dir.path().join("blade.obj"), blade()).expect("written");
    let text = "asset blade = obj(\"blade.obj\", unit: m, up: +y)
instance blade_a { shape = blade, material = clay, at = (0.1, 0.1, 0)m, scale = (1.3, 0.4, 0.8)
  rotate = [-5ms: (10, 0, -40)deg, 15ms: (10, 0, 60)deg] }\n";
    let text = format!("{EYE}{text}");
    is_mean_of_moments("turning mesh", dir.path(), &text);
    let text =
        format!("rts 1\n{VIEW}{text}").replace("SHUTTER", "-5ms..15ms").replace("SAMPLES", "1");
    assert_eq!(scene::compile_in(dir.path(), &text).lowered.instances.len(), 1);
}

/// A rectangle of 4 by 1 metres, not in the middle, in 256 triangles.
fn blade() -> String {
    let mut text = String::new();
    for i in 0..=16 {
        for j in 0..=8 {
            let (x, y) = (f64::from(i) / 8.0 - 0.5, f64::from(j) / 8.0 - 0.25);
            let _ = writeln!(text, "v {x} {y} {}", 0.05 * x * y);
        }
    }
    for i in 0..16 {
        for j in 0..8 {
            let at = 9 * i + j + 1;
            let _ = writeln!(text, "f {} {} {} {}", at, at + 9, at + 10, at + 1);
        }
    }
    text
}

#[test]
fn a_camera_is_blurred_from_key_to_key() {
    let eye = "camera eye: perspective { fov.vertical = 35deg, shutter = SHUTTER, aperture = 5cm
  from = [-5ms: (0, 1.5, 6)m, 4ms: (0.6, 1.5, 6)m, 15ms: (0.6, 2, 5)m]
  to = [0ms: (0, 0, 0)m, 15ms: (0.5, 0.1, 0)m] }
instance ball { shape = sphere(radius: 50cm), material = clay }\n";
    is_mean_of_moments("camera", Path::new("."), eye);
}

#[test]
fn a_camera_that_moves_sees_a_world_that_moves_the_other_way() {
    let world = |ball: &str, eye: &str| {
        format!(
            "rts 1\nfilm f {{ size = (32, 32)px }}
render main: path {{ camera = eye, film = f, samples = 256, depth = 3, seed = 3 }}
sky day: constant {{ }}
material clay: diffuse {{ color = linear(0.8, 0.5, 0.3) }}
instance ball {{ shape = sphere(radius: 50cm), material = clay{ball} }}
instance crate {{ shape = box(size: (1, 1, 1)m), material = clay, at = (1, 0, -1)m{} }}
camera eye: perspective {{ fov.vertical = 35deg, shutter = -5ms..15ms, {eye} }}\n",
            ball.replace(", at = (0, 0, 0)m", "")
        )
    };
    let still = world(", velocity = (-25, 10, 0)m/s", "from = (0, 0, 6)m, to = (0, 0, 0)m");
    let keys = |z: &str| format!("[-5ms: (-0.125, 0.05, {z})m, 15ms: (0.375, -0.15, {z})m]");
    let moving = world("", &format!("from = {}, to = {}", keys("6"), keys("0")));
    let [still, moving] = [still, moving].map(|text| means(Path::new("."), &text, "", 1));
    let found = distance(&moving, &still);
    console::line(&format!("camera and world {found:.5}"));
    assert!(found < 0.01, "{found}");
}

#[test]
fn two_keys_are_a_velocity() {
    let things = |place: &str| {
        format!(
            "rts 1\n{VIEW}{EYE}instance crate {{ shape = box(size: (1, 1, 1)m), material = clay, {place} }}\n"
        )
    };
    let velocity = things("at = (0.25, 0, 0)m, velocity = (50, 0, -25)m/s");
    let keys = things("at = [-5ms: (0, 0, 0.125)m, 15ms: (1, 0, -0.375)m]");
    let bits = |text: &str| {
        let means = means(Path::new("."), text, "-5ms..15ms", 16);
        means.as_flattened().iter().map(|x| x.to_bits()).collect::<Vec<_>>()
    };
    assert_eq!(bits(&velocity), bits(&keys));
}

#[test]
fn keys_that_lead_nowhere_need_no_motion() {
    let text = format!(
        "rts 1\n{VIEW}{EYE}instance crate {{ shape = box(size: (1, 1, 1)m), material = clay
  at = [20ms: (0, 0, 0)m, 30ms: (1, 0, 0)m] }}\n"
    );
    let text = text.replace("SHUTTER", "-5ms..15ms").replace("SAMPLES", "1");
    let lowered = scene::compile(&text).lowered;
    assert!(lowered.motion.is_empty() && lowered.objects.is_empty());
}
