//! What can go wrong on the way from modules to a valid kernel.

use std::fmt;
use thiserror::Error;

/// A place in a module: shown as `file:line:column`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Location {
    /// Module name, such as `bsdf/ggx.wgsl`; generated modules are `scene/…`.
    pub file: String,
    /// Line, from 1.
    pub line: u32,
    /// Column in bytes, from 1.
    pub column: u32,
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)
    }
}

/// A kernel that cannot be linked or is not valid WGSL.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ShaderError {
    /// A line that begins with `#` but is not `#import "name"`.
    #[error("{at}: expected `#import \"name.wgsl\"`")]
    BadImport {
        /// The line.
        at: Location,
    },
    /// An import of a module that does not exist.
    #[error("{at}: unknown module `{name}`")]
    UnknownImport {
        /// The import line.
        at: Location,
        /// The name that it asks for.
        name: String,
    },
    /// Modules that import each other.
    #[error("{at}: import cycle: {}", .chain.join(" -> "))]
    ImportCycle {
        /// The import line that closes the cycle.
        at: Location,
        /// The modules, the first one again at the end.
        chain: Vec<String>,
    },
    /// Text at module scope that is not a whole declaration.
    #[error("{at}: {message}")]
    BadDeclaration {
        /// Where the declaration begins.
        at: Location,
        /// What is wrong with it.
        message: &'static str,
    },
    /// Two declarations of one name.
    #[error("{at}: `{name}` is already declared at {first}")]
    Duplicate {
        /// The second declaration.
        at: Location,
        /// The first declaration.
        first: Location,
        /// Their name.
        name: String,
    },
    /// No declaration of the entry point.
    #[error("{file}: no function `render`")]
    NoEntry {
        /// The kernel's root module.
        file: String,
    },
    /// More storage bindings than devices offer.
    #[error(
        "the scene is too large: it needs {count} storage buffers of 128 MiB, and a kernel has {limit} at most"
    )]
    TooManyBindings {
        /// Storage buffers, windows included.
        count: usize,
        /// Most that are allowed.
        limit: usize,
    },
    /// naga's parser refuses the text.
    #[error("{at}: {message}")]
    Parse {
        /// The offending text.
        at: Location,
        /// naga's message.
        message: String,
    },
    /// naga cannot write the module as SPIR-V.
    #[error("the kernel has no SPIR-V: {message}")]
    Translate {
        /// naga's message.
        message: String,
    },
    /// naga's validator refuses the module.
    #[error("{at}: {message}")]
    Invalid {
        /// The offending text.
        at: Location,
        /// naga's message and its causes.
        message: String,
    },
}
