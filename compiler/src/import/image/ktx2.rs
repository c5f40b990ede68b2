//! KTX2 textures of Basis Universal, ETC1S or UASTC, become bytes: what glTF has by `KHR_texture_basisu`.
//!
//! The largest level is decoded. Everything of the header that says how much memory is needed, or where something is, is
//! checked here before the decoder sees it. UASTC under Zstandard is inflated here, a block at a time, so that a frame of
//! a few bytes cannot become more than the texture has.

use super::format::{broken, checked_size, kept};
use super::texels::{Image, Pixels, n_pixels};
use crate::import::budget::zeroed;
use crate::import::error::{ErrorKind, ImportError};
use crate::import::file::Limits;
use basisu::{DecodeFlags, SourceFormat, TargetFormat, Transcoder};
use ruzstd::decoding::{BlockDecodingStrategy, FrameDecoder};

/// Bytes of the header, and of the first entry of the index of levels behind it.
const HEAD: usize = 80 + 24;
/// Where the header says how the levels are compressed, how many there are, and where keys and values are.
const LEVELS: usize = 40;
const SCHEME: usize = 44;
const KEYS: usize = 56;
/// Zstandard, among the schemes.
const ZSTANDARD: u32 = 2;
/// Texels of a block along a side, and the bytes of a block of UASTC.
const BLOCK: u64 = 4;
const BLOCK_BYTES: u64 = 16;
/// Memory for codebooks and tables.
const TABLES: u64 = 8 << 20;

/// What the header says of the largest level.
struct Head {
    size: [u32; 2],
    scheme: u32,
    level: std::ops::Range<usize>,
    inflated: u64,
}

/// Width and height.
pub(super) fn size(bytes: &[u8], place: &str, limits: &Limits) -> Result<[u32; 2], ImportError> {
    Ok(head(bytes, place, limits)?.size)
}

/// Decodes the largest level.
pub(super) fn decode(bytes: &[u8], place: &str, limits: &Limits) -> Result<Image, ImportError> {
    let head = head(bytes, place, limits)?;
    let kept = kept(head.size, 4, place, limits)?;
    let n_bytes = (bytes.len() as u64).saturating_add(blocks_bytes(head.size).saturating_mul(3));
    let _loan = limits.memory.take(n_bytes.saturating_add(TABLES), place)?;
    let file = plain(bytes, &head, place)?;
    let damaged = |_| broken(place, &"its blocks make no sense");
    let texture = Transcoder::new(&file).map_err(damaged)?;
    if !matches!(texture.source_format(), SourceFormat::Etc1s | SourceFormat::UastcLdr) {
        return Err(foreign(place, "texels that are neither ETC1S nor UASTC"));
    }
    let mut texels: Vec<u8> = zeroed(4 * n_pixels(head.size), place)?;
    let flags = DecodeFlags::NONE;
    texture.transcode_into(0, TargetFormat::Rgba32, flags, &mut texels).map_err(damaged)?;
    kept.keep();
    let has_alpha = texels.chunks_exact(4).any(|texel| texel[3] < u8::MAX);
    let [width, height] = head.size;
    let data = Pixels::Rgba8(texels);
    Ok(Image { width, height, data, has_alpha, clamped: 0, is_radiance: false })
}

fn foreign(place: &str, what: &str) -> ImportError {
    let message = format!("this KTX2 image has {what}; those of Basis Universal are read");
    ImportError::new(ErrorKind::Image, place, message)
        .with_help("convert it to PNG, or encode it with `basisu -ktx2`")
}

/// The header, of which each part that lies in the file does so.
fn head(bytes: &[u8], place: &str, limits: &Limits) -> Result<Head, ImportError> {
    let cut_off = || broken(place, &"it ends in its header");
    let head: &[u8; HEAD] = bytes.first_chunk().ok_or_else(cut_off)?;
    let word = |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
    let long = |at: usize| u64::from(word(at)) | u64::from(word(at + 4)) << 32;
    let inside = |offset: u64, length: u64| {
        let start = usize::try_from(offset).ok()?;
        let end = usize::try_from(offset.checked_add(length)?).ok()?;
        bytes.get(start..end).map(|_| start..end)
    };
    if word(12) != 0 {
        return Err(foreign(place, &format!("texels of the Vulkan format {}", word(12))));
    }
    let size = checked_size(word(20), word(24), place, limits)?;
    if (word(28), word(36)) != (0, 1) || word(32) > 1 {
        return Err(foreign(place, "layers, faces or depth"));
    }
    let outside = || broken(place, &"its parts are not inside it");
    let descriptor = inside(word(48).into(), word(52).into());
    let tables = inside(long(64), long(72));
    let (Some(_), Some(_)) = (descriptor, tables) else { return Err(outside()) };
    let level = inside(long(80), long(88)).ok_or_else(outside)?;
    let (scheme, inflated) = (word(SCHEME), long(96));
    if scheme == ZSTANDARD && inflated != blocks_bytes(size) {
        return Err(broken(place, &"its largest level has not the length of its size"));
    }
    Ok(Head { size, scheme, level, inflated })
}

/// Bytes of all blocks of a level of UASTC; those of ETC1S have half of that.
fn blocks_bytes(size: [u32; 2]) -> u64 {
    let [across, down] = size.map(|texels| u64::from(texels).div_ceil(BLOCK));
    across.saturating_mul(down).saturating_mul(BLOCK_BYTES)
}

/// The file with its largest level as it is without Zstandard, and without keys and values, which say nothing of texels.
fn plain(bytes: &[u8], head: &Head, place: &str) -> Result<Vec<u8>, ImportError> {
    let mut file = bytes.to_vec();
    file[KEYS..KEYS + 8].fill(0);
    if head.scheme == ZSTANDARD {
        let level = inflate(&bytes[head.level.clone()], head.inflated)
            .ok_or_else(|| broken(place, &"its largest level cannot be inflated"))?;
        let (offset, length) = (file.len() as u64, head.inflated);
        file[SCHEME..SCHEME + 4].fill(0);
        file[LEVELS..LEVELS + 4].copy_from_slice(&1_u32.to_le_bytes());
        for (at, value) in [(80, offset), (88, length), (96, length)] {
            file[at..at + 8].copy_from_slice(&value.to_le_bytes());
        }
        file.extend_from_slice(&level);
    }
    Ok(file)
}

/// `length` bytes out of one frame of Zstandard; `None` if it holds more, or less, or is damaged.
fn inflate(mut frame: &[u8], length: u64) -> Option<Vec<u8>> {
    const ONE: BlockDecodingStrategy = BlockDecodingStrategy::UptoBlocks(1);
    /// Some encoders have no smaller one.
    const LEAST_WINDOW: u64 = 8 << 20;
    let mut decoder = FrameDecoder::new();
    decoder.set_max_window_size(length.max(LEAST_WINDOW));
    decoder.init(&mut frame).ok()?;
    let length = usize::try_from(length).ok()?;
    let mut out = Vec::new();
    while !decoder.is_finished() {
        decoder.decode_blocks(&mut frame, ONE).ok()?;
        out.extend(decoder.collect().unwrap_or_default());
        if out.len() > length {
            return None;
        }
    }
    out.extend(decoder.collect().unwrap_or_default());
    (out.len() == length).then_some(out)
}
