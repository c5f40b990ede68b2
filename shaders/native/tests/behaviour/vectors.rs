//! Vectors and matrices.

use crate::kernels::vectors::{Bindings, Kernel, Mat2, Mat3, Mat4, Real, Vec2, Vec3, Vec4};
use glam::{BVec2, BVec3, BVec4, IVec2, IVec4, UVec2, UVec3, UVec4};

fn kernel() -> Kernel<'static> {
    Kernel::new(Bindings { unused: core::marker::PhantomData })
}

const ABC: Vec3 = Vec3::new(1.0, 2.0, 3.0);
const ABCD: Vec4 = Vec4::new(1.0, 2.0, 3.0, 4.0);

#[test]
fn swizzles_of_any_order() {
    let mut k = kernel();
    assert_eq!(k.zxy(ABC).to_array(), [3.0, 1.0, 2.0]);
    assert_eq!(k.xxz(ABC).to_array(), [1.0, 1.0, 3.0]);
    assert_eq!(k.wzyx(ABCD).to_array(), [4.0, 3.0, 2.0, 1.0]);
    assert_eq!(k.yzw(UVec4::new(1, 2, 3, 4)), UVec3::new(2, 3, 4));
    assert_eq!(k.zw(IVec4::new(1, 2, 3, 4)), IVec2::new(3, 4));
    assert_eq!(k.yy(BVec2::new(true, false)), BVec4::new(false, false, true, true));
    assert_eq!(k.chained(ABCD).to_array(), [4.0, 3.0]);
    assert_eq!(k.of_sum(ABCD).to_array(), [5.0, 5.0]);
    assert_eq!(k.constant_swizzle().to_array(), [0.3, 0.2, 0.1]);
}

#[test]
fn vectors_are_put_together_from_parts() {
    let mut k = kernel();
    assert_eq!(k.composed(Vec2::new(1.0, 2.0), 3.0).to_array(), [3.0, 1.0, 2.0, 3.0]);
    assert_eq!(k.from_pairs(UVec2::new(1, 2), UVec2::new(3, 4)), UVec4::new(2, 1, 3, 4));
    assert_eq!(k.splat(2.5).to_array(), [2.5; 3]);
}

#[test]
fn select_takes_false_then_true() {
    let mut k = kernel();
    assert_eq!([k.select_scalar(1.0, 2.0, false), k.select_scalar(1.0, 2.0, true)], [1.0, 2.0]);
    assert_eq!(k.select_whole(ABC, -ABC, true), -ABC);
    assert_eq!(k.select_whole(ABC, -ABC, false), ABC);
    let mask = BVec3::new(true, false, true);
    assert_eq!(k.select_lanes(ABC, -ABC, mask).to_array(), [-1.0, 2.0, -3.0]);
    let least = k.select_less(UVec4::new(1, 9, 3, 9), UVec4::new(2, 8, 2, 9));
    assert_eq!(least, UVec4::new(1, 8, 2, 9));
}

#[test]
fn comparisons_are_lane_by_lane() {
    let mut k = kernel();
    assert_eq!(k.less(ABC, Vec3::new(2.0, 2.0, 4.0)), BVec3::new(true, false, true));
    let nan = Vec4::new(1.0, Real::NAN, -0.0, 4.0);
    assert_eq!(
        k.equal(nan, Vec4::new(1.0, Real::NAN, 0.0, 5.0)),
        BVec4::new(true, false, true, false)
    );
    assert_eq!(k.any_all(BVec3::new(true, true, true)), 1 + 2 + 4);
    assert_eq!(k.any_all(BVec3::new(false, true, false)), 1);
    assert_eq!(k.any_all(BVec3::FALSE), 8);
    let bools = k.bools(BVec2::new(true, true), BVec2::new(true, false));
    assert_eq!(bools, BVec2::new(true, false));
}

#[test]
fn vectors_and_scalars_mix() {
    let mut k = kernel();
    let got = k.arithmetic(ABC, Vec3::new(0.5, 1.0, 3.0), 2.0);
    let wanted = [(1.0 + 1.0) / 1.5 - 1.0, (2.0 + 2.0) / 1.0 - 2.0, (3.0 + 6.0) / -1.0 - 3.0];
    assert_eq!(got.to_array(), wanted);
    assert_eq!(k.negated(ABCD), -ABCD);
    assert_eq!([k.remainder(-7.5, 2.0), k.remainder(7.5, -2.0)], [-1.5, 1.5]);
    assert_eq!(k.remainder_v(Vec2::new(5.0, -5.0), 3.0).to_array(), [2.0, -2.0]);
}

#[test]
fn products_sum_in_one_order() {
    let mut k = kernel();
    // Large terms cancel: any other order of the sum gives another result.
    let (a, b) = (Vec3::new(1e10, 1.0, -1e10), Vec3::new(1e10, 1.0, 1e10));
    assert_eq!(k.dot3(a, b), a.x * b.x + a.y * b.y + a.z * b.z);
    assert_eq!(k.dot4(ABCD, ABCD), 30.0);
    assert_eq!(k.cross3(Vec3::X, Vec3::Y), Vec3::Z);
    assert_eq!(k.cross3(ABC, Vec3::new(-2.0, 0.5, 4.0)).to_array(), [6.5, -10.0, 4.5]);
    assert_eq!([k.length3(Vec3::new(2.0, 3.0, 6.0)), k.length1(-2.0)], [7.0, 2.0]);
    assert_eq!(k.distance3(ABC, Vec3::new(3.0, 5.0, 9.0)), 7.0);
    assert_eq!(k.normalize3(Vec3::new(0.0, 0.0, -8.0)), Vec3::NEG_Z);
}

#[test]
fn directions_reflect_and_refract() {
    let mut k = kernel();
    assert_eq!(k.reflected(Vec3::new(1.0, -1.0, 0.0), Vec3::Y).to_array(), [1.0, 1.0, 0.0]);
    assert_eq!(k.refracted(Vec3::NEG_Y, Vec3::Y, 1.5), Vec3::NEG_Y);
    let grazing = Vec3::new(0.8, -0.6, 0.0);
    assert_eq!(k.refracted(grazing, Vec3::Y, 1.5), Vec3::ZERO);
    let bent = k.refracted(grazing, Vec3::Y, 0.5);
    assert!((bent.x - 0.4).abs() < 1e-6 && (bent.length() - 1.0).abs() < 1e-6);
    assert_eq!(k.facing(Vec3::Z, Vec3::NEG_Z, Vec3::Z), Vec3::Z);
    assert_eq!(k.facing(Vec3::Z, Vec3::Z, Vec3::Z), Vec3::NEG_Z);
}

#[test]
fn matrices_are_column_major() {
    let mut k = kernel();
    assert_eq!(k.mat_vec(ABC).to_array(), [30.0, 36.0, 43.5]);
    assert_eq!(k.vec_mat(Vec2::new(1.0, 10.0)).to_array(), [21.0, 43.0]);
    let (a, b) = (
        Mat2::from_cols_array(&[1.0, 2.0, 3.0, 4.0]),
        Mat2::from_cols_array(&[5.0, 6.0, 7.0, 8.0]),
    );
    assert_eq!(k.mat_mat(a, b).to_cols_array(), [23.0, 34.0, 31.0, 46.0]);
    let m = Mat4::from_cols(ABCD, -ABCD, ABCD * 2.0, Vec4::ZERO);
    assert_eq!(k.mat_scaled(m, 3.0), m);
    assert_eq!([k.mat_column(m, 2), k.mat_column(m, 9)], [ABCD * 2.0, Vec4::ZERO]);
    let n = Mat3::from_cols(ABC, ABC * 2.0, ABC * 3.0);
    assert_eq!(k.mat_entry(n), 33.0);
    assert_eq!(k.transposed(n).to_cols_array(), [1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 3.0, 6.0, 9.0]);
    assert_eq!(k.determinant3(Mat3::from_cols(ABC, Vec3::Y, Vec3::new(2.0, 5.0, 7.0))), 1.0);
}

#[test]
fn matrices_need_not_be_square() {
    let mut k = kernel();
    assert_eq!(k.affine(ABC).to_array(), [11.0, 24.0, 39.0]);
    assert_eq!(k.affine_transposed(ABC).to_array(), [1.0, 4.0, 9.0, 10.0 + 50.0 + 90.0]);
}
