//! Velocities become displacements: where things are when the shutter opens, how far they come until it
//! closes, and marks on all that moves.

use glam::DVec3;
use lang::scene::Camera;
use pack::abi::{self, MOVES, OBJECT_OF_INSTANCE, TRI_SMOOTH};

use super::geometry::Placement;
use super::object::Thing;
use super::order::Ordered;
use crate::normalize::Normalization;

/// When the shutter opens and closes, seconds after the moment at which things are where the scene says.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shutter {
    open: f64,
    close: f64,
}

impl Shutter {
    pub(super) fn of(camera: &Camera) -> Self {
        let [open, close] = camera.shutter;
        Self { open, close }
    }

    /// How far a thing has come when the shutter opens, metres; `velocity` in metres per second.
    pub(super) fn lead(self, velocity: [f64; 3]) -> DVec3 {
        DVec3::from(velocity) * self.open
    }

    /// How far a thing comes while the shutter is open, metres.
    pub(super) fn travel(self, velocity: [f64; 3]) -> DVec3 {
        DVec3::from(velocity) * (self.close - self.open)
    }
}

/// How far each thing comes, normalised frame; empty where nothing moves.
pub(super) fn displacements(things: &[Thing], frame: &Normalization) -> Vec<[f32; 3]> {
    let all: Vec<[f32; 3]> = things.iter().map(|thing| thing.displacement(frame)).collect();
    if all.iter().flatten().all(|component| *component == 0.0) { Vec::new() } else { all }
}

/// Where the corners of moving triangles and the ends of moving spheres are when the shutter closes,
/// metres, as points whose bounds are theirs.
pub(super) fn ends(placement: &Placement) -> Vec<[f64; 3]> {
    let moving: Vec<Option<DVec3>> = (placement.things.iter())
        .map(|thing| Some(thing.motion).filter(|motion| *motion != DVec3::ZERO))
        .collect();
    if moving.iter().all(Option::is_none) {
        return Vec::new();
    }
    let corners = placement.corners.iter().zip(&placement.shades).filter_map(|(corners, shade)| {
        let motion = moving[(shade.object & !TRI_SMOOTH) as usize]?;
        Some(corners.map(|corner| corner + motion))
    });
    let balls = placement.spheres.iter().zip(&placement.sphere_objects);
    let balls = balls.filter_map(|((center, radius), object)| {
        let center = *center + moving[*object as usize]?;
        Some([center - *radius, center + *radius])
    });
    let placed = placement.placed.iter().filter_map(|placed| {
        let motion = moving[placed.object as usize]?;
        Some(placed.bounds.map(|corner| corner + motion))
    });
    let all = corners.flatten().chain(balls.flatten()).chain(placed.flatten());
    all.map(DVec3::into).collect()
}

/// Marks the primitives of objects that move; instances were marked when they were made.
pub(super) fn mark(objects: &[abi::Object], ordered: &mut Ordered) {
    if !objects.iter().any(abi::Object::moves) {
        return;
    }
    let moves = |object: u32| object != OBJECT_OF_INSTANCE && objects[object as usize].moves();
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
