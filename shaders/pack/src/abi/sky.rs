//! What a ray sees that leaves the scene.

use super::field::abi_struct;
use super::tag::tags;

tags! {
    /// How `Sky` is to be read.
    pub enum SkyKind {
        /// `zenith` in every direction.
        Constant = 0 as 5 "constant sky",
        /// Three-band gradient with glow and disc around `sun_direction`.
        Gradient = 1 as 6 "gradient sky",
        /// `zenith` times a lat-long image.
        Image = 2 as 52 "image sky",
    }
}

/// `f32` values of SKYTABLE for so many rows and columns: for each row the sum of shares up to and
/// including it; the cosine of the polar angle at each edge between rows, first and last included; for each
/// row its columns' sums of shares. Zeros fill the last word of 16 bytes.
#[must_use]
pub fn sky_table_values(rows: u32, columns: u32) -> u64 {
    let (rows, columns) = (u64::from(rows), u64::from(columns));
    2 * rows + 1 + rows * columns
}

abi_struct! {
    /// Radiance by direction, linear Rec. 709, W/(m2 sr) up to the scene's own scale.
    pub struct Sky {
        /// Radiance straight up; the only colour of a constant sky; the factor on an image.
        pub zenith: [f32; 3],
        /// `SkyKind`.
        pub kind: u32,
        /// Radiance at elevation sine `blend_high`.
        pub middle: [f32; 3],
        /// Sine of the elevation where zenith and middle bands meet.
        pub blend_high: f32,
        /// Radiance at the horizon.
        pub horizon: [f32; 3],
        /// Sine of the elevation where horizon and ground bands meet.
        pub blend_low: f32,
        /// Radiance at elevation sine `blend_ground` and below.
        pub ground: [f32; 3],
        /// Exponent of the wide glow around the sun, `cos^glow_power`.
        pub glow_power: f32,
        /// Unit direction towards the sun; glow and disc are centred here.
        pub sun_direction: [f32; 3],
        /// Exponent of the narrow disc, `cos^disc_power`.
        pub disc_power: f32,
        /// Radiance added at the centre of the glow.
        pub glow: [f32; 3],
        /// Sine of the elevation where the ground band ends; less than -1 if it does not.
        pub blend_ground: f32,
        /// Radiance added at the centre of the disc.
        pub disc: [f32; 3],
        /// Turns from azimuth to the column of image and table: u = azimuth + rotation, azimuth from -z to +x.
        pub rotation: f32,
        /// Image of an image sky, wrapped along u; `NONE` for other kinds.
        pub texture: u32,
        /// Index of the sky in the light table; `NONE`: it is found by chance only, and there is no SKYTABLE.
        pub light: u32,
        /// Rows and columns of SKYTABLE; 0 without.
        pub rows: u32,
        /// See `rows`.
        pub columns: u32,
        /// 1: rays that come straight from the camera find it black.
        pub unseen: u32,
        /// Unused.
        pub _pad0: u32,
        /// Unused.
        pub _pad1: u32,
        /// Unused.
        pub _pad2: u32,
    }
}
