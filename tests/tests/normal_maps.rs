//! Normal maps: the normal that is meant is the normal that is lit, however texture coordinates run.
//!
//! A far light of known irradiance makes the radiance of a white Lambert surface its cosine to the shading
//! normal, so a picture of one point measures that normal. Maps are constant, so that their texels are exact
//! up to their eight bits.

use std::path::Path;

use glam::{DMat3, DVec3};
use pack::Pack;
use tests::picture::{self, Estimate, channel};
use tests::scene;

/// Half the step of eight bits between -1 and 1.
const HALF_STEP: f64 = 1.0 / 255.0;

/// Distance and radius of the light, metres: it fills 4e-6 of the hemisphere.
const FAR: f64 = 1000.0;
const RADIUS: f64 = 2.0;

/// A unit square in the plane z = 0, front towards +z, with texture coordinates at its four corners, counter-clockwise
/// from (-1, -1).
fn square(uvs: [[f64; 2]; 4]) -> String {
    let [a, b, c, d] = uvs.map(|[u, v]| format!("vt {u} {v}\n"));
    let corners = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";
    format!("{corners}{a}{b}{c}{d}f 1/1 2/2 3/3 4/4\n")
}

/// What is lit: texture coordinates, texel of the map, its strength, how the map is placed (scale and turn in degrees),
/// how the square is turned (degrees, about x then y), and whether it is mirrored along x.
#[derive(Clone, Copy, Debug)]
struct Case {
    uvs: [[f64; 2]; 4],
    texel: [u8; 3],
    strength: f64,
    placed: [f64; 2],
    rotate: [f64; 2],
    mirrored: bool,
}

/// u along +x, v along +y.
const PLAIN: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
/// u along -x.
const MIRRORED: [[f64; 2]; 4] = [[1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
/// v along -y, stretched.
const UPSIDE_DOWN: [[f64; 2]; 4] = [[0.0, 3.0], [1.0, 3.0], [1.0, 0.0], [0.0, 0.0]];
/// u along +y, v along -x.
const TURNED: [[f64; 2]; 4] = [[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];

const TILTED: Case = Case {
    uvs: PLAIN,
    texel: [181, 99, 230],
    strength: 1.0,
    placed: [1.0, 0.0],
    rotate: [0.0, 0.0],
    mirrored: false,
};

fn value(byte: u8) -> f64 {
    f64::from(byte) / 127.5 - 1.0
}

/// World from the square's frame.
fn placed(case: &Case) -> DMat3 {
    let [x, y] = case.rotate.map(f64::to_radians);
    let mirror = DVec3::new(if case.mirrored { -1.0 } else { 1.0 }, 1.0, 1.0);
    DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x) * DMat3::from_diagonal(mirror)
}

/// The normal that a map means, in the world: along where u and v grow, and out of the front.
fn meant(case: &Case) -> DVec3 {
    let [scale, turn] = case.placed;
    let (sin, cos) = turn.to_radians().sin_cos();
    let [a, b, _, d] =
        case.uvs.map(|[u, v]| [scale * (cos * u - sin * v), scale * (sin * u + cos * v)]);
    // The square has side 2 along x and y: rows of the inverse of d(u, v) / d(x, y).
    let du = [(b[0] - a[0]) / 2.0, (d[0] - a[0]) / 2.0];
    let dv = [(b[1] - a[1]) / 2.0, (d[1] - a[1]) / 2.0];
    let area = du[0] * dv[1] - du[1] * dv[0];
    let along_u = DVec3::new(dv[1], -dv[0], 0.0) / area;
    let along_v = DVec3::new(-du[1], du[0], 0.0) / area;
    let world = placed(case);
    let front = world * DVec3::Z;
    let [x, y] = [0, 1].map(|k| value(case.texel[k]) * case.strength);
    let (u, v) = ((world * along_u).normalize(), (world * along_v).normalize());
    (u * x + v * y + front * value(case.texel[2])).normalize()
}

/// Renders the middle of the square from `eye` under a light along `light`; radiance over that of a surface that
/// faces the light.
fn lit(case: &Case, eye: DVec3, light: DVec3, with_map: bool) -> Estimate {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    write(dir.path(), case);
    let at = light * FAR;
    let map = if with_map {
        format!(", normal = map.rgb, normal.strength = {}", case.strength)
    } else {
        String::new()
    };
    let scale = if case.mirrored { "(-1, 1, 1)" } else { "(1, 1, 1)" };
    let [x, y] = case.rotate;
    let [size, turn] = case.placed;
    let text = format!(
        "rts 1
texture map = image(\"map.png\", space: data, scale: {size}, rotate: {turn}deg)
asset square = obj(\"square.obj\", unit: m, up: +y)
material m: diffuse {{ color = linear(1){map} }}
instance s {{ shape = square, material = m, rotate = ({x}, {y}, 0)deg, scale = {scale} }}
light sun: sphere {{ center = ({:.12}, {:.12}, {:.12})m, radius = {RADIUS}m }}
camera eye: perspective {{ from = ({}, {}, {})m, to = (0, 0, 0)m, up = (0.1, 1, 0.2), fov.vertical = 0.001deg }}
film f {{ size = (8, 8)px }}
render main: path {{ camera = eye, film = f, samples = 64, depth = 2, seed = 5, sampler = pcg }}
",
        at.x, at.y, at.z, eye.x, eye.y, eye.z
    );
    let compiled = scene::compile_in(dir.path(), &text);
    let pack = Pack::from_bytes(scene::bytes(&compiled)).expect("valid");
    let full = (RADIUS / FAR) * (RADIUS / FAR);
    let outcome = picture::cpu(pack, |_| {});
    let values = channel(outcome.film(), 1);
    Estimate::of(&values.into_iter().map(|v| v / full).collect::<Vec<_>>())
}

fn write(dir: &Path, case: &Case) {
    let [r, g, b] = case.texel;
    let image = image::RgbaImage::from_pixel(4, 4, image::Rgba([r, g, b, 255]));
    image.save(dir.join("map.png")).expect("an image can be written");
    std::fs::write(dir.join("square.obj"), square(case.uvs)).expect("a mesh can be written");
}

/// The lit cosine is that of the normal that is meant, for two lights: so two components of it are right, and with the
/// side the third.
fn check(case: &Case) {
    let front = placed(case) * DVec3::Z;
    let normal = meant(case);
    let side = front.any_orthonormal_vector();
    let eye = (front + side * 0.2).normalize() * 3.0;
    for turn in [side, -side, front.cross(side), -front.cross(side)] {
        let light = (front + turn * 0.4).normalize();
        let found = lit(case, eye, light, true);
        let truth = normal.dot(light).max(0.0);
        let off = (found.mean - truth).abs();
        // That the light is not a point, and that few scattered rays find it, is 4e-6 of the value. Packed normals of
        // a mesh are up to 6.5e-5 off (`functions/math.rs` measures it), less for these; with Sobol's smaller noise the
        // worst of them would be seen, so samples are independent here.
        assert!(off < 4.0 * found.error + 2e-5, "{case:?}: {found:?}, not {truth}");
    }
}

#[test]
fn a_tilted_map_is_lit_as_the_tilted_surface_would_be() {
    check(&TILTED);
    check(&Case { strength: 0.5, ..TILTED });
    check(&Case { texel: [60, 128, 200], strength: 1.7, ..TILTED });
}

#[test]
fn tilts_follow_the_texture_coordinates() {
    for uvs in [MIRRORED, UPSIDE_DOWN, TURNED] {
        check(&Case { uvs, ..TILTED });
    }
}

#[test]
fn tilts_follow_placed_maps() {
    check(&Case { placed: [1.0, 90.0], ..TILTED });
    check(&Case { placed: [-3.0, 0.0], ..TILTED });
    check(&Case { placed: [0.4, -25.0], uvs: TURNED, ..TILTED });
}

#[test]
fn tilts_follow_turned_and_mirrored_instances() {
    check(&Case { rotate: [25.0, -40.0], ..TILTED });
    for uvs in [PLAIN, MIRRORED, TURNED] {
        check(&Case { uvs, mirrored: true, rotate: [0.0, 130.0], ..TILTED });
    }
}

/// A surface of this tilt without a map gives the same picture.
#[test]
fn a_map_does_what_tilted_geometry_does() {
    let tilt: f64 = 20.0;
    let (sin, cos) = tilt.to_radians().sin_cos();
    let byte = |v: f64| ((v + 1.0) * 127.5).round();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
    let texel = [0.0, sin, cos].map(|v| byte(v) as u8);
    let map = Case { texel, ..TILTED };
    // The green tilt is up: the square turned about x by the same angle backwards.
    let geometry = Case { rotate: [-tilt, 0.0], ..TILTED };
    let light = DVec3::new(0.3, 0.5, 1.0).normalize();
    let eye = DVec3::new(0.0, 0.4, 3.0);
    let (a, b) = (lit(&map, eye, light, true), lit(&geometry, eye, light, false));
    let bound = HALF_STEP * 2.0 + 4.0 * (a.error + b.error);
    assert!((a.mean - b.mean).abs() < bound, "{a:?} and {b:?}");
    let flat = lit(&TILTED, eye, light, false);
    assert!((a.mean - flat.mean).abs() > 0.05, "the tilt shows: {a:?}, {flat:?}");
}

/// (128, 128, 255) is nearly no tilt.
#[test]
fn a_flat_map_is_no_map() {
    let flat = Case { texel: [128, 128, 255], ..TILTED };
    let light = DVec3::new(-0.4, 0.2, 1.0).normalize();
    let eye = DVec3::new(0.5, 0.4, 3.0);
    let (a, b) = (lit(&flat, eye, light, true), lit(&flat, eye, light, false));
    let bound = HALF_STEP + 4.0 * (a.error + b.error);
    assert!((a.mean - b.mean).abs() < bound, "{a:?} and {b:?}");
}

/// What is a bump from the front is a dent from behind: the normal is the same line.
#[test]
fn from_behind_a_map_is_turned_inside_out() {
    let normal = meant(&TILTED);
    for light in [DVec3::new(0.4, 0.0, -1.0), DVec3::new(0.0, 0.4, -1.0)].map(DVec3::normalize) {
        let found = lit(&TILTED, DVec3::new(0.3, 0.1, -3.0), light, true);
        let truth = (-normal).dot(light);
        assert!((found.mean - truth).abs() < 4.0 * found.error + 2e-5, "{found:?}, not {truth}");
    }
}
