//! A bump from the difference of two different fields (the naive form), and of one field (ours).

use glam::{DVec3, Vec3, Vec4};
use pack::abi::{MaterialKind, Object};
use runtime::kernel::f32::Kernel;

use super::{Topic, row};
use crate::kernel::{Bench, Lobe};
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

const STEP: f32 = 0.010;
const STRENGTH: f32 = 0.02;

/// Key of the fabric.
const KEY: u32 = 1;

/// What a bump does to a normal.
#[derive(Clone, Copy, Debug)]
pub struct Tilt {
    /// Mean angle to the exact bump's normal, in degrees.
    pub error: f64,
    /// Mean tilt, in degrees.
    pub tilt: f64,
}

/// A floor of fabric.
fn floor() -> Lobe {
    Lobe { normal: DVec3::Y, ..Lobe::new(MaterialKind::Fabric) }
}

/// The floor's normal as the kernel tilts it by `values` of a field: one step back along each axis, and at the
/// point.
fn tilted(kernel: &mut Kernel<'_>, values: Vec4) -> Vec3 {
    let mut scatter = floor().single();
    kernel.bump_tilt(&mut scatter, 0, values, Vec3::Y);
    scatter.ns
}

/// The bumps of the naive form and of the kernel on a floor, against the gradient of the fabric's field by central
/// differences in double precision.
#[must_use]
pub fn measure(n: u64) -> [Tilt; 2] {
    let record = floor().record();
    let axis = |k: usize| DVec3::AXES[k].as_vec3().to_array();
    let object = Object { row_x: axis(0), row_y: axis(1), row_z: axis(2), ..Object::default() };
    let material = pack::abi::Material {
        bump_step: STEP,
        bump_height: STRENGTH,
        pattern_scale: 1.0,
        ..record
    };
    let bench = Bench::new().materials(&[material]).objects(&[object]);
    let mut kernel = bench.single();
    let mut stream = Stream::new(199, 0);
    let mut sums = [[Mean::default(); 2]; 2];
    for _ in 0..n {
        let p = Vec3::from([0; 3].map(|_| 8.0 * stream.unit24()));
        let exact = exact(&bench, p.as_dvec3());
        let value = kernel.fabric_field(p, 1.0, KEY);
        let back = [0, 1, 2].map(|k| kernel.bump_point(p, STEP, k));
        let naive = back.map(|q| kernel.fbm_value(q, 4, KEY));
        let ours = back.map(|q| kernel.fabric_field(q, 1.0, KEY));
        for (sum, [x, y, z]) in sums.iter_mut().zip([naive, ours]) {
            let found = tilted(&mut kernel, Vec4::new(x, y, z, value));
            sum[0].add(f64::from(found.angle_between(exact)).to_degrees());
            sum[1].add(f64::from(found.angle_between(Vec3::Y)).to_degrees());
        }
    }
    sums.map(|[error, tilt]| Tilt { error: error.value(), tilt: tilt.value() })
}

/// The floor's normal tilted by the slope of the fabric's field.
fn exact(bench: &Bench, p: DVec3) -> Vec3 {
    let mut kernel = bench.double();
    let h = 1e-5;
    let mut slope = |axis: DVec3| {
        let [a, b] = [1.0, -1.0].map(|side| kernel.fabric_field(p + axis * (side * h), 1.0, KEY));
        (a - b) / (2.0 * h)
    };
    let gradient = DVec3::new(slope(DVec3::X), 0.0, slope(DVec3::Z));
    (DVec3::Y - gradient * f64::from(STRENGTH)).normalize().as_vec3()
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let [naive, ours] = measure(100_000);
    let degrees = |x: f64| format!("{x:.2}°");
    Topic {
        title: "A bump is the slope of one field",
        places: &["shaders/wgsl/bsdf/fabric.wgsl", "shaders/wgsl/pattern/bump.wgsl"],
        rows: vec![
            row(
                "angle between the bumped normal and the exact one, fabric",
                degrees(naive.error),
                degrees(ours.error),
            ),
            row("mean tilt of the normal, fabric", degrees(naive.tilt), degrees(ours.tilt)),
        ],
        fact: "The difference of two different fields does not shrink with the step: it tilts \
            every normal. The same field at both points gives its slope.",
    }
}
