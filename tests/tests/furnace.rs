//! White surfaces keep all light: a part of the grid of `docs/furnace.md`, with fewer samples.

use tests::furnace::surfaces;

#[test]
fn white_surfaces_return_everything() {
    let (mut families, mut count) = (std::collections::BTreeSet::new(), 0);
    let mut wrong = Vec::new();
    for surface in surfaces().iter().step_by(7) {
        // Fibres are sampled evenly, and smooth ones have a peak at grazing; what goes through coat and glass is as noisy.
        let noisy = surface.family.contains("sheen")
            || surface.family.contains("coat") && surface.name.contains("transmission");
        let n = if noisy { 1 << 16 } else { 1 << 14 };
        let off = surface.worst(n);
        if off.abs() >= 0.017 {
            wrong.push(format!("{}, {}: {off}", surface.family, surface.name));
        }
        families.insert(surface.family);
        count += 1;
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(families.len() >= 12 && count > 40, "{count} surfaces of {families:?}");
}
