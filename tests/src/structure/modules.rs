//! A crate's root file becomes its modules: which file each is written in, and what its names stand for.
//!
//! Knows modules and `use`, no types: whose method `value.name()` calls is not seen. What `#[cfg(test)]` marks is left
//! out.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use syn::punctuated::Punctuated;
use syn::{Attribute, Item, Meta, Token, UseTree};

/// One module of a crate.
#[derive(Debug)]
pub(super) struct Module {
    /// Index in [`Package::files`].
    pub(super) file: usize,
    pub(super) parent: Option<usize>,
    names: BTreeMap<String, Vec<Name>>,
}

/// What a name stands for where it is declared.
#[derive(Clone, Debug)]
enum Name {
    Module(usize),
    /// Declared here.
    Item,
    /// Imported, from the module's point of view.
    Import(Vec<String>),
}

/// What a path leads to: a module, or an item with the file that declares it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Definition {
    Module(usize),
    Item(usize),
}

/// The modules of the targets of one package, and their sources.
#[derive(Default)]
pub(super) struct Package {
    pub(super) files: Vec<PathBuf>,
    pub(super) modules: Vec<Module>,
    /// Module and source of each file; a file that is a module twice is here twice.
    pub(super) sources: Vec<(usize, syn::File)>,
    /// Files of `macro_rules!`, which are in scope after their text, not along paths.
    macros: BTreeMap<String, usize>,
}

/// One name of a `use` declaration: the path, and what it is called from then on.
pub(super) struct Imported {
    pub(super) path: Vec<String>,
    pub(super) name: String,
    pub(super) line: usize,
}

impl Package {
    /// Adds the crate that begins in `root`.
    pub(super) fn add_crate(&mut self, root: &Path) -> io::Result<()> {
        let folder = root.parent().unwrap_or(Path::new("")).to_owned();
        self.add_file(root, &folder, None)?;
        Ok(())
    }

    /// Adds the module in `path`, whose own modules lie in `folder`.
    fn add_file(&mut self, path: &Path, folder: &Path, parent: Option<usize>) -> io::Result<usize> {
        let text = fs::read_to_string(path).map_err(|error| {
            io::Error::new(error.kind(), format!("{}: {error}", path.display()))
        })?;
        let source = syn::parse_file(&text)
            .map_err(|error| io::Error::other(format!("{}: {error}", path.display())))?;
        let file = self.files.iter().position(|known| known == path).unwrap_or_else(|| {
            self.files.push(path.to_owned());
            self.files.len() - 1
        });
        let module = self.add_module(file, parent);
        self.declare(&source.items, module, path, folder)?;
        self.sources.push((module, source));
        Ok(module)
    }

    fn add_module(&mut self, file: usize, parent: Option<usize>) -> usize {
        self.modules.push(Module { file, parent, names: BTreeMap::new() });
        self.modules.len() - 1
    }

    fn name(&mut self, module: usize, name: impl Into<String>, meaning: Name) {
        self.modules[module].names.entry(name.into()).or_default().push(meaning);
    }

    /// Enters the names of `items` into `module`; modules in files of their own are read.
    fn declare(
        &mut self,
        items: &[Item],
        module: usize,
        path: &Path,
        folder: &Path,
    ) -> io::Result<()> {
        for item in items.iter().filter(|item| !is_for_tests(attributes(item))) {
            match item {
                Item::Mod(inner) => {
                    let name = inner.ident.to_string();
                    let id = if let Some((_, items)) = &inner.content {
                        let id = self.add_module(self.modules[module].file, Some(module));
                        self.declare(items, id, path, &folder.join(&name))?;
                        id
                    } else {
                        let (file, below) = file_of(&name, &inner.attrs, path, folder);
                        self.add_file(&file, &below, Some(module))?
                    };
                    self.name(module, name, Name::Module(id));
                }
                Item::Use(declaration) => {
                    for import in imports(&declaration.tree) {
                        self.name(module, import.name, Name::Import(import.path));
                    }
                }
                Item::Macro(rules) => {
                    if let Some(name) = &rules.ident {
                        let file = self.modules[module].file;
                        self.macros.insert(name.to_string(), file);
                        self.name(module, name.to_string(), Name::Item);
                    }
                }
                other => {
                    if let Some(name) = declared(other) {
                        self.name(module, name, Name::Item);
                    }
                }
            }
        }
        Ok(())
    }

    /// The module `name` that is written inside of `module`.
    pub(super) fn inner(&self, module: usize, name: &str) -> Option<usize> {
        self.modules[module].names.get(name)?.iter().find_map(|name| match name {
            Name::Module(id) => Some(*id),
            Name::Item | Name::Import(_) => None,
        })
    }

    /// What `path` leads to as seen from `module`; nothing when it leaves the crate.
    pub(super) fn resolve(&self, module: usize, path: &[String]) -> Vec<Definition> {
        self.follow(module, path, &mut BTreeSet::new())
    }

    /// The file of a macro, by its name alone.
    pub(super) fn macro_file(&self, name: &str) -> Option<usize> {
        self.macros.get(name).copied()
    }

    fn follow(
        &self,
        module: usize,
        path: &[String],
        seen: &mut BTreeSet<(usize, String)>,
    ) -> Vec<Definition> {
        let Some((first, rest)) = path.split_first() else { return Vec::new() };
        let begin = match first.as_str() {
            "crate" => vec![Definition::Module(self.root(module))],
            "self" => vec![Definition::Module(module)],
            "super" => self.modules[module].parent.map(Definition::Module).into_iter().collect(),
            name => self.look_up(module, name, seen),
        };
        rest.iter().fold(begin, |mut from, name| {
            // A function may be called as a module is, but has nothing inside.
            if from.iter().any(|definition| matches!(definition, Definition::Module(_))) {
                from.retain(|definition| matches!(definition, Definition::Module(_)));
            }
            let step = |definition: Definition| match definition {
                // What belongs to a type is declared with the type as far as paths tell.
                Definition::Item(file) => vec![Definition::Item(file)],
                Definition::Module(id) if name == "super" => {
                    self.modules[id].parent.map(Definition::Module).into_iter().collect()
                }
                Definition::Module(id) => self.look_up(id, name, seen),
            };
            from.into_iter().flat_map(step).collect()
        })
    }

    fn look_up(
        &self,
        module: usize,
        name: &str,
        seen: &mut BTreeSet<(usize, String)>,
    ) -> Vec<Definition> {
        if !seen.insert((module, name.to_owned())) {
            return Vec::new();
        }
        let meanings = self.modules[module].names.get(name).map_or(&[][..], Vec::as_slice);
        let mut found = Vec::new();
        for meaning in meanings {
            match meaning {
                Name::Module(id) => found.push(Definition::Module(*id)),
                Name::Item => found.push(Definition::Item(self.modules[module].file)),
                Name::Import(path) => found.extend(self.follow(module, path, seen)),
            }
        }
        seen.remove(&(module, name.to_owned()));
        found
    }

    fn root(&self, module: usize) -> usize {
        self.modules[module].parent.map_or(module, |parent| self.root(parent))
    }
}

/// Where `mod name;` in `path` has its text, and where the modules of that one are.
fn file_of(name: &str, attributes: &[Attribute], path: &Path, folder: &Path) -> (PathBuf, PathBuf) {
    if let Some(given) = path_attribute(attributes) {
        let file = path.parent().unwrap_or(Path::new("")).join(given);
        let below = file.parent().unwrap_or(Path::new("")).to_owned();
        return (file, below);
    }
    let below = folder.join(name);
    let nested = below.join("mod.rs");
    if nested.exists() { (nested, below) } else { (folder.join(format!("{name}.rs")), below) }
}

fn path_attribute(attributes: &[Attribute]) -> Option<String> {
    attributes.iter().find_map(|attribute| {
        let Meta::NameValue(meta) = &attribute.meta else { return None };
        let syn::Expr::Lit(value) = &meta.value else { return None };
        let syn::Lit::Str(text) = &value.lit else { return None };
        meta.path.is_ident("path").then(|| text.value())
    })
}

/// Whether the compiler sees what has these attributes in tests only.
pub(super) fn is_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let only_tests = attribute.path().is_ident("cfg")
            && attribute.parse_args::<Meta>().is_ok_and(|condition| asks_for_test(&condition));
        only_tests || attribute.path().is_ident("test")
    })
}

/// `test`, or `all(…)` with it.
fn asks_for_test(condition: &Meta) -> bool {
    let Meta::List(list) = condition else { return condition.path().is_ident("test") };
    let parts = list.parse_args_with(Punctuated::<Meta, Token![,]>::parse_terminated);
    list.path.is_ident("all") && parts.is_ok_and(|parts| parts.iter().any(asks_for_test))
}

/// Every name that a `use` declaration brings.
pub(super) fn imports(tree: &UseTree) -> Vec<Imported> {
    fn walk(tree: &UseTree, before: &[String], found: &mut Vec<Imported>) {
        let with = |last: &syn::Ident| {
            let mut path = before.to_vec();
            // `use a::{self}` is `use a`.
            if last != "self" || before.is_empty() {
                path.push(last.to_string());
            }
            path
        };
        match tree {
            UseTree::Path(step) => walk(&step.tree, &with(&step.ident), found),
            UseTree::Group(group) => group.items.iter().for_each(|tree| walk(tree, before, found)),
            UseTree::Name(name) => {
                let path = with(&name.ident);
                let own = path.last().cloned().unwrap_or_default();
                found.push(Imported { path, name: own, line: name.ident.span().start().line });
            }
            UseTree::Rename(renamed) => found.push(Imported {
                path: with(&renamed.ident),
                name: renamed.rename.to_string(),
                line: renamed.ident.span().start().line,
            }),
            UseTree::Glob(glob) => found.push(Imported {
                path: before.to_vec(),
                name: "*".to_owned(),
                line: glob.star_token.spans[0].start().line,
            }),
        }
    }
    let mut found = Vec::new();
    walk(tree, &[], &mut found);
    found
}

/// The name that an item declares.
fn declared(item: &Item) -> Option<String> {
    let name = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::TraitAlias(item) => &item.ident,
        Item::Type(item) => &item.ident,
        Item::Union(item) => &item.ident,
        _ => return None,
    };
    Some(name.to_string())
}

/// Attributes of an item.
pub(super) fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::ExternCrate(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::ForeignMod(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::TraitAlias(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Union(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}
