//! Levels of lints for some of the files.

use super::Options;
use crate::util::patterns::MATCHING;
use glob::{Pattern, PatternError};
use lipz_diagnostics::{Code, Levels, Report, Severity, Span};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

/// Levels of lints for the files that a pattern matches; see [`Options::file_levels`].
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct FileLevels {
    /// The pattern as written.
    written: String,
    /// The pattern of whole paths.
    pattern: Pattern,
    levels: Levels,
    /// The position of the pattern in the settings.
    span: Span,
}

impl FileLevels {
    /// Creates levels for the files below `folder` whose relative paths match the pattern: `voices/old/**`. Links in a
    /// path make no difference.
    ///
    /// # Errors
    /// If the pattern is invalid.
    pub fn new(folder: &Path, pattern: &str, levels: Levels) -> Result<FileLevels, PatternError> {
        Pattern::new(pattern)?; // positions in an error refer to the pattern
        let below = pattern.strip_prefix("./").unwrap_or(pattern);
        let whole = format!("{}/{below}", Pattern::escape(whole(folder).trim_end_matches('/')));
        Ok(FileLevels { written: pattern.to_owned(), pattern: Pattern::new(&whole)?, levels, span: Span::default() })
    }

    /// Sets the position of the pattern in the settings, for [`Options::unused_patterns`].
    #[must_use]
    pub fn at(self, span: Span) -> FileLevels {
        FileLevels { span, ..self }
    }
}

impl Options {
    /// Returns the levels for the file with this name: those of the project, overridden by those of each pattern that
    /// matches it, in order.
    ///
    /// ```
    /// use lipz_compiler::diagnostics::{Code, Levels};
    /// use lipz_compiler::{FileLevels, Options};
    /// let allowed = Levels::from([(Code::UnknownEmotion, None)]);
    /// let options = Options::new().file_levels(FileLevels::new("".as_ref(), "voices/old/**", allowed)?);
    /// assert_eq!(options.levels_for("voices/old/act1/mara.lipz").severity(Code::UnknownEmotion), None);
    /// assert!(options.levels_for("voices/act1/mara.lipz").severity(Code::UnknownEmotion).is_some());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn levels_for(&self, name: &str) -> Cow<'_, Levels> {
        let mut levels = Cow::Borrowed(&self.levels);
        for at in self.matching(name) {
            levels.to_mut().extend(self.files_levels[at].levels.clone());
        }
        levels
    }

    /// Returns the patterns of [`file_levels`](Options::file_levels) that match none of these files and no other file on
    /// disk, because levels apply to recordings and other files too, with their positions in the settings.
    pub fn unused_patterns(&self, names: &[String]) -> Vec<(&str, Span)> {
        let is_on_disk = |pattern: &Pattern| {
            // A search for `**` at the end finds only folders.
            let files = if pattern.as_str().ends_with("**") { "/*" } else { "" };
            let found = glob::glob_with(&format!("{pattern}{files}"), MATCHING);
            found.is_ok_and(|mut found| found.any(|path| path.is_ok_and(|path| path.is_file())))
        };
        let used: BTreeSet<usize> = names.iter().flat_map(|name| self.matching(name)).collect();
        let of_files = self.files_levels.iter().enumerate();
        let is_unused = |(at, one): &(usize, &FileLevels)| !used.contains(at) && !is_on_disk(&one.pattern);
        of_files.filter(is_unused).map(|(_, one)| (one.written.as_str(), one.span)).collect()
    }

    /// Applies the levels for a report's file to its diagnostics.
    pub fn apply_levels(&self, report: &mut Report) {
        self.levels_for(&report.source.path).apply(&mut report.diagnostics);
    }

    /// Returns the options for the file with this name, whose [levels](Options::get_levels) are [those for
    /// it](Options::levels_for).
    pub fn for_file(&self, name: &str) -> Cow<'_, Options> {
        match self.levels_for(name) {
            Cow::Borrowed(_) => Cow::Borrowed(self),
            Cow::Owned(levels) => Cow::Owned(Options { levels, ..self.clone() }),
        }
    }

    /// Whether a lint is reported in any file, as far as this is known without the file's name.
    pub(crate) fn may_report(&self, code: Code) -> bool {
        let of_files = self.files_levels.iter().map(|of_files| &of_files.levels);
        of_files.chain([&self.levels]).any(|levels| levels.severity(code).is_some())
    }

    /// Sets the level of a lint in all files, overriding earlier settings.
    pub fn overrule(&mut self, code: Code, level: Option<Severity>) {
        let of_files = self.files_levels.iter_mut().map(|of_files| &mut of_files.levels);
        of_files.chain([&mut self.levels]).for_each(|levels| levels.set(code, level));
    }

    /// Returns the indexes of the patterns that match a name.
    fn matching(&self, name: &str) -> Vec<usize> {
        if self.files_levels.is_empty() {
            return Vec::new();
        }
        let whole = whole(name.as_ref());
        let is_match = |at: &usize| self.files_levels[*at].pattern.matches_with(&whole, MATCHING);
        (0..self.files_levels.len()).filter(is_match).collect()
    }
}

/// Returns a path from the root, without `.` and `..`.
fn whole(path: &Path) -> String {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    let mut plain = PathBuf::new();
    for part in std::path::absolute(path).as_deref().unwrap_or(path).components() {
        match part {
            Component::ParentDir => _ = plain.pop(),
            Component::CurDir => {}
            _ => plain.push(part),
        }
    }
    plain.to_string_lossy().into_owned()
}

/// Options for a sequence of files. Those for files that match the same patterns are created once.
pub(crate) struct FileOptions<'o> {
    options: &'o Options,
    made: Vec<(Vec<usize>, Options)>,
}

impl<'o> FileOptions<'o> {
    pub(crate) fn new(options: &'o Options) -> FileOptions<'o> {
        FileOptions { options, made: Vec::new() }
    }

    /// Returns the options for the file with this name, which is computed only if there are patterns.
    pub(crate) fn of(&mut self, name: impl FnOnce() -> String) -> &Options {
        if self.options.files_levels.is_empty() {
            return self.options;
        }
        let name = name();
        let matching = self.options.matching(&name);
        if matching.is_empty() {
            return self.options;
        }
        let place = self.made.iter().position(|(patterns, _)| *patterns == matching).unwrap_or_else(|| {
            self.made.push((matching, self.options.for_file(&name).into_owned()));
            self.made.len() - 1
        });
        &self.made[place].1
    }
}
