//! Bytes of a connection → a request, within limits, however they arrive; an answer → bytes. One request a connection.
//!
//! It knows no addresses, and trusts nothing: heads and bodies are short, and whoever sends them slowly is not waited
//! for.

use std::io::{self, Read, Write};
use std::time::{Duration, Instant};

/// Most bytes of a head. Browsers send one or two thousand.
const MAX_HEAD: usize = 16 << 10;
/// Most lines of a head.
const MAX_LINES: usize = 100;
/// Most bytes of a body: a camera has two hundred.
pub const MAX_BODY: usize = 4 << 10;
/// For the whole of a request.
const PATIENCE: Duration = Duration::from_secs(5);

/// A request.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Request {
    /// As it is written: `GET`.
    pub method: String,
    /// From the first slash to the question mark.
    pub path: String,
    /// After the question mark.
    pub query: String,
    /// The header line of this name; at most once.
    pub host: Option<String>,
    /// Likewise.
    pub origin: Option<String>,
    /// At most `MAX_BODY` bytes.
    pub body: Vec<u8>,
}

/// A status and its words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Status(pub u16, pub &'static str);

pub(super) const OK: Status = Status(200, "OK");
pub(super) const NO_CONTENT: Status = Status(204, "No Content");
pub(super) const BAD: Status = Status(400, "Bad Request");
pub(super) const FORBIDDEN: Status = Status(403, "Forbidden");
pub(super) const NOT_FOUND: Status = Status(404, "Not Found");
pub(super) const NOT_ALLOWED: Status = Status(405, "Method Not Allowed");
pub(super) const TOO_SLOW: Status = Status(408, "Request Timeout");
pub(super) const CONFLICT: Status = Status(409, "Conflict");
pub(super) const TOO_LARGE: Status = Status(413, "Content Too Large");
pub(super) const TOO_MANY: Status = Status(503, "Service Unavailable");

/// Of every answer: nothing is kept, framed, guessed, or fetched from elsewhere.
const HEADERS: &str = "Connection: close\r\n\
    Cache-Control: no-store\r\n\
    Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
    connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n\
    Cross-Origin-Resource-Policy: same-origin\r\n\
    Cross-Origin-Opener-Policy: same-origin\r\n\
    Referrer-Policy: no-referrer\r\n\
    X-Content-Type-Options: nosniff\r\n";

/// Reads a request.
///
/// # Errors
/// The status that says what is wrong with it.
pub fn read(stream: &mut impl Read) -> Result<Request, Status> {
    let until = Instant::now() + PATIENCE;
    let mut bytes = Vec::new();
    let (mut request, head, length) = loop {
        if let Some(parsed) = parse(&bytes)? {
            break parsed;
        }
        if bytes.len() >= MAX_HEAD {
            return Err(TOO_LARGE);
        }
        more(stream, &mut bytes, until)?;
    };
    if head > MAX_HEAD || length > MAX_BODY {
        return Err(TOO_LARGE);
    }
    while bytes.len() < head + length {
        more(stream, &mut bytes, until)?;
    }
    request.body = bytes.get(head..head + length).unwrap_or_default().to_vec();
    Ok(request)
}

/// The request in a complete head, the length of the head, and that of the body.
fn parse(bytes: &[u8]) -> Result<Option<(Request, usize, usize)>, Status> {
    let mut lines = [httparse::EMPTY_HEADER; MAX_LINES];
    let mut parsed = httparse::Request::new(&mut lines);
    let head = match parsed.parse(bytes) {
        Ok(httparse::Status::Complete(head)) => head,
        Ok(httparse::Status::Partial) => return Ok(None),
        Err(httparse::Error::TooManyHeaders) => return Err(TOO_LARGE),
        Err(_) => return Err(BAD),
    };
    let line = |name: &str| -> Result<Option<String>, Status> {
        let mut found = parsed.headers.iter().filter(|line| line.name.eq_ignore_ascii_case(name));
        let value = found.next().map(|line| std::str::from_utf8(line.value));
        match (value, found.next()) {
            (None, _) => Ok(None),
            (Some(Ok(value)), None) => Ok(Some(value.trim().to_owned())),
            _ => Err(BAD),
        }
    };
    if line("transfer-encoding")?.is_some() {
        return Err(BAD);
    }
    let length = line("content-length")?.map_or(Ok(0), |text| text.parse().map_err(|_| BAD))?;
    let target = parsed.path.unwrap_or_default();
    let (path, query) = target.split_once('?').unwrap_or((target, ""));
    let request = Request {
        method: parsed.method.unwrap_or_default().to_owned(),
        path: path.to_owned(),
        query: query.to_owned(),
        host: line("host")?,
        origin: line("origin")?,
        body: Vec::new(),
    };
    Ok(Some((request, head, length)))
}

fn more(stream: &mut impl Read, bytes: &mut Vec<u8>, until: Instant) -> Result<(), Status> {
    let mut buffer = [0; 2048];
    match stream.read(&mut buffer) {
        _ if Instant::now() > until => Err(TOO_SLOW),
        Ok(0) => Err(BAD),
        Ok(n) => {
            bytes.extend(buffer.iter().take(n));
            Ok(())
        }
        Err(error) if error.kind() == io::ErrorKind::Interrupted => Ok(()),
        Err(_) => Err(TOO_SLOW),
    }
}

impl Request {
    /// The value of a number in the query, as in `x=3&y=4`.
    #[must_use]
    pub fn number(&self, name: &str) -> Option<u32> {
        self.word(name)?.parse().ok()
    }

    /// The value of this name in the query, as it is written.
    #[must_use]
    pub fn word(&self, name: &str) -> Option<&str> {
        let pairs = self.query.split('&').filter_map(|pair| pair.split_once('='));
        pairs.into_iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }
}

/// Sends an answer.
///
/// # Errors
/// When nobody listens any more.
pub(super) fn respond(
    stream: &mut impl Write,
    status: Status,
    kind: &str,
    body: &[u8],
) -> io::Result<()> {
    let Status(number, words) = status;
    let head = format!(
        "HTTP/1.1 {number} {words}\r\n{HEADERS}Content-Type: {kind}\r\nContent-Length: {}\r\n\r\n",
        body.len()
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(body)?;
    stream.flush()
}

/// Begins a stream of server-sent events.
///
/// # Errors
/// As `respond`.
pub(super) fn begin_events(stream: &mut impl Write) -> io::Result<()> {
    let head = format!("HTTP/1.1 200 OK\r\n{HEADERS}Content-Type: text/event-stream\r\n\r\n");
    stream.write_all(head.as_bytes())?;
    stream.flush()
}

/// Sends an event; `None`: a comment, which shows whether anybody listens.
///
/// # Errors
/// As `respond`.
pub(super) fn event(stream: &mut impl Write, line: Option<&str>) -> io::Result<()> {
    let text = line.map_or(":\n\n".to_owned(), |line| format!("data: {line}\n\n"));
    stream.write_all(text.as_bytes())?;
    stream.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_text(text: &str) -> Result<Request, Status> {
        read(&mut text.as_bytes())
    }

    #[test]
    fn a_request_is_read_with_its_body() {
        let text = "POST /a/b?x=3&y=04 HTTP/1.1\r\nHost: localhost:1\r\nORIGIN: http://a\r\nContent-Length: 2\r\n\r\n{}";
        let request = read_text(text).unwrap();
        assert_eq!((request.method.as_str(), request.path.as_str()), ("POST", "/a/b"));
        assert_eq!(
            (request.number("x"), request.number("y"), request.number("z")),
            (Some(3), Some(4), None)
        );
        assert_eq!(
            (request.host.as_deref(), request.origin.as_deref()),
            (Some("localhost:1"), Some("http://a"))
        );
        assert_eq!(request.body, b"{}");
    }

    #[test]
    fn what_is_malformed_or_too_large_is_refused() {
        let lines = "a: b\r\n".repeat(MAX_LINES + 1);
        let long = "x".repeat(MAX_HEAD);
        for (text, status) in [
            ("", BAD),
            ("GET /", BAD),
            ("GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", BAD),
            ("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n", BAD),
            ("POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n", BAD),
            ("POST / HTTP/1.1\r\nContent-Length: 9\r\n\r\n{}", BAD),
            ("POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n", TOO_LARGE),
            (&format!("GET / HTTP/1.1\r\n{lines}\r\n"), TOO_LARGE),
            (&format!("GET /{long} HTTP/1.1\r\n\r\n"), TOO_LARGE),
        ] {
            assert_eq!(read_text(text), Err(status), "{}", text.get(..40).unwrap_or(text));
        }
    }
}
