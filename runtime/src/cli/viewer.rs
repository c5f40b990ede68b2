//! `--tev HOST:PORT`: an image in tev, which is kept up to date as long as tev is there.
//!
//! Whatever goes wrong is told once; the run does not depend on it.

use super::console::Console;
use crate::output::Picture;
use crate::tev;
use std::io::{self, BufWriter, Write as _};
use std::net::{SocketAddr, TcpStream, ToSocketAddrs as _};
use std::time::Duration;

/// How long tev may take to answer, and to take what it is sent.
const PATIENCE: Duration = Duration::from_secs(2);

/// An image in tev.
pub(super) struct Viewer {
    console: Console,
    /// As the user names it.
    place: String,
    /// Of the image.
    name: String,
    /// `None`: it is not there, and that has been said.
    stream: Option<TcpStream>,
}

impl Viewer {
    /// Opens an image of this name and size.
    pub(super) fn new(console: &Console, place: &str, name: &str, size: [u32; 2]) -> Self {
        let (console, place, name) = (console.clone(), place.to_owned(), name.to_owned());
        let mut viewer = Self { console, place, name, stream: None };
        match connect(&viewer.place) {
            Ok(stream) => viewer.stream = Some(stream),
            Err(error) => viewer.complain(&error, "is it running, with this --host?"),
        }
        viewer.send(|out, name| tev::create(out, name, size));
        viewer
    }

    /// Shows a picture.
    pub(super) fn show(&mut self, picture: &Picture) {
        self.send(|out, name| tev::update(out, name, picture));
    }

    fn send(&mut self, packets: impl FnOnce(&mut dyn io::Write, &str) -> io::Result<()>) {
        let Some(stream) = &self.stream else { return };
        let mut out = BufWriter::new(stream);
        if let Err(error) = packets(&mut out, &self.name).and_then(|()| out.flush()) {
            // What could not be sent must not be tried again when the buffer goes.
            drop(out.into_parts());
            self.stream = None;
            self.complain(&error, "has it been closed?");
        }
    }

    fn complain(&self, error: &io::Error, question: &str) {
        let place = &self.place;
        self.console.warn(&format!(
            "warning: cannot reach tev at {place}: {error}; {question} Rendering goes on without it"
        ));
    }
}

fn connect(place: &str) -> io::Result<TcpStream> {
    let mut last = io::Error::from(io::ErrorKind::AddrNotAvailable);
    for address in addresses(place)? {
        match TcpStream::connect_timeout(&address, PATIENCE) {
            Ok(stream) => {
                stream.set_write_timeout(Some(PATIENCE))?;
                return Ok(stream);
            }
            Err(error) => last = error,
        }
    }
    Err(last)
}

/// `HOST:PORT`, or `HOST` alone.
fn addresses(place: &str) -> io::Result<Vec<SocketAddr>> {
    let found = place.to_socket_addrs().or_else(|error| match place.rsplit_once(':') {
        // An address of version 6 has colons of its own.
        Some((_, port)) if port.parse::<u16>().is_ok() => Err(error),
        _ => (place, tev::PORT).to_socket_addrs(),
    });
    Ok(found?.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_port_may_be_left_out() {
        let port = |place: &str| addresses(place).expect("an address")[0].port();
        assert_eq!(port("127.0.0.1:7"), 7);
        assert_eq!(port("127.0.0.1"), tev::PORT);
        assert_eq!(port("[::1]:8"), 8);
        assert!(addresses("127.0.0.1:99999").is_err());
    }
}
