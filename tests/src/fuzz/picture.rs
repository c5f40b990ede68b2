//! What `rtr` reads again: parts of a picture, which it merges, and checkpoints, which it resumes.

use std::fs;
use std::path::Path;

use runtime::output::{Picture, merge, read_exr, write};
use runtime::{Checkpoint, SampleRange};

pub(super) const CHECKPOINT_WORDS: &[&[u8]] = &[
    b"size 65535x65535\n",
    b"crop 0,0,65535,65535\n",
    b"done ",
    b"samples 0..4294967295\n",
    b"seconds nan\n",
    b"seconds inf\n",
    b"rays 18446744073709551615\n",
    b"first_bad 0,0,0\n",
    b"seed ",
    b"\n",
    b"0..16",
    b",",
    b"4294967295",
];

/// Bytes before the text of a checkpoint.
pub(super) const HEADER: usize = 48;

pub(super) fn part(folder: &Path, bytes: &[u8]) -> Result<(), String> {
    let path = folder.join("part.exr");
    fs::write(&path, bytes).map_err(|e| e.to_string())?;
    let read = |path: &Path| {
        // The folder is another one each time, and no part of what was said.
        let clean = |e: String| e.replace(&folder.display().to_string(), "").replace('\n', " ");
        read_exr(path).map_err(|error| clean(error.to_string()))
    };
    let picture = read(&path)?;
    assert_whole(&picture);
    let copy = folder.join("copy.exr");
    write(&copy, &picture, true).expect("what was read can be written");
    let again = read(&copy).expect("what was written can be read");
    assert_eq!(again.meta, picture.meta);
    assert_eq!(again.film.ranges, picture.film.ranges);
    assert_eq!(again.film.counts, picture.film.counts);

    merge(vec![picture.clone()]).map_err(|error| error.to_string())?;
    let twice = merge(vec![picture.clone(), picture.clone()]).map(|_| ());
    twice.expect_err("the same samples twice are no picture");
    let mut rest = picture.clone();
    let after = picture.film.ranges.last().map_or(0, |range| range.end);
    let (most, _) = picture.film.samples();
    // The same number of samples, behind the last.
    let Some(range) = after.checked_add(most).and_then(|end| SampleRange::new(after, end)) else {
        return Err("no room for samples behind the last".to_owned());
    };
    rest.film.ranges = vec![range];
    let whole = merge(vec![rest, picture]).map_err(|error| error.to_string())?;
    assert_whole(&whole);
    assert_eq!(whole.film.samples(), (2 * most, 2 * most));
    Ok(())
}

fn assert_whole(picture: &Picture) {
    let film = &picture.film;
    assert!(film.region.fits(film.image_size));
    let n_pixels = usize::try_from(film.region.pixels()).expect("it is in memory");
    assert_eq!((film.sums.len(), film.counts.len()), (n_pixels, n_pixels));
    assert!(film.variance.is_empty() || film.variance.len() == n_pixels);
}

pub(super) fn checkpoint(folder: &Path, bytes: &[u8]) -> Result<(), String> {
    let path = folder.join("a.checkpoint");
    let read = || {
        let clean = |e: String| e.replace(&folder.display().to_string(), "");
        let found = Checkpoint::read(&path).map_err(|error| clean(error.to_string()))?;
        Ok::<_, String>(found.expect("the file is there"))
    };
    fs::write(&path, bytes).map_err(|e| e.to_string())?;
    let checkpoint = read()?;
    assert!(Checkpoint::can_hold(&checkpoint.film, checkpoint.samples));
    assert!(checkpoint.seconds >= 0.0 && checkpoint.seconds.is_finite());
    assert_eq!(checkpoint.film.sums.len() as u64, checkpoint.film.region.pixels());
    checkpoint.write(&path).expect("what was read can be written");
    let again = read().expect("what was written can be read");
    let bits =
        |c: &Checkpoint| c.film.sums.iter().flatten().map(|sum| sum.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&again), bits(&checkpoint));
    assert_eq!((&again.identity, again.samples), (&checkpoint.identity, checkpoint.samples));
    assert_eq!(again.film.counters, checkpoint.film.counters);
    Ok(())
}

/// Makes the checksum true again, as `runtime/src/checkpoint.rs` describes the layout.
pub(super) fn repair_checkpoint(bytes: &mut [u8]) {
    if let Some((head, rest)) = bytes.split_at_mut_checked(HEADER) {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&head[..16]).update(rest);
        head[16..48].copy_from_slice(hasher.finalize().as_bytes());
    }
}
