//! Floating-point literals. naga keeps them as f32; the f64 twin wants what was typed, so it reads
//! the WGSL text under the literal's span again, constants and plain arithmetic included. What it
//! reads is taken only if it agrees with naga's value to f32 rounding.

use crate::Precision;
use crate::context::Context;
use naga::Span;

/// Nested constants followed before giving up; naga itself refuses cycles.
const MAX_DEPTH: u32 = 16;

impl Context<'_> {
    /// The suffix of a float literal.
    pub(crate) fn suffix(&self) -> &'static str {
        match self.precision {
            Precision::F32 => "f32",
            Precision::F64 => "f64",
        }
    }

    /// The text of `value`, which naga found at `span`.
    pub(crate) fn real(&self, value: f32, span: Span) -> String {
        if value.is_nan() {
            return "Real::NAN".to_owned();
        }
        if value.is_infinite() {
            return if value < 0.0 { "Real::NEG_INFINITY" } else { "Real::INFINITY" }.to_owned();
        }
        match self.precision {
            Precision::F32 => format!("{value:?}f32"),
            Precision::F64 => {
                let typed = self.evaluate(span, 0).filter(|typed| is_close(*typed, value));
                let shortest = format!("{value:?}").parse().unwrap_or(f64::from(value));
                format!("{:?}f64", typed.unwrap_or(shortest))
            }
        }
    }

    fn evaluate(&self, span: Span, depth: u32) -> Option<f64> {
        evaluate(self.source, self.source.get(span.to_range()?)?, depth)
    }
}

/// The value of an arithmetic expression, whose constants are declared in `source`.
fn evaluate(source: &str, text: &str, depth: u32) -> Option<f64> {
    let mut reader = Reader { source, rest: text, depth };
    let value = reader.sum()?;
    reader.skip_space();
    reader.rest.is_empty().then_some(value)
}

/// The value of `const name = …;`. naga forgets the constants that have no concrete type, so this
/// looks in the text.
fn constant_value(source: &str, name: &str, depth: u32) -> Option<f64> {
    source.match_indices("const ").find_map(|(start, word)| {
        let rest = source[start + word.len()..].trim_start().strip_prefix(name)?;
        let rest = rest.trim_start();
        let rest = if rest.starts_with(':') { &rest[rest.find('=')?..] } else { rest };
        let (value, _) = rest.strip_prefix('=')?.split_once(';')?;
        evaluate(source, value, depth + 1)
    })
}

/// Whether two values differ by no more than folding in f32 can explain.
fn is_close(typed: f64, value: f32) -> bool {
    let value = f64::from(value);
    typed.is_finite() && (typed - value).abs() <= value.abs() * 4.0 * f64::from(f32::EPSILON)
}

/// A reader of numbers, names of constants, `+ - * /` and parentheses; anything else ends it.
struct Reader<'a> {
    source: &'a str,
    rest: &'a str,
    depth: u32,
}

impl Reader<'_> {
    fn skip_space(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn take(&mut self, c: char) -> bool {
        self.skip_space();
        match self.rest.strip_prefix(c) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn sum(&mut self) -> Option<f64> {
        let mut value = self.product()?;
        loop {
            if self.take('+') {
                value += self.product()?;
            } else if self.take('-') {
                value -= self.product()?;
            } else {
                return Some(value);
            }
        }
    }

    fn product(&mut self) -> Option<f64> {
        let mut value = self.unary()?;
        loop {
            if self.take('*') {
                value *= self.unary()?;
            } else if self.take('/') {
                value /= self.unary()?;
            } else {
                return Some(value);
            }
        }
    }

    fn unary(&mut self) -> Option<f64> {
        if self.depth > MAX_DEPTH {
            return None;
        }
        if self.take('-') {
            self.depth += 1;
            return self.unary().map(|value| -value);
        }
        if self.take('(') {
            self.depth += 1;
            let value = self.sum()?;
            self.depth -= 1;
            return self.take(')').then_some(value);
        }
        self.skip_space();
        if self.rest.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            self.number()
        } else {
            self.name()
        }
    }

    fn number(&mut self) -> Option<f64> {
        let bytes = self.rest.as_bytes();
        let mut end = 0;
        while end < bytes.len() {
            let after_exponent = end > 0 && matches!(bytes[end - 1], b'e' | b'E');
            let part = bytes[end].is_ascii_digit()
                || matches!(bytes[end], b'.' | b'e' | b'E')
                || (after_exponent && matches!(bytes[end], b'+' | b'-'));
            if !part {
                break;
            }
            end += 1;
        }
        let value = self.rest[..end].parse().ok()?;
        self.rest = self.rest[end..].trim_start_matches(['f', 'u', 'i']);
        Some(value)
    }

    fn name(&mut self) -> Option<f64> {
        let end =
            self.rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(self.rest.len());
        let (name, rest) = self.rest.split_at(end);
        self.rest = rest;
        if name.is_empty() { None } else { constant_value(self.source, name, self.depth) }
    }
}
