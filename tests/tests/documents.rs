//! The pages: links lead somewhere, the index lists every page, and what they show is true.

use std::path::{Path, PathBuf};

use lang::source::{LoadError, Loader};
use scenes::catalog::EXAMPLES;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Every page of the top folder and of `docs`, relative to the root.
fn pages() -> Vec<String> {
    let mut pages = Vec::new();
    for folder in ["", "docs/"] {
        for entry in std::fs::read_dir(root().join(folder)).expect("the folder is readable") {
            let name = entry.expect("readable").file_name().to_string_lossy().into_owned();
            if Path::new(&name).extension().is_some_and(|extension| extension == "md") {
                pages.push(format!("{folder}{name}"));
            }
        }
    }
    assert!(pages.len() > 10, "{pages:?}");
    pages
}

/// Targets of the links of a page, as they are written.
fn links(text: &str) -> impl Iterator<Item = &str> {
    text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(target, _)| target)
}

#[test]
fn links_between_pages_lead_to_files() {
    for page in pages() {
        let text = read(&page);
        let folder = root().join(&page).parent().expect("a page is in a folder").to_owned();
        for link in links(&text).filter(|link| !link.contains("://")) {
            let file = link.split('#').next().unwrap_or_default();
            assert!(folder.join(file).exists(), "{page} links to `{link}`, which is not there");
        }
    }
}

#[test]
fn the_index_lists_every_page() {
    let index = read("docs/README.md");
    for page in pages() {
        let link = page.strip_prefix("docs/").map_or(format!("../{page}"), str::to_owned);
        let is_start = link == "README.md" || link == "../README.md";
        assert!(is_start || index.contains(&format!("]({link})")), "{link} is not in the index");
    }
}

#[test]
fn every_example_has_a_page_and_a_row_in_the_guide() {
    let guide = read("docs/guide.md");
    for example in EXAMPLES {
        let page = root().join("scenes").join(example.name).join("README.md");
        assert!(page.is_file(), "{} is missing", page.display());
        assert!(guide.contains(&format!("`{}`", example.name)), "{} is not named", example.name);
    }
}

/// A scene that imports nothing.
struct Alone;

impl Loader for Alone {
    fn load(&mut self, _: &str, _: &str) -> Result<(String, String), LoadError> {
        Err(LoadError::NotFound)
    }
}

#[test]
fn the_scene_of_the_readme_has_no_fault() {
    let readme = read("README.md");
    let (_, rest) = readme.split_once("```rts\n").expect("it shows a scene");
    let (scene, _) = rest.split_once("```").expect("the scene ends");
    let analysis = lang::analyze("scene.rts", scene, &mut Alone, &lang::Options::default());
    assert!(analysis.diagnostics.is_empty(), "{:?}", analysis.diagnostics);
    assert!(analysis.scene.is_some());
}
