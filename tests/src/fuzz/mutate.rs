//! Seeds → damaged inputs: bits, numbers, cuts, repeats, pieces of other seeds, words of the format.
//!
//! It knows nothing of the format but its words and its repair, and needs no instrumented build: what
//! is kept as a new seed is decided by the words of the refusal (see [`Mutator::learn`]).

use std::collections::BTreeSet;

use super::{Seed, Target};

/// Longer inputs are cut: readers are to be asked often.
const MAX_LEN: usize = 64 << 10;
/// Most inputs that are kept as further seeds.
const MAX_LEARNED: usize = 4096;

/// Xorshift64*, Vigna 2016.
pub struct Random(u64);

impl Random {
    /// A stream of its own for each seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 16
    }

    /// In `0..n`; 0 when `n` is 0.
    #[expect(clippy::cast_possible_truncation, reason = "below n")]
    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }

    fn byte(&mut self) -> u8 {
        self.next().to_le_bytes()[0]
    }

    fn pick<'a, T>(&mut self, list: &'a [T]) -> Option<&'a T> {
        list.get(self.below(list.len()))
    }
}

/// Numbers at the edge of what fields hold.
const NUMBERS: [u64; 18] = [
    0,
    1,
    0x7f,
    0x80,
    0xff,
    0x7fff,
    0x8000,
    0xffff,
    0x0001_0000,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_ffff,
    0x1_0000_0000,
    0x7f80_0000, // infinity in f32
    0x7fc0_0000, // NaN in f32
    0x7ff8_0000_0000_0000,
    i64::MAX as u64,
    u64::MAX,
];

/// The same as text.
const NUMERALS: [&str; 14] = [
    "0",
    "-1",
    "1e38",
    "1e-45",
    "nan",
    "inf",
    "4294967296",
    "-9223372036854775808",
    "18446744073709551615",
    "1e400",
    "0.1",
    "",
    "7/",
    "-0",
];

/// Makes inputs of one target.
pub struct Mutator {
    target: &'static Target,
    seeds: Vec<Vec<u8>>,
    /// Which of them are accepted: damage to those gets furthest.
    accepted: Vec<usize>,
    n_given: usize,
    random: Random,
    heard: BTreeSet<String>,
}

impl Mutator {
    /// Starts from these seeds; the same inputs for the same `seed`.
    #[must_use]
    pub fn new(target: &'static Target, seeds: &[Seed], seed: u64) -> Self {
        let good = |(i, seed): (usize, &Seed)| (seed.is_good() == Some(true)).then_some(i);
        let accepted = seeds.iter().enumerate().filter_map(good).collect();
        let seeds: Vec<_> = seeds.iter().map(|seed| seed.bytes.clone()).collect();
        let (n_given, random) = (seeds.len(), Random::new(seed));
        Self { target, seeds, accepted, n_given, random, heard: BTreeSet::new() }
    }

    /// The next input.
    pub fn make(&mut self) -> Vec<u8> {
        let any = self.random.below(self.seeds.len());
        let good = self.random.pick(&self.accepted).copied().unwrap_or(any);
        let from = if self.random.below(4) == 0 { any } else { good };
        let mut bytes = self.seeds.get(from).cloned().unwrap_or_default();
        let is_text = bytes.is_ascii();
        // Mostly few changes, sometimes many.
        let most = [1, 1, 2, 4, 4, 32][self.random.below(6)];
        for _ in 0..=self.random.below(most) {
            if is_text && self.random.below(2) == 0 {
                self.change_text(&mut bytes);
            } else {
                self.change(&mut bytes);
            }
        }
        bytes.truncate(MAX_LEN);
        if self.random.below(4) != 0 {
            (self.target.repair)(&mut bytes);
        }
        bytes
    }

    /// Keeps an input whose outcome was never heard before as a seed; returns whether it was new.
    /// Two refusals are the same if they differ only in numbers and in what they quote.
    pub fn learn(&mut self, input: &[u8], outcome: &Result<(), String>) -> bool {
        let heard = match outcome {
            Ok(()) => "accepted".to_owned(),
            Err(refusal) => gist(refusal),
        };
        let new = self.seeds.len() < self.n_given + MAX_LEARNED && self.heard.insert(heard);
        if new {
            if outcome.is_ok() {
                self.accepted.push(self.seeds.len());
            }
            self.seeds.push(input.to_vec());
        }
        new
    }

    /// How many different outcomes were heard.
    #[must_use]
    pub fn outcomes(&self) -> usize {
        self.heard.len()
    }

    fn change(&mut self, bytes: &mut Vec<u8>) {
        let random = &mut self.random;
        let at = random.below(bytes.len() + 1);
        let end = |length: usize| bytes.len().min(at + length);
        match random.below(9) {
            0 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
            1 if at < bytes.len() => bytes[at] = random.byte(),
            2 => bytes.truncate(at),
            3 => {
                let piece = bytes[at..end(random.below(64))].to_vec();
                let to = random.below(bytes.len() + 1);
                bytes.splice(to..to, piece);
            }
            4 => drop(bytes.drain(at..end(random.below(16)))),
            5 => {
                let other = self.seeds.get(random.below(self.seeds.len())).cloned();
                let other = other.unwrap_or_default();
                let from = random.below(other.len() + 1);
                let to = other.len().min(from + random.below(256));
                let over = end(if random.below(2) == 0 { to - from } else { 0 });
                bytes.splice(at..over, other[from..to].iter().copied());
            }
            6 => {
                let word = random.pick(self.target.words).copied().unwrap_or_default();
                let over = end(if random.below(2) == 0 { word.len() } else { 0 });
                bytes.splice(at..over, word.iter().copied());
            }
            7 => {
                let run = 1 + random.below(40);
                let byte = random.byte();
                bytes.splice(at..at, std::iter::repeat_n(byte, run));
            }
            _ => self.put_number(bytes, at),
        }
    }

    /// Overwrites 1, 2, 4 or 8 bytes, in either order.
    fn put_number(&mut self, bytes: &mut [u8], at: usize) {
        let random = &mut self.random;
        let mut number = random.pick(&NUMBERS).copied().unwrap_or_default();
        if random.below(4) == 0 {
            number = number.wrapping_add(random.below(16) as u64).wrapping_sub(8);
        }
        let width = 1 << random.below(4);
        let mut value = number.to_le_bytes();
        let value = &mut value[..width];
        if random.below(2) == 0 {
            value.reverse();
        }
        if let Some(place) = bytes.get_mut(at..at + width) {
            place.copy_from_slice(value);
        }
    }

    /// Repeats, drops, moves or replaces a word.
    fn change_text(&mut self, bytes: &mut Vec<u8>) {
        let random = &mut self.random;
        let is_end = |byte: &u8| b" \n,/(){}[]:\"".contains(byte);
        let mut words: Vec<Vec<u8>> = bytes.split_inclusive(is_end).map(<[u8]>::to_vec).collect();
        if words.is_empty() {
            return;
        }
        let at = random.below(words.len());
        match random.below(6) {
            0 => words.insert(at, words[at].clone()),
            1 => drop(words.remove(at)),
            2 => {
                let other = random.below(words.len());
                words.swap(at, other);
            }
            3 => {
                let end = words[at].last().copied().filter(|byte| is_end(byte));
                let numeral = random.pick(&NUMERALS).copied().unwrap_or_default();
                words[at] = numeral.bytes().chain(end).collect();
            }
            4 => {
                let word = random.pick(self.target.words).copied().unwrap_or_default();
                words.insert(at, word.to_vec());
            }
            _ => {
                // A piece of the text many times over.
                let end = words.len().min(at + 1 + random.below(6));
                let piece = words[at..end].concat();
                let times = 1 + random.below(30);
                words.insert(at, piece.repeat(times));
            }
        }
        *bytes = words.concat();
    }
}

/// A refusal without its numbers and quotes.
fn gist(refusal: &str) -> String {
    let quoted = refusal.split('`').step_by(2).collect::<Vec<_>>().join("`");
    quoted.chars().filter(|c| !c.is_ascii_digit()).take(80).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fuzz::TARGETS;

    #[test]
    fn the_same_seed_gives_the_same_inputs() {
        for target in TARGETS {
            let seeds = [Seed { name: String::new(), bytes: b"v 1 2 3\nv 4 5 6\n".to_vec() }];
            let inputs = |seed: u64| {
                let mut mutator = Mutator::new(target, &seeds, seed);
                (0..100).map(|_| mutator.make()).collect::<Vec<_>>()
            };
            assert_eq!(inputs(1), inputs(1));
            assert_ne!(inputs(1), inputs(2));
        }
    }

    #[test]
    fn outcomes_that_differ_in_numbers_and_quotes_are_the_same() {
        let target = &TARGETS[0];
        let mut mutator = Mutator::new(target, &[], 1);
        let mut learn = |text: &str| mutator.learn(b"x", &Err(text.to_owned()));
        assert!(learn("line 3: no `a`"));
        assert!(!learn("line 14: no `b`"));
        assert!(learn("line 14: two `b`"));
        assert_eq!(mutator.outcomes(), 2);
    }
}
