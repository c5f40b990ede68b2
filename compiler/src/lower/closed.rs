//! Things that are filled must be closed, and their outside must be outside.

use lang::diagnostic::{Code, Diagnostic};
use lang::material::Traits as _;
use lang::scene::{Instance, Parts, Scene, Shape};

use super::files::Files;
use super::measured;
use crate::counted::counted;
use crate::import::{ImportError, Topology, topology};
use crate::stage::Stages;

/// What stands in the text about an inside: the name of the medium, or of the material.
struct Filling<'a> {
    material: &'a str,
    medium: Option<&'a str>,
}

/// Reports open and inverted shapes under materials that are filled with a medium. `matters`: light
/// must know what it is inside of, so that clear things are better closed, too.
///
/// # Errors
/// When a mesh cannot be loaded that must be looked at.
pub(super) fn check(
    scene: &Scene,
    (files, stages): (&dyn Files, &Stages),
    matters: bool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<(), ImportError> {
    for instance in &scene.instances {
        let Some(filling) = filling(scene, instance) else { continue };
        if filling.medium.is_none() && !matters {
            continue;
        }
        if let Some(what) = instance.shape.open() {
            diagnostics.push(open(instance, &filling, format!("{what} has no inside")));
        }
        if instance.shape.signed_volume().is_some_and(|volume| volume < 0.0) {
            diagnostics.push(inverted(instance, &filling));
        }
        let Shape::Mesh { asset, parts } = &instance.shape else { continue };
        let found = surface(*asset, parts, (files, stages))?;
        if found.boundary_edges > 0 {
            diagnostics.push(open(instance, &filling, holes(&found)));
        } else if found.signed_volume < 0.0 {
            diagnostics.push(inverted(instance, &filling));
        }
    }
    Ok(())
}

/// The surface that the parts of a file form which a shape shows.
pub(super) fn surface(
    asset: usize,
    parts: &Parts,
    (files, stages): (&dyn Files, &Stages),
) -> Result<Topology, ImportError> {
    measured::of_parts("topology", (asset, parts), &[], (files, stages), topology)
}

fn filling<'a>(scene: &'a Scene, instance: &Instance) -> Option<Filling<'a>> {
    let material = &scene.materials[instance.material?];
    let inside = material.model.inside()?;
    let medium = inside.medium.map(|medium| scene.media[medium].name.text.as_str());
    Some(Filling { material: &material.name.text, medium })
}

fn holes(found: &Topology) -> String {
    let near = found.boundary_near.map_or(String::new(), |p| {
        format!(", near ({:.3}, {:.3}, {:.3})m of the file", p[0], p[1], p[2])
    });
    let (edges, loops) = (found.boundary_edges, found.boundary_loops);
    let edges = counted(edges, "boundary edge", "boundary edges");
    format!("{edges} in {}{near}", counted(loops, "loop", "loops"))
}

fn open(instance: &Instance, filling: &Filling<'_>, what: String) -> Diagnostic {
    let material = filling.material;
    let found = if let Some(medium) = filling.medium {
        let text = format!(
            "`{material}` has an interior, but this shape is open: light would enter `{medium}` and \
             never leave"
        );
        Diagnostic::error(Code("E0512"), text)
            .with_help("close the mesh, use `box(...)`, or take a material without `interior`")
    } else {
        let text = format!("this shape of `{material}` is open: light that enters stays inside");
        Diagnostic::warning(Code("W0525"), "open_glass", text)
            .with_note("in a scene with media or priorities every ray knows what it is inside of")
            .with_help("close the mesh, or use a thin `box(...)`")
    };
    let found = found.at(instance.shape_span, what);
    match instance.material_span {
        Some(span) => found.because(span, "because of this material"),
        None => found,
    }
}

fn inverted(instance: &Instance, filling: &Filling<'_>) -> Diagnostic {
    let text = format!("this mesh of `{}` is inside out", filling.material);
    let help = if matches!(instance.shape, Shape::Faces { .. }) {
        "reverse the order of the points in each face"
    } else {
        "flip the normals of the mesh in the program that made it"
    };
    Diagnostic::error(Code("E0510"), text)
        .at(instance.shape_span, "the volume that its triangles enclose is negative")
        .with_note("triangles must be counter-clockwise seen from outside")
        .with_help(help)
}
