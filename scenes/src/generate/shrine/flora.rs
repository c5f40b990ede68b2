//! Textures of what grows: blossom and petals cut out by alpha, leaves, bark, moss, forest.

use std::f64::consts::TAU;

use super::noise::{cells, tile, tile_fbm};
use super::paint::{Picture, Texel, bumps, cloud, grey, hex, mix, opaque, ramp, shade};

/// All of them.
pub(super) const PICTURES: &[Picture] = &[
    Picture::new("blossom_a.png", [256, 256], |u, v| {
        flower(u, v, hex(0x00ff_eef3), hex(0x00f3_a9c4), 0.0)
    }),
    Picture::new("blossom_b.png", [256, 256], |u, v| {
        bunch(u, v, hex(0x00ff_dfe9), hex(0x00ee_8fb3), 1)
    }),
    Picture::new("blossom_c.png", [256, 256], |u, v| {
        bunch(u, v, hex(0x00ff_f4f4), hex(0x00f7_c3d2), 2)
    }),
    Picture::new("blossom_d.png", [256, 256], |u, v| {
        flower(u, v, hex(0x00ff_d3e2), hex(0x00e5_7ba3), 0.3)
    }),
    Picture::new("blossom_e.png", [256, 256], |u, v| {
        bunch(u, v, hex(0x00ff_e8ee), hex(0x00f0_a0be), 3)
    }),
    Picture::new("blossom_buds.png", [128, 128], buds),
    Picture::new("petal_a.png", [128, 128], |u, v| petal(u, v, hex(0x00ff_e9f0), hex(0x00f2_a5c1))),
    Picture::new("petal_b.png", [128, 128], |u, v| petal(u, v, hex(0x00ff_f6f6), hex(0x00f9_cddb))),
    Picture::new("petal_c.png", [128, 128], |u, v| petal(v, u, hex(0x00fb_d2df), hex(0x00e3_87a8))),
    Picture::new("leaf_young.png", [128, 128], |u, v| {
        leaf(u, v, hex(0x009a_7a3c), hex(0x006d_4a2c))
    }),
    Picture::new("leaf_shrub.png", [128, 128], |u, v| {
        leaf(u, v, hex(0x0046_6b34), hex(0x002c_4a24))
    }),
    Picture::new("leaf_azalea.png", [128, 128], |u, v| {
        flower(u, v, hex(0x00d9_5a86), hex(0x00b0_2f62), 0.1)
    }),
    Picture::new("spray_cedar.png", [128, 256], |u, v| {
        spray(u, v, hex(0x002f_4a35), hex(0x001d_3026))
    }),
    Picture::new("spray_pine.png", [128, 256], |u, v| {
        spray(u, v, hex(0x0041_5634), hex(0x0022_3320))
    }),
    Picture::new("bark.png", [256, 512], |u, v| opaque(bark(u, v))),
    Picture::new("bark_normal.png", [256, 512], |u, v| bumps(bark_height, u, v, 0.05)),
    Picture::new("bark_cedar.png", [128, 256], |u, v| {
        opaque(mix(hex(0x0036_2a24), hex(0x006a_5446), tile_fbm(u, v, [14, 2], 9)))
    }),
    Picture::new("moss.png", [512, 512], |u, v| opaque(moss(u, v))),
    Picture::new("moss_normal.png", [512, 512], |u, v| bumps(moss_height, u, v, 0.035)),
    Picture::new("grass.png", [64, 128], |u, v| {
        opaque(blade(u, v, hex(0x0052_7a34), hex(0x00a9_b65a)))
    }),
    Picture::new("grass_dry.png", [64, 128], |u, v| {
        opaque(blade(u, v, hex(0x0078_7a3c), hex(0x00c4_ac6c)))
    }),
    Picture::new("iris.png", [64, 128], |u, v| {
        opaque(blade(u, v, hex(0x002f_5c3c), hex(0x006f_9a56)))
    }),
    Picture::new("lily.png", [128, 128], |u, v| opaque(lily(u, v))),
    Picture::new("forest.png", [256, 256], |u, v| {
        opaque(mix(hex(0x0022_3030), hex(0x0040_4f48), cloud(u, v, 9, 31)))
    }),
];

/// Coverage and place (0 at the root, 1 at the tip) of a petal that points along +x from the origin.
fn petal_shape(x: f64, y: f64) -> Option<f64> {
    let notch = 0.08 * (1.0 - (libm::fabs(y) * 9.0).min(1.0));
    if !(0.0..1.0 - notch).contains(&x) {
        return None;
    }
    let half =
        0.40 * libm::pow(libm::sin(std::f64::consts::PI * libm::pow(x, 0.72)).max(0.0), 0.62);
    (libm::fabs(y) < half).then_some(x)
}

/// A flower with five petals around (0.5, 0.5), turned by `turn` of a revolution.
fn flower(u: f64, v: f64, pale: [f64; 3], deep: [f64; 3], turn: f64) -> Texel {
    let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let r = libm::hypot(x, y) / 0.98;
    for k in 0..5 {
        let a = TAU * (f64::from(k) / 5.0 + turn);
        let (px, py) = (x * libm::cos(a) + y * libm::sin(a), y * libm::cos(a) - x * libm::sin(a));
        let stamen = libm::fabs(py) < 0.018 && (0.0..0.34).contains(&px)
            || libm::hypot(px - 0.35, py) < 0.035;
        if stamen {
            return opaque(hex(0x00f0_c060));
        }
    }
    for k in 0..5 {
        let a = TAU * (f64::from(k) / 5.0 + turn + 0.1);
        let (px, py) = (x * libm::cos(a) + y * libm::sin(a), y * libm::cos(a) - x * libm::sin(a));
        if let Some(t) = petal_shape(px / 0.98, py / 0.98) {
            let vein = 0.04 * libm::sin(60.0 * py / (0.3 + px));
            let rim = 0.10 * ramp(0.75, 1.0, t);
            let c = mix(deep, pale, ramp(0.0, 0.62, t) + vein);
            return opaque(shade(c, 1.0 - rim - 0.12 * f64::from(k % 2) * (1.0 - r)));
        }
    }
    let [a, b, c] = deep;
    [a, b, c, 0.0]
}

/// Several flowers on one card, each with a turn and a size of its own.
fn bunch(u: f64, v: f64, pale: [f64; 3], deep: [f64; 3], seed: u64) -> Texel {
    let places = [
        [0.30, 0.30, 0.28],
        [0.70, 0.27, 0.25],
        [0.29, 0.72, 0.26],
        [0.71, 0.71, 0.28],
        [0.5, 0.5, 0.27],
    ];
    for (k, [x, y, r]) in places.into_iter().enumerate().rev() {
        let n = k as u64 * 7 + seed * 31;
        let wobble = |i: u64| 0.05 * (tile(0.37, 0.61, [5, 5], n + i) - 0.5);
        let (fu, fv) =
            ((u - x - wobble(1)) / (2.0 * r) + 0.5, (v - y - wobble(2)) / (2.0 * r) + 0.5);
        if (0.0..1.0).contains(&fu) && (0.0..1.0).contains(&fv) {
            let f = flower(fu, fv, pale, deep, tile(0.5, 0.5, [3, 3], n));
            if f[3] > 0.5 {
                let [a, b, c] = shade([f[0], f[1], f[2]], 0.94 + 0.06 * k as f64 / 4.0);
                return [a, b, c, 1.0];
            }
        }
    }
    let [a, b, c] = deep;
    [a, b, c, 0.0]
}

fn buds(u: f64, v: f64) -> Texel {
    let mut texel = [0.8, 0.4, 0.5, 0.0];
    for (k, (x, y)) in [(0.3, 0.3), (0.68, 0.36), (0.45, 0.7)].into_iter().enumerate() {
        let (dx, dy) = ((u - x) / 0.13, (v - y) / 0.19);
        if dx * dx + dy * dy < 1.0 {
            texel = opaque(mix(hex(0x00e8_86a8), hex(0x00f9_bcd0), 0.5 + 0.5 * dy));
        } else if libm::fabs(u - x - 0.3 * (v - y)) < 0.016 && (y..y + 0.32).contains(&v) && k != 2
        {
            texel = opaque(hex(0x0074_6a38));
        }
    }
    texel
}

fn petal(u: f64, v: f64, pale: [f64; 3], deep: [f64; 3]) -> Texel {
    let c = mix(deep, pale, ramp(0.0, 0.7, u) + 0.05 * libm::sin(50.0 * (v - 0.5) / (0.35 + u)));
    let inside = petal_shape((u - 0.02) / 0.96, (v - 0.5) * 0.92).is_some();
    [c[0], c[1], c[2], if inside { 1.0 } else { 0.0 }]
}

fn leaf(u: f64, v: f64, pale: [f64; 3], deep: [f64; 3]) -> Texel {
    let y = v - 0.5;
    let half = 0.30 * libm::pow(libm::sin(std::f64::consts::PI * libm::pow(u, 0.85)).max(0.0), 0.9);
    let tooth = 0.012 * libm::fabs(libm::sin(60.0 * u));
    let vein = libm::fabs(libm::sin(40.0 * (u - 0.8 * libm::fabs(y))));
    let midrib = 1.0 - ramp(0.008, 0.03, libm::fabs(y));
    let c = mix(deep, pale, 0.35 + 0.5 * vein + 0.4 * midrib);
    [c[0], c[1], c[2], if libm::fabs(y) < half - tooth { 1.0 } else { 0.0 }]
}

/// A flat spray of a conifer: needles to both sides of drooping twigs.
fn spray(u: f64, v: f64, pale: [f64; 3], deep: [f64; 3]) -> Texel {
    let x = 2.0 * u - 1.0;
    let reach = 0.95 * libm::sqrt((v * (1.05 - v) * 3.6).clamp(0.0, 1.0)).min(1.0);
    let row = 15.0 * (v + 0.28 * libm::fabs(x));
    let twig = row - libm::floor(row);
    let needle = 46.0 * (libm::fabs(x) + 0.1 * twig);
    let fringe = 0.22 * (needle - libm::floor(needle));
    let keep =
        libm::fabs(x) < reach * (0.82 + 0.25 * tile(u, v, [9, 15], 3)) && twig > 0.10 + fringe;
    let c = mix(deep, pale, twig * 0.8 + 0.3 * tile(u, v, [12, 24], 5));
    [c[0], c[1], c[2], if keep || libm::fabs(x) < 0.03 { 1.0 } else { 0.0 }]
}

/// Bark of a cherry: rings of pores around, peeling in between.
fn bark_height(u: f64, v: f64) -> f64 {
    let rings = tile_fbm(u, v, [4, 40], 17);
    let pores = ramp(0.62, 0.80, tile(u, v, [9, 60], 18));
    0.7 * rings + 0.5 * pores + 0.5 * tile_fbm(u, v, [6, 9], 19)
}

fn bark(u: f64, v: f64) -> [f64; 3] {
    let h = bark_height(u, v) / 1.7;
    let lichen = ramp(0.60, 0.72, tile_fbm(u, v, [5, 9], 21));
    mix(mix(hex(0x002c_2220), hex(0x006e_5a52), h * 1.2), hex(0x0080_8670), 0.55 * lichen)
}

fn moss_height(u: f64, v: f64) -> f64 {
    0.5 * cloud(u, v, 24, 41) + 0.35 * (1.0 - cells(u, v, 40, 42).0) + 0.4 * cloud(u, v, 5, 43)
}

fn moss(u: f64, v: f64) -> [f64; 3] {
    let green = mix(hex(0x003c_5428), hex(0x0078_8a46), cloud(u, v, 18, 44));
    let soil = mix(hex(0x0050_4430), hex(0x0078_6a50), cloud(u, v, 30, 45));
    let bare = ramp(0.56, 0.68, cloud(u, v, 4, 46));
    shade(mix(green, soil, bare), 0.75 + 0.4 * cloud(u, v, 60, 47))
}

/// A blade of grass: darker at its root (v = 1), a pale rib in the middle.
fn blade(u: f64, v: f64, deep: [f64; 3], pale: [f64; 3]) -> [f64; 3] {
    let rib = 0.2 * (1.0 - ramp(0.04, 0.12, libm::fabs(u - 0.5)));
    let lines = 0.08 * libm::sin(40.0 * u);
    shade(mix(pale, deep, 0.15 + 0.85 * v - rib + lines), 0.65 + 0.35 * (1.0 - v))
}

fn lily(u: f64, v: f64) -> [f64; 3] {
    let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let (r, a) = (libm::hypot(x, y), libm::atan2(y, x));
    let vein = 1.0 - ramp(0.0, 0.16, libm::fabs(libm::sin(9.0 * a)) * r);
    let c = mix(hex(0x002e_5230), hex(0x0060_8046), 0.5 * vein + 0.5 * cloud(u, v, 5, 51));
    mix(c, hex(0x0078_4a3a), ramp(0.82, 1.0, r) * 0.7)
}

/// How far a surface is worn, one channel.
pub(super) fn wear(u: f64, v: f64) -> Texel {
    grey(cloud(u, v, 6, 55))
}
