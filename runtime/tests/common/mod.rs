//! Small packs made by hand: a glass, a metal and a diffuse sphere over a floor, lit by a sphere and
//! by the sky.

#![allow(dead_code, reason = "each test file uses its own part")]

use pack::abi::{
    Camera, ChildRef, Light, LightKind, Material, MaterialKind, NONE, Node, RenderSettings, Sky,
    SkyKind, Sphere, TriShade, Triangle,
};
use pack::{Manifest, Pack, PackWriter};
use runtime::{Film, Scene};
use shaders::FeatureSet;

/// Size of the scene's image.
pub(crate) const SIZE: [u32; 2] = [72, 40];
/// Samples that the scene asks for.
pub(crate) const SPP: u32 = 32;

fn material(kind: MaterialKind, color: [f32; 3]) -> Material {
    Material {
        color,
        kind: kind as u32,
        ior: 1.5,
        ior_minus_1: 0.5,
        alpha: 1.0,
        color_texture: NONE,
        emission_texture: NONE,
        metallic_roughness_texture: NONE,
        alpha_texture: NONE,
        normal_texture: NONE,
        specular_texture: NONE,
        coat_texture: NONE,
        transmission_texture: NONE,
        anisotropy_texture: NONE,
        sheen_texture: NONE,
        medium: NONE,
        ..Material::default()
    }
}

fn sphere(center: [f32; 3], radius: f32, material: u32) -> Sphere {
    Sphere { center, radius, material, light: NONE, ..Sphere::default() }
}

/// The ball on the left.
fn diffuse_ball() -> Sphere {
    sphere([-0.3, -0.15, 0.0], 0.12, 0)
}

/// The kernel that the compiler would link for this scene.
pub(crate) fn features() -> FeatureSet {
    use pack::abi::MaterialKind::{Dielectric, Diffuse, Emissive, Metal};
    FeatureSet {
        triangles: true,
        spheres: true,
        materials: [Diffuse, Metal, Dielectric, Emissive].into(),
        lights: [LightKind::Sphere].into(),
        skies: [SkyKind::Gradient].into(),
        ..FeatureSet::empty()
    }
}

/// The bytes of the pack, with the kernel for `features`.
pub(crate) fn pack_bytes(features: &FeatureSet) -> Vec<u8> {
    let kernel = shaders::link(features).expect("the modules link").text;
    pack_with_kernel(&kernel)
}

/// The bytes of the pack with any kernel.
pub(crate) fn pack_with_kernel(kernel: &str) -> Vec<u8> {
    pack(kernel, None, diffuse_ball())
}

/// The bytes of the pack inside a ball of metal: its paths are many times as long.
pub(crate) fn pack_with_long_paths() -> Vec<u8> {
    let kernel = shaders::link(&features()).expect("the modules link").text;
    pack(&kernel, None, sphere([0.0; 3], 5.0, 1))
}

/// The bytes of the pack that asks for an output.
pub(crate) fn pack_with_output(output: &str) -> Vec<u8> {
    let kernel = shaders::link(&features()).expect("the modules link").text;
    pack(&kernel, Some(output.to_owned()), diffuse_ball())
}

fn pack(kernel: &str, output: Option<String>, ball: Sphere) -> Vec<u8> {
    let materials = [
        material(MaterialKind::Diffuse, [0.7, 0.3, 0.2]),
        Material { fuzz: 0.1, ..material(MaterialKind::Metal, [0.8, 0.8, 0.9]) },
        material(MaterialKind::Dielectric, [1.0; 3]),
        Material { emission: [20.0; 3], ..material(MaterialKind::Emissive, [0.0; 3]) },
        material(MaterialKind::Diffuse, [0.5; 3]),
    ];
    let spheres = [
        ball,
        sphere([0.0, -0.15, 0.0], 0.12, 1),
        sphere([0.3, -0.15, 0.0], 0.12, 2),
        Sphere { light: 0, ..sphere([0.1, 0.5, 0.3], 0.06, 3) },
    ];
    let triangles = floor();
    let shades = [TriShade { material: 4, light: NONE, ..TriShade::default() }; 2];
    let word = |child: ChildRef| child.encode().expect("small references have a word");
    let nodes = [Node {
        left_lo: [-0.43, -0.28, -0.13].map(|x: f32| x.min(-ball.radius)),
        left: word(ChildRef::Spheres { first: 0, count: 4 }),
        left_hi: [0.43, 0.57, 0.37].map(|x: f32| x.max(ball.radius)),
        right: word(ChildRef::Triangles { first: 0, count: 2 }),
        right_lo: [-0.6, -0.27, -0.6],
        right_hi: [0.6, -0.27, 0.6],
        ..Node::default()
    }];
    let lights = [Light {
        origin: [0.1, 0.5, 0.3],
        kind: LightKind::Sphere as u32,
        edge1: [0.06, 0.0, 0.0],
        primitive: 3,
        pmf: 1.0,
        cdf: 1.0,
        material: 3,
        ..Light::default()
    }];
    let ((settings, camera), sky) = (view(), sky());
    let manifest = Manifest { scene: "marbles".to_owned(), output, ..Manifest::default() };
    let mut writer = PackWriter::new();
    writer
        .record(&settings)
        .record(&camera)
        .record(&sky)
        .records(&nodes)
        .records(&triangles)
        .records(&shades)
        .records(&spheres)
        .records(&materials)
        .records(&lights)
        .kernel(kernel)
        .manifest(&manifest)
        .expect("a small manifest");
    writer.to_bytes().expect("the scene keeps the rules")
}

fn floor() -> [Triangle; 2] {
    let corners = [[-0.6, -0.27, -0.6], [0.6, -0.27, -0.6], [0.6, -0.27, 0.6], [-0.6, -0.27, 0.6]];
    [[0_u32, 2, 1], [0, 3, 2]].map(|[id0, id1, id2]| {
        let [v0, v1, v2] = [id0, id1, id2].map(|id| corners[id as usize]);
        Triangle { v0, id0, v1, id1, v2, id2 }
    })
}

fn sky() -> Sky {
    Sky {
        zenith: [0.3, 0.5, 0.9],
        kind: SkyKind::Gradient as u32,
        middle: [0.6, 0.7, 0.9],
        blend_high: 0.4,
        horizon: [0.8, 0.8, 0.8],
        blend_low: -0.1,
        ground: [0.2; 3],
        glow_power: 8.0,
        sun_direction: [0.0, 1.0, 0.0],
        disc_power: 256.0,
        texture: NONE,
        light: NONE,
        ..Sky::default()
    }
}

fn view() -> (RenderSettings, Camera) {
    let settings = RenderSettings {
        image_size: SIZE,
        samples: SPP,
        max_depth: 12,
        roulette_depth: 3,
        seed: 7,
        root: ChildRef::Inner(0).encode().expect("small references have a word"),
        stack_need: 1,
        // The halves of the f64 1.0.
        scale_bits: [0, 0x3ff0_0000],
        n_lights: 1,
        air: NONE,
        fog: NONE,
        inside: [NONE; 4],
        ..RenderSettings::default()
    };
    let camera = Camera {
        origin: [0.0, 0.1, 0.9],
        right: [1.0, 0.0, 0.0],
        half_height: 0.3,
        up: [0.0, 1.0, 0.0],
        focus_distance: 1.0,
        forward: [0.0, 0.0, -1.0],
        half_width: 0.54,
        ..Camera::default()
    };
    (settings, camera)
}

/// The scene.
pub(crate) fn scene() -> Scene {
    Scene::new(Pack::from_bytes(pack_bytes(&features())).expect("the scene keeps the rules"))
}

/// Panics, with the first difference, unless both films are the same bit for bit.
pub(crate) fn assert_same(a: &Film, b: &Film) {
    assert_eq!((a.image_size, a.region, &a.ranges), (b.image_size, b.region, &b.ranges));
    assert_eq!(a.counts, b.counts);
    let bits = |film: &Film, i: usize| film.sums[i].map(f64::to_bits);
    let differ = |i: &usize| bits(a, *i) != bits(b, *i);
    let different: Vec<usize> = (0..a.sums.len()).filter(differ).collect();
    if let Some(&i) = different.first() {
        let (n, all) = (different.len(), a.sums.len());
        panic!("{n} of {all} pixels differ, pixel {i} first: {:?} {:?}", a.sums[i], b.sums[i]);
    }
    assert_eq!(a.counters, b.counters);
}
