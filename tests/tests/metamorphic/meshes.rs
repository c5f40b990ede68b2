//! The same surface from other triangles: in another order, or each cut in four. Trees, lights and numbers of
//! triangles differ, so the pictures are compared by a z-test.

use std::fmt::Write;
use std::path::Path;

use compiler::pipeline::Compiled;
use tests::scene;

use crate::compare::{Means, SIZE, assert_same_mean};

/// Points and texture coordinates of triangles; all are multiples of 2^-10, so that middles are exact.
#[derive(Clone)]
struct Mesh {
    corners: Vec<[([f64; 3], [f64; 2]); 3]>,
    /// The compiler makes normals; else corners are flat.
    smooth: bool,
}

impl Mesh {
    /// Hills between -2 and 2, 8 x 8 squares of two triangles.
    fn hills() -> Self {
        let at = |i: u32, j: u32| {
            let height = f64::from((i * 37 + j * 61 + i * j * 13) % 16) / 32.0;
            let (x, z) = (f64::from(i) / 2.0 - 2.0, 2.0 - f64::from(j) / 2.0);
            ([x, height, z], [f64::from(i) / 8.0, f64::from(j) / 8.0])
        };
        let squares = (0..8).flat_map(|j| (0..8).map(move |i| (i, j)));
        let corners = squares.flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        Self { corners: corners.collect(), smooth: true }
    }

    /// A pyramid without a bottom, open and bright below: four lights.
    fn shade() -> Self {
        let rim = [[-0.75, 0.5], [0.75, 0.75], [1.0, -0.5], [-0.5, -0.75]];
        let corner = |k: usize| ([rim[k][0], 0.0, rim[k][1]], [k as f64 / 4.0, 0.0]);
        let top = ([0.125, 0.375, 0.0], [0.5, 1.0]);
        // Fronts below.
        let corners = [0, 1, 2, 3].map(|k| [corner((k + 1) % 4), corner(k), top]);
        Self { corners: corners.into(), smooth: false }
    }

    /// The same triangles in another order.
    fn permuted(&self) -> Self {
        let n = self.corners.len();
        // 29 is prime to 4 and to 128.
        let corners = (0..n).map(|i| self.corners[(i * 29 + 11) % n]).collect();
        Self { corners, ..self.clone() }
    }

    /// Each triangle cut in four between the middles of its sides.
    fn split(&self) -> Self {
        let corners = self.corners.iter().flat_map(|&[a, b, c]| {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        });
        Self { corners: corners.collect(), ..self.clone() }
    }

    fn write(&self, path: &Path) {
        let mut text = String::from(if self.smooth { "s 1\n" } else { "s off\n" });
        for ([x, y, z], [u, v]) in self.corners.iter().flatten() {
            writeln!(text, "v {x} {y} {z}\nvt {u} {v}").expect("strings take every text");
        }
        for i in (1..).step_by(3).take(self.corners.len()) {
            let [b, c] = [i + 1, i + 2];
            writeln!(text, "f {i}/{i} {b}/{b} {c}/{c}").expect("strings take every text");
        }
        std::fs::write(path, text).expect("a mesh can be written");
    }
}

type Corner = ([f64; 3], [f64; 2]);

fn middle(a: Corner, b: Corner) -> Corner {
    ([0, 1, 2].map(|k| a.0[k].midpoint(b.0[k])), [0, 1].map(|k| a.1[k].midpoint(b.1[k])))
}

/// Painted hills and a ball below a lamp with a picture.
fn compiled(hills: &Mesh, shade: &Mesh) -> Compiled {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    hills.write(&dir.path().join("hills.obj"));
    shade.write(&dir.path().join("shade.obj"));
    let byte = |x: u32| u8::try_from(x).expect("the image is small");
    let texel = |x, y| image::Rgb([120 + 14 * byte(x), 240 - 12 * byte(y), 60 + 20 * byte(x ^ y)]);
    let paint = image::RgbImage::from_fn(8, 8, texel);
    paint.save(dir.path().join("paint.png")).expect("an image can be written");
    let [width, height] = SIZE;
    let text = format!(
        "rts 1
sky dim: constant {{ color = linear(0.2, 0.25, 0.3) }}
texture paint = image(\"paint.png\", space: srgb)
asset hills = obj(\"hills.obj\", unit: m, up: +y)
asset shade = obj(\"shade.obj\", unit: m, up: +y)
material turf: principled {{ color = paint.rgb, roughness = 0.6 }}
material lamp: principled {{ color = linear(0.2), emission.color = paint.rgb, emission.strength = 6 }}
material steel: metal {{ color = linear(0.8), fuzz = 0.3 }}
instance ground {{ shape = hills, material = turf }}
instance umbrella {{ shape = shade, material = lamp, at = (-0.25, 2, 0.25)m }}
instance ball {{ shape = sphere(radius: 50cm), material = steel, at = (0.75, 0.75, -0.25)m }}
camera eye: perspective {{ from = (0.5, 2, 4)m, to = (0, 0.75, 0)m, fov.vertical = 45deg }}
film f {{ size = ({width}, {height})px }}
render main: path {{ camera = eye, film = f, samples = 128, depth = 6, seed = 1 }}
"
    );
    scene::compile_in(dir.path(), &text)
}

#[test]
fn the_order_of_triangles_does_not_matter() {
    let (hills, shade) = (Mesh::hills(), Mesh::shade());
    let a = compiled(&hills, &shade);
    let b = compiled(&hills.permuted(), &shade.permuted());
    assert_ne!(a.lowered.lights[0], b.lowered.lights[0], "the lights are in another order");
    assert_same_mean("triangles in another order", &Means::of(&a, 1000), &Means::of(&b, 2000));
}

/// The four lights, each weighed by itself, become sixteen, which are chosen by a tree. Without normals: those of a vertex in the
/// middle are unit again, which bends what is interpolated.
#[test]
fn triangles_cut_in_four_are_the_same_surface() {
    let (hills, shade) = (Mesh { smooth: false, ..Mesh::hills() }, Mesh::shade());
    let a = compiled(&hills, &shade);
    let b = compiled(&hills.split(), &shade.split());
    assert_eq!(a.lowered.triangles.len() * 4, b.lowered.triangles.len());
    assert_eq!([a.lowered.light_nodes.len(), b.lowered.light_nodes.len()], [7, 31]);
    assert_same_mean("triangles cut in four", &Means::of(&a, 3000), &Means::of(&b, 4000));
}
