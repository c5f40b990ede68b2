//! `abi_struct!`: one declaration becomes a `repr(C)` record, its `Pod` impl and its field table.

/// WGSL type of a record field, with its size and alignment in bytes (WGSL spec, 14.4.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldType {
    /// `f32`.
    F32,
    /// `u32`.
    U32,
    /// `vec2<f32>`.
    Vec2F,
    /// `vec3<f32>`; a scalar must fill its fourth lane.
    Vec3F,
    /// `vec4<f32>`.
    Vec4F,
    /// `vec2<u32>`.
    Vec2U,
    /// `vec3<u32>`; a scalar must fill its fourth lane.
    Vec3U,
    /// `vec4<u32>`.
    Vec4U,
}

impl FieldType {
    /// The type as WGSL writes it.
    #[must_use]
    pub fn wgsl(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::U32 => "u32",
            Self::Vec2F => "vec2<f32>",
            Self::Vec3F => "vec3<f32>",
            Self::Vec4F => "vec4<f32>",
            Self::Vec2U => "vec2<u32>",
            Self::Vec3U => "vec3<u32>",
            Self::Vec4U => "vec4<u32>",
        }
    }

    /// Number of 4-byte lanes.
    #[must_use]
    pub fn lanes(self) -> usize {
        match self {
            Self::F32 | Self::U32 => 1,
            Self::Vec2F | Self::Vec2U => 2,
            Self::Vec3F | Self::Vec3U => 3,
            Self::Vec4F | Self::Vec4U => 4,
        }
    }

    /// Whether the lanes are `f32`; otherwise they are `u32`.
    #[must_use]
    pub fn is_float(self) -> bool {
        matches!(self, Self::F32 | Self::Vec2F | Self::Vec3F | Self::Vec4F)
    }
}

/// One field of a record: its name in Rust and WGSL, its WGSL type, its byte offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name, the same in Rust and WGSL.
    pub name: &'static str,
    /// WGSL type.
    pub ty: FieldType,
    /// Byte offset from the start of the record.
    pub offset: usize,
    /// What it is, the lines of its comment in Rust and WGSL, each with the space before it.
    pub doc: &'static [&'static str],
}

/// A record with a field table; implemented by `abi_struct!` only.
pub trait AbiRecord: bytemuck::Pod {
    /// Name of the Rust struct and of the WGSL struct.
    const NAME: &'static str;
    /// What it is, the lines of its comment in Rust and WGSL, each with the space before it.
    const DOC: &'static [&'static str];
    /// Fields in declaration order, padding included.
    const FIELDS: &'static [Field];
}

/// A record's part of the tables that are made of all records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Record {
    /// Name of the Rust struct and of the WGSL struct.
    pub name: &'static str,
    /// See [`AbiRecord::DOC`].
    pub doc: &'static [&'static str],
    /// Fields in declaration order, padding included.
    pub fields: &'static [Field],
    /// Bytes, a multiple of 16.
    pub size: usize,
}

impl Record {
    /// That of `R`.
    #[must_use]
    pub fn of<R: AbiRecord>() -> Self {
        Self { name: R::NAME, doc: R::DOC, fields: R::FIELDS, size: size_of::<R>() }
    }
}

/// Maps a Rust field type to its WGSL type.
pub(crate) trait AbiField {
    const TYPE: FieldType;
}

macro_rules! abi_field {
    ($($rust:ty => $ty:ident),* $(,)?) => {
        $(impl AbiField for $rust { const TYPE: FieldType = FieldType::$ty; })*
    };
}
abi_field! {
    f32 => F32, u32 => U32,
    [f32; 2] => Vec2F, [f32; 3] => Vec3F, [f32; 4] => Vec4F,
    [u32; 2] => Vec2U, [u32; 3] => Vec3U, [u32; 4] => Vec4U,
}

/// Declares a record, for Rust and for WGSL: its comments are those of both. The size must be a multiple of 16
/// bytes: checked at compile time.
macro_rules! abi_struct {
    ($(#[doc = $doc:literal])* pub struct $name:ident {
        $($(#[doc = $fdoc:literal])* pub $field:ident: $ty:ty,)*
    }) => {
        $(#[doc = $doc])*
        #[allow(clippy::doc_markdown, reason = "formulas stand in WGSL, too")]
        #[repr(C)]
        #[allow(clippy::pub_underscore_fields, reason = "padding is part of the layout")]
        #[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
        pub struct $name { $($(#[doc = $fdoc])* pub $field: $ty,)* }

        impl $crate::abi::AbiRecord for $name {
            const NAME: &'static str = stringify!($name);
            const DOC: &'static [&'static str] = &[$($doc),*];
            const FIELDS: &'static [$crate::abi::Field] = &[$($crate::abi::Field {
                name: stringify!($field),
                ty: <$ty as $crate::abi::field::AbiField>::TYPE,
                offset: core::mem::offset_of!($name, $field),
                doc: &[$($fdoc),*],
            },)*];
        }

        const _: () = assert!(size_of::<$name>() % 16 == 0, "records are whole 16-byte words");
    };
}
pub(crate) use abi_struct;
