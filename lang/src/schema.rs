//! What the one table of the language is made of: kinds, types, and fields with unit, range, default and doc.
//!
//! Checking, `rtc explain`, the resolved listing and `docs/reference.md` all read that table, so a
//! field that is not in it does not exist anywhere; `table` has it whole. It does not know the syntax tree or values.

/// The types of a kind: one list becomes the table of their schemas and the enum to match on, so that a type
/// that nothing is made of does not compile.
macro_rules! types {
    ($name:ident { $($variant:ident = $schema:ident),* $(,)? }) => {
        pub(crate) const TYPES: &[&$crate::schema::TypeSchema] = &[$(&$schema),*];

        /// The types of this kind.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum $name { $($variant),* }

        impl $name {
            /// The type that `schema` describes.
            pub(crate) fn of(schema: &$crate::schema::TypeSchema) -> Self {
                $(if schema.name == $schema.name { return Self::$variant; })*
                unreachable!("`{}` is no type of this kind", schema.name)
            }
        }
    };
}

/// Words of a field: one list becomes the table that is checked and shown, and an enum.
macro_rules! words {
    ($(#[$meta:meta])* pub enum $name:ident {
        $($(#[$row:meta])* $variant:ident = $word:literal $doc:literal,)*
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $($(#[$row])* $variant,)* }

        impl $name {
            /// Every word and what it means.
            pub(crate) const WORDS: &[$crate::schema::Word] = &[$(($word, $doc)),*];

            /// The one that is written so.
            pub(crate) fn of(word: &str) -> Option<Self> {
                $(if word == $word { return Some(Self::$variant); })*
                None
            }

            /// As it is written.
            #[must_use]
            pub fn word(self) -> &'static str {
                match self { $(Self::$variant => $word,)* }
            }
        }
    };
}
pub(crate) use {types, words};

pub(crate) mod asset;
mod bounds;
pub(crate) mod camera;
mod field;
pub(crate) mod film;
pub(crate) mod instance;
mod kind;
pub(crate) mod light;
mod limits;
mod render;
mod table;
mod text;
pub(crate) mod texture;

pub use bounds::Bounds;
pub use field::{Default, Field, FieldType, Word};
pub use kind::Kind;
pub(crate) use limits::{ANY, WHITE};
pub use limits::{MAX_FILM_SIDE, MAX_GROUP, MAX_MAGNITUDE};
pub use table::{all_types, find_type, types_of};
pub use text::{color_text, default_text, range_text, type_text, unit_of};

/// One type of a kind, such as `diffuse` of `material`.
#[derive(Debug)]
pub struct TypeSchema {
    /// The kind it belongs to.
    pub kind: Kind,
    /// Its name after the colon or as a call; empty for kinds without types.
    pub name: &'static str,
    /// One or two sentences.
    pub doc: &'static str,
    /// A declaration that compiles, for the reference.
    pub example: &'static str,
    /// Its fields, in the order in which they are best written.
    pub fields: &'static [Field],
    /// Names that other renderers give this type, with the renderers.
    pub foreign: &'static [(&'static str, &'static str)],
}

impl TypeSchema {
    /// The field of this name.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<&'static Field> {
        self.fields.iter().find(|field| field.name == name)
    }

    /// `material.diffuse`, `film`.
    #[must_use]
    pub fn path(&self) -> String {
        if self.name.is_empty() {
            self.kind.name().to_owned()
        } else {
            format!("{}.{}", self.kind.name(), self.name)
        }
    }

    /// As it stands in a message: ``material type `diffuse` ``, `film`.
    #[must_use]
    pub fn described(&self) -> String {
        match (self.name, self.kind) {
            ("", kind) => format!("`{}`", kind.name()),
            (name, Kind::Asset | Kind::Texture | Kind::Shape) => format!("`{name}(...)`"),
            (name, kind) => format!("{} type `{name}`", kind.name()),
        }
    }
}
