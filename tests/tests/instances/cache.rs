//! Trees of meshes that are stored once are found again wherever the meshes are.

use std::fmt::Write as _;
use std::path::Path;

use compiler::cache::{Cache, MIN_PRIMITIVES};
use compiler::pipeline::Compiled;
use tests::scene::compile_with;

/// Hills of `2 n n` triangles between -1 and 1.
fn write_hills(path: &Path, n: usize) {
    let mut text = String::from("s off\n");
    let at = |i: usize| i as f64 / n as f64 * 2.0 - 1.0;
    for j in 0..=n {
        for i in 0..=n {
            let height = ((i * 37 + j * 61 + i * j * 13) % 16) as f64 / 160.0;
            writeln!(text, "v {} {height} {}", at(i), -at(j)).expect("strings take all");
        }
    }
    for j in 0..n {
        for i in 0..n {
            let a = j * (n + 1) + i + 1;
            let (b, c, d) = (a + 1, a + n + 2, a + n + 1);
            writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}").expect("strings take all");
        }
    }
    std::fs::write(path, text).expect("a mesh can be written");
}

fn compiled(dir: &Path, cache: &Cache, places: [&str; 2], ground: &str) -> Compiled {
    let [first, second] = places;
    let text = format!(
        "rts 1
sky day: constant {{ color = linear(1) }}
material clay: diffuse {{ color = linear(0.5) }}
asset hills = obj(\"hills.obj\", unit: m, up: +y)
asset plain = obj(\"plain.obj\", unit: m, up: +y)
instance ground {{ shape = plain, material = clay, scale = {ground}, at = (0, -1, 0)m }}
instance a {{ shape = hills, material = clay, {first} }}
instance b {{ shape = hills, material = clay, {second} }}
camera eye: perspective {{ from = (0, 2, 4)m, to = (0, 0, 0)m, fov.vertical = 40deg }}
film f {{ size = (8, 8)px }}
render main: path {{ camera = eye, film = f, samples = 1, depth = 3, seed = 1 }}
"
    );
    compile_with(dir, &text, cache)
}

/// The ground reaches beyond the hills on all sides, so that moving them does not change the scene's frame.
#[test]
fn moving_an_instance_builds_no_tree_of_a_mesh() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let n = 110;
    assert!(2 * n * n > MIN_PRIMITIVES);
    write_hills(&dir.path().join("hills.obj"), n);
    write_hills(&dir.path().join("plain.obj"), n + 1);
    let cache = Cache::at(dir.path().join("cache"));
    let places = ["at = (-2, 0, 0)m", "at = (2, 0.3, 0.5)m, rotate = (10, 50, 0)deg"];
    let compile = |places, ground| compiled(dir.path(), &cache, places, ground);
    let first = compile(places, "(9, 90, 9)");
    let trees = |compiled: &Compiled| {
        let trees = &compiled.lowered.trees;
        (trees.groups, trees.stored, trees.loaded)
    };
    assert_eq!(first.lowered.counters.instances, 2);
    assert_eq!(trees(&first), (2, 2, 0), "one of the ground, one of the hills");
    // The same again: all found, and the same records.
    let again = compile(places, "(9, 90, 9)");
    assert_eq!(trees(&again), (2, 0, 2));
    assert_eq!(again.lowered.wide_nodes, first.lowered.wide_nodes);
    assert_eq!(again.lowered.triangles, first.lowered.triangles);
    // Moved, turned, mirrored and stretched.
    let other = "at = (1, 1, -1)m, rotate = (0, 0, 40)deg, scale = (-1, 0.5, 2)";
    let moved = compile([places[0], other], "(9, 90, 9)");
    assert_eq!(trees(&moved), (2, 0, 2));
    assert_ne!(moved.lowered.instances, first.lowered.instances);
    let of_mesh = |compiled: &Compiled| {
        compiled.lowered.triangles[compiled.lowered.triangles.len() - 2 * n * n..].to_vec()
    };
    let corners = |t: &pack::abi::Triangle| [t.v0, t.v1, t.v2];
    let same = |a: &Compiled, b: &Compiled| {
        of_mesh(a).iter().map(corners).eq(of_mesh(b).iter().map(corners))
    };
    assert!(same(&moved, &first), "the mesh is stored as it was");
    // A scene of another size has another frame: the ground's tree is built again, the hills' is not.
    let larger = compile(places, "(13, 90, 9)");
    assert_eq!(trees(&larger), (2, 1, 1));
}

#[test]
fn a_pack_does_not_depend_on_the_cache() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    write_hills(&dir.path().join("hills.obj"), 105);
    write_hills(&dir.path().join("plain.obj"), 3);
    let cache = Cache::at(dir.path().join("cache"));
    let places = ["at = (-2, 0, 0)m", "at = (2, 0.3, 0.5)m"];
    let packs = [&cache, &cache, &Cache::disabled()]
        .map(|cache| tests::scene::bytes(&compiled(dir.path(), cache, places, "(9, 90, 9)")));
    assert!(packs[0] == packs[1] && packs[1] == packs[2]);
}
