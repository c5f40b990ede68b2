//! Places: variables and their parts, the words of resources.

use super::functions::WideWriter;
use super::types::letter;
use crate::error::NativeError;
use crate::types::LANES;
use naga::{AddressSpace, Expression, GlobalVariable, Handle, Literal, Type, TypeInner};

/// A place of this function's, or of its caller's.
pub(crate) struct Place {
    /// The text of the part, as far as it is known now.
    pub(crate) text: String,
    /// The index of its last step where that is not known, with the texts of all parts that it may mean.
    picked: Option<(String, Vec<String>)>,
    /// What it holds in lanes outside the mask is of no interest.
    free: bool,
}

/// An element of a resource.
struct Word {
    array: String,
    index: String,
    /// The index is the same in all lanes: a number.
    same: bool,
    /// One of its four words.
    axis: Option<u32>,
}

impl WideWriter<'_> {
    /// What a pointer points to.
    pub(crate) fn place_of(&mut self, pointer: Handle<Expression>) -> Result<Place, NativeError> {
        match self.fun.expressions[pointer].clone() {
            Expression::LocalVariable(local) => {
                let text = self.locals[local.index()].clone();
                let free = self.whole || self.homes[local.index()] == Some(self.block);
                Ok(Place { text, picked: None, free })
            }
            Expression::FunctionArgument(index) => {
                let text = format!("(*{})", self.arguments[index as usize]);
                Ok(Place { text, picked: None, free: false })
            }
            Expression::AccessIndex { base, index } => {
                let place = self.place_of(base)?;
                if place.picked.is_some() {
                    return Err(self.refuse(pointer, "a part under an index that is not known"));
                }
                let text = format!("{}{}", place.text, self.step(base, index)?);
                Ok(Place { text, ..place })
            }
            Expression::Access { base, index } => {
                let place = self.place_of(base)?;
                let n = match self.pointed(base)? {
                    TypeInner::Vector { size, .. } => size as u32,
                    TypeInner::Array { size: naga::ArraySize::Constant(n), .. } => n.get(),
                    _ => return Err(self.refuse(pointer, "this access")),
                };
                let parts = (0..n)
                    .map(|k| Ok(format!("{}{}", place.text, self.step(base, k)?)))
                    .collect::<Result<Vec<_>, NativeError>>()?;
                let index = self.index(index)?;
                Ok(Place { picked: Some((index, parts)), ..place })
            }
            Expression::GlobalVariable(_) => {
                Err(self.refuse(pointer, "a private variable, in lanes,"))
            }
            _ => Err(self.refuse(pointer, "this place, in lanes,")),
        }
    }

    /// The type that a pointer points to.
    fn pointed(&self, pointer: Handle<Expression>) -> Result<TypeInner, NativeError> {
        match *self.ty(pointer) {
            TypeInner::Pointer { base, .. } => Ok(self.cx.module.types[base].inner.clone()),
            TypeInner::ValuePointer { size: Some(size), scalar, .. } => {
                Ok(TypeInner::Vector { size, scalar })
            }
            TypeInner::ValuePointer { size: None, scalar, .. } => Ok(TypeInner::Scalar(scalar)),
            _ => Err(self.refuse(pointer, "what is no pointer")),
        }
    }

    /// The text of the step to part `index` of what `base` points to.
    fn step(&self, base: Handle<Expression>, index: u32) -> Result<String, NativeError> {
        let k = index as usize;
        match self.pointed(base)? {
            TypeInner::Vector { .. } => Ok(format!(".{}", LANES[k])),
            TypeInner::Array { .. } => Ok(format!("[{k}]")),
            TypeInner::Struct { .. } => match *self.ty(base) {
                TypeInner::Pointer { base, .. } => Ok(format!(".{}", self.cx.field_names(base)[k])),
                _ => Err(self.refuse(base, "this struct")),
            },
            _ => Err(self.refuse(base, "this access")),
        }
    }

    /// Names the index of a place now: it may change before the place is read.
    pub(crate) fn fix_index(&mut self, pointer: Handle<Expression>) -> Result<(), NativeError> {
        if let Expression::Access { index, .. } = self.fun.expressions[pointer]
            && self.bound[index.index()].is_none()
            && !matches!(
                self.fun.expressions[index],
                Expression::Literal(_) | Expression::Constant(_) | Expression::FunctionArgument(_)
            )
        {
            return self.bind(index);
        }
        Ok(())
    }

    /// The value of a place.
    pub(crate) fn load(&mut self, pointer: Handle<Expression>) -> Result<String, NativeError> {
        if let Some(word) = self.word(pointer)? {
            let element = if word.same {
                format!("v::at_same({}, {})", word.array, word.index)
            } else {
                format!("v::at({}, {}, {})", word.array, word.index, self.mask)
            };
            return Ok(match word.axis {
                Some(axis) => format!("{element}.{}", LANES[axis as usize]),
                None => element,
            });
        }
        let place = self.place_of(pointer)?;
        match place.picked {
            None => Ok(place.text),
            Some((index, parts)) => match self.pointed(pointer)? {
                TypeInner::Scalar(scalar) => {
                    Ok(format!("v::pick_{}(&[{}], {index})", letter(scalar.kind), parts.join(", ")))
                }
                _ => Err(self.refuse(pointer, "more than a number under an index")),
            },
        }
    }

    /// Stores a value in the lanes of the mask.
    pub(crate) fn write_store(
        &mut self,
        pointer: Handle<Expression>,
        value: Handle<Expression>,
    ) -> Result<(), NativeError> {
        if let Some(word) = self.word(pointer)? {
            if word.axis.is_some() || word.same {
                return Err(self.refuse(pointer, "a store of a part of a resource's element"));
            }
            let value = self.atom(value)?;
            let mask = self.mask.clone();
            self.out.line(&format!("v::put({}, {}, {value}, {mask});", word.array, word.index));
            return Ok(());
        }
        let place = self.place_of(pointer)?;
        if place.picked.is_none() && place.free {
            let value = self.value(value)?;
            self.out.line(&format!("{} = {value};", place.text));
            return Ok(());
        }
        if place.picked.is_none()
            && self.bound[value.index()].is_none()
            && let Some((ty, members)) = self.members(value)
        {
            let members = members.to_vec();
            return self.write_members(&place.text, ty, &members);
        }
        let value = self.atom(value)?;
        let mask = self.mask.clone();
        let Some((index, parts)) = place.picked else {
            let parts = [mask.as_str(), &value, &place.text];
            let text = if let TypeInner::Pointer { base, .. } = *self.ty(pointer) {
                self.cx.wide_select(base, parts)?
            } else {
                self.cx.select_inner(&self.pointed(pointer)?, parts, self.span)?
            };
            self.out.line(&format!("{} = {text};", place.text));
            return Ok(());
        };
        let index = self.named(&index);
        let inner = self.pointed(pointer)?;
        for (k, part) in parts.iter().enumerate() {
            let here = format!("v::and_b({mask}, v::eq_u({index}, v::u({k})))");
            let text = self.cx.select_inner(&inner, [&here, &value, part], self.span)?;
            self.out.line(&format!("{part} = {text};"));
        }
        Ok(())
    }

    /// Stores the members of a struct of type `ty` in the lanes of the mask: no struct is made that is only copied.
    fn write_members(
        &mut self,
        place: &str,
        ty: Handle<Type>,
        members: &[Handle<Expression>],
    ) -> Result<(), NativeError> {
        let TypeInner::Struct { members: declared, .. } = &self.cx.module.types[ty].inner else {
            return Err(self.place(NativeError::nowhere("members of no struct".to_owned())));
        };
        let mut texts = Vec::new();
        for &member in members {
            let is_struct = matches!(self.ty(member), TypeInner::Struct { .. });
            texts.push(if is_struct { self.value(member)? } else { self.atom(member)? });
        }
        let mask = self.mask.clone();
        for ((text, field), declared) in texts.iter().zip(self.cx.field_names(ty)).zip(declared) {
            let part = format!("{place}.{field}");
            let text = self.cx.wide_select(declared.ty, [&mask, text, &part])?;
            self.out.line(&format!("{part} = {text};"));
        }
        Ok(())
    }

    /// The element of a resource that `pointer` points to or into.
    fn word(&mut self, pointer: Handle<Expression>) -> Result<Option<Word>, NativeError> {
        match self.fun.expressions[pointer].clone() {
            Expression::AccessIndex { base, index } => {
                if let Some(global) = self.global(base) {
                    let array = self.resource(global, pointer)?;
                    return Ok(Some(Word {
                        array,
                        index: index.to_string(),
                        same: true,
                        axis: None,
                    }));
                }
                let word = self.word(base)?;
                Ok(word.map(|word| Word { axis: Some(index), ..word }))
            }
            Expression::Access { base, index } => {
                let Some(global) = self.global(base) else { return Ok(None) };
                let array = self.resource(global, pointer)?;
                if let Expression::Literal(Literal::U32(index)) = self.fun.expressions[index] {
                    let index = index.to_string();
                    return Ok(Some(Word { array, index, same: true, axis: None }));
                }
                let index = self.index(index)?;
                let index = self.named(&index);
                Ok(Some(Word { array, index, same: false, axis: None }))
            }
            _ => Ok(None),
        }
    }

    fn global(&self, handle: Handle<Expression>) -> Option<Handle<GlobalVariable>> {
        match self.fun.expressions[handle] {
            Expression::GlobalVariable(global) => Some(global),
            _ => None,
        }
    }

    fn resource(
        &self,
        global: Handle<GlobalVariable>,
        pointer: Handle<Expression>,
    ) -> Result<String, NativeError> {
        if self.cx.module.global_variables[global].space == AddressSpace::Private {
            return Err(self.refuse(pointer, "a private variable, in lanes,"));
        }
        Ok(format!("self.{}", self.cx.global_name(global)))
    }
}
