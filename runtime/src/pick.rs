//! A pixel → what is seen there: which declarations of the scene made it, where it is, which way it faces.
//!
//! One ray through the middle of the pixel, from the middle of the lens, when the shutter opens; the kernel's own
//! functions find the surface. Names and lines come from the pack's manifest. It does not print.

use crate::check::{self, CheckError};
use crate::job::Job;
use crate::kernel::f32 as k;
use crate::scene::Scene;
use glam::{UVec2, Vec2, Vec3};
use pack::Manifest;
use pack::abi::{CameraKind, MOVES, NONE};
use pack::manifest::Named;
use serde::Serialize;
use std::fmt;

/// A declaration of the scene.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Declared {
    /// Its name; of a shape what it is: `sphere`, `rectangle`, `box`, `mesh`.
    pub name: String,
    /// The file that it is in, as the scene names it.
    pub file: Option<String>,
    /// Line there, from 1.
    pub line: Option<u32>,
}

/// A primitive of the pack.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Primitive {
    /// Index of a triangle.
    Triangle(u32),
    /// Index of a sphere.
    Sphere(u32),
}

/// The surface that is seen.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Surface {
    /// The instance that it is part of.
    pub instance: Option<Declared>,
    /// Or the light.
    pub light: Option<Declared>,
    /// The object whose shape the instance has, if it has that of one.
    pub object: Option<Declared>,
    /// The shape, where it is written.
    pub shape: Option<Declared>,
    /// The asset that a mesh is from.
    pub asset: Option<Declared>,
    /// The part of the asset that the scene asks for; `None`: all of it.
    pub part: Option<String>,
    /// Its material.
    pub material: Option<Declared>,
    /// World space, metres.
    pub position: [f64; 3],
    /// From the camera, metres.
    pub distance: f64,
    /// Along the viewing direction, metres: where the camera focuses on it; of a panorama the distance.
    pub depth: f64,
    /// Shading normal before normal maps, unit, world space, on the side of the camera.
    pub normal: [f64; 3],
    /// Geometric normal, unit, world space, on the side of the camera.
    pub geometric_normal: [f64; 3],
    /// Whether its front is seen.
    pub front: bool,
    /// Texture coordinates.
    pub uv: [f64; 2],
    /// What the pack calls it.
    pub primitive: Primitive,
}

/// What is seen in a pixel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pick {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Image in pixels.
    pub image: [u32; 2],
    /// `None`: the sky, or nothing.
    pub surface: Option<Surface>,
    /// The camera.
    pub camera: Option<Declared>,
}

/// What cannot be picked.
#[derive(Debug, thiserror::Error)]
pub enum PickError {
    /// The pixel is outside of the image.
    #[error("pixel {},{} is not in the image of {}x{} pixels", pixel[0], pixel[1], size[0], size[1])]
    Pixel {
        /// What was asked for.
        pixel: [u32; 2],
        /// The image.
        size: [u32; 2],
    },
    /// The CPU kernel cannot trace the scene.
    #[error(transparent)]
    Kernel(#[from] CheckError),
}

/// What is seen in `pixel` of the job's image.
///
/// # Errors
/// When there is no such pixel, or the CPU kernel cannot trace the scene.
pub fn pick(scene: &Scene, job: &Job, pixel: [u32; 2]) -> Result<Pick, PickError> {
    let size = job.image_size;
    if pixel[0] >= size[0] || pixel[1] >= size[1] {
        return Err(PickError::Pixel { pixel, size });
    }
    let setup = scene.setup(job);
    check::room(&setup)?;
    let frame = setup.frame_of(job);
    let mut kernel = check::open(&setup, &frame);
    let camera = kernel.load_camera();
    let at = Vec2::new(pixel[0] as f32 + 0.5, pixel[1] as f32 + 0.5);
    let ray = match CameraKind::from_tag(camera.kind) {
        Some(CameraKind::Orthographic) => kernel.orthographic_ray(camera, at),
        Some(CameraKind::Panoramic) => kernel.panoramic_ray(camera, at),
        Some(CameraKind::Perspective) | None => kernel.pinhole_ray(camera, at),
    };
    let nowhere = UVec2::splat(NONE);
    let ray = kernel.ray_new(ray.origin, ray.dir, k::RAY_FAR, nowhere, NONE, 0.0);
    let hit = kernel.trace(ray);
    let manifest = scene.pack().manifest().unwrap_or_default();
    let surface = (hit.prim != NONE).then(|| {
        let surface = kernel.dispatch_surface(hit, ray.origin, ray.dir, 0.0);
        let around = camera.kind == CameraKind::Panoramic as u32;
        let facing = if around { 1.0 } else { f64::from(ray.dir.dot(camera.forward)) };
        described(scene, &manifest, (&surface, hit), facing)
    });
    let camera = manifest.cameras.first().map(|camera| declared(&manifest, camera));
    Ok(Pick { pixel, image: size, surface, camera })
}

/// `facing`: cosine between the ray and the viewing direction; 1 where the camera looks all around.
fn described(
    scene: &Scene,
    manifest: &Manifest,
    (surface, hit): (&k::Surface, k::Hit),
    facing: f64,
) -> Surface {
    let (scale, center) = (scene.settings().scale(), scene.settings().center());
    let wide = |v: Vec3| v.as_dvec3().to_array();
    let [x, y, z] = wide(surface.p);
    let named = manifest.object(surface.object & !MOVES);
    let (instance, light, shown) = match named {
        Some((named, Some(shown))) => (Some(named), None, Some(shown)),
        Some((named, None)) => (None, Some(named), None),
        None => (None, None, None),
    };
    let told = |named: Option<&Named>| named.map(|named| declared(manifest, named));
    let distance = f64::from(hit.t) / scale;
    Surface {
        instance: told(instance),
        light: told(light),
        object: told(shown.and_then(|shown| shown.object.as_ref())),
        shape: told(shown.map(|shown| &shown.shape)),
        asset: told(shown.and_then(|shown| shown.asset.as_ref())),
        part: shown.and_then(|shown| shown.part.clone()),
        material: told(manifest.materials.get(surface.material as usize)),
        position: [x / scale + center[0], y / scale + center[1], z / scale + center[2]],
        distance,
        depth: distance * facing,
        normal: wide(surface.ns),
        geometric_normal: wide(surface.ng),
        front: surface.front,
        uv: surface.at.uv.as_dvec2().to_array(),
        primitive: match hit.prim & k::PRIM_SPHERE {
            0 => Primitive::Triangle(hit.prim),
            _ => Primitive::Sphere(hit.prim & !k::PRIM_SPHERE),
        },
    }
}

fn declared(manifest: &Manifest, named: &Named) -> Declared {
    let place = manifest.file(named.file).filter(|_| named.line > 0);
    Declared {
        name: named.name.clone(),
        file: place.map(str::to_owned),
        line: place.map(|_| named.line),
    }
}

/// `clay (scene.rts:12)`. Names are a stranger's: nothing in them steers a terminal.
impl fmt::Display for Declared {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&files::escape(&self.name))?;
        match (&self.file, self.line) {
            (Some(file), Some(line)) => write!(f, " ({}:{line})", files::escape(file)),
            _ => Ok(()),
        }
    }
}

/// A line each.
impl fmt::Display for Pick {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([x, y], [w, h]) = (self.pixel, self.image);
        write!(f, "pixel {x},{y} of {w}x{h}")?;
        let Some(surface) = &self.surface else { return write!(f, ": the sky") };
        let part = match (&surface.asset, &surface.part) {
            (Some(_), None) => Some("all of it".to_owned()),
            (_, part) => part.as_deref().map(|part| files::escape(part).into_owned()),
        };
        let rows = [
            ("instance", surface.instance.as_ref().map(Declared::to_string)),
            ("light", surface.light.as_ref().map(Declared::to_string)),
            ("object", surface.object.as_ref().map(Declared::to_string)),
            ("shape", surface.shape.as_ref().map(Declared::to_string)),
            ("asset", surface.asset.as_ref().map(Declared::to_string)),
            ("part", part),
            ("material", surface.material.as_ref().map(Declared::to_string)),
            ("position", Some(format!("{} m", vector(surface.position)))),
            ("distance", Some(format!("{:.5} m", surface.distance))),
            ("normal", Some(vector(surface.normal))),
            ("side", Some(if surface.front { "front" } else { "back" }.to_owned())),
        ];
        for (name, value) in rows {
            if let Some(value) = value {
                write!(f, "\n{name:<9} {value}")?;
            }
        }
        Ok(())
    }
}

/// Without a sign on zeros.
fn vector(v: [f64; 3]) -> String {
    let [x, y, z] = v.map(|x| if x.abs() < 5e-6 { 0.0 } else { x });
    format!("({x:.5}, {y:.5}, {z:.5})")
}
