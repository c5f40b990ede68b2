//! Which statements may take lanes out of a mask.

use naga::{Block, Statement};

/// Whether a lane may leave the block around `statement` in it.
pub(crate) fn leaves(statement: &Statement) -> bool {
    match statement {
        Statement::Return { .. } | Statement::Break | Statement::Continue => true,
        Statement::Block(block) => block_leaves(block),
        Statement::If { accept, reject, .. } => block_leaves(accept) || block_leaves(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|case| leaves_switch(&case.body)),
        Statement::Loop { body, continuing, .. } => returns(body) || returns(continuing),
        _ => false,
    }
}

/// Whether a lane may leave `block`.
pub(crate) fn block_leaves(block: &Block) -> bool {
    block.iter().any(leaves)
}

/// As `block_leaves`, of what also leaves the switch around it.
fn leaves_switch(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Return { .. } | Statement::Continue => true,
        Statement::Block(block) => leaves_switch(block),
        Statement::If { accept, reject, .. } => leaves_switch(accept) || leaves_switch(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|case| leaves_switch(&case.body)),
        Statement::Loop { body, continuing, .. } => returns(body) || returns(continuing),
        _ => false,
    })
}

/// Whether a lane may return in `block`.
pub(crate) fn returns(block: &Block) -> bool {
    returns_in(block.iter())
}

/// Whether a lane may return in one of these.
pub(crate) fn returns_in<'b>(mut statements: impl Iterator<Item = &'b Statement>) -> bool {
    statements.any(|statement| match statement {
        Statement::Return { .. } => true,
        Statement::Block(block) => returns(block),
        Statement::If { accept, reject, .. } => returns(accept) || returns(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|case| returns(&case.body)),
        Statement::Loop { body, continuing, .. } => returns(body) || returns(continuing),
        _ => false,
    })
}
