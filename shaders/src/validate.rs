//! A linked text becomes a validated naga module, or an error at a place in our files.

use crate::{Linked, ShaderError};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use std::error::Error as _;
use std::fmt::Write as _;

/// Parses and validates `linked` with no capability beyond plain WebGPU.
pub fn validate(linked: &Linked) -> Result<(naga::Module, ModuleInfo), ShaderError> {
    let module = naga::front::wgsl::parse_str(&linked.text).map_err(|error| {
        let byte =
            error.labels().next().and_then(|(span, _)| span.to_range()).map_or(0, |r| r.start);
        ShaderError::Parse { at: linked.locate(byte), message: error.message().to_owned() }
    })?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .map_err(|error| invalid(linked, &error))?;
    Ok((module, info))
}

/// Words of the module in SPIR-V: without names, runtime checks and debug information, so that the number is
/// the same in every build.
#[cfg(feature = "spirv")]
pub fn spirv_words(module: &naga::Module, info: &ModuleInfo) -> Result<u32, ShaderError> {
    let options = naga::back::spv::Options {
        flags: naga::back::spv::WriterFlags::empty(),
        ..naga::back::spv::Options::default()
    };
    let words = naga::back::spv::write_vec(module, info, &options, None)
        .map_err(|error| ShaderError::Translate { message: error.to_string() })?;
    Ok(u32::try_from(words.len()).unwrap_or(u32::MAX))
}

fn invalid(linked: &Linked, error: &naga::WithSpan<naga::valid::ValidationError>) -> ShaderError {
    // The innermost span is the last one: a function, then the expression in it.
    let byte = error.spans().last().and_then(|(span, _)| span.to_range()).map_or(0, |r| r.start);
    let mut message = error.as_inner().to_string();
    let mut cause = error.as_inner().source();
    while let Some(inner) = cause {
        let _ = write!(message, ": {inner}");
        cause = inner.source();
    }
    ShaderError::Invalid { at: linked.locate(byte), message }
}
