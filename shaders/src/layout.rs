//! naga's view of the WGSL structs against the field tables of `pack::abi`.

use crate::{ShaderError, generate};
use naga::{Module, ScalarKind, TypeInner, VectorSize};
use pack::abi::{self, Field};
use std::fmt::Write as _;
use thiserror::Error;

/// Records whose WGSL struct differs from the Rust struct.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}", .tables.join("\n"))]
pub struct LayoutError {
    /// One table for each such record: both layouts side by side, differing rows marked.
    pub tables: Vec<String>,
}

/// A module that declares every record, used or not: [`check_layouts`] of it proves the generator.
pub fn abi_module() -> Result<Module, ShaderError> {
    let all: String = generate::record_texts().into_iter().map(|(_, text)| text).collect();
    naga::front::wgsl::parse_str(&all).map_err(|error| ShaderError::Parse {
        at: crate::declaration::location("abi", &all, 0),
        message: error.message().to_owned(),
    })
}

/// Compares every struct of `module` that has a record's name with that record: field names, types,
/// offsets, and the size, which is also the stride of an array of them.
pub fn check_layouts(module: &Module) -> Result<(), LayoutError> {
    let mut tables = Vec::new();
    for (_, ty) in module.types.iter() {
        let (Some(name), TypeInner::Struct { members, span }) = (&ty.name, &ty.inner) else {
            continue;
        };
        let Some(record) = abi::records().into_iter().find(|record| record.name == name.as_str())
        else {
            continue;
        };
        let rust = rows(record.fields, record.size);
        let mut wgsl: Vec<String> = members
            .iter()
            .map(|member| {
                let name = member.name.as_deref().unwrap_or("?");
                let ty = type_name(&module.types[member.ty].inner);
                format!("{:4} {name}: {ty}", member.offset)
            })
            .collect();
        wgsl.push(format!("{span:4} end"));
        if rust != wgsl {
            tables.push(table(name, &rust, &wgsl));
        }
    }
    if tables.is_empty() { Ok(()) } else { Err(LayoutError { tables }) }
}

fn rows(fields: &[Field], size: usize) -> Vec<String> {
    let row = |field: &Field| format!("{:4} {}: {}", field.offset, field.name, field.ty.wgsl());
    fields.iter().map(row).chain([format!("{size:4} end")]).collect()
}

/// The type as the field tables write it; anything else as naga prints it.
#[expect(clippy::wildcard_enum_match_arm, reason = "the types are naga's")]
fn type_name(inner: &TypeInner) -> String {
    let scalar = |kind: ScalarKind, width: u8| match (kind, width) {
        (ScalarKind::Float, 4) => Some("f32"),
        (ScalarKind::Uint, 4) => Some("u32"),
        _ => None,
    };
    let known = match *inner {
        TypeInner::Scalar(s) => scalar(s.kind, s.width).map(str::to_owned),
        TypeInner::Vector { size, scalar: s } => scalar(s.kind, s.width).map(|element| {
            let lanes = match size {
                VectorSize::Bi => 2,
                VectorSize::Tri => 3,
                VectorSize::Quad => 4,
            };
            format!("vec{lanes}<{element}>")
        }),
        _ => None,
    };
    known.unwrap_or_else(|| format!("{inner:?}"))
}

/// Both lists side by side, `!` before each row that differs.
fn table(name: &str, rust: &[String], wgsl: &[String]) -> String {
    let width = rust.iter().map(String::len).max().unwrap_or(0).max(20);
    let mut text = format!("layout of `{name}` differs\n  {:width$}   WGSL\n", "Rust");
    for i in 0..rust.len().max(wgsl.len()) {
        let left = rust.get(i).map_or("", String::as_str);
        let right = wgsl.get(i).map_or("", String::as_str);
        let mark = if left == right { ' ' } else { '!' };
        let _ = writeln!(text, "{mark} {left:width$}   {right}");
    }
    text
}
