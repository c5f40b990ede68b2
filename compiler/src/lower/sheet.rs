//! What makes the leaves and petals of one mesh differ: some are not there, each leans its own way.
//!
//! Turns the name of an instance and the number of a piece (triangles that hang together) into
//! whether the piece exists, and into normals. It depends on names and pieces alone, so every ray,
//! of any kind, meets the same petal.

use glam::{DVec2, DVec3};
use lang::material::Traits as _;
use lang::scene::{Instance, Scene};

use super::pieces::pieces;
use crate::import::Part;
use crate::stage::KeyOf;

/// The sheets of one instance.
pub(super) struct Sheets {
    name: String,
    /// Share that is not there.
    gap: f64,
    /// Lean at the rim.
    pillow: f64,
    /// Lean of a whole petal.
    tilt: f64,
}

impl Sheets {
    /// `None` for materials that do not differ from piece to piece.
    pub(super) fn of(scene: &Scene, instance: &Instance) -> Option<Self> {
        let name = instance.name.text.clone();
        let sheet = scene.materials[instance.material?].model.sheet()?;
        let sheets = Self { name, gap: sheet.gap, pillow: sheet.pillow, tilt: sheet.tilt };
        (sheets.gap > 0.0 || sheets.leans()).then_some(sheets)
    }

    /// Adds all that makes them differ.
    pub(super) fn read(&self, key: &mut KeyOf) {
        key.text(&self.name).floats(&[self.gap, self.pillow, self.tilt]);
    }

    /// Whether piece `piece` is there.
    pub(super) fn exists(&self, piece: u32) -> bool {
        self.gap == 0.0 || self.unit(piece, 0) >= self.gap
    }

    /// Whether normals change.
    pub(super) fn leans(&self) -> bool {
        self.pillow > 0.0 || self.tilt > 0.0
    }

    /// The normal `n` at texture coordinates `uv` of piece `piece`; `along` is where u grows.
    pub(super) fn normal(&self, piece: u32, n: DVec3, along: DVec3, uv: DVec2) -> DVec3 {
        let n = n.normalize_or(DVec3::Y);
        let t = (along - n * n.dot(along)).normalize_or(n.any_orthonormal_vector());
        let centred = uv.clamp(DVec2::ZERO, DVec2::ONE) - 0.5;
        let own = DVec2::new(self.unit(piece, 1), self.unit(piece, 2)) - 0.5;
        let lean = centred * self.pillow + own * self.tilt;
        (t * lean.x + n.cross(t) * lean.y + n).normalize()
    }

    /// A number in 0..1 that belongs to a piece and a purpose.
    fn unit(&self, piece: u32, purpose: u8) -> f64 {
        let mut hasher = blake3::Hasher::new();
        hasher.update(self.name.as_bytes()).update(&piece.to_le_bytes()).update(&[purpose]);
        let hash = hasher.finalize();
        let mut low = [0; 8];
        low.copy_from_slice(&hash.as_bytes()[..8]);
        (u64::from_le_bytes(low) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The piece of each triangle of `part`: triangles that share a position hang together.
pub(super) fn pieces_of(part: &Part) -> Vec<u32> {
    let keys = |triangle: usize| part.corners(triangle).map(|p| p.map(f32::to_bits));
    pieces((0..part.triangles.len()).map(keys))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheets(gap: f64) -> Sheets {
        Sheets { name: "crown".to_owned(), gap, pillow: 0.2, tilt: 0.25 }
    }

    #[test]
    fn the_share_of_gaps_is_what_was_asked() {
        for gap in [0.0, 0.3, 1.0] {
            let there = (0..20_000).filter(|piece| sheets(gap).exists(*piece)).count();
            let wanted = (1.0 - gap) * 20_000.0;
            let sd = (20_000.0 * gap * (1.0 - gap)).sqrt();
            assert!((there as f64 - wanted).abs() <= 4.0 * sd, "{gap}: {there}");
        }
    }

    #[test]
    fn normals_lean_outward_and_stay_on_their_side() {
        let sheets = Sheets { tilt: 0.0, ..sheets(0.0) };
        let right = sheets.normal(0, DVec3::Y, DVec3::X, DVec2::new(1.0, 0.5));
        assert!(
            (right.x - 0.1 / 1.01_f64.sqrt()).abs() < 1e-12 && right.z.abs() < 1e-12,
            "{right}"
        );
        let middle = sheets.normal(5, DVec3::Y, DVec3::X, DVec2::new(0.5, 0.5));
        assert!((middle - DVec3::Y).length() < 1e-12);
    }

    #[test]
    fn petals_differ_and_names_matter() {
        let own = |piece| sheets(0.0).normal(piece, DVec3::Y, DVec3::X, DVec2::new(0.5, 0.5));
        assert!((own(0) - own(1)).length() > 1e-3);
        let other = Sheets { name: "branch".to_owned(), ..sheets(0.0) };
        assert!((own(0) - other.normal(0, DVec3::Y, DVec3::X, DVec2::splat(0.5))).length() > 1e-3);
    }
}
