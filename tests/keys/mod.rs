//! Keys of JSON objects, against those that `docs/json.md` lists. Tests of both programs include this file.

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::Value;

/// Whether `objects`, taken together, have the keys that the page lists for `schema`: all of them, and no other.
pub(crate) fn check(schema: &str, objects: &[Value]) {
    let documented = documented(schema);
    let mut found = BTreeSet::new();
    for object in objects {
        assert_eq!(object["schema"], schema, "{object}");
        gather(object, "", &mut found);
    }
    assert_eq!(found, documented, "left: keys of {schema}, right: those of docs/json.md");
}

/// Rows of the section of the page.
fn documented(schema: &str) -> BTreeSet<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/json.md");
    let page = std::fs::read_to_string(path).expect("the page is there");
    let section = page.split("\n## ").find(|section| section.lines().next() == Some(schema));
    let section = section.unwrap_or_else(|| panic!("docs/json.md has no section {schema}"));
    let key = |line: &str| Some(line.strip_prefix("| `")?.split_once('`')?.0.to_owned());
    section.lines().filter_map(key).collect()
}

/// Adds the keys of a value, as the page writes them. An object with a schema of its own is left to that.
fn gather(value: &Value, prefix: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(object) if prefix.is_empty() || !object.contains_key("schema") => {
            for (key, value) in object {
                let dot = if prefix.is_empty() { "" } else { "." };
                let path = format!("{prefix}{dot}{key}");
                gather(value, &path, found);
                found.insert(path);
            }
        }
        Value::Array(list) => {
            for value in list {
                gather(value, &format!("{prefix}[]"), found);
            }
        }
        _ => {}
    }
}
