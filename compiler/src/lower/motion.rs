//! Velocities become displacements: where things are when the shutter opens, how far they come until it
//! closes, and marks on all that moves.

use pack::abi::{MOVES, OBJECT_OF_INSTANCE, TRI_SMOOTH};

use super::object::Thing;
use super::order::Ordered;
use crate::normalize::Normalization;

/// How far each thing comes, normalised frame; empty where nothing moves.
pub(super) fn displacements(things: &[Thing], frame: &Normalization) -> Vec<[f32; 3]> {
    let all: Vec<[f32; 3]> = things.iter().map(|thing| thing.displacement(frame)).collect();
    if all.iter().flatten().all(|component| *component == 0.0) { Vec::new() } else { all }
}

/// Marks the primitives of things that move, each by its displacement in `motions`; instances were marked when they
/// were made.
pub(super) fn mark(motions: &[[f32; 3]], ordered: &mut Ordered) {
    if motions.is_empty() {
        return;
    }
    let moves = |object: u32| {
        object != OBJECT_OF_INSTANCE && motions[object as usize].iter().any(|x| *x != 0.0)
    };
    for (triangle, shade) in ordered.triangles.iter_mut().zip(&ordered.shades) {
        if moves(shade.object & !TRI_SMOOTH) {
            triangle.id0 |= MOVES;
            triangle.id1 |= MOVES;
            triangle.id2 |= MOVES;
        }
    }
    for sphere in ordered.spheres.iter_mut().filter(|sphere| moves(sphere.object)) {
        sphere.object |= MOVES;
    }
}
