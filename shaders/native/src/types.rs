//! WGSL types → Rust types, their zeros, and values put together from parts.

use crate::context::Context;
use crate::error::NativeError;
use crate::options::Precision;
use naga::{ArraySize, Handle, Literal, Scalar, ScalarKind, Span, Type, TypeInner, VectorSize};

/// The axes of a vector, in order.
pub(crate) const LANES: [&str; 4] = ["x", "y", "z", "w"];

/// `Vec3`, `UVec2`, …: the alias of a vector in the generated module.
pub(crate) fn vector_name(size: VectorSize, kind: ScalarKind) -> String {
    let prefix = match kind {
        ScalarKind::Uint => "U",
        ScalarKind::Sint => "I",
        ScalarKind::Bool => "B",
        ScalarKind::Float | ScalarKind::AbstractFloat | ScalarKind::AbstractInt => "",
    };
    format!("{prefix}Vec{}", size as u8)
}

/// `axis` of a matrix: columns have names in glam's square matrices and numbers in our others.
pub(crate) fn column(matrix: &str, index: usize, square: bool) -> String {
    if square { format!("{matrix}.{}_axis", LANES[index]) } else { format!("{matrix}[{index}]") }
}

/// A matrix from its columns.
pub(crate) fn matrix_of(columns: &[String], rows: VectorSize) -> String {
    let list: Vec<&str> = columns.iter().map(|c| crate::text::unwrap(c)).collect();
    let list = list.join(", ");
    if columns.len() == rows as usize {
        format!("Mat{}::from_cols({list})", columns.len())
    } else {
        format!("[{list}]")
    }
}

impl Context<'_> {
    /// The Rust type of a scalar; only 32-bit numbers and `bool` have one.
    pub(crate) fn scalar(&self, scalar: Scalar, span: Span) -> Result<&'static str, NativeError> {
        match (scalar.kind, scalar.width) {
            (ScalarKind::Float, 4) | (ScalarKind::AbstractFloat, _) => Ok("Real"),
            (ScalarKind::Uint, 4) => Ok("u32"),
            (ScalarKind::Sint, 4) | (ScalarKind::AbstractInt, _) => Ok("i32"),
            (ScalarKind::Bool, _) => Ok("bool"),
            (kind, width) => {
                Err(self
                    .refuse(span, &format!("numbers of {} bits ({kind:?})", u32::from(width) * 8)))
            }
        }
    }

    /// The Rust type of a WGSL value.
    pub(crate) fn rust_type(&self, inner: &TypeInner, span: Span) -> Result<String, NativeError> {
        self.type_text(inner, span, false)
    }

    /// The Rust type of a value in a resource: floats stay 32 bits wide there, outside structs.
    pub(crate) fn stored_type(&self, ty: Handle<Type>) -> Result<String, NativeError> {
        self.named_type(ty, true)
    }

    /// As `rust_type`, of a type in the module's list.
    pub(crate) fn handle_type(&self, ty: Handle<Type>) -> Result<String, NativeError> {
        self.named_type(ty, false)
    }

    fn named_type(&self, ty: Handle<Type>, stored: bool) -> Result<String, NativeError> {
        if matches!(self.module.types[ty].inner, TypeInner::Struct { .. }) {
            return Ok(self.struct_name(ty).to_owned());
        }
        self.type_text(&self.module.types[ty].inner, self.module.types.get_span(ty), stored)
    }

    fn type_text(
        &self,
        inner: &TypeInner,
        span: Span,
        stored: bool,
    ) -> Result<String, NativeError> {
        let narrow = stored && self.precision == Precision::F64;
        Ok(match *inner {
            TypeInner::Scalar(scalar) => match self.scalar(scalar, span)? {
                "Real" if narrow => "f32".to_owned(),
                name => name.to_owned(),
            },
            TypeInner::Vector { size, scalar } => {
                self.scalar(scalar, span)?;
                let glam = if narrow && scalar.kind == ScalarKind::Float { "glam::" } else { "" };
                format!("{glam}{}", vector_name(size, scalar.kind))
            }
            TypeInner::Matrix { columns, rows, scalar } => {
                self.scalar(scalar, span)?;
                let glam = if narrow { "glam::" } else { "" };
                if columns == rows {
                    format!("{glam}Mat{}", columns as u8)
                } else {
                    format!("[{glam}Vec{}; {}]", rows as u8, columns as u8)
                }
            }
            TypeInner::Array { base, size, .. } => {
                let length = self.array_length(size, span)?;
                format!("[{}; {length}]", self.named_type(base, stored)?)
            }
            _ => return Err(self.refuse(span, type_word(inner))),
        })
    }

    /// The length of a fixed-size array.
    pub(crate) fn array_length(&self, size: ArraySize, span: Span) -> Result<u32, NativeError> {
        match size {
            ArraySize::Constant(length) => Ok(length.get()),
            ArraySize::Pending(_) => {
                Err(self.refuse(span, "an array whose length is an `override`"))
            }
            ArraySize::Dynamic => {
                Err(self.refuse(span, "a runtime-sized array inside another type"))
            }
        }
    }

    /// The zero value of a type.
    pub(crate) fn zero(&self, inner: &TypeInner, span: Span) -> Result<String, NativeError> {
        Ok(match *inner {
            TypeInner::Scalar(scalar) => match self.scalar(scalar, span)? {
                "Real" => format!("0.0{}", self.suffix()),
                "bool" => "false".to_owned(),
                name => format!("0{name}"),
            },
            TypeInner::Vector { size, scalar } => {
                let zero = if scalar.kind == ScalarKind::Bool { "FALSE" } else { "ZERO" };
                format!("{}::{zero}", vector_name(size, scalar.kind))
            }
            TypeInner::Matrix { columns, rows, .. } if columns == rows => {
                format!("Mat{}::ZERO", columns as u8)
            }
            TypeInner::Matrix { columns, rows, .. } => {
                format!("[Vec{}::ZERO; {}]", rows as u8, columns as u8)
            }
            TypeInner::Array { base, size, .. } => {
                format!("[{}; {}]", self.handle_zero(base)?, self.array_length(size, span)?)
            }
            _ => return Err(self.refuse(span, type_word(inner))),
        })
    }

    /// The zero value of a type in the module's list.
    pub(crate) fn handle_zero(&self, ty: Handle<Type>) -> Result<String, NativeError> {
        if matches!(self.module.types[ty].inner, TypeInner::Struct { .. }) {
            return Ok(format!("{}::ZERO", self.struct_name(ty)));
        }
        self.zero(&self.module.types[ty].inner, self.module.types.get_span(ty))
    }

    /// The zero of what a resource stores of type `ty`.
    pub(crate) fn stored_zero(&self, ty: Handle<Type>) -> Result<String, NativeError> {
        let zero = self.handle_zero(ty)?;
        if self.precision == Precision::F32 || !self.has_plain_floats(ty) {
            return Ok(zero);
        }
        let zero = zero.replace("f64", "f32");
        Ok(zero.replace("Mat", "glam::Mat").replace("Vec", "glam::Vec"))
    }

    /// Whether `ty` holds floats that are not inside a struct.
    pub(crate) fn has_plain_floats(&self, ty: Handle<Type>) -> bool {
        match self.module.types[ty].inner {
            TypeInner::Scalar(scalar)
            | TypeInner::Vector { scalar, .. }
            | TypeInner::Matrix { scalar, .. } => scalar.kind == ScalarKind::Float,
            TypeInner::Array { base, .. } => self.has_plain_floats(base),
            _ => false,
        }
    }

    /// A value of type `ty` from the texts of its parts, which are whole members, elements,
    /// columns or lanes.
    pub(crate) fn compose(
        &self,
        ty: Handle<Type>,
        parts: &[String],
        span: Span,
    ) -> Result<String, NativeError> {
        match self.module.types[ty].inner {
            TypeInner::Vector { size, scalar } => {
                Ok(crate::text::call(&format!("{}::new", vector_name(size, scalar.kind)), parts))
            }
            TypeInner::Matrix { rows, .. } => Ok(matrix_of(parts, rows)),
            TypeInner::Array { .. } => Ok(matrix_of_list(parts)),
            TypeInner::Struct { .. } => {
                let members: Vec<String> = self
                    .field_names(ty)
                    .iter()
                    .zip(parts)
                    .map(|(name, part)| format!("{name}: {}", crate::text::unwrap(part)))
                    .collect();
                Ok(format!("{} {{ {} }}", self.struct_name(ty), members.join(", ")))
            }
            ref inner => Err(self.refuse(span, type_word(inner))),
        }
    }

    /// A literal, printed so that Rust reads the same value, or in f64 the decimal as typed.
    pub(crate) fn literal(&self, literal: Literal, span: Span) -> Result<String, NativeError> {
        Ok(match literal {
            Literal::F32(value) => self.real(value, span),
            #[expect(clippy::cast_possible_truncation, reason = "abstract floats become f32")]
            Literal::AbstractFloat(value) => self.real(value as f32, span),
            Literal::U32(value) => format!("{value}u32"),
            Literal::I32(i32::MIN) => "i32::MIN".to_owned(),
            Literal::I32(value) => format!("{value}i32"),
            Literal::AbstractInt(value) => format!("{value}"),
            Literal::Bool(value) => value.to_string(),
            Literal::F64(_)
            | Literal::F16(_)
            | Literal::U16(_)
            | Literal::I16(_)
            | Literal::U64(_)
            | Literal::I64(_) => {
                return Err(self.refuse(span, &format!("the literal {literal:?}")));
            }
        })
    }
}

fn matrix_of_list(parts: &[String]) -> String {
    let list: Vec<&str> = parts.iter().map(|p| crate::text::unwrap(p)).collect();
    format!("[{}]", list.join(", "))
}

/// What a type is called in an error.
pub(crate) fn type_word(inner: &TypeInner) -> &'static str {
    match inner {
        TypeInner::Scalar(_) | TypeInner::Vector { .. } | TypeInner::Matrix { .. } => "this number",
        TypeInner::CooperativeMatrix { .. } => "a cooperative matrix",
        TypeInner::Atomic(_) => "an atomic",
        TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => "a pointer here",
        TypeInner::Array { .. } => "an array here",
        TypeInner::Struct { .. } => "a struct here",
        TypeInner::Image { .. } => "a texture",
        TypeInner::Sampler { .. } => "a sampler",
        TypeInner::AccelerationStructure { .. } => "an acceleration structure",
        TypeInner::RayQuery { .. } => "a ray query",
        TypeInner::BindingArray { .. } => "a binding array",
    }
}
