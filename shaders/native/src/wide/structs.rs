//! Structs of lanes: their zeros, choosing between two, and lanes from and to the scalar form.

use super::types::{letter, vector};
use crate::context::Context;
use crate::error::NativeError;
use crate::options::Lanes;
use crate::text::Text;
use crate::types::{LANES, vector_name};
use naga::{Handle, Type, TypeInner};

/// The text of a part of a struct, of its name and type.
type PartOf<'a> = dyn Fn(&str, Handle<Type>) -> Result<String, NativeError> + 'a;

impl Context<'_> {
    /// Writes every struct.
    pub(crate) fn write_wide_structs(
        &self,
        out: &mut Text,
        lanes: Lanes,
    ) -> Result<(), NativeError> {
        for (handle, ty) in self.module.types.iter() {
            if let TypeInner::Struct { .. } = ty.inner {
                self.write_wide_struct(out, handle, lanes)?;
            }
        }
        Ok(())
    }

    fn write_wide_struct(
        &self,
        out: &mut Text,
        handle: Handle<Type>,
        lanes: Lanes,
    ) -> Result<(), NativeError> {
        let TypeInner::Struct { members, .. } = &self.module.types[handle].inner else {
            return Ok(());
        };
        let name = self.struct_name(handle);
        let fields = self.field_names(handle);
        out.line("#[derive(Clone, Copy, Debug)]");
        out.open(&format!("pub struct {name} {{"));
        for (field, member) in fields.iter().zip(members) {
            out.line(&format!("pub {field}: {},", self.wide_type(member.ty)?));
        }
        out.close("}");
        out.line("");
        out.open(&format!("impl {name} {{"));
        let mut each = |head: &str, part: &PartOf<'_>| {
            out.line("#[inline]");
            out.line(lanes.attribute());
            out.open(&format!("pub fn {head} {{"));
            let is_scalar = head.ends_with("scalar::") || head.contains("-> scalar::");
            out.open(&if is_scalar { format!("scalar::{name} {{") } else { "Self {".to_owned() });
            for (field, member) in fields.iter().zip(members) {
                out.line(&format!("{field}: {},", part(field, member.ty)?));
            }
            out.close("}");
            out.close("}");
            Ok::<(), NativeError>(())
        };
        each("zero() -> Self", &|_, ty| self.wide_zero(ty))?;
        each("select(m: v::B, yes: &Self, no: &Self) -> Self", &|field, ty| {
            self.wide_select(ty, ["m", &format!("yes.{field}"), &format!("no.{field}")])
        })?;
        each(&format!("lane(&self, k: usize) -> scalar::{name}"), &|field, ty| {
            self.lane_of(ty, &format!("self.{field}"))
        })?;
        each(&format!("of(x: &[scalar::{name}; {}]) -> Self", lanes.count()), &|field, ty| {
            self.of_lanes(ty, &format!(".{field}"), lanes)
        })?;
        out.close("}");
        out.line("");
        Ok(())
    }

    /// Lane `k` of the place `text`.
    fn lane_of(&self, ty: Handle<Type>, text: &str) -> Result<String, NativeError> {
        let span = self.module.types.get_span(ty);
        match self.module.types[ty].inner {
            TypeInner::Struct { .. } => Ok(format!("{text}.lane(k)")),
            TypeInner::Scalar(scalar) => {
                Ok(format!("v::{}_to({text})[k % v::LANES]", letter(scalar.kind)))
            }
            TypeInner::Vector { size, scalar } => {
                let lane = |axis: &&str| {
                    format!("v::{}_to({text}.{axis})[k % v::LANES]", letter(scalar.kind))
                };
                let parts: Vec<String> = LANES[..size as usize].iter().map(lane).collect();
                Ok(format!("glam::{}::new({})", vector_name(size, scalar.kind), parts.join(", ")))
            }
            TypeInner::Array { base, size, .. } => {
                let length = self.array_length(size, span)?;
                let part = |k: u32| self.lane_of(base, &format!("{text}[{k}]"));
                let parts = (0..length).map(part).collect::<Result<Vec<_>, _>>()?;
                Ok(format!("[{}]", parts.join(", ")))
            }
            ref inner => Err(self.refuse(span, crate::types::type_word(inner))),
        }
    }

    /// Lanes from part `path` of each of the scalar structs `x`.
    fn of_lanes(&self, ty: Handle<Type>, path: &str, lanes: Lanes) -> Result<String, NativeError> {
        let span = self.module.types.get_span(ty);
        let all = |path: &str| -> String {
            let each: Vec<String> = (0..lanes.count()).map(|k| format!("x[{k}]{path}")).collect();
            format!("[{}]", each.join(", "))
        };
        match self.module.types[ty].inner {
            TypeInner::Struct { .. } => Ok(format!("{}::of(&{})", self.struct_name(ty), all(path))),
            TypeInner::Scalar(scalar) => {
                Ok(format!("v::{}_of({})", letter(scalar.kind), all(path)))
            }
            TypeInner::Vector { size, scalar } => {
                let lane = |axis: &&str| {
                    format!("v::{}_of({})", letter(scalar.kind), all(&format!("{path}.{axis}")))
                };
                Ok(vector(&LANES[..size as usize].iter().map(lane).collect::<Vec<_>>()))
            }
            TypeInner::Array { base, size, .. } => {
                let length = self.array_length(size, span)?;
                let part = |k: u32| self.of_lanes(base, &format!("{path}[{k}]"), lanes);
                let parts = (0..length).map(part).collect::<Result<Vec<_>, _>>()?;
                Ok(format!("[{}]", parts.join(", ")))
            }
            ref inner => Err(self.refuse(span, crate::types::type_word(inner))),
        }
    }
}
