//! What holds of the f64 twin alone: decimals survive as typed, and nothing is cut to f32 but bits.

use crate::kernels::{floats, integers, memory, vectors};
use glam::DVec3;

fn floats() -> floats::Kernel<'static> {
    floats::Kernel::new(floats::Bindings { unused: core::marker::PhantomData })
}

fn is_close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-14 * b.abs()
}

#[test]
fn typed_decimals_survive() {
    let mut k = floats();
    assert!(is_close(k.tenth(), 0.1));
    assert!(is_close(k.long_decimal(), 0.123_456_789_012_345));
    assert!(is_close(k.pi_times(2.0), 2.0 * std::f64::consts::PI));
    assert!(is_close(k.inv_pi(), std::f64::consts::FRAC_1_PI));
    assert!(is_close(k.third(3.0), 1.0));
    assert!(is_close(k.folded(), 2.0 * std::f64::consts::PI - 0.1));
    assert!(is_close(k.suffixed(), 0.3 + 1e-7));
    assert!(is_close(k.overridden(1.0), 2.2));
}

#[test]
fn arithmetic_is_double() {
    let mut k = floats();
    assert!(is_close(k.root(2.0), std::f64::consts::SQRT_2));
    assert!(is_close(k.polynomial(1e-9), ((0.2e-9 + 0.3) * 1e-9 - 0.4) * 1e-9 + 0.5));
    let mut k = vectors::Kernel::new(vectors::Bindings { unused: core::marker::PhantomData });
    let long = k.length3(DVec3::new(1.0, 1e-7, 0.0));
    assert!(is_close(long, (1.0 + 1e-14_f64).sqrt()));
}

#[test]
fn bits_round_to_f32_and_back() {
    let mut k = integers::Kernel::new(integers::Bindings { unused: core::marker::PhantomData });
    assert_eq!(k.to_bits(1.0 + 1e-12), 1.0_f32.to_bits());
    let bits = k.to_bits(std::f64::consts::PI);
    assert!(is_close(k.from_bits(bits), f64::from(std::f32::consts::PI)));
}

#[test]
fn structs_hold_doubles() {
    let leaf = memory::Leaf { weight: 0.1_f64, count: 1 };
    assert!(is_close(leaf.weight, 0.1));
}
