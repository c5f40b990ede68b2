//! Module-scope constants and overrides → Rust constants. naga has folded their values already, so
//! only literals, zeros and values put together from them remain.

use crate::NativeError;
use crate::context::Context;
use crate::text::Text;
use naga::{Expression, Handle, TypeInner};

impl Context<'_> {
    /// Writes every constant that has a name and a concrete type.
    pub(crate) fn write_constants(&self, out: &mut Text) -> Result<(), NativeError> {
        for (handle, constant) in self.module.constants.iter() {
            if let Some(name) = self.constant_name(handle) {
                let ty = self.handle_type(constant.ty)?;
                let value = self.global_expression(constant.init)?;
                out.line(&format!("pub const {name}: {ty} = {value};"));
            }
        }
        for (handle, constant) in self.module.overrides.iter() {
            let span = self.module.overrides.get_span(handle);
            let Some(init) = constant.init else {
                return Err(self.refuse(span, "an `override` without a default"));
            };
            let ty = self.handle_type(constant.ty)?;
            let value = self.global_expression(init)?;
            out.line(&format!("pub const {}: {ty} = {value};", self.override_name(handle)));
        }
        Ok(())
    }

    /// The text of an expression outside functions.
    pub(crate) fn global_expression(
        &self,
        handle: Handle<Expression>,
    ) -> Result<String, NativeError> {
        let arena = &self.module.global_expressions;
        let span = arena.get_span(handle);
        match arena[handle] {
            Expression::Literal(literal) => self.literal(literal, span),
            Expression::Constant(constant) => match self.constant_name(constant) {
                Some(name) => Ok(name.to_owned()),
                None => self.global_expression(self.module.constants[constant].init),
            },
            Expression::Override(constant) => Ok(self.override_name(constant).to_owned()),
            Expression::ZeroValue(ty) => self.handle_zero(ty),
            Expression::Splat { size, value } => {
                let inner = self.info[handle].inner_with(&self.module.types);
                let TypeInner::Vector { scalar, .. } = *inner else {
                    return Err(self.refuse(span, "this constant"));
                };
                let name = crate::types::vector_name(size, scalar.kind);
                Ok(format!("{name}::splat({})", self.global_expression(value)?))
            }
            Expression::Compose { ty, ref components } => {
                let mut parts = Vec::new();
                for &component in components {
                    parts.push(self.global_expression(component)?);
                }
                let inner = &self.module.types[ty].inner;
                if let TypeInner::Vector { size, .. } = *inner
                    && parts.len() != size as usize
                {
                    return Err(self.refuse(span, "a constant vector made of vectors"));
                }
                self.compose(ty, &parts, span)
            }
            _ => Err(self.refuse(span, "this constant expression")),
        }
    }
}
