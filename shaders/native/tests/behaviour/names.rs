//! Names that Rust or the generated module keeps for itself.

use crate::kernels::names::{Bindings, Kernel, Kernel_, Vec3, Vec3_, limit};
use glam::UVec3;

#[test]
fn taken_names_get_an_underscore() {
    let mut k = Kernel::new(Bindings { unused: core::marker::PhantomData });
    let made: Kernel_ = k.box_(9);
    assert_eq!((made.match_, made.type_, limit), (4, 3, 4));
    assert_eq!([made.box_, made.dyn_.x], [3.0, 0.0]);
    assert_eq!(k.none(), 6);
    assert_eq!(k.try_new(1, 2), 6);
    assert_eq!(k.shadows_constant(1), 6);
    let third: Vec3_ = k.vec3_of(5);
    assert_eq!((third.gen_, k.self_), (7, 2));
    assert_eq!(k.render_(UVec3::new(1, 1, 0)), 4);
    assert_eq!(Vec3::ZERO.x, 0.0);
}
