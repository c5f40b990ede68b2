//! The choice of one of many lights by the tree that the compiler makes.

use std::fmt::Write as _;

use glam::{DVec3, DVec4};
use pack::abi::{Light, LightNode};
use runtime::kernel::{f32 as single, f64 as double};
use tests::kernel::Bench;
use tests::scene;
use tests::statistics::Counts;
use tests::statistics::stream::Stream;

use crate::{N, check, key};

/// Points from which lights are chosen, in normalised units: among them, near them, far away.
const POINTS: [DVec3; 3] =
    [DVec3::new(0.02, -0.01, 0.03), DVec3::new(0.3, -0.2, 0.1), DVec3::new(-5.0, 2.0, 9.0)];

/// Triangles, the sides on which they glow, and the receiver, as `receiver_at` of the kernel gives it: none, an opaque
/// surface, one that transmits. The last two have so few lights that each is weighed by itself.
const SETS: [(usize, &str, DVec4); 5] = [
    (300, "both", DVec4::ZERO),
    (300, "front", DVec4::ZERO),
    (300, "both", DVec4::new(0.6, 0.8, 0.0, 1.0)),
    (5, "both", DVec4::new(0.6, 0.8, 0.0, 1.0)),
    (5, "front", DVec4::new(0.0, -0.6, 0.8, 0.0)),
];

/// Chi-square tests here.
pub(crate) const CHECKS: usize = SETS.len() * POINTS.len();

/// Triangles that glow on `sides`, scattered and turned at random, and some spheres.
fn scattered(n: usize, sides: &str) -> (Vec<Light>, Vec<LightNode>) {
    let mut stream = Stream::new(11, n as u64);
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let mut obj = String::new();
    for i in 0..n {
        let at = DVec3::new(stream.unit(), stream.unit(), stream.unit()) * 4.0 - 2.0;
        for _ in 0..3 {
            let p = at + stream.direction() * 0.1;
            let _ = writeln!(obj, "v {} {} {}", p.x, p.y, p.z);
        }
        let _ = writeln!(obj, "f {} {} {}", 3 * i + 1, 3 * i + 2, 3 * i + 3);
    }
    std::fs::write(dir.path().join("sparks.obj"), obj).expect("writable");
    let text = format!(
        "rts 1
asset sparks = obj(\"sparks.obj\", unit: m, up: +y)
material lamp: emissive {{ color = linear(1), strength = 3, sides = {sides} }}
instance glow {{ shape = sparks, material = lamp }}
instance ball[i in 0..3] {{ shape = sphere(radius: 10cm), material = lamp, at = (i - 1, 0, 0)m }}
camera c: perspective {{ from = (0, 0, 5)m, to = (0, 0, 0)m }}
render r: path {{ camera = c }}
"
    );
    let lowered = scene::compile_in(dir.path(), &text).lowered;
    assert_eq!(lowered.lights.len(), n + 3);
    assert_eq!(lowered.light_nodes.len(), 2 * (n + 3) - 1);
    (lowered.lights, lowered.light_nodes)
}

/// Where lights face away the walk may end at two children of which none can light the point: then there is no
/// choice, which is an outcome like any other.
#[test]
fn lights_are_chosen_by_the_tree_with_the_probability_it_says() {
    for (set, (triangles, sides, receiver)) in SETS.into_iter().enumerate() {
        let (lights, nodes) = scattered(triangles, sides);
        let bench = Bench::new().lights(&lights).light_tree(&nodes);
        let (mut f32s, mut f64s) = (bench.single(), bench.double());
        let near = single::Receiver { facing: receiver.as_vec4(), ..f32s.receiver_none() };
        let exact = double::Receiver { facing: receiver, ..f64s.receiver_none() };
        let n = u32::try_from(lights.len()).expect("few");
        for (i, p) in POINTS.into_iter().enumerate() {
            let pmf = |index| f64s.dispatch_choose_pmf(index, p, exact);
            let shares: Vec<f64> = (0..n).map(pmf).collect();
            let sum: f64 = shares.iter().sum();
            assert!(
                if set == 0 { (sum - 1.0).abs() < 1e-6 } else { sum < 1.0 + 1e-6 },
                "{p}: {sum}"
            );
            let outcomes = shares.iter().copied().chain([(1.0 - sum).max(0.0)]);
            let mut counts = Counts::new(outcomes.map(|share| share * N as f64).collect());
            for k in 0..N {
                let test = 1500 + POINTS.len() * set + i;
                let u = f32s.sample_1d(key(test, k), single::PURPOSE_LIGHT_CHOICE);
                let choice = f32s.dispatch_choose(n, p.as_vec3(), near, u);
                let none = choice.pmf == 0.0;
                counts.add(if none { lights.len() } else { choice.index as usize });
                if k < 10_000 && !none {
                    let back = f32s.dispatch_choose_pmf(choice.index, p.as_vec3(), near);
                    assert_eq!(choice.pmf, back, "light {}", choice.index);
                    let truth = shares[choice.index as usize];
                    assert!((f64::from(choice.pmf) / truth - 1.0).abs() < 1e-3, "{p} {truth}");
                }
            }
            check(&format!("tree of {n} lights, {sides}, for {receiver}, from {p}"), &counts);
        }
    }
}

/// Many lights that face away have no probability; one that can be seen always has one.
#[test]
fn lights_that_face_the_point_have_a_probability() {
    let (lights, nodes) = scattered(200, "front");
    let bench = Bench::new().lights(&lights).light_tree(&nodes);
    let mut kernel = bench.double();
    let nobody = kernel.receiver_none();
    let mut stream = Stream::new(12, 0);
    let mut averted = 0;
    for _ in 0..200 {
        let p = stream.direction() * 3.0 * stream.unit();
        for (index, light) in (0..).zip(&lights) {
            let pmf = kernel.dispatch_choose_pmf(index, p, nobody);
            let v = |x: [f32; 3]| DVec3::from(x.map(f64::from));
            let normal = v(light.edge1).cross(v(light.edge2));
            let sphere = light.area == 0.0;
            let faces = sphere || normal.dot(p - v(light.origin)) > 1e-6 * normal.length();
            averted += u32::from(!faces && pmf == 0.0);
            assert!(!faces || pmf > 0.0, "light {index} from {p}");
        }
    }
    assert!(averted > 1000, "{averted}");
}
