//! Eight or sixteen invocations side by side compute what each computes alone: every bit, in every mask.
#![cfg(target_arch = "x86_64")]
#![expect(unsafe_code, reason = "what the processor can is asked before")]

use glam::{UVec3, UVec4};
use native::{ByHand, Lanes, generate_wide};

macro_rules! generated {
    ($name:ident, $file:literal, $($rules:item)?) => {
        #[allow(
            clippy::all,
            clippy::pedantic,
            dead_code,
            missing_docs,
            non_camel_case_types,
            non_snake_case,
            non_upper_case_globals,
            unreachable_pub,
            unused,
            reason = "generated text"
        )]
        mod $name {
            $($rules)?
            include!(concat!("generated/", $file));
        }
    };
}

#[path = "../src/prelude/single.rs"]
mod single;

generated!(scalar, "lanes.rs", use crate::single::rules as wgsl;);

/// A module with the operations of an instruction set, the wide form of the probe, and a call of it.
macro_rules! in_lanes {
    ($name:ident, $operations:literal, $file:literal, $features:literal) => {
        mod $name {
            use glam::UVec4;

            #[allow(
                clippy::all,
                clippy::pedantic,
                dead_code,
                unreachable_pub,
                unused,
                reason = "as it is pasted"
            )]
            mod v {
                include!(concat!("../src/prelude/", $operations));
                include!("../src/prelude/lanes.rs");
            }
            generated!(wide, $file, use super::v;);

            pub(crate) const LANES: usize = v::LANES;

            /// What the invocations from `first` find in the lanes of `mask`.
            pub(crate) fn together(given: &[UVec4], first: u32, mask: u32) -> Vec<UVec4> {
                let mut found = vec![super::NOTHING; given.len() * super::FOUND];
                // SAFETY: the test asks for these instructions first.
                unsafe { run(given, &mut found, first, mask) };
                found
            }

            /// Four words a lane, `words[word][lane]`, as a row a lane.
            pub(crate) fn in_rows(words: [[u32; LANES]; 4]) -> [[u32; 4]; LANES] {
                // SAFETY: as above.
                let rows = unsafe { turn(words) };
                std::array::from_fn(|lane| rows[lane % 4][lane / 4])
            }

            #[target_feature(enable = $features)]
            fn turn([x, y, z, w]: [[u32; LANES]; 4]) -> [[[u32; 4]; LANES / 4]; 4] {
                v::rows(v::V4 { x: v::u_of(x), y: v::u_of(y), z: v::u_of(z), w: v::u_of(w) })
            }

            #[target_feature(enable = $features)]
            fn run(given: &[UVec4], found: &mut [UVec4], first: u32, mask: u32) {
                let mask = v::b_of(std::array::from_fn(|lane| mask >> lane & 1 == 1));
                let id = v::V3 { x: v::add_u(v::u(first), v::lane()), y: v::u(0), z: v::u(0) };
                wide::Kernel { given, found }.main(mask, id);
            }
        }
    };
}

in_lanes!(avx2, "avx2.rs", "wide/avx2.rs", "avx2,fma,bmi1,bmi2,lzcnt,popcnt");
in_lanes!(
    avx512,
    "avx512.rs",
    "wide/avx512.rs",
    "avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2,bmi1,bmi2,lzcnt,popcnt"
);

/// Words that an invocation finds.
const FOUND: usize = 10;
/// What stands where nobody has written.
const NOTHING: UVec4 = UVec4::splat(0xdead_beef);

/// Numbers that mean something as integers and as floats, many of them awkward.
fn given(n: usize) -> Vec<UVec4> {
    let awkward = [
        0.0,
        -0.0,
        1.0,
        -1.5,
        0.5,
        2.5,
        3.5,
        1e-40,
        f32::MAX,
        f32::MIN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        2_147_483_648.0,
        4_294_967_296.0,
        -2_147_483_648.0,
        4_294_967_040.0,
        16_777_217.0,
        0.1,
    ];
    let mut state = 1_u32;
    let mut next = move || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        state ^ (state >> 15)
    };
    let mut word = move |k: usize| {
        let bits = next();
        let number = |pick: u32| match pick % 3 {
            0 => awkward[(pick / 3) as usize % awkward.len()].to_bits(),
            1 => (((pick % 4096) as f32 - 2048.0) / 64.0).to_bits(),
            _ => pick,
        };
        let small = [0, 1, 2, 3, 0xffff_ffff, 0x8000_0000, 77][(bits >> 8) as usize % 7];
        match k {
            0 | 1 if bits % 4 == 0 => small,
            0 | 1 if bits % 4 == 1 => bits % 40,
            0 | 1 => bits,
            _ => number(bits >> 3),
        }
    };
    (0..n).map(|_| UVec4::new(word(0), word(1), word(2), word(3))).collect()
}

/// What invocation `i` finds alone.
fn alone(given: &[UVec4], i: u32) -> Vec<UVec4> {
    let mut found = vec![NOTHING; given.len() * FOUND];
    let bindings = scalar::Bindings { given, found: &mut found };
    scalar::Kernel::new(bindings).main(UVec3::new(i, 0, 0));
    found[i as usize * FOUND..][..FOUND].to_vec()
}

/// Bits, but those of what is not a number.
fn known(words: &[UVec4]) -> Vec<[u32; 4]> {
    let floats = [1, 2, 3, 5, 9];
    let known = |(k, word): (usize, &UVec4)| {
        word.to_array().map(|bits| {
            let nan = f32::from_bits(bits).is_nan() && *word != NOTHING;
            if floats.contains(&(k % FOUND)) && nan { 0x7fc0_0000 } else { bits }
        })
    };
    words.iter().enumerate().map(known).collect()
}

/// How invocations are computed side by side: as many as there are lanes from the first, in those of a mask.
type Together = fn(&[UVec4], u32, u32) -> Vec<UVec4>;

fn check(lanes: usize, together: Together) {
    let given = given(512);
    let expected: Vec<Vec<UVec4>> = (0..512).map(|i| alone(&given, i)).collect();
    let all = (1 << lanes) - 1;
    for first in (0..512).step_by(lanes) {
        let every: Vec<u32> = (0..256).map(|k| (k * 0x0101) ^ (k << 7)).collect();
        let masks = if first < 32 { every } else { vec![all, 0x5a5a, first, first << 8] };
        for mask in masks {
            let found = together(&given, first, mask & all);
            for lane in 0..lanes {
                let i = first as usize + lane;
                let here = &found[i * FOUND..][..FOUND];
                let nothing = vec![NOTHING; FOUND];
                let active = mask >> lane & 1 == 1;
                let expected = if active { &expected[i] } else { &nothing };
                let what = || format!("invocation {i}, mask {mask:#x}, given {:x?}", given[i]);
                assert_eq!(known(here), known(expected), "{}", what());
            }
        }
    }
}

macro_rules! there {
    ($($name:tt),*) => { $(is_x86_feature_detected!($name))&&* };
}

#[test]
fn every_lane_has_the_bits_of_the_scalar_form_in_every_mask() {
    if there!("avx2", "bmi1", "bmi2", "lzcnt", "popcnt") {
        check(avx2::LANES, avx2::together);
        if there!("avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl") {
            check(avx512::LANES, avx512::together);
        }
    }
}

#[test]
fn the_words_of_each_lane_come_to_lie_together() {
    fn words<const N: usize>() -> ([[u32; N]; 4], [[u32; 4]; N]) {
        let mut next = 0..;
        let rows = [(); N].map(|()| [(); 4].map(|()| next.next().unwrap_or(0)));
        (std::array::from_fn(|word| rows.map(|row| row[word])), rows)
    }
    if there!("avx2", "bmi1", "bmi2", "lzcnt", "popcnt") {
        let (given, expected) = words();
        assert_eq!(avx2::in_rows(given), expected);
        if there!("avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl") {
            let (given, expected) = words();
            assert_eq!(avx512::in_rows(given), expected);
        }
    }
}

/// What has no form in lanes is refused, with its line.
#[test]
fn what_lanes_cannot_do_is_refused() {
    let refused = |body: &str, words: &str| {
        let source = format!(
            "@group(0) @binding(0) var<storage, read_write> out: array<vec4<u32>>;
var<private> state: u32;
@compute @workgroup_size(1) fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    {body}
}}"
        );
        let error = generate_wide(&source, "crate::scalar", Lanes::Avx2, ByHand::default())
            .expect_err("this must be refused");
        assert!(error.message.contains(words), "{error} does not say {words:?}");
        assert_eq!(error.line, 4, "{error}");
    };
    refused("out[id.x] = bitcast<vec4u>(sin(vec4f(id.xxxx)));", "Sin");
    refused("state += id.x;", "private");
    refused("let m = mat2x2f(vec2f(id.xy), vec2f(1.0)); out[0].x = u32(m[1].x);", "number");
}
