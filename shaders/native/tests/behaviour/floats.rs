//! Floats: rounding, built-ins, literals.

use crate::kernels::floats::{Bindings, Kernel, Real, Vec2, Vec3, Vec4};

fn kernel() -> Kernel<'static> {
    Kernel::new(Bindings { unused: core::marker::PhantomData })
}

fn is_near(a: Real, b: Real) -> bool {
    (a - b).abs() <= 1e-6 * b.abs().max(1.0)
}

#[test]
fn rounding_goes_where_wgsl_says() {
    let mut k = kernel();
    assert_eq!(k.floor_ceil(-1.5).to_array(), [-2.0, -1.0]);
    let inputs = [0.5, 1.5, 2.5, -0.5, -2.5, 2.4, -2.6];
    assert_eq!(inputs.map(|x| k.rounded(x)), [0.0, 2.0, 2.0, 0.0, -2.0, 2.0, -3.0]);
    assert_eq!([k.truncated(1.9), k.truncated(-1.9)], [1.0, -1.0]);
    assert_eq!([k.fraction(1.25), k.fraction(-1.25), k.fraction(-2.0)], [0.25, 0.75, 0.0]);
    assert_eq!([-2.0, 0.0, 3.0].map(|x| k.sign_f(x)), [-1.0, 0.0, 1.0]);
}

#[test]
fn limits_compare_directly() {
    let mut k = kernel();
    assert_eq!([k.smaller(1.0, 2.0), k.smaller(2.0, 1.0)], [1.0, 1.0]);
    let larger = k.larger(Vec3::new(1.0, 5.0, -1.0), Vec3::new(2.0, 4.0, -2.0));
    assert_eq!(larger.to_array(), [2.0, 5.0, -1.0]);
    assert_eq!([-9.0, 0.5, 9.0].map(|x| k.clamped(x)), [-1.5, 0.5, 2.5]);
    assert_eq!(k.clamped(Real::NAN), -1.5);
    assert_eq!(k.saturated(Vec2::new(-1.0, 1.5)).to_array(), [0.0, 1.0]);
    assert_eq!(k.absolute(Vec4::new(-1.0, 2.0, -0.0, 3.0)).to_array(), [1.0, 2.0, 0.0, 3.0]);
}

#[test]
fn roots_and_ramps() {
    let mut k = kernel();
    assert_eq!([k.root(9.0), k.inverse_root(4.0)], [3.0, 0.5]);
    assert_eq!([k.stepped(1.0, 0.5), k.stepped(1.0, 1.0)], [0.0, 1.0]);
    assert_eq!([0.0, 2.0, 4.0].map(|x| k.smooth_ramp(x)), [0.0, 0.5, 1.0]);
    assert_eq!(k.mixed(Vec2::new(1.0, 2.0), Vec2::new(3.0, 6.0), 0.25).to_array(), [1.5, 3.0]);
    assert_eq!(k.fused(2.0, 3.0, 4.0), 10.0);
}

#[test]
fn transcendental_functions_are_themselves() {
    let mut k = kernel();
    for x in [0.25, 0.5, 0.75] {
        let waves = k.waves(x);
        assert!(
            is_near(waves.x, x.sin()) && is_near(waves.y, x.cos()) && is_near(waves.z, x.tan())
        );
        let arcs = k.arcs(x);
        assert!(is_near(arcs.x, x.asin()) && is_near(arcs.y, x.acos()));
        assert!(is_near(arcs.z, x.atan()) && is_near(arcs.w, x.atan2(2.0)));
        let growth = k.growth(x);
        assert!(is_near(growth.x, x.exp()) && is_near(growth.y, x.exp2()));
        assert!(is_near(growth.z, x.ln()) && is_near(growth.w, x.log2()));
        assert!(is_near(k.power(x, 1.5), x.powf(1.5)));
        let angles = k.angles(x);
        assert!(is_near(angles.x, x.to_radians()) && is_near(angles.y, x.to_degrees()));
    }
}

#[test]
fn floats_come_apart() {
    let mut k = kernel();
    assert_eq!([k.scaled(1.5, 4), k.scaled(1.5, -1)], [24.0, 0.75]);
    assert_eq!(k.parts(-2.75).to_array(), [-0.75, -2.0]);
    assert_eq!((k.mantissa(-12.0), k.exponent(-12.0)), (-0.75, 4));
    assert_eq!(k.halved(1.0 + 1.0 / 4096.0), 1.0);
}

#[test]
fn literals_read_as_typed() {
    let mut k = kernel();
    assert_eq!([k.tenth(), k.negative(), k.whole_number(), k.hexadecimal()], [0.1, -0.7, 3.0, 3.0]);
    assert_eq!(k.constant_vector().to_array(), [0.1, 0.7, 1e-3]);
    assert!(is_near(k.suffixed(), 0.3 + 1e-7) && is_near(k.overridden(2.0), 4.4));
    assert!(is_near(k.polynomial(2.0), ((0.2 * 2.0 + 0.3) * 2.0 - 0.4) * 2.0 + 0.5));
    assert!(k.largest().is_finite());
}
