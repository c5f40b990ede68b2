//! Colours at the corners of triangles.

use super::field::abi_struct;

abi_struct! {
    /// Colours and alpha at the corners of a triangle, 16 bytes, one record a triangle. Of a linear channel the square
    /// root is stored, in 11 bits; of alpha itself, in 9.
    pub struct VertexColors {
        /// Of each corner: red in bits 0-10, green in bits 11-21, the upper ten bits of blue in bits 22-31.
        pub high: [u32; 3],
        /// Of corner k, from bit 10 k on: the lowest bit of blue, then alpha. Bits 30 and 31 are 0.
        pub low: u32,
    }
}

impl VertexColors {
    /// What triangles have that have no colours: 1 in every channel.
    pub const WHITE: Self = Self { high: [u32::MAX; 3], low: Self::LOW };

    /// The bits of `low` that mean something.
    pub const LOW: u32 = (1 << 30) - 1;

    /// Of linear red, green and blue, and alpha, at each corner, 0 ..= 1: colours off by 0.0005 at most, alpha by 0.001.
    #[must_use]
    pub fn of(corners: [[f32; 4]; 3]) -> Self {
        let mut record = Self::default();
        for (k, [r, g, b, a]) in corners.into_iter().enumerate() {
            let [r, g, b] = [r, g, b].map(|x| steps(x.clamp(0.0, 1.0).sqrt(), 2047.0));
            record.high[k] = r | g << 11 | (b >> 1) << 22;
            record.low |= (b & 1 | steps(a.clamp(0.0, 1.0), 511.0) << 1) << (10 * k);
        }
        record
    }
}

/// The whole number of steps next to `x`, 0 ..= 1, when there are `n`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ..= n")]
fn steps(x: f32, n: f32) -> u32 {
    (x * n).round() as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_white_and_black_is_nothing() {
        assert_eq!(VertexColors::of([[1.0; 4]; 3]), VertexColors::WHITE);
        assert_eq!(VertexColors::of([[0.0; 4]; 3]), VertexColors::default());
        assert_eq!(VertexColors::of([[f32::NAN; 4]; 3]), VertexColors::default());
    }

    #[test]
    fn channels_have_bits_of_their_own() {
        let mut seen = 0_u128;
        for corner in 0..3 {
            for channel in 0..4 {
                let mut corners = [[0.0; 4]; 3];
                corners[corner][channel] = 1.0;
                let VertexColors { high: [a, b, c], low } = VertexColors::of(corners);
                let bits =
                    [a, b, c, low].iter().fold(0, |bits, word| bits << 32 | u128::from(*word));
                assert_eq!(seen & bits, 0, "{corner} {channel}");
                seen |= bits;
            }
        }
        assert_eq!(seen.count_ones(), 126);
    }
}
