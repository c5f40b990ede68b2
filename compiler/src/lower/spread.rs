//! Lamps of any shape that say their power: it is spread over all that is made of their material.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use lang::diagnostic::{Code, Diagnostic};
use lang::material::{Brightness, Emissive};
use lang::scene::{Instance, MaterialModel, Parts, Scene, Shape};

use super::closed;
use super::geometry::body::{Bodies, Body, Form};
use super::geometry::transform::Transform;
use super::material::{MaterialRef, MaterialTable};
use super::measured;
use crate::import::{ImportError, Part};
use crate::stage::Stages;

/// Gives materials that say their power the radiance that follows.
///
/// # Errors
/// When a mesh cannot be loaded.
pub(super) fn powers(
    scene: &Scene,
    bodies: &Bodies,
    stages: &Stages,
    materials: &mut MaterialTable<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<(), ImportError> {
    // Of each: its watts, and the square metres that shine.
    let mut lamps: BTreeMap<usize, (&Emissive, f64, f64)> = BTreeMap::new();
    for (index, material) in scene.materials.iter().enumerate() {
        if let MaterialModel::Emissive(emissive) = &material.model
            && let Brightness::Power(watts) = emissive.brightness
        {
            lamps.insert(index, (emissive, watts, 0.0));
        }
    }
    for (instance, body) in scene.instances.iter().zip(&bodies.list) {
        let lamp = instance.material.and_then(|material| lamps.get_mut(&material));
        let Some((emissive, _, area)) = lamp else { continue };
        let sides = sides(instance, emissive.both_sides, (materials, stages))?;
        *area += sides * area_of(instance, body, (materials, stages))?;
    }
    for (index, (_, watts, area)) in lamps {
        let Some(known) = materials.position(MaterialRef::Scene(index)) else { continue };
        // What has no area gives no light, however bright it is.
        if area > 0.0 && !materials.brighten(known, watts / (PI * area)) {
            let name = &scene.materials[index].name;
            let text = format!("`{}` is too bright: it has {area:e} m2 for {watts} W", name.text);
            let error = Diagnostic::error(Code("E0402"), text).at(name.span, "this light");
            diagnostics.push(error.with_help("a larger light spreads the same `power`"));
        }
    }
    Ok(())
}

/// How many sides of a shape give light that gets away.
fn sides(
    instance: &Instance,
    both: bool,
    (materials, stages): (&MaterialTable<'_>, &Stages),
) -> Result<f64, ImportError> {
    if !both {
        return Ok(1.0);
    }
    let is_open = if let Shape::Mesh { asset, parts } = &instance.shape {
        closed::surface(*asset, parts, (materials.files, stages))?.boundary_edges > 0
    } else {
        instance.shape.open().is_some()
    };
    Ok(if is_open { 2.0 } else { 1.0 })
}

/// Square metres of one side.
fn area_of(
    instance: &Instance,
    body: &Body,
    (materials, stages): (&MaterialTable<'_>, &Stages),
) -> Result<f64, ImportError> {
    match (&body.form, &instance.shape) {
        (Form::Sphere(ball), _) => Ok(4.0 * PI * ball.radius * ball.radius),
        (Form::Faces(faces, _), _) => Ok(faces.iter().map(|face| face.area).sum()),
        (Form::Mesh(_) | Form::Stored(..), Shape::Mesh { asset, parts }) => {
            area_of_mesh((*asset, parts), &body.transform, (materials, stages))
        }
        (Form::Nothing | Form::Mesh(_) | Form::Stored(..), _) => Ok(0.0),
    }
}

fn area_of_mesh(
    mesh: (usize, &Parts),
    transform: &Transform,
    (materials, stages): (&MaterialTable<'_>, &Stages),
) -> Result<f64, ImportError> {
    let area = |part: &&Part| -> f64 {
        let triangles = measured::placed(part, transform);
        triangles.map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum()
    };
    let known = (materials.files, stages);
    measured::of_parts("area", mesh, &transform.numbers(), known, |parts| {
        parts.iter().map(area).sum()
    })
}
