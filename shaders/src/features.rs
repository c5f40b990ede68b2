//! What a scene needs of the kernel.

use crate::ShaderError;
use pack::abi::{
    CameraKind, FilterKind, LightKind, MaterialKind, SamplerKind, SkyKind, TextureFormat,
};
use std::collections::BTreeSet;

/// Storage buffers that every WebGPU device offers, less one that is left for the host. A scene that needs more
/// of them renders on the CPU, and on devices that offer more.
pub const PORTABLE_STORAGE: usize = 7;

/// Most storage buffers of a kernel: what Metal and llvmpipe offer, less what the host may need.
const MAX_STORAGE: usize = 30;

/// The features of a kernel. Whatever is absent brings neither code nor a binding.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[expect(clippy::struct_excessive_bools, reason = "each is an independent switch with a name")]
pub struct FeatureSet {
    /// There are triangles.
    pub triangles: bool,
    /// There are spheres.
    pub spheres: bool,
    /// Some triangle interpolates normals.
    pub smooth_normals: bool,
    /// Kinds of scattering.
    pub materials: BTreeSet<MaterialKind>,
    /// Kinds in the light selection table.
    pub lights: BTreeSet<LightKind>,
    /// There are several lights to choose from; one needs neither table nor tree.
    pub light_choice: bool,
    /// Lights are chosen by a tree; only with `light_choice`.
    pub light_tree: bool,
    /// Some light is tinted by direction.
    pub tint: bool,
    /// Some light shines into a cone.
    pub spot: bool,
    /// Lights with a profile.
    pub profile: bool,
    /// Things that the camera does not see.
    pub unseen: bool,
    /// Kinds of sky; none is black. A scene has at most one, the full kernel knows all.
    pub skies: BTreeSet<SkyKind>,
    /// Pixel filters. A scene has exactly one, the full kernel knows all.
    pub filters: BTreeSet<FilterKind>,
    /// Kinds of cameras. A scene has exactly one, the full kernel knows all.
    pub cameras: BTreeSet<CameraKind>,
    /// The camera has a lens of radius > 0; only with perspective cameras.
    pub lens: bool,
    /// The opening of the lens has corners; only with `lens`.
    pub blades: bool,
    /// Paths may have any length.
    pub unlimited: bool,
    /// Where random numbers come from. A scene has exactly one, the full kernel knows all.
    pub samplers: BTreeSet<SamplerKind>,
    /// Formats of the textures.
    pub textures: BTreeSet<TextureFormat>,
    /// Some material has the flag `ALPHA_CLIP`.
    pub alpha_clip: bool,
    /// Some material has the flag `ALPHA_BLEND`.
    pub alpha_blend: bool,
    /// Some material has the flag `TANGENT`.
    pub tangents: bool,
    /// Some material has the flag `OBJECT`.
    pub objects: bool,
    /// Textures of some material are projected; only with `objects`.
    pub projection: bool,
    /// Some material has a normal map.
    pub normal_maps: bool,
    /// Things have an inside, or there is an atmosphere.
    pub media: bool,
    /// Some medium scatters; only with `media`.
    pub scattering: bool,
    /// There is fog.
    pub fog: bool,
    /// Some material has the flag `THROUGH`.
    pub through: bool,
    /// And has no inside: a thin sheet.
    pub sheets: bool,
    /// Some principled material has a specular factor or colour.
    pub principled_specular: bool,
    /// Some principled material has a coat.
    pub principled_coat: bool,
    /// Some principled material lets light through.
    pub principled_transmission: bool,
    /// Some principled material has sheen.
    pub principled_sheen: bool,
    /// Some principled material is brushed.
    pub principled_anisotropy: bool,
    /// Something moves while the shutter is open.
    pub motion: bool,
    /// Some object turns, or its way is not one straight line; only with `motion`.
    pub keys: bool,
    /// The camera moves; only with `motion`.
    pub camera_keys: bool,
    /// Some light does not light everything.
    pub links: bool,
    /// There are instances; only with `triangles`.
    pub instances: bool,
    /// Layouts of nodes; a scene has one.
    pub layouts: BTreeSet<NodeLayout>,
    /// Entries of the traversal stack, at least 1: `RenderSettings::stack_need`.
    pub stack_size: u32,
    /// How many bindings each section is split into.
    pub windows: Windows,
}

/// How inner nodes are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NodeLayout {
    /// `pack::abi::Node`: two children.
    Binary,
    /// `pack::abi::WideNode`: up to four children.
    Wide,
}

/// Bindings per section: 1, unless the section exceeds [`crate::WINDOW_WORDS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Windows {
    /// BVH nodes.
    pub node: u32,
    /// Triangles.
    pub tri: u32,
    /// Shading data of triangles.
    pub shade: u32,
    /// Spheres.
    pub sphere: u32,
    /// Texels.
    pub texel: u32,
}

impl Default for Windows {
    fn default() -> Self {
        Self { node: 1, tri: 1, shade: 1, sphere: 1, texel: 1 }
    }
}

/// A buffer of the kernel, all in bind group 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Binding {
    /// Binding number: 0 the frame, 1 the film, 2 heap, 3 nodes, 4 triangles, 5 shading data, 6 spheres,
    /// 7 texels; window `w` of binding `b` is `b + 8 w`.
    pub number: u32,
    /// Name of the variable, such as `node_words` or `node_words_1`.
    pub name: String,
    /// Which window of its section, from 0.
    pub window: u32,
}

impl FeatureSet {
    /// The smallest kernel: a pinhole camera in front of nothing, with the default sampler.
    #[must_use]
    pub fn empty() -> Self {
        Self {
            triangles: false,
            spheres: false,
            smooth_normals: false,
            materials: BTreeSet::new(),
            lights: BTreeSet::new(),
            light_choice: false,
            light_tree: false,
            tint: false,
            spot: false,
            profile: false,
            unseen: false,
            skies: BTreeSet::new(),
            filters: [FilterKind::Pixel].into(),
            cameras: [CameraKind::Perspective].into(),
            lens: false,
            blades: false,
            unlimited: false,
            samplers: [SamplerKind::Sobol].into(),
            textures: BTreeSet::new(),
            alpha_clip: false,
            alpha_blend: false,
            tangents: false,
            objects: false,
            projection: false,
            normal_maps: false,
            media: false,
            scattering: false,
            fog: false,
            through: false,
            sheets: false,
            principled_specular: false,
            principled_coat: false,
            principled_transmission: false,
            principled_sheen: false,
            principled_anisotropy: false,
            motion: false,
            keys: false,
            camera_keys: false,
            links: false,
            instances: false,
            layouts: [NodeLayout::Binary].into(),
            stack_size: 1,
            windows: Windows::default(),
        }
    }

    /// Everything: the kernel that renders any pack.
    #[must_use]
    pub fn full() -> Self {
        Self {
            triangles: true,
            spheres: true,
            smooth_normals: true,
            materials: MaterialKind::ALL.into(),
            lights: LightKind::ALL.into(),
            light_choice: true,
            light_tree: true,
            tint: true,
            spot: true,
            profile: true,
            unseen: true,
            skies: SkyKind::ALL.into(),
            filters: FilterKind::ALL.into(),
            cameras: CameraKind::ALL.into(),
            lens: true,
            blades: true,
            unlimited: true,
            samplers: SamplerKind::ALL.into(),
            textures: TextureFormat::ALL.into(),
            alpha_clip: true,
            alpha_blend: true,
            tangents: true,
            objects: true,
            projection: true,
            normal_maps: true,
            media: true,
            scattering: true,
            fog: true,
            through: true,
            sheets: true,
            principled_specular: true,
            principled_coat: true,
            principled_transmission: true,
            principled_sheen: true,
            principled_anisotropy: true,
            motion: true,
            keys: true,
            camera_keys: true,
            links: true,
            instances: true,
            layouts: [NodeLayout::Binary, NodeLayout::Wide].into(),
            stack_size: pack::abi::MAX_STACK,
            windows: Windows::default(),
        }
    }

    /// Whether a ray can hit anything.
    #[must_use]
    pub fn geometry(&self) -> bool {
        self.triangles || self.spheres
    }

    /// Whether some light is a surface that rays can hit.
    #[must_use]
    pub fn surface_lights(&self) -> bool {
        self.lights.iter().any(|kind| kind.surface().is_some())
    }

    /// The buffers that the linked kernel declares, by number. An error if they are more than any kernel may
    /// have.
    pub fn bindings(&self) -> Result<Vec<Binding>, ShaderError> {
        let windows = &self.windows;
        let geometry = self.geometry();
        let images = self.textures.iter().any(|format| *format != TextureFormat::Expression);
        let sky = self.skies.contains(&SkyKind::Image) && images;
        let textures = sky || (geometry && !self.textures.is_empty());
        let sections = [
            (0, "frame_words", true, 1),
            (1, "film_words", true, 1),
            (2, "heap_words", true, 1),
            (3, "node_words", geometry, windows.node),
            (4, "tri_words", self.triangles, windows.tri),
            (5, "shade_words", self.triangles, windows.shade),
            (6, "sphere_words", self.spheres, windows.sphere),
            (7, "texel_words", textures, windows.texel),
        ];
        let mut bindings = Vec::new();
        for (number, name, present, n_windows) in sections {
            let n_windows = if present { n_windows.max(1) } else { 0 };
            bindings.extend((0..n_windows).map(|window| Binding {
                number: number + 8 * window,
                name: window_name(name, window),
                window,
            }));
        }
        bindings.sort_by_key(|binding| binding.number);
        let count = storage(&bindings);
        if count > MAX_STORAGE {
            return Err(ShaderError::TooManyBindings { count, limit: MAX_STORAGE });
        }
        Ok(bindings)
    }

    /// Storage buffers that the linked kernel declares; to be compared with [`PORTABLE_STORAGE`].
    pub fn storage_buffers(&self) -> Result<usize, ShaderError> {
        self.bindings().map(|bindings| storage(&bindings))
    }
}

/// All but the frame, which is a uniform.
fn storage(bindings: &[Binding]) -> usize {
    bindings.len() - 1
}

/// Name of window `window` of the section variable `name`.
pub(crate) fn window_name(name: &str, window: u32) -> String {
    if window == 0 { name.to_owned() } else { format!("{name}_{window}") }
}
