//! A request → what the session answers, or one of the page's files; for those that know the token only.

use super::camera::View;
use super::http::{
    BAD, CONFLICT, FORBIDDEN, NO_CONTENT, NOT_ALLOWED, NOT_FOUND, OK, Request, Status,
    begin_events, event, respond,
};
use super::plane::{Absent, Kind};
use super::session::Session;
use std::io::{self, Write};
use std::net::IpAddr;
use std::time::Duration;

const PAGE: &str = include_str!("page/view.html");
const SCRIPT: &str = include_str!("page/view.js");
const LAYERS: &str = include_str!("page/layers.js");
const PLOT: &str = include_str!("page/plot.js");
const STYLE: &str = include_str!("page/view.css");

/// Between two events: as fast as the eye.
const PACE: Duration = Duration::from_millis(30);
/// After this time without news a listener is asked whether it is still there.
const PATIENCE: Duration = Duration::from_secs(5);

const JAVASCRIPT: &str = "text/javascript; charset=utf-8";
const JSON: &str = "application/json";
const TEXT: &str = "text/plain; charset=utf-8";

/// Everything that can be asked for.
const ROUTES: [&str; 11] = [
    "",
    "view.js",
    "layers.js",
    "plot.js",
    "view.css",
    "events",
    "film",
    "layer",
    "pick",
    "camera",
    "stop",
];

/// Who may ask.
pub(super) struct Door {
    /// The first part of every path.
    pub(super) token: String,
    /// Where the server listens.
    pub(super) address: IpAddr,
}

/// Answers a request.
///
/// # Errors
/// When nobody listens any more.
pub(super) fn answer(
    session: &Session,
    door: &Door,
    request: &Request,
    stream: &mut impl Write,
) -> io::Result<()> {
    let Some(route) = door.route(request) else {
        return respond(stream, FORBIDDEN, TEXT, b"forbidden\n");
    };
    match (request.method.as_str(), route) {
        ("GET", "") => respond(stream, OK, "text/html; charset=utf-8", PAGE.as_bytes()),
        ("GET", "view.js") => respond(stream, OK, JAVASCRIPT, SCRIPT.as_bytes()),
        ("GET", "layers.js") => respond(stream, OK, JAVASCRIPT, LAYERS.as_bytes()),
        ("GET", "plot.js") => respond(stream, OK, JAVASCRIPT, PLOT.as_bytes()),
        ("GET", "view.css") => respond(stream, OK, "text/css; charset=utf-8", STYLE.as_bytes()),
        ("GET", "events") => events(session, stream),
        ("GET", "film") => film(session, stream),
        ("GET", "layer") => layer(session, request, stream),
        ("GET", "pick") => pick(session, request, stream),
        ("POST", "camera") => {
            let view = serde_json::from_slice::<Option<View>>(&request.body);
            if view.is_ok_and(|view| session.look(view)) {
                respond(stream, NO_CONTENT, TEXT, b"")
            } else {
                respond(stream, BAD, TEXT, b"this is no camera\n")
            }
        }
        ("POST", "stop") => match serde_json::from_slice::<bool>(&request.body) {
            Ok(is_stopped) => {
                session.stop(is_stopped);
                respond(stream, NO_CONTENT, TEXT, b"")
            }
            Err(_) => respond(stream, BAD, TEXT, b"write true or false\n"),
        },
        (_, route) if ROUTES.contains(&route) => respond(stream, NOT_ALLOWED, TEXT, b""),
        _ => respond(stream, NOT_FOUND, TEXT, b"there is no such thing\n"),
    }
}

/// Answers a request that cannot be read, or not now.
///
/// # Errors
/// As `answer`.
pub(super) fn refuse(status: Status, stream: &mut impl Write) -> io::Result<()> {
    respond(stream, status, TEXT, status.1.as_bytes())
}

/// The state whenever it changes.
fn events(session: &Session, stream: &mut impl Write) -> io::Result<()> {
    begin_events(stream)?;
    let mut seen = u64::MAX;
    while !session.is_over() {
        match session.news(seen, PATIENCE) {
            Some((revision, json)) => {
                seen = revision;
                event(stream, Some(&json))?;
                std::thread::sleep(PACE);
            }
            None => event(stream, None)?,
        }
    }
    Ok(())
}

/// Width, height, samples and id of the newest picture, four 32-bit numbers, then its pixels; little endian.
fn film(session: &Session, stream: &mut impl Write) -> io::Result<()> {
    let Some(shot) = session.shot() else {
        return respond(stream, NO_CONTENT, TEXT, b"");
    };
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the page only asks whether it is another one"
    )]
    let head = [shot.size[0], shot.size[1], shot.samples, shot.id as u32];
    let mut body = Vec::with_capacity(16 + shot.bytes.len());
    body.extend(head.into_iter().flat_map(u32::to_le_bytes));
    body.extend(&shot.bytes);
    respond(stream, OK, "application/octet-stream", &body)
}

/// A layer, or the error of every pixel; see `Plane::bytes`.
fn layer(session: &Session, request: &Request, stream: &mut impl Write) -> io::Result<()> {
    let Some(kind) = request.word("name").and_then(Kind::of_name) else {
        return respond(stream, BAD, TEXT, b"write it as name=depth\n");
    };
    match session.plane(kind) {
        Ok(plane) => respond(stream, OK, "application/octet-stream", &plane.bytes()),
        Err(Absent::Not(why)) => respond(stream, NOT_FOUND, TEXT, format!("{why}\n").as_bytes()),
        Err(Absent::Stale) => respond(stream, CONFLICT, TEXT, b"something else is wanted\n"),
        Err(Absent::Failed(why)) => respond(stream, BAD, TEXT, format!("{why}\n").as_bytes()),
    }
}

fn pick(session: &Session, request: &Request, stream: &mut impl Write) -> io::Result<()> {
    let Some((x, y)) = request.number("x").zip(request.number("y")) else {
        return respond(stream, BAD, TEXT, b"write it as x=31&y=7\n");
    };
    match session.pick([x, y]) {
        None => respond(stream, NOT_FOUND, TEXT, b"there is no scene yet\n"),
        Some(Err(error)) => respond(stream, BAD, TEXT, format!("{error}\n").as_bytes()),
        Some(Ok(pick)) => {
            let json = serde_json::to_vec(&pick).expect("numbers and texts become JSON");
            respond(stream, OK, JSON, &json)
        }
    }
}

impl Door {
    /// What is asked for, after the token; `None` for those who do not know it, for pages of other servers, and for
    /// names that somebody else's name server may have given this machine.
    fn route<'a>(&self, request: &'a Request) -> Option<&'a str> {
        let host = request.host.as_deref().filter(|host| self.is_ours(host))?;
        let origin = request.origin.as_deref();
        if origin.is_some_and(|origin| origin.strip_prefix("http://") != Some(host)) {
            return None;
        }
        let (token, route) = request.path.strip_prefix('/')?.split_once('/')?;
        is_same(token.as_bytes(), self.token.as_bytes()).then_some(route)
    }

    /// Whether a `Host` is this machine under a name that no name server gives: `localhost`, or an address, which is one
    /// of the loopback unless the server listens to others. The port is that of a tunnel, whatever it is.
    fn is_ours(&self, host: &str) -> bool {
        let name = match host.strip_prefix('[') {
            Some(rest) => rest.split_once(']').map_or("", |(name, _)| name),
            None => host.rsplit_once(':').map_or(host, |(name, _)| name),
        };
        name.eq_ignore_ascii_case("localhost")
            || name
                .parse::<IpAddr>()
                .is_ok_and(|ip| ip.is_loopback() || !self.address.is_loopback())
    }
}

/// Compares in a time that does not tell where they differ.
fn is_same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).fold(0, |sum, (a, b)| sum | (a ^ b)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(address: &str, host: &str, origin: Option<&str>, path: &str) -> Option<String> {
        let door = Door { token: "t0ken".to_owned(), address: address.parse().unwrap() };
        let (host, origin) = (Some(host.to_owned()), origin.map(str::to_owned));
        let request = Request { path: path.to_owned(), host, origin, ..Request::default() };
        door.route(&request).map(str::to_owned)
    }

    #[test]
    fn only_this_machine_with_the_token_is_let_in() {
        let (here, all) = ("127.0.0.1", "0.0.0.0");
        let film = Some("film".to_owned());
        for host in
            ["localhost", "localhost:8000", "LOCALHOST:1", "127.0.0.1:80", "[::1]:80", "[::1]"]
        {
            assert_eq!(asked(here, host, None, "/t0ken/film"), film, "{host}");
        }
        for host in
            ["", "evil.example", "localhost.evil.example:80", "10.0.0.7:80", "[::1", "[fe80::1]:80"]
        {
            assert_eq!(asked(here, host, None, "/t0ken/film"), None, "{host}");
        }
        assert_eq!(asked(all, "10.0.0.7:80", None, "/t0ken/film"), film);
        assert_eq!(asked(all, "evil.example", None, "/t0ken/film"), None);
        for path in ["/", "/film", "/t0ken", "/t0keN/film", "/t0ken0/film", "t0ken/film", "//film"]
        {
            assert_eq!(asked(here, "localhost", None, path), None, "{path}");
        }
    }

    #[test]
    fn pages_of_others_are_refused() {
        let asked = |origin| asked("127.0.0.1", "localhost:80", Some(origin), "/t0ken/");
        assert_eq!(asked("http://localhost:80").as_deref(), Some(""));
        for origin in
            ["null", "http://localhost:81", "https://localhost:80", "http://evil.example", ""]
        {
            assert_eq!(asked(origin), None, "{origin}");
        }
    }
}
