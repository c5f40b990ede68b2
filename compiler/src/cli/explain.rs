//! `rtc explain`: the page behind an error code or a kind.

use clap::Args;

use super::args::{USAGE, printed};
use crate::report::{Color, ErrorFormat, Reporter};

#[derive(Debug, Args)]
pub(super) struct ExplainArgs {
    /// A code (`E0301`) or a kind (`material.diffuse`, `camera.perspective`).
    topic: String,
}

pub(super) fn explain(args: &ExplainArgs) -> u8 {
    let reporter = Reporter::new(ErrorFormat::Human, Color::Auto, usize::MAX);
    if let Some(page) = lang::explain(&args.topic) {
        return printed(&reporter, &page);
    }
    let topic = &args.topic;
    reporter.failure(&format!(
        "no page about `{topic}`; pages are about codes such as E0301 and kinds such as material.diffuse"
    ));
    USAGE
}
