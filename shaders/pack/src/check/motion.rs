//! Checks that primitives know whether they move.
//!
//! A kernel looks into the table of objects only for primitives that are marked, so a mark must be there
//! exactly where the object moves: then no mark leads beyond the table.

use rayon::prelude::*;

use crate::abi::{Instance, MOVES, Object, Sphere, TRI_SMOOTH, TriShade, Triangle};
use crate::contents::Contents;
use crate::error::PackError;
use crate::fault::ElementFault;

use super::broken::{Broken, CHUNK, element};

/// Every triangle, then every sphere, then every instance.
pub(super) fn check(contents: &Contents<'_>) -> Result<(), PackError> {
    let (triangles, spheres) = (contents.triangles.par_iter(), contents.spheres.par_iter());
    let bad = triangles
        .zip(contents.shades)
        .with_min_len(CHUNK)
        .enumerate()
        .find_map_first(|(index, (t, shade))| Some((index, triangle(t, shade, contents)?)));
    if let Some((index, broken)) = bad {
        return Err(element::<Triangle>(index, broken));
    }
    let bad = spheres
        .with_min_len(CHUNK)
        .enumerate()
        .find_map_first(|(index, s)| Some((index, thing(s.object, contents)?)));
    if let Some((index, broken)) = bad {
        return Err(element::<Sphere>(index, broken));
    }
    let bad = (contents.instances.iter().enumerate())
        .find_map(|(index, i)| Some((index, thing(i.object, contents)?)));
    bad.map_or(Ok(()), |(index, broken)| Err(element::<Instance>(index, broken)))
}

fn triangle(triangle: &Triangle, shade: &TriShade, contents: &Contents<'_>) -> Option<Broken> {
    let ids = [("id0", triangle.id0), ("id1", triangle.id1), ("id2", triangle.id2)];
    ids.into_iter().find_map(|(field, id)| {
        Some((field, marked(id & MOVES != 0, shade.object & !TRI_SMOOTH, contents)?))
    })
}

/// The word `object` of a sphere or an instance.
fn thing(object: u32, contents: &Contents<'_>) -> Option<Broken> {
    Some(("object", marked(object & MOVES != 0, object & !MOVES, contents)?))
}

/// Whether a primitive of `object` may or may not be marked.
fn marked(found: bool, object: u32, contents: &Contents<'_>) -> Option<ElementFault> {
    let moves = contents.objects.get(object as usize).is_some_and(Object::moves);
    (found != moves).then_some(if moves {
        ElementFault::NotMarked { object }
    } else {
        ElementFault::Marked { object }
    })
}
