//! Velocities and keys become displacements: where things are when the shutter opens, how they move until it
//! closes, and marks on all that moves.

use lang::diagnostic::{Code, Diagnostic};
use lang::scene::Scene;
use pack::abi::{MOVES, OBJECT_OF_INSTANCE, TRI_SMOOTH};

use super::geometry::body::{Bodies, Form};
use super::material::MaterialTable;
use super::object::Thing;
use super::order::Ordered;
use crate::bvh::Motion;
use crate::normalize::Normalization;

/// How each thing moves, normalised frame; empty where nothing does.
pub(super) fn displacements(things: &[Thing], frame: &Normalization) -> Vec<Motion> {
    let all: Vec<Motion> = things.iter().map(|thing| thing.displacement(frame)).collect();
    if all.iter().any(Motion::moves) { all } else { Vec::new() }
}

/// Marks the primitives of things that move, each by its displacement in `motions`; instances were marked when they
/// were made.
pub(super) fn mark(motions: &[Motion], ordered: &mut Ordered) {
    if motions.is_empty() {
        return;
    }
    let moves = |object: u32| object != OBJECT_OF_INSTANCE && motions[object as usize].moves();
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

/// Refuses things that glow and turn: a light is sampled where it was when the shutter opened, moved but not turned.
pub(super) fn check(
    scene: &Scene,
    bodies: &Bodies,
    materials: &MaterialTable<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let glows = |material: u32| materials.looks(material).glows;
    for (body, thing) in bodies.list.iter().zip(&bodies.things) {
        let lit = match &body.form {
            Form::Nothing | Form::Stored(..) => false,
            Form::Sphere(ball) => glows(ball.material),
            Form::Faces(_, material) => glows(*material),
            Form::Mesh(mesh) => mesh.parts.iter().any(|(_, material)| glows(*material)),
        };
        let turns = thing.path.as_ref().is_some_and(|path| path.turns());
        let Some(instance) = scene.instances.get(body.object as usize).filter(|_| lit && turns)
        else {
            continue;
        };
        let text =
            format!("`{}` gives light and turns while the shutter is open", instance.name.text);
        let help = "give `rotate` one value; what gives light may move along keys of `at`";
        let error = Diagnostic::error(Code("E0806"), text).at(instance.name.span, "this turns");
        diagnostics.push(error.with_help(help));
    }
}
