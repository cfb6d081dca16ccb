//! Access control: only the page that this process served may send requests.
//!
//! Other pages in the same browser can also send requests to this machine. They do not have the token of the path; a
//! foreign name that resolves to this machine (DNS rebinding) has a different `Host`; and browsers send the origin of a
//! request.

use super::http::Request;
use percent_encoding::percent_decode_str;

/// The number of random bytes in the token, too many to guess.
const TOKEN_BYTES: usize = 16;

/// The required properties of a request.
pub(super) struct Guard {
    token: String,
    port: u16,
}

impl Guard {
    /// Creates a guard with a new token.
    ///
    /// # Errors
    /// If the system has no random numbers.
    pub(super) fn new(port: u16) -> Result<Guard, getrandom::Error> {
        let mut bytes = [0; TOKEN_BYTES];
        getrandom::fill(&mut bytes)?;
        let token = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Guard { token, port })
    }

    /// Returns the address of the page.
    pub(super) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token)
    }

    /// Returns the path below the token and the query of the request, or `None` if it must be refused.
    pub(super) fn asked(&self, request: &Request) -> Option<(String, String)> {
        let is_changing = request.method != "GET";
        let [host, origin, site] = ["Host", "Origin", "Sec-Fetch-Site"].map(|name| request.header(name));
        self.admits(&request.url, is_changing, host, origin, site)
    }

    fn admits(
        &self,
        url: &str,
        is_changing: bool,
        host: Option<&str>,
        origin: Option<&str>,
        fetch_site: Option<&str>,
    ) -> Option<(String, String)> {
        let host =
            host.filter(|host| ["127.0.0.1", "localhost"].iter().any(|name| *host == format!("{name}:{}", self.port)))?;
        let is_own = |origin: &str| origin == format!("http://{host}");
        // Browsers send the origin with every request except plain GETs.
        let is_from_page = origin.map_or(!is_changing, is_own);
        let is_same_site = fetch_site.is_none_or(|site| site == "same-origin" || site == "none" && !is_changing);
        let below = url.strip_prefix('/')?.strip_prefix(self.token.as_str())?.strip_prefix('/')?;
        if !is_from_page || !is_same_site {
            return None;
        }
        let (path, query) = below.split_once('?').unwrap_or((below, ""));
        Some((path.to_owned(), query.to_owned()))
    }
}

/// Returns the decoded value of a query parameter. Pages encode parameters as forms do, with `+` for a space.
pub(super) fn parameter(query: &str, name: &str) -> Option<String> {
    let value = query.split('&').find_map(|pair| pair.strip_prefix(name)?.strip_prefix('='))?;
    let value = value.replace('+', " ");
    percent_decode_str(&value).decode_utf8().ok().map(std::borrow::Cow::into_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_page_itself_is_answered() {
        let guard = Guard { token: "abc".into(), port: 80 };
        let (here, own) = (Some("127.0.0.1:80"), Some("http://127.0.0.1:80"));
        let is_admitted =
            |url, is_changing, host, origin, site| guard.admits(url, is_changing, host, origin, site).is_some();
        assert_eq!(
            guard.admits("/abc/api/clip?key=a", false, here, None, None),
            Some(("api/clip".into(), "key=a".into()))
        );
        assert!(is_admitted("/abc/", false, Some("localhost:80"), None, Some("none")), "typed by a person");
        assert!(is_admitted("/abc/api/save", true, here, own, Some("same-origin")));
        assert!(!is_admitted("/", false, here, None, None), "no token");
        assert!(!is_admitted("/abd/", false, here, None, None), "another token");
        assert!(!is_admitted("/abc/", false, Some("evil.example:80"), None, None), "a name that leads here");
        assert!(!is_admitted("/abc/", false, None, None, None), "no host");
        assert!(!is_admitted("/abc/", false, here, Some("http://evil.example"), None), "a page reads");
        assert!(!is_admitted("/abc/", false, here, Some("null"), None), "a page in a sandbox");
        assert!(!is_admitted("/abc/", false, here, None, Some("cross-site")), "an image of another page");
        assert!(
            !is_admitted("/abc/", false, here, Some("http://127.0.0.1:81"), Some("same-site")),
            "another server here"
        );
        assert!(!is_admitted("/abc/api/save", true, here, None, None), "a change by nobody");
        assert!(!is_admitted("/abc/api/save", true, here, own, Some("none")));
    }

    #[test]
    fn parameters_are_decoded() {
        assert_eq!(parameter("a=1&key=act1%2Fm%C3%A4r", "key").as_deref(), Some("act1/mär"));
        assert_eq!(parameter("key=hello+there", "key").as_deref(), Some("hello there"));
        assert_eq!(parameter("key=a%2Bb%20c", "key").as_deref(), Some("a+b c"));
        assert_eq!(parameter("monkey=1", "key"), None);
        assert_eq!(parameter("key=%ff", "key"), None);
    }

    #[test]
    fn tokens_differ() {
        let [one, other] = [(), ()].map(|()| Guard::new(1).unwrap());
        assert_ne!(one.token, other.token);
        assert_eq!(one.token.len(), 2 * TOKEN_BYTES);
    }
}
