//! What `rtr --pick` says of a pixel: the names and lines of the text that made it.

use runtime::pick::{Declared, Pick, Primitive, Surface, pick};
use runtime::{Job, Scene};
use tests::scene::{bytes, compile_in};

/// Two triangles, in parts of their own, each before one half of the camera.
const SHEET: &str = "\
v -4 0 -4
v 0 0 -4
v 0 0 4
v 4 0 -4
v 4 0 4
g left
f 1 3 2
g right
f 2 3 4
";

/// Seen from above, 8 x 8 pixels of 1 m: the sheet behind a ball, a post and a lamp.
const SCENE: &str = "rts 1
asset sheet = obj(\"sheet.obj\", unit: m, up: +y)
material clay: diffuse { color = linear(0.5) }
material glow: emissive { color = linear(1) }
object slab {
  shape = sheet.right
  material = clay
}
object post { shape = box(size: (1, 1, 1)m), material = clay }
object pair { shape = [post] }
instance ground: slab { at = (0, -1, 0)m }
instance balls[i in 0..2] {
  shape = sphere(radius: 50cm)
  material = glow
  at = (-1.5 - i, 0, -1.5)m
}
instance posts { shape = pair, at = (-1.5, 0, 1.5)m }
light bulb: sphere { center = (1.5, 1, 1.5)m, radius = 40cm, power = 10 }
camera eye: perspective { from = (0, 20, 0)m, to = (0, 0, 0)m, up = (0, 0, -1), fov.vertical = 23deg }
film tiny { size = (8, 8)px }
render main: path { camera = eye, film = tiny, samples = 1, depth = 4, seed = 1 }
";

fn picked(pixel: [u32; 2]) -> Pick {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("sheet.obj"), SHEET).expect("writable");
    let pack = pack::Pack::from_bytes(bytes(&compile_in(folder.path(), SCENE))).expect("valid");
    let scene = Scene::new(pack);
    pick(&scene, &Job::of_scene(&scene), pixel).expect("a pixel of the image")
}

fn surface(pixel: [u32; 2]) -> Surface {
    picked(pixel).surface.expect("something is there")
}

#[expect(clippy::unnecessary_wraps, reason = "what it is compared with may be nothing")]
fn at(name: &str, line: u32) -> Option<Declared> {
    Some(Declared { name: name.to_owned(), file: Some("test.rts".to_owned()), line: Some(line) })
}

#[test]
fn a_part_of_a_mesh_has_the_lines_of_its_object_and_asset() {
    let seen = surface([5, 2]);
    assert_eq!((seen.instance, seen.light), (at("ground", 11), None));
    assert_eq!((seen.object, seen.shape), (at("slab", 5), at("mesh", 6)));
    assert_eq!((seen.asset, seen.part.as_deref()), (at("sheet", 2), Some("right")));
    assert_eq!(seen.material, at("clay", 3));
    assert!(matches!(seen.primitive, Primitive::Triangle(_)));
    assert!((seen.position[1] + 1.0).abs() < 1e-5, "{:?}", seen.position);
    assert!((seen.depth - 21.0).abs() < 1e-4, "{}", seen.depth);
    assert!(seen.distance > seen.depth);
    assert!((seen.normal[1] - 1.0).abs() < 1e-6, "{:?}", seen.normal);
}

#[test]
fn instances_with_an_index_groups_and_lights_are_told_apart() {
    let ball = surface([2, 2]);
    assert_eq!((ball.instance, ball.object), (at("balls[0]", 12), None));
    assert_eq!((ball.shape, ball.material), (at("sphere", 13), at("glow", 4)));
    assert_eq!(surface([1, 2]).instance, at("balls[1]", 12));
    let post = surface([2, 5]);
    assert_eq!((post.instance, post.object), (at("posts.post", 17), at("post", 9)));
    assert!((post.position[1] - 0.5).abs() < 1e-5, "{:?}", post.position);
    let bulb = surface([5, 5]);
    assert_eq!((bulb.instance, bulb.light), (None, at("bulb", 18)));
}

#[test]
fn where_nothing_is_there_is_the_sky() {
    let pick = picked([0, 4]);
    assert_eq!((pick.surface, pick.camera), (None, at("eye", 19)));
}

#[test]
fn the_text_has_a_line_for_each_fact() {
    let text = picked([5, 2]).to_string();
    let start = "pixel 5,2 of 8x8\ninstance  ground (test.rts:11)\nobject    slab (test.rts:5)\n";
    assert!(text.starts_with(start), "{text}");
    for line in ["shape     mesh (test.rts:6)", "part      right", "side      "] {
        assert!(text.contains(line), "{line}: {text}");
    }
}
