//! Where on the film and on the lens camera rays go.

use glam::{UVec2, Vec2, Vec3};
use pack::abi::Camera;
use tests::kernel::Bench;
use tests::statistics::{Counts, index};

use crate::{N, check, corners, key};

/// Lens radii.
const RADII: [f32; 2] = [0.25, 1e-3];

/// Chi-square tests here.
pub(crate) const CHECKS: usize = RADII.len() + 1 + BLADES.len();

/// Counts of blades.
const BLADES: [u32; 3] = [3, 6, 16];

const SIZE: [u32; 2] = [64, 48];
const SIDE: usize = 20;

fn camera(lens_radius: f32, half_width: f32) -> Camera {
    Camera {
        origin: [0.0; 3],
        lens_radius,
        right: [0.8, 0.0, -0.6],
        half_height: half_width * 0.75,
        up: [0.0, 1.0, 0.0],
        focus_distance: 2.5,
        forward: [-0.6, 0.0, -0.8],
        half_width,
        ..Camera::default()
    }
}

fn cell(x: f64, y: f64) -> usize {
    index(x, SIDE) * SIDE + index(y, SIDE)
}

#[test]
fn the_lens_is_filled_evenly_and_focuses() {
    for (i, radius) in RADII.into_iter().enumerate() {
        let camera = camera(radius, 0.5);
        let bench = Bench::new().camera(camera, SIZE);
        let mut kernel = bench.single();
        let loaded = kernel.load_camera();
        let at = Vec2::new(13.25, 40.5);
        let focus = (kernel.film_plane_point(loaded, at) * camera.focus_distance).as_dvec3();
        let mut counts = Counts::uniform(SIDE * SIDE, N);
        for k in 0..N {
            let ray = kernel.dispatch_camera(key(2000 + i, k), at);
            let x = f64::from(ray.origin.dot(camera.right.into()) / radius);
            let y = f64::from(ray.origin.dot(camera.up.into()) / radius);
            counts.add(cell(x * x + y * y, y.atan2(x) / std::f64::consts::TAU + 0.5));
            let (o, d) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
            let off = (focus - o).cross(d.normalize()).length();
            assert!(off < 1e-6, "a ray passes the point of focus at {off}");
        }
        check(&format!("lens of radius {radius}"), &counts);
    }
}

/// A polygon of the area of the lens, with a corner where `blade_rotation` says.
#[test]
fn blades_are_filled_evenly() {
    for (i, blades) in BLADES.into_iter().enumerate() {
        let turn = std::f64::consts::TAU / f64::from(blades);
        // Any size will do.
        let reach = 1.25;
        let rotation = 0.07;
        let camera = Camera {
            blades,
            blade_rotation: rotation,
            blade_reach: reach as f32,
            ..camera(0.25, 0.5)
        };
        let bench = Bench::new().camera(camera, SIZE);
        let mut kernel = bench.single();
        let mut counts = Counts::uniform(SIDE * SIDE, N);
        for k in 0..N {
            let ray = kernel.dispatch_camera(key(2400 + i, k), Vec2::new(13.25, 40.5));
            let x = f64::from(ray.origin.dot(camera.right.into())) / 0.25;
            let y = f64::from(ray.origin.dot(camera.up.into())) / 0.25;
            // Clockwise from the corner at the top.
            let from_corner = (x.atan2(y) - f64::from(rotation) * std::f64::consts::TAU)
                .rem_euclid(std::f64::consts::TAU);
            let (side, within) = ((from_corner / turn).floor(), from_corner.rem_euclid(turn));
            // The share of the triangle that is nearer to the middle, and of its side that is before the point.
            let middle = within - 0.5 * turn;
            let apothem = reach * (0.5 * turn).cos();
            let radius = (x * x + y * y).sqrt() * middle.cos() / apothem;
            let along = 0.5 + 0.5 * middle.tan() / (0.5 * turn).tan();
            assert!(radius < 1.0 + 1e-5, "{blades}: {x} {y}");
            counts.add(cell(radius * radius, (side + along) / f64::from(blades)));
        }
        check(&format!("{blades} blades"), &counts);
    }
}

/// The filter is the pixel's own square.
#[test]
fn the_pixel_is_filled_evenly() {
    let camera = camera(0.0, 0.5);
    let bench = Bench::new().camera(camera, SIZE);
    let mut kernel = bench.single();
    let mut counts = Counts::uniform(SIDE * SIDE, N);
    let pixel = UVec2::new(17, 31);
    for k in 0..N {
        let path = kernel.path_begin(key(2100, k), pixel);
        let d = path.dir.as_dvec3();
        let axis = |v: [f32; 3]| d.dot(Vec3::from(v).as_dvec3());
        let depth = axis(camera.forward);
        let x = axis(camera.right) / depth / f64::from(camera.half_width);
        let y = axis(camera.up) / depth / f64::from(camera.half_height);
        let x = (x + 1.0) * 0.5 * f64::from(SIZE[0]) - f64::from(pixel.x);
        let y = (1.0 - y) * 0.5 * f64::from(SIZE[1]) - f64::from(pixel.y);
        let inside = -1e-4..1.0 + 1e-4;
        assert!(inside.contains(&x) && inside.contains(&y), "{x} {y}");
        counts.add(cell(x, y));
    }
    check("pixel", &counts);
}

#[test]
fn extreme_cameras_have_unit_directions() {
    // Half of 1e-3 degrees and of 179.9 degrees.
    for half in [0.0005_f64.to_radians(), 89.95_f64.to_radians()] {
        for radius in [0.0, 1e-6, 0.5] {
            let camera = camera(radius, half.tan() as f32);
            let bench = Bench::new().camera(camera, SIZE);
            let mut kernel = bench.single();
            for k in 0..64 {
                for at in corners().map(|u| u * Vec2::new(64.0, 48.0)) {
                    let ray = kernel.dispatch_camera(key(2200, k), at);
                    assert!((ray.dir.length() - 1.0).abs() < 1e-6, "{half} {radius}: {ray:?}");
                    assert!(ray.origin.is_finite());
                }
            }
        }
    }
}
