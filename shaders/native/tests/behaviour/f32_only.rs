//! What holds of the f32 kernel alone: its results are those of plain f32 arithmetic.

use crate::kernels::{floats, vectors};
use glam::Vec3;

fn floats() -> floats::Kernel<'static> {
    floats::Kernel::new(floats::Bindings { unused: core::marker::PhantomData })
}

fn vectors() -> vectors::Kernel<'static> {
    vectors::Kernel::new(vectors::Bindings { unused: core::marker::PhantomData })
}

/// A fixed sequence of floats in -4..4.
fn numbers() -> impl Iterator<Item = f32> {
    let mut state = 1_u32;
    std::iter::repeat_with(move || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (state >> 8) as f32 / 2_097_152.0 - 4.0
    })
}

#[test]
fn polynomials_have_the_bits_of_plain_arithmetic() {
    let mut k = floats();
    for x in numbers().take(1000) {
        let wanted = ((0.2_f32 * x + 0.3) * x - 0.4) * x + 0.5;
        assert_eq!(k.polynomial(x).to_bits(), wanted.to_bits());
        assert_eq!(k.pi_times(x).to_bits(), (x * std::f32::consts::PI).to_bits());
    }
}

#[test]
fn products_have_the_bits_of_the_written_order() {
    let mut k = vectors();
    let mut next = numbers();
    for _ in 0..1000 {
        let [a, b] = [(); 2].map(|()| Vec3::from_array([(); 3].map(|()| next.next().unwrap())));
        let dot = |a: Vec3, b: Vec3| a.x * b.x + a.y * b.y + a.z * b.z;
        assert_eq!(k.dot3(a, b).to_bits(), dot(a, b).to_bits());
        assert_eq!(k.length3(a).to_bits(), dot(a, a).sqrt().to_bits());
        let cross = Vec3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
        assert_eq!(k.cross3(a, b).to_array().map(f32::to_bits), cross.to_array().map(f32::to_bits));
    }
}

#[test]
fn constants_are_rounded_once() {
    let mut k = floats();
    assert_eq!(k.inv_pi().to_bits(), std::f32::consts::FRAC_1_PI.to_bits());
    assert_eq!(k.long_decimal().to_bits(), 0.123_456_79_f32.to_bits());
    assert_eq!(k.largest().to_bits(), f32::MAX.to_bits());
}
