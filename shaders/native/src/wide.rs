//! A WGSL compute kernel → the text of a Rust module that computes eight or sixteen invocations at once.
//!
//! The third form of a kernel, beside the two of [`crate::generate`]: values that may differ between invocations are
//! lanes, and control flow is masks. A side of an `if` runs where some lane takes it, a case of a `switch` where
//! some lane asks for it, a loop until no lane is left; `return`, `break` and `continue` take lanes out of the mask;
//! what is stored is stored in the lanes of the mask. Every lane has the bits of the scalar form.
//!
//! Only what the entry points and hand-written code call is translated, without what is done by hand. The module needs
//! `glam`, `bytemuck` and the scalar module, whose constants and structs it uses; all its functions are compiled for the
//! instructions of its lanes, so that calling an entry point is `unsafe` where those are not known to be there.

mod builtins;
mod calls;
mod exits;
mod expressions;
mod functions;
mod homes;
mod operators;
mod places;
mod statements;
mod structs;
mod target;
mod types;

use crate::context::Context;
use crate::error::NativeError;
use crate::options::Lanes;
use crate::text::Text;
use functions::WideWriter;
use naga::{AddressSpace, Block, Function, Handle, Statement};

impl Context<'_> {
    /// Writes the wide form; `scalar` is the path of the module with the scalar form.
    pub(crate) fn write_wide(&self, scalar: &str, lanes: Lanes) -> Result<String, NativeError> {
        let mut out = Text::default();
        out.line("// Generated from WGSL by the crate `native`. Do not edit.");
        out.line(&format!("use {scalar} as scalar;"));
        out.line("");
        let reached = self.reached();
        self.write_wide_structs(&mut out, lanes)?;
        self.write_wide_resources(&mut out)?;
        out.open("impl<'a> Kernel<'a> {");
        for (index, entry) in self.module.entry_points.iter().enumerate() {
            let info = self.info.get_entry_point(index);
            let writer =
                WideWriter::new(self, lanes, (&entry.function, info, naga::Span::UNDEFINED));
            out.raw(&writer.write_entry(&self.entry_points[index])?);
        }
        for (handle, function) in self.module.functions.iter() {
            if !reached[handle.index()] {
                continue;
            }
            out.line("");
            let span = self.module.functions.get_span(handle);
            let writer = WideWriter::new(self, lanes, (function, &self.info[handle], span));
            let name = self.function_name(handle);
            out.raw(&match &self.seams[handle.index()] {
                Some((path, _)) => writer.write_seam(name, path)?,
                None => writer.write_function(name)?,
            });
        }
        out.close("}");
        out.line("");
        out.line("pub mod v {");
        out.raw(&lanes.operations());
        out.line("}");
        Ok(out.finish())
    }

    /// What the entry points and hand-written code call, be it over other functions; nothing that only a seam's own
    /// translation calls.
    fn reached(&self) -> Vec<bool> {
        let mut reached = vec![false; self.module.functions.len()];
        let mut left: Vec<&Block> =
            self.module.entry_points.iter().map(|entry| &entry.function.body).collect();
        for (handle, function) in self.module.functions.iter() {
            if function.name.as_deref().is_some_and(|name| self.entrances.contains(&name)) {
                reached[handle.index()] = true;
                left.push(&function.body);
            }
        }
        while let Some(block) = left.pop() {
            let mut called = Vec::new();
            calls(block, &mut called);
            for function in called {
                let index: usize = Handle::<Function>::index(function);
                if !std::mem::replace(&mut reached[index], true) && self.seams[index].is_none() {
                    left.push(&self.module.functions[function].body);
                }
            }
        }
        reached
    }

    /// Writes `Kernel`, the resources of a group of invocations after another.
    fn write_wide_resources(&self, out: &mut Text) -> Result<(), NativeError> {
        let mut members = Vec::new();
        for (handle, global) in self.module.global_variables.iter() {
            if global.space == AddressSpace::Private {
                continue;
            }
            let name = self.global_name(handle);
            members.push(format!("pub {name}: {},", self.wide_resource(handle)?));
        }
        if let Some(companion) = self.companion {
            members.push(format!("pub companion: {companion},"));
        }
        out.line("/// The resources of one group of invocations after another.");
        out.open("pub struct Kernel<'a> {");
        out.lines(&members);
        out.close("}");
        out.line("");
        Ok(())
    }
}

/// The functions that a block calls.
fn calls(block: &Block, found: &mut Vec<Handle<Function>>) {
    for statement in block {
        match statement {
            Statement::Call { function, .. } => found.push(*function),
            Statement::Block(block) => calls(block, found),
            Statement::If { accept, reject, .. } => {
                calls(accept, found);
                calls(reject, found);
            }
            Statement::Switch { cases, .. } => {
                for case in cases {
                    calls(&case.body, found);
                }
            }
            Statement::Loop { body, continuing, .. } => {
                calls(body, found);
                calls(continuing, found);
            }
            _ => {}
        }
    }
}
