//! Textures of what people made: tiles, plaster, paper, cloth with crests, rope, metal, gold leaf.

use std::f64::consts::{PI, TAU};

use super::noise::{cells, tile, tile_fbm};
use super::paint::{Picture, bumps, cloud, grey, hex, mix, opaque, ramp, shade};

/// All of them.
pub(super) const PICTURES: &[Picture] = &[
    Picture::new("tile.png", [256, 256], |u, v| opaque(tile_color(u, v))),
    Picture::new("tile_rough.png", [128, 128], |u, v| grey(0.30 + 0.45 * cloud(u, v, 5, 11))),
    Picture::new("tile_pan.png", [128, 128], |u, v| opaque(shade(tile_color(v, u), 0.8))),
    Picture::new("tile_crest.png", [128, 128], |u, v| {
        opaque(shade(tile_color(u, v), 0.6 + 0.75 * tomoe(u, v)))
    }),
    Picture::new("tile_crest_normal.png", [128, 128], |u, v| bumps(tomoe, u, v, 0.06)),
    Picture::new("plaster.png", [256, 256], |u, v| opaque(plaster(u, v))),
    Picture::new("plaster_normal.png", [256, 256], |u, v| {
        bumps(|u, v| cloud(u, v, 20, 13), u, v, 0.03)
    }),
    Picture::new("shoji.png", [256, 256], |u, v| opaque(shoji(u, v))),
    Picture::new("pane.png", [128, 128], |u, v| opaque(pane(u, v))),
    Picture::new("lantern_white.png", [512, 256], |u, v| {
        opaque(lantern(u, v, hex(0x00ff_d9a0), hex(0x0060_1c10)))
    }),
    Picture::new("lantern_red.png", [512, 256], |u, v| {
        opaque(lantern(u, v, hex(0x00ff_7a45), hex(0x0030_0806)))
    }),
    Picture::new("banner_wave.png", [128, 512], |u, v| {
        opaque(banner(u, v, hex(0x001f_3a6b), hex(0x00ec_e4d2), 0))
    }),
    Picture::new("banner_blossom.png", [128, 512], |u, v| {
        opaque(banner(u, v, hex(0x009c_2434), hex(0x00f4_e6da), 1))
    }),
    Picture::new("banner_dawn.png", [128, 512], |u, v| {
        opaque(banner(u, v, hex(0x00ec_e4d4), hex(0x008c_2230), 2))
    }),
    Picture::new("noren.png", [512, 256], |u, v| opaque(noren(u, v))),
    Picture::new("rope.png", [256, 256], |u, v| opaque(rope(u, v))),
    Picture::new("rope_normal.png", [256, 256], |u, v| bumps(straw, u, v, 0.02)),
    Picture::new("paper.png", [128, 128], |u, v| {
        opaque(mix(hex(0x00e6_e0d2), hex(0x00fb_f8f0), cloud(u, v, 12, 17)))
    }),
    Picture::new("tablet.png", [256, 384], |u, v| opaque(tablet(u, v))),
    Picture::new("gold_leaf.png", [256, 128], |u, v| opaque(gold_leaf(u, v))),
    Picture::new("gilding.png", [128, 128], |u, v| {
        opaque(mix(hex(0x00d9_9c3c), hex(0x00ff_d67c), cloud(u, v, 5, 19)))
    }),
    Picture::new("gilding_rough.png", [128, 128], |u, v| grey(0.14 + 0.3 * cloud(u, v, 9, 20))),
    Picture::new("bronze.png", [128, 128], |u, v| opaque(bronze(u, v))),
    Picture::new("bronze_rough.png", [128, 128], |u, v| grey(0.22 + 0.4 * cloud(u, v, 6, 22))),
    Picture::new("lacquer.png", [256, 256], |u, v| opaque(lacquer(u, v))),
    Picture::new("lacquer_normal.png", [256, 256], |u, v| {
        bumps(|u, v| cloud(u, v, 6, 25), u, v, 0.008)
    }),
    Picture::new("pebble.png", [128, 128], |u, v| {
        opaque(mix(hex(0x006a_6662), hex(0x00a8_a096), cloud(u, v, 3, 27)))
    }),
    Picture::new("ridge_tile.png", [128, 128], |u, v| {
        opaque(shade(tile_color(u, v), 0.75 + 0.3 * cloud(u, v, 3, 28)))
    }),
    Picture::new("worn.png", [128, 128], super::flora::wear),
];

fn tile_color(u: f64, v: f64) -> [f64; 3] {
    let c = mix(hex(0x003a_4048), hex(0x006c_737a), cloud(u, v, 4, 31));
    let soot = ramp(0.5, 0.75, tile_fbm(u, v, [6, 3], 32));
    let moss = ramp(0.63, 0.75, tile_fbm(u, v, [3, 5], 33)) * ramp(0.35, 0.9, v);
    mix(shade(c, 1.0 - 0.35 * soot), hex(0x0052_5c38), 0.6 * moss)
}

/// Three commas in a ring, the crest on the ends of tiles; 0..1.
fn tomoe(u: f64, v: f64) -> f64 {
    let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let r = libm::hypot(x, y);
    let ring = if (0.72..0.86).contains(&r) { 1.0 } else { 0.0 };
    let comma = (0..3).any(|k| {
        let a = TAU * f64::from(k) / 3.0;
        let (px, py) = (x * libm::cos(a) + y * libm::sin(a), y * libm::cos(a) - x * libm::sin(a));
        let head = libm::hypot(px - 0.30, py) < 0.19;
        let w = libm::atan2(py, px);
        let tail =
            (0.0..1.9).contains(&w) && libm::fabs(r - 0.44 - 0.06 * w) < 0.09 * (1.0 - w / 1.9);
        head || tail
    });
    if comma { 1.0 } else { ring }
}

fn plaster(u: f64, v: f64) -> [f64; 3] {
    let c = mix(hex(0x00d8_d0c0), hex(0x00f0_eadc), cloud(u, v, 5, 35));
    let stain = ramp(0.55, 0.8, tile_fbm(u, v, [9, 2], 36));
    shade(c, 1.0 - 0.18 * stain)
}

/// Paper before a lamp: fibres, and light that falls off towards the frame.
fn shoji(u: f64, v: f64) -> [f64; 3] {
    let fibre = 0.08 * (tile_fbm(u, v, [40, 8], 37) - 0.5) + 0.06 * (cloud(u, v, 12, 38) - 0.5);
    let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.1);
    let glow = libm::exp(-0.55 * (x * x + 1.3 * y * y));
    shade(mix(hex(0x00e0_8a3c), hex(0x00ff_d08a), glow), 0.45 + 0.55 * glow + fibre)
}

/// A pane of a stone lantern with a flame behind it.
fn pane(u: f64, v: f64) -> [f64; 3] {
    let (x, y) = (2.0 * u - 1.0, (v - 0.68) * 1.8);
    let glow = libm::exp(-1.6 * (x * x + y * y));
    let fibre = 0.1 * (cloud(u, v, 16, 39) - 0.5);
    shade(mix(hex(0x00c8_6420), hex(0x00ff_d890), glow), 0.35 + 0.65 * glow + fibre)
}

/// Ribbed paper with a crest on four sides; u around, v down.
fn lantern(u: f64, v: f64, paper: [f64; 3], ink: [f64; 3]) -> [f64; 3] {
    let rib = libm::fabs(libm::sin(PI * 14.0 * v));
    let glow = 0.55 + 0.45 * libm::sin(PI * (0.1 + 0.8 * v));
    let (cu, cv) = (4.0 * u - libm::floor(4.0 * u), (v - 0.5) * 1.6 + 0.5);
    let crest = if (0.0..1.0).contains(&cv) { blossom_crest(cu, cv) } else { 0.0 };
    let band = if (0.1..0.9).contains(&v) { 0.0 } else { 1.0 };
    let c = mix(paper, ink, (crest + band).min(1.0) * 0.92);
    shade(c, glow * (0.72 + 0.28 * rib) * (0.92 + 0.16 * cloud(u, v, 20, 40)))
}

/// The crest of the shrine: five round petals with a dot between; 0..1.
fn blossom_crest(u: f64, v: f64) -> f64 {
    let (x, y) = ((2.0 * u - 1.0) * 1.25, (2.0 * v - 1.0) * 1.25);
    let r = libm::hypot(x, y);
    let a = libm::atan2(x, -y) / TAU * 5.0;
    let within = 2.0 * libm::fabs(a - libm::round(a));
    let edge = 0.78 - 0.34 * within * within - 0.10 * ramp(0.14, 0.0, within);
    let gap = within > 0.90 - 0.12 * r;
    let core = (0.17..0.22).contains(&r);
    if r < edge && !gap && !core { 1.0 } else { 0.0 }
}

/// A banner: borders, a crest above, strokes or waves below; v down.
fn banner(u: f64, v: f64, ground: [f64; 3], ink: [f64; 3], kind: u8) -> [f64; 3] {
    let cloth =
        shade(ground, 0.93 + 0.14 * (cloud(u, v, 16, 45) - 0.5) + 0.03 * libm::sin(600.0 * v));
    let x = 2.0 * u - 1.0;
    let y = 4.35 * v;
    let border = libm::fabs(x) > 0.86 || !(0.06..4.24).contains(&y);
    let cv = (y - 0.25) / 0.8;
    let crest = (0.0..1.0).contains(&cv) && blossom_crest(0.5 + 0.62 * x, cv) > 0.5;
    let below = match kind {
        0 => seigaiha(4.0 * u, 4.35 * 1.7 * v) && y > 2.6,
        1 => strokes(x, y, 0.0),
        _ => strokes(x, y, 0.7) || libm::hypot(x, y - 3.75) < 0.36,
    };
    let fade = ramp(0.2, 0.9, tile_fbm(u, v, [4, 12], 47));
    if border || crest || below { mix(cloth, ink, 0.80 + 0.18 * fade) } else { cloth }
}

/// Overlapping waves, whether on a line of them.
fn seigaiha(x: f64, y: f64) -> bool {
    let row = libm::floor(2.0 * y);
    (0..3).rev().any(|k| {
        let r = row - f64::from(k) + 1.0;
        let shift = if libm::fmod(r, 2.0) == 0.0 { 0.0 } else { 0.5 };
        let cx = libm::floor(x + shift) - shift + 0.5;
        let d = libm::hypot(x - cx, y - 0.5 * r - 0.2);
        [0.48, 0.34, 0.20].iter().any(|c| libm::fabs(d - c) < 0.045) && y < 0.5 * r + 0.2
    })
}

/// Marks of a brush down the middle: written by nobody, to be read from afar.
fn strokes(x: f64, y: f64, seed: f64) -> bool {
    let glyph = libm::floor((y - 1.25) / 0.72);
    if !(0.0..3.0).contains(&glyph) {
        return false;
    }
    let t = (y - 1.25) / 0.72 - glyph;
    let k = glyph + 3.0 * seed;
    let bar = |at: f64, half: f64, thick: f64| {
        libm::fabs(t - at - 0.06 * x) < thick && libm::fabs(x) < half
    };
    let post = |at: f64, from: f64, to: f64| {
        libm::fabs(x - at - 0.05 * t) < 0.085 && (from..to).contains(&t)
    };
    let sweep = |s: f64| t > 0.45 && t < 0.92 && libm::fabs(x - s * (t - 0.40) * 0.95) < 0.09;
    match (k * 1.43) as i32 % 3 {
        0 => bar(0.25, 0.55, 0.05) || post(0.0, 0.08, 0.9) || sweep(1.0) || sweep(-1.0),
        1 => {
            bar(0.12, 0.42, 0.05)
                || bar(0.5, 0.5, 0.05)
                || post(-0.4, 0.12, 0.9)
                || post(0.4, 0.12, 0.9)
                || bar(0.86, 0.42, 0.05)
        }
        _ => {
            bar(0.3, 0.6, 0.055)
                || post(0.0, 0.05, 0.55)
                || sweep(1.0)
                || sweep(-1.0)
                || bar(0.62, 0.22, 0.045)
        }
    }
}

fn noren(u: f64, v: f64) -> [f64; 3] {
    let cloth = shade(hex(0x005a_1a3a), 0.9 + 0.2 * (cloud(u, v, 14, 49) - 0.5));
    let hem = v > 0.88 && libm::fabs(libm::sin(PI * 24.0 * u)) > 0.5 || (0.82..0.85).contains(&v);
    let (cu, cv) = (4.0 * u - libm::floor(4.0 * u), (v - 0.42) * 2.0 + 0.5);
    let crest = (0.0..1.0).contains(&cv) && blossom_crest(cu, cv) > 0.5;
    if hem || crest { mix(cloth, hex(0x00f2_e4d4), 0.92) } else { cloth }
}

fn straw(u: f64, v: f64) -> f64 {
    tile_fbm(u, v, [48, 5], 51) + 0.4 * libm::fabs(libm::sin(PI * 24.0 * (u + 0.3 * v)))
}

fn rope(u: f64, v: f64) -> [f64; 3] {
    mix(hex(0x0086_6a38), hex(0x00dc_c284), 0.75 * straw(u, v))
}

fn tablet(u: f64, v: f64) -> [f64; 3] {
    let ground = shade(hex(0x0016_1a24), 0.8 + 0.5 * cloud(u, v, 9, 53));
    let (x, y) = (2.0 * u - 1.0, 1.25 + 0.72 * 3.0 * (v - 0.06) / 0.88);
    if strokes(1.15 * x, y, 0.35) {
        mix(hex(0x00d8_a040), hex(0x00f6_d080), cloud(u, v, 8, 54))
    } else {
        ground
    }
}

/// Squares of gold leaf with seams, painted clouds, and a pine that is not there.
fn gold_leaf(u: f64, v: f64) -> [f64; 3] {
    let (a, b) = (12.0 * u, 4.0 * v);
    let (fa, fb) = (a - libm::floor(a), b - libm::floor(b));
    let seam = if fa.min(fb) < 0.03 { 0.8 } else { 1.0 };
    let square = 0.9 + 0.16 * tile(u, v, [12, 4], 57);
    shade(mix(hex(0x00c8_8c30), hex(0x00f8_c860), cloud(u, v, 6, 58)), seam * square)
}

fn bronze(u: f64, v: f64) -> [f64; 3] {
    let patina = ramp(0.52, 0.72, cloud(u, v, 5, 61));
    mix(
        mix(hex(0x008a_6238), hex(0x00c0_9258), cloud(u, v, 8, 62)),
        hex(0x0058_8070),
        0.55 * patina,
    )
}

/// Vermilion, bleached and scuffed in places.
fn lacquer(u: f64, v: f64) -> [f64; 3] {
    let c = mix(hex(0x00a8_2a16), hex(0x00d2_4424), cloud(u, v, 4, 65));
    let (d, n) = cells(u, v, 14, 66);
    let chip = if d < 0.12 && n > 0.8 { 0.5 } else { 1.0 };
    let streak = ramp(0.62, 0.8, tile_fbm(u, v, [24, 3], 67));
    shade(mix(c, hex(0x0078_2014), 0.5 * streak), chip)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_more_than_forty_textures_and_their_names_differ() {
        let mut names: Vec<&str> = PICTURES
            .iter()
            .chain(super::super::flora::PICTURES)
            .map(|picture| picture.name)
            .collect();
        let all = names.len();
        names.sort_unstable();
        names.dedup();
        assert!(all >= 40 && names.len() == all, "{all}");
    }

    #[test]
    fn cut_outs_are_partly_there_and_crests_are_drawn() {
        for picture in super::super::flora::PICTURES {
            let cut = ["blossom", "petal", "leaf", "spray"]
                .iter()
                .any(|kind| picture.name.starts_with(kind));
            let image = picture.paint();
            let there = image.pixels().filter(|p| p.0[3] > 127).count() as f64
                / image.pixels().len() as f64;
            let wanted = if cut { 0.1..0.95 } else { 1.0..1.1 };
            assert!(wanted.contains(&there), "{}: {there}", picture.name);
        }
        let area = (0..4096)
            .filter(|k| blossom_crest(f64::from(k % 64) / 64.0, f64::from(k / 64) / 64.0) > 0.5);
        assert!((600..2600).contains(&area.count()));
    }
}
