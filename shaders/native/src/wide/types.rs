//! WGSL types → types of lanes, their zeros, and choosing between two values.

use crate::context::Context;
use crate::error::NativeError;
use crate::resources::Holding;
use crate::types::{LANES, type_word};
use naga::{GlobalVariable, Handle, Scalar, ScalarKind, Span, Type, TypeInner};

/// The letter of a kind of numbers, which is the end of the names of its functions.
pub(crate) fn letter(kind: ScalarKind) -> char {
    match kind {
        ScalarKind::Float | ScalarKind::AbstractFloat => 'f',
        ScalarKind::Uint => 'u',
        ScalarKind::Sint | ScalarKind::AbstractInt => 'i',
        ScalarKind::Bool => 'b',
    }
}

/// A vector from the texts of its lanes.
pub(crate) fn vector(parts: &[String]) -> String {
    let members: Vec<String> =
        LANES.iter().zip(parts).map(|(axis, part)| format!("{axis}: {part}")).collect();
    format!("v::V{} {{ {} }}", parts.len(), members.join(", "))
}

/// The type of a scalar.
fn scalar_type(scalar: Scalar) -> String {
    format!("v::{}", letter(scalar.kind).to_ascii_uppercase())
}

impl Context<'_> {
    /// The type of a value.
    pub(crate) fn wide_type(&self, ty: Handle<Type>) -> Result<String, NativeError> {
        match self.module.types[ty].inner {
            TypeInner::Struct { .. } => Ok(self.struct_name(ty).to_owned()),
            TypeInner::Array { base, size, .. } => {
                let length = self.array_length(size, self.module.types.get_span(ty))?;
                Ok(format!("[{}; {length}]", self.wide_type(base)?))
            }
            ref inner => self.wide_inner(inner, self.module.types.get_span(ty)),
        }
    }

    /// The type of a scalar or vector.
    pub(crate) fn wide_inner(&self, inner: &TypeInner, span: Span) -> Result<String, NativeError> {
        match *inner {
            TypeInner::Scalar(scalar) => {
                self.scalar(scalar, span)?;
                Ok(scalar_type(scalar))
            }
            TypeInner::Vector { size, scalar } => {
                self.scalar(scalar, span)?;
                Ok(format!("v::V{}<{}>", size as u8, scalar_type(scalar)))
            }
            _ => Err(self.refuse(span, type_word(inner))),
        }
    }

    /// The member of `Kernel` for a resource: those of the scalar form, words of four.
    pub(crate) fn wide_resource(
        &self,
        handle: Handle<GlobalVariable>,
    ) -> Result<String, NativeError> {
        let span = self.module.global_variables.get_span(handle);
        let ty = self.module.global_variables[handle].ty;
        let TypeInner::Array { base, .. } = self.module.types[ty].inner else {
            return Err(self.refuse(span, "a resource that is no array"));
        };
        if self.handle_type(base)? != "UVec4" {
            return Err(self.refuse(span, "a resource of other elements than `vec4<u32>`"));
        }
        match self.holding(handle)? {
            Holding::Fixed(_) | Holding::Slice => Ok("&'a [glam::UVec4]".to_owned()),
            Holding::SliceMut => Ok("&'a mut [glam::UVec4]".to_owned()),
            Holding::Private | Holding::Value | Holding::ValueMut => {
                Err(self.refuse(span, "such a resource"))
            }
        }
    }

    /// The zero of a type.
    pub(crate) fn wide_zero(&self, ty: Handle<Type>) -> Result<String, NativeError> {
        let span = self.module.types.get_span(ty);
        match self.module.types[ty].inner {
            TypeInner::Struct { .. } => Ok(format!("{}::zero()", self.struct_name(ty))),
            TypeInner::Array { base, size, .. } => {
                Ok(format!("[{}; {}]", self.wide_zero(base)?, self.array_length(size, span)?))
            }
            TypeInner::Scalar(scalar) => Ok(zero(scalar)),
            TypeInner::Vector { size, scalar } => Ok(vector(&vec![zero(scalar); size as usize])),
            ref inner => Err(self.refuse(span, type_word(inner))),
        }
    }

    /// `yes` in the lanes of `mask`, else `no`; each is a name or a place.
    pub(crate) fn wide_select(
        &self,
        ty: Handle<Type>,
        [mask, yes, no]: [&str; 3],
    ) -> Result<String, NativeError> {
        let inner = &self.module.types[ty].inner;
        match *inner {
            TypeInner::Struct { .. } => {
                Ok(format!("{}::select({mask}, &{yes}, &{no})", self.struct_name(ty)))
            }
            TypeInner::Array { base, size, .. } => {
                let length = self.array_length(size, self.module.types.get_span(ty))?;
                let each = |k: u32| {
                    let (yes, no) = (format!("{yes}[{k}]"), format!("{no}[{k}]"));
                    self.wide_select(base, [mask, &yes, &no])
                };
                let parts = (0..length).map(each).collect::<Result<Vec<_>, _>>()?;
                Ok(format!("[{}]", parts.join(", ")))
            }
            _ => self.select_inner(inner, [mask, yes, no], self.module.types.get_span(ty)),
        }
    }

    /// As `wide_select` of a scalar or vector.
    pub(crate) fn select_inner(
        &self,
        inner: &TypeInner,
        [mask, yes, no]: [&str; 3],
        span: Span,
    ) -> Result<String, NativeError> {
        match *inner {
            TypeInner::Scalar(scalar) => {
                Ok(format!("v::select_{}({mask}, {yes}, {no})", letter(scalar.kind)))
            }
            TypeInner::Vector { size, scalar } => {
                let lane = |axis: &&str| {
                    format!("v::select_{}({mask}, {yes}.{axis}, {no}.{axis})", letter(scalar.kind))
                };
                let parts: Vec<String> = LANES[..size as usize].iter().map(lane).collect();
                Ok(vector(&parts))
            }
            _ => Err(self.refuse(span, type_word(inner))),
        }
    }
}

/// The zero of a scalar.
pub(crate) fn zero(scalar: Scalar) -> String {
    match letter(scalar.kind) {
        'f' => "v::f(0.0)".to_owned(),
        'b' => "v::b(false)".to_owned(),
        letter => format!("v::{letter}(0)"),
    }
}
