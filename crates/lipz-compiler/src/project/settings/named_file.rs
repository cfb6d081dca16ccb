//! Files that settings name, with the positions of their names.

use lipz_diagnostics::{Diagnostic, Label, Report, Source, Span};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file that a setting names. Programs read it only when they need it, and report its problems at its name.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct NamedFile {
    path: PathBuf,
    /// The settings, and the name of the file in them; `None` for a file that a program has set.
    place: Option<(Arc<Source>, Span)>,
}

impl NamedFile {
    /// Returns a file without a position in settings.
    pub fn new(path: impl Into<PathBuf>) -> NamedFile {
        NamedFile { path: path.into(), place: None }
    }

    /// Returns a file whose name is at `span` in these settings.
    #[cfg(feature = "settings")]
    pub(super) fn at(path: PathBuf, settings: &Arc<Source>, span: Span) -> NamedFile {
        NamedFile { path, place: Some((Arc::clone(settings), span)) }
    }

    /// Returns the path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the report about a problem of the file, at its name in the settings.
    pub fn report(&self, mut diagnostic: Diagnostic) -> Report {
        let Some((settings, span)) = &self.place else {
            return Report::about(self.path.to_string_lossy(), diagnostic);
        };
        diagnostic.primary = Some(Label::new(*span, ""));
        Report::new(Source::clone(settings), vec![diagnostic])
    }
}

#[cfg(all(test, feature = "settings"))]
mod tests {
    use super::*;
    use lipz_diagnostics::Code;

    #[test]
    fn problems_are_reported_at_the_name_of_the_file() {
        let diagnostic = || Diagnostic::new(Code::SettingValue, "`a.csv` does not exist");
        let without = NamedFile::new("a.csv").report(diagnostic());
        assert_eq!(without.to_string(), "a.csv: error[LZ1004]: `a.csv` does not exist\n");
        let settings = Arc::new(Source::new("lipz.toml", "[text]\nterms = \"a.csv\"\n"));
        let named = NamedFile::at("a.csv".into(), &settings, Span::new(15, 22)).report(diagnostic());
        assert_eq!(named.to_string(), "lipz.toml:2:9: error[LZ1004]: `a.csv` does not exist\n");
    }
}
