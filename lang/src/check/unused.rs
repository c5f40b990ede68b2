//! Warns of declarations that nothing refers to.

use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::resolve::{ItemId, item_name, item_word};
use crate::schema::Kind;
use crate::syntax::{Base, ItemKind, OfFile};

/// Looks at a scene without errors. Names that begin with `_` may be unused.
pub(super) fn check(ev: &mut Evaluator<'_>) {
    let program = ev.program;
    for id in program.ids() {
        if let Some(decl) = program.decl(id)
            && let Some(Base::Like(path) | Base::Type(path) | Base::OfFile(OfFile { path, .. })) =
                &decl.base
            && let Some(base) = program.lookup(id.module, path)
        {
            ev.used.insert(base);
        }
    }
    let unused: Vec<ItemId> = program
        .ids()
        .filter(|id| {
            let item = program.item(*id);
            let kind = crate::resolve::item_kind(item);
            let counts = matches!(item.kind, ItemKind::Let(_) | ItemKind::Param(_))
                || matches!(
                    kind,
                    Some(
                        Kind::Material | Kind::Medium | Kind::Texture | Kind::Asset | Kind::Object
                    )
                );
            counts && !item.public && !ev.used.contains(id)
        })
        .collect();
    for id in unused {
        let item = program.item(id);
        let Some(name) = item_name(item).filter(|name| !name.text.starts_with('_')) else {
            continue;
        };
        let text = format!("{} `{}` is never used", item_word(item), name.text);
        let warning = Diagnostic::warning(Code("W0201"), "unused", text)
            .at(name.span, "nothing refers to it")
            .with_help(format!("remove it, or call it `_{}`", name.text));
        ev.tell(warning);
    }
}
