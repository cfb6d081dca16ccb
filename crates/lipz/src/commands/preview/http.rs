//! One request and its answer, over one connection, as HTTP/1.1 has them. Connections are not kept: on one machine a new
//! one costs nothing, and none can keep others waiting.

use std::fs::File;
use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::Duration;

/// The most bytes and lines of a head: browsers send a tenth.
const LONGEST_HEAD: usize = 64 * 1024;
const MOST_HEADERS: usize = 100;
/// The most bytes of a body: a Lipz file twice, escaped.
const LONGEST_BODY: usize = 4 * lipz_file::MAX_FILE_BYTES;
/// How long to wait for the rest of a request: browsers open connections that they may need later.
const PATIENCE: Duration = Duration::from_secs(10);

/// What came over a connection.
pub(super) enum Received {
    Request(Request),
    /// A request whose body is longer than any change of a Lipz file.
    TooLong,
    /// The connection ended before a request was whole, or it is none of HTTP.
    Nothing,
}

/// What somebody asks.
pub(super) struct Request {
    pub(super) method: String,
    pub(super) url: String,
    headers: Vec<(String, String)>,
    pub(super) body: Vec<u8>,
}

/// What they get.
pub(super) struct Answer {
    pub(super) status: u16,
    pub(super) media_type: &'static str,
    /// What tells this version of the body from others.
    pub(super) tag: Option<String>,
    pub(super) body: Body,
}

/// The bytes of an answer.
pub(super) enum Body {
    Bytes(Vec<u8>),
    File(File),
}

impl Request {
    /// Reads a request. Nothing of a body that is too long is kept.
    pub(super) fn read(stream: &mut TcpStream) -> io::Result<Received> {
        stream.set_read_timeout(Some(PATIENCE))?;
        let mut bytes = Vec::new();
        let (mut request, start) = loop {
            if let Some(found) = head(&bytes) {
                break found;
            }
            let mut more = [0; 4096];
            let count = stream.read(&mut more)?;
            bytes.extend_from_slice(more.get(..count).unwrap_or_default());
            if count == 0 || bytes.len() > LONGEST_HEAD {
                return Ok(Received::Nothing);
            }
        };
        let length = request.header("Content-Length").map_or(Ok(0), str::parse::<usize>);
        let Ok(length) = length else { return Ok(Received::Nothing) };
        if length > LONGEST_BODY {
            // Whoever is still sending does not listen for an answer.
            let _ = io::copy(&mut stream.take(LONGEST_BODY as u64), &mut io::sink());
            return Ok(Received::TooLong);
        }
        request.body = bytes.split_off(start);
        let missing = length.saturating_sub(request.body.len());
        stream.take(missing as u64).read_to_end(&mut request.body)?;
        Ok(if request.body.len() == length { Received::Request(request) } else { Received::Nothing })
    }

    /// The value of a header.
    pub(super) fn header(&self, name: &str) -> Option<&str> {
        let mut found = self.headers.iter().filter(|(known, _)| known.eq_ignore_ascii_case(name));
        found.next().map(|(_, value)| value.as_str())
    }
}

/// The head of a request, and where its body starts; none if it is not whole.
fn head(bytes: &[u8]) -> Option<(Request, usize)> {
    let mut headers = [httparse::EMPTY_HEADER; MOST_HEADERS];
    let mut parsed = httparse::Request::new(&mut headers);
    let Ok(httparse::Status::Complete(start)) = parsed.parse(bytes) else { return None };
    let text = |value: &[u8]| String::from_utf8_lossy(value).into_owned();
    Some((
        Request {
            method: parsed.method?.to_owned(),
            url: parsed.path?.to_owned(),
            headers: parsed.headers.iter().map(|header| (header.name.to_owned(), text(header.value))).collect(),
            body: Vec::new(),
        },
        start,
    ))
}

impl Answer {
    /// Sends it, with these headers, and ends the connection.
    pub(super) fn send(self, stream: &mut TcpStream, headers: &[(&str, &str)]) -> io::Result<()> {
        let Answer { status, media_type, tag, body } = self;
        let length = match &body {
            Body::Bytes(bytes) => bytes.len() as u64,
            Body::File(file) => file.metadata()?.len(),
        };
        let mut head = format!("HTTP/1.1 {status} {}\r\nContent-Type: {media_type}\r\n", reason(status));
        head += &format!("Content-Length: {length}\r\nConnection: close\r\n");
        head.extend(tag.map(|tag| format!("ETag: \"{tag}\"\r\n")));
        head.extend(headers.iter().map(|(name, value)| format!("{name}: {value}\r\n")));
        stream.write_all((head + "\r\n").as_bytes())?;
        match body {
            Body::Bytes(bytes) => stream.write_all(&bytes),
            Body::File(file) => io::copy(&mut file.take(length), stream).map(drop),
        }
    }
}

fn reason(status: u16) -> &'static str {
    match status {
        200 => "OK",
        400 => "Bad Request",
        403 => "Forbidden",
        404 => "Not Found",
        405 => "Method Not Allowed",
        413 => "Content Too Large",
        _ => "Internal Server Error",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_are_read_whole_or_not_at_all() {
        let bytes = b"POST /a?b=c HTTP/1.1\r\nHost: h\r\nContent-Length: 2\r\n\r\nhi";
        let (request, start) = head(bytes).unwrap();
        assert_eq!((request.method.as_str(), request.url.as_str()), ("POST", "/a?b=c"));
        assert_eq!((request.header("host"), request.header("origin"), &bytes[start..]), (Some("h"), None, &b"hi"[..]));
        assert!((0..start).all(|length| head(&bytes[..length]).is_none()));
        assert!(head(b"\x16\x03\x01 nonsense\r\n\r\n").is_none());
    }
}
