//! The server: the response for each address.

use super::assets;
use super::clip::{ClipPage, phones};
use super::draft::{DraftAnswer, DraftRequest};
use super::guard::{Guard, parameter};
use super::http::{Answer, Body, ReceivedRequest, Request};
use super::listing::Listing;
use super::project_file;
use super::shared_version::SharedVersion;
use serde::Serialize;
use std::io;
use std::net::{TcpListener, TcpStream};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

/// The time that a request waits for changes. Then the page repeats it.
const PATIENCE: Duration = Duration::from_secs(25);

/// The most connections at a time. Each page waits for changes on one of them.
const MOST_CONNECTIONS: usize = 512;

/// Headers that keep pages of other sites out, and allow ours no external content.
const HEADERS: [(&str, &str); 7] = [
    (
        "Content-Security-Policy",
        "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; \
         frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
    ),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Referrer-Policy", "no-referrer"),
    ("X-Content-Type-Options", "nosniff"),
    ("X-Frame-Options", "DENY"),
    ("Cache-Control", "no-store"),
];

/// The server of one page.
pub(super) struct Preview {
    listener: TcpListener,
    guard: Guard,
    shared: Arc<SharedVersion>,
    is_read_only: bool,
}

impl Preview {
    /// Listens on this machine, on a free port unless one is named.
    ///
    /// # Errors
    /// If the port is in use, or if the system has no random numbers for the token.
    pub(super) fn listen(port: Option<u16>, shared: Arc<SharedVersion>, is_read_only: bool) -> io::Result<Preview> {
        let listener = TcpListener::bind(("127.0.0.1", port.unwrap_or(0)))?;
        let guard = Guard::new(listener.local_addr()?.port()).map_err(io::Error::other)?;
        Ok(Preview { listener, guard, shared, is_read_only })
    }

    /// Returns the address of the page.
    pub(super) fn address(&self) -> String {
        self.guard.address()
    }

    /// Answers requests until the process ends, each in its own thread, because some wait for changes.
    pub(super) fn run(self) {
        let preview = Arc::new(self);
        let open = Arc::new(());
        for stream in preview.listener.incoming().filter_map(Result::ok) {
            // Half requests of other programs must not use up the threads of this process.
            let connection = Arc::clone(&open);
            if Arc::strong_count(&connection) > MOST_CONNECTIONS {
                continue;
            }
            let preview = Arc::clone(&preview);
            // If no thread starts, the request is dropped, and so is a response that the page does not wait for.
            let _ = thread::Builder::new().spawn(move || {
                drop(preview.answer(stream));
                drop(connection);
            });
        }
    }

    fn answer(&self, mut stream: TcpStream) -> io::Result<()> {
        let answer = match Request::read(&mut stream, |head| self.guard.asked(head))? {
            ReceivedRequest::Nothing => return Ok(()),
            ReceivedRequest::TooLong => plain(413, "The change exceeds the size limit of a Lipz file."),
            ReceivedRequest::Refused => plain(403, "Forbidden: open the address that `lipz preview` printed."),
            ReceivedRequest::Request(request, (path, query)) => self.respond(&request, &path, &query),
        };
        answer.send(&mut stream, &HEADERS)
    }

    fn respond(&self, request: &Request, path: &str, query: &str) -> Answer {
        match request.method.as_str() {
            "GET" => self.get(path, query),
            "POST" => self.post(path, &request.body),
            _ => plain(405, "This address does not support this method."),
        }
    }

    fn get(&self, path: &str, query: &str) -> Answer {
        let version = self.shared.now();
        let key = parameter(query, "key").unwrap_or_default();
        match path {
            "api/clips" => json(200, &Listing::new(&version, self.is_read_only)),
            "api/changes" => {
                let since = parameter(query, "since").and_then(|number| number.parse().ok());
                let newer = self.shared.after(since.unwrap_or(u64::MAX), PATIENCE);
                json(200, &serde_json::json!({ "version": newer.number }))
            }
            "api/bank" => {
                Answer { tag: Some(version.bank_tag()), ..bytes("application/octet-stream", version.bank.to_vec()) }
            }
            "api/clip" => match ClipPage::new(&version, &key) {
                Some(clip) => json(200, &clip),
                None => plain(404, "The clip no longer exists."),
            },
            "api/phones" => match version.hearing.phones(&version, &key) {
                Ok(heard) => json(200, &phones(&heard)),
                Err(report) => plain(500, &report.to_string()),
            },
            "api/sprites" => json(200, version.sprites.as_ref()),
            "api/sound" => match version.recordings.find(&key).map(project_file::open_recording) {
                Some(Ok(file)) => Answer { body: Body::File(file), ..bytes("application/octet-stream", Vec::new()) },
                Some(Err(report)) => plain(404, &report.to_string()),
                None => plain(404, "The clip has no recording."),
            },
            _ => match assets::named(path) {
                Some(asset) => bytes(asset.media_type(), asset.bytes.to_vec()),
                None => plain(404, "This address does not exist."),
            },
        }
    }

    fn post(&self, path: &str, body: &[u8]) -> Answer {
        let version = self.shared.now();
        let change: DraftRequest = match serde_json::from_slice(body) {
            Ok(change) => change,
            Err(error) => return plain(400, &format!("The change cannot be read: {error}.")),
        };
        match path {
            "api/draft" => with_bank(change.draft(&version)),
            "api/save" if self.is_read_only => json(
                403,
                &DraftAnswer::Refused { message: "files are not changed because of `--read-only`".to_owned() },
            ),
            "api/save" => json(200, &change.save(&version)),
            _ => plain(404, "This address does not exist."),
        }
    }
}

/// Returns the result of a change and its bank: the length of the document in four bytes, the document, the bank.
fn with_bank((changed, bank): (DraftAnswer, Option<Vec<u8>>)) -> Answer {
    let mut document = serde_json::to_vec(&changed).unwrap_or_default();
    let mut body = u32::try_from(document.len()).unwrap_or_default().to_le_bytes().to_vec();
    body.append(&mut document);
    body.extend(bank.unwrap_or_default());
    bytes("application/octet-stream", body)
}

fn json<T: Serialize>(status: u16, value: &T) -> Answer {
    match serde_json::to_vec(value) {
        Ok(document) => Answer { status, ..bytes("application/json", document) },
        Err(error) => plain(500, &error.to_string()),
    }
}

fn plain(status: u16, text: &str) -> Answer {
    Answer { status, ..bytes("text/plain; charset=utf-8", format!("{text}\n").into_bytes()) }
}

fn bytes(media_type: &'static str, bytes: Vec<u8>) -> Answer {
    Answer { status: 200, media_type, tag: None, body: Body::Bytes(bytes) }
}
