//! `KHR_materials_variants`: which material a primitive has in the variant that the scene chooses.

use super::super::error::{ErrorKind, ImportError};
use super::document::{Document, list};
use ::gltf::json::mesh::Primitive;
use ::gltf::json::{Index, Material};

/// Name of the extension.
pub(super) const NAME: &str = "KHR_materials_variants";

/// The variant of this name.
pub(super) fn find(
    document: &Document<'_>,
    name: Option<&str>,
) -> Result<Option<u32>, ImportError> {
    let Some(wanted) = name else { return Ok(None) };
    let known = names(document);
    if let Some(index) = (0..).zip(&known).find(|(_, own)| **own == wanted).map(|(i, _)| i) {
        return Ok(Some(index));
    }
    let list = if known.is_empty() {
        "it has none at all".to_owned()
    } else {
        list("its variants are", known.into_iter())
    };
    let message = format!("it has no variant `{wanted}`: {list}");
    Err(ImportError::new(ErrorKind::Choice, document.file, message))
}

/// The names of all variants.
pub(super) fn names<'a>(document: &Document<'a>) -> Vec<&'a str> {
    let extension = document.root.extensions.as_ref();
    let extension = extension.and_then(|all| all.khr_materials_variants.as_ref());
    extension
        .map_or_else(Vec::new, |found| found.variants.iter().map(|v| v.name.as_str()).collect())
}

/// The material of a primitive in a variant, or its own.
pub(super) fn material(primitive: &Primitive, variant: Option<u32>) -> Option<Index<Material>> {
    let mapped = variant.and_then(|variant| {
        let mappings = primitive.extensions.as_ref()?.khr_materials_variants.as_ref()?;
        let found = mappings.mappings.iter().find(|mapping| mapping.variants.contains(&variant));
        found.map(|mapping| Index::new(mapping.material))
    });
    mapped.or(primitive.material)
}
