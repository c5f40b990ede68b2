//! The scalar rules, checked where they are plain Rust, in both precisions.

#![allow(clippy::float_cmp, reason = "these results are exact")]

use super::double::rules as wide;
use super::single::rules;

#[test]
fn every_half_survives_a_round_trip() {
    for bits in 0..=0xffff_u32 {
        let value = rules::f16_to(bits);
        let back = rules::f16_from(value);
        assert!(back == bits || (value.is_nan() && back & 0x7fff == 0x7e00), "{bits:#x} {back:#x}");
    }
}

#[test]
fn halves_round_to_nearest_even() {
    for bits in 0..0x7bff_u32 {
        let (low, high) = (rules::f16_to(bits), rules::f16_to(bits + 1));
        let middle = low.midpoint(high);
        let even = bits + (bits & 1);
        assert_eq!(rules::f16_from(middle), even, "half-way above {bits:#x}");
        assert_eq!(rules::f16_from(middle.next_down()), bits);
        assert_eq!(rules::f16_from(middle.next_up()), bits + 1);
    }
    assert_eq!(rules::f16_from(65_519.99), 0x7bff);
    assert_eq!(rules::f16_from(65_520.0), 0x7c00);
    assert_eq!(rules::f16_from(-1e30), 0xfc00);
}

#[test]
fn frexp_and_ldexp_are_inverse() {
    for x in [1.0_f32, -0.75, 3.5e-40, 1e38, f32::MIN_POSITIVE, -2.0, 0.0] {
        let (fraction, exponent) = rules::frexp(x);
        assert!(x == 0.0 || (0.5..1.0).contains(&fraction.abs()), "{x}: {fraction}");
        assert_eq!(rules::ldexp(fraction, exponent), x);
        assert_eq!(wide::ldexp(wide::frexp(f64::from(x)).0, exponent), f64::from(x));
    }
    assert_eq!(wide::frexp(5e-324), (0.5, -1073));
    assert_eq!(rules::ldexp(1.0, 5000), f32::INFINITY);
    assert_eq!(rules::ldexp(1.0, -5000), 0.0);
}

#[test]
fn nothing_panics_at_the_edges() {
    let floats = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e30, -1e30, 1e-45];
    for x in floats {
        for y in floats {
            let _ = (rules::min(x, y), rules::max(x, y), rules::clamp(x, y, x), rules::rem(x, y));
            let _ = (rules::step(x, y), rules::smoothstep(x, y, x), rules::ldexp(x, i32::MIN));
            let _ = (rules::pack_snorm(x, 127.0), rules::pack_unorm(x, 65535.0));
        }
        let _ = (rules::frexp(x), rules::to_u32(x), rules::to_i32(x), rules::quantize_f16(x));
    }
    for offset in [0, 1, 31, 32, u32::MAX] {
        for count in [0, 1, 31, 32, u32::MAX] {
            let _ = rules::extract_u32(u32::MAX, offset, count);
            let _ = rules::extract_i32(i32::MIN, offset, count);
            let _ = rules::insert_u32(u32::MAX, 0, offset, count);
        }
    }
}
