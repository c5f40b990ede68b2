//! A scene → a page that shows its picture while it grows, lets people look around, and says what they see.
//!
//! A [`Session`] is rendered by a thread that [`start`] begins, and shown to browsers by a [`Server`]. Nothing is written,
//! and a page that is closed leaves the picture as it is. It neither prints nor reads files.

mod camera;
mod client;
mod curve;
pub mod http;
mod plane;
mod renderer;
mod server;
mod session;
mod state;
mod sums;

pub use camera::View;
pub use renderer::start;
pub use server::{Server, Token, wake};
pub use session::{Options, Session};
