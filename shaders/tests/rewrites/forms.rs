//! Forms that Mesa computes in another order than they are written in, because SPIR-V from WGSL allows it:
//! found in naga's IR, through arguments and results of functions. A kernel without them gives the same
//! bits on a CPU and on Mesa's software adapter.
//!
//! What cannot be seen here: values that went through a `var`, and sums that meet in a loop.

use crate::values::{Kernel, Place, Product, Sum};
use naga::valid::ModuleInfo;
use naga::{BinaryOperator, Expression, MathFunction, Module};

/// One line for each form that is rewritten.
pub(crate) fn rewrites(module: &Module, info: &ModuleInfo) -> Vec<String> {
    let kernel = Kernel::new(module, info);
    let mut found = Vec::new();
    for (index, (function, _)) in kernel.functions.iter().enumerate() {
        let name = function.name.as_deref().unwrap_or("?");
        for (at, expression) in function.expressions.iter() {
            if let Expression::Binary { op, left, right } = *expression
                && kernel.is_float((index, left))
            {
                let forms = kernel.forms(op, (index, left), (index, right));
                found.extend(forms.into_iter().map(|form| format!("`{name}` {at:?}: {form}")));
            }
        }
    }
    found
}

impl Kernel<'_> {
    fn forms(&self, op: BinaryOperator, left: Place, right: Place) -> Vec<&'static str> {
        match op {
            BinaryOperator::Multiply => self.forms_of_product(left, right),
            BinaryOperator::Divide => self.forms_of_quotient(left, right),
            BinaryOperator::Add | BinaryOperator::Subtract => {
                self.forms_of_sum(left, right, op == BinaryOperator::Subtract)
            }
            _ => self.forms_of_comparison(left, right),
        }
    }

    fn forms_of_product(&self, left: Place, right: Place) -> Vec<&'static str> {
        let mut forms = Vec::new();
        for (x, c) in [(left, right), (right, left)] {
            let numbers = self.numbers(c);
            if self.number(c) == Some(0.0) {
                forms.push("a * 0");
            }
            // Powers of two move without a change of bits.
            if numbers.iter().all(|c| is_power_of_two(*c)) {
                continue;
            }
            for Product { place, left, right } in self.products(x) {
                match (self.numbers(left).as_slice(), self.numbers(right).as_slice()) {
                    ([], []) if self.is_used_once(place) => {
                        forms.push("(a * b) * C; write (a * C) * b");
                    }
                    ([], []) => {}
                    ([c], []) | ([], [c]) if is_power_of_two(*c) => {}
                    _ => forms.push("(a * C) * D; write a * (C * D)"),
                }
            }
        }
        let roots = |place| -> Vec<Place> {
            let root = |value: Place| match *self.expression(value) {
                Expression::Math { fun: MathFunction::Sqrt, arg, .. } => {
                    self.values((value.0, arg))
                }
                _ => Vec::new(),
            };
            self.values(place).into_iter().flat_map(root).collect()
        };
        let others = roots(right);
        if roots(left).iter().any(|a| others.iter().any(|b| self.same(*a, *b))) {
            forms.push("sqrt(a) * sqrt(a); write a");
        }
        forms
    }

    fn forms_of_quotient(&self, left: Place, right: Place) -> Vec<&'static str> {
        let one = |place| self.numbers(place).contains(&1.0);
        let inverse = |value: Place| match *self.expression(value) {
            Expression::Binary { op: BinaryOperator::Divide, left, .. } => one((value.0, left)),
            _ => false,
        };
        let twice = one(left) && self.values(right).into_iter().any(inverse);
        if twice { vec!["1 / (1 / a); write a"] } else { Vec::new() }
    }

    fn forms_of_sum(&self, left: Place, right: Place, minus: bool) -> Vec<&'static str> {
        let mut forms = Vec::new();
        if minus && self.same(left, right) {
            forms.push("a - a");
        }
        for (x, c, negated) in [(left, right, false), (right, left, minus)] {
            let constant = self.numbers(c).iter().any(|c| *c != 0.0);
            if constant && !negated && self.is_dot(x) {
                forms.push("dot(a, b) + C");
            }
            for inner in self.sums(x) {
                let parts = [inner.left, inner.right];
                let constants =
                    parts.iter().filter(|part| !self.numbers(**part).is_empty()).count();
                if constant && constants > 0 {
                    forms.push("(a + C) + D; write a + (C + D)");
                } else if constant && !negated && self.is_used_once(inner.place) {
                    forms.push("(a + b) + C; write (a + C) + b");
                }
                let two = parts.iter().all(|part| !self.products(*part).is_empty());
                let once = self.is_used_once(inner.place);
                if two && !negated && once && self.products(c).is_empty() && !self.is_dot(c) {
                    forms.push("(a * b + c * d) + e; write (e + a * b) + c * d");
                }
                // `c` is negative where it is what is subtracted.
                let c_minus = minus && !negated;
                if self.meets(inner, c, c_minus == negated) {
                    forms.push("(a + b) - a; write b");
                }
            }
        }
        let equal =
            |x: Place, y: Place| self.same(x, y) && !self.number(x).is_some_and(is_power_of_two);
        let common = |a: Product, b: Product| {
            [a.left, a.right].iter().any(|x| equal(*x, b.left) || equal(*x, b.right))
        };
        let products = self.products(right);
        if self.products(left).iter().any(|a| products.iter().any(|b| common(*a, *b))) {
            forms.push("a * b + a * c; write a * (b + c)");
        }
        forms
    }

    /// Whether `c` is a part of `sum` that is subtracted, or one that is added.
    fn meets(&self, sum: Sum, c: Place, subtracted: bool) -> bool {
        let part = |part, minus| minus == subtracted && self.same(part, c);
        !self.is_constant(c) && (part(sum.left, false) || part(sum.right, sum.minus))
    }

    fn forms_of_comparison(&self, left: Place, right: Place) -> Vec<&'static str> {
        let mut forms = Vec::new();
        if self.same(left, right) {
            forms.push("a compared with itself");
        }
        for (x, c) in [(left, right), (right, left)] {
            let constant = self.numbers(c).iter().any(|c| *c != 0.0);
            for Sum { left: a, right: b, .. } in self.sums(x) {
                if constant && [a, b].iter().any(|part| !self.numbers(*part).is_empty()) {
                    forms.push("a + C compared with D; write a compared with D - C");
                }
                if self.same(a, c) || self.same(b, c) {
                    forms.push("a + b compared with a; write b compared with 0");
                }
            }
        }
        forms
    }
}

/// Whether multiplying by `x` only moves the exponent.
fn is_power_of_two(x: f64) -> bool {
    x.is_normal() && x.to_bits().trailing_zeros() >= 52
}
