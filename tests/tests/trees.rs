//! The builder of the tree and the layout of its nodes change how long a picture takes, and not one bit of it:
//! triangles that are in several leaves are one triangle to paths, lights and shadow rays, and a shadow ray that goes
//! through sheets is one ray.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use compiler::bvh::{Layout, Preset};
use compiler::pipeline::Compiled;
use glam::Vec3;
use pack::Pack;
use pack::abi::Triangle;
use runtime::kernel::f32 as single;
use tests::kernel::{Bench, ray, skip};
use tests::picture;
use tests::scene::{bytes, compile_built};
use tests::statistics::stream::Stream;

/// Long boards and blades through one another, among small triangles: what is split.
fn thicket_obj() -> String {
    let mut text = String::new();
    let mut state = 1_u32;
    let mut next = move || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        f64::from(state >> 8) / 16_777_216.0
    };
    let mut n = 0;
    for k in 0..900 {
        let size = if k % 9 == 0 { 1.2 } else { 0.05 };
        let p = [0; 3].map(|_| next() * 2.0 - 1.0);
        let d = [0; 3].map(|_| (next() - 0.5) * size);
        let e = [0; 3].map(|_| (next() - 0.5) * size.min(0.1));
        for (a, b) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
            let at = [0, 1, 2].map(|i| p[i] + a * d[i] + b * e[i]);
            let _ = writeln!(text, "v {:.6} {:.6} {:.6}", at[0], at[1] + 1.0, at[2]);
        }
        let _ = writeln!(text, "f {} {} {} {}", n + 1, n + 2, n + 3, n + 4);
        n += 4;
    }
    text
}

/// A thicket of `material`; floors in one plane, of two materials, one of them twice; a lamp.
fn thicket(dir: &Path, material: &str) -> String {
    std::fs::write(dir.join("thicket.obj"), thicket_obj())
        .expect("a temporary directory is writable");
    format!(
        "rts 1
asset wild = obj(\"thicket.obj\", unit: m, up: +y)
material stuff: {material}
material clay: diffuse {{ color = linear(0.6, 0.3, 0.2) }}
material moss: diffuse {{ color = linear(0.2, 0.5, 0.2) }}
material lamp: emissive {{ color = linear(1), strength = 5 }}
instance thicket {{ shape = wild, material = stuff }}
instance floor {{ shape = rectangle(size: (6, 6)m), material = clay }}
instance lawn {{ shape = rectangle(size: (4, 4)m), material = moss, at = (0.5, 0, 0.3)m }}
instance again {{ shape = rectangle(size: (4, 4)m), material = clay, at = (0.5, 0, 0.3)m }}
instance sun {{ shape = sphere(radius: 20cm), material = lamp, at = (0.5, 3, 1.5)m }}
camera eye: perspective {{ from = (0, 1.5, 5)m, to = (0, 0.8, 0)m, fov.vertical = 40deg }}
film tiny {{ size = (48, 48)px }}
render main: path {{ camera = eye, film = tiny, samples = 16, depth = 6, seed = 1 }}
"
    )
}

/// Renders with every builder and layout; returns how many places in leaves a triangle has by default.
fn check(material: &str) -> f64 {
    let dir = tempfile::tempdir().expect("dir");
    let text = thicket(dir.path(), material);
    let mut expected = None;
    let mut places = 0.0;
    let both = |preset| Layout::ALL.map(|layout| (preset, layout));
    for (preset, layout) in Preset::ALL.into_iter().flat_map(both) {
        let compiled = compile_built(dir.path(), &text, preset, layout);
        assert_eq!(compiled.lowered.nodes.is_empty(), layout == Layout::Wide);
        let counters = compiled.lowered.counters;
        assert_eq!(counters.references > counters.triangles, preset.splits_triangles(), "{preset}");
        if preset == Preset::Default {
            places = counters.references as f64 / counters.triangles as f64;
        }
        let pack = Pack::from_bytes(bytes(&compiled)).expect("what was written can be read");
        let outcome = picture::cpu(pack, |_| {});
        let picture = (outcome.film().means(), outcome.film().counters.rays);
        match &expected {
            None => expected = Some(picture),
            Some(expected) => {
                assert!(
                    *expected == picture,
                    "{material}: `{preset}`, `{layout}` shows another picture"
                );
            }
        }
    }
    places
}

#[test]
fn every_builder_and_layout_gives_the_same_picture() {
    for material in [
        "diffuse { color = linear(0.7) }",
        // Paths go on behind what they hit, and shadow rays too.
        "dielectric { ior = 1.5 }",
        "petal { color = linear(0.9, 0.5, 0.6) }",
        // Hundreds of lights whose triangles are in several leaves.
        "emissive { color = linear(1), strength = 0.2 }",
    ] {
        let places = check(material);
        assert!(places > 1.1, "{material}: {places} places a triangle prove little");
    }
}

/// A thicket, and the places of each triangle that has several.
fn split_thicket() -> (Compiled, Vec<Vec<u32>>) {
    let dir = tempfile::tempdir().expect("dir");
    let text = thicket(dir.path(), "diffuse { color = linear(0.7) }");
    let compiled = compile_built(dir.path(), &text, Preset::Default, Layout::Wide);
    let mut places: BTreeMap<[u32; 4], Vec<u32>> = BTreeMap::new();
    for ((i, t), shade) in (0..).zip(&compiled.lowered.triangles).zip(&compiled.lowered.shades) {
        places.entry([t.id0, t.id1, t.id2, shade.material]).or_default().push(i);
    }
    let several = places.into_values().filter(|places| places.len() > 1).collect();
    (compiled, several)
}

/// A ray that begins just behind the triangle that it is said to begin on.
#[test]
fn a_ray_does_not_meet_the_triangle_that_it_starts_on_in_any_place() {
    let (compiled, several) = split_thicket();
    assert!(several.len() > 50, "{} triangles are split", several.len());
    let lowered = &compiled.lowered;
    let bench = Bench::new().shapes(lowered);
    let mut kernel = bench.single();
    let mut met = 0;
    for places in &several {
        let t = &lowered.triangles[places[0] as usize];
        let [a, b, c] = [t.v0, t.v1, t.v2].map(Vec3::from);
        let n = (b - a).cross(c - a).normalize();
        for k in 1..20_u8 {
            let u = f32::from(k) / 20.0;
            let p = a + (b - a) * (u * 0.8) + (c - a) * 0.1;
            let dir = (n + (b - a).normalize() * (u - 0.5)).normalize();
            let from = |prim| single::Ray { skip: skip(prim), ..ray(p - dir * 1e-5, dir) };
            met += usize::from(places.contains(&kernel.trace(from(single::NONE)).prim));
            for &place in places {
                let hit = kernel.trace(from(place));
                assert!(!places.contains(&hit.prim), "{places:?}: {hit:?}");
            }
        }
    }
    assert!(met > several.len() * 10, "without being told, {met} rays meet it");
}

/// Which of two coinciding triangles is seen does not depend on where in the tree they are met.
#[test]
fn all_places_of_a_triangle_have_the_same_rank() {
    let (compiled, several) = split_thicket();
    let bench = Bench::new().shapes(&compiled.lowered);
    let mut kernel = bench.single();
    for pair in several.windows(2) {
        let first = kernel.order_before(pair[0][0], pair[1][0]);
        for (&i, &j) in pair[0].iter().flat_map(|i| pair[1].iter().map(move |j| (i, j))) {
            assert_eq!(kernel.order_before(i, j), first);
            assert_eq!(kernel.order_before(j, i), !first);
            assert!(!kernel.order_same(i, j) && !kernel.order_same(j, i));
        }
        for (&i, &j) in pair[0].iter().flat_map(|i| pair[0].iter().map(move |j| (i, j))) {
            assert!(kernel.order_same(i, j));
        }
        assert!(!kernel.order_same(pair[0][0], single::NONE));
    }
}

/// Both layouts of one tree, over the same triangles in the same order.
fn both_layouts(text: &str, dir: &Path) -> [Compiled; 2] {
    let both = Layout::ALL.map(|layout| compile_built(dir, text, Preset::Default, layout));
    let [wide, binary] = both.each_ref().map(|compiled| &compiled.lowered.triangles);
    assert_eq!(wide, binary);
    both
}

/// A ray from anywhere to a corner, along an edge, or along an axis through a corner: where boxes are tight.
fn tight_ray(stream: &mut Stream, triangles: &[Triangle]) -> (Vec3, Vec3) {
    let t = &triangles[stream.index(triangles.len())];
    let [a, b] = [t.v0, t.v1].map(Vec3::from);
    let far = Vec3::from([0; 3].map(|_| stream.unit24() * 3.0 - 1.5));
    match stream.index(4) {
        0 => (far, a - far),
        1 => (far, a.lerp(b, stream.unit24()) - far),
        2 => (a - (b - a) * 3.0, b - a),
        _ => {
            let axis = [Vec3::X, Vec3::Y, Vec3::Z][stream.index(3)];
            (a - axis * 2.0, axis)
        }
    }
}

#[test]
fn both_layouts_give_every_ray_the_same_hit() {
    let dir = tempfile::tempdir().expect("dir");
    let text = thicket(dir.path(), "diffuse { color = linear(0.7) }");
    let both = both_layouts(&text, dir.path());
    let benches = both.each_ref().map(|compiled| Bench::new().shapes(&compiled.lowered));
    let [mut wide, mut binary] = benches.each_ref().map(Bench::single);
    let triangles = &both[0].lowered.triangles;
    let mut stream = Stream::new(61, 0);
    let (mut met, n) = (0, 200_000);
    for _ in 0..n {
        let (origin, way) = tight_ray(&mut stream, triangles);
        let ray = ray(origin, way.normalize());
        let hits = [wide.trace(ray), binary.trace(ray)];
        // Of a triangle in several leaves any place may be met first.
        let what = |hit: single::Hit| triangles.get(hit.prim as usize).ok_or(hit.prim);
        let bits = hits.map(|hit| (what(hit), hit.t.to_bits(), hit.b.to_array().map(f32::to_bits)));
        assert_eq!(bits[0], bits[1], "from {origin} along {way}");
        met += usize::from(hits[0].prim != single::NONE);
    }
    assert!(met > n / 2, "{met} of {n} rays meet anything");
}
