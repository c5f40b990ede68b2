//! What is wrong with a scene, as plain data: code, places, reasons and edits.
//!
//! Every phase returns these beside its result and goes on. Nothing here knows how a diagnostic is
//! drawn or turned into JSON.

mod short;

pub use short::short;

use crate::source::Span;

/// Most diagnostics that are kept of a file, and of the phases after reading: each takes some hundred
/// bytes, a fault in a hostile text two.
pub const MAX_FAULTS: usize = 200_000;

/// A stable code such as `E0201` (error) or `W0511` (lint), as `rtc explain` takes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Code(pub &'static str);

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The scene cannot be used.
    Error,
    /// The scene can be used, and probably does not mean what it says.
    Warning,
}

/// One finding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Its code.
    pub code: Code,
    /// Error or warning.
    pub severity: Severity,
    /// Name of the lint, for warnings that can be allowed or denied.
    pub lint: Option<&'static str>,
    /// One line, lower case, no full stop.
    pub message: String,
    /// Places; the first primary one is where the fault is. May lie in several files.
    pub labels: Vec<Label>,
    /// Facts that explain, one line each.
    pub notes: Vec<String>,
    /// Advice without an edit, one line each.
    pub helps: Vec<String>,
    /// Advice with edits.
    pub fixes: Vec<Fix>,
}

/// A marked place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// Where.
    pub span: Span,
    /// Where the fault is, rather than what explains it.
    pub primary: bool,
    /// What to say there; may be empty.
    pub text: String,
}

/// How sure a fix is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Applicability {
    /// Certainly what was meant; `rtc fix` applies it.
    MachineApplicable,
    /// A proposal to look at.
    MaybeIncorrect,
}

/// A change of the text that would cure the fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// What it does, in the imperative.
    pub message: String,
    /// How sure it is.
    pub applicability: Applicability,
    /// The edits, which belong together and do not overlap.
    pub edits: Vec<Edit>,
}

/// Replaces a span; an empty span inserts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced.
    pub span: Span,
    /// What stands there afterwards.
    pub replacement: String,
}

impl Label {
    /// Marks the fault.
    pub fn primary(span: Span, text: impl Into<String>) -> Label {
        Label { span, primary: true, text: text.into() }
    }

    /// Marks something that explains the fault.
    pub fn secondary(span: Span, text: impl Into<String>) -> Label {
        Label { span, primary: false, text: text.into() }
    }
}

impl Fix {
    /// A fix of one edit that is certainly right.
    pub fn sure(message: impl Into<String>, span: Span, replacement: impl Into<String>) -> Fix {
        let edits = vec![Edit { span, replacement: replacement.into() }];
        Fix { message: message.into(), applicability: Applicability::MachineApplicable, edits }
    }

    /// A fix of one edit that is a guess.
    pub fn guess(message: impl Into<String>, span: Span, replacement: impl Into<String>) -> Fix {
        Fix {
            applicability: Applicability::MaybeIncorrect,
            ..Fix::sure(message, span, replacement)
        }
    }
}

impl Diagnostic {
    /// An error without places yet.
    pub fn error(code: Code, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            code,
            severity: Severity::Error,
            lint: None,
            message: message.into(),
            labels: Vec::new(),
            notes: Vec::new(),
            helps: Vec::new(),
            fixes: Vec::new(),
        }
    }

    /// A warning that `lint` names.
    pub fn warning(code: Code, lint: &'static str, message: impl Into<String>) -> Diagnostic {
        let error = Diagnostic::error(code, message);
        Diagnostic { severity: Severity::Warning, lint: Some(lint), ..error }
    }

    /// Adds a label.
    #[must_use]
    pub fn with_label(mut self, label: Label) -> Diagnostic {
        self.labels.push(label);
        self
    }

    /// Adds a primary label.
    #[must_use]
    pub fn at(self, span: Span, text: impl Into<String>) -> Diagnostic {
        self.with_label(Label::primary(span, text))
    }

    /// Adds a secondary label.
    #[must_use]
    pub fn because(self, span: Span, text: impl Into<String>) -> Diagnostic {
        self.with_label(Label::secondary(span, text))
    }

    /// Adds a note.
    #[must_use]
    pub fn with_note(mut self, note: impl Into<String>) -> Diagnostic {
        self.notes.push(note.into());
        self
    }

    /// Adds advice.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Diagnostic {
        self.helps.push(help.into());
        self
    }

    /// Adds a fix.
    #[must_use]
    pub fn with_fix(mut self, fix: Fix) -> Diagnostic {
        self.fixes.push(fix);
        self
    }

    /// Is this an error?
    #[must_use]
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// Where the fault is: the first primary label, else the first label.
    #[must_use]
    pub fn span(&self) -> Option<Span> {
        let primary = self.labels.iter().find(|label| label.primary);
        primary.or_else(|| self.labels.first()).map(|label| label.span)
    }
}

/// Sorts by file, place and code, so that the order of phases does not show.
pub fn sort(diagnostics: &mut [Diagnostic]) {
    diagnostics.sort_by(|a, b| {
        (a.span(), a.code, a.message.as_str()).cmp(&(b.span(), b.code, b.message.as_str()))
    });
}
