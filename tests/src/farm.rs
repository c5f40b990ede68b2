//! What a large frame costs on many machines: measured here, simulated there.
//!
//! `cost` turns a scene into the cost of every tile, `tasks` measures whole tasks and merging, `schedule` simulates
//! machines that take such tasks, and `page` says what that comes to. `merging` measures that alone, for frames with
//! layers. See `docs/farm.md`.

pub mod cost;
pub mod merging;
pub mod page;
pub mod schedule;
pub mod tasks;
