//! The server: takes messages of an editor one after the other, and answers.

mod capabilities;
mod notifications;
mod publish;
mod requests;
mod runs;

use crate::document::Document;
use crate::project::{Checked, Known, Project};
use crate::transport::{self, Received};
use capabilities::Client;
use crossbeam_channel::{at, never, select, unbounded};
use lipz_compiler::{Content, Input};
use lsp_server::{ErrorCode, Message, Notification, Request, Response};
use runs::Runs;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::io::{self, BufRead, Write};
use std::path::{Path, PathBuf};
use std::thread;

/// Serves an editor until it says goodbye or is gone; whether it said goodbye in the order of the protocol, which decides
/// the exit code.
///
/// `check` finds what is wrong with a whole project, whose files have these texts where they are open and not saved, by the
/// names of their paths. It runs on a thread of its own.
///
/// # Errors
/// If the streams break, or it is not known where a message starts.
pub fn serve(
    mut input: impl BufRead + Send + 'static,
    output: impl Write,
    check: impl Fn(&Project, &HashMap<String, String>) -> Checked + Send + Sync + 'static,
) -> io::Result<bool> {
    // Without a bound: an editor that does not listen while it speaks is not waited for.
    let (sender, received) = unbounded();
    thread::spawn(move || {
        loop {
            let next = transport::read(&mut input).transpose();
            let Some(next) = next else { return };
            let is_lost = next.is_err();
            if sender.send(next).is_err() || is_lost {
                return;
            }
        }
    });
    let mut server = Server::new(output, Runs::new(check));
    loop {
        if received.is_empty() {
            // Whoever types quickly gets no answer about a text that is gone.
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

/// How far the conversation is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Phase {
    Before,
    Running,
    After,
}

/// What the server knows.
struct Server<W> {
    output: W,
    runs: Runs,
    phase: Phase,
    client: Client,
    /// The open files, by the editor's addresses.
    documents: BTreeMap<String, Document>,
    /// The projects of open files, by what tells them apart.
    projects: BTreeMap<PathBuf, Known>,
    /// The projects of the open files, by the same addresses.
    homes: HashMap<String, PathBuf>,
    /// Files for which an editor shows diagnostics, by project.
    published: BTreeMap<PathBuf, BTreeSet<String>>,
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
        }
    }

    /// Takes what has arrived; how the conversation ends, if this is its end.
    fn take(&mut self, received: Received) -> io::Result<Option<bool>> {
        match received {
            Received::Refused(refused) => transport::refuse(&mut self.output, &refused)?,
            Received::Message(Message::Request(request)) => {
                let response = self.answer(request)?;
                self.send(response)?;
            }
            Received::Message(Message::Notification(notification)) if notification.method == "exit" => {
                return Ok(Some(self.phase == Phase::After));
            }
            Received::Message(Message::Notification(notification)) if self.phase == Phase::Running => {
                self.notice(notification)?;
            }
            // Answers to our requests tell nothing, and before its time nothing is to be noticed.
            Received::Message(_) => {}
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
            (Phase::Before, _) => refuse(ErrorCode::ServerNotInitialized, "the first request is `initialize`"),
            (Phase::Running, "shutdown") => {
                self.phase = Phase::After;
                Response::new_ok(request.id, ())
            }
            (Phase::Running, "initialize") => refuse(ErrorCode::InvalidRequest, "`initialize` was the first request"),
            (Phase::Running, _) => self.respond(request)?,
            (Phase::After, _) => refuse(ErrorCode::InvalidRequest, "after `shutdown` comes `exit`"),
        })
    }

    /// The project of an open file.
    fn known(&self, uri: &str) -> Option<&Known> {
        self.projects.get(self.homes.get(uri)?)
    }

    fn send(&mut self, message: impl Into<Message>) -> io::Result<()> {
        message.into().write(&mut self.output)
    }

    fn notify(&mut self, method: &str, params: impl serde::Serialize) -> io::Result<()> {
        self.send(Notification::new(method.to_owned(), params))
    }
}

/// A path as reports name it.
pub(crate) fn path_name(path: &Path) -> String {
    Input { key: String::new(), content: Content::File(path.to_owned()) }.name()
}
