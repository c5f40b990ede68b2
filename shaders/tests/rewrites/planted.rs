//! The forms that `forms.rs` knows, planted: each is found, and what drivers keep passes.

use crate::forms::rewrites;
use naga::Module;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use shaders::{FeatureSet, link};

#[test]
fn forms_planted_in_the_kernel_are_found() {
    let text = link(&FeatureSet::full()).expect("the modules link").text;
    let plants = [
        ("ggx_normals", "(k * INV_PI) * k", "k * k * INV_PI"),
        ("principled_eval", "(1.0 - share) * (cos_i * INV_PI)", "(1.0 - share) * cos_i * INV_PI"),
        ("sphere_light_sample", "d2 * sin2_t", "distance * distance * sin2_t"),
    ];
    for (function, good, bad) in plants {
        assert_eq!(text.matches(good).count(), 1, "{good}");
        let (module, info) = valid(&text.replace(good, bad));
        let found = rewrites(&module, &info);
        assert!(
            found.iter().any(|form| form.starts_with(&format!("`{function}`"))),
            "{bad}: {found:?}"
        );
    }
}

fn valid(text: &str) -> (Module, ModuleInfo) {
    let module = naga::front::wgsl::parse_str(text).unwrap_or_else(|e| panic!("{text}: {e}"));
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{text}: {e}"));
    (module, info)
}

fn forms_of(body: &str) -> Vec<String> {
    let text = format!(
        "@group(0) @binding(0) var<storage, read_write> words: array<f32>;
        struct Pair {{ first: f32, second: f32 }}
        fn product(a: f32, b: f32) -> f32 {{ return a * b; }}
        fn square(a: f32) -> f32 {{ return a * a; }}
        fn root(a: f32) -> f32 {{ return sqrt(a); }}
        fn pair(a: f32, b: f32) -> Pair {{ return Pair(a * b, 1.0 - a); }}
        fn scaled(a: f32) -> f32 {{ return a * 0.3; }}
        @compute @workgroup_size(1)
        fn render() {{
            let a = words[0];
            let b = words[1];
            let c = words[2];
            let d = words[3];
            let both = c * d;
            let v = vec3f(a, b, c);
            let w = vec3f(d, c, a);
            words[4] = {body};
        }}"
    );
    let (module, info) = valid(&text);
    rewrites(&module, &info)
}

#[test]
fn forms_that_mesa_rewrites_are_found() {
    let refused = [
        "a * b * 0.3",
        "0.3 * (a * b)",
        "product(a, b) * 0.3",
        "scaled(a * b)",
        "pair(a, b).first * 0.3",
        "(a * 0.3) * 0.7",
        "scaled(a) * 0.7",
        "(v * b * 0.3).x",
        "(v * d * vec3f(0.3)).y",
        "a + b + 0.3",
        "a + 0.7 - 0.3",
        "1.0 - (1.0 - a)",
        "1.0 - pair(a, b).second",
        "0.5 + dot(v, w)",
        "a * b + a * c",
        "(1.0 - a) * b + a * b",
        "words[7] * a - b * words[7]",
        "a * b + c * d + sqrt(a)",
        "(a + b) - a",
        "a - (b + a)",
        "b + (a - b)",
        "a - a",
        "sqrt(a) * sqrt(a)",
        "root(a) * sqrt(a)",
        "square(a * b) + (a * b * c) * 0.3",
        "1.0 / (1.0 / a)",
        "a * 0.0",
        "select(0.0, 1.0, a == a)",
        "select(0.0, 1.0, a + 0.3 < 0.7)",
        "select(0.0, 1.0, a + b > a)",
    ];
    for body in refused {
        assert!(!forms_of(body).is_empty(), "`{body}` passes");
    }
}

#[test]
fn forms_that_stay_as_they_are_pass() {
    let kept = [
        "(a * 0.3) * b",
        "a * (b * 0.3)",
        "scaled(a) * b",
        "a * b * 2.0",
        "(a + 0.3) + b",
        "1.0 - a - b",
        "1.0 - (a + b)",
        "dot(v, w) - c * d",
        "a * b + c * d + a * c",
        "sqrt(a) + a * b + c * d",
        "a + (b - a) * c",
        "a * (1.0 - c) + b * c",
        "0.3 + a * (0.2 + a * 0.1)",
        "sqrt(a) * sqrt(b)",
        "1.0 / (a + b)",
        "select(0.0, 1.0, a + b > 0.0)",
        "select(0.0, 1.0, a + b > c)",
        "pair(a, b).second * 0.3",
        "square(c * d) * 2.0",
        "both * 0.3 + (both * 0.2) * a",
    ];
    for body in kept {
        assert_eq!(forms_of(body), Vec::<String>::new(), "`{body}`");
    }
}
