//! The sections that a pack may hold: one table that writer, reader and checks share.
//!
//! Keeps the invariant that a record type has exactly one section and that the order of
//! [`SECTIONS`] is the order in the file. It does not know what the records mean.

use std::fmt;

use crate::abi::{self, AbiRecord};

/// Name of a section: eight ASCII characters, padded with spaces.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Kind(pub [u8; 8]);

impl Kind {
    /// One [`abi::RenderSettings`].
    pub const RENDER: Self = Self(*b"RENDER  ");
    /// One [`abi::Camera`].
    pub const CAMERA: Self = Self(*b"CAMERA  ");
    /// One [`abi::Sky`]; absent when the sky is black.
    pub const SKY: Self = Self(*b"SKY     ");
    /// [`abi::Node`]s, every child after its parent.
    pub const NODE: Self = Self(*b"NODE    ");
    /// [`abi::WideNode`]s, every child after its parent; never together with NODE.
    pub const WIDENODE: Self = Self(*b"WIDENODE");
    /// [`abi::Triangle`]s in leaf order.
    pub const TRIANGLE: Self = Self(*b"TRIANGLE");
    /// [`abi::TriShade`]s, one a triangle.
    pub const TRISHADE: Self = Self(*b"TRISHADE");
    /// [`abi::VertexColors`], one a triangle. Present exactly when a texture reads them and there are triangles.
    pub const VERTEXCOLOR: Self = Self(*b"VTXCOLOR");
    /// [`abi::Sphere`]s in leaf order.
    pub const SPHERE: Self = Self(*b"SPHERE  ");
    /// [`abi::Material`]s.
    pub const MATERIAL: Self = Self(*b"MATERIAL");
    /// [`abi::Object`]s; absent when nothing depends on them.
    pub const OBJECT: Self = Self(*b"OBJECT  ");
    /// [`abi::Instance`]s; absent when every mesh is where its triangles say.
    pub const INSTANCE: Self = Self(*b"INSTANCE");
    /// [`abi::Medium`]s.
    pub const MEDIUM: Self = Self(*b"MEDIUM  ");
    /// [`abi::Light`]s: the selection table.
    pub const LIGHT: Self = Self(*b"LIGHT   ");
    /// [`abi::LightNode`]s: the tree by which one of many lights is chosen; absent when the table does.
    pub const LIGHTNODE: Self = Self(*b"LIGHTNOD");
    /// [`abi::Texture`]s.
    pub const TEXTURE: Self = Self(*b"TEXTURE ");
    /// Texels of all textures, 16-byte words.
    pub const TEXEL: Self = Self(*b"TEXEL   ");
    /// 256 `f32`: linear value of each sRGB byte. Present exactly when a texture is `Rgba8Srgb`.
    pub const SRGBLUT: Self = Self(*b"SRGBLUT ");
    /// `f32` values by which the sky is sampled, four a word: [`abi::sky_table_values`]. Present exactly when
    /// the sky is a light.
    pub const SKYTABLE: Self = Self(*b"SKYTABLE");
    /// Tables of directional albedo, `f32` values, four a word. Present exactly when a material reads one:
    /// [`abi::albedo_words`].
    pub const ALBEDO: Self = Self(*b"ALBEDO  ");
    /// [`abi::LightLink`]s; absent when every light lights everything.
    pub const LIGHTLINK: Self = Self(*b"LIGHTLNK");
    /// [`abi::MotionPiece`]s; absent when nothing turns and every way is one straight line.
    pub const MOTION: Self = Self(*b"MOTION  ");
    /// [`abi::CameraKey`]s; absent when the camera stands still.
    pub const CAMERAKEY: Self = Self(*b"CAMKEY  ");
    /// The linked WGSL text.
    pub const KERNEL: Self = Self(*b"KERNEL  ");
    /// The [`crate::Manifest`]; never needed to render.
    pub const META: Self = Self(*b"META    ");

    /// The name without its padding.
    #[must_use]
    pub fn name(&self) -> &str {
        std::str::from_utf8(&self.0).unwrap_or("?").trim_end()
    }

    /// Number of the kernel's first binding that holds the section; small tables share binding 2. `None` for
    /// what the host reads.
    #[must_use]
    pub fn binding(self) -> Option<u32> {
        match self {
            Self::RENDER | Self::KERNEL | Self::META => None,
            Self::NODE | Self::WIDENODE => Some(3),
            Self::TRIANGLE => Some(4),
            Self::TRISHADE => Some(5),
            Self::SPHERE => Some(6),
            Self::TEXEL => Some(7),
            _ => self.spec().map(|_| 2),
        }
    }

    /// The row of [`SECTIONS`], or `None` for a section of a later format.
    #[must_use]
    pub fn spec(self) -> Option<&'static SectionSpec> {
        SECTIONS.iter().find(|spec| spec.kind == self)
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_ascii() {
            out.pad(&self.name().escape_debug().to_string())
        } else {
            write!(out, "0x{:016x}", u64::from_le_bytes(self.0))
        }
    }
}

impl fmt::Debug for Kind {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "Kind({self})")
    }
}

/// What is fixed about a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SectionSpec {
    /// Its name.
    pub kind: Kind,
    /// Version of its elements.
    pub version: u32,
    /// Bytes of one element.
    pub elem_size: u32,
    /// Fewest elements of a section that is present.
    pub min_count: u64,
    /// Most elements.
    pub max_count: u64,
    /// Whether every pack has it.
    pub required: bool,
    /// Whether a reader that does not know it must refuse the pack.
    pub must_understand: bool,
}

const fn table(kind: Kind, elem_size: usize, max_count: u64) -> SectionSpec {
    #[expect(clippy::cast_possible_truncation, reason = "records are below 200 bytes")]
    let elem_size = elem_size as u32;
    SectionSpec {
        kind,
        version: 1,
        elem_size,
        min_count: 1,
        max_count,
        required: false,
        must_understand: true,
    }
}

const fn one(kind: Kind, elem_size: usize, required: bool) -> SectionSpec {
    SectionSpec { required, ..table(kind, elem_size, 1) }
}

/// A leaf names its first primitive with 27 bits.
const MAX_PRIMITIVES: u64 = 1 << 27;

/// Most instances of a pack.
pub const MAX_INSTANCES: u64 = 1 << 19;

/// Most bytes of a kernel: a hundred times what the largest scene links today.
pub(crate) const MAX_KERNEL: u64 = 4 << 20;
/// Most bytes of a manifest.
pub(crate) const MAX_META: usize = 16 << 20;
/// 16-byte words of the table of the sky: 32 MiB of cells and some rows; it shares a binding with small tables.
const MAX_SKY_WORDS: u64 = (32 << 20) / 16 + (1 << 16);
/// 16-byte words of the sRGB table: 256 values of 4 bytes.
pub(crate) const SRGB_WORDS: u64 = 64;

/// Every section of this format, in file order.
pub const SECTIONS: [SectionSpec; 25] = [
    one(Kind::RENDER, size_of::<abi::RenderSettings>(), true),
    // 2: kinds of cameras.
    SectionSpec { version: 2, ..one(Kind::CAMERA, size_of::<abi::Camera>(), true) },
    one(Kind::SKY, size_of::<abi::Sky>(), false),
    // A binary tree has one inner node less than leaves, and a leaf holds at least one primitive.
    table(Kind::NODE, size_of::<abi::Node>(), 2 * MAX_PRIMITIVES),
    table(Kind::WIDENODE, size_of::<abi::WideNode>(), 2 * MAX_PRIMITIVES),
    table(Kind::TRIANGLE, size_of::<abi::Triangle>(), MAX_PRIMITIVES),
    table(Kind::TRISHADE, size_of::<abi::TriShade>(), MAX_PRIMITIVES),
    table(Kind::VERTEXCOLOR, size_of::<abi::VertexColors>(), MAX_PRIMITIVES),
    // A reference to spheres has one bit less.
    table(Kind::SPHERE, size_of::<abi::Sphere>(), MAX_PRIMITIVES / 2),
    table(Kind::MATERIAL, size_of::<abi::Material>(), 1 << 24),
    table(Kind::OBJECT, size_of::<abi::Object>(), 1 << 24),
    // 56 MiB, which share a binding with other small tables.
    table(Kind::INSTANCE, size_of::<abi::Instance>(), MAX_INSTANCES),
    table(Kind::MEDIUM, size_of::<abi::Medium>(), 1 << 16),
    table(Kind::LIGHT, size_of::<abi::Light>(), 1 << 24),
    table(Kind::LIGHTNODE, size_of::<abi::LightNode>(), 1 << 20),
    table(Kind::TEXTURE, size_of::<abi::Texture>(), 1 << 20),
    // `Texture::offset` is a `u32` that counts words.
    table(Kind::TEXEL, 16, 1 << 32),
    SectionSpec { min_count: SRGB_WORDS, ..table(Kind::SRGBLUT, 16, SRGB_WORDS) },
    table(Kind::SKYTABLE, 16, MAX_SKY_WORDS),
    table(Kind::ALBEDO, 16, 1 << 16),
    table(Kind::LIGHTLINK, size_of::<abi::LightLink>(), 1 << 24),
    table(Kind::MOTION, size_of::<abi::MotionPiece>(), 1 << 20),
    // One key is no motion.
    SectionSpec { min_count: 2, ..table(Kind::CAMERAKEY, size_of::<abi::CameraKey>(), 1 << 16) },
    SectionSpec { required: true, ..table(Kind::KERNEL, 1, MAX_KERNEL) },
    // 2: features with their declarations, and the size of the kernel. 3: what instances show; since then every
    // primitive says which instance or light it is, also where there is no OBJECT.
    SectionSpec { version: 3, must_understand: false, ..table(Kind::META, 1, MAX_META as u64) },
];

/// A record that has a section of its own.
pub trait PackRecord: AbiRecord {
    /// The section that holds these records.
    const KIND: Kind;
}

macro_rules! pack_records {
    ($($record:ident => $kind:ident),* $(,)?) => {
        $(impl PackRecord for abi::$record { const KIND: Kind = Kind::$kind; })*
    };
}
pack_records! {
    RenderSettings => RENDER, Camera => CAMERA, Sky => SKY, Node => NODE, WideNode => WIDENODE,
    Triangle => TRIANGLE,
    TriShade => TRISHADE, VertexColors => VERTEXCOLOR, Sphere => SPHERE, Material => MATERIAL,
    Object => OBJECT,
    Instance => INSTANCE,
    Medium => MEDIUM, Light => LIGHT, LightNode => LIGHTNODE, Texture => TEXTURE,
    LightLink => LIGHTLINK, MotionPiece => MOTION, CameraKey => CAMERAKEY,
}
