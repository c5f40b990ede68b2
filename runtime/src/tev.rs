//! Pictures → packets of tev, the image viewer, over whatever carries them.
//!
//! tev listens on a TCP port (14158) and documents its packets in `src/Ipc.cpp`. A packet is its length in bytes as a
//! `u32`, that of the length included, then a byte that names what it is, then its fields. Numbers are little-endian,
//! texts end with a zero byte. This module knows neither sockets nor the command line.

use crate::output::Picture;
use std::io::{self, Write};

/// The port on which tev listens unless it is told otherwise.
pub(crate) const PORT: u16 = 14158;

/// `CreateImage`.
const CREATE: u8 = 4;
/// `UpdateImageV3`: several channels, each with an offset and a stride in the data.
const UPDATE: u8 = 6;
const CHANNELS: [&str; 3] = ["R", "G", "B"];
/// Pixels of a packet, about: 12 MB.
const PIXELS: usize = 1 << 20;

/// A packet on its way.
struct Packet(Vec<u8>);

impl Packet {
    fn new(kind: u8) -> Self {
        Self(vec![0, 0, 0, 0, kind])
    }

    fn byte(mut self, byte: u8) -> Self {
        self.0.push(byte);
        self
    }

    /// A text, which ends where a zero byte is.
    fn text(mut self, text: &str) -> Self {
        self.0.extend(text.bytes().take_while(|byte| *byte != 0));
        self.byte(0)
    }

    fn number(mut self, number: u32) -> Self {
        self.0.extend(number.to_le_bytes());
        self
    }

    fn long(mut self, number: u64) -> Self {
        self.0.extend(number.to_le_bytes());
        self
    }

    fn channels(self) -> Self {
        CHANNELS.iter().fold(self, |packet, name| packet.text(name))
    }

    fn send(mut self, out: &mut dyn Write) -> io::Result<()> {
        let len = u32::try_from(self.0.len()).map_err(io::Error::other)?;
        self.0[..4].copy_from_slice(&len.to_le_bytes());
        out.write_all(&self.0)
    }
}

/// Makes a black image called `name`, or puts it in the place of the one that has the name, and shows it.
pub(crate) fn create(out: &mut dyn Write, name: &str, size: [u32; 2]) -> io::Result<()> {
    let [w, h] = size;
    let packet = Packet::new(CREATE).byte(1).text(name).number(w).number(h);
    packet.number(3).channels().send(out)
}

/// Sends the pixels of a picture to the image called `name`: linear, no exposure.
pub(crate) fn update(out: &mut dyn Write, name: &str, picture: &Picture) -> io::Result<()> {
    let film = &picture.film;
    let region = film.region;
    let width = region.w as usize;
    let rows = (PIXELS / width.max(1)).max(1);
    let means = picture.shown();
    for (band, y) in means.chunks(rows * width.max(1)).zip((region.y..).step_by(rows)) {
        let height = u32::try_from(band.len() / width.max(1)).unwrap_or(0);
        let packet = Packet::new(UPDATE).byte(0).text(name).number(3).channels();
        let packet = packet.number(region.x).number(y).number(region.w).number(height);
        let packet = [0, 1, 2].into_iter().fold(packet, Packet::long);
        let mut packet = [3; 3].into_iter().fold(packet, Packet::long);
        #[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose")]
        let values = band.as_flattened().iter().flat_map(|mean| (*mean as f32).to_le_bytes());
        packet.0.extend(values);
        packet.send(out)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Film;
    use crate::output::Meta;
    use crate::region::Rect;

    #[test]
    fn packets_are_those_that_tev_documents() {
        let mut sent = Vec::new();
        create(&mut sent, "a", [2, 3]).unwrap();
        let expected = b"\x1a\0\0\0\x04\x01a\0\x02\0\0\0\x03\0\0\0\x03\0\0\0R\0G\0B\0";
        assert_eq!(sent, expected);

        let mut film = Film::new([2, 3], Rect { x: 1, y: 2, w: 1, h: 1 });
        (film.sums[0], film.counts[0]) = ([2.0, 4.0, 1.0], 2);
        sent.clear();
        update(&mut sent, "a", &Picture::new(film, Meta::default())).unwrap();
        let mut expected = b"\x06\0a\0\x03\0\0\0R\0G\0B\0".to_vec();
        expected.extend([1_u32, 2, 1, 1].map(u32::to_le_bytes).as_flattened());
        expected.extend([0_u64, 1, 2, 3, 3, 3].map(u64::to_le_bytes).as_flattened());
        expected.extend([1_f32, 2.0, 0.5].map(f32::to_le_bytes).as_flattened());
        assert_eq!(sent[..4], u32::try_from(expected.len() + 4).unwrap().to_le_bytes());
        assert_eq!(sent[4..], expected);
    }

    #[test]
    fn a_large_picture_is_sent_in_bands() {
        let side = 1025;
        let film = Film::new([side; 2], Rect::whole([side; 2]));
        let mut sent = Vec::new();
        update(&mut sent, "a", &Picture::new(film, Meta::default())).unwrap();
        let (mut at, mut heights) = (0, Vec::new());
        while at < sent.len() {
            let number = |i: usize| u32::from_le_bytes(sent[i..i + 4].try_into().unwrap());
            heights.push((number(at + 22), number(at + 30)));
            at += number(at) as usize;
        }
        assert_eq!((at, heights), (sent.len(), vec![(0, 1023), (1023, 2)]));
    }
}
