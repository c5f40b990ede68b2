//! Scene + job → what the kernel binds: the heap, the big sections, the numbers of a dispatch.
//!
//! Both backends read the same bytes from here. It does not render.

use crate::job::{CpuWay, Job};
use crate::kernel::walk::Tree;
use crate::replicate::replicate_seed;
use crate::scene::Scene;
use crate::schedule::WorkItem;
#[cfg(target_arch = "x86_64")]
use crate::wide::Wide;
use glam::UVec4;
use pack::Kind;
use pack::abi::{Camera, Frame, NONE, albedo_tables};
use pack::features as bit;

/// Sections that the kernel binds as they are, with their binding numbers.
#[cfg(feature = "gpu")]
const BOUND: [(u32, Kind); 6] = [
    (3, Kind::NODE),
    (3, Kind::WIDENODE),
    (4, Kind::TRIANGLE),
    (5, Kind::TRISHADE),
    (6, Kind::SPHERE),
    (7, Kind::TEXEL),
];

/// Small tables that share one buffer, in this order.
const HEAP: [Kind; 16] = [
    Kind::CAMERA,
    Kind::SKY,
    Kind::MATERIAL,
    Kind::OBJECT,
    Kind::MEDIUM,
    Kind::LIGHT,
    Kind::TEXTURE,
    Kind::SRGBLUT,
    Kind::SKYTABLE,
    Kind::LIGHTNODE,
    Kind::INSTANCE,
    Kind::ALBEDO,
    Kind::MOTION,
    Kind::CAMERAKEY,
    Kind::LIGHTLINK,
    Kind::VERTEXCOLOR,
];

/// Bytes of one window of a section: the largest binding that every device has. Window `w` of binding
/// `b` is binding `b + 8 w`.
#[cfg(feature = "gpu")]
const WINDOW_BYTES: u64 = 128 << 20;

/// The binding of the heap, which is one window however large it is: kernels know no second one.
#[cfg(feature = "gpu")]
const HEAP_BINDING: u32 = 2;

/// Bytes of a window of a binding.
#[cfg(feature = "gpu")]
pub(crate) fn window_bytes(binding: u32) -> u64 {
    if binding == HEAP_BINDING { u64::MAX } else { WINDOW_BYTES }
}

/// A scene and a job, ready for any backend.
pub(crate) struct Setup<'a> {
    scene: &'a Scene,
    heap: Vec<UVec4>,
    /// Everything of `Frame` that is the same for all tiles.
    frame: Frame,
    way: CpuWay,
    /// Runs instead of the pack's.
    #[cfg(feature = "gpu")]
    kernel: Option<&'a str>,
}

impl Scene {
    /// The camera for the job's image: see `Camera::resized`.
    fn camera(&self, job: &Job) -> Camera {
        let camera = job.camera.unwrap_or(*self.pack().camera());
        camera.resized(job.image_size, self.settings().image_size)
    }

    /// First heap words of the tables of directional albedo, which begin at word `first`.
    fn albedo_at(&self, first: u32) -> ([u32; 4], [u32; 2]) {
        let at = |word: usize| u32::try_from(word).expect("tables are small") + first;
        Frame::albedo_places(albedo_tables(self.pack().records()).map(|word| word.map_or(NONE, at)))
    }

    /// First heap word of a table, `at` if it is there; otherwise `NONE`.
    fn table(&self, kind: Kind, at: u32) -> u32 {
        if self.pack().section_bytes(kind).is_some() { at } else { NONE }
    }

    /// The small tables, and the first word of each.
    fn heap(&self, camera: &Camera) -> (Vec<UVec4>, [u32; HEAP.len()]) {
        let mut heap: Vec<UVec4> = Vec::new();
        let at = HEAP.map(|kind| {
            let at = u32::try_from(heap.len()).expect("the checks bound every table");
            if kind == Kind::CAMERA {
                heap.extend_from_slice(words(bytemuck::bytes_of(camera)));
            } else if let Some(bytes) = self.pack().section_bytes(kind) {
                heap.extend_from_slice(words(bytes));
            }
            at
        });
        (heap, at)
    }

    pub(crate) fn setup(&self, job: &Job) -> Setup<'_> {
        let settings = self.settings();
        let (heap, at) = self.heap(&self.camera(job));
        let [
            camera_at,
            sky_at,
            material_at,
            object_at,
            medium_at,
            light_at,
            texture_at,
            srgb_at,
            sky_table_at,
            light_tree_at,
            instance_at,
            albedo_first,
            path_at,
            camera_key_at,
            link_at,
            vertex_color_at,
        ] = at;
        // The full kernel asks these numbers whether the tables are there; a specialised one knows.
        let sky_at = self.table(Kind::SKY, sky_at);
        let light_tree_at = self.table(Kind::LIGHTNODE, light_tree_at);
        let object_at = self.table(Kind::OBJECT, object_at);
        let path_at = self.table(Kind::MOTION, path_at);
        // A camera of somebody else's stands still.
        let still = job.camera.is_some();
        let camera_key_at = if still { NONE } else { self.table(Kind::CAMERAKEY, camera_key_at) };
        let (albedo_at, albedo_more_at) = self.albedo_at(albedo_first);
        let frame = Frame {
            link_at: self.table(Kind::LIGHTLINK, link_at),
            vertex_color_at: self.table(Kind::VERTEXCOLOR, vertex_color_at),
            path_at,
            camera_key_at,
            albedo_at,
            albedo_more_at,
            image_size: job.image_size,
            seed: job.seed,
            max_depth: settings.max_depth,
            roulette_depth: settings.roulette_depth,
            n_lights: settings.n_lights,
            camera_at,
            sky_at,
            material_at,
            object_at,
            medium_at,
            light_at,
            texture_at,
            srgb_at,
            sky_table_at,
            light_tree_at,
            instance_at,
            root: settings.root,
            estimator: job.estimator,
            clamp_indirect: job.clamp_indirect.unwrap_or(0.0),
            sampler: settings.sampler,
            pixel_filter: settings.filter,
            filter_width: settings.filter_width,
            air: settings.air,
            fog: settings.fog,
            wide: u32::from(self.pack().section_bytes(Kind::WIDENODE).is_some()),
            inside: settings.inside,
            ..Frame::default()
        };
        Setup {
            scene: self,
            heap,
            frame,
            way: job.way,
            #[cfg(feature = "gpu")]
            kernel: None,
        }
    }
}

#[cfg(feature = "gpu")]
impl<'a> Setup<'a> {
    /// The same scene for another kernel, which can do at least what the pack's can.
    pub(crate) fn with_kernel(self, kernel: &'a str) -> Self {
        Self { kernel: Some(kernel), ..self }
    }
}

impl Setup<'_> {
    /// The uniform of one tile.
    pub(crate) fn frame(&self, item: &WorkItem) -> Frame {
        Frame {
            tile_origin: [item.tile.x, item.tile.y],
            tile_size: [item.tile.w, item.tile.h],
            sample_first: item.samples.start,
            sample_count: item.samples.count(),
            seed: replicate_seed(self.frame.seed, item.replicate),
            ..self.frame
        }
    }

    /// The same for a picture by the full kernel, which is told where nothing asks for texture coordinates.
    pub(crate) fn picture_frame(&self, item: &WorkItem) -> Frame {
        let frame = self.frame(item);
        let has_tangents = self.features() & bit::TANGENTS != 0;
        let texture_at = self.scene.table(Kind::TEXTURE, frame.texture_at);
        Frame { texture_at: if has_tangents { frame.texture_at } else { texture_at }, ..frame }
    }

    /// The uniform of all samples of a job at once.
    pub(crate) fn frame_of(&self, job: &Job) -> Frame {
        self.frame(&WorkItem { replicate: 0, tile: job.crop, samples: job.samples, probe: false })
    }

    /// Whole image in pixels.
    #[cfg(feature = "gpu")]
    pub(crate) fn image_size(&self) -> [u32; 2] {
        self.frame.image_size
    }

    /// Binding 2.
    pub(crate) fn heap(&self) -> &[UVec4] {
        &self.heap
    }

    /// 16-byte words of a section; empty when the scene has none.
    pub(crate) fn section(&self, kind: Kind) -> &[UVec4] {
        self.scene.pack().section_bytes(kind).map_or(&[], words)
    }

    /// The tree that the CPU walks by hand, if it does; made when it is first asked for.
    pub(crate) fn tree(&self) -> Option<&Tree> {
        if self.way.by_hand { self.scene.tree(self.way.width()) } else { None }
    }

    /// The same if it has been made; without it rays find the same hits in the nodes of the pack.
    pub(crate) fn finished_tree(&self) -> Option<&Tree> {
        if self.way.by_hand { self.scene.finished_tree(self.way.width()) } else { None }
    }

    /// The kernel for several pixels at a time, if there is one and it is wanted.
    #[cfg(target_arch = "x86_64")]
    pub(crate) fn wide(&self) -> Option<Wide> {
        Wide::of_processor(self.way.lanes)
    }

    /// The nodes of the tree, in either layout.
    pub(crate) fn nodes(&self) -> &[UVec4] {
        let wide = self.section(Kind::WIDENODE);
        if wide.is_empty() { self.section(Kind::NODE) } else { wide }
    }

    /// Every storage buffer that is only read: binding number and bytes, none empty.
    #[cfg(feature = "gpu")]
    pub(crate) fn buffers(&self) -> Vec<(u32, &[u8])> {
        let heap = (HEAP_BINDING, bytemuck::cast_slice(&self.heap));
        let bound =
            BOUND.map(|(binding, kind)| (binding, bytemuck::cast_slice(self.section(kind))));
        let mut buffers: Vec<(u32, &[u8])> =
            std::iter::once(heap).chain(bound).filter(|(_, bytes)| !bytes.is_empty()).collect();
        // A tree that is one leaf has no node, but the kernel's loop names the buffer.
        let has_nodes = buffers.iter().any(|(binding, _)| *binding == BOUND[0].0);
        if self.frame.root != NONE && !has_nodes {
            buffers.insert(1, (BOUND[0].0, &[0; 64]));
        }
        // A kernel that can do more names sections that this pack lacks, and never reads them.
        for (binding, _) in BOUND {
            let named = || self.kernel().contains(&format!("@group(0) @binding({binding}) "));
            let bound = buffers.iter().any(|(number, _)| *number == binding);
            if self.kernel.is_some() && !bound && named() {
                buffers.push((binding, &[0; 64]));
            }
        }
        buffers
    }

    /// Whether a ray can hit anything.
    #[cfg(feature = "gpu")]
    pub(crate) fn has_geometry(&self) -> bool {
        self.frame.root != NONE
    }

    /// Bits of `pack::features`.
    pub(crate) fn features(&self) -> u64 {
        self.scene.pack().features()
    }

    /// Entries that the traversal stack needs, as the checks of the pack computed them.
    pub(crate) fn stack_need(&self) -> u32 {
        self.scene.settings().stack_need
    }

    /// The WGSL text that renders it.
    #[cfg(feature = "gpu")]
    pub(crate) fn kernel(&self) -> &str {
        self.kernel.unwrap_or_else(|| self.scene.pack().kernel())
    }
}

/// Bytes of whole records as words.
fn words(bytes: &[u8]) -> &[UVec4] {
    bytemuck::try_cast_slice(bytes).expect("sections are whole 16-byte words at page boundaries")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_are_bound_where_the_pack_says() {
        assert!(HEAP.iter().all(|kind| kind.binding() == Some(2)));
        #[cfg(feature = "gpu")]
        assert!(BOUND.iter().all(|(binding, kind)| kind.binding() == Some(*binding)));
        let n_heap = pack::SECTIONS.iter().filter(|spec| spec.kind.binding() == Some(2)).count();
        assert_eq!(n_heap, HEAP.len());
    }
}
