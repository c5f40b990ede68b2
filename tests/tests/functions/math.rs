//! Sines, powers, angles, half floats, packed normals, frames.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec3};
use tests::kernel::Bench;
use tests::statistics::stream::Stream;

use crate::Worst;

#[test]
fn sine_and_cosine_of_turns() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let (mut value, mut circle, mut twin) = (Worst::default(), Worst::default(), Worst::default());
    for i in (0..1_u32 << 24).step_by(7).chain([(1 << 24) - 1, 1 << 24]) {
        let u = f64::from(i) * 2.0_f64.powi(-24);
        let (sin, cos) = (TAU * u).sin_cos();
        let at = single.sincos_2pi(u as f32).as_dvec2();
        value.add((at.x - sin).abs().max((at.y - cos).abs()), u);
        circle.add((at.length_squared() - 1.0).abs(), u);
        let at = double.sincos_2pi(u);
        twin.add((at.x - sin).abs().max((at.y - cos).abs()), u);
    }
    value.check("sincos_2pi", 8.9e-8);
    circle.check("sincos_2pi squared", 2.2e-7);
    twin.check("sincos_2pi in double precision", 5e-8);
}

/// Of each point of the square the distance to its middle, by the larger coordinate, is that of the disk; what the
/// smaller one is of it, is the angle in eighths of a turn.
#[test]
fn squares_become_disks() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let (mut value, mut twin) = (Worst::default(), Worst::default());
    let mut stream = Stream::new(29, 0);
    let step = 2.0_f64.powi(-24);
    let edges = [0.0, 0.25, 0.5 - step, 0.5, 0.75, 1.0 - step];
    let corners = edges.iter().flat_map(|x| edges.map(|y| DVec2::new(*x, y)));
    let inside = std::iter::repeat_with(|| stream.pair24().as_dvec2()).take(400_000);
    for u in corners.chain(inside) {
        let q = 2.0 * u - DVec2::splat(1.0 - step);
        let r = q.abs().max_element();
        let angle = if q.x.abs() > q.y.abs() { q.y / q.x } else { 2.0 - q.x / q.y } * TAU / 8.0;
        let far = if q.x.abs() > q.y.abs() { q.x } else { q.y };
        let truth = far * DVec2::new(angle.cos(), angle.sin());
        let at = single.disk_concentric(u.as_vec2());
        assert_eq!(f64::from(at.r), r);
        value.add((at.turn.as_dvec2() * r - truth).abs().max_element(), u.x);
        let at = double.disk_concentric(u);
        twin.add((at.turn * at.r - truth).abs().max_element(), u.x);
    }
    value.check("disk_concentric", 1e-7);
    twin.check("disk_concentric in double precision", 5e-8);
}

/// `n` values between `low` and `high`, even in the logarithm, with both ends.
fn log_spaced(low: f64, high: f64, n: usize) -> impl Iterator<Item = f32> {
    let step = (high / low).ln() / (n - 1) as f64;
    (0..n).map(move |i| (low * (i as f64 * step).exp()) as f32)
}

#[test]
fn powers_of_two() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let (mut value, mut twin) = (Worst::default(), Worst::default());
    for i in -400_000..=400_000 {
        let x = i as f32 / 4000.0;
        let truth = f64::from(x).exp2();
        value.add((f64::from(single.exp_log_exp2(x)) / truth - 1.0).abs(), x.into());
        twin.add((double.exp_log_exp2(x.into()) / truth - 1.0).abs(), x.into());
    }
    value.check("exp2", 9.5e-8);
    twin.check("exp2 in double precision", 5e-8);
    assert_eq!(single.exp_log_exp2(-126.5), 0.0);
    assert!(single.exp_log_exp2(1e9).is_finite());
}

#[test]
fn logarithms_to_base_two() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let (mut absolute, mut relative, mut twin) =
        (Worst::default(), Worst::default(), Worst::default());
    for x in log_spaced(0.5, 2.0, 800_000) {
        let truth = f64::from(x).log2();
        let value = f64::from(single.exp_log_log2(x));
        absolute.add((value - truth).abs(), x.into());
        if truth == 0.0 {
            assert_eq!(value, 0.0);
        } else {
            relative.add((value / truth - 1.0).abs(), x.into());
        }
        twin.add((double.exp_log_log2(x.into()) - truth).abs(), x.into());
    }
    absolute.check("log2", 1.25e-7);
    relative.check("log2, relative", 2.6e-7);
    twin.check("log2 in double precision", 8e-8);
    let mut far = Worst::default();
    for x in log_spaced(1.2e-38, 3e38, 200_000) {
        let truth = f64::from(x).log2();
        far.add((f64::from(single.exp_log_log2(x)) - truth).abs() / truth.abs().max(1.0), x.into());
    }
    far.check("log2 of any number", 1.8e-7);
}

#[test]
fn powers_and_cube_roots() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    for (low, y, bound) in [(0.05, 6.0_f32, 1.8e-6), (0.96, 400.0, 3.6e-6), (1e-6, 1.0, 2.5e-6)] {
        let mut worst = Worst::default();
        for x in log_spaced(low, 1.0, 300_000) {
            let truth = f64::from(x).powf(y.into());
            worst.add((f64::from(single.exp_log_pow(x, y)) / truth - 1.0).abs(), x.into());
        }
        worst.check("pow", bound);
    }
    let (mut root, mut twin) = (Worst::default(), Worst::default());
    for i in 1..500_000_u32 {
        // 24-bit fractions, the smallest first.
        let x = (i.min(1000) + i.saturating_sub(1000) * 33) as f32 * 2.0_f32.powi(-24);
        let truth = f64::from(x).cbrt();
        root.add((f64::from(single.exp_log_cbrt(x)) / truth - 1.0).abs(), x.into());
        twin.add((double.exp_log_cbrt(x.into()) / truth - 1.0).abs(), x.into());
    }
    root.check("cbrt", 4.8e-7);
    twin.check("cbrt in double precision", 2e-7);
    assert_eq!(single.exp_log_cbrt(0.0), single.exp_log_cbrt(2.0_f32.powi(-24)));
    assert_eq!((single.exp_log_pow(0.0, 0.0), single.exp_log_pow(1.0, 1e6)), (0.0, 1.0));
}

#[test]
fn angles_in_turns() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let (mut value, mut twin) = (Worst::default(), Worst::default());
    let mut stream = Stream::new(11, 0);
    let edges = [0.0, -0.0, 1.0, -1.0, 1e-30, -1e-30, 1e30, 0.5, -0.5];
    let pairs = edges.into_iter().flat_map(|y| edges.into_iter().map(move |x| (y, x)));
    let random = (0..400_000).map(|_| {
        let length = 10.0_f64.powf(stream.between(-6.0, 6.0));
        let angle = stream.between(0.0, TAU);
        ((length * angle.sin()) as f32, (length * angle.cos()) as f32)
    });
    for (y, x) in pairs.chain(random) {
        if x == 0.0 && y == 0.0 {
            assert_eq!(single.atan_turns(y, x), 0.0);
            continue;
        }
        let truth = f64::from(y).atan2(x.into()) / TAU;
        // Half a turn is the same either way round.
        let off = |turns: f64| {
            let d = (turns - truth).abs();
            d.min((d - 1.0).abs())
        };
        value.add(off(single.atan_turns(y, x).into()), truth);
        twin.add(off(double.atan_turns(y.into(), x.into())), truth);
    }
    value.check("atan_turns", 6e-8);
    twin.check("atan_turns in double precision", 2.7e-8);
}

/// binary16 by its definition.
fn half(bits: u32) -> f64 {
    let (e, m) = ((bits >> 10) & 31, f64::from(bits & 1023));
    let value = if e == 0 {
        m * 2.0_f64.powi(-24)
    } else {
        (1.0 + m / 1024.0) * 2.0_f64.powi(i32::try_from(e).expect("5 bits") - 15)
    };
    if bits & 0x8000 == 0 { value } else { -value }
}

#[test]
fn half_floats_are_decoded_exactly() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for bits in 0..=0xffff_u32 {
        let value = kernel.half_decode(bits | 0xabcd_0000);
        if bits & 0x7c00 == 0x7c00 {
            // What a checked pack does not contain is finite all the same.
            assert!(value.is_finite());
        } else {
            assert_eq!(f64::from(value).to_bits(), half(bits).to_bits(), "{bits:#x}");
        }
    }
}

/// The word of `v` as the format says, rounded to nearest.
fn octahedral_encode(v: DVec3) -> u32 {
    let v = v / (v.x.abs() + v.y.abs() + v.z.abs());
    let (mut x, mut y) = (v.x, v.y);
    if v.z < 0.0 {
        (x, y) = ((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y));
    }
    let word = |t: f64| (t * 32767.0).round() as i32 as u32 & 0xffff;
    word(x) | word(y) << 16
}

#[test]
fn packed_normals() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let (mut angle, mut length, mut twin) = (Worst::default(), Worst::default(), Worst::default());
    let mut stream = Stream::new(13, 0);
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let signs = axes.into_iter().flat_map(|a| [a, -a]);
    for n in signs.chain((0..300_000).map(|_| stream.direction())) {
        let word = octahedral_encode(n);
        let v = single.octahedral_decode(word).as_dvec3();
        angle.add((v - n).length(), n.z);
        length.add((v.length() - 1.0).abs(), n.z);
        twin.add((double.octahedral_decode(word) - v).length(), n.z);
    }
    // Half a step of 1/32767 along x and y, their sum along z, stretched by sqrt(3) by normalisation.
    angle.check("octahedral_decode", 6.5e-5);
    length.check("octahedral length", 1.5e-7);
    twin.check("octahedral in both precisions", 3e-7);
    for word in [0x8000, 0x8000_0000, 0x8000_8000, 0x7fff_8000, 0] {
        let v = single.octahedral_decode(word);
        assert!((v.length() - 1.0).abs() < 2e-7, "{word:#x}: {v}");
    }
    assert_eq!(single.octahedral_decode(0x8000), single.octahedral_decode(0x8001));
}

#[test]
fn frames_are_orthonormal_everywhere() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let (mut worst, mut twin) = (Worst::default(), Worst::default());
    let mut stream = Stream::new(17, 0);
    let near_pole = |stream: &mut Stream| {
        let r = 10.0_f64.powf(stream.between(-9.0, 0.0));
        let phi = stream.between(0.0, TAU);
        let up = if stream.unit() < 0.5 { -1.0 } else { 1.0 };
        DVec3::new(r * phi.cos(), r * phi.sin(), up).normalize()
    };
    for i in 0..400_000 {
        let n = match i {
            0 => DVec3::NEG_Z,
            1 => DVec3::Z,
            2 => DVec3::new(1.0, 0.0, -0.0),
            _ if i % 2 == 0 => stream.direction(),
            _ => near_pole(&mut stream),
        };
        let basis = single.basis_around(n.as_vec3());
        let [t, b, m] = [basis.t, basis.b, basis.n].map(Vec3::as_dvec3);
        worst.add(frame_error(t, b, m), n.z);
        let basis = double.basis_around(n);
        twin.add(frame_error(basis.t, basis.b, basis.n), n.z);
        let v = stream.direction().as_vec3();
        let basis = single.basis_around(n.as_vec3());
        let local = single.basis_local_from_world(basis, v);
        let back = single.basis_world_from_local(basis, local);
        assert!((back - v).length() < 1e-6, "{n}: {v} comes back as {back}");
    }
    // 2.2e-7 for the frame itself; the rest is the rounding of `n`.
    worst.check("basis", 3.5e-7);
    twin.check("basis in double precision", 1e-15);
}

/// Largest entry of F^T F - 1, and of t x b - n.
fn frame_error(t: DVec3, b: DVec3, n: DVec3) -> f64 {
    let lengths = [t, b, n].map(|v| (v.length_squared() - 1.0).abs());
    let angles = [t.dot(b), b.dot(n), n.dot(t)].map(f64::abs);
    let turn = (t.cross(b) - n).length();
    lengths.into_iter().chain(angles).fold(turn, f64::max)
}

#[test]
fn unit_vectors_of_any_length() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(19, 0);
    let mut worst = Worst::default();
    for _ in 0..100_000 {
        let d = stream.direction();
        let scale = 10.0_f64.powf(stream.between(-36.0, 38.0));
        let unit = kernel.vector_unit_or((d * scale).as_vec3(), Vec3::X).as_dvec3();
        worst.add((unit - d).length(), scale);
    }
    worst.check("vector_unit_or", 3e-7);
    assert_eq!(kernel.vector_unit_or(Vec3::ZERO, Vec3::Y), Vec3::Y);
    assert_eq!(kernel.vector_unit_or(Vec3::splat(1e-40), Vec3::Y), Vec3::Y);
    let (a, b) = (Vec3::new(1.0, 2.0, 3.0), Vec3::new(-4.0, 5.0, 0.5));
    assert_eq!(kernel.vector_cross(a, b), a.cross(b));
}
