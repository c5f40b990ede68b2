//! The modules of a package become arrows: this file names an item that that file declares.
//!
//! An arrow leads to the file that declares the item, past every re-export on the way. A re-export itself is an
//! address, as `mod x;` is, and no arrow, unless its file uses the name. In macros every path is looked up.

use std::collections::BTreeMap;

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{ImplItem, Item, ItemMod, ItemUse, Macro, Path, Visibility};

use super::modules::{Definition, Package, attributes, imports, is_for_tests};

/// One item that a file takes from another, and the line that names it first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arrow {
    /// As the path says it.
    pub item: String,
    /// Counted from 1.
    pub line: usize,
}

/// Arrows by the indices of both files, from and to.
pub(super) type Arrows = BTreeMap<(usize, usize), Arrow>;

/// All arrows of a package, and each `use path::*` of its own modules, which would hide some: file and line.
pub(super) fn arrows(package: &Package) -> (Arrows, Vec<(usize, usize)>) {
    let mut arrows = Arrows::new();
    let mut globs = Vec::new();
    for (module, source) in &package.sources {
        let file = package.modules[*module].file;
        let mut reader =
            Reader { package, module: *module, file, arrows: &mut arrows, globs: &mut globs };
        reader.visit_file(source);
    }
    (arrows, globs)
}

struct Reader<'a> {
    package: &'a Package,
    module: usize,
    file: usize,
    arrows: &'a mut Arrows,
    globs: &'a mut Vec<(usize, usize)>,
}

impl Reader<'_> {
    fn note(&mut self, path: &[String], line: usize) {
        for definition in self.package.resolve(self.module, path) {
            if let Definition::Item(file) = definition {
                self.arrow(file, path, line);
            }
        }
    }

    fn arrow(&mut self, to: usize, path: &[String], line: usize) {
        if to != self.file {
            let arrow = || Arrow { item: path.join("::"), line };
            self.arrows.entry((self.file, to)).or_insert_with(arrow);
        }
    }

    fn note_macro(&mut self, path: &[String], line: usize) {
        let known = self.package.resolve(self.module, path);
        if known.iter().any(|definition| matches!(definition, Definition::Item(_))) {
            self.note(path, line);
        } else if let Some(file) = path.last().and_then(|name| self.package.macro_file(name)) {
            self.arrow(file, path, line);
        }
    }

    /// Paths and calls of macros, in the arguments or the body of one.
    fn tokens(&mut self, tokens: TokenStream) {
        let mut path: Vec<String> = Vec::new();
        let mut line = 0;
        let mut colons = 0;
        let mut after_dot = false;
        for token in tokens {
            let dot = matches!(&token, TokenTree::Punct(mark) if mark.as_char() == '.');
            match token {
                TokenTree::Ident(_) if after_dot => self.end(&mut path, line),
                TokenTree::Ident(name) => {
                    if colons != 2 {
                        self.end(&mut path, line);
                        line = name.span().start().line;
                    }
                    colons = 0;
                    path.push(name.to_string());
                }
                TokenTree::Punct(mark) if mark.as_char() == ':' && !path.is_empty() => colons += 1,
                TokenTree::Punct(mark) if mark.as_char() == '!' && colons == 0 => {
                    self.note_macro(&path, line);
                    path.clear();
                }
                TokenTree::Group(group) => {
                    self.end(&mut path, line);
                    self.tokens(group.stream());
                    colons = 0;
                }
                TokenTree::Punct(_) | TokenTree::Literal(_) => {
                    self.end(&mut path, line);
                    colons = 0;
                }
            }
            after_dot = dot;
        }
        self.end(&mut path, line);
    }

    fn end(&mut self, path: &mut Vec<String>, line: usize) {
        self.note(path, line);
        path.clear();
    }
}

fn names(path: &Path) -> Vec<String> {
    path.segments.iter().map(|segment| segment.ident.to_string()).collect()
}

fn line(path: &Path) -> usize {
    path.segments.first().map_or(0, |segment| segment.ident.span().start().line)
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        if !is_for_tests(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_mod(&mut self, inner: &'ast ItemMod) {
        let id = self.package.inner(self.module, &inner.ident.to_string());
        if let (Some((_, items)), Some(id)) = (&inner.content, id) {
            let outer = std::mem::replace(&mut self.module, id);
            for item in items {
                self.visit_item(item);
            }
            self.module = outer;
        }
    }

    fn visit_impl_item(&mut self, item: &'ast ImplItem) {
        let attributes = match item {
            ImplItem::Fn(item) => &item.attrs[..],
            ImplItem::Const(item) => &item.attrs,
            _ => &[],
        };
        if !is_for_tests(attributes) {
            visit::visit_impl_item(self, item);
        }
    }

    fn visit_item_use(&mut self, declaration: &'ast ItemUse) {
        for import in imports(&declaration.tree) {
            let found = self.package.resolve(self.module, &import.path);
            // What a module is imported for is seen where it is used.
            let module = found.iter().any(|found| matches!(found, Definition::Module(_)));
            if module && import.name == "*" {
                self.globs.push((self.file, import.line));
            }
            if !module && matches!(declaration.vis, Visibility::Inherited) {
                self.note(&import.path, import.line);
            }
        }
    }

    fn visit_path(&mut self, path: &'ast Path) {
        self.note(&names(path), line(path));
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &'ast Macro) {
        self.note_macro(&names(&call.path), line(&call.path));
        self.tokens(call.tokens.clone());
    }

    // Neither `pub(in path)` nor `#[derive(…)]` takes anything from a file.
    fn visit_visibility(&mut self, _: &'ast Visibility) {}

    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
}
