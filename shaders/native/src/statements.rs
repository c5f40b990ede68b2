//! Statements: naga's structured control flow → Rust's, with labels where they say more than the
//! plain keyword would.

use crate::NativeError;
use crate::expressions::operands;
use crate::functions::{FunctionWriter, Scope};
use naga::{
    AddressSpace, Block, Expression, Function, Handle, Span, Statement, SwitchCase, SwitchValue,
    TypeInner,
};

impl FunctionWriter<'_> {
    /// Writes a block's statements in order.
    pub(crate) fn write_block(&mut self, block: &Block) -> Result<(), NativeError> {
        let mut evaluated: Vec<Handle<Expression>> = Vec::new();
        for (statement, span) in block.span_iter() {
            if let Statement::Emit(range) = statement {
                // Nothing can be written between neighbours, so they are one.
                evaluated.extend(range.clone());
                continue;
            }
            self.write_emitted(&evaluated, read_at_once(statement))?;
            evaluated.clear();
            self.write_statement(statement, *span)?;
        }
        self.write_emitted(&evaluated, Vec::new())
    }

    fn write_statement(&mut self, statement: &Statement, span: Span) -> Result<(), NativeError> {
        match statement {
            Statement::Emit(range) => {
                self.write_emitted(&range.clone().collect::<Vec<_>>(), Vec::new())
            }
            Statement::Block(block) => {
                self.out.open("{");
                self.write_block(block)?;
                self.out.close("}");
                Ok(())
            }
            Statement::If { condition, accept, reject } => {
                self.write_if(*condition, accept, reject)
            }
            Statement::Switch { selector, cases } => self.write_switch(*selector, cases, span),
            Statement::Loop { body, continuing, break_if } => {
                self.write_loop(body, continuing, *break_if)
            }
            Statement::Break => self.write_break(span),
            Statement::Continue => self.write_continue(span),
            Statement::Return { value } => self.write_return(*value),
            Statement::Store { pointer, value } => self.write_store(*pointer, *value),
            Statement::Call { function, arguments, result } => {
                let name = self.cx.function_name(*function);
                let callee = &self.cx.module.functions[*function];
                self.write_call(name, callee, arguments, *result)
            }
            other => Err(self.place(self.cx.refuse(span, statement_word(other)))),
        }
    }

    /// Names what is evaluated here, except what its one reader can take as it is: an expression
    /// that is evaluated here too, or the statement that comes next and `reads` it.
    fn write_emitted(
        &mut self,
        handles: &[Handle<Expression>],
        reads: Vec<Handle<Expression>>,
    ) -> Result<(), NativeError> {
        let mut readers = vec![0_usize; handles.len()];
        let read = handles.iter().flat_map(|&handle| operands(&self.fun.expressions[handle]));
        for handle in read.chain(reads) {
            if let Ok(slot) = handles.binary_search_by_key(&handle.index(), |h| h.index()) {
                readers[slot] += 1;
            }
        }
        for (slot, &handle) in handles.iter().enumerate() {
            self.check_supported(handle)?;
            let n_readers = self.info[handle].ref_count;
            let only_here = n_readers == 1 && readers[slot] == 1;
            let named = self.fun.named_expressions.contains_key(&handle);
            let constant = !self.is_emitted(handle);
            let keep = named || !only_here || self.hoisted[handle.index()].is_some();
            if self.is_pointer(handle) {
                self.fix_index(handle)?;
            } else if n_readers > 0 && keep && !constant {
                self.bind(handle)?;
            }
        }
        Ok(())
    }

    fn write_if(
        &mut self,
        condition: Handle<Expression>,
        accept: &Block,
        reject: &Block,
    ) -> Result<(), NativeError> {
        let condition = self.value(condition)?;
        if accept.is_empty() && !reject.is_empty() {
            self.out.open(&format!("if !({condition}) {{"));
            self.write_block(reject)?;
        } else {
            self.out.open(&format!("if {condition} {{"));
            self.write_block(accept)?;
            if !reject.is_empty() {
                self.out.reopen("} else {");
                self.write_block(reject)?;
            }
        }
        self.out.close("}");
        Ok(())
    }

    fn label(&mut self, stem: &str) -> String {
        self.n_labels += 1;
        format!("'{stem}{}", self.n_labels)
    }

    fn write_switch(
        &mut self,
        selector: Handle<Expression>,
        cases: &[SwitchCase],
        span: Span,
    ) -> Result<(), NativeError> {
        let selector = self.value(selector)?;
        let label = self.label("switch");
        let has_break = cases.iter().any(|case| leaves_switch(&case.body));
        // The labelled block is what `break` leaves; Rust's `match` is not a target.
        if has_break {
            self.out.open(&format!("{label}: {{"));
        }
        self.scopes.push(Scope::Switch { label });
        self.out.open(&format!("match {selector} {{"));
        let mut patterns = Vec::new();
        let mut default = None;
        let mut has_default = false;
        for case in cases {
            match case.value {
                SwitchValue::I32(value) => patterns.push(format!("{value}i32")),
                SwitchValue::U32(value) => patterns.push(format!("{value}u32")),
                SwitchValue::Default => has_default = true,
            }
            if case.fall_through {
                if !case.body.is_empty() {
                    return Err(self.place(self.cx.refuse(span, "a `switch` that falls through")));
                }
                continue;
            }
            if has_default {
                // Rust's `_` comes last; the arms are disjoint, so their order says nothing.
                default = Some(&case.body);
                has_default = false;
            } else {
                self.write_arm(&patterns.join(" | "), &case.body)?;
            }
            patterns.clear();
        }
        match default {
            Some(body) => self.write_arm("_", body)?,
            None => self.out.line("_ => {}"),
        }
        self.out.close("}");
        if has_break {
            self.out.close("}");
        }
        self.scopes.pop();
        Ok(())
    }

    fn write_arm(&mut self, pattern: &str, body: &Block) -> Result<(), NativeError> {
        self.out.open(&format!("{pattern} => {{"));
        self.write_block(body)?;
        self.out.close("}");
        Ok(())
    }

    fn write_loop(
        &mut self,
        body: &Block,
        continuing: &Block,
        break_if: Option<Handle<Expression>>,
    ) -> Result<(), NativeError> {
        let label = self.label("repeat");
        let has_end = !continuing.is_empty() || break_if.is_some();
        let next = (has_end && continues(body)).then(|| self.label("next"));
        self.out.open(&format!("{label}: loop {{"));
        self.scopes.push(Scope::Loop { label: label.clone(), next: next.clone() });
        if let Some(next) = &next {
            self.hoist(body, continuing, break_if)?;
            self.out.open(&format!("{next}: {{"));
        }
        self.write_block(body)?;
        if next.is_some() {
            self.out.close("}");
        }
        self.write_block(continuing)?;
        if let Some(condition) = break_if {
            let condition = self.value(condition)?;
            self.out.open(&format!("if {condition} {{"));
            self.out.line(&format!("break {label};"));
            self.out.close("}");
        }
        self.scopes.pop();
        self.out.close("}");
        Ok(())
    }

    /// Declares, before the labelled body, the values of the body that the continuing block reads.
    fn hoist(
        &mut self,
        body: &Block,
        continuing: &Block,
        break_if: Option<Handle<Expression>>,
    ) -> Result<(), NativeError> {
        let mut read: Vec<Handle<Expression>> = break_if.into_iter().collect();
        read_in(continuing, self.fun, &mut read);
        let mut seen = vec![false; self.fun.expressions.len()];
        while let Some(handle) = read.pop() {
            // A pointer has no name of its own; what it was made of must live as long.
            if !std::mem::replace(&mut seen[handle.index()], true) && self.is_pointer(handle) {
                read.extend(operands(&self.fun.expressions[handle]));
            }
        }
        for statement in body {
            let made: Vec<Handle<Expression>> = match statement {
                Statement::Emit(range) => range.clone().collect(),
                Statement::Call { result, .. } => result.iter().copied().collect(),
                _ => continue,
            };
            for handle in made {
                if seen[handle.index()] && !self.is_pointer(handle) {
                    let name = self.new_name(handle);
                    let ty = self.rust_type(handle)?;
                    let zero = self.zero_of(handle)?;
                    self.out.line(&format!("let mut {name}: {ty} = {zero};"));
                    self.hoisted[handle.index()] = Some(name);
                }
            }
        }
        Ok(())
    }

    fn write_break(&mut self, span: Span) -> Result<(), NativeError> {
        let line = match self.scopes.last() {
            Some(Scope::Loop { label, .. } | Scope::Switch { label }) => format!("break {label};"),
            None => return Err(self.cx.refuse(span, "`break` outside a loop")),
        };
        self.out.line(&line);
        Ok(())
    }

    fn write_continue(&mut self, span: Span) -> Result<(), NativeError> {
        let target = self.scopes.iter().rev().find_map(|scope| match scope {
            Scope::Loop { next: Some(next), .. } => Some(format!("break {next};")),
            Scope::Loop { label, next: None } => Some(format!("continue {label};")),
            Scope::Switch { .. } => None,
        });
        let Some(line) = target else {
            return Err(self.cx.refuse(span, "`continue` outside a loop"));
        };
        self.out.line(&line);
        Ok(())
    }

    fn write_return(&mut self, value: Option<Handle<Expression>>) -> Result<(), NativeError> {
        let line = match value {
            Some(value) => format!("return {};", self.value(value)?),
            None => "return;".to_owned(),
        };
        self.out.line(&line);
        Ok(())
    }

    fn write_call(
        &mut self,
        name: &str,
        callee: &Function,
        arguments: &[Handle<Expression>],
        result: Option<Handle<Expression>>,
    ) -> Result<(), NativeError> {
        let mut texts = Vec::new();
        let mut lent: Vec<String> = Vec::new();
        for (&argument, parameter) in arguments.iter().zip(&callee.arguments) {
            let text = match self.cx.module.types[parameter.ty].inner {
                TypeInner::Pointer { space: AddressSpace::Function, .. } => {
                    let text = self.lend(argument)?;
                    let root = text.split(['.', '[']).next().unwrap_or_default().to_owned();
                    if lent.contains(&root) {
                        return Err(self.refuse(argument, "two pointers into one variable"));
                    }
                    lent.push(root);
                    text
                }
                _ => self.value(argument)?,
            };
            texts.push(text);
        }
        let call = format!("self.{name}({})", texts.join(", "));
        match result {
            Some(result) if self.info[result].ref_count > 0 => self.bind_as(result, &call),
            _ => self.out.line(&format!("{call};")),
        }
        Ok(())
    }
}

/// The operands that a statement reads before it does anything else.
fn read_at_once(statement: &Statement) -> Vec<Handle<Expression>> {
    match statement {
        Statement::If { condition, .. } => vec![*condition],
        Statement::Switch { selector, .. } => vec![*selector],
        Statement::Return { value } => value.iter().copied().collect(),
        Statement::Store { value, .. } => vec![*value],
        _ => Vec::new(),
    }
}

/// Whether a `continue` in `block` belongs to the loop around it.
fn continues(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Continue => true,
        Statement::Block(block) => continues(block),
        Statement::If { accept, reject, .. } => continues(accept) || continues(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|case| continues(&case.body)),
        _ => false,
    })
}

/// Whether a `break` in `block` belongs to the switch around it.
fn leaves_switch(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Break => true,
        Statement::Block(block) => leaves_switch(block),
        Statement::If { accept, reject, .. } => leaves_switch(accept) || leaves_switch(reject),
        _ => false,
    })
}

/// Collects the expressions that `block` reads or evaluates, nested blocks included.
fn read_in(block: &Block, fun: &Function, read: &mut Vec<Handle<Expression>>) {
    for statement in block {
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    read.extend(operands(&fun.expressions[handle]));
                }
            }
            Statement::Block(block) => read_in(block, fun, read),
            Statement::If { condition, accept, reject } => {
                read.push(*condition);
                read_in(accept, fun, read);
                read_in(reject, fun, read);
            }
            Statement::Switch { selector, cases } => {
                read.push(*selector);
                for case in cases {
                    read_in(&case.body, fun, read);
                }
            }
            Statement::Loop { body, continuing, break_if } => {
                read.extend(break_if);
                read_in(body, fun, read);
                read_in(continuing, fun, read);
            }
            Statement::Return { value } => read.extend(value),
            Statement::Store { pointer, value } => read.extend([*pointer, *value]),
            Statement::Call { arguments, .. } => read.extend(arguments),
            _ => {}
        }
    }
}

/// What a statement that has no translation is called.
fn statement_word(statement: &Statement) -> &'static str {
    match statement {
        Statement::Kill => "`discard`",
        Statement::ControlBarrier(_) | Statement::MemoryBarrier(_) => "a barrier",
        Statement::ImageStore { .. } | Statement::ImageAtomic { .. } => "a texture store",
        Statement::Atomic { .. } => "an atomic operation",
        Statement::WorkGroupUniformLoad { .. } => "`workgroupUniformLoad`",
        Statement::RayQuery { .. } | Statement::RayPipelineFunction(_) => "a ray query",
        Statement::SubgroupBallot { .. }
        | Statement::SubgroupGather { .. }
        | Statement::SubgroupCollectiveOperation { .. } => "a subgroup operation",
        Statement::CooperativeStore { .. } => "a cooperative matrix",
        _ => "this statement",
    }
}
