//! A small valid pack with everything in it, and a way to break it and seal it again.
//!
//! Offsets are written here as the format publishes them, independently of the crate's own structs.

#![allow(dead_code, reason = "each test file uses its part")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are tests")]

pub(crate) mod sound;

use pack::abi::{
    AlbedoTable, Camera, CameraKey, ChildRef, Instance, LIGHT_LEAF, Light, LightKind, LightLink,
    LightNode, MOVES, Material, MaterialKind, Medium, MotionPiece, NONE, Node, OBJECT_OF_INSTANCE,
    Object, RenderSettings, Sky, SkyKind, Sphere, TRI_SMOOTH, Texture, TextureFormat, TextureOp,
    TextureOpKind, ToneMap, TriShade, Triangle, VertexColors, WideNode, Wrap, f64_bits,
    material_flag,
};
use pack::manifest::Named;
use pack::{Kind, Manifest, PackWriter};

/// Everything that goes into the example.
pub(crate) struct Scene {
    pub(crate) render: RenderSettings,
    pub(crate) camera: Camera,
    pub(crate) sky: Option<Sky>,
    pub(crate) nodes: Vec<Node>,
    pub(crate) wide_nodes: Vec<WideNode>,
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) shades: Vec<TriShade>,
    pub(crate) vertex_colors: Vec<VertexColors>,
    pub(crate) spheres: Vec<Sphere>,
    pub(crate) materials: Vec<Material>,
    pub(crate) objects: Vec<Object>,
    pub(crate) links: Vec<LightLink>,
    pub(crate) motion: Vec<MotionPiece>,
    pub(crate) camera_keys: Vec<CameraKey>,
    pub(crate) instances: Vec<Instance>,
    pub(crate) media: Vec<Medium>,
    pub(crate) lights: Vec<Light>,
    pub(crate) light_nodes: Vec<LightNode>,
    pub(crate) textures: Vec<Texture>,
    pub(crate) texels: Vec<[u32; 4]>,
    pub(crate) srgb: Option<[f32; 256]>,
    pub(crate) sky_table: Vec<[f32; 4]>,
    pub(crate) albedo: Vec<[f32; 4]>,
    pub(crate) kernel: String,
    pub(crate) manifest: Option<Manifest>,
}

/// Maps a file of a test.
pub(crate) fn map(path: &std::path::Path) -> Result<pack::Pack, pack::PackError> {
    #[expect(unsafe_code, reason = "tests of mapped files map files")]
    // SAFETY: what writes to the file meanwhile is the test, of what becomes of the numbers in it.
    unsafe {
        pack::Pack::map(path)
    }
}

/// From a file into memory.
pub(crate) type Way = fn(&std::path::Path) -> Result<pack::Pack, pack::PackError>;

/// Every way from a file into memory.
pub(crate) const WAYS: [Way; 2] = [map, |path| pack::Pack::read(path)];

pub(crate) fn inner(index: u32) -> u32 {
    ChildRef::Inner(index).encode().unwrap()
}

pub(crate) fn triangles(first: u32, count: u32) -> u32 {
    ChildRef::Triangles { first, count }.encode().unwrap()
}

pub(crate) fn spheres(first: u32, count: u32) -> u32 {
    ChildRef::Spheres { first, count }.encode().unwrap()
}

pub(crate) fn instance(index: u32) -> u32 {
    ChildRef::Instance(index).encode().unwrap()
}

/// A node whose boxes are both the cube from -1 to 1.
pub(crate) fn node(left: u32, right: u32) -> Node {
    Node {
        left_lo: [-1.0; 3],
        left,
        left_hi: [1.0; 3],
        right,
        right_lo: [-1.0; 3],
        right_hi: [1.0; 3],
        ..Node::default()
    }
}

/// A wide node whose boxes are all the cube from -1 to 1 on its grid; `NONE` for no child.
pub(crate) fn wide_node(children: [u32; 4]) -> WideNode {
    let ends = children.map(|word| if word == NONE { [255, 0] } else { [0, 128] });
    let word = |end: usize| u32::from_le_bytes(ends.map(|ends| ends[end]));
    let [child0, child1, child2, child3] = children;
    WideNode {
        origin: [-1.0; 3],
        child0,
        scale: [1.0 / 64.0; 3],
        child1,
        lo: [word(0); 3],
        child2,
        hi: [word(1); 3],
        child3,
    }
}

fn material(kind: MaterialKind) -> Material {
    Material {
        color: [0.5, 0.25, 0.125],
        kind: kind as u32,
        fuzz: 0.1,
        roughness: 0.5,
        ior: 1.5,
        ior_minus_1: 0.5,
        alpha: 1.0,
        bump_step: 0.01,
        color_texture: NONE,
        emission_texture: NONE,
        metallic_roughness_texture: NONE,
        alpha_texture: NONE,
        normal_texture: NONE,
        medium: NONE,
        specular_texture: NONE,
        coat_texture: NONE,
        transmission_texture: NONE,
        anisotropy_texture: NONE,
        sheen_texture: NONE,
        ..Material::default()
    }
}

/// Those of three images, and an expression: red of the first image, times a colour.
fn texels() -> Vec<[u32; 4]> {
    let op =
        |kind: TextureOpKind, arg| TextureOp { kind: kind as u32, arg, ..TextureOp::default() };
    let place = TextureOp { p: [1.0, 0.0, 0.0, 1.0], ..op(TextureOpKind::Image, 0) };
    let color = TextureOp { p: [0.5, 0.25, 0.125, 1.0], ..op(TextureOpKind::Constant, 0) };
    let ops = [place, color, op(TextureOpKind::Multiply, 0)];
    let images = [[0x3c00_3800; 4]; 5];
    images.into_iter().chain([[0; 4]]).chain(ops.iter().flat_map(TextureOp::words)).collect()
}

fn texture(format: TextureFormat, size: [u32; 2], offset: u32) -> Texture {
    Texture {
        width: size[0],
        height: size[1],
        format: format as u32,
        offset,
        wrap_u: Wrap::Clamp as u32,
        wrap_v: Wrap::Mirror as u32,
        ..Texture::default()
    }
}

pub(crate) fn render() -> RenderSettings {
    RenderSettings {
        image_size: [64, 32],
        samples: 16,
        max_depth: 8,
        roulette_depth: 3,
        seed: 7,
        exposure: -0.5,
        tone_map: ToneMap::Aces as u32,
        root: inner(0),
        stack_need: 2,
        scale_bits: f64_bits(0.125),
        center_x_bits: f64_bits(1e6),
        center_y_bits: f64_bits(0.0),
        center_z_bits: f64_bits(-3.5),
        n_lights: 3,
        air: NONE,
        fog: 0,
        inside: [NONE; 4],
        ..RenderSettings::default()
    }
}

pub(crate) fn camera() -> Camera {
    Camera {
        origin: [0.0, 0.0, 3.0],
        lens_radius: 0.01,
        right: [1.0, 0.0, 0.0],
        half_height: 0.5,
        up: [0.0, 1.0, 0.0],
        focus_distance: 3.0,
        forward: [0.0, 0.0, -1.0],
        half_width: 1.0,
        ..Camera::default()
    }
}

fn sky() -> Sky {
    Sky {
        zenith: [0.1, 0.2, 0.4],
        kind: SkyKind::Gradient as u32,
        middle: [0.3; 3],
        blend_high: 0.4,
        horizon: [0.5; 3],
        blend_low: -0.1,
        ground: [0.1; 3],
        glow_power: 32.0,
        sun_direction: [0.0, 1.0, 0.0],
        disc_power: 4000.0,
        glow: [1.0; 3],
        blend_ground: -0.6,
        disc: [90.0; 3],
        texture: NONE,
        light: NONE,
        ..Sky::default()
    }
}

fn materials() -> Vec<Material> {
    let mut materials: Vec<Material> = MaterialKind::ALL.into_iter().map(material).collect();
    materials[0].color_texture = 0;
    materials[2].medium = 0;
    materials[2].flags = material_flag::INTERIOR | material_flag::THROUGH;
    materials[3].emission = [4.0; 3];
    materials[3].flags = material_flag::EMIT_BOTH_SIDES;
    materials[3].emission_texture = 2;
    materials[2].normal_texture = 1;
    materials[4].metallic_roughness_texture = 1;
    materials[4].alpha_texture = 0;
    materials[4].normal_texture = 1;
    materials[4].flags = material_flag::ALPHA_CLIP
        | material_flag::TANGENT
        | material_flag::OBJECT
        | material_flag::THROUGH;
    materials[4].alpha_cutoff = 0.5;
    materials[4].normal_texture = 1;
    materials[4].specular = 0.5;
    materials[4].coat = 0.5;
    materials[4].transmission = 0.5;
    materials[4].anisotropy = 0.5;
    materials
}

fn lights() -> Vec<Light> {
    let light = |kind: LightKind, primitive: u32, pmf: f32, cdf: f32| Light {
        kind: kind as u32,
        edge1: [0.1, 0.0, 0.0],
        area: 0.01,
        edge2: [0.0, 0.1, 0.0],
        primitive,
        pmf,
        cdf,
        material: 3,
        ..Light::default()
    };
    vec![
        light(LightKind::Sphere, 2, 0.25, 0.25),
        light(LightKind::Rectangle, 1, 0.5, 0.75),
        light(LightKind::Triangle, 3, 0.25, 1.0),
    ]
}

fn srgb() -> [f32; 256] {
    std::array::from_fn(|byte| byte as f32 / 255.0)
}

pub(crate) fn manifest() -> Manifest {
    Manifest {
        scene: "example".to_owned(),
        rtc_version: "0.1.0".to_owned(),
        files: vec!["example.rts".to_owned()],
        materials: vec![Named { name: "clay".to_owned(), file: 0, line: 4 }],
        counters: vec![("vertices".to_owned(), 12)],
        ..Manifest::default()
    }
}

fn piece([start, end]: [f32; 2]) -> MotionPiece {
    MotionPiece {
        start,
        travel: [0.0, 0.25, 0.0],
        end,
        axis: [0.0, 0.0, 1.0],
        turns: 0.25,
        turn: [0.0, 0.0, 0.0, 1.0],
        ..MotionPiece::default()
    }
}

fn camera_key(time: f32) -> CameraKey {
    CameraKey { time, aim: [0.0, 0.0, 1.0], up: [0.0, 1.0, 0.0], ..CameraKey::default() }
}

impl Scene {
    /// Four triangles, three spheres, eight materials, three lights, three textures, a sky.
    pub(crate) fn full() -> Self {
        let triangle = |at: f32, id: u32| Triangle {
            v0: [at, 0.0, 0.0],
            id0: MOVES | id,
            v1: [at + 0.1, 0.0, 0.0],
            id1: MOVES | (id + 1),
            v2: [at, 0.1, 0.0],
            id2: MOVES | (id + 2),
        };
        let shade = |material: u32, light: u32| TriShade {
            normals: [0x7fff_0000; 3],
            material,
            uv1: [1.0, 0.0],
            uv2: [0.0, 1.0],
            light,
            object: TRI_SMOOTH | 1,
            ..TriShade::default()
        };
        let sphere = |at: f32, material: u32, light: u32| Sphere {
            center: [at, 0.0, 0.0],
            radius: 0.1,
            material,
            light,
            ..Sphere::default()
        };
        Self {
            render: render(),
            camera: camera(),
            sky: Some(sky()),
            wide_nodes: Vec::new(),
            nodes: vec![
                node(inner(1), inner(2)),
                node(triangles(0, 2), triangles(2, 2)),
                node(spheres(0, 1), spheres(1, 2)),
            ],
            triangles: [0, 3, 6, 9].map(|id| triangle(id as f32 / 20.0, id)).to_vec(),
            shades: vec![shade(0, NONE), shade(3, 1), shade(4, NONE), shade(3, 2)],
            vertex_colors: Vec::new(),
            spheres: vec![sphere(-0.5, 1, NONE), sphere(-0.2, 2, NONE), sphere(0.6, 3, 0)],
            materials: materials(),
            objects: vec![
                Object::default(),
                Object { motion: [0.0, 0.25, 0.0], ..Object::default() },
            ],
            links: Vec::new(),
            motion: Vec::new(),
            camera_keys: Vec::new(),
            instances: Vec::new(),
            media: vec![Medium { sigma_s: [0.5; 3], ..Medium::default() }],
            lights: lights(),
            light_nodes: Vec::new(),
            textures: vec![
                texture(TextureFormat::Rgba8Srgb, [4, 2], 0),
                texture(TextureFormat::Rgba8Linear, [3, 1], 2),
                texture(TextureFormat::Rgba16Float, [2, 2], 3),
                Texture::expression(3, 6),
            ],
            texels: texels(),
            srgb: Some(srgb()),
            sky_table: Vec::new(),
            albedo: Vec::new(),
            kernel: "// kernel\nfn main() {}\n".to_owned(),
            manifest: Some(manifest()),
        }
    }

    /// The example with a thing that turns and a camera that moves.
    pub(crate) fn with_keys() -> Self {
        let mut scene = Self::full();
        scene.objects[1] = Object { pivot: [0.0, 0.25, 0.0], path: 1, ..Object::default() };
        scene.motion = vec![piece([0.0, 0.5]), piece([0.5, 1.0])];
        scene.camera_keys = [0.0, 1.0].map(camera_key).to_vec();
        scene
    }

    /// The same, with lights that light only some things.
    pub(crate) fn and_links(mut self) -> Self {
        let link = |receives, own_set| LightLink { receives, own_set, ..LightLink::default() };
        self.links = self.lights.iter().map(|_| link(0, 2)).collect();
        self.links.extend(self.objects.iter().map(|_| link(3, 0)));
        self
    }

    /// The same, with an image that is tinted by vertices instead of by a colour.
    pub(crate) fn and_vertex_colors(mut self) -> Self {
        let op = TextureOp { kind: TextureOpKind::VertexColor as u32, ..TextureOp::default() };
        self.texels[9..12].copy_from_slice(&op.words());
        self.vertex_colors = vec![VertexColors::WHITE; self.triangles.len()];
        self
    }

    /// The same, with materials that read the first and the last table of directional albedo.
    pub(crate) fn and_albedo(mut self) -> Self {
        for material in &mut self.materials {
            match MaterialKind::from_tag(material.kind) {
                Some(MaterialKind::Principled) => {
                    (material.compensation, material.anisotropy) = (1.0, 0.0);
                }
                Some(MaterialKind::Leaf) => (material.weight, material.forward) = (0.5, 0.5),
                _ => {}
            }
        }
        let words = AlbedoTable::Gloss.words() + AlbedoTable::Leaf.words();
        self.albedo = vec![[0.5, -0.25, 0.0, 1.0]; words];
        self
    }

    /// The example with wide nodes: three, four and two children.
    pub(crate) fn wide() -> Self {
        Self {
            render: RenderSettings { stack_need: 5, ..render() },
            nodes: Vec::new(),
            wide_nodes: vec![
                wide_node([inner(1), inner(2), triangles(0, 1), NONE]),
                wide_node([triangles(1, 1), triangles(2, 1), triangles(3, 1), spheres(0, 1)]),
                wide_node([spheres(1, 1), spheres(2, 1), NONE, NONE]),
            ],
            ..Self::full()
        }
    }

    /// The example with an image for a sky that is its fourth light, sampled by 2 rows of 3 columns.
    pub(crate) fn with_sky_light() -> Self {
        let mut scene = Self::full();
        let sky =
            Sky { kind: SkyKind::Image as u32, texture: 2, light: 3, rows: 2, columns: 3, ..sky() };
        scene.sky = Some(sky);
        scene.lights[2].pmf = 0.125;
        scene.lights[2].cdf = 0.875;
        scene.lights.push(Light {
            kind: LightKind::Sky as u32,
            pmf: 0.125,
            cdf: 1.0,
            ..Light::default()
        });
        scene.render.n_lights = 4;
        let rows = [0.25, 1.0];
        let edges = [1.0, 0.0, -1.0];
        let columns = [0.0, 0.5, 1.0, 0.25, 0.75, 1.0];
        let values = [rows.as_slice(), &edges, &columns, &[0.0]].concat();
        scene.sky_table = values.as_chunks::<4>().0.to_vec();
        scene
    }

    /// The example with the sky as a light and a tree over the three others.
    pub(crate) fn with_light_tree() -> Self {
        let mut scene = Self::with_sky_light();
        let node = |child: u32| LightNode {
            radius2: 0.25,
            axis: [0.0, 1.0, 0.0],
            power: 2.0,
            cos_spread: -1.0,
            child,
            ..LightNode::default()
        };
        scene.light_nodes = [2, LIGHT_LEAF | 1, 4, LIGHT_LEAF, LIGHT_LEAF | 2].map(node).to_vec();
        scene.materials[3].flags |= material_flag::EMIT_TINT;
        scene.lights[0].trail = 0b01;
        scene.lights[2].trail = 0b11;
        scene
    }

    /// The example with a mesh of two nodes and four triangles in two places, one of which moves.
    pub(crate) fn with_instances() -> Self {
        Self::full().and_instances()
    }

    /// The same with such a mesh; for those that have the example's tree.
    pub(crate) fn and_instances(self) -> Self {
        let mut scene = self;
        for at in 0..4_u32 {
            let mut triangle = scene.triangles[at as usize];
            for id in [&mut triangle.id0, &mut triangle.id1, &mut triangle.id2] {
                *id = (*id & !MOVES) + 12;
            }
            scene.triangles.push(triangle);
            let object = if at == 0 { OBJECT_OF_INSTANCE } else { OBJECT_OF_INSTANCE | TRI_SMOOTH };
            scene.shades.push(TriShade { light: NONE, object, ..scene.shades[2] });
        }
        scene.nodes = vec![
            node(inner(1), inner(2)),
            node(triangles(0, 2), inner(3)),
            node(spheres(0, 1), inner(4)),
            node(triangles(2, 2), instance(0)),
            node(spheres(1, 2), instance(1)),
            node(triangles(4, 1), inner(6)),
            node(triangles(5, 2), triangles(7, 1)),
        ];
        let place = |center: [f32; 3], material: u32, object: u32| Instance {
            row_x: [2.0, 0.0, 0.0],
            root: inner(5),
            row_y: [0.0, -4.0, 0.0],
            material,
            row_z: [0.0, 0.0, 1.0],
            object,
            center,
            reach: 1.0,
            col_x: [0.5, 0.0, 0.0],
            col_y: [0.0, -0.25, 0.0],
            col_z: [0.0, 0.0, 1.0],
            ..Instance::default()
        };
        scene.instances = vec![place([0.1; 3], NONE, 0), place([-0.1; 3], 4, MOVES | 1)];
        // Two world nodes, the two before the instances, the way out, two nodes of the mesh.
        scene.render.stack_need = 3 + 1 + 2;
        scene
    }

    /// Camera and settings only: no geometry, no sky, no manifest.
    pub(crate) fn empty() -> Self {
        let render =
            RenderSettings { root: NONE, stack_need: 0, n_lights: 0, fog: NONE, ..render() };
        Self {
            render,
            sky: None,
            nodes: Vec::new(),
            wide_nodes: Vec::new(),
            triangles: Vec::new(),
            shades: Vec::new(),
            vertex_colors: Vec::new(),
            spheres: Vec::new(),
            materials: Vec::new(),
            objects: Vec::new(),
            links: Vec::new(),
            motion: Vec::new(),
            camera_keys: Vec::new(),
            instances: Vec::new(),
            media: Vec::new(),
            lights: Vec::new(),
            textures: Vec::new(),
            texels: Vec::new(),
            srgb: None,
            manifest: None,
            ..Self::full()
        }
    }

    pub(crate) fn writer(&self) -> PackWriter<'_> {
        let mut writer = PackWriter::new();
        writer
            .record(&self.render)
            .record(&self.camera)
            .records(&self.nodes)
            .records(&self.wide_nodes)
            .records(&self.triangles)
            .records(&self.shades)
            .records(&self.vertex_colors)
            .records(&self.spheres)
            .records(&self.materials)
            .records(&self.objects)
            .records(&self.links)
            .records(&self.motion)
            .records(&self.camera_keys)
            .records(&self.instances)
            .records(&self.media)
            .records(&self.lights)
            .records(&self.light_nodes)
            .records(&self.textures)
            .texels(&self.texels)
            .sky_table(&self.sky_table)
            .albedo(&self.albedo)
            .kernel(&self.kernel)
            .recipe_id([7; 32]);
        if let Some(sky) = &self.sky {
            writer.record(sky);
        }
        if let Some(srgb) = &self.srgb {
            writer.srgb_table(srgb);
        }
        if let Some(manifest) = &self.manifest {
            writer.manifest(manifest).unwrap();
        }
        writer
    }

    pub(crate) fn bytes(&self) -> Vec<u8> {
        self.writer().to_bytes().unwrap()
    }
}

/// A pack as loose parts, in which anything can be wrong.
#[derive(Clone)]
pub(crate) struct Draft {
    pub(crate) header: Vec<u8>,
    /// Entry and bytes.
    pub(crate) sections: Vec<(Vec<u8>, Vec<u8>)>,
}

pub(crate) fn put<const N: usize>(bytes: &mut [u8], at: usize, value: [u8; N]) {
    bytes[at..at + N].copy_from_slice(&value);
}

pub(crate) fn put32(bytes: &mut [u8], at: usize, value: u32) {
    put(bytes, at, value.to_le_bytes());
}

pub(crate) fn put64(bytes: &mut [u8], at: usize, value: u64) {
    put(bytes, at, value.to_le_bytes());
}

pub(crate) fn get32(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

pub(crate) fn get64(bytes: &[u8], at: usize) -> u64 {
    u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap())
}

pub(crate) fn index64(bytes: &[u8], at: usize) -> usize {
    usize::try_from(get64(bytes, at)).unwrap()
}

impl Draft {
    pub(crate) fn new(pack: &[u8]) -> Self {
        let count = get32(pack, 32) as usize;
        let entries = pack[128..128 + 64 * count].chunks(64);
        let sections = entries
            .map(|entry| {
                let (offset, length) = (index64(entry, 16), index64(entry, 24));
                (entry.to_vec(), pack[offset..offset + length].to_vec())
            })
            .collect();
        Self { header: pack[..128].to_vec(), sections }
    }

    pub(crate) fn find(&self, kind: Kind) -> usize {
        let found = self.sections.iter().position(|(entry, _)| entry[..8] == kind.0);
        found.unwrap_or_else(|| panic!("no section {kind}"))
    }

    pub(crate) fn section(&mut self, kind: Kind) -> &mut Vec<u8> {
        let index = self.find(kind);
        &mut self.sections[index].1
    }

    pub(crate) fn entry(&mut self, kind: Kind) -> &mut Vec<u8> {
        let index = self.find(kind);
        &mut self.sections[index].0
    }

    pub(crate) fn remove(&mut self, kind: Kind) {
        let index = self.find(kind);
        self.sections.remove(index);
    }

    pub(crate) fn add(&mut self, index: usize, kind: Kind, flags: u32, bytes: &[u8]) {
        let mut entry = vec![0; 64];
        put(&mut entry, 0, kind.0);
        put32(&mut entry, 8, 1);
        put32(&mut entry, 12, flags);
        put32(&mut entry, 32, 1);
        self.sections.insert(index, (entry, bytes.to_vec()));
    }

    /// Fills in offsets, lengths, counts, hashes, ids: a pack that is whole again.
    pub(crate) fn seal(&self) -> Vec<u8> {
        let mut draft = self.clone();
        let mut end = 128 + 64 * draft.sections.len();
        for (entry, bytes) in &mut draft.sections {
            let offset = end.next_multiple_of(4096);
            let count = bytes.len() as u64 / u64::from(get32(entry, 32).max(1));
            put64(entry, 16, offset as u64);
            put64(entry, 24, bytes.len() as u64);
            put64(entry, 40, count);
            put(entry, 48, *blake3::hash(bytes).as_bytes().first_chunk::<16>().unwrap());
            end = offset + bytes.len();
        }
        put32(&mut draft.header, 32, u32::try_from(draft.sections.len()).unwrap());
        put64(&mut draft.header, 40, end as u64);
        let mut pack = draft.header;
        pack.extend(draft.sections.iter().flat_map(|(entry, _)| entry));
        for (_, bytes) in &draft.sections {
            pack.resize(pack.len().next_multiple_of(4096), 0);
            pack.extend(bytes);
        }
        fix_render_id(&mut pack);
        pack
    }
}

/// `render_id` as the format defines it, written a second time.
pub(crate) fn fix_render_id(pack: &mut [u8]) {
    let count = (get32(pack, 32) as usize).min((pack.len() - 128) / 64);
    let mut hasher = blake3::Hasher::new();
    hasher.update(&pack[8..10]).update(&pack[48..56]).update(&pack[36..40]);
    for entry in pack[128..128 + 64 * count].chunks(64).filter(|entry| entry[12] & 1 == 1) {
        hasher.update(&entry[..8]).update(&entry[8..12]).update(&entry[32..36]);
        hasher.update(&entry[40..48]).update(&entry[48..64]);
    }
    put(pack, 64, *hasher.finalize().as_bytes());
}
