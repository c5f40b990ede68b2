//! What was written, before it means anything: the tree that `parse` builds from one file.
//!
//! Every node knows its place. Where the text could not be read, the tree holds a poisoned node
//! (`ItemKind::Poisoned`, `Base::Error`, `ExprKind::Error`, `Decl::kind == None`) for which a
//! diagnostic has been given already, so later phases stay silent about it and check the rest.
//!
//! The height of an expression is at most [`MAX_HEIGHT`], so it may be walked recursively.

mod places;

use crate::scene::Axis;
use crate::source::Span;

/// Bound of the height of an expression: brackets plus operators on the way to a leaf.
pub const MAX_HEIGHT: u32 = 256;

/// One file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct File {
    /// `rts 1`; `None` where it is missing or unreadable (there is a diagnostic then).
    pub edition: Option<Edition>,
    /// Declarations in the order of the text.
    pub items: Vec<Item>,
    /// Something could not be read: do not complain of things that seem to be unused.
    pub has_errors: bool,
}

/// The edition header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edition {
    /// Its number; only known editions get here.
    pub number: u32,
    /// The header.
    pub span: Span,
}

/// A declaration at top level.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// From the first word to the last character, without the doc comment.
    pub span: Span,
    /// Lines of the `///` comment directly above, without the slashes and one space after them.
    /// Always empty for imports and assertions.
    pub docs: Vec<String>,
    /// `pub` stands before it.
    pub public: bool,
    /// What it is.
    pub kind: ItemKind,
}

/// Kinds of declarations.
#[derive(Clone, Debug, PartialEq)]
pub enum ItemKind {
    /// `import "file" …`
    Import(Import),
    /// `param name: type = value in range`
    Param(Param),
    /// `let name = value`
    Let(Binding),
    /// `asset name = value`
    Asset(Binding),
    /// `texture name = value`
    Texture(Binding),
    /// `kind name: type { … }`
    Decl(Decl),
    /// `assert condition, "message"`
    Assert(Assert),
    /// Unreadable; the names it would have declared, as far as they could be told. A use of one of
    /// them is no error.
    Poisoned(Vec<Ident>),
}

/// An identifier.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ident {
    /// As written.
    pub text: String,
    /// Where.
    pub span: Span,
}

/// One or more identifiers with dots between them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Path {
    /// At least one.
    pub segments: Vec<Ident>,
    /// The whole path.
    pub span: Span,
}

impl Path {
    /// The path as written, without spaces.
    #[must_use]
    pub fn text(&self) -> String {
        let words: Vec<&str> = self.segments.iter().map(|s| s.text.as_str()).collect();
        words.join(".")
    }
}

/// A string without its quotes. There are no escapes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text {
    /// The characters between the quotes.
    pub text: String,
    /// With the quotes.
    pub span: Span,
}

/// `import "parts/lantern.rts" as lantern`, `import "std:materials" { basalt, brass }`.
#[derive(Clone, Debug, PartialEq)]
pub struct Import {
    /// The file.
    pub path: Text,
    /// What it is used as.
    pub names: ImportNames,
}

/// What an import brings in.
#[derive(Clone, Debug, PartialEq)]
pub enum ImportNames {
    /// Nothing is named: every public name under its own name.
    All,
    /// `as lantern`: public names behind a prefix.
    As(Ident),
    /// `{ a, b }`: these public names.
    Only(Vec<Ident>),
}

/// `param hour: time = 6.4h in 5h..9h`.
#[derive(Clone, Debug, PartialEq)]
pub struct Param {
    /// Name.
    pub name: Ident,
    /// Type word.
    pub ty: Ident,
    /// Value unless given from outside.
    pub value: Expr,
    /// Allowed values.
    pub range: Option<Expr>,
}

/// `let name = value`, `asset name = value`, `texture name = value`.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// Name.
    pub name: Ident,
    /// Value.
    pub value: Expr,
}

/// `assert condition, "message"`.
#[derive(Clone, Debug, PartialEq)]
pub struct Assert {
    /// Must be true.
    pub condition: Expr,
    /// What to say otherwise.
    pub message: Text,
}

/// Kinds of declarations with a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the words of the language themselves")]
pub enum DeclKind {
    Material,
    Medium,
    Object,
    Instance,
    Scatter,
    Light,
    Sky,
    Camera,
    Film,
    Render,
}

impl DeclKind {
    /// All kinds, in the order of the reference.
    pub const ALL: [DeclKind; 10] = [
        DeclKind::Material,
        DeclKind::Medium,
        DeclKind::Object,
        DeclKind::Instance,
        DeclKind::Scatter,
        DeclKind::Light,
        DeclKind::Sky,
        DeclKind::Camera,
        DeclKind::Film,
        DeclKind::Render,
    ];

    /// The word in the text.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            DeclKind::Material => "material",
            DeclKind::Medium => "medium",
            DeclKind::Object => "object",
            DeclKind::Instance => "instance",
            DeclKind::Scatter => "scatter",
            DeclKind::Light => "light",
            DeclKind::Sky => "sky",
            DeclKind::Camera => "camera",
            DeclKind::Film => "film",
            DeclKind::Render => "render",
        }
    }

    /// The kind that a word names.
    #[must_use]
    pub fn from_word(word: &str) -> Option<DeclKind> {
        DeclKind::ALL.into_iter().find(|kind| kind.word() == word)
    }
}

/// `kind name[i in a..b] (: type | like other) { fields }`.
#[derive(Clone, Debug, PartialEq)]
pub struct Decl {
    /// Kind; `None` is an unknown word, already reported: the name may be used as anything.
    /// A misspelt word (reported) counts as the kind it resembles, if there is just one.
    pub kind: Option<DeclKind>,
    /// The kind word.
    pub kind_span: Span,
    /// Name.
    pub name: Ident,
    /// `[i in 0..6]`.
    pub index: Option<Index>,
    /// Type or model; `None` where nothing is said.
    pub base: Option<Base>,
    /// Fields in the order of the text.
    pub fields: Vec<Field>,
    /// From `{` to `}`.
    pub block: Span,
    /// Part of the block could not be read: do not complain of fields that seem to be missing.
    pub partial: bool,
}

/// `[i in 0..6]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Index {
    /// Variable.
    pub var: Ident,
    /// Its values.
    pub range: Expr,
    /// With the brackets.
    pub span: Span,
}

/// What a declaration builds on.
#[derive(Clone, Debug, PartialEq)]
pub enum Base {
    /// `: wood`
    Type(Path),
    /// `like cedar`
    Like(Path),
    /// `like car.material("paint")`
    OfFile(OfFile),
    /// Unreadable, already reported.
    Error(Span),
}

/// `car.material("paint")`: what a mesh file has.
#[derive(Clone, Debug, PartialEq)]
pub struct OfFile {
    /// `car.material`.
    pub path: Path,
    /// Its name in the file.
    pub name: Text,
    /// With the brackets.
    pub span: Span,
}

/// `ring.width = 3.2mm`.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Left of `=`.
    pub path: Path,
    /// Right of `=`; `ExprKind::Error` where it could not be read.
    pub value: Expr,
    /// The whole field.
    pub span: Span,
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Where; includes parentheses around it.
    pub span: Span,
}

/// Kinds of expressions. Parentheses leave no node of their own.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// `3.2mm`
    Number(Number),
    /// `(0, 1.6, 4)m`; at least two entries.
    Tuple {
        /// Entries.
        items: Vec<Expr>,
        /// Unit of all entries.
        unit: Option<Unit>,
    },
    /// `[a, b]`, `[0deg: a, 90deg: b]`
    List(Vec<Entry>),
    /// `srgb(#c79a6b)`, `obj("a.obj", unit: cm)`
    Call {
        /// What is called.
        path: Path,
        /// Arguments.
        args: Vec<Arg>,
    },
    /// `hour`, `shrine.post`, `petal_rgba.rgb`
    Path(Path),
    /// `f(x).rgb`: a dot after something that is not a path.
    Member {
        /// Left of the dot.
        base: Box<Expr>,
        /// Right of the dot.
        name: Ident,
    },
    /// `car { material "paint*" = red }`
    Edited {
        /// What is changed.
        base: Box<Expr>,
        /// The changes.
        edits: Vec<Edit>,
    },
    /// `-x`
    Negate(Box<Expr>),
    /// `a + b`
    Binary {
        /// Operator.
        op: BinaryOp,
        /// Where the operator stands.
        op_span: Span,
        /// Left side.
        left: Box<Expr>,
        /// Right side.
        right: Box<Expr>,
    },
    /// `a < b`
    Compare {
        /// Operator.
        op: CompareOp,
        /// Where the operator stands.
        op_span: Span,
        /// Left side.
        left: Box<Expr>,
        /// Right side.
        right: Box<Expr>,
    },
    /// `if a then b else c`
    If {
        /// Condition.
        condition: Box<Expr>,
        /// Value where it holds.
        then: Box<Expr>,
        /// Value where it does not.
        otherwise: Box<Expr>,
    },
    /// `a..b`
    Range {
        /// First.
        start: Box<Expr>,
        /// Last, or one past it, as the slot has it.
        end: Box<Expr>,
    },
    /// `+x`; note that `-x` is always the axis and `- x` the negated name.
    Axis(Axis),
    /// `#c79a6b`
    Hex([u8; 3]),
    /// `"a.obj"`
    Text(String),
    /// `true`, `false`
    Bool(bool),
    /// `default`
    Default,
    /// `none`
    None,
    /// Unreadable, already reported.
    Error,
}

/// A number with its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// Value, without the unit; finite.
    pub value: f64,
    /// As written, without the unit: `40_000`.
    pub text: String,
    /// The unit, if any.
    pub unit: Option<Unit>,
}

/// A unit as written: `mm`, `%`, `kcd/m2`, `/m`. Not checked here: `5m/width` written without
/// spaces has the (unknown) unit `m/width`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// As written.
    pub text: String,
    /// Where.
    pub span: Span,
}

/// Entry of a list.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Left of the colon.
    pub key: Option<Box<Expr>>,
    /// The value.
    pub value: Expr,
}

/// A change of a mesh file: `material "paint*" = red`.
#[derive(Clone, Debug, PartialEq)]
pub struct Edit {
    /// `material`, `part`.
    pub kind: Ident,
    /// Names in the file that it holds for.
    pub pattern: Text,
    /// Right of `=`.
    pub value: Expr,
}

/// Argument of a call.
#[derive(Clone, Debug, PartialEq)]
pub struct Arg {
    /// `name:`
    pub name: Option<Ident>,
    /// The value.
    pub value: Expr,
}

/// Arithmetic operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "see `symbol`")]
pub enum BinaryOp {
    Add,
    Sub,
    Mul,
    Div,
}

impl BinaryOp {
    /// As written.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            BinaryOp::Add => "+",
            BinaryOp::Sub => "-",
            BinaryOp::Mul => "*",
            BinaryOp::Div => "/",
        }
    }
}

/// Comparison operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "see `symbol`")]
pub enum CompareOp {
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
}

impl CompareOp {
    /// As written.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            CompareOp::Less => "<",
            CompareOp::LessEqual => "<=",
            CompareOp::Greater => ">",
            CompareOp::GreaterEqual => ">=",
            CompareOp::Equal => "==",
            CompareOp::NotEqual => "!=",
        }
    }
}
