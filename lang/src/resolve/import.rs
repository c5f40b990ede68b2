//! Loads the root file and everything it imports, and gives every name of every file its meaning.

use std::collections::{BTreeMap, BTreeSet};

use super::{Entry, ItemId, Module, Program, Target, item_name};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::parse;
use crate::source::{
    FileId, LoadError, Loader, MAX_FILE_BYTES, MAX_SCENE_BYTES, SourceSet, Span, is_scene_text,
};
use crate::standard;
use crate::suggest::suggest;
use crate::syntax::{File, Import, ImportNames, Item, ItemKind};

/// Imports may be nested this deep, the root included.
const MAX_IMPORT_DEPTH: usize = 64;

/// Loads the root and all imports.
pub(crate) fn load(
    sources: &mut SourceSet,
    root_name: &str,
    root_text: &str,
    loader: &mut dyn Loader,
) -> (Program, Vec<Diagnostic>) {
    let mut loading = Loading {
        sources,
        loader,
        program: Program::default(),
        by_name: BTreeMap::new(),
        stack: Vec::new(),
        prefixes: BTreeMap::new(),
        diagnostics: Vec::new(),
        n_bytes: root_text.len(),
    };
    let file = loading.sources.add(root_name, root_text);
    loading.module(file, String::new());
    (loading.program, loading.diagnostics)
}

struct Loading<'a> {
    sources: &'a mut SourceSet,
    loader: &'a mut dyn Loader,
    program: Program,
    /// Modules that are complete, by the name of their file.
    by_name: BTreeMap<String, u32>,
    /// Files that are being loaded, with the import that led to each.
    stack: Vec<(String, Option<Span>)>,
    prefixes: BTreeMap<String, u32>,
    diagnostics: Vec<Diagnostic>,
    /// Bytes of all texts so far.
    n_bytes: usize,
}

impl Loading<'_> {
    /// Parses one file, loads what it imports, then declares its names.
    fn module(&mut self, file: FileId, prefix: String) -> u32 {
        let (tree, diagnostics) = parse::parse(self.sources, file);
        self.diagnostics.extend(diagnostics);
        let index = u32::try_from(self.program.modules.len()).unwrap_or(u32::MAX);
        let module =
            Module { file, prefix, tree: File::default(), names: BTreeMap::new(), imports: vec![] };
        self.program.modules.push(module);
        let name = self.sources.name(file).to_owned();
        self.stack.push((name.clone(), None));
        let imported = self.import_all(file, &tree, index);
        self.stack.pop();
        self.by_name.insert(name, index);
        let names = self.declare(&tree, index, &imported);
        let module = &mut self.program.modules[index as usize];
        module.tree = tree;
        module.names = names;
        module.imports = import_spans(&module.tree, &imported);
        index
    }

    /// Loads the imports of a file; `None` for those that failed. They are visited in the order of
    /// their paths, so that the order in the text does not decide how things are called.
    fn import_all(&mut self, file: FileId, tree: &File, importer: u32) -> Vec<Option<u32>> {
        let mut imports: Vec<(usize, &Import)> = Vec::new();
        for item in &tree.items {
            if let ItemKind::Import(import) = &item.kind {
                imports.push((imports.len(), import));
            }
        }
        let mut loaded = vec![None; imports.len()];
        imports.sort_by_key(|(_, import)| {
            let alias = match &import.names {
                ImportNames::As(name) => name.text.as_str(),
                _ => "",
            };
            (alias.is_empty(), alias, import.path.text.as_str())
        });
        for (i, import) in imports {
            loaded[i] = self.import(file, import, importer);
        }
        loaded
    }

    fn import(&mut self, file: FileId, import: &Import, importer: u32) -> Option<u32> {
        let path = import.path.text.as_str();
        if let Some(problem) = self.refuse(import) {
            self.diagnostics.push(problem);
            return None;
        }
        let importing = self.sources.name(file).to_owned();
        let standard = path.strip_prefix("std:").and_then(standard::text);
        let found = match standard {
            Some(text) => Ok((path.to_owned(), text.to_owned())),
            None => self.loader.load(&importing, path),
        };
        let (name, text) = match found {
            Ok(found) => found,
            Err(error) => {
                self.diagnostics.push(unreadable(import, &error));
                return None;
            }
        };
        if let Some(&module) = self.by_name.get(&name) {
            return Some(module);
        }
        if self.stack.iter().any(|(other, _)| *other == name) {
            self.diagnostics.push(self.cycle(import, &name));
            return None;
        }
        if let Err(error) = self.take_in(import, &text) {
            self.diagnostics.push(*error);
            return None;
        }
        if let Some(top) = self.stack.last_mut() {
            top.1 = Some(import.path.span);
        }
        let prefix = self.prefix(import, importer);
        let file = self.sources.add(name, text);
        Some(self.module(file, prefix))
    }

    /// Counts a text that was found, or refuses it.
    fn take_in(&mut self, import: &Import, text: &str) -> Result<(), Box<Diagnostic>> {
        let mib = |bytes: usize| bytes >> 20;
        if text.len() > MAX_FILE_BYTES {
            let why = format!("larger than {} MiB", mib(MAX_FILE_BYTES));
            return Err(Box::new(unreadable(import, &LoadError::Unreadable(why))));
        }
        self.n_bytes += text.len();
        if self.n_bytes > MAX_SCENE_BYTES {
            let why =
                format!("the scene would have more than {} MiB of text", mib(MAX_SCENE_BYTES));
            return Err(Box::new(unreadable(import, &LoadError::Unreadable(why))));
        }
        if !is_scene_text(text) {
            // Nothing of it is shown: it may be any file.
            let (path, span) = (&import.path.text, import.path.span);
            let error = Diagnostic::error(Code("E0209"), format!("`{path}` is not a scene text"));
            let error = error.at(span, "it does not begin with `rts`");
            return Err(Box::new(error.with_help("a file that is imported begins with `rts 1`")));
        }
        Ok(())
    }

    /// Imports that need no look at a disk to be refused.
    fn refuse(&self, import: &Import) -> Option<Diagnostic> {
        let (path, span) = (import.path.text.as_str(), import.path.span);
        let error = |text: String| Diagnostic::error(Code("E0209"), text);
        if let Some(module) = path.strip_prefix("std:") {
            return no_standard(import, module);
        }
        if path.contains('\\') {
            let fix = Fix::sure("use `/`", span, format!("\"{}\"", path.replace('\\', "/")));
            let text = "an import path has a `\\` in it";
            return Some(error(text.to_owned()).at(span, "use `/`").with_fix(fix));
        }
        if path.is_empty() {
            return Some(error("an import names no file".to_owned()).at(span, "empty"));
        }
        if self.stack.len() >= MAX_IMPORT_DEPTH {
            let text = format!("imports are nested deeper than {MAX_IMPORT_DEPTH} files");
            return Some(Diagnostic::error(Code("E0210"), text).at(span, "this one is too deep"));
        }
        None
    }

    fn cycle(&self, import: &Import, name: &str) -> Diagnostic {
        let text = format!("`{name}` imports itself");
        let mut error = Diagnostic::error(Code("E0210"), text)
            .at(import.path.span, format!("`{name}` is being read already"));
        let start = self.stack.iter().position(|(other, _)| other == name).unwrap_or(0);
        for (file, span) in &self.stack[start..] {
            if let Some(span) = span.filter(|span| *span != import.path.span) {
                error = error.because(span, format!("`{file}` imports this"));
            }
        }
        error.with_help("move what both files need to a third file")
    }

    /// What stands before the names of an imported file: the alias of the first import, else its
    /// path without the ending.
    fn prefix(&mut self, import: &Import, importer: u32) -> String {
        let outer = &self.program.modules[importer as usize].prefix;
        let own = match &import.names {
            ImportNames::As(alias) => alias.text.as_str(),
            _ => import.path.text.trim_end_matches(".rts"),
        };
        let prefix = format!("{outer}{own}.");
        let n = self.prefixes.entry(prefix.clone()).or_insert(0);
        *n += 1;
        if *n == 1 { prefix } else { format!("{outer}{own}~{n}.") }
    }

    /// Fills the table of names of a module.
    fn declare(
        &mut self,
        tree: &File,
        module: u32,
        imported: &[Option<u32>],
    ) -> BTreeMap<String, Entry> {
        let mut names = Names { names: BTreeMap::new(), diagnostics: &mut self.diagnostics };
        let mut imports = imported.iter();
        let mut whole = BTreeSet::new();
        for (item, i) in tree.items.iter().zip(0..) {
            match &item.kind {
                ItemKind::Import(import) => {
                    let target = imports.next().copied().flatten();
                    if import.names == ImportNames::All && target.is_some_and(|t| !whole.insert(t))
                    {
                        continue; // all of its names are there already
                    }
                    bring_in(&self.program, import, target, &mut names);
                }
                ItemKind::Poisoned(idents) => {
                    for ident in idents {
                        names.poison(&ident.text, ident.span);
                    }
                }
                _ => declare_item(item, ItemId { module, item: i }, &mut names),
            }
        }
        names.names
    }
}

/// The complaint about a `std:` module that there is not.
fn no_standard(import: &Import, module: &str) -> Option<Diagnostic> {
    if standard::text(module).is_some() {
        return None;
    }
    let span = import.path.span;
    let error = Diagnostic::error(Code("E0209"), format!("unknown module `std:{module}`"));
    let error = error.at(span, "not known");
    if let Some(name) = suggest(module, standard::names()).first() {
        let fix = format!("did you mean `std:{name}`?");
        return Some(error.with_fix(Fix::guess(fix, span, format!("\"std:{name}\""))));
    }
    let all: Vec<String> = standard::names().map(|name| format!("`std:{name}`")).collect();
    Some(error.with_note(format!("there is {}", all.join(", "))))
}

fn import_spans(tree: &File, imported: &[Option<u32>]) -> Vec<(u32, Span)> {
    let spans = tree.items.iter().filter_map(|item| match &item.kind {
        ItemKind::Import(import) => Some(import.path.span),
        _ => None,
    });
    imported.iter().zip(spans).filter_map(|(module, span)| Some(((*module)?, span))).collect()
}

fn declare_item(item: &Item, id: ItemId, names: &mut Names) {
    let Some(name) = item_name(item) else { return };
    let known = match &item.kind {
        ItemKind::Decl(decl) => super::decl_kind(decl).is_some(),
        _ => true,
    };
    if known {
        names.add(&name.text, name.span, Target::Item(id));
    } else {
        names.poison(&name.text, name.span);
    }
}

/// Declares the names that an import brings.
fn bring_in(program: &Program, import: &Import, target: Option<u32>, names: &mut Names) {
    let span = import.path.span;
    match (&import.names, target) {
        (ImportNames::As(alias), Some(module)) => {
            names.add(&alias.text, alias.span, Target::Module(module));
        }
        (ImportNames::As(alias), None) => names.poison(&alias.text, alias.span),
        (ImportNames::Only(list), None) => {
            for name in list {
                names.poison(&name.text, name.span);
            }
        }
        (ImportNames::Only(list), Some(module)) => {
            for name in list {
                match program.find_public(module, name) {
                    Ok(Some(id)) => names.add(&name.text, name.span, Target::Item(id)),
                    Ok(None) => names.poison(&name.text, name.span),
                    Err(error) => {
                        names.diagnostics.push(*error);
                        names.poison(&name.text, name.span);
                    }
                }
            }
        }
        (ImportNames::All, Some(module)) => {
            for name in program.public_names(module) {
                if let Some(entry) = program.modules[module as usize].names.get(&name) {
                    names.add(&name, span, entry.target);
                }
            }
        }
        (ImportNames::All, None) => {}
    }
}

struct Names<'a> {
    names: BTreeMap<String, Entry>,
    diagnostics: &'a mut Vec<Diagnostic>,
}

impl Names<'_> {
    fn add(&mut self, name: &str, span: Span, target: Target) {
        match self.names.get(name) {
            None => {
                self.names.insert(name.to_owned(), Entry { target, span });
            }
            Some(first) if first.target == target || first.target == Target::Poison => {}
            Some(first) => {
                let error = Diagnostic::error(Code("E0204"), format!("`{name}` is declared twice"))
                    .at(span, "declared again")
                    .because(first.span, "first declared here")
                    .with_help("names are shared by all kinds of declarations: rename one of them");
                self.diagnostics.push(error);
            }
        }
    }

    /// A name that could not be read stands for anything.
    fn poison(&mut self, name: &str, span: Span) {
        let poison = Entry { target: Target::Poison, span };
        self.names.entry(name.to_owned()).or_insert(poison);
    }
}

fn unreadable(import: &Import, error: &LoadError) -> Diagnostic {
    let (path, span) = (&import.path.text, import.path.span);
    let diagnostic = |text: String| Diagnostic::error(Code("E0209"), text);
    match error {
        LoadError::NotFound => diagnostic(format!("cannot find `{path}`"))
            .at(span, "no such file")
            .with_note("the path is relative to the file that imports it"),
        LoadError::WrongCase(real) => diagnostic(format!("cannot find `{path}`, only `{real}`"))
            .at(span, "upper and lower case differ")
            .with_note("some systems would find it, others would not"),
        LoadError::NotText(byte) => diagnostic(format!("`{path}` is not UTF-8 text"))
            .at(span, format!("byte {byte} is not UTF-8")),
        LoadError::Unreadable(why) => {
            diagnostic(format!("cannot read `{path}`")).at(span, why.clone())
        }
    }
}
