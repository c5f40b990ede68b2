//! Cloth: tall banners on poles, the curtain in the door of the hall.

use super::kit::{Mesh, Place, V3};

/// Parts of a banner, the foot of its pole in the origin, the cloth towards +x.
#[derive(Default)]
pub(super) struct Banner {
    /// The cloth, uv 0..1.
    pub(super) cloth: Mesh,
    /// Pole and arm.
    pub(super) pole: Mesh,
    /// Loops that hold the cloth, and the tip.
    pub(super) fittings: Mesh,
}

/// A banner 0.62 m wide and 2.7 m high in a light breeze; `phase` makes each its own.
pub(super) fn banner(phase: f64) -> Banner {
    let mut banner = Banner::default();
    let (low, high, width) = (0.75, 3.45, 0.62);
    banner.cloth.grid([16, 72], [1.0, 1.0], |u, v| {
        let y = high + (low - high) * v;
        // Held along the pole and along the arm: free towards the lower far corner.
        let free = u * v;
        let swing = libm::sin(5.0 * u + 6.5 * v + phase) * 0.16
            + libm::sin(11.0 * v - 3.0 * u + 2.0 * phase) * 0.05;
        let x = 0.07 + width * u - 0.10 * free * v;
        [x, y + 0.05 * free * libm::sin(3.0 * phase), free * swing + 0.22 * free * v]
    });
    let at = |y: f64| -> V3 { [0.0, y, 0.0] };
    banner.pole.tube(&[at(-0.6), at(1.5), at(3.75)], &[0.030, 0.027, 0.022], 16, 1.0);
    let arm = [[-0.03, high + 0.06, 0.0], [0.35, high + 0.065, 0.0], [0.74, high + 0.06, 0.0]];
    banner.pole.tube(&arm, &[0.014, 0.014, 0.012], 10, 1.0);
    for k in 0..9 {
        let y = high - 0.05 - (high - low - 0.1) * f64::from(k) / 8.0;
        banner.fittings.bar([-0.034, y - 0.022, -0.034], [0.075, y + 0.022, 0.034], 0.008);
    }
    let tip = Place::at(at(3.75));
    banner.fittings.turned(
        &[[0.026, -0.03], [0.05, 0.02], [0.045, 0.06], [0.015, 0.11], [0.0, 0.14]],
        20,
        &tip,
    );
    banner
}

/// The split curtain of a door `width` wide and `height` high, top edge in the origin; uv 0..1.
pub(super) fn curtain(width: f64, height: f64) -> Mesh {
    let mut mesh = Mesh::default();
    let panels = 4;
    for panel in 0..panels {
        let (u0, u1) =
            (f64::from(panel) / f64::from(panels), f64::from(panel + 1) / f64::from(panels));
        let first = mesh.0.uvs.len();
        mesh.grid([14, 28], [1.0, 1.0], |u, v| {
            let along = u0 + (u1 - u0) * (0.012 + 0.976 * u);
            let fold =
                0.035 * libm::sin(16.0 * along + 1.1 * f64::from(panel) + 2.0 * v) * (0.3 + v);
            let x = width * (along - 0.5) - 0.03 * v * (2.0 * u - 1.0);
            [x, -height * v * (1.0 + 0.02 * libm::sin(9.0 * along)), fold]
        });
        // One picture over all panels.
        for uv in &mut mesh.0.uvs[first..] {
            uv[0] = (u0 + (u1 - u0) * f64::from(uv[0])) as f32;
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cloth_is_fine_enough_to_fold() {
        assert_eq!(banner(0.0).cloth.triangles(), 2 * 16 * 72);
        assert_eq!(curtain(3.0, 1.0).triangles(), 4 * 2 * 14 * 28);
    }
}
