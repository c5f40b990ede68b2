//! Structs, resources and private variables → `Bindings`, `Kernel` and their constructor.

use crate::context::Context;
use crate::error::NativeError;
use crate::options::Precision;
use crate::text::Text;
use naga::{AddressSpace, ArraySize, GlobalVariable, Handle, StorageAccess, Type, TypeInner};

/// How a global variable lies in `Kernel`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holding {
    /// `var<private>`: by value.
    Private,
    /// Read-only array of known length: `&[T; N]`.
    Fixed(u32),
    /// Read-only runtime-sized array: `&[T]`.
    Slice,
    /// Writable array: `&mut [T]`.
    SliceMut,
    /// Read-only single value: `&T`.
    Value,
    /// Writable single value: `&mut T`.
    ValueMut,
}

impl Holding {
    /// Whether functions copy the reference to a local of the same name.
    pub(crate) fn is_shared(self) -> bool {
        matches!(self, Self::Fixed(_) | Self::Slice | Self::Value)
    }
}

impl Context<'_> {
    /// How `global` is held; what no kernel on the CPU can hold is refused.
    pub(crate) fn holding(&self, global: Handle<GlobalVariable>) -> Result<Holding, NativeError> {
        let span = self.module.global_variables.get_span(global);
        let variable = &self.module.global_variables[global];
        let inner = &self.module.types[variable.ty].inner;
        let writable = match variable.space {
            AddressSpace::Private => return Ok(Holding::Private),
            AddressSpace::Uniform => false,
            AddressSpace::Storage { access } if access.contains(StorageAccess::ATOMIC) => {
                return Err(self.refuse(span, "an atomic"));
            }
            AddressSpace::Storage { access } => access.contains(StorageAccess::STORE),
            AddressSpace::WorkGroup => return Err(self.refuse(span, "a `var<workgroup>`")),
            AddressSpace::Handle => {
                return Err(self.refuse(span, crate::types::type_word(inner)));
            }
            space => return Err(self.refuse(span, &format!("a variable in {space:?} space"))),
        };
        Ok(match *inner {
            TypeInner::Array { .. } if writable => Holding::SliceMut,
            TypeInner::Array { size: ArraySize::Dynamic, .. } => Holding::Slice,
            TypeInner::Array { size, .. } => Holding::Fixed(self.array_length(size, span)?),
            _ if writable => Holding::ValueMut,
            _ => Holding::Value,
        })
    }

    /// The element type of an array in a resource, or the type itself.
    fn element(&self, ty: Handle<Type>) -> Handle<Type> {
        match self.module.types[ty].inner {
            TypeInner::Array { base, .. } => base,
            _ => ty,
        }
    }

    /// Writes the aliases that make both precisions read the same.
    pub(crate) fn write_aliases(&self, out: &mut Text) {
        let (real, d) = match self.precision {
            Precision::F32 => ("f32", ""),
            Precision::F64 => ("f64", "D"),
        };
        out.line("");
        out.line("/// WGSL's `f32`.");
        out.line(&format!("pub type Real = {real};"));
        for stem in ["Vec", "Mat"] {
            for n in 2..=4 {
                out.line(&format!("pub type {stem}{n} = glam::{d}{stem}{n};"));
            }
        }
        out.line("pub use glam::{BVec2, BVec3, BVec4, IVec2, IVec3, IVec4, UVec2, UVec3, UVec4};");
        out.line("");
    }

    /// Writes every struct with its zero.
    pub(crate) fn write_structs(&self, out: &mut Text) -> Result<(), NativeError> {
        for (handle, ty) in self.module.types.iter() {
            let TypeInner::Struct { members, .. } = &ty.inner else { continue };
            let span = self.module.types.get_span(handle);
            let place = |error: NativeError| error.or_at(span, self.source);
            let name = self.struct_name(handle);
            out.line("#[derive(Clone, Copy, Debug, PartialEq)]");
            out.open(&format!("pub struct {name} {{"));
            for (field, member) in self.field_names(handle).iter().zip(members) {
                out.line(&format!("pub {field}: {},", self.handle_type(member.ty).map_err(place)?));
            }
            out.close("}");
            out.line("");
            out.open(&format!("impl {name} {{"));
            out.line("/// All members zero.");
            let mut zeros = Vec::new();
            for member in members {
                zeros.push(self.handle_zero(member.ty).map_err(place)?);
            }
            let zero = self.compose(handle, &zeros, span)?;
            out.line(&format!("pub const ZERO: Self = {zero};"));
            out.close("}");
            out.line("");
            out.open(&format!("impl Default for {name} {{"));
            out.open("fn default() -> Self {");
            out.line("Self::ZERO");
            out.close("}");
            out.close("}");
            out.line("");
        }
        Ok(())
    }

    /// Writes `Bindings` and `Kernel`.
    pub(crate) fn write_resources(&self, out: &mut Text) -> Result<(), NativeError> {
        let mut bindings = Vec::new();
        let mut members = Vec::new();
        for (handle, global) in self.module.global_variables.iter() {
            let name = self.global_name(handle);
            let holding = self.holding(handle)?;
            let span = self.module.global_variables.get_span(handle);
            let place = |error: NativeError| error.or_at(span, self.source);
            if holding == Holding::Private {
                members
                    .push(format!("pub {name}: {},", self.handle_type(global.ty).map_err(place)?));
                continue;
            }
            let element = self.stored_type(self.element(global.ty)).map_err(place)?;
            let (given, held) = match holding {
                Holding::Private => continue,
                Holding::Fixed(n) => (format!("&'a [{element}]"), format!("&'a [{element}; {n}]")),
                Holding::Slice => (format!("&'a [{element}]"), format!("&'a [{element}]")),
                Holding::SliceMut => {
                    (format!("&'a mut [{element}]"), format!("&'a mut [{element}]"))
                }
                Holding::Value => (format!("&'a {element}"), format!("&'a {element}")),
                Holding::ValueMut => (format!("&'a mut {element}"), format!("&'a mut {element}")),
            };
            bindings.push(format!("pub {name}: {given},"));
            members.push(format!("pub {name}: {held},"));
        }
        if bindings.is_empty() {
            // The lifetime must be used whatever the kernel binds.
            bindings.push("pub unused: core::marker::PhantomData<&'a ()>,".to_owned());
            members.push("pub unused: core::marker::PhantomData<&'a ()>,".to_owned());
        }
        if let Some(companion) = self.companion {
            members.push(format!("pub companion: {companion},"));
        }
        out.line("/// What the kernel reads and writes, one member a WGSL resource.");
        out.open("pub struct Bindings<'a> {");
        out.lines(&bindings);
        out.close("}");
        out.line("");
        out.line("/// The resources and the private variables of one invocation after another.");
        out.open("pub struct Kernel<'a> {");
        out.lines(&members);
        out.close("}");
        out.line("");
        Ok(())
    }

    /// Writes `Kernel::new`.
    pub(crate) fn write_constructor(&self, out: &mut Text) -> Result<(), NativeError> {
        out.line("/// Binds the resources; the private variables get their initial values.");
        out.open("pub fn new(bindings: Bindings<'a>) -> Self {");
        out.open("Self {");
        let mut bound = false;
        for (handle, global) in self.module.global_variables.iter() {
            let name = self.global_name(handle);
            let value = match self.holding(handle)? {
                Holding::Private => self.initial(handle)?,
                Holding::Fixed(n) => {
                    let zero = self.stored_zero(self.element(global.ty))?;
                    format!("bindings.{name}.first_chunk().unwrap_or(&[{zero}; {n}])")
                }
                Holding::Slice | Holding::SliceMut | Holding::Value | Holding::ValueMut => {
                    format!("bindings.{name}")
                }
            };
            bound |= global.space != AddressSpace::Private;
            out.line(&format!("{name}: {value},"));
        }
        if !bound {
            out.line("unused: bindings.unused,");
        }
        if self.companion.is_some() {
            out.line("companion: core::default::Default::default(),");
        }
        out.close("}");
        out.close("}");
        Ok(())
    }

    /// The initial value of a private variable.
    pub(crate) fn initial(&self, global: Handle<GlobalVariable>) -> Result<String, NativeError> {
        let variable = &self.module.global_variables[global];
        match variable.init {
            Some(init) => self.global_expression(init),
            None => self.handle_zero(variable.ty),
        }
    }
}
