//! Pages about codes: errors and lints.

/// Pages as Markdown; each starts with a line `# CODE: title`.
const PAGES: [&str; 6] = [
    include_str!("syntax.md"),
    include_str!("names.md"),
    include_str!("types.md"),
    include_str!("values.md"),
    include_str!("view.md"),
    include_str!("files.md"),
];

/// Every code that has a page, in order of the pages.
pub fn codes() -> impl Iterator<Item = &'static str> {
    pages().map(|(code, _)| code)
}

/// `(code, page)` of every page.
fn pages() -> impl Iterator<Item = (&'static str, &'static str)> {
    PAGES.iter().flat_map(|file| file.split("\n# ")).map(|page| {
        let page = page.trim_start_matches("# ");
        (page.split(':').next().unwrap_or(page), page)
    })
}

/// The page about a code or a lint.
pub(crate) fn code_page(name: &str) -> Option<String> {
    let lint = format!("(`{name}`)");
    let is_it = |(code, page): &(&str, &str)| {
        code.eq_ignore_ascii_case(name)
            || page.lines().next().is_some_and(|title| title.ends_with(&lint))
    };
    pages().find(is_it).map(|(_, page)| format!("# {}\n", page.trim_end()))
}
