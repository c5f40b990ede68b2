//! `rtc cache`: what the BVH cache holds, and how to empty it.

use clap::Args;
use files::ShowPath as _;

use super::args::{IO, printed};
use crate::cache::Cache;
use crate::report::{Color, ErrorFormat, Reporter};

#[derive(Debug, Args)]
pub(super) struct CacheArgs {
    /// Delete every cached tree.
    #[arg(long, conflicts_with = "stats")]
    clear: bool,
    /// Print where the cache is and how much it holds; the default.
    #[arg(long)]
    stats: bool,
}

pub(super) fn cache(args: &CacheArgs) -> u8 {
    let reporter = Reporter::new(ErrorFormat::Human, Color::Auto, usize::MAX);
    let cache = Cache::from_env();
    let Some(root) = cache.root().map(|root| root.shown().to_string()) else {
        let text = "there is no cache: neither RTC_CACHE_DIR nor a home directory is set";
        return printed(&reporter, text);
    };
    let (result, what) =
        if args.clear { (cache.clear(), "deleted") } else { (cache.stats(), "cached") };
    match result {
        Ok(stats) => {
            let megabytes = stats.bytes as f64 / 1e6;
            let text = format!("{root}: {} trees {what}, {megabytes:.1} MB", stats.entries);
            printed(&reporter, &text)
        }
        Err(error) => {
            reporter.failure(&error.to_string());
            IO
        }
    }
}
