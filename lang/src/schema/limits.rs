//! Limits and values that many fields share.

/// Longest name of a light group: it is part of the names of channels.
pub const MAX_GROUP: usize = 40;

/// Largest width or height of a film, in pixels.
pub const MAX_FILM_SIDE: u32 = 65_536;

/// No number of a scene may be larger, in SI: it must still fit a 32-bit float after squaring.
pub const MAX_MAGNITUDE: f64 = 1e15;

/// No limit above the general one.
pub(crate) const ANY: f64 = f64::INFINITY;
pub(crate) const WHITE: [f64; 3] = [1.0; 3];
