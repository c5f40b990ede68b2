//! Which variables may be stored without regard to the mask, and where each is needed first.
//!
//! Lanes that leave a block do not come back to it before it begins anew. A variable that is nowhere but in one block,
//! and is stored as a whole there before anything else is done with it, holds nothing for lanes that have left: the
//! block is its home, where stores need not keep what those lanes had.

use naga::{Block, Expression, Function, Handle, LocalVariable, Statement};

/// The home of each variable, by the address of its block; nothing for a variable without one.
pub(crate) fn homes(fun: &Function) -> Vec<Option<*const Block>> {
    fun.local_variables.iter().map(|(local, _)| home(fun, &fun.body, local)).collect()
}

/// For each variable the first statement of the function's own block that does anything with it, if there is one.
pub(crate) fn first_uses(fun: &Function) -> Vec<Option<usize>> {
    let first = |local| fun.body.iter().position(|statement| uses(fun, statement, local));
    fun.local_variables.iter().map(|(local, _)| first(local)).collect()
}

/// The home of `local`, which is nowhere but in `block`, if it is used at all.
fn home(fun: &Function, block: &Block, local: Handle<LocalVariable>) -> Option<*const Block> {
    let mut using = block.iter().filter(|statement| uses(fun, statement, local));
    let statement = using.next()?;
    if let Statement::Store { pointer, value } = statement
        && is_variable(fun, *pointer, local)
        && !made_of(fun, *value, local)
    {
        return Some(std::ptr::from_ref(block));
    }
    if using.next().is_some() {
        return None;
    }
    match statement {
        Statement::Block(block) => home(fun, block, local),
        Statement::If { accept, reject, .. } => {
            let both = block_uses(fun, accept, local) && block_uses(fun, reject, local);
            let block = if block_uses(fun, accept, local) { accept } else { reject };
            if both { None } else { home(fun, block, local) }
        }
        Statement::Switch { cases, .. } => {
            let mut using = cases.iter().filter(|case| block_uses(fun, &case.body, local));
            let case = using.next()?;
            if using.next().is_some() { None } else { home(fun, &case.body, local) }
        }
        Statement::Loop { body, continuing, break_if } => {
            let after = break_if.is_some() || block_uses(fun, continuing, local);
            if after { None } else { home(fun, body, local) }
        }
        _ => None,
    }
}

/// Whether `handle` is the variable itself.
fn is_variable(fun: &Function, handle: Handle<Expression>, local: Handle<LocalVariable>) -> bool {
    matches!(fun.expressions[handle], Expression::LocalVariable(variable) if variable == local)
}

/// Whether a value or a pointer is made of the variable without another statement between.
fn made_of(fun: &Function, handle: Handle<Expression>, local: Handle<LocalVariable>) -> bool {
    is_variable(fun, handle, local)
        || match fun.expressions[handle] {
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => {
                made_of(fun, base, local)
            }
            Expression::Load { pointer } => made_of(fun, pointer, local),
            _ => false,
        }
}

fn block_uses(fun: &Function, block: &Block, local: Handle<LocalVariable>) -> bool {
    block.iter().any(|statement| uses(fun, statement, local))
}

fn uses(fun: &Function, statement: &Statement, local: Handle<LocalVariable>) -> bool {
    let of = |handle: &Handle<Expression>| made_of(fun, *handle, local);
    match statement {
        Statement::Emit(range) => range.clone().any(|handle| made_of(fun, handle, local)),
        Statement::Block(block) => block_uses(fun, block, local),
        Statement::If { condition, accept, reject } => {
            of(condition) || block_uses(fun, accept, local) || block_uses(fun, reject, local)
        }
        Statement::Switch { selector, cases } => {
            of(selector) || cases.iter().any(|case| block_uses(fun, &case.body, local))
        }
        Statement::Loop { body, continuing, .. } => {
            block_uses(fun, body, local) || block_uses(fun, continuing, local)
        }
        Statement::Return { value } => value.iter().any(of),
        Statement::Store { pointer, value } => of(pointer) || of(value),
        Statement::Call { arguments, .. } => arguments.iter().any(of),
        _ => false,
    }
}
