//! Pointers → Rust places. A pointer is never a Rust value, except as an argument: it is a variable
//! and the steps into it, read at the load and written at the store. Its indexes are evaluated when
//! the pointer is.

use crate::error::NativeError;
use crate::functions::FunctionWriter;
use crate::options::Precision;
use crate::resources::Holding;
use crate::types::column;
use naga::{ArraySize, Expression, Handle, Scalar, ScalarKind, Type, TypeInner};

/// An index into an array, a matrix or a vector.
enum Index {
    /// Known, and within bounds.
    Known(u32),
    /// The text of a number that may be out of bounds.
    Dynamic(String),
}

/// One step from a variable into its parts.
enum Step {
    Field(String),
    /// Element of an array of known length.
    Element {
        index: Index,
        length: u32,
    },
    /// Element of an array whose length only its slice knows; `zero` if it has none.
    Slice {
        index: Index,
        zero: String,
    },
    Column {
        index: Index,
        columns: u32,
        square: bool,
    },
    Lane {
        index: Index,
        lanes: u32,
        boolean: bool,
    },
}

/// A variable and the way into it.
struct Place {
    root: String,
    /// The root is a reference.
    by_ref: bool,
    /// The root lies in `Kernel`.
    in_kernel: bool,
    /// The root is a resource, whose floats are 32 bits wide outside structs.
    stored: bool,
    steps: Vec<Step>,
}

impl FunctionWriter<'_> {
    /// Evaluates the index of a pointer, where the pointer is evaluated.
    pub(crate) fn fix_index(&mut self, pointer: Handle<Expression>) -> Result<(), NativeError> {
        if let Expression::Access { index, .. } = self.fun.expressions[pointer] {
            self.atom(index)?;
        }
        Ok(())
    }

    fn place_of(&mut self, pointer: Handle<Expression>) -> Result<Place, NativeError> {
        match self.fun.expressions[pointer] {
            Expression::LocalVariable(local) => Ok(Place {
                root: self.locals[local.index()].clone(),
                by_ref: false,
                in_kernel: false,
                stored: false,
                steps: Vec::new(),
            }),
            Expression::FunctionArgument(index) => Ok(Place {
                root: self.arguments[index as usize].clone(),
                by_ref: true,
                in_kernel: false,
                stored: false,
                steps: Vec::new(),
            }),
            Expression::GlobalVariable(global) => {
                let (holding, root) = self.global(global)?;
                Ok(Place {
                    root,
                    by_ref: matches!(
                        holding,
                        Holding::Value | Holding::ValueMut | Holding::Fixed(_)
                    ),
                    in_kernel: true,
                    stored: holding != Holding::Private,
                    steps: Vec::new(),
                })
            }
            Expression::AccessIndex { base, index } => {
                let mut place = self.place_of(base)?;
                let step = self.step(&mut place, base, Index::Known(index))?;
                place.steps.push(step);
                Ok(place)
            }
            Expression::Access { base, index } => {
                let mut place = self.place_of(base)?;
                let index = Index::Dynamic(self.atom(index)?);
                let step = self.step(&mut place, base, index)?;
                place.steps.push(step);
                Ok(place)
            }
            _ => Err(self.refuse(pointer, "this pointer")),
        }
    }

    /// The step from what `base` points to under `index`.
    fn step(
        &self,
        place: &mut Place,
        base: Handle<Expression>,
        index: Index,
    ) -> Result<Step, NativeError> {
        let lane = |size, scalar: Scalar, index| Step::Lane {
            index,
            lanes: size as u32,
            boolean: scalar.kind == ScalarKind::Bool,
        };
        let ty = match *self.ty(base) {
            TypeInner::Pointer { base, .. } => base,
            TypeInner::ValuePointer { size: Some(size), scalar, .. } => {
                return Ok(lane(size, scalar, index));
            }
            _ => return Err(self.refuse(base, "this pointer")),
        };
        match (&self.cx.module.types[ty].inner, index) {
            (TypeInner::Struct { .. }, Index::Known(index)) => {
                place.stored = false;
                Ok(Step::Field(self.cx.field_names(ty)[index as usize].clone()))
            }
            (&TypeInner::Array { base: element, size, .. }, index) => {
                self.element_step(place, base, element, size, index)
            }
            (&TypeInner::Matrix { columns, rows, .. }, index) => {
                Ok(Step::Column { index, columns: columns as u32, square: columns == rows })
            }
            (&TypeInner::Vector { size, scalar }, index) => Ok(lane(size, scalar, index)),
            _ => Err(self.refuse(base, "this pointer")),
        }
    }

    fn element_step(
        &self,
        place: &Place,
        base: Handle<Expression>,
        element: Handle<Type>,
        size: ArraySize,
        index: Index,
    ) -> Result<Step, NativeError> {
        if let Expression::GlobalVariable(global) = self.fun.expressions[base]
            && matches!(self.cx.holding(global)?, Holding::Slice | Holding::SliceMut)
        {
            let zero = if place.stored {
                self.cx.stored_zero(element)?
            } else {
                self.cx.handle_zero(element)?
            };
            return Ok(Step::Slice { index, zero });
        }
        let length = self.cx.array_length(size, self.span_of(base)).map_err(|e| self.place(e))?;
        Ok(Step::Element { index, length })
    }

    /// The value at a pointer.
    pub(crate) fn load(&mut self, pointer: Handle<Expression>) -> Result<String, NativeError> {
        let place = self.place_of(pointer)?;
        let (text, is_ref) = place.read();
        let text = if is_ref { format!("*{text}") } else { text };
        if place.stored && self.cx.precision == Precision::F64 {
            return self.widen(pointer, &text);
        }
        Ok(text)
    }

    /// Writes to a pointer; nothing is written outside an array.
    pub(crate) fn write_store(
        &mut self,
        pointer: Handle<Expression>,
        value: Handle<Expression>,
    ) -> Result<(), NativeError> {
        let place = self.place_of(pointer)?;
        let mut value = self.value(value)?;
        if place.stored && self.cx.precision == Precision::F64 {
            value = self.narrow(pointer, &value)?;
        }
        let (guards, target) = place.written();
        let line = match place.steps.last() {
            Some(Step::Lane { index, boolean: true, .. }) => {
                format!("{target}.set({}, {value});", index.plain())
            }
            _ => format!("{target} = {value};"),
        };
        if guards.is_empty() {
            self.out.line(&line);
        } else {
            self.out.open(&format!("if {} {{", guards.join(" && ")));
            self.out.line(&line);
            self.out.close("}");
        }
        Ok(())
    }

    /// A pointer as an argument.
    pub(crate) fn lend(&mut self, pointer: Handle<Expression>) -> Result<String, NativeError> {
        let place = self.place_of(pointer)?;
        if place.in_kernel {
            return Err(self.refuse(pointer, "a pointer to a module-scope variable as an argument"));
        }
        if place.steps.iter().any(|step| matches!(step, Step::Lane { .. })) {
            return Err(self.refuse(pointer, "a pointer to one lane of a vector"));
        }
        if place.steps.is_empty() && place.by_ref {
            return Ok(format!("&mut *{}", place.root));
        }
        Ok(format!("&mut {}", place.lent()))
    }

    /// The length of a runtime-sized array.
    pub(crate) fn array_length(
        &mut self,
        array: Handle<Expression>,
    ) -> Result<String, NativeError> {
        let place = self.place_of(array)?;
        Ok(format!("{}.len() as u32", place.root))
    }

    /// A stored value as the twin's wider type.
    fn widen(&mut self, pointer: Handle<Expression>, text: &str) -> Result<String, NativeError> {
        self.recast(pointer, text, ["f64::from(", ")"], "d")
    }

    /// A wide value as the type in which it is stored.
    fn narrow(&mut self, pointer: Handle<Expression>, text: &str) -> Result<String, NativeError> {
        self.recast(pointer, text, ["(", ") as f32"], "")
    }

    fn recast(
        &mut self,
        pointer: Handle<Expression>,
        text: &str,
        [before, after]: [&str; 2],
        d: &str,
    ) -> Result<String, NativeError> {
        let cx = self.cx;
        let inner = match *self.ty(pointer) {
            TypeInner::Pointer { base, .. } if !cx.has_plain_floats(base) => {
                return Ok(text.to_owned());
            }
            TypeInner::Pointer { base, .. } => cx.module.types[base].inner.clone(),
            TypeInner::ValuePointer { size: None, scalar, .. } => TypeInner::Scalar(scalar),
            TypeInner::ValuePointer { size: Some(size), scalar, .. } => {
                TypeInner::Vector { size, scalar }
            }
            ref other => other.clone(),
        };
        let operand = crate::text::wrap(text);
        match inner {
            TypeInner::Scalar(scalar) | TypeInner::Vector { scalar, .. }
                if scalar.kind != ScalarKind::Float =>
            {
                Ok(text.to_owned())
            }
            TypeInner::Scalar(_) => Ok(format!("{before}{text}{after}")),
            TypeInner::Vector { size, .. } => Ok(format!("{operand}.as_{d}vec{}()", size as u8)),
            TypeInner::Matrix { columns, rows, .. } if columns == rows => {
                Ok(format!("{operand}.as_{d}mat{}()", columns as u8))
            }
            _ => Err(self.refuse(pointer, "a whole array of floats in a resource, in f64,")),
        }
    }
}

impl Index {
    /// The index as a `usize`, cut to the last of `n`.
    fn clamped(&self, n: u32) -> String {
        match self {
            Self::Known(index) => index.to_string(),
            Self::Dynamic(index) => format!("({index} as usize).min({})", n - 1),
        }
    }

    /// The index as a `usize`.
    fn plain(&self) -> String {
        match self {
            Self::Known(index) => index.to_string(),
            Self::Dynamic(index) => format!("{index} as usize"),
        }
    }

    /// The index as a `u32`.
    fn word(&self) -> String {
        match self {
            Self::Known(index) => index.to_string(),
            Self::Dynamic(index) => format!("{index} as u32"),
        }
    }

    fn is_dynamic(&self) -> bool {
        matches!(self, Self::Dynamic(_))
    }
}

impl Place {
    /// The text that reads the place, and whether that is a reference.
    fn read(&self) -> (String, bool) {
        let mut text = self.root.clone();
        let mut is_ref = self.by_ref;
        for step in &self.steps {
            if let Step::Slice { index, zero } = step {
                let slice = if text.contains('.') { format!("&*{text}") } else { text };
                text = format!("wgsl::at({slice}, {}, &{zero})", index.word());
                is_ref = true;
                continue;
            }
            text = step.part_of(&text);
            is_ref = false;
        }
        (text, is_ref)
    }

    /// The place as the operand of `&mut`.
    fn lent(&self) -> String {
        self.steps.iter().fold(self.root.clone(), |text, step| match step {
            Step::Column { index, square: true, columns } if index.is_dynamic() => {
                format!("*{text}.col_mut({})", index.clamped(*columns))
            }
            step => step.part_of(&text),
        })
    }

    /// The conditions under which the place exists, and the text that is assigned to (for a lane of
    /// a boolean vector, the vector).
    fn written(&self) -> (Vec<String>, String) {
        let mut guards = Vec::new();
        let mut text = self.root.clone();
        if self.by_ref && self.steps.is_empty() {
            return (guards, format!("*{text}"));
        }
        for (n, step) in self.steps.iter().enumerate() {
            let last = n + 1 == self.steps.len();
            let (index, length) = match step {
                Step::Field(_) => {
                    text = step.part_of(&text);
                    continue;
                }
                Step::Element { index, length } => (index, length.to_string()),
                Step::Slice { index, .. } => (index, format!("{text}.len()")),
                Step::Column { index, columns, .. } => (index, columns.to_string()),
                Step::Lane { index, lanes, .. } => (index, lanes.to_string()),
            };
            if index.is_dynamic() || matches!(step, Step::Slice { .. }) {
                guards.push(format!("{} < {length}", crate::text::wrap(&index.plain())));
            }
            text = match step {
                Step::Lane { boolean: true, .. } => text,
                Step::Column { square: true, .. } if index.is_dynamic() => {
                    let star = if last { "*" } else { "" };
                    format!("{star}{text}.col_mut({})", index.plain())
                }
                _ if index.is_dynamic() => format!("{text}[{}]", index.plain()),
                step => step.part_of(&text),
            };
        }
        (guards, text)
    }
}

impl Step {
    /// The text of the part of `text` that this step leads to, for reading.
    fn part_of(&self, text: &str) -> String {
        match self {
            Self::Field(name) => format!("{text}.{name}"),
            Self::Element { index, length } => format!("{text}[{}]", index.clamped(*length)),
            Self::Slice { index, .. } => format!("{text}[{}]", index.plain()),
            Self::Column { index: Index::Known(index), square, .. } => {
                column(text, *index as usize, *square)
            }
            Self::Column { index, columns, square: true } => {
                format!("{text}.col({})", index.clamped(*columns))
            }
            Self::Column { index, columns, .. } => format!("{text}[{}]", index.clamped(*columns)),
            Self::Lane { index: Index::Known(index), .. } => {
                format!("{text}.{}", crate::types::LANES[*index as usize])
            }
            Self::Lane { index, lanes, boolean: true } => {
                format!("{text}.test({})", index.clamped(*lanes))
            }
            Self::Lane { index, lanes, .. } => format!("{text}[{}]", index.clamped(*lanes)),
        }
    }
}
