//! Shading normals that are not those of the geometry: no light is lost below the surface, none gets through it, and a
//! coarse mesh is lit as the smooth surface that it stands for.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::Path;

use glam::{DMat3, DVec3};
use pack::Pack;
use tests::picture::{self, channel};
use tests::scene;

#[path = "shading_normals/fold.rs"]
mod fold;

/// A ball of radius 1 with smooth normals: `rows` x `columns` faces.
struct Ball {
    points: Vec<DVec3>,
    triangles: Vec<[usize; 3]>,
}

impl Ball {
    fn new(rows: usize, columns: usize) -> Self {
        let at = |i: usize, j: usize| {
            let (theta, phi) = (PI * i as f64 / rows as f64, TAU * j as f64 / columns as f64);
            DVec3::new(theta.sin() * phi.cos(), theta.cos(), -theta.sin() * phi.sin())
        };
        let points = (0..=rows).flat_map(|i| (0..columns).map(move |j| at(i, j))).collect();
        let mut triangles = Vec::new();
        for i in 0..rows {
            for j in 0..columns {
                let k = (j + 1) % columns;
                let [a, b] = [i, i + 1].map(|row| row * columns + j);
                let [d, c] = [i, i + 1].map(|row| row * columns + k);
                if i + 1 < rows {
                    triangles.push([a, b, c]);
                }
                if i > 0 {
                    triangles.push([a, c, d]);
                }
            }
        }
        Self { points, triangles }
    }

    fn obj(&self) -> String {
        let mut text = String::new();
        for p in &self.points {
            let _ = writeln!(text, "v {} {} {}\nvn {} {} {}", p.x, p.y, p.z, p.x, p.y, p.z);
        }
        for t in &self.triangles {
            let [a, b, c] = t.map(|i| i + 1);
            let _ = writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}");
        }
        text
    }

    /// The interpolated normal, unit, where the ray meets the ball first.
    fn normal(&self, origin: DVec3, dir: DVec3) -> Option<DVec3> {
        let seen = self.triangles.iter().filter_map(|t| {
            let [a, b, c] = t.map(|i| self.points[i]);
            let m = DMat3::from_cols(a - b, a - c, dir);
            let faces = (b - a).cross(c - a).dot(dir) < 0.0;
            let x = m.inverse() * (a - origin);
            let inside = x.x >= 0.0 && x.y >= 0.0 && x.x + x.y <= 1.0;
            (faces && inside).then(|| (a * (1.0 - x.x - x.y) + b * x.x + c * x.y).normalize())
        });
        seen.into_iter().next()
    }
}

/// Radiance of every pixel, one channel, in image order.
fn render(dir: &Path, text: &str) -> Vec<f64> {
    let compiled = scene::compile_in(dir, text);
    let pack = Pack::from_bytes(scene::bytes(&compiled)).expect("valid");
    channel(picture::cpu(pack, |_| {}).film(), 1)
}

fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    for (name, text) in files {
        std::fs::write(dir.path().join(name), text).expect("a file can be written");
    }
    dir
}

const SIDE: usize = 96;

/// Under a far small light a white ball shows its cosine: every pixel where the smooth ball is lit is lit, and all of
/// them together as much, also of a turned instance that is stored once.
#[test]
fn a_coarse_ball_is_lit_as_a_smooth_one() {
    let light = DVec3::new(1.0, 0.2, 0.0).normalize();
    let (distance, radius) = (300.0, 0.3);
    for (rows, columns, twice) in [(8, 16, false), (8, 16, true), (16, 32, false)] {
        let ball = Ball::new(rows, columns);
        let dir = folder(&[("ball.obj", &ball.obj())]);
        let other = "instance other { shape = b, material = m, at = (0, 0, -40)m }\n";
        let at = light * distance;
        let text = format!(
            "rts 1
asset b = obj(\"ball.obj\", unit: m)
material m: diffuse {{ color = linear(1) }}
instance q {{ shape = b, material = m }}
{}light sun: sphere {{ center = ({:.9}, {:.9}, 0)m, radius = {radius}m }}
camera eye: perspective {{ from = (0, 0, 9)m, to = (0, 0, 0)m, up = (0, 1, 0), fov.vertical = 12.8deg }}
film f {{ size = ({SIDE}, {SIDE})px }}
render main: path {{ samples = 16, depth = 2 }}
",
            if twice { other } else { "" },
            at.x,
            at.y
        );
        let found = render(dir.path(), &text);
        judge(&format!("{rows} x {columns}, {twice}"), &ball, light, &found, distance, radius);
    }
}

fn judge(name: &str, ball: &Ball, light: DVec3, found: &[f64], distance: f64, radius: f64) {
    let eye = DVec3::new(0.0, 0.0, 9.0);
    let half = 6.4_f64.to_radians().tan();
    let cosine = |x: f64, y: f64| {
        let [x, y] = [x, y].map(|v| (v / SIDE as f64 * 2.0 - 1.0) * half);
        let normal = ball.normal(eye, DVec3::new(x, -y, -1.0).normalize())?;
        // The light is so near that its direction and distance differ over the ball.
        let to = light * distance - normal;
        Some(normal.dot(to).max(0.0) * (radius * radius) / to.length().powi(3))
    };
    let full = (radius / distance) * (radius / distance);
    let (mut truth, mut sum, mut n_dim) = (0.0, 0.0, 0);
    for row in 0..SIDE {
        for column in 0..SIDE {
            let corners = [(0, 0), (1, 0), (0, 1), (1, 1)];
            let corners = corners.map(|(i, j)| cosine((column + i) as f64, (row + j) as f64));
            let Some(known) = corners.into_iter().collect::<Option<Vec<f64>>>() else {
                continue;
            };
            let mean = known.iter().sum::<f64>() / 4.0;
            let is = found[row * SIDE + column];
            truth += mean;
            sum += is;
            let least = known.iter().copied().fold(f64::MAX, f64::min) / full;
            if (0.01..0.3).contains(&least) {
                n_dim += 1;
                assert!(
                    is > 0.8 * least * full,
                    "{name}: {column}, {row}: {} for {least}",
                    is / full
                );
            }
        }
    }
    assert!(n_dim > 200, "{name}: {n_dim} pixels near the terminator");
    assert!((sum / truth - 1.0).abs() < 0.003, "{name}: {}", sum / truth);
}

/// A cube whose normals point from its middle to its corners: the smooth surface bulges by a third of its side.
const CUBE: &str =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
vn -1 -1 -1\nvn 1 -1 -1\nvn 1 1 -1\nvn -1 1 -1\nvn -1 -1 1\nvn 1 -1 1\nvn 1 1 1\nvn -1 1 1
f 4//4 3//3 2//2 1//1\nf 5//5 6//6 7//7 8//8\nf 1//1 2//2 6//6 5//5
f 3//3 4//4 8//8 7//7\nf 2//2 3//3 7//7 6//6\nf 4//4 1//1 5//5 8//8\n";

/// A closed room in a bright sky and a strong sun, walls nearer to a smooth cube than its bulge, and itself with
/// smooth normals: dark. Without the room the same faces are lit.
#[test]
fn closed_rooms_stay_dark() {
    let dir = folder(&[("cube.obj", CUBE)]);
    let kinds = [
        "diffuse { color = linear(1) }",
        "conductor { color = linear(1), roughness = 0.4 }",
        "principled { color = linear(1), roughness = 0.3 }",
        "metal { color = linear(1), fuzz = 0 }",
        "clearcoat { color = linear(1) }",
    ];
    let smooth = "instance room { shape = c, material = m, scale = (1.1, 1.5, 4) }";
    let flat = "instance room { shape = box(size: (2.01, 2.01, 8)m), material = m }";
    let wide = "instance room { shape = c, material = m, scale = (9, 9, 9) }";
    let sheet = "instance room { shape = box(size: (2.2, 3, 8)m), material = m }
instance outer { shape = c, material = m, scale = (1.11, 1.51, 4.01) }";
    for kind in kinds {
        for (room, dark) in [(smooth, true), (flat, true), (wide, true), (sheet, true), ("", false)]
        {
            let text = format!(
                "rts 1
asset c = obj(\"cube.obj\", unit: m)
material m: {kind}
instance cube {{ shape = c, material = m }}
{room}
sky s: constant {{ color = linear(1000) }}
light sun: sphere {{ center = (50, 70, 20)m, radius = 2m, strength = 1e6 }}
camera eye: perspective {{ from = (0.3, 0.2, 3.9)m, to = (0, 0, 0)m, fov.vertical = 50deg }}
film f {{ size = (24, 24)px }}
render main: path {{ samples = 64, depth = 6 }}
"
            );
            let sum: f64 = render(dir.path(), &text).iter().sum();
            assert_eq!(sum == 0.0, dark, "{kind}, {room}: {sum}");
        }
    }
}

/// The steepest map on a ball in white light: white materials stay white.
#[test]
fn steep_normal_maps_lose_no_light() {
    let dir = folder(&[]);
    let image = image::RgbaImage::from_fn(8, 8, |x, y| {
        let [r, g] =
            [x * 5 + y * 3, x * 7 + y * 11].map(|v| 40 + u8::try_from(v % 8 * 25).expect("small"));
        image::Rgba([r, g, 200, 255])
    });
    image.save(dir.path().join("map.png")).expect("an image can be written");
    // What a flat surface of these keeps at any cosine.
    let kinds = [
        ("diffuse { color = linear(1)", 0.999),
        ("metal { color = linear(1), fuzz = 0", 0.999),
        ("conductor { color = linear(1), roughness = 0.3", 0.99),
        ("principled { color = linear(1), metallic = 1, roughness = 0.3", 0.99),
        ("principled { color = linear(1), roughness = 0.3", 0.99),
        ("principled { color = linear(1), roughness = 0.8, coat.weight = 1", 0.99),
    ];
    for (kind, least) in kinds {
        for strength in [1, 4, 10] {
            let text = format!(
                "rts 1
texture map = image(\"map.png\", space: data)
material m: {kind}, normal = map.rgb, normal.strength = {strength} }}
instance ball {{ shape = sphere(radius: 1m), material = m }}
sky s: constant {{ color = linear(1) }}
camera eye: perspective {{ from = (0, 0, 9)m, to = (0, 0, 0)m, fov.vertical = 9deg }}
film f {{ size = (16, 16)px }}
render main: path {{ samples = 256, depth = 64 }}
"
            );
            let found = render(dir.path(), &text);
            let mean = found.iter().sum::<f64>() / found.len() as f64;
            assert!((least..1.005).contains(&mean), "{kind}, {strength}: {mean}");
        }
    }
}
