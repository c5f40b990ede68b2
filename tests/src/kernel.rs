//! Hand-made records → the generated kernel, in both precisions, so that tests can call any WGSL function.

use bytemuck::Pod;
use glam::{DVec2, DVec3, UVec4, Vec3};
use pack::abi::{
    Camera, Frame, Light, Material, MaterialKind, NONE, Node, Object, Sphere, TriShade, Triangle,
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

fn words<R: Pod>(records: &[R]) -> Vec<UVec4> {
    bytemuck::pod_collect_to_vec(records)
}

impl Default for Bench {
    fn default() -> Self {
        Self::new()
    }
}

impl Bench {
    /// No geometry, no lights, no sky.
    #[must_use]
    pub fn new() -> Self {
        let frame = Frame { root: NONE, sky_at: NONE, image_size: [64, 64], ..Frame::default() };
        let none = Vec::new;
        let bench = Self {
            frame,
            frame_words: none(),
            heap: none(),
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
    /// Share of a second lobe: translucency.
    pub weight: f32,
    /// How much narrower the lobe is across the tangent.
    pub anisotropy: f32,
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
            normal: DVec3::new(0.36, -0.48, 0.8),
            front: true,
            uv: DVec2::new(0.3, 0.6),
            place: DVec3::new(0.1, -0.7, 0.4),
            key: 0x9e37_79b9,
            gloss: 0.0,
            weight: 0.0,
            anisotropy: 0.0,
        }
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

    /// The material that its functions read: index 0 of a bench.
    #[must_use]
    pub fn record(&self) -> Material {
        Material {
            kind: self.kind as u32,
            gloss: self.gloss,
            weight: self.weight,
            anisotropy: self.anisotropy,
            ..Material::default()
        }
    }

    /// A bench with its material.
    #[must_use]
    pub fn bench(&self) -> Bench {
        Bench::new().materials(&[self.record()])
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
        }
    }
}
