//! `trace/ray.wgsl` where surfaces are there in part: rays know the random numbers that decide which of them they meet.
//!
//! The module is the one under `wgsl/` with one more field in `Ray`, so that the rays of all other scenes carry nothing.

use crate::modules::module_texts;

/// What is added, each behind the line that it belongs to.
const ADDED: [(&str, &str); 3] = [
    ("#import \"scene/constants.wgsl\"\n", "#import \"sampler/key.wgsl\"\n"),
    (
        "    // The instance in whose frame the ray is; `NONE`: the world.\n    instance: u32,\n",
        "    // Whose numbers decide which surfaces of partial coverage the ray meets; see `trace/coverage.wgsl`.\n    \
         key: SampleKey,\n",
    ),
    (
        "    return Ray(origin, t_max, 0.0, vec2u(NONE), dir, skip, light, time, NONE",
        ", SampleKey(0u, 0u, 0u, 0u)",
    ),
];

/// The module for a scene with partial coverage.
pub(crate) fn with_key() -> String {
    let plain = module_texts().iter().find(|(name, _)| *name == "trace/ray.wgsl");
    let plain = plain.map_or_else(String::new, |(_, text)| (*text).to_owned());
    ADDED
        .into_iter()
        .fold(plain, |text, (line, more)| text.replacen(line, &(line.to_owned() + more), 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_line_is_there_once() {
        let texts = module_texts().iter().filter(|(name, _)| *name == "trace/ray.wgsl");
        let counts: Vec<usize> =
            texts.flat_map(|(_, text)| ADDED.map(|(line, _)| text.matches(line).count())).collect();
        assert_eq!(counts, [1, 1, 1]);
    }
}
