//! Statements: naga's structured control flow → masks.
//!
//! Each block has a mask of its own, out of which lanes are taken that leave it early; what comes after in the block is
//! skipped when none is left.

use super::exits::{block_leaves, leaves, returns};
use super::functions::{Scope, WideWriter};
use crate::error::NativeError;
use naga::{Block, Expression, Handle, Span, Statement, SwitchCase, SwitchValue};

impl WideWriter<'_> {
    /// Writes a block in a mask of its own, `mask`.
    fn write_block(&mut self, block: &Block, mask: &str) -> Result<(), NativeError> {
        let outer = std::mem::replace(&mut self.mask, mask.to_owned());
        let whole = std::mem::replace(&mut self.whole, false);
        let nested = self.write_statements(block, block.len())?;
        for _ in 0..nested {
            self.out.close("}");
        }
        self.mask = outer;
        self.whole = whole;
        Ok(())
    }

    /// Writes the first `n` statements in the current mask; says how many blocks are still open behind them.
    pub(crate) fn write_statements(
        &mut self,
        block: &Block,
        n: usize,
    ) -> Result<usize, NativeError> {
        let mut nested = 0;
        let outer = std::mem::replace(&mut self.block, std::ptr::from_ref(block));
        let is_body = std::ptr::eq(block, &raw const self.fun.body);
        for (k, (statement, span)) in block.span_iter().enumerate().take(n) {
            if is_body {
                self.declare_before(k)?;
            }
            if let Statement::Emit(range) = statement {
                self.write_emitted(range.clone(), block.get(k + 1))?;
                continue;
            }
            self.write_statement(statement, *span)?;
            if leaves(statement) {
                self.whole = false;
                if k + 1 < n {
                    self.out.open(&format!("if v::any({}) {{", self.mask));
                    nested += 1;
                }
            }
        }
        self.block = outer;
        Ok(nested)
    }

    fn write_statement(&mut self, statement: &Statement, span: Span) -> Result<(), NativeError> {
        match statement {
            Statement::Emit(range) => self.write_emitted(range.clone(), None),
            Statement::Block(block) => {
                self.out.open("{");
                let nested = self.write_statements(block, block.len())?;
                for _ in 0..nested {
                    self.out.close("}");
                }
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
            Statement::Break => {
                let Some(Scope::Loop { broken, .. } | Scope::Switch { broken }) =
                    self.scopes.last()
                else {
                    return Err(self.cx.refuse(span, "`break` outside a loop"));
                };
                let broken = broken.clone();
                self.leave_to(&broken);
                Ok(())
            }
            Statement::Continue => {
                let waiting = self.scopes.iter().rev().find_map(|scope| match scope {
                    Scope::Loop { waiting, .. } => Some(waiting.clone()),
                    Scope::Switch { .. } => None,
                });
                let Some(waiting) = waiting else {
                    return Err(self.cx.refuse(span, "`continue` outside a loop"));
                };
                self.leave_to(&waiting);
                Ok(())
            }
            Statement::Return { value } => {
                if let Some(value) = value {
                    self.write_result(*value)?;
                }
                self.out.line(&format!("{} = v::b(false);", self.mask));
                Ok(())
            }
            Statement::Store { pointer, value } => self.write_store(*pointer, *value),
            Statement::Call { function, arguments, result } => {
                let name = self.cx.function_name(*function);
                let callee = &self.cx.module.functions[*function];
                self.write_call(name, callee, arguments, *result)
            }
            _ => Err(self.place(self.cx.refuse(span, "this statement, in lanes,"))),
        }
    }

    /// The lanes of the mask go to another.
    fn leave_to(&mut self, other: &str) {
        let mask = self.mask.clone();
        self.out.line(&format!("{other} = v::or_b({other}, {mask});"));
        self.out.line(&format!("{mask} = v::b(false);"));
    }

    /// The result of the lanes that are left.
    pub(crate) fn write_result(&mut self, value: Handle<Expression>) -> Result<(), NativeError> {
        let value = self.value(value)?;
        let (Some(result), Some(ty)) = (self.result.clone(), &self.fun.result) else {
            return Err(
                self.place(NativeError::nowhere("a result that is not declared".to_owned()))
            );
        };
        let value = self.named(&value);
        let chosen = self.cx.wide_select(ty.ty, [&self.mask.clone(), &value, &result])?;
        self.out.line(&format!("{result} = {chosen};"));
        Ok(())
    }

    fn write_if(
        &mut self,
        condition: Handle<Expression>,
        accept: &Block,
        reject: &Block,
    ) -> Result<(), NativeError> {
        let condition = self.value(condition)?;
        let condition = self.named(&condition);
        let mask = self.mask.clone();
        let leaves = block_leaves(accept) || block_leaves(reject);
        let mut ends = Vec::new();
        for (block, function) in [(accept, "and_b"), (reject, "but_b")] {
            if block.is_empty() && !leaves {
                continue;
            }
            let own = self.names.add("m");
            self.out.line(&format!("let mut {own} = v::{function}({mask}, {condition});"));
            if !block.is_empty() {
                self.out.open(&format!("if v::any({own}) {{"));
                self.write_block(block, &own)?;
                self.out.close("}");
            }
            ends.push(own);
        }
        self.join(leaves, &ends);
        Ok(())
    }

    /// The mask is that of the lanes that have come to one of the ends.
    fn join(&mut self, leaves: bool, ends: &[String]) {
        if leaves {
            let all = ends
                .iter()
                .skip(1)
                .fold(ends[0].clone(), |all, end| format!("v::or_b({all}, {end})"));
            self.out.line(&format!("{} = {all};", self.mask));
        }
    }

    fn write_switch(
        &mut self,
        selector: Handle<Expression>,
        cases: &[SwitchCase],
        span: Span,
    ) -> Result<(), NativeError> {
        let selector = self.value(selector)?;
        let selector = self.named(&selector);
        let mask = self.mask.clone();
        let is = |value: &SwitchValue| match value {
            SwitchValue::I32(value) => Some(format!("v::eq_i({selector}, v::i({value}))")),
            SwitchValue::U32(value) => Some(format!("v::eq_u({selector}, v::u({value}))")),
            SwitchValue::Default => None,
        };
        let broken = self.names.add("broken");
        self.out.line(&format!("let mut {broken} = v::b(false);"));
        self.scopes.push(Scope::Switch { broken: broken.clone() });
        let leaves = cases.iter().any(|case| block_leaves(&case.body));
        let mut ends = vec![broken];
        let mut conditions: Vec<Option<String>> = Vec::new();
        for case in cases {
            conditions.push(is(&case.value));
            if case.fall_through {
                if !case.body.is_empty() {
                    return Err(self.place(self.cx.refuse(span, "a `switch` that falls through")));
                }
                continue;
            }
            let asked = std::mem::take(&mut conditions);
            let own = self.names.add("m");
            let condition = if asked.iter().any(Option::is_none) {
                // Whoever asks for nothing else.
                let other: Vec<String> = cases.iter().filter_map(|case| is(&case.value)).collect();
                let named: Vec<String> = asked.into_iter().flatten().collect();
                let other: Vec<String> =
                    other.into_iter().filter(|text| !named.contains(text)).collect();
                format!("v::but_b({mask}, {})", any_of(&other))
            } else {
                let asked: Vec<String> = asked.into_iter().flatten().collect();
                format!("v::and_b({mask}, {})", any_of(&asked))
            };
            self.out.line(&format!("let mut {own} = {condition};"));
            if !case.body.is_empty() {
                self.out.open(&format!("if v::any({own}) {{"));
                self.write_block(&case.body, &own)?;
                self.out.close("}");
            }
            ends.push(own);
        }
        self.scopes.pop();
        self.join(leaves, &ends);
        Ok(())
    }

    fn write_loop(
        &mut self,
        body: &Block,
        continuing: &Block,
        break_if: Option<Handle<Expression>>,
    ) -> Result<(), NativeError> {
        let [active, broken, waiting] = ["m", "broken", "waiting"].map(|stem| self.names.add(stem));
        let mask = self.mask.clone();
        self.out.line(&format!("let mut {active} = {mask};"));
        self.out.line(&format!("let mut {broken} = v::b(false);"));
        self.out.open("loop {");
        self.out.line(&format!("let mut {waiting} = v::b(false);"));
        self.scopes.push(Scope::Loop { broken: broken.clone(), waiting: waiting.clone() });
        self.write_block(body, &active)?;
        self.out.line(&format!("{active} = v::or_b({active}, {waiting});"));
        self.write_block(continuing, &active)?;
        if let Some(condition) = break_if {
            let condition = self.value(condition)?;
            let condition = self.named(&condition);
            self.out
                .line(&format!("{broken} = v::or_b({broken}, v::and_b({active}, {condition}));"));
            self.out.line(&format!("{active} = v::but_b({active}, {condition});"));
        }
        self.out.open(&format!("if !v::any({active}) {{"));
        self.out.line("break;");
        self.out.close("}");
        self.scopes.pop();
        self.out.close("}");
        self.join(returns(body) || returns(continuing), &[broken]);
        Ok(())
    }
}

/// One of several conditions.
fn any_of(conditions: &[String]) -> String {
    match conditions {
        [] => "v::b(false)".to_owned(),
        [first, rest @ ..] => {
            rest.iter().fold(first.clone(), |all, one| format!("v::or_b({all}, {one})"))
        }
    }
}
