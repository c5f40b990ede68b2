//! What the tree says: expressions with all their parentheses, declarations with their parts.
//!
//! `tests/syntax/trees.txt` holds pairs: `--- name`, a text, `>>>`, the tree. `UPDATE=1` rewrites the
//! second parts.

use std::fmt::Write as _;

use lang::parse::parse;
use lang::source::SourceSet;
use lang::syntax::{Base, Binding, Decl, Expr, ExprKind, ImportNames, Item, ItemKind, Param, Unit};

fn unit(unit: Option<&Unit>) -> String {
    unit.map_or(String::new(), |unit| format!(" unit:{}", unit.text))
}

fn join(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join(", ")
}

fn show(expr: &Expr) -> String {
    match &expr.kind {
        ExprKind::Number(n) => format!("{}{}", n.value, unit(n.unit.as_ref())),
        ExprKind::Tuple { items, unit: u } => {
            format!("tuple({}){}", join(items.iter().map(show)), unit(u.as_ref()))
        }
        ExprKind::List(entries) => format!(
            "[{}]",
            join(entries.iter().map(|e| match &e.key {
                Some(key) => format!("{} => {}", show(key), show(&e.value)),
                None => show(&e.value),
            }))
        ),
        ExprKind::Call { path, args } => format!(
            "{}({})",
            path.text(),
            join(args.iter().map(|a| match &a.name {
                Some(name) => format!("{} := {}", name.text, show(&a.value)),
                None => show(&a.value),
            }))
        ),
        ExprKind::Path(path) => format!("path:{}", path.text()),
        ExprKind::Member { base, name } => format!("({}).{}", show(base), name.text),
        ExprKind::Edited { base, edits } => format!(
            "{} edited({})",
            show(base),
            join(edits.iter().map(|edit| {
                format!("{} {:?} = {}", edit.kind.text, edit.pattern.text, show(&edit.value))
            }))
        ),
        ExprKind::Negate(value) => format!("neg({})", show(value)),
        ExprKind::Binary { op, left, right, .. } => {
            format!("({} {} {})", show(left), op.symbol(), show(right))
        }
        ExprKind::Compare { op, left, right, .. } => {
            format!("({} {} {})", show(left), op.symbol(), show(right))
        }
        ExprKind::If { condition, then, otherwise } => {
            format!("if({}, {}, {})", show(condition), show(then), show(otherwise))
        }
        ExprKind::Range { start, end } => format!("range({}, {})", show(start), show(end)),
        ExprKind::Axis(axis) => format!("{axis:?}"),
        ExprKind::Hex(rgb) => format!("hex{rgb:?}"),
        ExprKind::Text(text) => format!("{text:?}"),
        ExprKind::Bool(value) => format!("bool:{value}"),
        ExprKind::Default => "default".to_owned(),
        ExprKind::None => "none".to_owned(),
        ExprKind::Error => "ERROR".to_owned(),
    }
}

fn binding(word: &str, binding: &Binding) -> String {
    format!("{word} {} = {}", binding.name.text, show(&binding.value))
}

fn decl(decl: &Decl) -> String {
    let kind = decl.kind.map_or("?", |kind| kind.word());
    let mut out = format!("{kind} {}", decl.name.text);
    if let Some(index) = &decl.index {
        let _ = write!(out, " index:{} in {}", index.var.text, show(&index.range));
    }
    match &decl.base {
        Some(Base::Type(path)) => out.extend([" type:", &path.text()]),
        Some(Base::Like(path)) => out.extend([" like:", &path.text()]),
        Some(Base::OfFile(base)) => {
            let _ = write!(out, " like:{}({:?})", base.path.text(), base.name.text);
        }
        Some(Base::Error(_)) => out += " base:ERROR",
        None => {}
    }
    if decl.partial {
        out += " partial";
    }
    for field in &decl.fields {
        let _ = write!(out, "\n  {} = {}", field.path.text(), show(&field.value));
    }
    out
}

fn item(item: &Item) -> String {
    let docs: String = item.docs.iter().flat_map(|line| ["doc:", line, "\n"]).collect();
    let public = if item.public { "pub " } else { "" };
    let what = match &item.kind {
        ItemKind::Import(import) => match &import.names {
            ImportNames::All => format!("import {:?}", import.path.text),
            ImportNames::As(name) => format!("import {:?} as {}", import.path.text, name.text),
            ImportNames::Only(names) => {
                let names = join(names.iter().map(|name| name.text.clone()));
                format!("import {:?} only {names}", import.path.text)
            }
        },
        ItemKind::Param(Param { name, ty, value, range }) => {
            let range = range.as_ref().map_or(String::new(), |r| format!(" in {}", show(r)));
            format!("param {}: {} = {}{range}", name.text, ty.text, show(value))
        }
        ItemKind::Let(b) => binding("let", b),
        ItemKind::Asset(b) => binding("asset", b),
        ItemKind::Texture(b) => binding("texture", b),
        ItemKind::Decl(d) => decl(d),
        ItemKind::Assert(a) => format!("assert {} or {:?}", show(&a.condition), a.message.text),
        ItemKind::Poisoned(names) => {
            format!("POISONED {}", join(names.iter().map(|name| name.text.clone())))
        }
    };
    format!("{docs}{public}{what}\n")
}

#[test]
fn trees_say_what_was_written() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/syntax/trees.txt");
    let text = std::fs::read_to_string(path).expect("the test's own file");
    let mut rewritten = String::new();
    let update = std::env::var_os("UPDATE").is_some();
    for case in text.split("--- ").skip(1) {
        let (title, rest) = case.split_once('\n').expect("a line with the name");
        let (input, expected) = rest.split_once(">>>\n").expect("two parts");
        let mut sources = SourceSet::new();
        let file = sources.add("", format!("rts 1\n{input}"));
        let (tree, _) = parse(&sources, file);
        let found: String = tree.items.iter().map(item).collect();
        let _ = write!(rewritten, "--- {title}\n{input}>>>\n{found}");
        if !update {
            assert_eq!(expected, found, "case `{title}`");
        }
    }
    if update {
        std::fs::write(path, rewritten).expect("the test's own file");
    }
}

#[test]
fn spans_cover_what_was_written() {
    let text =
        "rts 1\npub let a = (hour - 6h) * 2 // c\ninstance b[i in 0..6]: c.d { at = (1, 2)m }\n";
    let mut sources = SourceSet::new();
    let file = sources.add("", text);
    let (tree, _) = parse(&sources, file);
    let slices: Vec<&str> = tree.items.iter().map(|item| sources.slice(item.span)).collect();
    assert_eq!(slices[0], "pub let a = (hour - 6h) * 2");
    assert_eq!(slices[1], "instance b[i in 0..6]: c.d { at = (1, 2)m }");
    let ItemKind::Let(a) = &tree.items[0].kind else { panic!("a let") };
    let ExprKind::Binary { left, op_span, .. } = &a.value.kind else { panic!("a product") };
    assert_eq!((sources.slice(left.span), sources.slice(*op_span)), ("(hour - 6h)", "*"));
    let ItemKind::Decl(b) = &tree.items[1].kind else { panic!("an instance") };
    assert_eq!(sources.slice(b.index.as_ref().expect("an index").span), "[i in 0..6]");
    assert_eq!(sources.slice(b.block), "{ at = (1, 2)m }");
    assert_eq!(sources.slice(b.fields[0].span), "at = (1, 2)m");
    assert_eq!(sources.slice(b.fields[0].value.span), "(1, 2)m");
}
