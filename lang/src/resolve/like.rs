//! `: type` and `like other` of every declaration become its schema and its chain of bases.

use std::collections::BTreeMap;

use super::model::{InFile, Model};
use super::{Found, ItemId, Program, decl_kind, quoted_list};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::schema::{self, Kind, TypeSchema};
use crate::source::Span;
use crate::suggest::suggest;
use crate::syntax::{Base, Decl, Path};

mod of_file;

/// A chain of `like` may be this long.
const MAX_LIKE: usize = 8;

/// The models of all declarations that have one, and what is wrong with the others.
pub(crate) fn models(program: &Program) -> (BTreeMap<ItemId, Model>, Vec<Diagnostic>) {
    let mut bases = Bases { program, diagnostics: Vec::new(), direct: BTreeMap::new() };
    for id in program.ids() {
        if let Some(decl) = program.decl(id) {
            let base = bases.direct(id, decl);
            bases.direct.insert(id, base);
        }
    }
    let mut models = BTreeMap::new();
    let ids: Vec<ItemId> = bases.direct.keys().copied().collect();
    for id in ids {
        if let Some(model) = bases.follow(id) {
            models.insert(id, model);
        }
    }
    (models, bases.diagnostics)
}

/// What stands between the name and the block.
enum Direct {
    /// A type, and an object for instances.
    Type(&'static TypeSchema, Option<(ItemId, Span)>),
    /// Another declaration of the same kind.
    Like(ItemId, Span),
    /// A material or a camera of a mesh file.
    OfFile(&'static TypeSchema, InFile),
    /// Already reported.
    Unknown,
}

struct Bases<'a> {
    program: &'a Program,
    diagnostics: Vec<Diagnostic>,
    direct: BTreeMap<ItemId, Direct>,
}

impl Bases<'_> {
    fn direct(&mut self, id: ItemId, decl: &Decl) -> Direct {
        let Some(kind) = decl_kind(decl) else {
            if let Some(word) = decl.kind {
                let text =
                    format!("`{}` is not a kind of declaration in this edition", word.word());
                let kinds: Vec<String> = Kind::ALL
                    .into_iter()
                    .filter(|kind| *kind != Kind::Shape)
                    .map(|kind| kind.name().to_owned())
                    .collect();
                let error = Diagnostic::error(Code("E0208"), text)
                    .at(decl.kind_span, "not known")
                    .with_note(format!("the kinds are {}", quoted_list(&kinds)));
                self.diagnostics.push(error);
            }
            return Direct::Unknown;
        };
        match &decl.base {
            None => self.without_base(kind, decl),
            Some(Base::Type(path)) => self.typed(id, kind, path),
            Some(Base::Like(path)) => self.like(id, kind, path),
            Some(Base::OfFile(base)) => self.of_file(id, kind, base),
            Some(Base::Error(_)) => Direct::Unknown,
        }
    }

    fn without_base(&mut self, kind: Kind, decl: &Decl) -> Direct {
        if let Some(schema) = schema::find_type(kind, "") {
            return Direct::Type(schema, None);
        }
        let word = kind.name();
        let types = type_names(kind);
        let error = Diagnostic::error(Code("E0208"), format!("`{}` has no type", decl.name.text))
            .at(decl.name.span, format!("which type of {word}?"))
            .with_note(format!("the types of {word} are {}", quoted_list(&types)));
        let error = match types.as_slice() {
            [only] => {
                let text = format!(": {only}");
                error.with_fix(Fix::sure("say its type", decl.name.span.after(), text))
            }
            _ => error.with_help(format!("write `{word} {}: {}`", decl.name.text, types[0])),
        };
        self.diagnostics.push(error);
        Direct::Unknown
    }

    fn typed(&mut self, id: ItemId, kind: Kind, path: &Path) -> Direct {
        if kind == Kind::Instance {
            let schema = schema::find_type(kind, "").expect("instances have one schema");
            return match self.named(id, path, Kind::Object) {
                Some(object) => Direct::Type(schema, Some((object, path.span))),
                None => Direct::Unknown,
            };
        }
        if let Some(schema) = schema::find_type(kind, &path.text()) {
            return Direct::Type(schema, None);
        }
        self.unknown_type(kind, path);
        Direct::Unknown
    }

    fn unknown_type(&mut self, kind: Kind, path: &Path) {
        let (word, name) = (kind.name(), path.text());
        let code = Code("E0208");
        if schema::find_type(kind, "").is_some() {
            let error = Diagnostic::error(code, format!("a {word} has no types"))
                .at(path.span, "not wanted")
                .with_help(format!("write `{word} name {{ ... }}`"));
            self.diagnostics.push(error);
            return;
        }
        let error = Diagnostic::error(code, format!("unknown {word} type `{name}`"));
        let foreign = schema::types_of(kind)
            .iter()
            .find_map(|t| t.foreign.iter().find(|f| f.0 == name).map(|f| (t.name, f.1)));
        let types = type_names(kind);
        let error = match (suggest(&name, types.iter().map(String::as_str)).first(), foreign) {
            (_, Some((ours, from))) => error
                .at(path.span, "not known")
                .with_note(format!("`{name}` is the name in {from}"))
                .with_fix(Fix::sure(format!("in `.rts` it is `{ours}`"), path.span, ours)),
            (Some(close), None) => error
                .at(path.span, format!("did you mean `{close}`?"))
                .with_fix(Fix::sure(format!("write `{close}`"), path.span, *close)),
            (None, None) => error
                .at(path.span, "not known")
                .with_note(format!("the types of {word} are {}", quoted_list(&types))),
        };
        self.diagnostics.push(error);
    }

    fn like(&mut self, id: ItemId, kind: Kind, path: &Path) -> Direct {
        match self.named(id, path, kind) {
            Some(base) => Direct::Like(base, path.span),
            None => Direct::Unknown,
        }
    }

    /// The declaration of `kind` that a whole path names.
    fn named(&mut self, id: ItemId, path: &Path, kind: Kind) -> Option<ItemId> {
        let found = match self.program.find(id.module, path, Some(kind)) {
            Ok(Found::Item(found, used)) if used == path.segments.len() => found,
            Ok(Found::Poison) => return None,
            Ok(Found::Item(found, _)) => {
                let text = format!("`{}` is not the name of {}", path.text(), kind.with_article());
                let error = Diagnostic::error(Code("E0203"), text).at(path.span, "not a name");
                let of_asset = super::item_kind(self.program.item(found)) == Some(Kind::Asset);
                self.diagnostics.push(match path.segments.as_slice() {
                    [.., last] if of_asset && last.text == kind.name() => {
                        error.with_help(format!("say which: `like {}(\"name\")`", path.text()))
                    }
                    _ => error,
                });
                return None;
            }
            Err(error) => {
                self.diagnostics.push(*error);
                return None;
            }
        };
        let item = self.program.item(found);
        if super::item_kind(item) == Some(kind) {
            return Some(found);
        }
        let word = super::item_word(item);
        let text = format!("`{}` is a {word}, not {}", path.text(), kind.with_article());
        let error = Diagnostic::error(Code("E0203"), text)
            .at(path.span, format!("{} is due here", kind.with_article()))
            .because(self.program.name_span(found), format!("declared here as {word}"));
        self.diagnostics.push(error);
        None
    }

    /// Walks the chain of `like` to its type.
    fn follow(&mut self, id: ItemId) -> Option<Model> {
        let mut chain = vec![id];
        let mut last = id;
        loop {
            match self.direct.get(&last)? {
                Direct::Type(schema, object) => {
                    let object = *object;
                    return Some(Model { schema, chain, object, of_file: None });
                }
                Direct::OfFile(schema, base) => {
                    let of_file = Some(base.clone());
                    return Some(Model { schema, chain, object: None, of_file });
                }
                Direct::Unknown => return None,
                &Direct::Like(next, span) => {
                    if chain.contains(&next) {
                        self.cycle(id, next, span);
                        return None;
                    }
                    if chain.len() > MAX_LIKE {
                        self.too_long(id, &chain);
                        return None;
                    }
                    chain.push(next);
                    last = next;
                }
            }
        }
    }

    /// Reports a cycle once, at its first declaration.
    fn cycle(&mut self, id: ItemId, next: ItemId, span: Span) {
        let mut members = vec![next];
        let mut at = next;
        while let Some(Direct::Like(base, _)) = self.direct.get(&at) {
            if *base == next {
                break;
            }
            members.push(*base);
            at = *base;
        }
        if members.iter().min() != Some(&id) {
            return;
        }
        let name = self.program.name(id);
        let text = format!("`{name}` is like itself");
        let mut error = Diagnostic::error(Code("E0211"), text);
        let own = match self.direct.get(&id) {
            Some(Direct::Like(_, span)) => *span,
            _ => span,
        };
        error = error.at(own, "this leads back to it");
        for member in members.into_iter().filter(|member| *member != id) {
            if let Some(Direct::Like(_, span)) = self.direct.get(&member) {
                let name = self.program.name(member);
                error = error.because(*span, format!("`{name}` is like this"));
            }
        }
        self.diagnostics.push(error);
    }

    fn too_long(&mut self, id: ItemId, chain: &[ItemId]) {
        // Only the first that is too long speaks; what is built on it stays silent.
        let Some(Direct::Like(base, span)) = self.direct.get(&id) else { return };
        if chain.len() > MAX_LIKE + 1 || self.depth(*base) > MAX_LIKE {
            return;
        }
        let text = format!("`{}` is built on more than {MAX_LIKE} others", self.program.name(id));
        let error = Diagnostic::error(Code("E0211"), text).at(*span, "too deep");
        self.diagnostics.push(error);
    }

    /// Number of `like` steps from a declaration, at most one more than allowed.
    fn depth(&self, id: ItemId) -> usize {
        let (mut at, mut depth) = (id, 0);
        while let Some(Direct::Like(base, _)) = self.direct.get(&at) {
            depth += 1;
            if depth > MAX_LIKE {
                break;
            }
            at = *base;
        }
        depth
    }
}

fn type_names(kind: Kind) -> Vec<String> {
    schema::types_of(kind).iter().map(|schema| schema.name.to_owned()).collect()
}
