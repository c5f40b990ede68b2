//! Feature sets become the declarations that the linker emits for them.
//!
//! There are more than a thousand kernels of some hundreds of declarations each, nearly all of them the same: each text
//! is kept once, and known by its number.

use crate::pieces::{name_of, pieces};
use shaders::{FeatureSet, Linked};
use std::collections::BTreeMap;
use std::error::Error;

/// Members of a family that have the same kernel.
pub(crate) struct Group {
    /// Index of the family.
    pub(crate) family: usize,
    /// The feature bits of each.
    pub(crate) bits: Vec<u64>,
}

/// The texts of one declaration, each with the groups whose kernels have it.
pub(crate) type Texts<'e> = BTreeMap<&'e str, Vec<&'e Group>>;

/// A declaration that is in some kernel.
struct Declaration {
    name: String,
    text: String,
    /// Numbers of the groups whose kernels have it.
    groups: Vec<usize>,
}

/// The declarations of all kernels.
#[derive(Default)]
pub(crate) struct Emitted {
    groups: Vec<Group>,
    declarations: Vec<Declaration>,
    /// Numbers of the declarations that a text of the linker is cut into.
    numbers: BTreeMap<String, Vec<usize>>,
}

impl Emitted {
    /// Adds the kernel that members `alike` of family `family` have.
    pub(crate) fn add(
        &mut self,
        family: usize,
        alike: &[(u64, FeatureSet)],
    ) -> Result<(), Box<dyn Error>> {
        let Some((_, features)) = alike.first() else { return Ok(()) };
        let group = self.groups.len();
        self.groups.push(Group { family, bits: alike.iter().map(|member| member.0).collect() });
        for text in linked(features)?.declarations() {
            if !self.numbers.contains_key(text) {
                let first = self.declarations.len();
                self.declarations.extend(cut(text)?.into_iter().map(|(name, text)| Declaration {
                    name,
                    text,
                    groups: Vec::new(),
                }));
                self.numbers.insert(text.to_owned(), (first..self.declarations.len()).collect());
            }
            for number in &self.numbers[text] {
                self.declarations[*number].groups.push(group);
            }
        }
        Ok(())
    }

    /// The texts of each declaration, by its name.
    pub(crate) fn by_name(&self) -> BTreeMap<&str, Texts<'_>> {
        let mut found: BTreeMap<&str, Texts<'_>> = BTreeMap::new();
        for Declaration { name, text, groups } in &self.declarations {
            let all = found.entry(name).or_default().entry(text).or_default();
            all.extend(groups.iter().map(|group| &self.groups[*group]));
        }
        found
    }
}

/// Name and text of every declaration of a kernel.
pub(crate) fn declarations_of(
    features: &FeatureSet,
) -> Result<Vec<(String, String)>, Box<dyn Error>> {
    cut(&linked(features)?.text)
}

fn linked(features: &FeatureSet) -> Result<Linked, Box<dyn Error>> {
    // Layers are of scenes with geometry.
    let more: &[_] = if features.geometry() { &[shaders::AOV] } else { &[] };
    Ok(shaders::link_with(features, more)?)
}

/// Name and text of every declaration in `text`. Those of a kernel are cut alone as they are together: blank lines are
/// between them.
fn cut(text: &str) -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let pieces = pieces(text).map_err(|line| format!("line {line} is not plain text"))?;
    pieces
        .into_iter()
        .map(|(_, text)| {
            Ok((name_of(text).ok_or("a declaration without a name")?.to_owned(), text.to_owned()))
        })
        .collect()
}
