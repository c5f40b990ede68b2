//! What can go wrong, with the place in the WGSL text.

use naga::Span;
use naga::front::wgsl::ParseError;
use naga::valid::ValidationError;
use std::error::Error as _;
use std::fmt::Write as _;
use thiserror::Error;

/// A WGSL text that cannot be translated with its exact meaning.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{line}:{column}: {message}")]
pub struct NativeError {
    /// What is wrong, naming the construct.
    pub message: String,
    /// Line in the WGSL text, from 1; 0 where naga kept no location.
    pub line: u32,
    /// Column in bytes, from 1; 0 where naga kept no location.
    pub column: u32,
    /// The byte of the WGSL text at that place; 0 where naga kept no location.
    pub offset: usize,
}

impl NativeError {
    /// An error about the text at `span`.
    pub(crate) fn at(span: Span, source: &str, message: impl Into<String>) -> Self {
        let message = message.into();
        match span.to_range() {
            Some(range) if source.get(..range.start).is_some() => {
                let location = span.location(source);
                Self {
                    message,
                    line: location.line_number,
                    column: location.line_position,
                    offset: range.start,
                }
            }
            _ => Self { message, line: 0, column: 0, offset: 0 },
        }
    }

    /// An error about no place in the text.
    pub(crate) fn nowhere(message: String) -> Self {
        Self { message, line: 0, column: 0, offset: 0 }
    }

    /// The same error; where it has no place of its own, at `span`.
    pub(crate) fn or_at(self, span: Span, source: &str) -> Self {
        if self.line == 0 { Self::at(span, source, self.message) } else { self }
    }

    /// The front end's refusal.
    pub(crate) fn parse(error: &ParseError, source: &str) -> Self {
        let mut spans = error.labels().map(|(span, _)| span);
        let span = spans.find(Span::is_defined).unwrap_or_default();
        Self::at(span, source, error.message())
    }

    /// The validator's refusal: the outer error and everything that it says caused it.
    pub(crate) fn invalid(error: &naga::WithSpan<ValidationError>, source: &str) -> Self {
        let mut message = error.as_inner().to_string();
        let mut cause = error.as_inner().source();
        while let Some(inner) = cause {
            let _ = write!(message, ": {inner}");
            cause = inner.source();
        }
        let span = error.spans().last().map_or(Span::UNDEFINED, |(span, _)| *span);
        Self::at(span, source, message)
    }
}
