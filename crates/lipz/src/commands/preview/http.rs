//! One request and its response, over one HTTP/1.1 connection. Connections are not kept: on one machine a new one costs
//! nothing, and an idle one cannot block others.

use std::fs::File;
use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// The most bytes of a head. Browsers send a tenth of that.
const LONGEST_HEAD: usize = 64 * 1024;
const MOST_HEADERS: usize = 100;
/// The most bytes of a body: a Lipz file twice, escaped.
const LONGEST_BODY: usize = 4 * lipz_file::MAX_FILE_BYTES;
/// The time to wait for a head, and for each part of a body. Browsers open connections in advance.
const PATIENCE: Duration = Duration::from_secs(10);
/// The most bytes of a refused body that are read, so that a client which sends it first receives the response.
const MOST_REFUSED: u64 = 64 * 1024;

/// The data received over a connection.
pub(super) enum ReceivedRequest {
    /// A request, with the result of the function that admitted it.
    Request(Request, (String, String)),
    /// A request that was not admitted. Its body is not read.
    Refused,
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
    /// Reads a request, if `admit` returns its path and query by its head. Discards a body that is too long.
    pub(super) fn read(
        stream: &mut TcpStream,
        admit: impl FnOnce(&Request) -> Option<(String, String)>,
    ) -> io::Result<ReceivedRequest> {
        let began = Instant::now();
        let mut bytes = Vec::new();
        let (mut request, start) = loop {
            match head(&bytes) {
                Ok(Some(found)) => break found,
                Ok(None) => {}
                Err(_) => return Ok(ReceivedRequest::Nothing),
            }
            let Some(left) = PATIENCE.checked_sub(began.elapsed()).filter(|left| !left.is_zero()) else {
                return Ok(ReceivedRequest::Nothing);
            };
            stream.set_read_timeout(Some(left))?;
            let mut more = [0; 4096];
            let count = stream.read(&mut more)?;
            bytes.extend_from_slice(more.get(..count).unwrap_or_default());
            if count == 0 || bytes.len() > LONGEST_HEAD {
                return Ok(ReceivedRequest::Nothing);
            }
        };
        stream.set_read_timeout(Some(PATIENCE))?;
        let length = request.header("Content-Length").map_or(Ok(0), str::parse::<usize>);
        let Ok(length) = length else { return Ok(ReceivedRequest::Nothing) };
        // Any program on this machine can send a body, so it is not read before the head shows that the page sent it.
        let Some(asked) = admit(&request) else {
            let unread = (length as u64).saturating_sub((bytes.len() - start) as u64);
            let _ = io::copy(&mut stream.take(unread.min(MOST_REFUSED)), &mut io::sink());
            return Ok(ReceivedRequest::Refused);
        };
        if length > LONGEST_BODY {
            // Read the body to its end, because clients do not read a response while they send.
            let _ = io::copy(&mut stream.take(LONGEST_BODY as u64), &mut io::sink());
            return Ok(ReceivedRequest::TooLong);
        }
        request.body = bytes.split_off(start);
        let missing = length.saturating_sub(request.body.len());
        stream.take(missing as u64).read_to_end(&mut request.body)?;
        match request.body.len() == length {
            true => Ok(ReceivedRequest::Request(request, asked)),
            false => Ok(ReceivedRequest::Nothing),
        }
    }

    /// Returns the value of a header.
    pub(super) fn header(&self, name: &str) -> Option<&str> {
        let mut found = self.headers.iter().filter(|(known, _)| known.eq_ignore_ascii_case(name));
        found.next().map(|(_, value)| value.as_str())
    }
}

/// Returns the head of a request and the start of its body, or `None` if the head is incomplete.
fn head(bytes: &[u8]) -> Result<Option<(Request, usize)>, httparse::Error> {
    let mut headers = [httparse::EMPTY_HEADER; MOST_HEADERS];
    let mut parsed = httparse::Request::new(&mut headers);
    let httparse::Status::Complete(start) = parsed.parse(bytes)? else { return Ok(None) };
    let text = |value: &[u8]| String::from_utf8_lossy(value).into_owned();
    Ok(Some((
        Request {
            method: parsed.method.unwrap_or_default().to_owned(),
            url: parsed.path.unwrap_or_default().to_owned(),
            headers: parsed.headers.iter().map(|header| (header.name.to_owned(), text(header.value))).collect(),
            body: Vec::new(),
        },
        start,
    )))
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
        let (request, start) = head(bytes).unwrap().unwrap();
        assert_eq!((request.method.as_str(), request.url.as_str()), ("POST", "/a?b=c"));
        assert_eq!((request.header("host"), request.header("origin"), &bytes[start..]), (Some("h"), None, &b"hi"[..]));
        assert!((0..start).all(|length| head(&bytes[..length]).unwrap().is_none()));
        assert!(head(b"\x16\x03\x01 nonsense").is_err(), "not waited for");
    }
}
