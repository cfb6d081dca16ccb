//! URIs of files in the protocol, and their paths.

use lsp_types::Uri;
use std::path::{Component, Path, PathBuf};
use std::str::FromStr;
use url::Url;

/// Returns the path of a file, without `.` and `..`; `None` for other URIs.
pub(crate) fn path(uri: &str) -> Option<PathBuf> {
    let url = Url::parse(uri).ok().filter(|url| url.scheme() == "file")?;
    url.to_file_path().ok()
}

/// Returns the URI of the file at an absolute path.
pub(crate) fn of_path(path: &Path) -> Option<Uri> {
    let url = Url::from_file_path(from_root(path)?).ok()?;
    Uri::from_str(url.as_str()).ok()
}

/// Returns an absolute path without `.` and `..`, which editors do not resolve.
fn from_root(path: &Path) -> Option<PathBuf> {
    let mut whole = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => drop(whole.pop()),
            part => whole.push(part),
        }
    }
    whole.is_absolute().then_some(whole)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn paths_and_addresses() {
        let uri = of_path(Path::new("/voices/act 1/../mära#2?.lipz")).map(|uri| uri.as_str().to_owned());
        assert_eq!(uri.as_deref(), Some("file:///voices/m%C3%A4ra%232%3F.lipz"));
        assert_eq!(path("file:///voices/m%C3%A4ra%232%3F.lipz"), Some("/voices/mära#2?.lipz".into()));
        for other in ["untitled:Untitled-1", "http://example.com/a", "file", ""] {
            assert_eq!(path(other), None, "{other}");
        }
        assert_eq!(of_path(Path::new("a.lipz")), None);
    }
}
