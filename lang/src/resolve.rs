//! Names: files and their imports become modules in which every name has one meaning.
//!
//! Each file is loaded once, whoever imports it. Imports form a tree without cycles. What a name
//! stands for is decided here; what the thing behind it is worth is not known here.

use std::cell::Cell;
use std::collections::BTreeMap;

use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::schema::Kind;
use crate::source::{FileId, Span};
use crate::suggest::suggest;
use crate::syntax::{Decl, DeclKind, File, Ident, Item, ItemKind, Path};
use crate::texture::VERTEX_COLOR;

mod import;
pub(crate) mod like;
mod model;

pub(crate) use import::load;
pub(crate) use model::{InFile, Model};

/// Names that may be compared in search of similar ones; a file full of unknown names would
/// otherwise take time that grows with the square of its length.
const MAX_COMPARED: usize = 500_000;

/// A declaration: which module, which item of its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ItemId {
    pub(crate) module: u32,
    pub(crate) item: u32,
}

/// All files of a scene. Module 0 is the root.
#[derive(Debug, Default)]
pub(crate) struct Program {
    pub(crate) modules: Vec<Module>,
    /// Names compared so far in search of similar ones.
    compared: Cell<usize>,
}

/// One file.
#[derive(Debug)]
pub(crate) struct Module {
    pub(crate) file: FileId,
    /// What stands before its names in the scene, such as `lantern.`; empty for the root.
    pub(crate) prefix: String,
    pub(crate) tree: File,
    pub(crate) names: BTreeMap<String, Entry>,
    /// Modules it imports, with the place of the import.
    pub(crate) imports: Vec<(u32, Span)>,
}

/// What a name stands for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    pub(crate) target: Target,
    /// Where it was declared or imported.
    pub(crate) span: Span,
}

/// See [`Entry`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// A declaration.
    Item(ItemId),
    /// `import ... as name`.
    Module(u32),
    /// Something that could not be read; any use of it is fine.
    Poison,
}

/// A resolved path: the target and how many segments led to it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Found {
    /// A declaration, and the index of the first segment after its name.
    Item(ItemId, usize),
    /// Already reported.
    Poison,
}

/// The name that an item declares, with its place.
pub(crate) fn item_name(item: &Item) -> Option<&Ident> {
    match &item.kind {
        ItemKind::Param(param) => Some(&param.name),
        ItemKind::Let(binding) | ItemKind::Asset(binding) | ItemKind::Texture(binding) => {
            Some(&binding.name)
        }
        ItemKind::Decl(decl) => Some(&decl.name),
        ItemKind::Import(_) | ItemKind::Assert(_) | ItemKind::Poisoned(_) => None,
    }
}

/// The kind of a declaration that this edition knows.
pub(crate) fn decl_kind(decl: &Decl) -> Option<Kind> {
    match decl.kind? {
        DeclKind::Material => Some(Kind::Material),
        DeclKind::Medium => Some(Kind::Medium),
        DeclKind::Object => Some(Kind::Object),
        DeclKind::Instance => Some(Kind::Instance),
        DeclKind::Light => Some(Kind::Light),
        DeclKind::Sky => Some(Kind::Sky),
        DeclKind::Camera => Some(Kind::Camera),
        DeclKind::Film => Some(Kind::Film),
        DeclKind::Render => Some(Kind::Render),
        DeclKind::Scatter => None,
    }
}

/// The kind of an item; `None` for values, imports and what could not be read.
pub(crate) fn item_kind(item: &Item) -> Option<Kind> {
    match &item.kind {
        ItemKind::Asset(_) => Some(Kind::Asset),
        ItemKind::Texture(_) => Some(Kind::Texture),
        ItemKind::Decl(decl) => decl_kind(decl),
        _ => None,
    }
}

/// What the words before an item's name say it is, for messages.
pub(crate) fn item_word(item: &Item) -> &'static str {
    match &item.kind {
        ItemKind::Param(_) => "param",
        ItemKind::Let(_) => "let",
        _ => item_kind(item).map_or("declaration", Kind::name),
    }
}

impl Program {
    /// The item behind an id.
    pub(crate) fn item(&self, id: ItemId) -> &Item {
        &self.modules[id.module as usize].tree.items[id.item as usize]
    }

    /// The declaration with a block behind an id.
    pub(crate) fn decl(&self, id: ItemId) -> Option<&Decl> {
        match &self.item(id).kind {
            ItemKind::Decl(decl) => Some(decl),
            _ => None,
        }
    }

    /// The declared name of an item; empty for items without one.
    pub(crate) fn name(&self, id: ItemId) -> &str {
        item_name(self.item(id)).map_or("", |name| name.text.as_str())
    }

    /// Where the name of an item is declared.
    pub(crate) fn name_span(&self, id: ItemId) -> Span {
        let item = self.item(id);
        item_name(item).map_or(item.span, |name| name.span)
    }

    /// The name by which an item is known in the whole scene.
    pub(crate) fn full_name(&self, id: ItemId) -> String {
        format!("{}{}", self.modules[id.module as usize].prefix, self.name(id))
    }

    /// Where one module imports another.
    pub(crate) fn import_span(&self, importer: u32, imported: u32) -> Option<Span> {
        let imports = &self.modules[importer as usize].imports;
        imports.iter().find(|(module, _)| *module == imported).map(|(_, span)| *span)
    }

    /// Every item of every module, in order.
    pub(crate) fn ids(&self) -> impl Iterator<Item = ItemId> + '_ {
        self.modules.iter().zip(0..).flat_map(|(module, m)| {
            let n = u32::try_from(module.tree.items.len()).unwrap_or(u32::MAX);
            (0..n).map(move |item| ItemId { module: m, item })
        })
    }

    /// Finds the declaration that a path begins with. `kind` is what the place wants, if it wants
    /// one, and decides which names are suggested.
    pub(crate) fn find(
        &self,
        module: u32,
        path: &Path,
        kind: Option<Kind>,
    ) -> Result<Found, Box<Diagnostic>> {
        let first = &path.segments[0];
        let names = &self.modules[module as usize].names;
        match names.get(&first.text).map(|entry| entry.target) {
            Some(Target::Item(id)) => Ok(Found::Item(id, 1)),
            Some(Target::Poison) => Ok(Found::Poison),
            Some(Target::Module(target)) => match path.segments.get(1) {
                Some(second) => self.find_public(target, second).map(|found| match found {
                    Some(id) => Found::Item(id, 2),
                    None => Found::Poison,
                }),
                None => Err(Box::new(self.module_as_value(target, first))),
            },
            None => Err(Box::new(self.unknown_name(module, first, kind))),
        }
    }

    /// Finds the declaration that a path begins with, without a word if there is none.
    pub(crate) fn lookup(&self, module: u32, path: &Path) -> Option<ItemId> {
        let names = &self.modules[module as usize].names;
        match names.get(&path.segments[0].text)?.target {
            Target::Item(id) => Some(id),
            Target::Poison => None,
            Target::Module(target) => {
                let names = &self.modules[target as usize].names;
                match names.get(&path.segments.get(1)?.text)?.target {
                    Target::Item(id) if id.module == target && self.item(id).public => Some(id),
                    _ => None,
                }
            }
        }
    }

    /// Finds a public name of a module; `None` is one that could not be read.
    pub(crate) fn find_public(
        &self,
        module: u32,
        name: &Ident,
    ) -> Result<Option<ItemId>, Box<Diagnostic>> {
        let entry = self.modules[module as usize].names.get(&name.text);
        match entry.map(|entry| entry.target) {
            Some(Target::Poison) => Ok(None),
            Some(Target::Item(id)) if id.module == module => {
                if self.item(id).public {
                    Ok(Some(id))
                } else {
                    Err(Box::new(self.private(id, name)))
                }
            }
            _ => Err(Box::new(self.not_in_module(module, name))),
        }
    }

    fn module_as_value(&self, target: u32, name: &Ident) -> Diagnostic {
        let names = &self.modules[target as usize].names;
        self.compared.set(self.compared.get().saturating_add(names.len()));
        let few = self.compared.get() <= MAX_COMPARED;
        let mut public = names.iter().filter(|(_, entry)| few && self.is_public(target, entry));
        let example = public.next().map_or("name", |(name, _)| name);
        Diagnostic::error(
            Code("E0203"),
            format!("`{}` is an imported file, not a value", name.text),
        )
        .at(name.span, "a file")
        .with_help(format!("name something in it: `{}.{example}`", name.text))
    }

    fn private(&self, id: ItemId, name: &Ident) -> Diagnostic {
        let item = self.item(id);
        let text = format!("`{}` is private in its file", name.text);
        let fix = Fix::sure("make it public", item.span.before(), "pub ");
        Diagnostic::error(Code("E0206"), text)
            .at(name.span, "not visible here")
            .because(self.name_span(id), "declared here without `pub`")
            .with_fix(fix)
    }

    fn not_in_module(&self, module: u32, name: &Ident) -> Diagnostic {
        self.compared.set(self.compared.get() + self.modules[module as usize].names.len());
        let public =
            if self.compared.get() > MAX_COMPARED { vec![] } else { self.public_names(module) };
        let text = format!("that file has no `{}`", name.text);
        let error = Diagnostic::error(Code("E0202"), text);
        let mut error = did_you_mean(error, name, public.iter().map(String::as_str));
        if error.fixes.is_empty() && !public.is_empty() && public.len() <= 12 {
            error = error.with_note(format!("its public names are {}", quoted_list(&public)));
        }
        error
    }

    fn public_names(&self, module: u32) -> Vec<String> {
        let names = &self.modules[module as usize].names;
        let public = names.iter().filter(|(_, entry)| self.is_public(module, entry));
        public.map(|(name, _)| name.clone()).collect()
    }

    /// Does a name of a module stand for something that importers of the module see?
    fn is_public(&self, module: u32, entry: &Entry) -> bool {
        match entry.target {
            Target::Item(id) => id.module == module && self.item(id).public,
            _ => false,
        }
    }

    /// Says where an imported file has the name that is not known here.
    fn in_imports(&self, error: Diagnostic, module: u32, name: &Ident) -> Diagnostic {
        let this = &self.modules[module as usize];
        for (imported, span) in &this.imports {
            let names = &self.modules[*imported as usize].names;
            let Some(Target::Item(id)) = names.get(&name.text).map(|entry| entry.target) else {
                continue;
            };
            if !self.item(id).public {
                let text = format!("`{}` is private in its file", name.text);
                return error.because(self.name_span(id), text).because(*span, "imported here");
            }
            if id.module != *imported {
                // What a file imports is not passed on.
                return error
                    .because(self.name_span(id), "declared in a file that this one does not import")
                    .because(*span, "this one does, for itself only")
                    .with_help("import the file that declares it");
            }
            let alias = this.names.iter().find(|(_, e)| e.target == Target::Module(*imported));
            if let Some((alias, _)) = alias {
                let text = format!("{alias}.{}", name.text);
                return error.with_fix(Fix::sure(format!("write `{text}`"), name.span, text));
            }
        }
        error
    }

    fn unknown_name(&self, module: u32, name: &Ident, kind: Option<Kind>) -> Diagnostic {
        let what = kind.map_or("nothing", Kind::name);
        let text = match kind {
            Some(_) => format!("no {what} named `{}`", name.text),
            None => format!("{what} is named `{}`", name.text),
        };
        let names = &self.modules[module as usize].names;
        let looked_at = names.len() + self.modules[module as usize].imports.len();
        self.compared.set(self.compared.get().saturating_add(looked_at));
        if self.compared.get() > MAX_COMPARED {
            return Diagnostic::error(Code("E0202"), text).at(name.span, "not known here");
        }
        let fits = |entry: &Entry| match (kind, entry.target) {
            (Some(kind), Target::Item(id)) => item_kind(self.item(id)) == Some(kind),
            _ => kind.is_none(),
        };
        let valid = names.iter().filter(|(_, entry)| fits(entry)).map(|(name, _)| name.as_str());
        let is_texture = kind.is_none_or(|kind| kind == Kind::Texture);
        let valid = valid.chain(is_texture.then_some(VERTEX_COLOR));
        let mut error = did_you_mean(Diagnostic::error(Code("E0202"), text), name, valid);
        if error.fixes.is_empty() {
            error = self.in_imports(error, module, name);
        }
        let similar = error.fixes.first().and_then(|fix| fix.edits.first());
        if let Some(entry) = similar.and_then(|edit| names.get(&edit.replacement)) {
            error = error.because(entry.span, "similar name, declared here");
        }
        error
    }
}

/// Marks `name` and proposes what it may have meant: one name as an edit, several as advice.
pub(crate) fn did_you_mean<'a>(
    error: Diagnostic,
    name: &Ident,
    valid: impl IntoIterator<Item = &'a str>,
) -> Diagnostic {
    let mut close = suggest(&name.text, valid);
    if name.text.chars().count() < 3 {
        // Every name of one letter is near every other one.
        close.retain(|other| other.eq_ignore_ascii_case(&name.text));
    }
    match close.as_slice() {
        [] => error.at(name.span, "not known here"),
        [one] => error.at(name.span, format!("did you mean `{one}`?")).with_fix(Fix::sure(
            format!("write `{one}`"),
            name.span,
            *one,
        )),
        several => {
            let list: Vec<String> = several.iter().map(|s| (*s).to_owned()).collect();
            error
                .at(name.span, "not known here")
                .with_help(format!("similar names: {}", quoted_list(&list)))
        }
    }
}

/// `a`, `b` and `c`, in backquotes.
pub(crate) fn quoted_list(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}
