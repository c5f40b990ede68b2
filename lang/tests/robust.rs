//! No text makes the parser or the formatter panic, hang or point outside the text.

use std::time::{Duration, Instant};

use lang::diagnostic::Diagnostic;
use lang::format::format_file;
use lang::parse::parse;
use lang::source::{LoadError, Loader, SourceSet, Span};

/// Random numbers with a fixed seed: xorshift64*, Vigna 2016, ACM TOMS 42(4).
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 32;
        usize::try_from(bits).expect("32 bits") % n.max(1)
    }
}

/// What a text might be made worse with.
const SCRAPS: [&str; 44] = [
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    "\"",
    "//",
    "///",
    "\n",
    "\r\n",
    "\r",
    "\t",
    "\0",
    "\u{feff}",
    "é",
    "–",
    "=",
    "==",
    ",",
    ":",
    ".",
    "..",
    "...",
    "+",
    "-",
    "*",
    "/",
    "%",
    "#",
    "1",
    ".5",
    "1e999",
    "m/s",
    "if ",
    " then ",
    " else ",
    "like",
    "rts 1",
    "material a: b {",
    "let a = ",
    "none",
    "\u{a0}",
    "<",
];

fn mutate(random: &mut Random, text: &str) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len() + 1);
        let end = (at + random.below(12)).min(bytes.len());
        match random.below(8) {
            0 if at < bytes.len() => bytes[at] = u8::try_from(random.below(256)).expect("a byte"),
            1 => drop(bytes.drain(at..end)),
            2 => drop(bytes.splice(at..at, bytes[at..end].to_vec())),
            3 => lines(random, &mut bytes),
            4 => bytes.truncate(at),
            _ => {
                let scrap = SCRAPS[random.below(SCRAPS.len())];
                bytes.splice(at..at, scrap.bytes());
            }
        }
    }
    bytes
}

/// Swaps two lines, or repeats one.
fn lines(random: &mut Random, bytes: &mut Vec<u8>) {
    let mut lines: Vec<Vec<u8>> =
        bytes.split_inclusive(|&b| b == b'\n').map(<[u8]>::to_vec).collect();
    if lines.is_empty() {
        return;
    }
    let (a, b) = (random.below(lines.len()), random.below(lines.len()));
    if random.below(2) == 0 {
        lines.swap(a, b);
    } else {
        lines.insert(a, lines[b].clone());
    }
    *bytes = lines.concat();
}

fn check_span(sources: &SourceSet, span: Span) {
    let text = sources.text(span.file);
    assert!(text.get(span.start as usize..span.end as usize).is_some(), "{span:?} in {text:?}");
}

fn check_diagnostics(sources: &SourceSet, diagnostics: &[Diagnostic]) {
    for diagnostic in diagnostics {
        assert!(diagnostic.span().is_some(), "no place: {diagnostic:?}");
        diagnostic.labels.iter().for_each(|label| check_span(sources, label.span));
        for edit in diagnostic.fixes.iter().flat_map(|fix| &fix.edits) {
            check_span(sources, edit.span);
        }
        let _ = lang::diagnostic::short(sources, diagnostic);
    }
}

/// Reads and formats bytes, and returns how many faults they have.
fn check(bytes: &[u8]) -> usize {
    let mut sources = SourceSet::new();
    let file = sources.add("a.rts", String::from_utf8_lossy(bytes));
    let (tree, diagnostics) = parse(&sources, file);
    check_diagnostics(&sources, &diagnostics);
    tree.items.iter().for_each(|item| check_span(&sources, item.span));
    if diagnostics.is_empty() {
        let once = format_file(&sources, file).expect("a text without faults has a layout");
        let twice = lang::format::format(&once).expect("a layout can be formatted");
        assert_eq!(once, twice);
    }
    diagnostics.len()
}

/// Short scenes: the cases of the other tests, and pieces of the example.
fn seeds() -> Vec<String> {
    let mut seeds: Vec<String> = Vec::new();
    for file in [include_str!("syntax/faults.rts"), include_str!("syntax/layout.txt")] {
        seeds.extend(file.split("--- ").filter_map(|case| {
            let (_, body) = case.split_once('\n')?;
            let lines = body.lines().filter(|line| !line.starts_with("//") && *line != ">>>");
            Some(lines.collect::<Vec<_>>().join("\n"))
        }));
    }
    let lines: Vec<&str> = include_str!("syntax/shrine.rts").lines().collect();
    seeds.extend(lines.chunks(9).map(|lines| format!("rts 1\n{}\n", lines.join("\n"))));
    seeds
}

#[test]
fn a_hundred_thousand_damaged_texts_are_survived() {
    let mut random = Random(20_260_412);
    let seeds = seeds();
    let whole = include_str!("syntax/shrine.rts");
    let (mut n_bad, mut slowest) = (0, Duration::ZERO);
    for i in 0..100_000 {
        let seed = if i % 100 == 0 { whole } else { &seeds[random.below(seeds.len())] };
        let bytes = mutate(&mut random, seed);
        let before = Instant::now();
        n_bad += usize::from(check(&bytes) > 0);
        slowest = slowest.max(before.elapsed());
    }
    assert!(n_bad > 50_000, "the damage does no harm: {n_bad}");
    assert!(slowest < Duration::from_secs(5), "one text took {slowest:?}");
}

#[test]
fn monstrous_texts_take_little_time() {
    let start = Instant::now();
    let n = 30_000;
    let repeated = [
        "(", "[", "{", "(]", ")", "-", "1+", "if ", "f(", "a.", "\"", "//\n", "}\n", "[(", "{\n",
        "/", "..", "a b ", "\n", ",",
    ];
    for scrap in repeated {
        for head in ["let a = ", "film f { a = ", "import \"a\" {", "", "film f[i in "] {
            check(format!("rts 1\n{head}{}\nlet b = 1\n", scrap.repeat(n)).as_bytes());
        }
    }
    check(format!("rts 1\nlet a = [{}]", "1 + 1, ".repeat(n)).as_bytes());
    check("let a = 1\nmaterial b: c {\n".repeat(10_000).as_bytes());
    assert!(start.elapsed() < Duration::from_mins(2), "{:?}", start.elapsed());
}

/// Makes a scene of any declarations, so that warnings are looked for.
const GOOD: &str = "sky good_sky: constant { }
camera good_camera: perspective { from = (0, 1, 5)m, to = (0, 1, 0)m }
render good: path { camera = good_camera, sky = good_sky }
material good_material: diffuse { color = linear(0.5) }
instance ball { shape = sphere(radius: 1m), material = good_material }
";

/// Scenes of `n` lines, each of which is wrong in the same way.
fn hostile(n: usize) -> Vec<(&'static str, String)> {
    let each = |line: &dyn Fn(usize) -> String| (0..n).map(line).collect::<String>();
    let same = |text: &str| text.repeat(n);
    let base = "material base: diffuse {\n".to_owned() + &same("  color = linear(0.5)\n") + "}\n";
    vec![
        ("unused", each(&|i| format!("let a{i} = 1m\n"))),
        ("unknown", each(&|i| format!("let a{i} = b{i}\n"))),
        ("twice", same("let a = 1m\n")),
        ("fields", format!("film f {{\n{}}}\n", each(&|i| format!("  a{i} = 1\n")))),
        ("fields in a line", format!("film f {{ {} }}\n", each(&|i| format!("a{i} = 1, ")))),
        ("arguments", format!("let a = sphere({})\n", each(&|i| format!("a{i}: 1, ")))),
        ("nameless", format!("let a = sphere({})\n", same("1, "))),
        ("syntax", each(&|i| format!("let a{i} = = 1m\n"))),
        ("strange", each(&|i| format!("let a{i} = 1 ; é\n"))),
        ("braces", same("]\n") + &same("{}\n")),
        ("unclosed", each(&|i| format!("material a{i}: diffuse {{\n"))),
        ("kinds", each(&|i| format!("materail a{i}: diffuse {{ }}\n"))),
        ("types", each(&|i| format!("material a{i}: difuse {{ }}\n"))),
        ("bases", each(&|i| format!("material a{i} like a{} {{ }}\n", i + 1))),
        ("one base", base.clone() + &each(&|i| format!("material a{i} like base {{ }}\n"))),
        ("references", base + &each(&|i| format!("let a{i} = base.color\n"))),
        ("imports", each(&|i| format!("import \"a{i}.rts\"\n"))),
        ("modules", same("import \"std:metals\"\n") + &each(&|i| format!("let a{i} = b{i}\n"))),
        ("chain", each(&|i| format!("let a{i} = a{} + a0\n", i + 1))),
        (
            "fields of fields",
            each(&|i| format!("material a{i}: metal {{ fuzz = a{}.fuzz }}\n", i + 1)),
        ),
        ("percent", each(&|i| format!("material a{i}: metal {{ fuzz = 0.5% }}\n"))),
        ("renders", each(&|i| format!("render a{i}: path {{ }}\n"))),
        ("names", format!("let a = [{}]\n", each(&|i| format!("b{i}, ")))),
        ("long line", format!("let a = \"{}\" + {}\n", same("é"), same("1 = "))),
    ]
}

#[test]
fn what_is_wrong_n_times_takes_time_in_proportion() {
    struct Nothing;
    impl Loader for Nothing {
        fn load(&mut self, _: &str, _: &str) -> Result<(String, String), LoadError> {
            Err(LoadError::NotFound)
        }
    }
    // What grows with the square takes minutes here, as unused names once did.
    for (name, text) in hostile(20_000) {
        let start = Instant::now();
        let text = format!("rts 1\n{GOOD}{text}");
        let analysis = lang::analyze("a.rts", &text, &mut Nothing, &lang::Options::default());
        check_diagnostics(&analysis.sources, &analysis.diagnostics);
        assert!(!analysis.diagnostics.is_empty(), "{name}");
        let took = start.elapsed();
        assert!(took < Duration::from_secs(10), "{name}: {took:?}");
    }
}

#[test]
fn so_many_faults_are_kept_and_no_more() {
    let mut sources = SourceSet::new();
    let n = lang::diagnostic::MAX_FAULTS;
    let file = sources.add("a.rts", format!("rts 1\n{}", "let\n".repeat(n + 1000)));
    let (_, diagnostics) = parse(&sources, file);
    assert_eq!(diagnostics.len(), n + 1);
    assert_eq!(diagnostics.last().map(|d| d.code.0), Some("E0112"));
}

#[test]
fn nesting_up_to_the_limit_is_read_and_beyond_it_is_refused() {
    for (open, close) in [("(", ")"), ("[", "]"), ("f(", ")"), ("(1, ", ")m")] {
        let text = |n: usize| format!("rts 1\nlet a = {}1{}\n", open.repeat(n), close.repeat(n));
        assert_eq!(check(text(64).as_bytes()), 0, "64 {open}");
        let mut sources = SourceSet::new();
        let file = sources.add("a.rts", text(65));
        let (_, diagnostics) = parse(&sources, file);
        let codes: Vec<&str> = diagnostics.iter().map(|d| d.code.0).collect();
        assert_eq!(codes, ["E0109"], "65 {open}");
    }
    for chain in ["-", "1 + ", "if a then b else "] {
        assert_eq!(check(format!("rts 1\nlet a = {}1", chain.repeat(200)).as_bytes()), 0);
        assert_eq!(check(format!("rts 1\nlet a = {}1", chain.repeat(300)).as_bytes()), 1);
    }
}

#[test]
fn control_characters_are_reported_once() {
    assert_eq!(check(b"rts 1\nlet a = 1\0\0\nlet b\0= 2\n"), 1);
}

/// Faults that can be planted in the example: what to replace, with what.
const FAULTS: [(&str, &str); 12] = [
    ("ring.width = 3.2mm", "ring.width 3.2mm"),
    ("let sun_range = 400m", "let sun_range = 400 m"),
    ("color.late = srgb(#8a5a34)", "color.late = srgb(#8a5a3)"),
    ("alpha.clip = 50%", "alpha.clip = "),
    ("material bronze like brass", "materiel bronze like brass"),
    ("radius = sun_range * tan(0.265deg)", "radius = sun_range * tan(0.265deg"),
    ("light sun: sphere {", "light sun sphere {"),
    ("coat.roughness = 0.06\n}", "coat.roughness = 0.06\n"),
    ("output = \"out/hero.exr\"", "output = \"out/hero.exr"),
    ("lens = 50mm", "lens: 50mm"),
    ("assert elevation > 0deg, \"", "assert elevation > 0deg \""),
    ("import \"parts/lantern.rts\" as lantern", "import \"parts/lantern.rts\" as"),
];

#[test]
fn n_faults_give_n_or_one_more_complaints_and_cost_no_other_declaration() {
    let whole = include_str!("syntax/shrine.rts");
    // All small sets, and the nearly full ones.
    let sets = (1_usize..1 << FAULTS.len()).filter(|set| !(4..11).contains(&set.count_ones()));
    for set in sets {
        let mut text = whole.to_owned();
        let chosen = FAULTS.iter().enumerate().filter(|(i, _)| set >> i & 1 == 1);
        for (_, (good, bad)) in chosen {
            assert!(text.contains(good), "{good}");
            text = text.replacen(good, bad, 1);
        }
        let n_faults = set.count_ones() as usize;
        let mut sources = SourceSet::new();
        let file = sources.add("a.rts", text);
        let (tree, diagnostics) = parse(&sources, file);
        let found = diagnostics.len();
        assert!((n_faults..=n_faults + 1).contains(&found), "{n_faults} faults: {diagnostics:#?}");
        assert_eq!(tree.items.len(), 38);
    }
}
