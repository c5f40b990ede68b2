//! Modules become one text: imports are followed, declarations that the kernel does not reach are left
//! out, and every byte of the result remembers its place.

use crate::declaration::{self, Declaration, Parts, location};
use crate::error::{Location, ShaderError};
use crate::{FeatureSet, generate, modules};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::sync::LazyLock;

/// Name of the entry point of a scene's kernel.
const ENTRY: &str = "render";

/// The entry point of AOVs.
pub const AOV: Root<'_> = ("kernel/aov.wgsl", "aov");
/// What tells light groups apart, step by step; a host drives it.
pub const LIGHTS: Root<'_> = ("kernel/lights.wgsl", "lights_advance");

/// One kernel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Linked {
    /// Complete WGSL.
    pub text: String,
    /// Pieces of `text`, in order.
    pieces: Vec<Piece>,
    /// The modules that pieces come from: name and text.
    sources: Vec<(String, String)>,
}

/// Bytes that were copied in one go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Piece {
    /// First byte in the linked text.
    start: usize,
    /// Index of the source.
    source: usize,
    /// First byte in the source.
    source_start: usize,
    length: usize,
}

impl Linked {
    /// Where byte `byte` of the text was written. A byte between two pieces counts to the earlier one.
    #[must_use]
    pub fn locate(&self, byte: usize) -> Location {
        let after = self.pieces.partition_point(|piece| piece.start <= byte);
        let piece = self.pieces[after.saturating_sub(1)];
        let (file, text) = &self.sources[piece.source];
        let inside = byte.saturating_sub(piece.start).min(piece.length);
        location(file, text, piece.source_start + inside)
    }

    /// Where line `line`, column `column` of the text was written, both counted from 1.
    #[must_use]
    pub fn locate_line(&self, line: u32, column: u32) -> Location {
        let before = self.text.split_inclusive('\n').take(line.saturating_sub(1) as usize);
        self.locate(before.map(str::len).sum::<usize>() + column.saturating_sub(1) as usize)
    }

    /// The declarations, each with the comment above it, in order.
    pub fn declarations(&self) -> impl Iterator<Item = &str> {
        self.pieces.iter().map(|piece| &self.text[piece.start..piece.start + piece.length])
    }

    /// Names of the modules that the kernel is made of, in order of first use.
    #[must_use]
    pub fn files(&self) -> Vec<&str> {
        self.sources.iter().map(|(file, _)| file.as_str()).collect()
    }
}

/// The modules that are files, taken apart once: that is most of the work. One that cannot be is left out.
static FILES: LazyLock<Ready<'static>> = LazyLock::new(|| {
    let split = |(name, text): &(&'static str, &'static str)| {
        Some((*name, declaration::split(name, text).ok()?))
    };
    modules::module_texts().iter().filter_map(split).collect()
});

/// Modules by name, taken apart.
type Ready<'t> = BTreeMap<&'t str, Parts<'t>>;

/// The kernel for `features`.
pub fn link(features: &FeatureSet) -> Result<Linked, ShaderError> {
    link_roots(features, &[(generate::root_module(features), ENTRY)])
}

/// The same with what layers need beside `render`, for `features` with geometry.
pub fn link_with(features: &FeatureSet, more: &[Root<'_>]) -> Result<Linked, ShaderError> {
    link_roots(features, &[&[(generate::root_module(features), ENTRY)], more].concat())
}

fn link_roots(features: &FeatureSet, roots: &[Root<'_>]) -> Result<Linked, ShaderError> {
    let generated = generate::generated_texts(features)?;
    let written = modules::module_texts().iter().copied();
    let all: Vec<(&str, &str)> =
        written.chain(generated.iter().map(|(name, text)| (*name, text.as_str()))).collect();
    link_ready(&all, &FILES, roots)
}

/// The kernel that begins in module `root` of `modules`, each a name and a text: what [`link`] does, for
/// any set of modules.
pub fn link_modules(modules: &[(&str, &str)], root: &str) -> Result<Linked, ShaderError> {
    link_ready(modules, &Ready::new(), &[(root, ENTRY)])
}

/// A module and the function in it that a kernel is to have.
pub type Root<'r> = (&'r str, &'r str);

/// `ready`: some of the modules.
fn link_ready<'t>(
    modules: &[(&'t str, &'t str)],
    ready: &'t Ready<'t>,
    roots: &[Root<'_>],
) -> Result<Linked, ShaderError> {
    let texts: BTreeMap<&str, &str> = modules.iter().copied().collect();
    let (open, done) = (Vec::new(), BTreeSet::new());
    let mut walk = Walk { texts, ready, open, done, modules: Vec::new() };
    let unknown = |root: &str| ShaderError::NoEntry { file: root.to_owned() };
    for (root, _) in roots {
        let (name, text) = walk.texts.get_key_value(root).ok_or_else(|| unknown(root))?;
        if !walk.done.contains(name) {
            walk.visit(name, text)?;
        }
    }
    let modules = walk.modules;
    let names = declared(&modules)?;
    let entry = |(root, entry): &Root<'_>| names.get(entry).copied().ok_or_else(|| unknown(root));
    let entries = roots.iter().map(entry).collect::<Result<_, _>>()?;
    Ok(paste(&modules, &reached(&modules, &names, entries)))
}

/// A module of the kernel; imported modules come before those that import them.
struct Module<'t> {
    name: &'t str,
    text: &'t str,
    parts: Cow<'t, Parts<'t>>,
}

/// Depth-first walk over imports.
struct Walk<'t> {
    texts: BTreeMap<&'t str, &'t str>,
    ready: &'t Ready<'t>,
    open: Vec<&'t str>,
    done: BTreeSet<&'t str>,
    modules: Vec<Module<'t>>,
}

impl<'t> Walk<'t> {
    fn visit(&mut self, name: &'t str, text: &'t str) -> Result<(), ShaderError> {
        // A generated module may take the place of one that is ready.
        let ready = self.ready.get(name).filter(|parts| std::ptr::eq(parts.text, text));
        let parts = match ready {
            Some(parts) => Cow::Borrowed(parts),
            None => Cow::Owned(declaration::split(name, text)?),
        };
        self.open.push(name);
        for import in &parts.imports {
            let at = || location(name, text, import.start);
            let Some((&next, &next_text)) = self.texts.get_key_value(import.name) else {
                return Err(ShaderError::UnknownImport { at: at(), name: import.name.to_owned() });
            };
            if let Some(begin) = self.open.iter().position(|open| *open == next) {
                let mut chain: Vec<String> =
                    self.open[begin..].iter().map(|&module| module.to_owned()).collect();
                chain.push(next.to_owned());
                return Err(ShaderError::ImportCycle { at: at(), chain });
            }
            if !self.done.contains(next) {
                self.visit(next, next_text)?;
            }
        }
        self.open.pop();
        self.done.insert(name);
        self.modules.push(Module { name, text, parts });
        Ok(())
    }
}

/// Every declared name with its module and declaration.
fn declared<'m>(
    modules: &'m [Module<'_>],
) -> Result<BTreeMap<&'m str, (usize, usize)>, ShaderError> {
    let mut names: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for (m, module) in modules.iter().enumerate() {
        for (d, declaration) in module.parts.declarations.iter().enumerate() {
            if let Some((m0, d0)) = names.insert(declaration.name, (m, d)) {
                let first = &modules[m0];
                let start = first.parts.declarations[d0].start;
                return Err(ShaderError::Duplicate {
                    at: location(module.name, module.text, declaration.start),
                    first: location(first.name, first.text, start),
                    name: declaration.name.to_owned(),
                });
            }
        }
    }
    Ok(names)
}

/// The declarations that the entry points need, themselves included.
fn reached(
    modules: &[Module<'_>],
    names: &BTreeMap<&str, (usize, usize)>,
    mut open: Vec<(usize, usize)>,
) -> BTreeSet<(usize, usize)> {
    let mut found = BTreeSet::new();
    while let Some((m, d)) = open.pop() {
        if found.insert((m, d)) {
            let words = &modules[m].parts.declarations[d].words;
            open.extend(words.iter().filter_map(|word| names.get(word)));
        }
    }
    found
}

fn paste(modules: &[Module<'_>], wanted: &BTreeSet<(usize, usize)>) -> Linked {
    let mut linked = Linked { text: String::new(), pieces: Vec::new(), sources: Vec::new() };
    for (m, module) in modules.iter().enumerate() {
        let kept: Vec<&Declaration<'_>> = module
            .parts
            .declarations
            .iter()
            .enumerate()
            .filter_map(|(d, declaration)| wanted.contains(&(m, d)).then_some(declaration))
            .collect();
        if kept.is_empty() {
            continue;
        }
        let source = linked.sources.len();
        linked.sources.push((module.name.to_owned(), module.text.to_owned()));
        let _ = writeln!(linked.text, "// ---- {}", module.name);
        for declaration in kept {
            let range = declaration.range.clone();
            linked.pieces.push(Piece {
                start: linked.text.len(),
                source,
                source_start: range.start,
                length: range.len(),
            });
            linked.text += &module.text[range];
            linked.text += "\n\n";
        }
    }
    linked
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A module of the full kernel imports exactly the modules whose names it uses.
    #[test]
    fn modules_import_what_they_use_and_nothing_else() {
        let generated = generate::generated_texts(&FeatureSet::full()).expect("full links");
        let mut parts: Ready<'_> = BTreeMap::new();
        for (name, text) in modules::module_texts() {
            parts.insert(name, declaration::split(name, text).expect("modules are well formed"));
        }
        for (name, text) in &generated {
            parts.insert(name, declaration::split(name, text).expect("modules are well formed"));
        }
        let mut owners: BTreeMap<&str, &str> = BTreeMap::new();
        for (module, parts) in &parts {
            for declaration in parts.declarations.iter().filter(|d| d.name != ENTRY) {
                owners.insert(declaration.name, module);
            }
        }
        let mut wrong = Vec::new();
        for (module, _) in modules::module_texts() {
            let parts = &parts[module];
            let words = parts.declarations.iter().flat_map(|d| &d.words);
            let used: BTreeSet<&str> = words
                .filter_map(|word| owners.get(word).copied())
                .filter(|owner| owner != module)
                .collect();
            let imported: BTreeSet<&str> = parts.imports.iter().map(|i| i.name).collect();
            wrong.extend(used.difference(&imported).map(|other| format!("{module}: add {other}")));
            wrong.extend(imported.difference(&used).map(|other| format!("{module}: drop {other}")));
        }
        assert_eq!(wrong, Vec::<String>::new());
    }
}
