//! Sources become numbers of lines, without those that only tests need.

use std::collections::BTreeSet;
use std::ops::AddAssign;

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{ImplItem, Item};

use super::modules::{attributes, is_for_tests};

/// How long sources are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lines {
    /// With comments and blank lines.
    pub all: usize,
    /// With neither blank lines nor lines that are comments only.
    pub code: usize,
}

impl AddAssign for Lines {
    fn add_assign(&mut self, other: Self) {
        self.all += other.all;
        self.code += other.code;
    }
}

/// Lines of a text whose comments begin with `//`.
pub(super) fn plain(text: &str) -> Lines {
    count(text.lines())
}

/// Lines of Rust, less those of what `#[cfg(test)]` marks.
pub(super) fn rust(text: &str, source: &syn::File) -> Lines {
    let mut tests = Tests(BTreeSet::new());
    tests.visit_file(source);
    let product = text.lines().enumerate().filter(|(index, _)| !tests.0.contains(&(index + 1)));
    count(product.map(|(_, line)| line))
}

fn count<'a>(lines: impl Iterator<Item = &'a str>) -> Lines {
    let mut counted = Lines::default();
    for line in lines {
        let line = line.trim_start();
        counted.all += 1;
        counted.code += usize::from(!line.is_empty() && !line.starts_with("//"));
    }
    counted
}

/// Numbers of the lines of tests.
struct Tests(BTreeSet<usize>);

impl Tests {
    fn add(&mut self, item: &impl Spanned) {
        let span = item.span();
        self.0.extend(span.start().line..=span.end().line);
    }
}

impl<'ast> Visit<'ast> for Tests {
    fn visit_item(&mut self, item: &'ast Item) {
        if is_for_tests(attributes(item)) {
            self.add(item);
        } else {
            visit::visit_item(self, item);
        }
    }

    fn visit_impl_item(&mut self, item: &'ast ImplItem) {
        match item {
            ImplItem::Fn(function) if is_for_tests(&function.attrs) => self.add(function),
            _ => visit::visit_impl_item(self, item),
        }
    }
}
