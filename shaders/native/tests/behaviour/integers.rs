//! Integers, bits and conversions.

use crate::kernels::integers::{Bindings, Kernel, Real, Vec2, Vec3, Vec4};
use glam::{BVec3, IVec2, IVec3, IVec4, UVec2, UVec3, UVec4};

fn kernel() -> Kernel<'static> {
    Kernel::new(Bindings { unused: core::marker::PhantomData })
}

#[test]
fn arithmetic_wraps() {
    let mut k = kernel();
    assert_eq!(k.add(u32::MAX, 2), 1);
    assert_eq!(k.sub(1, 3), u32::MAX - 1);
    assert_eq!(k.mul(i32::MAX, 2), -2);
    assert_eq!([k.neg(5), k.neg(i32::MIN)], [-5, i32::MIN]);
    assert_eq!([k.abs_i(-5), k.abs_i(i32::MIN)], [5, i32::MIN]);
    assert_eq!(k.mul_v(UVec3::new(1, 2, u32::MAX), 2), UVec3::new(3, 5, u32::MAX));
    assert_eq!(k.sub_v(1, UVec3::new(0, 1, 2)), UVec3::new(1, 0, u32::MAX));
    assert_eq!(k.neg_v(IVec2::new(i32::MIN, 3)), IVec2::new(i32::MIN, -3));
    assert_eq!(k.dot_u(UVec3::new(1 << 31, 1, 2), UVec3::new(2, 3, 4)), 11);
    assert_eq!(k.most_negative(), i32::MIN);
}

#[test]
fn quotients_by_zero_and_overflow_follow_wgsl() {
    let mut k = kernel();
    assert_eq!([k.div_u(7, 2), k.div_u(7, 0)], [3, 7]);
    assert_eq!([k.rem_u(7, 2), k.rem_u(7, 0)], [1, 0]);
    assert_eq!([k.div_i(-7, 2), k.div_i(-7, 0), k.div_i(i32::MIN, -1)], [-3, -7, i32::MIN]);
    assert_eq!([k.rem_i(-7, 2), k.rem_i(-7, 0), k.rem_i(i32::MIN, -1)], [-1, 0, 0]);
    let quotient = k.div_v(IVec3::new(-9, 5, i32::MIN), IVec3::new(2, 0, -1));
    assert_eq!(quotient, IVec3::new(-4, 5, i32::MIN));
    assert_eq!(k.rem_v(UVec2::new(9, 5), UVec2::new(4, 0)), UVec2::new(1, 0));
}

#[test]
fn shift_counts_are_taken_modulo_the_width() {
    let mut k = kernel();
    assert_eq!([k.shl(1, 31), k.shl(1, 32), k.shl(1, 33)], [1 << 31, 1, 2]);
    assert_eq!([k.shr(8, 3), k.shr(8, 35), k.shr(8, u32::MAX)], [1, 1, 0]);
    assert_eq!([k.shr_i(-8, 1), k.shr_i(-8, 33), k.shr_i(-8, 31)], [-4, -4, -1]);
    assert_eq!(k.shl_v(UVec2::new(1, 3), UVec2::new(34, 1)), UVec2::new(4, 6));
}

#[test]
fn masks_and_limits() {
    let mut k = kernel();
    let wanted = (0b1100 & 0b1010) | (0b1100 ^ !0b1010_u32);
    assert_eq!(k.masks(0b1100, 0b1010), wanted);
    assert_eq!(k.masks_v(UVec4::splat(0b1100), UVec4::splat(0b1010)), UVec4::splat(wanted));
    assert_eq!([-100, -7, 0, 9, 10].map(|a| k.limits(a)), [-7, -7, 0, 9, 9]);
    assert_eq!(k.clamp_crossed(4), 3);
    assert_eq!([-9, 0, 9].map(|a| k.sign_i(a)), [-1, 0, 1]);
}

#[test]
fn floats_saturate_to_integers() {
    let mut k = kernel();
    let inputs = [1.9, -1.9, -0.5, 0.0, 5e9, -5e9, Real::NAN, Real::INFINITY, Real::NEG_INFINITY];
    // The largest integers are those that f32 holds too.
    assert_eq!(inputs.map(|x| k.to_u32(x)), [1, 0, 0, 0, 4_294_967_040, 0, 0, 4_294_967_040, 0]);
    let (high, low) = (2_147_483_520, i32::MIN);
    assert_eq!(inputs.map(|x| k.to_i32(x)), [1, -1, 0, 0, high, low, 0, high, low]);
    assert_eq!(k.to_u32_v(Vec3::new(3.5, -1.0, 7.0)), UVec3::new(3, 0, 7));
}

#[test]
fn integers_and_booleans_convert() {
    let mut k = kernel();
    assert_eq!([k.from_u32(3), k.from_u32(1 << 31)], [3.0, 2_147_483_648.0]);
    assert_eq!(k.from_i32(IVec2::new(-3, 4)).to_array(), [-3.0, 4.0]);
    assert_eq!(k.from_bool(true).to_array(), [1.0; 3]);
    assert_eq!(k.from_bool(false).to_array(), [0.0; 3]);
    assert_eq!(k.to_bool(0.5, 0, -1), BVec3::new(true, false, true));
    assert_eq!(k.sign_change(u32::MAX), -2);
}

#[test]
fn bits_are_those_of_f32() {
    let mut k = kernel();
    assert_eq!(k.to_bits(1.0), 0x3f80_0000);
    assert_eq!(k.to_bits(0.1), 0.1_f32.to_bits());
    assert_eq!(k.to_bits_i(Vec2::new(-2.0, 0.0)), IVec2::new(0xc000_0000_u32 as i32, 0));
    assert_eq!(k.from_bits(0.1_f32.to_bits()), Real::from(0.1_f32));
    assert_eq!(k.from_bits_i(0x4000_0000), 2.0);
    let four = k.from_bits_v(UVec4::new(0, 0x3f80_0000, 0x4000_0000, 0xbf80_0000));
    assert_eq!(four.to_array(), [0.0, 1.0, 2.0, -1.0]);
    assert_eq!(k.infinity(), Real::INFINITY);
    assert_eq!(k.words_to_ints(UVec3::new(u32::MAX, 1, 0)), IVec3::new(-1, 1, 0));
}

#[test]
fn bit_counts() {
    let mut k = kernel();
    assert_eq!(k.reverse(0b1011), 0b1101 << 28);
    assert_eq!((k.ones(0xf0f0), k.ones_i(-1)), (8, 32));
    assert_eq!([k.leading(0), k.leading(1), k.leading(u32::MAX)], [32, 31, 0]);
    assert_eq!(k.trailing(UVec2::new(0, 8)), UVec2::new(32, 3));
    assert_eq!([0, 1, 0x8000_0001].map(|x| k.first_leading(x)), [u32::MAX, 0, 31]);
    assert_eq!([0, -1, 1, -2, i32::MIN].map(|x| k.first_leading_i(x)), [-1, -1, 0, 0, 30]);
    assert_eq!([0, 8, u32::MAX].map(|x| k.first_trailing(x)), [u32::MAX, 3, 0]);
}

#[test]
fn bit_fields_are_cut_to_the_width() {
    let mut k = kernel();
    assert_eq!(k.extract(0xabcd_1234, 4, 8), 0x23);
    assert_eq!([k.extract(u32::MAX, 0, 0), k.extract(u32::MAX, 40, 4)], [0, 0]);
    assert_eq!([k.extract(u32::MAX, 30, 9), k.extract(u32::MAX, 0, 99)], [3, u32::MAX]);
    assert_eq!([k.extract_i(0x0f00, 8, 4), k.extract_i(0x0f00, 8, 5)], [-1, 15]);
    assert_eq!(k.extract_v(UVec2::new(0xf0, 0x30), 4, 4), UVec2::new(15, 3));
    assert_eq!(k.insert(0xffff_ffff, 0, 8, 8), 0xffff_00ff);
    assert_eq!(
        [k.insert(1, 9, 0, 0), k.insert(0, 7, 31, 9), k.insert(1, 7, 32, 1)],
        [1, 1 << 31, 1]
    );
}

#[test]
fn pcg4d_matches_its_definition() {
    let mut v = [1_u32, 2, 3, 4].map(|x| x.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let mut mix = |after: bool| {
        for (a, b, c) in [(0, 1, 3), (1, 2, 0), (2, 0, 1), (3, 1, 2)] {
            v[a] = v[a].wrapping_add(v[b].wrapping_mul(v[c]));
        }
        if !after {
            v = v.map(|x| x ^ (x >> 16));
        }
    };
    mix(false);
    mix(true);
    assert_eq!(kernel().pcg4d(UVec4::new(1, 2, 3, 4)).to_array(), v);
}

#[test]
fn words_pack_and_unpack() {
    let mut k = kernel();
    assert_eq!(k.pack_half(Vec2::new(1.0, -2.0)), 0xc000_3c00);
    assert_eq!(k.unpack_half(0xc000_3c00).to_array(), [1.0, -2.0]);
    assert_eq!(k.unpack_half(0x3555_7bff).to_array(), [65504.0, Real::from(0.333_251_95_f32)]);
    assert_eq!(k.pack_snorm2(Vec2::new(-1.0, 1.0)), 0x7fff_8001);
    assert_eq!(k.unpack_snorm2(0x7fff_8000).to_array(), [-1.0, 1.0]);
    assert_eq!(k.pack_unorm2(Vec2::new(2.0, 0.0)), 0x0000_ffff);
    assert_eq!(k.unpack_unorm2(0xffff_0000).to_array(), [0.0, 1.0]);
    assert_eq!(k.pack_snorm4(Vec4::new(-1.0, 0.0, 1.0, -3.0)), 0x817f_0081);
    assert_eq!(k.unpack_snorm4(0x817f_0080).to_array(), [-1.0, 0.0, 1.0, -1.0]);
    assert_eq!(k.pack_unorm4(Vec4::new(0.0, 1.0, 0.2, 9.0)), 0xff33_ff00);
    assert_eq!(k.unpack_unorm4(0xff00_ff00).to_array(), [0.0, 1.0, 0.0, 1.0]);
    assert_eq!(k.bytes(0xff80_0201), UVec4::new(1, 2, 0x80, 0xff));
    assert_eq!(k.bytes_i(0xff80_0201), IVec4::new(1, 2, -128, -1));
    assert_eq!(k.join(UVec4::new(1, 2, 0x1ff, 4)), 0x04ff_0201);
    assert_eq!(k.join_clamped(IVec4::new(1, -1, 300, -300)), 0x807f_ff01);
    assert_eq!(k.packed_dot(0xff01_0203, 0x0201_0101), -2 + 1 + 2 + 3);
}
