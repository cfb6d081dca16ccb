//! Messages of the protocol as bytes: `Content-Length: N`, an empty line, N bytes of JSON.
//!
//! lsp-server ends the connection at the first message that is not JSON, and allocates any length that a header
//! declares. This module answers every message, and memory only grows with the bytes that arrive.

use crate::halves;
use lsp_server::{ErrorCode, Message, Notification, Request, Response};
use serde_json::{Value, json};
use std::io::{self, BufRead, Read, Write};

/// The longest message: the longest Lipz file, with two bytes in JSON for each of its bytes.
const MOST_BYTES: u64 = 2 * lipz_file::MAX_FILE_BYTES as u64;

/// The longest line of a header, in bytes.
const MOST_HEADER_BYTES: u64 = 1 << 12;

/// A message received from an editor.
#[derive(Debug)]
pub(crate) enum IncomingMessage {
    /// A message.
    Message(Message),
    /// Invalid data, with its answer.
    Refused(RefusedMessage),
}

/// The answer to invalid data.
#[derive(Debug)]
pub(crate) struct RefusedMessage {
    id: Value,
    code: ErrorCode,
    message: String,
}

/// Reads the next message; `None` at the end of the stream.
///
/// # Errors
/// If the stream cannot be read, or the start of the next message cannot be determined.
pub(crate) fn read(input: &mut impl BufRead) -> io::Result<Option<IncomingMessage>> {
    let Some(length) = read_header(input)? else { return Ok(None) };
    let mut bytes = Vec::new();
    input.take(length).read_to_end(&mut bytes)?;
    if (bytes.len() as u64) < length {
        return Err(io::Error::new(io::ErrorKind::UnexpectedEof, "the last message is cut off"));
    }
    let parsed = serde_json::from_slice(&bytes).or_else(|error| match halves::replaced(&bytes) {
        Some(bytes) => serde_json::from_slice(&bytes),
        None => Err(error),
    });
    Ok(Some(match parsed {
        Ok(value) => message(value),
        Err(error) => refused(Value::Null, ErrorCode::ParseError, format!("the message is not JSON: {error}")),
    }))
}

/// Returns the length in a header; `None` at the end of the stream.
fn read_header(input: &mut impl BufRead) -> io::Result<Option<u64>> {
    let mut length = None;
    loop {
        let mut line = Vec::new();
        let count = input.by_ref().take(MOST_HEADER_BYTES).read_until(b'\n', &mut line)?;
        let line = String::from_utf8_lossy(&line);
        let line = line.trim_end_matches(['\r', '\n']);
        if count == 0 && length.is_none() {
            return Ok(None);
        }
        if line.is_empty() {
            return length.map(Some).ok_or_else(|| lost("the message has no Content-Length"));
        }
        let (name, value) = line.split_once(':').ok_or_else(|| lost("a line of the header has no colon"))?;
        if name.eq_ignore_ascii_case("Content-Length") {
            let number = value.trim().parse().ok().filter(|length| *length <= MOST_BYTES);
            length = Some(number.ok_or_else(|| lost("the Content-Length is not a number, or is too large"))?);
        }
    }
}

fn lost(why: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, why)
}

/// Converts a JSON value to a message.
fn message(value: Value) -> IncomingMessage {
    let id = value.get("id").cloned().unwrap_or_default();
    let has_method = value.get("method").is_some();
    let message = match (has_method, id.is_null()) {
        (true, false) => serde_json::from_value::<Request>(value).map(Message::Request),
        (true, true) => serde_json::from_value::<Notification>(value).map(Message::Notification),
        (false, _) => serde_json::from_value::<Response>(value).map(Message::Response),
    };
    match message {
        Ok(message) => IncomingMessage::Message(message),
        Err(error) => refused(id, ErrorCode::InvalidRequest, format!("not a message of the protocol: {error}")),
    }
}

fn refused(id: Value, code: ErrorCode, message: String) -> IncomingMessage {
    IncomingMessage::Refused(RefusedMessage { id, code, message })
}

/// Answers invalid data. Its ID may have any type, which lsp-server's messages do not support.
///
/// # Errors
/// If the editor has closed the stream.
pub(crate) fn refuse(output: &mut impl Write, refused: &RefusedMessage) -> io::Result<()> {
    let RefusedMessage { id, code, message } = refused;
    let answer = json!({ "jsonrpc": "2.0", "id": id, "error": { "code": *code as i32, "message": message } });
    let text = answer.to_string();
    write!(output, "Content-Length: {}\r\n\r\n{text}", text.len())?;
    output.flush()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
mod tests {
    use super::*;

    fn framed(body: &str) -> String {
        format!("Content-Length: {}\r\n\r\n{body}", body.len())
    }

    fn one(text: &str) -> io::Result<Option<IncomingMessage>> {
        read(&mut text.as_bytes())
    }

    #[test]
    fn what_is_no_message_is_refused_and_the_next_is_read() {
        let bodies =
            ["{", "", "[1]", "\u{fffd}", r#"{"id":{"a":1},"method":"x"}"#, r#"{"id":1}"#, &"[".repeat(100_000)];
        for body in bodies {
            let stream = framed(body) + &framed(r#"{"jsonrpc":"2.0","method":"exit"}"#);
            let mut stream = stream.as_bytes();
            assert!(matches!(read(&mut stream), Ok(Some(IncomingMessage::Refused(_)))), "{body:.20}");
            assert!(
                matches!(read(&mut stream), Ok(Some(IncomingMessage::Message(Message::Notification(_))))),
                "{body:.20}"
            );
            assert!(read(&mut stream).unwrap().is_none());
        }
    }

    /// JavaScript writes half a surrogate pair as an escape. The message was lost, and the texts differed from then on.
    #[test]
    fn halves_of_characters_are_read() {
        let body = r#"{"jsonrpc":"2.0","id":7,"method":"x","params":["\ude01"]}"#;
        let Ok(Some(IncomingMessage::Message(Message::Request(request)))) = one(&framed(body)) else { panic!() };
        assert_eq!((request.id, request.params), (7.into(), json!(["\u{f601}"])));
    }

    #[test]
    fn an_id_of_another_type_is_answered_as_it_was_sent() {
        let Ok(Some(IncomingMessage::Refused(refused))) = one(&framed(r#"{"id":1.5,"method":"x"}"#)) else { panic!() };
        let mut answer = Vec::new();
        refuse(&mut answer, &refused).unwrap();
        let answer = String::from_utf8(answer).unwrap();
        assert!(answer.contains(r#""id":1.5"#) && answer.contains("-32600"), "{answer}");
    }

    #[test]
    fn headers_that_lead_nowhere_end_the_stream() {
        let huge = "Content-Length: 18446744073709551615\r\n\r\n{}";
        let long = "x".repeat(100_000);
        for text in
            [huge, "Content-Length: -1\r\n\r\n", "a\r\n\r\n", "A: b\r\n\r\n{}", &long, "Content-Length: 9\r\n\r\n{}"]
        {
            assert!(one(text).is_err(), "{text:.50}");
        }
        assert!(one("content-length:2\n\n{}").is_ok_and(|found| found.is_some()), "other spellings");
    }
}
