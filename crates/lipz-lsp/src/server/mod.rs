//! The server: processes the messages of an editor in order, and answers them.

mod capabilities;
mod notifications;
mod publish;
mod requests;
mod runs;

use crate::document::Document;
use crate::project::{CheckedProject, KnownProject, Project};
use crate::transport::{self, IncomingMessage};
use capabilities::Client;
use crossbeam_channel::{at, never, select, unbounded};
use lipz_compiler::{Content, Input};
use lsp_server::{ErrorCode, Message, Notification, Request, Response};
use runs::Runs;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::io::{self, BufRead, Write};
use std::path::{Path, PathBuf};
use std::thread;

/// Serves an editor until it exits or disconnects. Returns whether it exited in the order of the protocol, which
/// decides the exit code.
///
/// `check` finds the problems of a whole project. Its second argument contains the texts of open, unsaved files, by
/// path name. It runs on a thread of its own.
///
/// # Errors
/// If the streams fail, the start of a message cannot be determined, or the system has no thread for reading.
pub fn serve(
    mut input: impl BufRead + Send + 'static,
    output: impl Write,
    check: impl Fn(&Project, &HashMap<String, String>) -> CheckedProject + Send + Sync + 'static,
) -> io::Result<bool> {
    // Unbounded, so that the reader does not wait for an editor that sends without reading.
    let (sender, received) = unbounded();
    let read = move || {
        loop {
            let next = transport::read(&mut input).transpose();
            let Some(next) = next else { return };
            let is_lost = next.is_err();
            if sender.send(next).is_err() || is_lost {
                return;
            }
        }
    };
    thread::Builder::new().spawn(read)?;
    let mut server = Server::new(output, Runs::new(check));
    loop {
        if received.is_empty() {
            // During fast typing, outdated texts are not checked.
            server.publish_changed()?;
        }
        let pause = server.runs.next_start().map_or_else(never, at);
        select! {
            recv(received) -> next => match next {
                Ok(next) => if let Some(is_orderly) = server.take(next?)? {
                    return Ok(is_orderly);
                },
                Err(_) => return Ok(false),
            },
            recv(server.runs.results) -> result => if let Ok(result) = result {
                server.take_result(result)?;
            },
            recv(pause) -> _ => server.start_run()?,
        }
    }
}

/// The state of the connection.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Phase {
    Before,
    Running,
    After,
}

/// The state of the server.
struct Server<W> {
    output: W,
    runs: Runs,
    phase: Phase,
    client: Client,
    /// The open files, by their URIs in the editor.
    documents: BTreeMap<String, Document>,
    /// The projects of open files, by their identifying paths.
    projects: BTreeMap<PathBuf, KnownProject>,
    /// The identifying path of each open file's project, by the file's URI.
    homes: HashMap<String, PathBuf>,
    /// The files for which an editor shows diagnostics, by project.
    published: BTreeMap<PathBuf, BTreeSet<String>>,
    /// The hash of the diagnostics that the editor shows for a file, by its URI. A project may have thousands of files,
    /// and editors take long to show them all again.
    sent: HashMap<String, u64>,
}

impl<W: Write> Server<W> {
    fn new(output: W, runs: Runs) -> Server<W> {
        Server {
            output,
            runs,
            phase: Phase::Before,
            client: Client::default(),
            documents: BTreeMap::new(),
            projects: BTreeMap::new(),
            homes: HashMap::new(),
            published: BTreeMap::new(),
            sent: HashMap::new(),
        }
    }

    /// Processes a message. Returns the result of the connection if it ends.
    fn take(&mut self, received: IncomingMessage) -> io::Result<Option<bool>> {
        match received {
            IncomingMessage::Refused(refused) => transport::refuse(&mut self.output, &refused)?,
            IncomingMessage::Message(Message::Request(request)) => {
                let response = self.answer(request)?;
                self.send(response)?;
            }
            IncomingMessage::Message(Message::Notification(notification)) if notification.method == "exit" => {
                return Ok(Some(self.phase == Phase::After));
            }
            IncomingMessage::Message(Message::Notification(notification)) if self.phase == Phase::Running => {
                self.notice(notification)?;
            }
            // Responses to the server's requests are ignored, and so are early notifications.
            IncomingMessage::Message(_) => {}
        }
        Ok(None)
    }

    fn answer(&mut self, request: Request) -> io::Result<Response> {
        let refuse = |code: ErrorCode, why: &str| Response::new_err(request.id.clone(), code as i32, why.to_owned());
        Ok(match (self.phase, request.method.as_str()) {
            (Phase::Before, "initialize") => {
                let (client, answer) = capabilities::agree(&request.params);
                self.client = client;
                self.phase = Phase::Running;
                Response::new_ok(request.id, answer)
            }
            (Phase::Before, _) => refuse(ErrorCode::ServerNotInitialized, "the first request must be `initialize`"),
            (Phase::Running, "shutdown") => {
                self.phase = Phase::After;
                Response::new_ok(request.id, ())
            }
            (Phase::Running, "initialize") => {
                refuse(ErrorCode::InvalidRequest, "`initialize` must be the first request")
            }
            (Phase::Running, _) => self.respond(request)?,
            (Phase::After, _) => refuse(ErrorCode::InvalidRequest, "only `exit` may follow `shutdown`"),
        })
    }

    /// Returns the project of an open file.
    fn known(&self, uri: &str) -> Option<&KnownProject> {
        self.projects.get(self.homes.get(uri)?)
    }

    fn send(&mut self, message: impl Into<Message>) -> io::Result<()> {
        message.into().write(&mut self.output)
    }

    fn notify(&mut self, method: &str, params: impl serde::Serialize) -> io::Result<()> {
        self.send(Notification::new(method.to_owned(), params))
    }
}

/// Returns the name of a path in reports.
pub(crate) fn path_name(path: &Path) -> String {
    Input { key: String::new(), content: Content::File(path.to_owned()) }.name()
}
