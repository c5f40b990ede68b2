//! The modules keep the rules that a reader relies on.

use shaders::module_texts;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

#[test]
fn every_file_is_embedded() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("wgsl");
    let mut files = BTreeSet::new();
    let mut open: Vec<PathBuf> = vec![root.clone()];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).expect("the folder is readable") {
            let path = entry.expect("the entry is readable").path();
            if path.is_dir() {
                open.push(path);
            } else {
                let name = path.strip_prefix(&root).expect("below the root");
                let parts: Vec<_> = name.iter().map(|part| part.to_string_lossy()).collect();
                files.insert(parts.join("/"));
            }
        }
    }
    let embedded: BTreeSet<String> = module_texts().iter().map(|row| row.0.to_owned()).collect();
    assert_eq!(files, embedded);
}

#[test]
fn files_functions_and_lines_are_short() {
    for (name, text) in module_texts() {
        assert!(text.lines().count() <= 300, "{name} is too long");
        assert!(text.starts_with("// "), "{name} does not say what it is");
        let mut begin = None;
        for (i, line) in text.lines().enumerate() {
            assert!(line.chars().count() <= 120, "{name}:{}: the line is too long", i + 1);
            if line.starts_with("fn ") {
                begin = Some(i);
            }
            if line == "}" {
                let length = begin.take().map_or(0, |begin| i - begin);
                assert!(length <= 70, "{name}:{}: the function is too long", i + 1);
            }
        }
    }
}

#[test]
fn functions_are_named_after_their_file() {
    // Interfaces that any module of their kind offers, and the two entry points.
    let exceptions = ["render", "trace"];
    for (name, text) in module_texts() {
        let stem = name.rsplit('/').next().and_then(|file| file.strip_suffix(".wgsl"));
        let stem = stem.expect("modules end in .wgsl");
        for line in text.lines() {
            let Some(function) = line.strip_prefix("fn ").and_then(|rest| rest.split('(').next())
            else {
                continue;
            };
            let interface = name.starts_with("sampler/") && function.starts_with("sample_");
            let named = function.starts_with(stem) || exceptions.contains(&function) || interface;
            assert!(named, "{name}: `{function}` is not named after its file");
        }
    }
}

#[test]
fn functions_take_at_most_six_parameters_and_say_what_they_do() {
    for (name, text) in module_texts() {
        let lines: Vec<&str> = text.lines().collect();
        for (i, line) in lines.iter().enumerate() {
            let Some(rest) = line.strip_prefix("fn ") else { continue };
            let inside = rest.split_once('(').and_then(|(_, rest)| rest.rsplit_once(')'));
            let parameters = inside.map_or(0, |(list, _)| list.matches(':').count());
            assert!(parameters <= 6, "{name}:{}: too many parameters", i + 1);
            let public = !rest.starts_with("pcg_") && !rest.starts_with("render");
            let commented =
                i > 0 && (lines[i - 1].starts_with("//") || lines[i - 1].starts_with('@'));
            assert!(commented || !public, "{name}:{}: `{rest}` has no comment", i + 1);
        }
    }
}

/// Purposes that share a number would share their random numbers, and so would the last of one bounce and
/// the first of the next if there were more than the stride.
#[test]
fn every_purpose_has_its_own_number_below_the_stride() {
    let key = module_texts().iter().find(|row| row.0 == "sampler/key.wgsl").expect("it is there").1;
    let constants = key.lines().filter_map(|line| {
        let (name, value) = line.strip_prefix("const PURPOSE_")?.split_once(": u32 = ")?;
        Some((name, value.strip_suffix("u;")?.parse::<u32>().expect("a plain number")))
    });
    let (stride, purposes): (Vec<_>, Vec<_>) = constants.partition(|row| row.0 == "STRIDE");
    let numbers: BTreeSet<u32> = purposes.iter().map(|row| row.1).collect();
    assert!(purposes.len() >= 8 && numbers.len() == purposes.len(), "{purposes:?}");
    assert!(numbers.iter().all(|number| *number < stride[0].1), "{purposes:?}");
}
