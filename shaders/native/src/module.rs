//! One module → its Rust text: the order in which its parts are written.

use crate::context::Context;
use crate::error::NativeError;
use crate::functions::FunctionWriter;
use crate::text::Text;
use naga::Span;

impl Context<'_> {
    /// Writes the whole module.
    pub(crate) fn write(&self) -> Result<String, NativeError> {
        let mut out = Text::default();
        out.line("// Generated from WGSL by the crate `native`. Do not edit.");
        self.write_aliases(&mut out);
        self.write_structs(&mut out)?;
        self.write_constants(&mut out)?;
        out.line("");
        self.write_resources(&mut out)?;
        out.open("impl<'a> Kernel<'a> {");
        self.write_constructor(&mut out)?;
        for (index, entry) in self.module.entry_points.iter().enumerate() {
            out.line("");
            let info = self.info.get_entry_point(index);
            let name = &self.entry_points[index];
            let body = FunctionWriter::new(self, &entry.function, info, Span::UNDEFINED)
                .write_entry(entry, name)?;
            out.raw(&body);
        }
        for (handle, function) in self.module.functions.iter() {
            out.line("");
            let span = self.module.functions.get_span(handle);
            let writer = FunctionWriter::new(self, function, &self.info[handle], span);
            let name = self.function_name(handle);
            let Some((path, own)) = &self.seams[handle.index()] else {
                out.raw(&writer.write_function(name)?);
                continue;
            };
            out.raw(&writer.write_seam(name, path)?);
            out.line("");
            let writer = FunctionWriter::new(self, function, &self.info[handle], span);
            out.raw(&writer.write_function(own)?);
        }
        out.close("}");
        out.line("");
        out.line("mod wgsl {");
        out.raw(crate::prelude::text());
        out.line("}");
        Ok(out.finish())
    }
}
