//! Waves of water.

use glam::{DVec2, DVec3, Vec2, Vec3};
use pack::abi::{Material, MaterialKind};
use tests::kernel::{Bench, Lobe};
use tests::statistics::stream::Stream;

use crate::Worst;

fn bench(scale: f32, height: f32) -> Bench {
    let water = Material { pattern_scale: scale, bump_height: height, ..Material::default() };
    Bench::new().materials(&[water])
}

/// The three trains of waves in radians, in double precision.
fn slope(p: DVec2) -> DVec2 {
    let (x, z) = (p.x, p.y);
    let low = (3.7 * x + 2.3 * z).sin() * (4.1 * z - 1.7 * x).cos() * 0.022;
    let middle = (7.1 * x + 5.3 * z + 0.7).sin() * (8.2 * z - 3.9 * x + 1.1).cos() * 0.009;
    let high = (13.4 * x + 9.7 * z + 1.3).sin() * (11.8 * z - 7.2 * x + 0.4).cos() * 0.003;
    DVec2::new(low + middle + high, 0.7 * low + 0.8 * middle + 0.9 * high)
}

#[test]
fn waves_are_the_sines_that_they_should_be() {
    let bench = bench(1.0, 1.0);
    let (mut single, mut double) = (bench.single(), bench.double());
    let (mut worst, mut twin) = (Worst::default(), Worst::default());
    let mut stream = Stream::new(41, 0);
    for _ in 0..100_000 {
        let p = Vec2::new(stream.between(-30.0, 30.0) as f32, stream.between(-30.0, 30.0) as f32);
        let truth = slope(p.as_dvec2());
        worst.add((single.water_slope(p).as_dvec2() - truth).length(), p.x.into());
        twin.add((double.water_slope(p.as_dvec2()) - truth).length(), p.x.into());
    }
    // The phases of the shortest waves reach 700 radians, which single precision holds to 4e-5.
    worst.check("water_slope", 2e-6);
    // The numbers of turns have eight digits.
    twin.check("water_slope in double precision", 2e-6);
}

#[test]
fn normals_are_unit_and_reflection_stays_above_the_surface_anywhere() {
    let bench = bench(400.0, 20.0);
    let mut kernel = bench.single();
    let mut stream = Stream::new(43, 0);
    for i in 0..200_000 {
        let reach = [1.0, 1e3, 1e5][i % 3];
        let mut lobe = Lobe { ior: 1.333, ..Lobe::new(MaterialKind::Water) };
        lobe.place = stream.direction() * reach;
        lobe.front = i % 2 == 0;
        let tilt = DVec3::new(stream.between(-0.6, 0.6), 1.0, stream.between(-0.6, 0.6));
        lobe.normal = tilt.normalize().as_vec3().as_dvec3();
        if !lobe.front {
            lobe.normal = -lobe.normal;
        }
        let s = lobe.single();
        let d = stream.direction();
        let wo = if d.dot(lobe.normal) > 0.0 { d } else { -d }.as_vec3();
        let n = kernel.water_normal(s, wo);
        assert!((n.length() - 1.0).abs() < 1e-6, "{lobe:?}: {n}");
        assert!(n.dot(wo) >= 0.0 && n.dot(s.ng) > 0.0, "{lobe:?}: {n}");
        for u in [0.0, 1.0 - 2.0_f32.powi(-24)] {
            let out = kernel.water_sample(s, wo, u);
            let side = out.wi.dot(s.ng);
            let reflected = (out.eta2 - 1.0).abs() < 1e-6;
            assert!((out.wi.length() - 1.0).abs() < 1e-6, "{lobe:?}: {}", out.wi);
            assert!(if reflected { side > 0.0 } else { side < 0.0 }, "{lobe:?}: {} {u}", out.wi);
            assert!(out.weight.is_finite() && out.weight.min_element() > 0.0);
        }
    }
}

#[test]
fn sides_and_flat_water_have_no_waves() {
    let still = bench(1.0, 0.0);
    let mut kernel = still.single();
    let mut lobe = Lobe::new(MaterialKind::Water);
    lobe.normal = DVec3::Y;
    let wo = Vec3::new(0.6, 0.8, 0.0);
    assert_eq!(kernel.water_normal(lobe.single(), wo), Vec3::Y);
    let waved = bench(1.0, 1.0);
    let mut kernel = waved.single();
    assert_ne!(kernel.water_normal(lobe.single(), wo), Vec3::Y);
    lobe.normal = DVec3::X;
    assert_eq!(kernel.water_normal(lobe.single(), wo), Vec3::X);
}
