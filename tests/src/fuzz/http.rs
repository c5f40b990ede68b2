//! What a stranger may send to the port of `rtr view`: requests, and the cameras in them.

use std::io::{self, Read};
use std::path::Path;

use pack::abi::{Camera, CameraKind};
use runtime::view::View;
use runtime::view::http::{MAX_BODY, Request, Status, read};

pub(super) const WORDS: &[&[u8]] = &[
    b"GET ",
    b"POST ",
    b" HTTP/1.1\r\n",
    b"\r\n\r\n",
    b"\r\n",
    b"Host: ",
    b"Host: localhost:1\r\n",
    b"Origin: ",
    b"Content-Length: ",
    b"Transfer-Encoding: chunked\r\n",
    b"4096",
    b"18446744073709551616",
    b"-1",
    b"?x=1&y=2",
    b"&name=",
    b"%00",
    b"1e999",
    b"null",
    b"[0,0,0]",
];

/// Most bytes of an input that is read byte by byte.
const SHORT: usize = 1 << 10;

/// A connection over which bytes come in pieces of one size.
struct Pieces<'a> {
    rest: &'a [u8],
    size: usize,
}

impl Read for Pieces<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let n = self.size.min(self.rest.len()).min(buffer.len());
        let (piece, rest) = self.rest.split_at(n);
        buffer[..n].copy_from_slice(piece);
        self.rest = rest;
        Ok(n)
    }
}

/// Refuses with one of the reader's own words, which do not depend on how the bytes arrive.
pub(super) fn check(_: &Path, bytes: &[u8]) -> Result<(), String> {
    let read_by = |size: usize| read(&mut Pieces { rest: bytes, size });
    let found = read_by(bytes.len().max(1));
    let sizes = [1, bytes.len() / 2 + 1, bytes.len() / 7 + 1];
    for size in sizes.into_iter().filter(|size| *size > 1 || bytes.len() <= SHORT) {
        assert_eq!(read_by(size), found, "in pieces of {size} bytes");
    }
    match found {
        Ok(request) => {
            assert_sound(&request);
            Ok(())
        }
        Err(Status(number, words)) => {
            assert!((400..500).contains(&number), "{number}");
            Err(words.to_owned())
        }
    }
}

fn assert_sound(request: &Request) {
    assert!(request.body.len() <= MAX_BODY);
    assert!(!request.path.contains('?'));
    let lines = [request.host.as_deref(), request.origin.as_deref()];
    assert!(lines.into_iter().flatten().all(|line| !line.contains(['\r', '\n', '\0'])));
    for name in ["x", "name"] {
        let word = request.word(name);
        assert_eq!(request.number(name), word.and_then(|word| word.parse().ok()));
        assert!(word.is_none_or(|word| request.query.contains(word) && !word.contains('&')));
    }
    if let Ok(view) = serde_json::from_slice::<View>(&request.body) {
        for kind in CameraKind::ALL {
            let own = Camera { kind: kind as u32, ..Camera::default() };
            let text = view.text("eye", &own);
            let head = format!("camera eye: {} {{\n", kind.stem());
            assert!(text.starts_with(&head) && text.ends_with("}\n"), "{text}");
        }
    }
}
