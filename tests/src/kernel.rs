//! Hand-made records → the generated kernel, in both precisions, so that tests can call any WGSL function.

mod lobe;

use crate::layers::Layers;
use bytemuck::Pod;
use compiler::lower::Lowered;
use glam::{DVec3, UVec2, UVec4, Vec3};
use pack::abi::{
    AlbedoTable, Camera, Frame, Light, LightNode, Material, Medium, NONE, Node, Object,
    SamplerKind, Sky, Sphere, TriShade, Triangle,
};
use runtime::kernel::{f32 as single, f64 as double};

pub use lobe::Lobe;

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
    texels: Vec<UVec4>,
}

/// A ray of the world for the kernel in single precision: to the nearest hit, from no surface, when the shutter opens.
#[must_use]
pub fn ray(origin: Vec3, dir: Vec3) -> single::Ray {
    let skip = UVec2::splat(NONE);
    let t_max = single::RAY_FAR;
    single::Ray {
        origin,
        t_max,
        t_min: 0.0,
        last: skip,
        dir,
        skip,
        light: NONE,
        time: 0.0,
        instance: NONE,
        key: single::SampleKey { pixel: 0, sample: 0, bounce: 0, seed: 0 },
    }
}

/// As [`ray`], in double precision.
#[must_use]
pub fn ray_double(origin: DVec3, dir: DVec3) -> double::Ray {
    let skip = UVec2::splat(NONE);
    let t_max = double::RAY_FAR;
    double::Ray {
        origin,
        t_max,
        t_min: 0.0,
        last: skip,
        dir,
        skip,
        light: NONE,
        time: 0.0,
        instance: NONE,
        key: double::SampleKey { pixel: 0, sample: 0, bounce: 0, seed: 0 },
    }
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
            link_at: NONE,
            vertex_color_at: NONE,
            path_at: NONE,
            camera_key_at: NONE,
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
            texels: none(),
        };
        bench.albedo()
    }

    /// With every table of directional albedo.
    fn albedo(mut self) -> Self {
        let tables = AlbedoTable::ALL.map(|of| {
            let at = self.heap_end();
            self.heap.extend(words(&compiler::lower::albedo::table(of)));
            at
        });
        (self.frame.albedo_at, self.frame.albedo_more_at) = Frame::albedo_places(tables);
        self.framed()
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

    /// With the textures of a compiled scene.
    #[must_use]
    pub fn textures(mut self, lowered: &Lowered) -> Self {
        self.frame.texture_at = self.heap_end();
        self.heap.extend(words(&lowered.textures));
        self.frame.srgb_at = self.heap_end();
        self.heap.extend(words(&compiler::lower::srgb_table()));
        self.texels = words(&lowered.texels);
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
            texel_words: &self.texels,
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
            texel_words: &self.texels,
        })
    }
}
