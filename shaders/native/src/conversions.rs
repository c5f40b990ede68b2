//! Value conversions and `bitcast`. In the f64 twin bits are still those of the f32 nearest.

use crate::error::NativeError;
use crate::functions::FunctionWriter;
use crate::options::Precision;
use crate::text::unwrap;
use naga::{Bytes, Expression, Handle, ScalarKind, TypeInner};

impl FunctionWriter<'_> {
    /// `T(x)` where `width` is given, else `bitcast<T>(x)`.
    pub(crate) fn convert(
        &mut self,
        handle: Handle<Expression>,
        operand: Handle<Expression>,
        to: ScalarKind,
        width: Option<Bytes>,
    ) -> Result<String, NativeError> {
        let Some(from) = self.scalar_kind(operand) else {
            return Err(self.refuse(handle, "this conversion"));
        };
        if from == to {
            return self.value(operand);
        }
        if let TypeInner::Matrix { .. } = self.ty(operand) {
            return Err(self.refuse(handle, "this conversion of a matrix"));
        }
        let f64_twin = self.cx.precision == Precision::F64;
        let text = match width {
            Some(_) => value_conversion(from, to),
            None => bit_conversion(from, to, f64_twin),
        };
        match text {
            Some([before, after]) => {
                let within = before.ends_with('(') && after.starts_with(')');
                self.lanewise(handle, &[operand], |x| {
                    format!("{before}{}{after}", if within { unwrap(&x[0]) } else { &x[0] })
                })
            }
            None => Err(self.refuse(handle, &format!("a conversion from {from:?} to {to:?}"))),
        }
    }
}

/// What stands before and after the operand to convert its value.
fn value_conversion(from: ScalarKind, to: ScalarKind) -> Option<[&'static str; 2]> {
    use ScalarKind as K;
    Some(match (from, to) {
        (K::Float, K::Uint) => ["wgsl::to_u32(", ")"],
        (K::Float, K::Sint) => ["wgsl::to_i32(", ")"],
        (K::Uint | K::Sint, K::Float) => ["", " as Real"],
        (K::Uint | K::Bool, K::Sint) => ["", " as i32"],
        (K::Sint | K::Bool, K::Uint) => ["", " as u32"],
        (K::Bool, K::Float) => ["if ", " { 1.0 } else { 0.0 }"],
        (K::Float, K::Bool) => ["", " != 0.0"],
        (K::Uint | K::Sint, K::Bool) => ["", " != 0"],
        _ => return None,
    })
}

/// What stands before and after the operand to take its bits for another type's.
fn bit_conversion(from: ScalarKind, to: ScalarKind, f64_twin: bool) -> Option<[&'static str; 2]> {
    use ScalarKind as K;
    Some(match (from, to, f64_twin) {
        (K::Float, K::Uint, false) => ["", ".to_bits()"],
        (K::Float, K::Sint, false) => ["", ".to_bits() as i32"],
        (K::Uint, K::Float, false) => ["f32::from_bits(", ")"],
        (K::Sint, K::Float, false) => ["f32::from_bits(", " as u32)"],
        (K::Float, K::Uint, true) => ["(", " as f32).to_bits()"],
        (K::Float, K::Sint, true) => ["(", " as f32).to_bits() as i32"],
        (K::Uint, K::Float, true) => ["f64::from(f32::from_bits(", "))"],
        (K::Sint, K::Float, true) => ["f64::from(f32::from_bits(", " as u32))"],
        (K::Uint, K::Sint, _) => ["", " as i32"],
        (K::Sint, K::Uint, _) => ["", " as u32"],
        _ => return None,
    })
}
