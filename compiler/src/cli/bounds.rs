//! `rtc show --bounds`: where everything in a scene is, as a table.

use std::fmt::Write as _;
use std::path::Path;

use lang::Analysis;
use lang::scene::Scene;
use lang::units::show_number;

use super::args::SceneArgs;
use super::compile::failed;
use crate::cache::Cache;
use crate::lower::{Bounds, Listed, Listing, Trees};
use crate::pipeline::{self, Options};
use crate::report::Reporter;

/// The table; what is wrong with a file is reported and becomes an exit code.
pub(super) fn bounds(
    args: &SceneArgs,
    (analysis, scene): (&Analysis, &Scene),
    reporter: &Reporter,
) -> Result<String, u8> {
    let cache = Cache::disabled();
    let options = options(args, &cache, reporter)?;
    let mut diagnostics = Vec::new();
    let listing = pipeline::list((scene, &analysis.sources), &options, &mut diagnostics);
    reporter.diagnostics(&analysis.sources, &diagnostics);
    listing.map(|listing| table(&listing)).map_err(|error| failed(&error, reporter))
}

/// How the files of a scene are read to look at them only.
pub(super) fn options<'a>(
    args: &'a SceneArgs,
    cache: &'a Cache,
    reporter: &Reporter,
) -> Result<Options<'a>, u8> {
    Ok(Options {
        root: args.scene.parent().unwrap_or(Path::new("")),
        trees: Trees::usual(cache),
        limits: args.limits(reporter)?,
        defines: &args.define,
    })
}

fn table(listing: &Listing) -> String {
    let Listing { world, assets, instances, lights } = listing;
    let mut rows = vec![("world".to_owned(), world, 1)];
    for (asset, parts) in assets {
        rows.push((format!("asset {}", asset.name), asset, parts.len()));
        // A file of one part is that part.
        let inner = if parts.len() > 1 { &parts[..] } else { &[] };
        let name = |part: &Listed| match part.name.as_str() {
            "" => "  part".to_owned(),
            name => format!("  part \"{name}\""),
        };
        rows.extend(inner.iter().map(|part| (name(part), part, 1)));
    }
    let named = |kind: &str, listed: &Listed| format!("{kind} {}", listed.name);
    rows.extend(instances.iter().map(|listed| (named("instance", listed), listed, 1)));
    rows.extend(lights.iter().map(|listed| (named("light", listed), listed, 1)));
    let widest = rows.iter().map(|(name, _, _)| name.chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for (name, listed, parts) in rows {
        let triangles = match listed.triangles {
            Some(1) => "1 triangle".to_owned(),
            Some(n) => format!("{n} triangles"),
            None => "sphere".to_owned(),
        };
        let parts = if parts > 1 { format!(" in {parts} parts") } else { String::new() };
        let place = listed.bounds.as_ref().map_or("nowhere".to_owned(), place);
        let _ = writeln!(text, "{name:<widest$}  {place}  {triangles}{parts}");
    }
    text + "\nBoxes are in metres: of assets and parts in their own frame, of all else in the world. `fit = NAME` in a\n\
            camera frames an instance.\n"
}

/// `(-1, 0, -1)m .. (1, 2, 1)m, 2 x 2 x 2 m`.
pub(super) fn place(Bounds { lo, hi }: &Bounds) -> String {
    let number =
        |x: f64| show_number(rounded(x, (hi[0] - lo[0]).max(hi[1] - lo[1]).max(hi[2] - lo[2])));
    let corner = |p: &[f64; 3]| format!("({})m", p.map(number).join(", "));
    let size = [0, 1, 2].map(|k| number(hi[k] - lo[k])).join(" x ");
    format!("{} .. {}, {size} m", corner(lo), corner(hi))
}

/// To about a ten-thousandth of `size`.
pub(super) fn rounded(x: f64, size: f64) -> f64 {
    if size <= 0.0 || !size.is_finite() {
        return x;
    }
    let steps = libm::pow(10.0, 4.0 - libm::floor(libm::log10(size)));
    let near = libm::round(x * steps) / steps;
    if near.is_finite() { near + 0.0 } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_have_as_many_digits_as_their_size_needs() {
        let bounds = Bounds { lo: [-0.5, 0.0, 1.0 / 3.0], hi: [0.5, 2.0, 1.0] };
        assert_eq!(place(&bounds), "(-0.5, 0, 0.3333)m .. (0.5, 2, 1)m, 1 x 2 x 0.6667 m");
        assert!((rounded(12_345.678, 20_000.0) - 12_346.0).abs() < 1e-9);
    }
}
