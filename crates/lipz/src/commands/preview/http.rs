//! One request and its response, over one HTTP/1.1 connection. Connections are not kept: on one machine a new one costs
//! nothing, and an idle one cannot block others.

use std::fs::File;
use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::Duration;

/// The most bytes of a head. Browsers send a tenth of that.
const LONGEST_HEAD: usize = 64 * 1024;
const MOST_HEADERS: usize = 100;
/// The most bytes of a body: a Lipz file twice, escaped.
const LONGEST_BODY: usize = 4 * lipz_file::MAX_FILE_BYTES;
/// The time to wait for the rest of a request. Browsers open connections in advance.
const PATIENCE: Duration = Duration::from_secs(10);

/// The data received over a connection.
pub(super) enum ReceivedRequest {
    Request(Request),
    /// A request whose body is longer than any change of a Lipz file.
    TooLong,
    /// The connection ended before the request was complete, or the data is not HTTP.
    Nothing,
}

/// A request.
pub(super) struct Request {
    pub(super) method: String,
    pub(super) url: String,
    headers: Vec<(String, String)>,
    pub(super) body: Vec<u8>,
}

/// The response.
pub(super) struct Answer {
    pub(super) status: u16,
    pub(super) media_type: &'static str,
    /// Identifies this version of the body.
    pub(super) tag: Option<String>,
    pub(super) body: Body,
}

/// The bytes of a response.
pub(super) enum Body {
    Bytes(Vec<u8>),
    File(File),
}

impl Request {
    /// Reads a request. Discards a body that is too long.
    pub(super) fn read(stream: &mut TcpStream) -> io::Result<ReceivedRequest> {
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
                return Ok(ReceivedRequest::Nothing);
            }
        };
        let length = request.header("Content-Length").map_or(Ok(0), str::parse::<usize>);
        let Ok(length) = length else { return Ok(ReceivedRequest::Nothing) };
        if length > LONGEST_BODY {
            // Read the body to its end, because clients do not read a response while they send.
            let _ = io::copy(&mut stream.take(LONGEST_BODY as u64), &mut io::sink());
            return Ok(ReceivedRequest::TooLong);
        }
        request.body = bytes.split_off(start);
        let missing = length.saturating_sub(request.body.len());
        stream.take(missing as u64).read_to_end(&mut request.body)?;
        Ok(if request.body.len() == length { ReceivedRequest::Request(request) } else { ReceivedRequest::Nothing })
    }

    /// Returns the value of a header.
    pub(super) fn header(&self, name: &str) -> Option<&str> {
        let mut found = self.headers.iter().filter(|(known, _)| known.eq_ignore_ascii_case(name));
        found.next().map(|(_, value)| value.as_str())
    }
}

/// Returns the head of a request and the start of its body, or `None` if the head is incomplete.
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
    /// Sends the response with these headers, and closes the connection.
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
