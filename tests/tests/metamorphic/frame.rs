//! The same scene in other units of length, or elsewhere in the world: the same picture. The compiler
//! centres and scales every scene, so the kernel does not see the difference.

use lang::scene::{AssetFormat, MediumModel, Scene};
use lang::schema::unit_of;
use lang::units::Dim;
use tests::features::{changed, named};

use crate::RICH;
use crate::compare::{assert_exact, film};

/// Micrometres to a planet.
const POWERS: [i32; 3] = [-20, 3, 20];

/// Multiplies every length by 2^`power`, and divides what is per length.
fn scale(scene: &mut Scene, power: i32) {
    let (by, per) = (2.0_f64.powi(power), 2.0_f64.powi(-power));
    lengths(scene, |length| *length *= by);
    for material in &mut scene.materials {
        material.model.numbers_mut(&mut |field, values| {
            let factor = match unit_of(field.ty) {
                Some((Dim::LENGTH, _)) => by,
                Some((Dim::PER_LENGTH, _)) => per,
                // Scales of coordinates, which are metres of the object times this.
                _ if ["scale", "waves.scale"].contains(&field.name) => per,
                _ => 1.0,
            };
            for value in values {
                *value *= factor;
            }
        });
    }
    for medium in &mut scene.media {
        medium.sky_distance *= by;
        match &mut medium.model {
            MediumModel::Homogeneous { sigma_a, sigma_s, g: _ } => {
                *sigma_a = sigma_a.map(|sigma| sigma * per);
                *sigma_s = sigma_s.map(|sigma| sigma * per);
            }
            MediumModel::Fog { density, color: _ } => *density *= per,
        }
    }
    for asset in &mut scene.assets {
        match &mut asset.format {
            AssetFormat::Obj(frame) | AssetFormat::Ply(frame) | AssetFormat::Stl(frame) => {
                frame.metres_per_unit *= by;
            }
            AssetFormat::Gltf(_) => panic!("no case has one"),
        }
    }
}

/// Calls `change` for every number of metres, and of metres per second, that says where things, lights and
/// the camera are and how large; not for what is inside of files, materials and media.
fn lengths(scene: &mut Scene, mut change: impl FnMut(&mut f64)) {
    for instance in &mut scene.instances {
        instance.world_from_object.iter_mut().for_each(|row| change(&mut row[3]));
        instance.velocity.iter_mut().for_each(&mut change);
        let keys = instance.motion.iter_mut().flat_map(|motion| &mut motion.keys);
        keys.flat_map(|key| &mut key.at).for_each(&mut change);
        instance.shape.lengths_mut().iter_mut().for_each(&mut change);
    }
    for light in &mut scene.lights {
        light.center.iter_mut().chain(&mut light.velocity).for_each(&mut change);
        change(&mut light.radius);
    }
    let camera = &mut scene.camera;
    camera.from.iter_mut().chain(&mut camera.to).for_each(&mut change);
    let keys = camera.keys.iter_mut().flat_map(|key| [&mut key.from, &mut key.to]);
    keys.flatten().for_each(&mut change);
    match &mut camera.projection {
        lang::scene::Projection::Perspective(lens) => {
            change(&mut lens.radius);
            change(&mut lens.focus_distance);
        }
        lang::scene::Projection::Orthographic { size, .. } => {
            size.iter_mut().flatten().for_each(&mut change);
        }
        lang::scene::Projection::Panoramic { .. } => {}
    }
}

#[test]
fn units_of_length_do_not_change_a_bit() {
    for name in RICH {
        let base = film(&changed(named(name), |_| {}));
        for power in POWERS {
            let scaled = film(&changed(named(name), |scene| scale(scene, power)));
            assert_exact(&format!("{name}, 2^{power} m"), &base, &scaled, 1.0);
        }
    }
}

/// Rounds all numbers that make up a place to a grid of 2^-12, in metres and in seconds, so that every place
/// of the world is a multiple of 2^-37 m: vertices of files have 24 bits.
fn snap(scene: &mut Scene) {
    let snap = |number: &mut f64| *number = (*number * 4096.0).round() / 4096.0;
    lengths(scene, snap);
    for instance in &mut scene.instances {
        instance.world_from_object.iter_mut().flatten().for_each(snap);
    }
    let keys = scene.instances.iter_mut().filter_map(|instance| instance.motion.as_mut());
    keys.flat_map(|motion| &mut motion.keys).for_each(|key| snap(&mut key.time));
    scene.camera.keys.iter_mut().for_each(|key| snap(&mut key.time));
    scene.camera.shutter.iter_mut().for_each(snap);
}

/// Moves everything. The magnitude keeps multiples of 2^-37 below 2^53 of them.
fn shift(scene: &mut Scene) {
    let by = [4096.0, -2048.0, 1024.0];
    let add = |to: &mut [f64; 3]| *to = [0, 1, 2].map(|k| to[k] + by[k]);
    for instance in &mut scene.instances {
        for (row, by) in instance.world_from_object.iter_mut().zip(by) {
            row[3] += by;
        }
        let keys = instance.motion.iter_mut().flat_map(|motion| &mut motion.keys);
        keys.for_each(|key| add(&mut key.at));
    }
    scene.lights.iter_mut().for_each(|light| add(&mut light.center));
    add(&mut scene.camera.from);
    add(&mut scene.camera.to);
    for key in &mut scene.camera.keys {
        add(&mut key.from);
        add(&mut key.to);
    }
}

/// Bit for bit, since `f64` holds every number on both sides, and what the compiler takes from them are
/// differences. (Middles of lights are rounded; they only weigh lights that are far from everything.)
#[test]
fn a_shift_that_numbers_can_hold_does_not_change_a_bit() {
    for name in RICH {
        let base = film(&changed(named(name), snap));
        let shifted = film(&changed(named(name), |scene| {
            snap(scene);
            shift(scene);
        }));
        assert_exact(name, &base, &shifted, 1.0);
    }
}
