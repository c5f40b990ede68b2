//! Broken scenes: 10^5 mutations of right ones are checked without a panic and without a hang.

mod common;

use common::check_text;

/// Short scenes that together use every rule.
const SEEDS: [&str; 10] = [
    "rts 1\nlet a = 2m\nmaterial m: diffuse { color = srgb(#c79a6b) }\ninstance s { shape = sphere(radius: a), material = m }\n",
    "rts 1\nparam h: time = 6h in 5h..9h\nlet e = 15deg * (h - 6h) / 1h + 2.5deg\nassert e > 0deg, \"up\"\n",
    "rts 1\nmaterial a: metal { color = linear(0.9), fuzz = 30% }\nmaterial b like a { fuzz = default }\n",
    "rts 1\ninstance s[i in 0..6] { shape = box(size: (1, 1, 1)m), material = m, at = (0m, 1m, -1m * i) }\n",
    "rts 1\ntexture t = image(\"t.png\", space: srgb)\nmaterial p: principled { color = t.rgb, alpha = t.a }\n",
    "rts 1\nobject o { shape = [a, b], rotate = (0, 90, 0)deg }\nobject a { shape = rock.lid }\nasset rock = obj(\"r\", unit: cm)\n",
    "rts 1\ncamera c: perspective { from = (0, 1, 5)m, to = (0, 1, 0)m, focus = distance(c.from, c.to) }\nrender r: path { }\n",
    "rts 1\nlight l: sphere { center = polar(azimuth: 1deg, elevation: 2deg, distance: 3m), radius = 1m, power = 3 }\n",
    "rts 1\nsky s: gradient { sun.direction = (0, 1, 0), zenith = blackbody(4300K) * 2 }\nfilm f { size = (4, 4)px }\n",
    "rts 1\nimport \"x.rts\" as x\nlet a = if x.y < 3m then -1 else pow(2, 3) / 0\nlet b = [1: 2, 3]\nlet c = a.x..b\n",
];

/// Pieces that are put in.
const PIECES: [&str; 36] = [
    "(",
    ")",
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "=",
    ".",
    "..",
    "-",
    "*",
    "/",
    "<",
    "m",
    "deg",
    "%",
    "0",
    "1e300",
    "-1",
    " like ",
    " none ",
    " default ",
    "if ",
    " then ",
    " else ",
    "\"",
    "#ffffff",
    "+x",
    "\n",
    "a",
    "s",
    "let a = b\n",
    "let b = a\n",
    "pub ",
];

struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % n.max(1)
    }
}

fn mutate(text: &str, random: &mut Random) -> String {
    let mut chars: Vec<char> = text.chars().collect();
    for _ in 0..=random.below(3) {
        let at = random.below(chars.len());
        match random.below(5) {
            0 => {
                let end = (at + 1 + random.below(4)).min(chars.len());
                chars.drain(at..end);
            }
            1 => {
                let from = random.below(chars.len());
                let end = (from + 1 + random.below(20)).min(chars.len());
                let piece: Vec<char> = chars[from..end].to_vec();
                chars.splice(at..at, piece);
            }
            _ => {
                let piece = PIECES[random.below(PIECES.len())];
                let end = (at + random.below(3)).min(chars.len());
                chars.splice(at..end, piece.chars());
            }
        }
    }
    chars.into_iter().collect()
}

#[test]
fn mutated_scenes_are_checked_without_a_panic() {
    let mut random = Random(20_260_412);
    let (mut n_errors, mut n_codes) = (0, std::collections::BTreeSet::new());
    for i in 0..100_000 {
        let text = mutate(SEEDS[i % SEEDS.len()], &mut random);
        let analysis = check_text(&text);
        n_errors += usize::from(analysis.scene.is_none());
        for diagnostic in &analysis.diagnostics {
            n_codes.insert(diagnostic.code.0);
            for label in &diagnostic.labels {
                let (start, end) = (label.span.start as usize, label.span.end as usize);
                let source = analysis.sources.text(label.span.file);
                assert!(source.get(start..end).is_some(), "a label outside the text of\n{text}");
            }
        }
    }
    assert!(n_errors > 90_000 && n_codes.len() > 30, "{n_errors} scenes with errors, {n_codes:?}");
}

#[test]
fn finite_numbers_only() {
    let mut random = Random(7);
    let numbers = ["0", "1e-300", "1e300", "1e15", "-1e15", "1e14", "0.5", "-1", "1e7", "3"];
    for _ in 0..3_000 {
        let mut n = || numbers[random.below(numbers.len())];
        let text = format!(
            "rts 1\nlet a = {} * {}\nmaterial m: emissive {{ color = linear({}), strength = {} }}\n\
             instance s {{ shape = sphere(radius: {}m), material = m, at = ({}, {}, {})m, scale = {} }}\n\
             light l: sphere {{ center = (0, 0, 0)m, radius = {}m, power = {} }}\n\
             camera c: perspective {{ from = ({}, {}, 1)m, to = (0, 0, {})m, lens = {}m, f_stop = {} }}\n\
             render r: path {{ }}\n",
            n(),
            n(),
            n(),
            n(),
            n(),
            n(),
            n(),
            n(),
            n(),
            n(),
            n(),
            n(),
            n(),
            n(),
            n(),
            n()
        );
        if let Some(scene) = check_text(&text).scene {
            let shown = lang::resolved(&scene);
            assert!(!shown.contains("NaN") && !shown.contains("inf"), "{shown}");
        }
    }
}
