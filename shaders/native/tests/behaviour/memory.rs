//! Variables, pointers, structs, arrays and resources.

#![allow(
    clippy::redundant_closure_for_method_calls,
    reason = "a method of `Kernel<'_>` is not general enough where the closure is"
)]

use crate::kernels::memory::{self, Bindings, Kernel, Leaf, Real, Tree2, Vec3};
use glam::{BVec3, Mat4, UVec3, UVec4, Vec2, Vec4};

const MOVE: Mat4 = Mat4::from_cols(
    Vec4::X,
    Vec4::Y,
    Vec4::new(0.0, 0.0, 3.0, 0.0),
    Vec4::new(0.5, 0.25, 0.0, 1.0),
);
const POINTS: [Vec2; 2] = [Vec2::new(0.5, 0.1), Vec2::new(2.5, 4.0)];

/// Runs `f` with small resources; returns what it wrote.
fn with_kernel<T>(f: impl FnOnce(&mut Kernel) -> T) -> (T, [UVec4; 3], [f32; 2]) {
    let frame_words = [UVec4::new(1, 2, 3, 4), UVec4::new(5, 6, 7, 8)];
    let bits = |x: f32| x.to_bits();
    let node_words = [
        UVec4::new(10, 11, 12, 13),
        UVec4::new(20, bits(0.5), bits(-2.0), bits(0.1)),
        UVec4::new(30, 31, 32, 33),
    ];
    let leaves = [Leaf { weight: 0.5, count: 3 }, Leaf { weight: 1.5, count: 4 }];
    let mut film_words = [UVec4::ZERO; 3];
    let mut sums = [0.25_f32, 0.5];
    let mut total = Leaf::ZERO;
    let mut grid = [[Vec2::ZERO; 2]; 3];
    let mut records = [Leaf { weight: 0.25, count: 1 }];
    let setting = Tree2 { gain: 2.0, offset: Vec3::new(0.0, 0.0, 0.5) };
    let mut kernel = Kernel::new(Bindings {
        frame_words: &frame_words,
        node_words: &node_words,
        weights: &[0.1, 0.2],
        leaves: &leaves,
        film_words: &mut film_words,
        sums: &mut sums,
        total: &mut total,
        setting: &setting,
        points: &POINTS,
        transforms: &[Mat4::IDENTITY, MOVE],
        grid: &mut grid,
        records: &mut records,
        scale: &2.0,
    });
    let value = f(&mut kernel);
    (value, film_words, sums)
}

fn run<T>(f: impl FnOnce(&mut Kernel) -> T) -> T {
    with_kernel(f).0
}

#[test]
fn private_variables_are_reset_for_each_invocation() {
    let ((), film, _) = with_kernel(|k| {
        k.render(UVec3::new(0, 7, 0));
        k.render(UVec3::new(1, 8, 0));
        k.render(UVec3::new(9, 9, 0));
    });
    assert_eq!(film, [UVec4::new(3, 0, 4, 7), UVec4::new(3, 0, 4, 8), UVec4::ZERO]);
}

#[test]
fn pointers_write_through() {
    assert_eq!(run(|k| k.pointer_to_variable()), 14);
    assert_eq!(run(|k| k.pointer_to_member()), 246);
    assert_eq!(run(|k| k.pointer_to_element(1)), 1434);
    assert_eq!(run(|k| k.pointer_keeps_index()), 50);
}

#[test]
fn structs_are_copied() {
    assert_eq!(run(|k| k.structs_are_values()), 1320);
    assert_eq!(run(|k| k.structs_pass_by_value()), 75.5);
}

#[test]
fn locals_start_at_zero() {
    assert_eq!(run(|k| k.locals_start_zeroed()), 0);
}

#[test]
fn constant_arrays_take_any_index() {
    assert_eq!([0, 3, 4, 5, u32::MAX].map(|i| run(|k| k.constant_array(i))), [2, 7, 11, 11, 11]);
    assert_eq!([0, 4, -1].map(|i| run(|k| k.constant_array_signed(i))), [2, 11, 11]);
    assert_eq!([0, 2, 9].map(|i| run(|k| k.local_constant_array(i))), [10, 30, 30]);
    assert_eq!(run(|k| k.constant_corner(1)).to_array(), [1.0, 0.2]);
}

#[test]
fn reads_outside_give_the_last_element() {
    assert_eq!([0, 2, 3, u32::MAX].map(|i| run(|k| k.read_outside(i))), [10, 30, 30, 30]);
    assert_eq!([1, 2, 9].map(|i| run(|k| k.frame(i)).x), [5, 5, 5]);
    assert_eq!([1, 3, u32::MAX].map(|i| run(|k| k.node(i)).x), [20, 30, 30]);
    assert_eq!(run(|k| k.node_lane(0, 2)), 12);
    assert_eq!(run(|k| k.node_lane(7, 7)), 33);
    assert_eq!([1, 9].map(|i| run(|k| k.lane_of_value(UVec4::new(1, 2, 3, 4), i))), [2, 4]);
}

#[test]
fn writes_outside_are_dropped() {
    assert_eq!([0, 2, 3, u32::MAX].map(|i| run(|k| k.write_outside(i))), [923, 129, 123, 123]);
    assert_eq!(run(|k| k.write_outside_nested(1, 0)), 10);
    assert_eq!(run(|k| k.write_outside_nested(0, 2)), 0);
    assert_eq!(run(|k| k.write_outside_nested(2, 0)), 0);
    assert_eq!([1, 3].map(|i| run(|k| k.lane_outside(i))), [153.0, 123.0]);
    assert_eq!([0, 1, 2].map(|i| run(|k| k.column_outside(i))), [5734.0, 1257.0, 1234.0]);
    let ((), film, _) = with_kernel(|k| k.film_write(3, UVec4::splat(1)));
    assert_eq!(film, [UVec4::ZERO; 3]);
    assert!(run(|k| k.lane_of_bools(BVec3::new(false, false, true), 1)));
    assert!(!run(|k| k.lane_of_bools(BVec3::new(false, false, true), 2)));
}

#[test]
fn empty_resources_read_as_zero() {
    let mut total = Leaf::ZERO;
    let mut k = Kernel::new(Bindings {
        frame_words: &[],
        node_words: &[],
        weights: &[],
        leaves: &[],
        film_words: &mut [],
        sums: &mut [],
        total: &mut total,
        setting: &Tree2::ZERO,
        points: &[],
        transforms: &[],
        grid: &mut [],
        records: &mut [],
        scale: &2.0,
    });
    assert_eq!(k.node(0), UVec4::ZERO);
    assert_eq!(k.frame(1), UVec4::ZERO);
    assert_eq!(k.leaf_count(3), 0);
    assert_eq!(k.film_read(0), UVec4::ZERO);
    k.film_lane(0, 1);
    assert_eq!(k.film_size() + k.node_count(), 0);
    assert_eq!([k.weight(0), k.point(1).x], [0.0, 0.0]);
}

#[test]
fn resources_are_read_as_declared() {
    assert_eq!(run(|k| k.frame_first()), 2 + 8);
    assert_eq!(run(|k| (k.node_count(), k.film_size())), (3, 3));
    assert_eq!(run(|k| k.leaf_count(1)), 4);
    let (weight, leaf, gain) = run(|k| (k.weight(1), k.leaf_weight(0), k.gain()));
    assert_eq!([weight, leaf, gain], [Real::from(0.2_f32), 0.5, 2.5]);
    let (point, y) = run(|k| (k.point(0), k.point_y(0)));
    assert_eq!([point.x, point.y, y], [0.5, Real::from(0.1_f32), Real::from(0.1_f32)]);
    let floats = run(|k| k.node_floats(1));
    assert_eq!(floats.to_array(), [0.5, -2.0, Real::from(0.1_f32)]);
}

#[test]
fn resources_are_written_as_declared() {
    let (total, film, sums) = with_kernel(|k| {
        k.film_write(1, UVec4::new(1, 2, 3, 4));
        k.film_lane(1, 9);
        k.film_lane(0, 5);
        k.add_sum(1, 0.25);
        k.add_sum(7, 0.5)
    });
    assert_eq!(film, [UVec4::new(0, 0, 5, 0), UVec4::new(1, 2, 9, 4), UVec4::ZERO]);
    assert_eq!(sums, [0.25, 0.75]);
    assert_eq!(total, 0.75);
}

#[test]
fn lanes_are_stored_one_by_one() {
    assert_eq!(run(|k| k.store_lane()).to_array(), [2.0, 0.0, 1.5, 1.5]);
}

#[test]
fn private_variables_outlive_calls() {
    assert_eq!(run(|k| k.push_and_peek(4, 7)), 472);
    let twice = run(|k| [k.next_random(), k.next_random()]);
    assert_ne!(twice[0], twice[1]);
}

#[test]
fn resources_nest() {
    let p = memory::Vec4::new(1.0, 1.0, 1.0, 1.0);
    assert_eq!(run(|k| k.transform(1, p)).to_array(), [3.0, 2.5, 6.0, 2.0]);
    assert_eq!(run(|k| k.transform(0, p)).to_array(), [2.0; 4]);
    assert_eq!(run(|k| k.transform_column(7, 9)).to_array(), [0.5, 0.25, 0.0, 1.0]);
    assert_eq!(run(|k| [k.grid_set(1, 1, 2.0), k.grid_set(1, 0, 3.0)]), [2.5, 3.5]);
    assert_eq!(run(|k| [k.grid_set(9, 1, 2.0), k.grid_set(2, 2, 2.0)]), [0.0, 0.0]);
    assert_eq!(run(|k| [k.record_set(0, 1.0), k.record_set(0, 2.0)]), [1.25, 3.25]);
    assert_eq!(run(|k| [k.table_set(0, 1), k.table_set(1, 2), k.table_set(2, 0)]), [3, 6, 3]);
}
