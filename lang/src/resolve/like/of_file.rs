//! `like car.material("paint")`, `like car.camera("Camera")`: what a declaration takes from a mesh file.
//!
//! Whether the file has it is known when the file is read, which is the compiler's business.

use super::{Bases, Direct};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::resolve::ItemId;
use crate::resolve::model::InFile;
use crate::schema::{self, Kind};
use crate::syntax::{OfFile, Path};

/// What of a mesh file declarations can be like, and the type that they then have. Whether a camera of a file is
/// orthographic is not known here.
const IN_FILES: [(Kind, &str); 2] = [(Kind::Material, "principled"), (Kind::Camera, "perspective")];

impl Bases<'_> {
    pub(super) fn of_file(&mut self, id: ItemId, kind: Kind, base: &OfFile) -> Direct {
        let [asset @ .., word] = base.path.segments.as_slice() else { return Direct::Unknown };
        let Some(schema) = type_of(kind).filter(|_| word.text == kind.name()) else {
            self.diagnostics.push(not_in_files(kind, base));
            return Direct::Unknown;
        };
        let (Some(first), Some(last)) = (asset.first(), asset.last()) else {
            let word = kind.name();
            let text = format!("which file is this {word} of?");
            let error = Diagnostic::error(Code("E0203"), text)
                .at(base.path.span, "no asset")
                .with_help(format!("name the asset: `car.{word}(\"{}\")`", base.name.text));
            self.diagnostics.push(error);
            return Direct::Unknown;
        };
        let path = Path { segments: asset.to_vec(), span: first.span.to(last.span) };
        match self.named(id, &path, Kind::Asset) {
            Some(asset) => {
                let (name, span) = (base.name.text.clone(), base.name.span);
                Direct::OfFile(schema, InFile { asset, name, span })
            }
            None => Direct::Unknown,
        }
    }
}

/// The type of declarations of this kind that are like something of a file.
fn type_of(kind: Kind) -> Option<&'static schema::TypeSchema> {
    let (_, name) = IN_FILES.into_iter().find(|(known, _)| *known == kind)?;
    schema::find_type(kind, name)
}

/// A declaration cannot be like that of a file.
fn not_in_files(kind: Kind, base: &OfFile) -> Diagnostic {
    let word = base.path.segments.last().expect("a path has a word");
    let own = kind.name();
    let known = IN_FILES.iter().any(|(known, _)| *known == kind);
    let other = IN_FILES.iter().find(|(known, _)| known.name() == word.text);
    match (known, other) {
        (true, Some((other, _))) => {
            let text = format!("{} cannot be like {}", kind.with_article(), other.with_article());
            Diagnostic::error(Code("E0203"), text)
                .at(base.span, format!("{} of a file", other.with_article()))
        }
        (true, None) => {
            let text = format!("a file has no `.{}(...)`", word.text);
            Diagnostic::error(Code("E0203"), text)
                .at(word.span, format!("{} is due here", kind.with_article()))
                .with_fix(Fix::guess(format!("write `.{own}`"), word.span, own))
        }
        (false, _) => {
            let text = format!("{} cannot be like something of a file", kind.with_article());
            let error = Diagnostic::error(Code("E0203"), text)
                .at(base.span, "only materials and cameras can");
            match kind {
                Kind::Light => error.with_help(
                    "`rtc show --assets` prints the lights of files as declarations to paste",
                ),
                _ => error,
            }
        }
    }
}
