//! Is the kernel in a pack our own? Then it may run without the checks that cost so much.
//!
//! A kernel is *known* when
//! - every declaration in it is, byte for byte, one that the linker of this build emits, and that it
//!   emits for scenes with the features of this pack: a function that switches over the kinds of
//!   lights is accepted only in the form that handles exactly the kinds this pack has;
//! - every reader of a section expects as many windows as the section has;
//! - `STACK_SIZE` is at least what the checks of the pack computed for its tree.
//!
//! Then the text is a selection of our declarations; if one that is used were missing, or were there
//! twice, it would not compile. So the code that runs is the code that was reviewed and tested here,
//! and the rules of a checked pack are the ones it relies on. Anything else is *unknown*, which is
//! no error: it runs with checks.

mod pieces;
mod relink;

use crate::setup::{Setup, window_bytes};

use pieces::pieces;
pub(crate) use relink::{AOV, FULL, RENDER, Wanted, is_same, relink};

/// When the linker emits a declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Condition {
    /// Whatever the scene.
    Any,
    /// For scenes whose feature bits under `mask` are `bits`.
    Features {
        /// The bits that matter.
        mask: u64,
        /// Their values.
        bits: u64,
    },
    /// For scenes where the section of this binding has `n` windows.
    Windows {
        /// Binding number of the first window.
        binding: u32,
        /// How many.
        n: u64,
    },
}

/// A declaration of the linker. The table is sorted by text; a text may occur several times.
struct Known {
    text: &'static str,
    condition: Condition,
}

/// A function that switches over the kinds of materials that a scene has, where there are several: its text
/// is `head`, the lines of the kinds in order, `foot`.
struct Switch {
    name: &'static str,
    head: &'static str,
    /// Feature bit and line of each kind.
    cases: &'static [(u64, &'static str)],
    foot: &'static str,
}

impl Switch {
    /// The text of this function for a scene with `features`.
    fn text(&self, features: u64) -> String {
        let lines = self.cases.iter().filter(|(bit, _)| features & bit != 0).map(|(_, line)| *line);
        std::iter::once(self.head).chain(lines).chain([self.foot]).collect()
    }

    /// Whether `text` is this function for a scene with `features`.
    fn is(&self, text: &str, features: u64) -> bool {
        let mut rest = text.strip_prefix(self.head);
        for (_, line) in self.cases.iter().filter(|(bit, _)| features & bit != 0) {
            rest = rest.and_then(|rest| rest.strip_prefix(line));
        }
        rest == Some(self.foot)
    }
}

include!(concat!(env!("OUT_DIR"), "/known.rs"));

/// The verdict about a kernel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Trust {
    /// Every line is ours, and made for such a pack.
    Known,
    /// The declaration at this line is not.
    Unknown {
        /// Line in the kernel, from 1.
        line: usize,
    },
}

/// Looks at every declaration of the kernel of `setup`.
pub(crate) fn judge(setup: &Setup<'_>) -> Trust {
    let pieces = match pieces(setup.kernel()) {
        Ok(pieces) => pieces,
        Err(line) => return Trust::Unknown { line },
    };
    let sections = windows(setup);
    let stack_need = setup.stack_need();
    for (line, text) in pieces {
        let fits = stack_size(text).is_some_and(|size| size >= stack_need.max(1));
        if !fits && !is_known(text, setup.features(), &sections) {
            return Trust::Unknown { line };
        }
    }
    Trust::Known
}

/// Binding of each section, and how many windows it has.
fn windows(setup: &Setup<'_>) -> Vec<(u32, u64)> {
    let buffers = setup.buffers();
    let windows = |(binding, bytes): &(u32, &[u8])| {
        (*binding, (bytes.len() as u64).div_ceil(window_bytes(*binding)))
    };
    buffers.iter().map(windows).collect()
}

impl Condition {
    /// Whether it holds for a scene with `features`, whose sections have so many windows.
    fn holds(self, features: u64, sections: &[(u32, u64)]) -> bool {
        match self {
            Self::Any => true,
            Self::Features { mask, bits } => features & mask == bits,
            Self::Windows { binding, n } => sections.contains(&(binding, n)),
        }
    }
}

fn is_known(text: &str, features: u64, sections: &[(u32, u64)]) -> bool {
    // Its size was looked at before.
    if stack_size(text).is_some() {
        return false;
    }
    if SWITCHES.iter().any(|switch| switch.is(text, features)) {
        return true;
    }
    let first = KNOWN.partition_point(|known| known.text < text);
    let same = KNOWN[first..].iter().take_while(|known| known.text == text);
    same.into_iter().any(|known| known.condition.holds(features, sections))
}

/// The number in `const STACK_SIZE: u32 = 0x12u;`, if that is the whole text.
fn stack_size(text: &str) -> Option<u32> {
    let digits = text.strip_prefix("const STACK_SIZE: u32 = 0x")?.strip_suffix("u;")?;
    // `from_str_radix` would also take a sign.
    let plain = digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    if plain { u32::from_str_radix(digits, 16).ok() } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_declaration_is_whole_and_the_table_is_sorted() {
        assert!(KNOWN.is_sorted_by_key(|known| known.text));
        assert!(KNOWN.iter().all(|known| known.text.ends_with([';', '}'])));
        assert!(KNOWN.iter().any(|known| known.text.contains("fn render(")));
    }

    #[test]
    fn variants_are_known_for_their_scenes_only() {
        let spheres = KNOWN.iter().find(|known| {
            known.text.contains("fn dispatch_light_sample") && !known.text.contains("switch")
        });
        let Some(Known { text, condition: Condition::Features { mask, bits } }) = spheres else {
            panic!("the light dispatch depends on features")
        };
        assert!(is_known(text, *bits, &[]));
        assert!(!is_known(text, bits ^ (mask & pack::features::LIGHT_SPHERE), &[]));
        let reader =
            KNOWN.iter().find(|known| matches!(known.condition, Condition::Windows { n: 2, .. }));
        let Some(Known { text, condition: Condition::Windows { binding, .. } }) = reader else {
            panic!("sections may have two windows")
        };
        assert!(is_known(text, 0, &[(*binding, 2)]));
        assert!(!is_known(text, 0, &[(*binding, 3)]));
    }

    #[test]
    fn a_changed_byte_is_noticed() {
        let text = KNOWN.iter().find(|known| known.text.contains("loop")).unwrap().text;
        let features = (0..1_u64 << 19).find(|features| is_known(text, *features, &[]));
        let features = features.expect("some scene has it");
        assert!(!is_known(&text.replacen("break", "continue", 1), features, &[]));
        assert!(!is_known(&text.replacen(' ', "  ", 1), features, &[]));
    }

    #[test]
    fn stack_sizes_are_plain_hexadecimal() {
        assert_eq!(stack_size("const STACK_SIZE: u32 = 0x60u;"), Some(96));
        assert_eq!(stack_size("const STACK_SIZE: u32 = 0x+6u;"), None);
        assert_eq!(stack_size("const STACK_SIZE: u32 = 0x6u; fn f() {}"), None);
        assert_eq!(stack_size("const STACK_SIZE: u32 = 0xfffffffffu;"), None);
    }

    #[test]
    fn odd_characters_end_the_search() {
        assert_eq!(pieces("// a\u{2028}fn f() {}\n"), Err(1));
        assert_eq!(pieces("const A: u32 = 1u;\n// b\rfn f() {}\n"), Err(2));
        let text = "// ---- a.wgsl\n// About f.\nfn f() {\n\n    g();\n}\n\nconst A: u32 = 1u;\n\n";
        let found = pieces(text).unwrap();
        assert_eq!(found, [(2, "// About f.\nfn f() {\n\n    g();\n}"), (8, "const A: u32 = 1u;")]);
    }
}
