//! `fit = NAME` of a camera: the place from which an instance just fits into the image: a sphere, else boxes around it.
//!
//! The way that the camera looks is given, so this is exact: each edge of the image bounds how near the camera may
//! come, and where it may be across. It does not know files: boxes come from what is known of them.

use glam::DVec3;
use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{Camera, Fit, Instance, Lens, MIN_UP_SINE, Projection, Scene, Side};

use super::bounds::{Bounds, ball, corners};
use crate::import::MeshFacts;

/// Share of half the image that a thing fills.
const FILLED: f64 = 0.95;

/// The scene with its camera where it is to be; `None` where that frames nothing. Faults go to `diagnostics`.
pub fn framed(
    scene: &Scene,
    assets: &[MeshFacts],
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Scene> {
    let fit = scene.camera.fit.as_ref()?;
    let shown = scene.instances.iter().filter(|instance| fit.frames(&instance.name.text));
    let balls: Vec<Ball> = shown.flat_map(|instance| balls(instance, assets)).collect();
    match camera(&scene.camera, fit, &balls) {
        Ok(camera) => Some(Scene { camera, ..scene.clone() }),
        Err(error) => {
            diagnostics.push(*error);
            None
        }
    }
}

/// A sphere, or a point.
#[derive(Clone, Copy)]
struct Ball {
    center: DVec3,
    radius: f64,
}

/// What must be in the image for all of an instance to be.
fn balls(instance: &Instance, assets: &[MeshFacts]) -> Vec<Ball> {
    let of = |center: [f64; 3], radius| Ball { center: center.into(), radius };
    match ball(instance) {
        Some((center, radius)) => vec![of(center, radius)],
        None => corners(instance, assets).into_iter().map(|corner| of(corner, 0.0)).collect(),
    }
}

fn camera(camera: &Camera, fit: &Fit, balls: &[Ball]) -> Result<Camera, Box<Diagnostic>> {
    let (name, at) = (&fit.instance.text, fit.instance.span);
    let boxes = balls.iter().filter_map(|ball| Bounds::of_sphere(ball.center.into(), ball.radius));
    let Some(bounds) = Bounds::union(boxes) else {
        let text = format!("the camera cannot frame `{name}`, which is not in the world");
        let error = Diagnostic::error(Code("E0713"), text)
            .at(at, "nothing to frame")
            .with_help("name an `instance` that is in the world; `rtc show --bounds` lists them");
        return Err(Box::new(error));
    };
    let (from, middle) = (DVec3::from(camera.from), DVec3::from(bounds.middle()));
    let way = match fit.side {
        Side::Along => DVec3::from(camera.to) - from,
        Side::From => middle - from,
    };
    let degenerate = |text: &str, label: &str| {
        Box::new(Diagnostic::error(Code("E0704"), text).at(at, label.to_owned()))
    };
    let Some(forward) = way.try_normalize() else {
        return Err(degenerate(
            "the camera is in the middle of what it frames",
            "say from which side with `from`",
        ));
    };
    let right = forward.cross(DVec3::from(camera.up).normalize_or_zero());
    if right.length() < MIN_UP_SINE {
        return Err(degenerate("the camera looks along its own `up`", "from above or below"));
    }
    let right = right.normalize();
    let up = right.cross(forward);
    let seen: Vec<Ball> = balls
        .iter()
        .map(|Ball { center, radius }| (*center - middle, *radius))
        .map(|(p, radius)| {
            let center = DVec3::new(p.dot(right), p.dot(up), p.dot(forward));
            Ball { center, radius }
        })
        .collect();
    // In front of the camera, too, and never at it.
    let depth = seen.iter().fold(0.0, |most: f64, ball| most.max(ball.radius - ball.center.z));
    let size = (DVec3::from(bounds.hi) - DVec3::from(bounds.lo)).length();
    let Placed { distance, across, projection } =
        placed(&camera.projection, fit, &seen, depth + 1e-3 * size);
    if size <= 0.0 || !distance.is_finite() {
        let text = format!("the camera cannot frame `{name}`, which has no size");
        return Err(Box::new(Diagnostic::error(Code("E0713"), text).at(at, "a point")));
    }
    let center = middle + right * across[0] + up * across[1];
    Ok(Camera {
        fit: None,
        from: (center - forward * distance).into(),
        to: center.into(),
        projection,
        ..camera.clone()
    })
}

/// Where a camera is that sees all balls, and what it sees.
struct Placed {
    /// From the middle, along the view.
    distance: f64,
    /// From the middle, to the right and up.
    across: [f64; 2],
    projection: Projection,
}

/// `nearest`: the least distance at which the balls are in front of the camera.
fn placed(projection: &Projection, fit: &Fit, seen: &[Ball], nearest: f64) -> Placed {
    match projection {
        Projection::Perspective(lens) => {
            let half = [lens.fov_horizontal, lens.fov_vertical]
                .map(|angle| FILLED * libm::tan(0.5 * angle));
            let across = [0, 1].map(|axis| between(seen, axis, half[axis]));
            let distance = across[0].0.max(across[1].0).max(nearest);
            let focus_distance = if fit.has_focus { lens.focus_distance } else { distance };
            let projection = Projection::Perspective(Lens { focus_distance, ..lens.clone() });
            Placed { distance, across: across.map(|(_, across)| across), projection }
        }
        Projection::Orthographic { size, aspect } => {
            let ends = [0, 1].map(|axis| ends(seen, axis));
            let [width, height] = ends.map(|[low, high]| (high - low) / FILLED);
            let width = width.max(height / aspect);
            let size = size.unwrap_or([width, width * aspect]);
            Placed {
                distance: nearest,
                across: ends.map(|[low, high]| 0.5 * (low + high)),
                projection: Projection::Orthographic { size: Some(size), aspect: *aspect },
            }
        }
        // It sees all around; the language lets it frame nothing.
        Projection::Panoramic { .. } => {
            Placed { distance: nearest, across: [0.0; 2], projection: projection.clone() }
        }
    }
}

/// Where the balls end, along one axis.
fn ends(balls: &[Ball], axis: usize) -> [f64; 2] {
    let most = |sign: f64| {
        let reach = |ball: &Ball| sign * ball.center[axis] + ball.radius;
        balls.iter().map(reach).fold(f64::NEG_INFINITY, f64::max)
    };
    [-most(-1.0), most(1.0)]
}

/// How far from the middle a camera must be for all balls to be between two edges of the image, and how far across
/// it is then. A point at `x` across and `z` behind the middle is if |x - across| <= (distance + z) half; a sphere
/// if that holds with its radius to spare, at a right angle to the plane through the edge.
fn between(balls: &[Ball], axis: usize, half: f64) -> (f64, f64) {
    let slant = (1.0 + half * half).sqrt();
    let most = |sign: f64| {
        balls.iter().fold(f64::NEG_INFINITY, |most, Ball { center, radius }| {
            most.max(sign * center[axis] - half * center.z + radius * slant)
        })
    };
    let (high, low) = (most(1.0), most(-1.0));
    ((high + low) / (2.0 * half), (high - low) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lang::source::{LoadError, Loader};

    /// A scene that imports nothing.
    struct Alone;

    impl Loader for Alone {
        fn load(&mut self, _: &str, _: &str) -> Result<(String, String), LoadError> {
            Err(LoadError::NotFound)
        }
    }

    /// A beam, lying askew far from the origin, seen by this camera.
    fn scene(camera: &str, film: &str) -> Scene {
        let text = format!(
            "rts 1
sky s: constant {{ }}
material m: diffuse {{ color = linear(0.5) }}
instance beam {{ shape = box(size: (4, 1, 0.5)m), material = m, rotate = (20, 30, 40)deg, at = (100, 7, -30)m }}
instance other {{ shape = sphere(radius: 1m), material = m }}
camera c: perspective {{ fit = beam, {camera} }}
film f {{ size = {film} }}
render r: path {{ camera = c }}
"
        );
        let analysis = lang::analyze("a.rts", &text, &mut Alone, &lang::Options::default());
        analysis.scene.unwrap_or_else(|| panic!("{:?}", analysis.diagnostics))
    }

    #[test]
    fn a_framed_thing_just_fits() {
        for (camera, film) in [
            ("", "(640, 360)px"),
            ("", "(100, 900)px"),
            ("from = (100, 90, 70)m", "(640, 360)px"),
            ("from = (0, 0, 0)m, to = (-1, 3, 0)m, fov.vertical = 120deg", "(64, 64)px"),
            ("up = (0, 0, 1), lens = 200mm, focus = 3m", "(640, 360)px"),
        ] {
            let scene = scene(camera, film);
            let framed = framed(&scene, &[], &mut Vec::new()).expect("a camera").camera;
            let (from, to) = (DVec3::from(framed.from), DVec3::from(framed.to));
            let forward = (to - from).normalize();
            let right = forward.cross(DVec3::from(framed.up)).normalize();
            let up = right.cross(forward);
            let Projection::Perspective(lens) = &framed.projection else { panic!("{framed:?}") };
            let edge = [lens.fov_horizontal, lens.fov_vertical].map(|a| libm::tan(0.5 * a));
            let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
            for corner in corners(&scene.instances[0], &[]) {
                let p = DVec3::from(corner) - from;
                assert!(p.dot(forward) > 0.0, "{camera}: a corner is behind the camera");
                for (k, axis) in [right, up].iter().enumerate() {
                    let at = p.dot(*axis) / (p.dot(forward) * edge[k]);
                    ends[k] = [ends[k][0].min(at), ends[k][1].max(at)];
                }
            }
            // It touches both margins of one axis, and is within those of the other.
            let reach = ends.map(|[low, high]| (-low).max(high));
            assert!(reach.iter().all(|reach| *reach <= FILLED + 1e-9), "{camera}: {ends:?}");
            let touches = |[low, high]: [f64; 2]| (high - low - 2.0 * FILLED).abs() < 1e-9;
            assert!(ends.into_iter().any(touches), "{camera}: {ends:?}");
            let distance = (to - from).length();
            let focus = if camera.contains("focus") { 3.0 } else { distance };
            assert!((lens.focus_distance - focus).abs() < 1e-9, "{camera}");
        }
    }

    #[test]
    fn parallel_rays_see_just_what_they_frame() {
        for (film, seen) in
            [("(640, 360)px", None), ("(100, 900)px", None), ("(640, 360)px", Some([32.0, 18.0]))]
        {
            let mut scene = scene("", film);
            scene.camera.projection = Projection::Orthographic {
                size: seen,
                aspect: f64::from(scene.film.size[1]) / f64::from(scene.film.size[0]),
            };
            let framed = framed(&scene, &[], &mut Vec::new()).expect("a camera").camera;
            let Projection::Orthographic { size: Some(size), .. } = framed.projection else {
                panic!("{framed:?}")
            };
            let (from, to) = (DVec3::from(framed.from), DVec3::from(framed.to));
            let forward = (to - from).normalize();
            let right = forward.cross(DVec3::from(framed.up)).normalize();
            let axes = [right, right.cross(forward)];
            let mut most: [f64; 2] = [0.0; 2];
            for corner in corners(&scene.instances[0], &[]) {
                let p = DVec3::from(corner) - from;
                assert!(p.dot(forward) > 0.0, "{film}: a corner is behind the camera");
                for (k, axis) in axes.iter().enumerate() {
                    most[k] = most[k].max((p.dot(*axis) / (0.5 * size[k])).abs());
                }
            }
            let reach = most[0].max(most[1]);
            match seen {
                None => assert!((reach - FILLED).abs() < 1e-9, "{film} {size:?}: {most:?}"),
                Some(seen) => assert_eq!(size.map(f64::to_bits), seen.map(f64::to_bits)),
            }
        }
    }

    #[test]
    fn points_touch_both_edges() {
        let points = [DVec3::new(-1.0, 0.0, 0.0), DVec3::new(2.0, 0.0, 3.0)];
        let balls = points.map(|center| Ball { center, radius: 0.0 });
        let (distance, across) = between(&balls, 0, 0.5);
        for (p, side) in points.iter().zip([-1.0, 1.0]) {
            assert!((p.x - across - side * (distance + p.z) * 0.5).abs() < 1e-12);
        }
        // A sphere alone is in the middle, and touches the planes through both edges.
        let (distance, across) = between(&[Ball { center: DVec3::X, radius: 2.0 }], 0, 0.75);
        assert!((across - 1.0).abs() < 1e-12 && (distance * 0.6 - 2.0).abs() < 1e-12);
    }
}
