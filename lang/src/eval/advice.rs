//! What is added to a diagnostic: labels about names, proposals of units.

use super::{Evaluator, Scope};
use crate::diagnostic::{Diagnostic, Fix};
use crate::syntax::{self, Expr, ExprKind, ItemKind};
use crate::units::{self, Dim};

impl Evaluator<'_> {
    /// Labels saying of what dimension the names in an expression are.
    pub(crate) fn explain_names(
        &self,
        mut error: Diagnostic,
        expr: &Expr,
        scope: Scope<'_>,
    ) -> Diagnostic {
        for path in paths(expr).into_iter().take(3) {
            let Some(id) = self.program.lookup(scope.module, path) else { continue };
            let is_value =
                matches!(self.program.item(id).kind, ItemKind::Param(_) | ItemKind::Let(_));
            let dim = match self.bindings.get(&id) {
                Some(Some(value)) if is_value => value.dim(),
                _ => None,
            };
            let span = self.program.name_span(id);
            if let Some(dim) = dim.filter(|_| error.labels.iter().all(|label| label.span != span)) {
                error = error.because(span, format!("`{}` is {dim}", self.program.name(id)));
            }
        }
        error
    }

    /// Labels saying what the names in an expression are worth.
    pub(crate) fn explain_values(
        &self,
        mut error: Diagnostic,
        expr: &Expr,
        scope: Scope<'_>,
    ) -> Diagnostic {
        for path in paths(expr).into_iter().take(4) {
            if let Some(id) = self.program.lookup(scope.module, path)
                && let Some(value) = self.known_binding(id)
            {
                let text = format!("`{}` is {}", self.program.name(id), value.shown());
                error = error.because(self.program.name_span(id), text);
            }
        }
        error
    }
}

/// Every path of an expression, calls included.
fn paths(expr: &Expr) -> Vec<&syntax::Path> {
    let mut paths = Vec::new();
    walk_paths(expr, &mut |path| paths.push(path));
    paths
}

/// Calls `visit` for every path of an expression, calls included.
pub(crate) fn walk_paths<'e>(expr: &'e Expr, visit: &mut dyn FnMut(&'e syntax::Path)) {
    match &expr.kind {
        ExprKind::Path(path) => visit(path),
        ExprKind::Call { path, args } => {
            if path.segments.len() > 1 {
                visit(path);
            }
            for arg in args {
                walk_paths(&arg.value, visit);
            }
        }
        ExprKind::Tuple { items, .. } => items.iter().for_each(|item| walk_paths(item, visit)),
        ExprKind::List(entries) => entries.iter().for_each(|e| walk_paths(&e.value, visit)),
        ExprKind::Member { base, .. } => walk_paths(base, visit),
        ExprKind::Edited { base, edits } => {
            walk_paths(base, visit);
            for edit in edits {
                walk_paths(&edit.value, visit);
            }
        }
        ExprKind::Negate(inner) => walk_paths(inner, visit),
        ExprKind::Binary { left, right, .. } | ExprKind::Compare { left, right, .. } => {
            walk_paths(left, visit);
            walk_paths(right, visit);
        }
        ExprKind::If { condition, then, otherwise } => {
            for branch in [condition, then, otherwise] {
                walk_paths(branch, visit);
            }
        }
        ExprKind::Range { start, end } => {
            walk_paths(start, visit);
            walk_paths(end, visit);
        }
        _ => {}
    }
}

/// The unit written on a literal.
pub(super) fn literal_unit(expr: &Expr) -> Option<&str> {
    match &expr.kind {
        ExprKind::Number(syntax::Number { unit: Some(unit), .. })
        | ExprKind::Tuple { unit: Some(unit), .. } => Some(&unit.text),
        ExprKind::Negate(inner) => literal_unit(inner),
        _ => None,
    }
}

/// Is a number or a tuple written without a unit, so that one can be put behind it?
pub(super) fn takes_unit(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Number(number) => number.unit.is_none(),
        ExprKind::Tuple { unit, .. } => unit.is_none(),
        ExprKind::Negate(inner) => takes_unit(inner) && inner.span.end == expr.span.end,
        _ => false,
    }
}

/// Proposes a unit of `dim` behind a literal, or a factor behind anything else.
pub(crate) fn with_unit_fix(error: Diagnostic, expr: &Expr, dim: Dim, unit: &str) -> Diagnostic {
    let unit = match unit {
        "" => units::si_symbol(dim).unwrap_or_default(),
        known => known,
    };
    if unit.is_empty() {
        return error;
    }
    let message = "add the unit";
    if takes_unit(expr) {
        error.with_fix(Fix::sure(message, expr.span.after(), unit))
    } else if matches!(expr.kind, ExprKind::Path(_) | ExprKind::Call { .. }) {
        error.with_fix(Fix::guess(message, expr.span.after(), format!(" * 1{unit}")))
    } else {
        error.with_help(format!("multiply it by `1{unit}`"))
    }
}
