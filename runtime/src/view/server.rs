//! Listens for browsers: one thread a connection, few at once, each with a limit on its time.

use super::client::{self, Door};
use super::http::{self, TOO_MANY};
use super::session::Session;
use std::fmt;
use std::io::{self, Read as _};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Connections at once. A page has one for events, and two or three for what it asks meanwhile.
const MAX_CLIENTS: usize = 32;
/// Bytes that are read of a request that is refused.
const MOST_LEFT: u64 = 64 << 10;
/// For one read or write.
const PATIENCE: Duration = Duration::from_secs(5);

/// A secret in the address of the page: 128 random bits in hexadecimal.
#[derive(Clone, PartialEq, Eq)]
pub struct Token(String);

impl Token {
    /// A new one.
    ///
    /// # Errors
    /// When the system has no randomness.
    pub fn new() -> io::Result<Self> {
        let mut bits = [0; 16];
        getrandom::fill(&mut bits).map_err(io::Error::from)?;
        Ok(Self(format!("{:032x}", u128::from_le_bytes(bits))))
    }
}

/// A token is not told by accident.
impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Token")
    }
}

/// Shows a session to browsers.
pub struct Server {
    listener: TcpListener,
    address: SocketAddr,
    door: Arc<Door>,
    session: Arc<Session>,
}

impl Server {
    /// Begins to listen.
    ///
    /// # Errors
    /// When the port is taken, or the address is not of this machine.
    pub fn bind(address: SocketAddr, token: Token, session: Arc<Session>) -> io::Result<Self> {
        let listener = TcpListener::bind(address)?;
        let address = listener.local_addr()?;
        let door = Arc::new(Door { token: token.0, address: address.ip() });
        Ok(Self { listener, address, door, session })
    }

    /// Of the page.
    #[must_use]
    pub fn url(&self) -> String {
        format!("http://{}/{}/", reachable(self.address), self.door.token)
    }

    /// Where it listens.
    #[must_use]
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Answers until the session is over; `wake` ends the wait for the last connection.
    pub fn serve(&self) {
        let clients = Arc::new(AtomicUsize::new(0));
        while !self.session.is_over() {
            let Ok((stream, _)) = self.listener.accept() else {
                // Too many open files, above all.
                std::thread::sleep(Duration::from_millis(50));
                continue;
            };
            if self.session.is_over() {
                return;
            }
            let place = Place::new(&clients);
            let (door, session) = (Arc::clone(&self.door), Arc::clone(&self.session));
            let serve = move || {
                // A browser that has gone needs no answer.
                let _ = serve_one(&session, &door, stream, place.is_some());
            };
            let thread = std::thread::Builder::new().name("rtr-client".to_owned());
            // Without a thread the connection is closed, and the page tries again.
            drop(thread.spawn(serve));
        }
    }
}

/// Ends `Server::serve`, whose session is over, at this address.
pub fn wake(address: SocketAddr) {
    // If nobody listens there any more, it has ended.
    drop(TcpStream::connect_timeout(&reachable(address), PATIENCE));
}

/// An address that this machine reaches itself at.
fn reachable(address: SocketAddr) -> SocketAddr {
    let ip = match address.ip() {
        IpAddr::V4(ip) if ip.is_unspecified() => IpAddr::V4(Ipv4Addr::LOCALHOST),
        IpAddr::V6(ip) if ip.is_unspecified() => IpAddr::V6(Ipv6Addr::LOCALHOST),
        ip => ip,
    };
    SocketAddr::new(ip, address.port())
}

fn serve_one(
    session: &Session,
    door: &Door,
    mut stream: TcpStream,
    is_room: bool,
) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    stream.set_nodelay(true)?;
    let refused = if is_room {
        match http::read(&mut stream) {
            Ok(request) => return client::answer(session, door, &request, &mut stream),
            Err(status) => status,
        }
    } else {
        TOO_MANY
    };
    client::refuse(refused, &mut stream)?;
    linger(&mut stream)
}

/// Reads some of what was not: a connection that is closed before is reset, and the answer may be lost.
fn linger(stream: &mut TcpStream) -> io::Result<()> {
    stream.shutdown(Shutdown::Write)?;
    stream.set_read_timeout(Some(Duration::from_millis(200)))?;
    io::copy(&mut stream.take(MOST_LEFT), &mut io::sink()).map(drop)
}

/// One of the places that there are.
struct Place(Arc<AtomicUsize>);

impl Place {
    fn new(clients: &Arc<AtomicUsize>) -> Option<Self> {
        let place = Self(Arc::clone(clients));
        (clients.fetch_add(1, Ordering::Relaxed) < MAX_CLIENTS).then_some(place)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}
