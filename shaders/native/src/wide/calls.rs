//! Calls, and what they can take where it is.

use super::functions::WideWriter;
use crate::error::NativeError;
use naga::{AddressSpace, Expression, Function, Handle, Statement, Type, TypeInner};

impl WideWriter<'_> {
    /// Writes a call; its first argument is the mask.
    pub(crate) fn write_call(
        &mut self,
        name: &str,
        callee: &Function,
        arguments: &[Handle<Expression>],
        result: Option<Handle<Expression>>,
    ) -> Result<(), NativeError> {
        let mut texts = vec![self.mask.clone()];
        for (&argument, parameter) in arguments.iter().zip(&callee.arguments) {
            texts.push(match self.cx.module.types[parameter.ty].inner {
                TypeInner::Pointer { space: AddressSpace::Function, .. } => {
                    format!("&mut {}", self.place_of(argument)?.text)
                }
                TypeInner::Struct { .. } => format!("&{}", self.value(argument)?),
                _ => self.value(argument)?,
            });
        }
        let call = format!("self.{name}({})", texts.join(", "));
        match result {
            Some(result) if self.info[result].ref_count > 0 => self.bind_as(result, &call),
            _ => self.out.line(&format!("{call};")),
        }
        Ok(())
    }

    /// Names what is evaluated here, except a struct that the call which comes `next` can take where it is, or that the
    /// store which comes next puts together.
    pub(crate) fn write_emitted(
        &mut self,
        range: naga::Range<Expression>,
        next: Option<&Statement>,
    ) -> Result<(), NativeError> {
        for handle in range {
            if self.is_pointer(handle) {
                self.fix_index(handle)?;
            } else if !self.can_be_lent(handle, next) && !self.is_stored_apart(handle, next) {
                self.bind(handle)?;
            }
        }
        Ok(())
    }

    /// Whether `handle` is a struct in a variable, for the call `next` alone, which changes nothing of that variable.
    fn can_be_lent(&self, handle: Handle<Expression>, next: Option<&Statement>) -> bool {
        let Some(Statement::Call { arguments, .. }) = next else { return false };
        let Expression::Load { pointer } = self.fun.expressions[handle] else { return false };
        let root = self.root(pointer);
        let changed = |argument: &Handle<Expression>| {
            self.is_pointer(*argument) && self.root(*argument) == root
        };
        matches!(self.ty(handle), TypeInner::Struct { .. })
            && self.info[handle].ref_count == 1
            && arguments.contains(&handle)
            && root.is_some()
            && !arguments.iter().any(changed)
    }

    /// Whether `handle` is a struct put together for the store `next` alone, which stores its members one by one.
    fn is_stored_apart(&self, handle: Handle<Expression>, next: Option<&Statement>) -> bool {
        let Some(Statement::Store { value, .. }) = next else { return false };
        *value == handle && self.info[handle].ref_count == 1 && self.members(handle).is_some()
    }

    /// The members of a struct that is put together.
    pub(crate) fn members(
        &self,
        handle: Handle<Expression>,
    ) -> Option<(Handle<Type>, &[Handle<Expression>])> {
        match &self.fun.expressions[handle] {
            Expression::Compose { ty, components }
                if matches!(self.cx.module.types[*ty].inner, TypeInner::Struct { .. }) =>
            {
                Some((*ty, components))
            }
            _ => None,
        }
    }

    /// The variable or parameter that a pointer leads into.
    fn root(&self, pointer: Handle<Expression>) -> Option<Handle<Expression>> {
        match self.fun.expressions[pointer] {
            Expression::AccessIndex { base, .. } => self.root(base),
            Expression::LocalVariable(_) | Expression::FunctionArgument(_) => Some(pointer),
            _ => None,
        }
    }
}
