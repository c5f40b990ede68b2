//! Mesh files whose materials are replaced, and parts left out: an instance of one becomes several, each of parts that
//! look alike. All that is checked of an instance with a material then holds for them.

use std::collections::BTreeMap;

use lang::diagnostic::{Code, Diagnostic, Fix};
use lang::scene::{EditOf, Instance, MeshEdit, Parts, Scene, Shape};
use lang::source::Span;

use crate::import::MeshFacts;

/// Longest list of names in a message.
const MOST_NAMES: usize = 12;

/// The scene without changes of mesh files; `None` where there are none. Patterns that name nothing go to
/// `diagnostics`.
pub fn edited(
    scene: &Scene,
    assets: &[MeshFacts],
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Scene> {
    if scene.instances.iter().all(|instance| instance.edits.is_empty()) {
        return None;
    }
    let mut cutter = Cutter { scene, assets, told: BTreeMap::new() };
    let instances = scene.instances.iter().flat_map(|instance| cutter.cut(instance)).collect();
    diagnostics.extend(cutter.told.into_values());
    Some(Scene { instances, ..scene.clone() })
}

struct Cutter<'a> {
    scene: &'a Scene,
    assets: &'a [MeshFacts],
    /// Patterns that name nothing, each once, by where they stand.
    told: BTreeMap<(u32, u32), Diagnostic>,
}

impl Cutter<'_> {
    /// The instances that an instance becomes, in the order of their first parts.
    fn cut(&mut self, instance: &Instance) -> Vec<Instance> {
        let (Shape::Mesh { asset, parts }, false) = (&instance.shape, instance.edits.is_empty())
        else {
            return vec![instance.clone()];
        };
        let Some(file) = self.assets.get(*asset) else { return vec![instance.clone()] };
        let shown = file.chosen(parts);
        let mut last: Vec<Option<&MeshEdit<usize>>> = vec![None; shown.len()];
        for edit in &instance.edits {
            let found = matching(edit, file, &shown);
            if found.is_empty() {
                let at = (edit.pattern_span.file.0, edit.pattern_span.start);
                let (scene, asset) = (self.scene, *asset);
                self.told.entry(at).or_insert_with(|| unknown(scene, asset, edit, file, &shown));
            }
            for place in found {
                last[place] = Some(edit);
            }
        }
        let mut looks: Vec<(Look, Vec<usize>)> = Vec::new();
        for (part, edit) in shown.into_iter().zip(last) {
            let look = match edit {
                None => (instance.material, instance.material_span),
                Some(edit) if edit.material.is_some() => (edit.material, Some(edit.material_span)),
                Some(_) => continue,
            };
            match looks.iter_mut().find(|(known, _)| *known == look) {
                Some((_, list)) => list.push(part),
                None => looks.push((look, vec![part])),
            }
        }
        let of_look = |((material, material_span), list): (Look, Vec<usize>)| Instance {
            shape: Shape::Mesh { asset: *asset, parts: Parts::Listed(list) },
            material,
            material_span,
            edits: Vec::new(),
            ..instance.clone()
        };
        looks.into_iter().map(of_look).collect()
    }
}

/// Material, and where it is named.
type Look = (Option<usize>, Option<Span>);

/// Places in `shown` of the parts that a change holds for. Upper and lower case differ, unless nothing is found.
fn matching(edit: &MeshEdit<usize>, file: &MeshFacts, shown: &[usize]) -> Vec<usize> {
    let find = |same: &dyn Fn(&str) -> bool| -> Vec<usize> {
        let fits = |part: &usize| names(edit.of, file, *part).into_iter().any(same);
        (0..).zip(shown).filter(|(_, part)| fits(part)).map(|(place, _)| place).collect()
    };
    let exact = find(&|name| fits(&edit.pattern, name));
    if !exact.is_empty() {
        return exact;
    }
    let pattern = edit.pattern.to_lowercase();
    find(&|name| fits(&pattern, &name.to_lowercase()))
}

/// What a part of a file is called, or its material.
fn names(of: EditOf, file: &MeshFacts, part: usize) -> Vec<&str> {
    let part = &file.parts[part];
    match of {
        EditOf::Material => {
            let material = part.material.and_then(|material| file.materials.get(material as usize));
            material.map(|material| material.name.as_str()).into_iter().collect()
        }
        EditOf::Part => {
            std::iter::once(&part.name).chain(&part.aliases).map(String::as_str).collect()
        }
    }
}

/// Whether a name is of a pattern: `*` stands for any letters, `?` for one.
fn fits(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) =
        (pattern.chars().collect(), name.chars().collect());
    let (mut p, mut n) = (0, 0);
    // The last `*`, and where what it stands for ends; more of the name is tried only for that one.
    let mut star = None;
    while n < name.len() {
        match pattern.get(p) {
            Some('*') => {
                star = Some((p, n));
                p += 1;
            }
            Some(c) if *c == '?' || *c == name[n] => (p, n) = (p + 1, n + 1),
            _ => {
                let Some((at, end)) = star else { return false };
                star = Some((at, end + 1));
                (p, n) = (at + 1, end + 1);
            }
        }
    }
    pattern[p..].iter().all(|c| *c == '*')
}

/// A pattern that names nothing, with what there is.
fn unknown(
    scene: &Scene,
    asset: usize,
    edit: &MeshEdit<usize>,
    file: &MeshFacts,
    shown: &[usize],
) -> Diagnostic {
    let known = shown
        .iter()
        .flat_map(|part| names(edit.of, file, *part))
        .filter(|name| !name.is_empty())
        .collect();
    let (what, asset) = (edit.of.word(), &scene.assets[asset]);
    let text = format!("`{}` shows no {what} named `{}`", asset.name.text, edit.pattern);
    let error = Diagnostic::error(Code("E0521"), text)
        .at(edit.pattern_span, "not in the file")
        .because(asset.path_span, "the file");
    let letters: String = edit.pattern.chars().filter(|c| !matches!(c, '*' | '?')).collect();
    listed(error, (what, &letters, edit.pattern_span), known)
}

/// Adds to the report of an unknown name the similar one that `known` has, or all that there are; `what` is named, with
/// these `letters`, `at` a text in quotes.
pub(super) fn listed(
    error: Diagnostic,
    (what, letters, at): (&str, &str, Span),
    mut known: Vec<&str>,
) -> Diagnostic {
    known.sort_unstable();
    known.dedup();
    if let [similar, ..] = lang::suggest::suggest(letters, known.iter().copied()).as_slice()
        && !similar.contains(['"', '\n'])
    {
        let message = format!("a {what} with a similar name exists: `{similar}`");
        return error.with_fix(Fix::guess(message, at, format!("\"{similar}\"")));
    }
    error.with_note(match known.len() {
        0 => format!("it names no {what}"),
        n if n <= MOST_NAMES => format!("there are: {}", known.join(", ")),
        n => format!("there are: {}, and {} more", known[..MOST_NAMES].join(", "), n - MOST_NAMES),
    })
}

#[cfg(test)]
mod tests {
    use super::fits;

    #[test]
    fn stars_stand_for_any_letters_and_question_marks_for_one() {
        let yes = [
            ("paint", "paint"),
            ("*", ""),
            ("*", "any"),
            ("paint*", "paint.001"),
            ("*.001", "paint.001"),
            ("w*l*", "wheel.left"),
            ("*ab*ab", "abaab.ab"),
            ("wheel.?", "wheel.1"),
            ("é?", "éà"),
            ("", ""),
        ];
        let no = [
            ("paint", "paint.001"),
            ("*.001", "paint.002"),
            ("wheel.?", "wheel."),
            ("", "a"),
            ("a*b", "a"),
        ];
        for (pattern, name) in yes {
            assert!(fits(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in no {
            assert!(!fits(pattern, name), "{pattern} {name}");
        }
    }
}
