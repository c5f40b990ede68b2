//! Fields that do nothing because of what another field says.

/// A field that does nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoEffect {
    /// Its name.
    pub field: &'static str,
    /// The field because of which.
    pub because: &'static str,
    /// Why.
    pub why: &'static str,
}

/// Field, the one because of which it does nothing, the value of that, and why. Of value 0, a field does nothing anyway.
const NO_EFFECT: &[(&str, &str, f64, &str)] = &[
    ("coat.roughness", "coat.weight", 0.0, "there is no coat"),
    ("anisotropy.rotation", "anisotropy", 0.0, "nothing is brushed"),
    ("transmission", "metallic", 1.0, "metal lets nothing through"),
    ("specular", "metallic", 1.0, "what a metal reflects is its `color`"),
    ("specular.color", "metallic", 1.0, "what a metal reflects is its `color`"),
];

/// The fields that do nothing in a material of which `number` says what numbers its fields are, as far as they are.
pub fn without_effect(number: impl Fn(&str) -> Option<f64>) -> Vec<NoEffect> {
    let idle = NO_EFFECT.iter().filter(|(field, because, value, _)| {
        number(field) != Some(0.0) && number(because) == Some(*value)
    });
    idle.map(|&(field, because, _, why)| NoEffect { field, because, why }).collect()
}
