//! `scene/bindings.wgsl`: the buffers, all of them arrays of 16-byte words, and a reader for each that
//! hides how many windows the section has.

use crate::features::Binding;
use pack::abi::Frame;
use std::fmt::Write as _;

/// Words of 16 bytes in one window: 128 MiB, the largest binding that every device offers.
pub const WINDOW_WORDS: u32 = 8_388_608;

/// The module for these bindings.
pub(crate) fn text(bindings: &[Binding]) -> String {
    let mut text = String::from("// Generated: the buffers, in words of 16 bytes.\n\n");
    for binding in bindings {
        let (number, name) = (binding.number, &binding.name);
        let kind = match number {
            0 => format!("var<uniform> {name}: array<vec4<u32>, {}u>", size_of::<Frame>() / 16),
            1 => format!("var<storage, read_write> {name}: array<vec4<u32>>"),
            _ => format!("var<storage, read> {name}: array<vec4<u32>>"),
        };
        let _ = writeln!(text, "@group(0) @binding({number}) {kind};");
    }
    for first in bindings.iter().filter(|binding| binding.window == 0 && binding.number >= 2) {
        text += &reader(first, bindings);
    }
    text
}

/// `fn node_word(i)`: word `i` of the section whose first window is `first`.
fn reader(first: &Binding, bindings: &[Binding]) -> String {
    let stem = first.name.trim_end_matches('s');
    let windows: Vec<&Binding> =
        bindings.iter().filter(|binding| binding.number % 8 == first.number).collect();
    let mut body = String::new();
    for (w, binding) in (0_u32..).zip(&windows) {
        let name = &binding.name;
        let begin = w * WINDOW_WORDS;
        let index = if w == 0 { "i".to_owned() } else { format!("i - {begin}u") };
        if w as usize + 1 == windows.len() {
            let _ = writeln!(body, "    return {name}[{index}];");
        } else {
            let end = begin + WINDOW_WORDS;
            let _ =
                writeln!(body, "    if (i < {end}u) {{\n        return {name}[{index}];\n    }}");
        }
    }
    format!("\n// Word `i` of the section.\nfn {stem}(i: u32) -> vec4<u32> {{\n{body}}}\n")
}
