//! "Did you mean …?": the names that a misspelt one resembles.

/// At most three of `names` that resemble `word`, best first; empty where none is close enough.
///
/// Order: equal but for case; the same parts in another order (`width_ring` for `ring.width`); edit
/// distance of at most a third of the longer of `word` and three. Where the first two rules find
/// something, the third is not asked.
pub fn suggest<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let names: Vec<&str> = names.into_iter().filter(|name| *name != word).collect();
    let lower = word.to_lowercase();
    let same_but_case = collect(&names, |name| name.to_lowercase() == lower);
    if !same_but_case.is_empty() {
        return same_but_case;
    }
    let parts = sorted_parts(&lower);
    let permuted = collect(&names, |name| sorted_parts(&name.to_lowercase()) == parts);
    if !permuted.is_empty() {
        return permuted;
    }
    near(&lower, &names)
}

/// The first three names, in order of the alphabet, that fulfil a condition.
fn collect<'a>(names: &[&'a str], condition: impl Fn(&str) -> bool) -> Vec<&'a str> {
    let mut found: Vec<&str> = names.iter().copied().filter(|name| condition(name)).collect();
    found.sort_unstable();
    found.dedup();
    found.truncate(3);
    found
}

/// `ring.width`, `width_ring` → `[ring, width]`.
fn sorted_parts(name: &str) -> Vec<&str> {
    let mut parts: Vec<&str> = name.split(['.', '_']).filter(|part| !part.is_empty()).collect();
    parts.sort_unstable();
    parts
}

/// Names within the edit distance that rustc allows, nearest first.
fn near<'a>(lower: &str, names: &[&'a str]) -> Vec<&'a str> {
    let limit = lower.chars().count().max(3) / 3;
    let mut found: Vec<(usize, &str)> = names
        .iter()
        .filter_map(|name| Some((distance(lower, &name.to_lowercase(), limit)?, *name)))
        .collect();
    found.sort_unstable();
    found.dedup();
    found.truncate(3);
    found.into_iter().map(|(_, name)| name).collect()
}

/// Edits (insert, delete, replace, swap of neighbours) from `a` to `b`, if at most `limit`.
fn distance(a: &str, b: &str, limit: usize) -> Option<usize> {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    if a.len().abs_diff(b.len()) > limit {
        return None;
    }
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replaced = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = replaced.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(before[j - 2] + 1);
            }
            row.push(best);
        }
        before = std::mem::replace(&mut last, row);
    }
    last.last().copied().filter(|&edits| edits <= limit)
}

#[cfg(test)]
mod tests {
    use super::suggest;

    #[test]
    fn case_comes_before_spelling() {
        assert_eq!(suggest("Color", ["colour", "color"]), ["color"]);
    }

    #[test]
    fn words_may_be_permuted() {
        assert_eq!(suggest("width_ring", ["ring.width", "ring.depth"]), ["ring.width"]);
    }

    #[test]
    fn near_names_come_nearest_first_and_at_most_three() {
        assert_eq!(suggest("materail", ["material", "medium"]), ["material"]);
        assert_eq!(
            suggest("ceder_red", ["cedar", "cedar_red", "cedar_rod"]),
            ["cedar_red", "cedar_rod"]
        );
        assert_eq!(suggest("abc", ["abd", "abe", "abf", "abg"]), ["abd", "abe", "abf"]);
    }

    #[test]
    fn far_names_are_not_suggested() {
        assert!(suggest("x", ["roughness", "ior"]).is_empty());
        assert!(suggest("lens", ["from", "lens"]).is_empty());
    }
}
