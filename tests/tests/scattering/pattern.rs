//! What patterns do to a surface point: the formula of the bumps, their limits, colours, grain.

use glam::{DVec3, Vec3};
use pack::abi::{Material, MaterialKind, Object};
use runtime::kernel::{f32 as single, f64 as double};
use tests::kernel::{Bench, Lobe};
use tests::statistics::Mean;
use tests::statistics::stream::Stream;

const KINDS: [MaterialKind; 3] = [MaterialKind::Stone, MaterialKind::Wood, MaterialKind::Fabric];

/// Height and step that the language takes where the scene says nothing.
fn defaults(kind: MaterialKind) -> (f32, f32) {
    match kind {
        MaterialKind::Stone => (0.04, 0.010),
        MaterialKind::Wood => (0.03, 0.008),
        _ => (0.02, 0.010),
    }
}

fn record(kind: MaterialKind, height: f32) -> Material {
    Material {
        tint: [0.1; 3],
        pattern_scale: 1.0,
        bump_step: defaults(kind).1,
        bump_height: height,
        gloss: 0.06,
        weight: 0.2,
        anisotropy: 0.6,
        ..Lobe::new(kind).record()
    }
}

/// An object that is turned, in a world of half a metre a unit.
fn object() -> Object {
    let turn = glam::DMat3::from_euler(glam::EulerRot::XYZ, 0.4, -1.1, 2.0) * 0.5;
    let row = |k: usize| turn.row(k).as_vec3().to_array();
    Object { row_x: row(0), row_y: row(1), row_z: row(2), ..Object::default() }
}

fn bench(record: Material) -> Bench {
    Bench::new().materials(&[record]).objects(&[object()])
}

/// A surface with the lobe's geometric normal, its own shading normal and material 0.
fn surface(kernel: &mut double::Kernel<'_>, lobe: &Lobe) -> double::Surface {
    kernel.surface_new(DVec3::ZERO, lobe.normal, -lobe.normal, 1.0)
}

/// The field of a kind at `q`.
fn field(kernel: &mut double::Kernel<'_>, kind: MaterialKind, q: DVec3, key: u32) -> f64 {
    match kind {
        MaterialKind::Stone => {
            let bands = kernel.stone_bands(q, 1.0, key);
            kernel.stone_field(bands)
        }
        MaterialKind::Wood => {
            // Grain along y.
            let bands = kernel.wood_bands(q * DVec3::new(1.0, 0.12, 1.0), 1.0, key);
            kernel.wood_field(bands)
        }
        _ => kernel.fabric_field(q, 1.0, key),
    }
}

/// `n' = unit(n - strength / eps P_T (f(q) - f(q - eps e_k)))`, the differences along the object's axes.
#[test]
fn bumps_are_those_of_the_formula() {
    let mut stream = Stream::new(89, 0);
    for kind in KINDS {
        let (height, step) = defaults(kind);
        let bench = bench(record(kind, height));
        let mut kernel = bench.double();
        let mut slopes = Mean::default();
        for k in 0..4000 {
            let q = DVec3::from_array([0; 3].map(|_| stream.between(-30.0, 30.0)));
            let n = stream.direction();
            let lobe = Lobe { normal: n, place: q, fuzz: 1.0 / 6.0, key: k, ..Lobe::new(kind) };
            let mut scatter = lobe.double();
            let at = surface(&mut kernel, &lobe);
            kernel.dispatch_pattern(&mut scatter, at, n);
            let (height, step) = (f64::from(height), f64::from(step));
            let here = field(&mut kernel, kind, q, k);
            let mut slope = DVec3::ZERO;
            for (axis, row) in [object().row_x, object().row_y, object().row_z].iter().enumerate() {
                let d = here - field(&mut kernel, kind, q - DVec3::AXES[axis] * step, k);
                slope += Vec3::from(*row).as_dvec3().normalize() * (d * height / step);
            }
            let truth = (n - (slope - n * n.dot(slope))).normalize();
            assert!((scatter.ns - truth).length() < 1e-6, "{kind:?}: {} {truth}", scatter.ns);
            // The front's bumps are the back's dents.
            let mut back = double::Scatter { ns: -n, ng: -n, front: false, ..lobe.double() };
            kernel.dispatch_pattern(&mut back, at, -n);
            assert!((back.ns + truth).length() < 1e-6, "{kind:?}: {} {truth}", back.ns);
            slopes.add(slope.length_squared() / (height * height));
        }
        // The language warns of bumps by this number.
        let known = match kind {
            MaterialKind::Stone => STONE_SLOPE,
            MaterialKind::Wood => WOOD_SLOPE,
            _ => FABRIC_SLOPE,
        };
        let found = slopes.value().sqrt();
        assert!((found / known - 1.0).abs() < 0.1, "{kind:?}: {found} a metre, not {known}");
    }
}

/// Root mean square of the slope of a field at scale 1, per metre, at the usual step.
const STONE_SLOPE: f64 = 3.3;
const WOOD_SLOPE: f64 = 2.8;
const FABRIC_SLOPE: f64 = 7.9;

/// A slope of a thousand, over shading normals that are not the geometric ones: the normal stays above the
/// surface and towards the eye, no light comes from below, and none is made.
#[test]
fn the_steepest_bumps_make_no_light() {
    for kind in KINDS {
        let bench = bench(Material { weight: 0.0, ..record(kind, 300.0) });
        let mut kernel = bench.single();
        let mut stream = Stream::new(97, kind as u64);
        let mut doubled = bench.double();
        let mut mean = Mean::default();
        for k in 0..40_000_u32 {
            let q = DVec3::from_array([0; 3].map(|_| stream.between(-30.0, 30.0)));
            let lobe = Lobe { place: q, fuzz: 0.5, key: k % 7, ..Lobe::new(kind) };
            let mut scatter = lobe.single();
            scatter.ns = (lobe.normal + stream.direction() * 0.7).normalize().as_vec3();
            let d = stream.direction();
            let wo = (if d.dot(lobe.normal) < 0.0 { -d } else { d }).as_vec3();
            let at = single_surface(&surface(&mut doubled, &lobe));
            kernel.dispatch_pattern(&mut scatter, at, wo);
            let at = format!("{kind:?} {k}: {scatter:?} from {wo}");
            assert!((scatter.ns.length() - 1.0).abs() < 1e-5, "{at}");
            assert!(scatter.ns.dot(scatter.ng) > 0.0 && scatter.ns.dot(wo) >= 0.0, "{at}");
            assert!((0.0..=1.0).contains(&scatter.roughness), "{at}");
            assert!(
                scatter.color.min_element() >= 0.0 && scatter.color.max_element() <= 1.0,
                "{at}"
            );
            // White, so that nothing hides what is made.
            scatter.color = Vec3::ONE;
            let out = kernel.dispatch_sample(scatter, wo, crate::weight::key(5000, k as usize));
            mean.add(f64::from(out.weight.x));
            // A white surface returns everything, so some weights are above 1: by less than the gloss.
            assert!(out.weight.x <= 1.06, "{at}: {out:?}");
            assert!(out.weight.x <= 0.0 || out.wi.dot(scatter.ng) > 0.0, "{at}: {out:?}");
            let below = stream.direction().as_vec3();
            if below.dot(scatter.ng) < 0.0 {
                assert_eq!(kernel.dispatch_eval(scatter, wo, below).f, Vec3::ZERO, "{at}");
            }
        }
        assert!(mean.value() <= 1.0 + 1e-3, "{kind:?}: {}", mean.value());
        assert!(mean.value() > 0.3, "{kind:?}: almost nothing is left: {}", mean.value());
    }
}

#[expect(clippy::cast_possible_truncation, reason = "rounded to the kernel's precision")]
fn single_surface(s: &double::Surface) -> single::Surface {
    single::Surface {
        p: s.p.as_vec3(),
        rest: s.rest.as_vec3(),
        ng: s.ng.as_vec3(),
        horizon: s.horizon.as_vec3(),
        bulge: s.bulge.as_vec3(),
        ns: s.ns.as_vec3(),
        at: single::TexturePoint {
            uv: s.at.uv.as_vec2(),
            w: s.at.w as f32,
            prim: s.at.prim,
            b: s.at.b.as_vec2(),
        },
        ray_offset: s.ray_offset as f32,
        material: s.material,
        light: s.light,
        object: s.object,
        tangent: s.tangent.as_vec3(),
        handed: s.handed as f32,
        front: s.front,
    }
}

/// Without a height the normal is untouched, bit for bit, and the rest of the pattern is the same.
#[test]
fn without_height_there_are_no_bumps() {
    for kind in KINDS {
        let (flat, bumpy) = (bench(record(kind, 0.0)), bench(record(kind, 0.02)));
        let (mut flat, mut bumpy) = (flat.double(), bumpy.double());
        let lobe = Lobe { fuzz: 0.5, ..Lobe::new(kind) };
        let (mut a, mut b) = (lobe.double(), lobe.double());
        let at = surface(&mut flat, &lobe);
        flat.dispatch_pattern(&mut a, at, lobe.normal);
        bumpy.dispatch_pattern(&mut b, at, lobe.normal);
        assert_eq!(a.ns, lobe.normal);
        assert_ne!(b.ns, lobe.normal);
        assert_eq!((a.color, a.roughness), (b.color, b.roughness));
    }
}

/// Roughness and colour stay between the ends that the reference names, use much of the range, and differ from
/// object to object.
#[test]
fn roughness_and_colour_vary_within_their_ends() {
    for (kind, low, high) in [(MaterialKind::Stone, 0.4, 0.75), (MaterialKind::Wood, 0.45, 0.85)] {
        let bench = bench(record(kind, 0.0));
        let mut kernel = bench.double();
        let mut stream = Stream::new(101, 0);
        let (mut rough, mut color) = ((1.0_f64, 0.0_f64), (1.0_f64, 0.0_f64));
        for _ in 0..20_000 {
            let q = DVec3::from_array([0; 3].map(|_| stream.between(-9.0, 9.0)));
            let lobe = Lobe { place: q, color: 0.6, ..Lobe::new(kind) };
            let mut s = lobe.double();
            let at = surface(&mut kernel, &lobe);
            kernel.dispatch_pattern(&mut s, at, lobe.normal);
            rough = (rough.0.min(s.roughness), rough.1.max(s.roughness));
            color = (color.0.min(s.color.x), color.1.max(s.color.x));
        }
        assert!(rough.0 >= low && rough.1 <= high, "{kind:?} {rough:?}");
        assert!(rough.1 - rough.0 > 0.3 * (high - low), "{kind:?} {rough:?}");
        // Between the second colour, 0.1, and the first, 0.6.
        assert!(color.0 >= 0.1 - 1e-6 && color.1 <= 0.6 + 1e-6, "{kind:?} {color:?}");
        assert!(color.0 < 0.25 && color.1 > 0.5, "{kind:?} {color:?}");
        let mut tone = |key| {
            let lobe = Lobe { key, ..Lobe::new(kind) };
            let mut s = lobe.double();
            let at = surface(&mut kernel, &lobe);
            kernel.dispatch_pattern(&mut s, at, lobe.normal);
            s.roughness
        };
        assert_ne!(tone(1), tone(2));
    }
}

/// The three codes are the three axes of the object, as the wood's tangent on the surface shows.
#[test]
fn the_grain_is_an_axis_of_the_object() {
    let bench = bench(record(MaterialKind::Wood, 0.0));
    let mut kernel = bench.double();
    let rows = [object().row_x, object().row_y, object().row_z];
    for (code, axis) in [(0.5, 0), (1.0 / 6.0, 1), (5.0 / 6.0, 2)] {
        let lobe = Lobe { fuzz: code, ..Lobe::new(MaterialKind::Wood) };
        let mut s = lobe.double();
        let at = surface(&mut kernel, &lobe);
        kernel.dispatch_pattern(&mut s, at, lobe.normal);
        let grain = Vec3::from(rows[axis]).as_dvec3().normalize();
        let truth = grain - lobe.normal * lobe.normal.dot(grain);
        assert!((s.tangent - truth).length() < 1e-6, "axis {axis}: {} {truth}", s.tangent);
    }
}
