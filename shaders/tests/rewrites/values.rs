//! naga's IR, read through lets, arguments, results and the making of vectors: what may have computed a value?

use naga::Expression as E;
use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{
    BinaryOperator, Block, Expression, Function, Handle, Literal, MathFunction, Module, ScalarKind,
    Statement, TypeInner, UnaryOperator,
};
use std::collections::BTreeSet;

type At = Handle<Expression>;

/// An expression of the function with this index; the entry point comes last.
pub(crate) type Place = (usize, At);

/// A call: the caller, the callee, the arguments.
struct Call {
    caller: usize,
    callee: usize,
    arguments: Vec<At>,
}

pub(crate) struct Kernel<'a> {
    module: &'a Module,
    pub(crate) functions: Vec<(&'a Function, &'a FunctionInfo)>,
    calls: Vec<Call>,
    /// What each function returns, wherever it does.
    returns: Vec<Vec<At>>,
}

/// Two operands and whether the second is subtracted.
#[derive(Clone, Copy)]
pub(crate) struct Sum {
    pub(crate) place: Place,
    pub(crate) left: Place,
    pub(crate) right: Place,
    pub(crate) minus: bool,
}

/// Two factors.
#[derive(Clone, Copy)]
pub(crate) struct Product {
    pub(crate) place: Place,
    pub(crate) left: Place,
    pub(crate) right: Place,
}

impl<'a> Kernel<'a> {
    pub(crate) fn new(module: &'a Module, info: &'a ModuleInfo) -> Self {
        let mut functions: Vec<_> =
            module.functions.iter().map(|(handle, f)| (f, &info[handle])).collect();
        let entries = module.entry_points.iter().enumerate();
        functions.extend(entries.map(|(i, entry)| (&entry.function, info.get_entry_point(i))));
        let mut kernel = Self { module, functions, calls: Vec::new(), returns: Vec::new() };
        for index in 0..kernel.functions.len() {
            let mut returns = Vec::new();
            kernel.walk(index, &kernel.functions[index].0.body, &mut returns);
            kernel.returns.push(returns);
        }
        kernel
    }

    fn walk(&mut self, caller: usize, block: &'a Block, returns: &mut Vec<At>) {
        for statement in block {
            match statement {
                Statement::Call { function, arguments, .. } => {
                    let (callee, arguments) = (function.index(), arguments.clone());
                    self.calls.push(Call { caller, callee, arguments });
                }
                Statement::Return { value } => returns.extend(value),
                Statement::Block(inner) => self.walk(caller, inner, returns),
                Statement::If { accept, reject, .. } => {
                    self.walk(caller, accept, returns);
                    self.walk(caller, reject, returns);
                }
                Statement::Switch { cases, .. } => {
                    for case in cases {
                        self.walk(caller, &case.body, returns);
                    }
                }
                Statement::Loop { body, continuing, .. } => {
                    self.walk(caller, body, returns);
                    self.walk(caller, continuing, returns);
                }
                _ => {}
            }
        }
    }

    pub(crate) fn expression(&self, (function, at): Place) -> &'a Expression {
        &self.functions[function].0.expressions[at]
    }

    fn inner(&self, (function, at): Place) -> &TypeInner {
        self.functions[function].1[at].ty.inner_with(&self.module.types)
    }

    pub(crate) fn is_float(&self, place: Place) -> bool {
        self.inner(place).scalar_kind() == Some(ScalarKind::Float)
    }

    /// Whether a driver may find that nothing else needs the value at `place`: that is where it moves
    /// constants. The components of a vector are values of their own: reading one leaves the others alone.
    pub(crate) fn is_used_once(&self, (function, at): Place) -> bool {
        let (code, info) = self.functions[function];
        let reads = code.expressions.iter().filter(|(_, expression)| match expression {
            Expression::AccessIndex { base, .. } => *base == at,
            Expression::Swizzle { vector, .. } => *vector == at,
            _ => false,
        });
        info[at].ref_count <= 1 + reads.count()
    }

    /// The operations that may have computed the value at `place`, seen through arguments, through functions
    /// with one `return`, and through the making and the reading of vectors and structs.
    pub(crate) fn values(&self, place: Place) -> Vec<Place> {
        let (mut found, mut seen, mut open) = (Vec::new(), BTreeSet::new(), vec![place]);
        while let Some(place) = open.pop() {
            if !seen.insert(place) {
                continue;
            }
            let (function, at) = place;
            let here = |at: &At| (function, *at);
            match self.expression(place) {
                Expression::FunctionArgument(i) => {
                    let calls = self.calls.iter().filter(|call| call.callee == function);
                    open.extend(calls.map(|call| (call.caller, call.arguments[*i as usize])));
                }
                Expression::CallResult(callee) => match self.returns[callee.index()].as_slice() {
                    [one] => open.push((callee.index(), *one)),
                    _ => found.push(place),
                },
                Expression::Splat { value, .. } => open.push(here(value)),
                Expression::Compose { components, .. } => open.extend(components.iter().map(here)),
                Expression::Swizzle { vector, .. } => open.push(here(vector)),
                Expression::AccessIndex { base, index } => {
                    open.extend(self.components(here(base), *index));
                }
                _ => found.push((function, at)),
            }
        }
        found
    }

    /// What component `index` of the vector or struct at `base` may be.
    fn components(&self, base: Place, index: u32) -> Vec<Place> {
        let (function, _) = base;
        match self.expression(base) {
            Expression::Compose { components, .. } => {
                // Vectors may be made of vectors; then any part will do.
                let exact = match self.inner(base) {
                    TypeInner::Vector { size, .. } => components.len() == *size as usize,
                    _ => true,
                };
                match components.get(index as usize).filter(|_| exact) {
                    Some(one) => vec![(function, *one)],
                    None => components.iter().map(|at| (function, *at)).collect(),
                }
            }
            Expression::CallResult(callee) => match self.returns[callee.index()].as_slice() {
                [one] => self.components((callee.index(), *one), index),
                _ => Vec::new(),
            },
            Expression::Binary { .. } | Expression::Unary { .. } | Expression::Splat { .. } => {
                vec![base]
            }
            _ => Vec::new(),
        }
    }

    /// The number that the value at `place` is, in all components, if it is constant.
    pub(crate) fn number(&self, place: Place) -> Option<f64> {
        let (function, _) = place;
        match self.expression(place) {
            Expression::Literal(Literal::F32(x)) => Some(f64::from(*x)),
            Expression::Literal(Literal::AbstractFloat(x)) => Some(*x),
            Expression::ZeroValue(_) => Some(0.0),
            Expression::Constant(constant) => {
                match &self.module.global_expressions[self.module.constants[*constant].init] {
                    Expression::Literal(Literal::F32(x)) => Some(f64::from(*x)),
                    _ => None,
                }
            }
            Expression::Splat { value, .. } => self.number((function, *value)),
            Expression::Compose { components, .. } => {
                let first = self.number((function, *components.first()?))?;
                let mut rest = components.iter().map(|at| self.number((function, *at)));
                rest.all(|x| x == Some(first)).then_some(first)
            }
            Expression::Unary { op: UnaryOperator::Negate, expr } => {
                self.number((function, *expr)).map(|x| -x)
            }
            _ => None,
        }
    }

    /// The constants that the value at `place` may be.
    pub(crate) fn numbers(&self, place: Place) -> Vec<f64> {
        self.number(place).map_or_else(
            || self.values(place).into_iter().filter_map(|value| self.number(value)).collect(),
            |x| vec![x],
        )
    }

    pub(crate) fn is_constant(&self, place: Place) -> bool {
        let values = self.values(place);
        !values.is_empty() && values.into_iter().all(|value| self.number(value).is_some())
    }

    pub(crate) fn bare(&self, place: Place) -> Place {
        match self.expression(place) {
            Expression::Unary { op: UnaryOperator::Negate, expr } => (place.0, *expr),
            _ => place,
        }
    }

    /// The factors of each product that the value at `place` may be.
    pub(crate) fn products(&self, place: Place) -> Vec<Product> {
        let values = self.values(place).into_iter().flat_map(|value| self.values(self.bare(value)));
        values
            .filter_map(|value| match *self.expression(value) {
                Expression::Binary { op: BinaryOperator::Multiply, left, right } => {
                    Some(Product { place: value, left: (value.0, left), right: (value.0, right) })
                }
                _ => None,
            })
            .collect()
    }

    /// The sums that the value at `place` may be.
    pub(crate) fn sums(&self, place: Place) -> Vec<Sum> {
        let sum = |value: Place| {
            let Expression::Binary { op, left, right } = *self.expression(value) else {
                return None;
            };
            let minus = op == BinaryOperator::Subtract;
            (minus || op == BinaryOperator::Add).then_some(Sum {
                place: value,
                left: (value.0, left),
                right: (value.0, right),
                minus,
            })
        };
        self.values(place).into_iter().filter_map(sum).collect()
    }

    pub(crate) fn is_dot(&self, place: Place) -> bool {
        let dot = |value| {
            matches!(self.expression(value), Expression::Math { fun: MathFunction::Dot, .. })
        };
        self.values(place).into_iter().any(dot)
    }

    /// Whether two expressions of one function read the same.
    pub(crate) fn same(&self, a: Place, b: Place) -> bool {
        if a == b {
            return true;
        }
        let pair = |x: At, y: At| self.same((a.0, x), (b.0, y));
        if a.0 != b.0 {
            return false;
        }
        match (self.expression(a), self.expression(b)) {
            (E::Literal(x), E::Literal(y)) => x == y,
            (E::Constant(x), E::Constant(y)) => x == y,
            (E::FunctionArgument(x), E::FunctionArgument(y)) => x == y,
            (E::LocalVariable(x), E::LocalVariable(y)) => x == y,
            (E::GlobalVariable(x), E::GlobalVariable(y)) => x == y,
            (E::Load { pointer: x }, E::Load { pointer: y })
            | (E::Splat { value: x, .. }, E::Splat { value: y, .. }) => pair(*x, *y),
            (E::AccessIndex { base: x, index: i }, E::AccessIndex { base: y, index: j }) => {
                i == j && pair(*x, *y)
            }
            (
                E::Swizzle { vector: x, pattern: p, size: n },
                E::Swizzle { vector: y, pattern: q, size: m },
            ) => n == m && p == q && pair(*x, *y),
            (E::Unary { op: f, expr: x }, E::Unary { op: g, expr: y }) => f == g && pair(*x, *y),
            (E::Binary { op: f, left: x, right: z }, E::Binary { op: g, left: y, right: w }) => {
                f == g && pair(*x, *y) && pair(*z, *w)
            }
            (E::Math { fun: f, arg: x, arg1: None, .. }, E::Math { fun: g, arg: y, .. }) => {
                f == g && pair(*x, *y)
            }
            _ => false,
        }
    }
}
