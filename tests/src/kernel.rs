//! Hand-made records → the generated kernel, in both precisions, so that tests can call any WGSL function.

use crate::layers::Layers;
use bytemuck::Pod;
use compiler::lower::Lowered;
use glam::{DVec2, DVec3, UVec2, UVec4, Vec3};
use pack::abi::{
    Camera, Frame, Light, LightNode, Material, MaterialKind, Medium, NONE, Node, Object,
    SamplerKind, Sky, Sphere, TriShade, Triangle,
};
use runtime::kernel::{f32 as single, f64 as double};

/// What a kernel reads.
#[derive(Clone, Debug)]
pub struct Bench {
    /// Where the heap's tables begin, and the settings of a dispatch.
    pub frame: Frame,
    frame_words: Vec<UVec4>,
    heap: Vec<UVec4>,
    nodes: Vec<UVec4>,
    triangles: Vec<UVec4>,
    shades: Vec<UVec4>,
    spheres: Vec<UVec4>,
}

/// A ray of the world for the kernel in single precision: to the nearest hit, from no surface, when the shutter opens.
#[must_use]
pub fn ray(origin: Vec3, dir: Vec3) -> single::Ray {
    let skip = UVec2::splat(NONE);
    let t_max = single::RAY_FAR;
    single::Ray { origin, t_max, dir, skip, light: NONE, time: 0.0, instance: NONE }
}

/// As [`ray`], in double precision.
#[must_use]
pub fn ray_double(origin: DVec3, dir: DVec3) -> double::Ray {
    let skip = UVec2::splat(NONE);
    let t_max = double::RAY_FAR;
    double::Ray { origin, t_max, dir, skip, light: NONE, time: 0.0, instance: NONE }
}

/// What a ray skips that starts on primitive `prim` of the world.
#[must_use]
pub fn skip(prim: u32) -> UVec2 {
    UVec2::new(prim, NONE)
}

fn words<R: Pod>(records: &[R]) -> Vec<UVec4> {
    bytemuck::pod_collect_to_vec(records)
}

impl Default for Bench {
    fn default() -> Self {
        Self::new()
    }
}

impl Bench {
    /// No geometry, no lights, no sky; one material without textures or layers. Random numbers are
    /// independent, as chi-square tests take them.
    #[must_use]
    pub fn new() -> Self {
        let sampler = SamplerKind::Pcg as u32;
        let frame = Frame {
            sampler,
            root: NONE,
            sky_at: NONE,
            air: NONE,
            fog: NONE,
            inside: [NONE; 4],
            light_tree_at: NONE,
            instance_at: NONE,
            image_size: [64, 64],
            ..Frame::default()
        };
        let none = Vec::new;
        let bench = Self {
            frame,
            frame_words: none(),
            heap: words(&[Material::from(Layers::PLAIN)]),
            nodes: none(),
            triangles: none(),
            shades: none(),
            spheres: none(),
        };
        bench.framed()
    }

    fn framed(mut self) -> Self {
        self.frame_words = words(&[self.frame]);
        self
    }

    fn heap_end(&self) -> u32 {
        u32::try_from(self.heap.len()).expect("tests have small heaps")
    }

    /// With random numbers from `kind`.
    #[must_use]
    pub fn sampler(mut self, kind: SamplerKind) -> Self {
        self.frame.sampler = kind as u32;
        self.framed()
    }

    /// With a table of lights.
    #[must_use]
    pub fn lights(mut self, lights: &[Light]) -> Self {
        self.frame.light_at = self.heap_end();
        self.frame.n_lights = u32::try_from(lights.len()).expect("tests have few lights");
        self.heap.extend(words(lights));
        self.framed()
    }

    /// With a table of materials; a [`Lobe`] is the material with index 0.
    #[must_use]
    pub fn materials(mut self, materials: &[Material]) -> Self {
        self.frame.material_at = self.heap_end();
        self.heap.extend(words(materials));
        self.framed()
    }

    /// With a table of objects.
    #[must_use]
    pub fn objects(mut self, objects: &[Object]) -> Self {
        self.frame.object_at = self.heap_end();
        self.heap.extend(words(objects));
        self.framed()
    }

    /// With a table of media.
    #[must_use]
    pub fn media(mut self, media: &[Medium]) -> Self {
        self.frame.medium_at = self.heap_end();
        self.heap.extend(words(media));
        self.framed()
    }

    /// With a tree over the table of lights.
    #[must_use]
    pub fn light_tree(mut self, nodes: &[LightNode]) -> Self {
        self.frame.light_tree_at = self.heap_end();
        self.heap.extend(words(nodes));
        self.framed()
    }

    /// With a sky and the table by which it is sampled.
    #[must_use]
    pub fn sky(mut self, sky: Sky, table: &[[f32; 4]]) -> Self {
        self.frame.sky_at = self.heap_end();
        self.heap.extend(words(&[sky]));
        self.frame.sky_table_at = self.heap_end();
        self.heap.extend(words(table));
        self.framed()
    }

    /// With the shapes of a compiled scene and what they belong to.
    #[must_use]
    pub fn shapes(self, lowered: &Lowered) -> Self {
        let mut bench = self.objects(&lowered.objects).materials(&lowered.materials);
        bench.frame.instance_at = bench.heap_end();
        bench.heap.extend(words(&lowered.instances));
        bench.nodes = words(&lowered.nodes);
        bench.nodes.extend(words(&lowered.wide_nodes));
        bench.frame.wide = u32::from(!lowered.wide_nodes.is_empty());
        bench.triangles = words(&lowered.triangles);
        bench.shades = words(&lowered.shades);
        bench.spheres = words(&lowered.spheres);
        bench.frame.root = lowered.render.root;
        bench.framed()
    }

    /// With a camera for an image of `size` pixels.
    #[must_use]
    pub fn camera(mut self, camera: Camera, size: [u32; 2]) -> Self {
        self.frame.camera_at = self.heap_end();
        self.frame.image_size = size;
        self.heap.extend(words(&[camera]));
        self.framed()
    }

    /// With triangles, flat, without texture coordinates; the root is a leaf of the first 8 of them.
    #[must_use]
    pub fn triangles(mut self, triangles: &[Triangle]) -> Self {
        let count = u32::try_from(triangles.len().clamp(1, 8)).expect("at most 8");
        self.frame.root = pack::abi::ChildRef::Triangles { first: 0, count }
            .encode()
            .expect("a leaf of at most 8 has a code");
        let shade = TriShade { light: NONE, ..TriShade::default() };
        self.triangles = words(triangles);
        self.shades = words(&vec![shade; triangles.len()]);
        self.framed()
    }

    /// With Russian roulette from vertex `bounce` of a path on.
    #[must_use]
    pub fn roulette_from(mut self, bounce: u32) -> Self {
        self.frame.roulette_depth = bounce;
        self.framed()
    }

    /// With triangles in the leaf order of a tree.
    #[must_use]
    pub fn tree(self, triangles: &[Triangle], nodes: &[Node], root: u32) -> Self {
        let mut bench = self.triangles(triangles);
        bench.nodes = words(nodes);
        bench.frame.root = root;
        bench.framed()
    }

    /// With spheres; the root is a leaf of the first 8 of them.
    #[must_use]
    pub fn spheres(mut self, spheres: &[Sphere]) -> Self {
        let count = u32::try_from(spheres.len().clamp(1, 8)).expect("at most 8");
        self.frame.root = pack::abi::ChildRef::Spheres { first: 0, count }
            .encode()
            .expect("a leaf of at most 8 has a code");
        self.spheres = words(spheres);
        self.framed()
    }

    /// The kernel in single precision.
    #[must_use]
    pub fn single(&self) -> single::Kernel<'_> {
        single::Kernel::new(single::Bindings {
            frame_words: &self.frame_words,
            film_words: &mut [],
            heap_words: &self.heap,
            node_words: &self.nodes,
            tri_words: &self.triangles,
            shade_words: &self.shades,
            sphere_words: &self.spheres,
            texel_words: &[],
        })
    }

    /// The kernel in double precision.
    #[must_use]
    pub fn double(&self) -> double::Kernel<'_> {
        double::Kernel::new(double::Bindings {
            frame_words: &self.frame_words,
            film_words: &mut [],
            heap_words: &self.heap,
            node_words: &self.nodes,
            tri_words: &self.triangles,
            shade_words: &self.shades,
            sphere_words: &self.spheres,
            texel_words: &[],
        })
    }
}

/// Mean reflectance of an interface of index `ior` for diffuse light from within, by quadrature over the
/// square of the cosine.
fn mean_from_within(ior: f64) -> f64 {
    let n = 20_000;
    let e = 1.0 / ior;
    let at = |i: u32| {
        let c = ((f64::from(i) + 0.5) / f64::from(n)).sqrt();
        let g2 = e * e - 1.0 + c * c;
        if g2 <= 0.0 {
            return 1.0;
        }
        let g = g2.sqrt();
        let (s, p) = ((c - g) / (c + g), (e * e * c - g) / (e * e * c + g));
        0.5 * (s * s + p * p)
    };
    (0..n).map(at).sum::<f64>() / f64::from(n)
}

/// A scattering model with its parameters, at a surface with one normal.
#[derive(Clone, Copy, Debug)]
pub struct Lobe {
    /// Which model.
    pub kind: MaterialKind,
    /// Grey reflectance or base colour.
    pub color: f32,
    /// Radius of the metal's ball.
    pub fuzz: f32,
    /// Perceptual roughness.
    pub roughness: f32,
    /// Metallic weight.
    pub metallic: f32,
    /// Refractive index.
    pub ior: f64,
    /// Brushed along the tangent, 0 ..= 1.
    pub anisotropy: f32,
    /// Share of a second lobe; the light of several reflections of a conductor.
    pub weight: f32,
    /// Geometric and shading normal, unit.
    pub normal: DVec3,
    /// The path comes from the front side.
    pub front: bool,
    /// Texture coordinates.
    pub uv: DVec2,
    /// Where in its object, metres.
    pub place: DVec3,
    /// Key of the object.
    pub key: u32,
    /// Share of gloss over a matte base.
    pub gloss: f32,
    /// Sample number, for models that are found by a random walk.
    pub sample: u32,
}

impl Lobe {
    /// A white model of `kind` at a surface of no special direction.
    #[must_use]
    pub fn new(kind: MaterialKind) -> Self {
        Self {
            kind,
            color: 1.0,
            fuzz: 0.0,
            roughness: 0.0,
            metallic: 0.0,
            ior: 1.5,
            anisotropy: 0.0,
            weight: if kind == MaterialKind::Conductor { 1.0 } else { 0.0 },
            normal: DVec3::new(0.36, -0.48, 0.8),
            front: true,
            uv: DVec2::new(0.3, 0.6),
            place: DVec3::new(0.1, -0.7, 0.4),
            key: 0x9e37_79b9,
            gloss: 0.0,
            sample: 0,
        }
    }

    /// The material record, for what models read from it: textures none, second colour white.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once, as the compiler does")]
    pub fn record(&self) -> Material {
        Material {
            color: [self.color; 3],
            kind: self.kind as u32,
            fuzz: self.fuzz,
            roughness: self.roughness,
            metallic: self.metallic,
            ior: self.ior as f32,
            ior_minus_1: (self.ior - 1.0) as f32,
            anisotropy: self.anisotropy,
            weight: self.weight,
            gloss: self.gloss,
            tint: [1.0; 3],
            specular: mean_from_within(self.ior) as f32,
            ..Material::default()
        }
    }

    /// A kernel whose material 0 is this model.
    #[must_use]
    pub fn bench(&self) -> Bench {
        Bench::new().materials(&[self.record()])
    }

    /// A white conductor with compensation.
    #[must_use]
    pub fn conductor(roughness: f32, anisotropy: f32) -> Self {
        Self { roughness, anisotropy, ..Self::new(MaterialKind::Conductor) }
    }

    /// Rough glass, seen from the outside or from within.
    #[must_use]
    pub fn rough_dielectric(roughness: f32, ior: f64, front: bool) -> Self {
        Self { roughness, ior, front, ..Self::new(MaterialKind::RoughDielectric) }
    }

    /// A white base under a coat of index 1.5.
    #[must_use]
    pub fn clearcoat(fuzz: f32) -> Self {
        Self { fuzz, ..Self::new(MaterialKind::Clearcoat) }
    }

    /// The direction in which u grows: some direction at a right angle to the normal.
    #[must_use]
    pub fn tangent(&self) -> DVec3 {
        self.normal.any_orthonormal_vector()
    }

    /// Lambert.
    #[must_use]
    pub fn diffuse() -> Self {
        Self::new(MaterialKind::Diffuse)
    }

    /// A white metal with a ball of radius `fuzz`.
    #[must_use]
    pub fn metal(fuzz: f32) -> Self {
        Self { fuzz, ..Self::new(MaterialKind::Metal) }
    }

    /// A white principled surface of index 1.5.
    #[must_use]
    pub fn principled(roughness: f32, metallic: f32) -> Self {
        Self { roughness, metallic, ..Self::new(MaterialKind::Principled) }
    }

    /// A unit direction at cosine `mu` to the normal, representable in single precision. Unit in
    /// double precision; its cosine is `mu` up to 1e-7.
    #[must_use]
    pub fn at_cosine(&self, mu: f64) -> DVec3 {
        let side = self.normal.any_orthonormal_vector();
        let d = self.normal * mu + side * (1.0 - mu * mu).max(0.0).sqrt();
        d.as_vec3().as_dvec3().normalize()
    }

    /// `wo` mirrored at the normal.
    #[must_use]
    pub fn mirror(&self, wo: DVec3) -> DVec3 {
        (self.normal * (2.0 * self.normal.dot(wo)) - wo).normalize()
    }

    /// For the kernel in single precision.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once, as the compiler does")]
    pub fn single(&self) -> single::Scatter {
        single::Scatter {
            ng: self.normal.as_vec3(),
            ns: self.normal.as_vec3(),
            color: Vec3::splat(self.color),
            kind: self.kind as u32,
            material: 0,
            tangent: self.tangent().as_vec3(),
            handed: 1.0,
            uv: self.uv.as_vec2(),
            place: single::Place { q: self.place.as_vec3(), key: self.key },
            fuzz: self.fuzz,
            roughness: self.roughness,
            metallic: self.metallic,
            ior: self.ior as f32,
            ior_minus_1: (self.ior - 1.0) as f32,
            front: self.front,
            key: single::SampleKey { pixel: 0, sample: self.sample, bounce: 0, seed: 7 },
        }
    }

    /// For the kernel in double precision.
    #[must_use]
    pub fn double(&self) -> double::Scatter {
        double::Scatter {
            ng: self.normal,
            ns: self.normal,
            color: DVec3::splat(f64::from(self.color)),
            kind: self.kind as u32,
            material: 0,
            tangent: self.tangent(),
            handed: 1.0,
            uv: self.uv,
            place: double::Place { q: self.place, key: self.key },
            fuzz: f64::from(self.fuzz),
            roughness: f64::from(self.roughness),
            metallic: f64::from(self.metallic),
            ior: self.ior,
            ior_minus_1: self.ior - 1.0,
            front: self.front,
            key: double::SampleKey { pixel: 0, sample: self.sample, bounce: 0, seed: 7 },
        }
    }
}
