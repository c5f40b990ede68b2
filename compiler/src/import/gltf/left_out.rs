//! Which extensions of a file are left out, and how many of its parts have them.
//!
//! The JSON text is gone through once more, because the parser keeps only what it knows. Extensions that are declared and
//! that nothing has are not worth a word.

use super::super::error::excerpt;
use super::super::report::ImportReport;
use super::document::Document;
use crate::counted::counted;
use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Lists of a document whose elements are worth a word, with the word for one of them.
const LISTS: [(&str, &str); 8] = [
    ("materials", "material"),
    ("meshes", "mesh"),
    ("nodes", "node"),
    ("textures", "texture"),
    ("images", "image"),
    ("animations", "animation"),
    ("skins", "skin"),
    ("scenes", "scene"),
];

/// Names of extensions, and where each is: a list and an index of [`LISTS`], or nowhere in particular.
type Found = BTreeMap<String, BTreeSet<Option<(usize, usize)>>>;

/// Warns about each extension that is there and is none of `supported`.
pub(super) fn warn(
    json: &[u8],
    document: &Document<'_>,
    supported: &[&str],
    report: &mut ImportReport,
) {
    let declared = &document.root.extensions_used;
    if declared.iter().all(|name| supported.contains(&name.as_str())) {
        return;
    }
    let mut found = Found::new();
    let mut text = serde_json::Deserializer::from_slice(json);
    // It has been parsed before.
    let _ = Walk { found: &mut found, depth: 0, list: None, element: None }.deserialize(&mut text);
    for (name, places) in &found {
        if supported.contains(&name.as_str()) {
            continue;
        }
        let name = excerpt(name.as_bytes());
        report.warn(document.file, format!("{name} is left out{}", of_things(places)));
    }
}

/// ` of 2 materials and 1 node`, or nothing if it is in none of the lists.
fn of_things(places: &BTreeSet<Option<(usize, usize)>>) -> String {
    let count = |list| places.iter().flatten().filter(|(own, _)| *own == list).count();
    let counts = LISTS.iter().enumerate().map(|(list, (all, one))| match count(list) {
        0 => None,
        n => Some(counted(n, one, all)),
    });
    let counts: Vec<String> = counts.flatten().collect();
    if counts.is_empty() { String::new() } else { format!(" of {}", counts.join(" and ")) }
}

/// Goes through a value.
struct Walk<'a> {
    found: &'a mut Found,
    /// 0 for the document, 1 for its lists, 2 for their elements, 3 for all inside of them.
    depth: usize,
    list: Option<usize>,
    element: Option<usize>,
}

impl Walk<'_> {
    fn inner(&mut self) -> Walk<'_> {
        let Walk { found, depth, list, element } = self;
        Walk { found, depth: (*depth + 1).min(3), list: *list, element: *element }
    }
}

impl<'de> DeserializeSeed<'de> for Walk<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        from.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Walk<'_> {
    type Value = ();

    fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.write_str("any value")
    }

    fn visit_bool<E>(self, _: bool) -> Result<(), E> {
        Ok(())
    }

    fn visit_i64<E>(self, _: i64) -> Result<(), E> {
        Ok(())
    }

    fn visit_u64<E>(self, _: u64) -> Result<(), E> {
        Ok(())
    }

    fn visit_f64<E>(self, _: f64) -> Result<(), E> {
        Ok(())
    }

    fn visit_str<E>(self, _: &str) -> Result<(), E> {
        Ok(())
    }

    fn visit_unit<E>(self) -> Result<(), E> {
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(mut self, mut from: A) -> Result<(), A::Error> {
        for index in 0.. {
            let mut inner = self.inner();
            if inner.depth == 2 {
                inner.element = Some(index);
            }
            if from.next_element_seed(inner)?.is_none() {
                break;
            }
        }
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut from: A) -> Result<(), A::Error> {
        while let Some(key) = from.next_key::<String>()? {
            match key.as_str() {
                "extensions" => from.next_value_seed(Names(self.inner()))?,
                "extras" => from.next_value::<IgnoredAny>().map(drop)?,
                key => {
                    let mut inner = self.inner();
                    if inner.depth == 1 {
                        inner.list = LISTS.iter().position(|(list, _)| *list == key);
                    }
                    from.next_value_seed(inner)?;
                }
            }
        }
        Ok(())
    }
}

/// Notes the names of the extensions that an object has.
struct Names<'a>(Walk<'a>);

impl<'de> DeserializeSeed<'de> for Names<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        from.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Names<'_> {
    type Value = ();

    fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.write_str("extensions")
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut from: A) -> Result<(), A::Error> {
        while let Some(name) = from.next_key::<String>()? {
            let place = self.0.list.zip(self.0.element);
            self.0.found.entry(name).or_default().insert(place);
            // Extensions have extensions: textures that are placed, say.
            from.next_value_seed(self.0.inner())?;
        }
        Ok(())
    }
}
