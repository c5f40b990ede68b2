//! Every type of every kind: the one place that knows them all.

use super::{Kind, TypeSchema, asset, camera, film, instance, light, render, texture};

/// The types of a kind; one without a name for kinds that are declared without `: type`.
#[must_use]
pub fn types_of(kind: Kind) -> &'static [&'static TypeSchema] {
    match kind {
        Kind::Asset => asset::TYPES,
        Kind::Texture => texture::TYPES,
        Kind::Material => crate::material::TYPES,
        Kind::Medium => crate::medium::TYPES,
        Kind::Shape => crate::shape::TYPES,
        Kind::Object => instance::OBJECT_TYPES,
        Kind::Instance => instance::INSTANCE_TYPES,
        Kind::Light => light::TYPES,
        Kind::Sky => crate::sky::TYPES,
        Kind::Camera => camera::TYPES,
        Kind::Film => film::TYPES,
        Kind::Render => render::TYPES,
    }
}

/// The type `name` of `kind`.
#[must_use]
pub fn find_type(kind: Kind, name: &str) -> Option<&'static TypeSchema> {
    types_of(kind).iter().copied().find(|schema| schema.name == name)
}

/// Every type of every kind, in the order of the reference.
pub fn all_types() -> impl Iterator<Item = &'static TypeSchema> {
    Kind::ALL.into_iter().flat_map(|kind| types_of(kind).iter().copied())
}
