//! `rtr view`: serves a page that shows a scene while it renders, and shows the scene again when it changes.

mod browser;
mod compiler;

use self::compiler::{Compiler, News};
use super::args::ViewArgs;
use super::change::Change;
use super::console::{Console, is_interrupted, quit, reset_interrupts};
use super::exit::Exit;
use super::guard::ThreadError;
use super::open::{How, is_stdin, open};
use crate::render::DeviceChoice;
use crate::scene::Scene;
use crate::view::{Options, Server, Session, Token, start, wake};
use files::ShowPath as _;
use std::io;
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// The port that is tried first: one that people can remember for a tunnel.
const PORT: u16 = 7878;
/// Between two looks at the pack and the compiler.
const POLL: Duration = Duration::from_millis(50);
/// What threads have to end by themselves.
const PATIENCE: Duration = Duration::from_millis(1200);

/// Serves until Ctrl-C.
pub(super) fn command(args: &ViewArgs) -> Exit {
    let console = Console::new(args.quiet);
    reset_interrupts();
    match serve(args, &console) {
        Ok(()) => Exit::Done,
        Err(exit) => exit,
    }
}

fn serve(args: &ViewArgs, console: &Console) -> Result<(), Exit> {
    let mut source = Source::new(args, console)?;
    let first = source.first(console)?;
    let thread = |error| console.fail(&ThreadError(error), Exit::World);
    let options = Options {
        size: args.size,
        spp: args.spp,
        threads: args.threads,
        device: DeviceChoice::parse(&args.device),
    };
    let session = Arc::new(Session::new(options));
    start(&session).map_err(thread)?;
    if let Some(scene) = first {
        session.show(scene, &source.name()).map_err(|text| {
            console.warn(&format!("error: {text}"));
            Exit::Usage
        })?;
    }
    let server = listen(args, &session).map_err(|(address, error)| {
        let help = match error.kind() {
            io::ErrorKind::AddrInUse => "; choose another with --port, 0 takes any that is free",
            _ => "",
        };
        console.warn(&format!("error: cannot listen at {address}: {error}{help}"));
        Exit::World
    })?;
    let (address, url) = (server.address(), server.url());
    let server = std::thread::Builder::new()
        .name("rtr-server".to_owned())
        .spawn(move || server.serve())
        .map_err(thread)?;
    announce(args, console, address, &url);
    while !is_interrupted() {
        source.look(console, &session);
        std::thread::sleep(POLL);
    }
    session.close();
    wake(address);
    drop(source);
    end(&server);
    Ok(())
}

/// Waits for the last answers, not for ever.
fn end(server: &JoinHandle<()>) {
    let until = Instant::now() + PATIENCE;
    while !server.is_finished() {
        if Instant::now() > until {
            quit(Exit::Done);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Listens at the port that is asked for; without one at ours, or at any.
fn listen(args: &ViewArgs, session: &Arc<Session>) -> Result<Server, (SocketAddr, io::Error)> {
    let address = |port| SocketAddr::new(args.listen, port);
    let token = Token::new().map_err(|error| (address(0), error))?;
    let bind = |port| {
        Server::bind(address(port), token.clone(), Arc::clone(session))
            .map_err(|error| (address(port), error))
    };
    match args.port {
        Some(port) => bind(port),
        None => bind(PORT).or_else(|(_, error)| match error.kind() {
            io::ErrorKind::AddrInUse => bind(0),
            _ => Err((address(PORT), error)),
        }),
    }
}

fn announce(args: &ViewArgs, console: &Console, address: SocketAddr, url: &str) {
    // Also when nothing else is printed: without it nobody gets in.
    Console::new(false).result(url);
    if !address.ip().is_loopback() {
        console.warn(
            "warning: whoever has this URL can see and steer the view from other machines, and it is not encrypted",
        );
    }
    if !args.no_browser && !browser::open(url) {
        let port = address.port();
        console.note(&format!(
            "no browser to open here: open the URL above; from another machine after ssh -L {port}:127.0.0.1:{port} HOST"
        ));
    }
    console.note("press Ctrl-C to stop");
}

/// Where scenes come from.
struct Source {
    pack: PathBuf,
    /// What makes the pack, where a scene text is shown.
    compiler: Option<Compiler>,
    /// The pack as it was last read.
    seen: Option<Change>,
}

impl Source {
    fn new(args: &ViewArgs, console: &Console) -> Result<Self, Exit> {
        let path = &args.scene;
        if is_stdin(path) {
            console.warn("error: standard input cannot be viewed, name a file");
            return Err(Exit::Usage);
        }
        if path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("rts")) {
            return Ok(Self { pack: path.clone(), compiler: None, seen: None });
        }
        let name = path.file_stem().unwrap_or(path.as_os_str());
        let pack = Path::new(name).with_extension("pack");
        let Some(rtc) = compiler::beside() else {
            let (path, pack) = (path.shown(), pack.shown());
            console.warn(&format!(
                "error: {path} is a scene source, and rtc is not beside rtr; compile it first: rtc {path} -o {pack}"
            ));
            return Err(Exit::World);
        };
        let compiler = Compiler::start(&rtc, path, &pack).map_err(|error| {
            console.warn(&format!("error: cannot start {}: {error}", rtc.shown()));
            Exit::World
        })?;
        Ok(Self { pack, compiler: Some(compiler), seen: None })
    }

    fn name(&self) -> String {
        self.pack.shown().to_string()
    }

    /// The scene to begin with. Of a scene text there may be none yet; a pack has to be there.
    fn first(&mut self, console: &Console) -> Result<Option<Scene>, Exit> {
        self.seen = Some(Change::of(&self.pack));
        match read(&self.pack) {
            Ok(scene) => Ok(Some(scene)),
            Err(_) if self.compiler.is_some() => Ok(None),
            Err(error) => Err(console.fail_about(&self.pack, &error, Exit::World)),
        }
    }

    /// Passes on what has changed.
    fn look(&mut self, console: &Console, session: &Session) {
        for news in self.compiler.as_mut().map_or_else(Vec::new, Compiler::news) {
            match news {
                News::Line(line) => console.note(&line),
                News::Well => session.complain(None),
                News::Wrong(text) => session.complain(Some(text)),
            }
        }
        if self.seen.as_ref().is_some_and(|seen| !seen.has_come()) {
            return;
        }
        self.seen = Some(Change::of(&self.pack));
        let name = self.name();
        let shown = read(&self.pack)
            .map_err(|error| format!("error: {error}"))
            .and_then(|scene| session.show(scene, &name).map_err(|text| format!("error: {text}")));
        match shown {
            Ok(()) => console.note(&format!("{name} has changed")),
            Err(text) => {
                console.warn(&format!("{name}: {text}"));
                session.complain(Some(format!("{name}: {text}")));
            }
        }
    }
}

/// A file that is going to be replaced is read, not mapped, and its hashes are compared before anything is shown.
fn read(path: &Path) -> Result<Scene, pack::PackError> {
    let pack = open(path, How::Read)?;
    pack.verify_hashes()?;
    Ok(Scene::new(pack))
}
