//! Checks that ways lead from the opening of the shutter to its closing, and that primitives know whether they move.
//!
//! A kernel walks along a way until a piece ends no sooner than its time, which is at most 1: so the last piece of
//! every way ends at 1. It looks into the table of objects only for primitives that are marked, so a mark must be there
//! exactly where the object moves: then no mark leads beyond the table.

use rayon::prelude::*;

use crate::abi::{
    CameraKey, Instance, MOVES, MotionPiece, Object, Sphere, TRI_SMOOTH, TriShade, Triangle,
};
use crate::contents::Contents;
use crate::error::PackError;
use crate::fault::ElementFault;

use super::broken::{Broken, CHUNK, element};

/// Ways, then every triangle, every sphere, every instance.
pub(super) fn check(contents: &Contents<'_>) -> Result<(), PackError> {
    ways(contents)?;
    let keys = contents.camera_keys;
    let times = keys.iter().map(|key| key.time);
    if let Some((index, fault)) = rising(times, keys.len()) {
        return Err(element::<CameraKey>(index, ("time", fault)));
    }
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

/// Every piece takes some time, and is followed by one that starts where it ends, unless that is 1; ways start at 0.
fn ways(contents: &Contents<'_>) -> Result<(), PackError> {
    let pieces = contents.motion;
    for (index, piece) in pieces.iter().enumerate() {
        let (start, end) = (piece.start, piece.end);
        if end <= start {
            let fault = ElementFault::NotAfter { found: end, before: start };
            return Err(element::<MotionPiece>(index, ("end", fault)));
        }
        let follows = pieces.get(index + 1).is_some_and(|next| same(next.start, end));
        if !same(end, 1.0) && !follows {
            let fault = ElementFault::NoWayOn(end);
            return Err(element::<MotionPiece>(index, ("end", fault)));
        }
    }
    let starts_late = |object: &Object| {
        let first = pieces.get((object.path as usize).checked_sub(1)?)?;
        (!same(first.start, 0.0))
            .then_some(ElementFault::Edge { found: first.start, expected: 0.0 })
    };
    let mut objects = contents.objects.iter().enumerate();
    let bad = objects.find_map(|(index, object)| Some((index, ("path", starts_late(object)?))));
    bad.map_or(Ok(()), |(index, broken)| Err(element::<Object>(index, broken)))
}

fn same(a: f32, b: f32) -> bool {
    a.total_cmp(&b).is_eq()
}

/// The first of `n` times that breaks the rule that they rise from 0 to 1.
fn rising(times: impl Iterator<Item = f32>, n: usize) -> Option<(usize, ElementFault)> {
    let mut last: Option<f32> = None;
    for (index, found) in times.enumerate() {
        let fault = match last {
            None if !same(found, 0.0) => Some(ElementFault::Edge { found, expected: 0.0 }),
            Some(before) if found <= before => Some(ElementFault::NotAfter { found, before }),
            Some(_) if index + 1 == n && !same(found, 1.0) => {
                Some(ElementFault::Edge { found, expected: 1.0 })
            }
            None | Some(_) => None,
        };
        if let Some(fault) = fault {
            return Some((index, fault));
        }
        last = Some(found);
    }
    None
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
