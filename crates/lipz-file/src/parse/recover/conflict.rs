//! The lines with which Git marks a conflict between two branches.

use super::Scan;
use lipz_diagnostics::{Code, Diagnostic, Span};

/// The markers, at the start of a line. Files with the style `diff3` also contain the common ancestor.
const OURS: &str = "<<<<<<<";
const ANCESTOR: &str = "|||||||";
const THEIRS: &str = "=======";
const END: &str = ">>>>>>>";

impl Scan<'_, '_> {
    /// Moves past the marker at the position, and past the version of the other branch. Reports each conflict at its
    /// first marker. Returns whether there was a marker.
    pub(super) fn conflict_marker(&mut self) -> bool {
        let rest = self.rest();
        if !self.at_line_start() {
            return false;
        }
        let line_length = rest.lines().next().map_or(0, str::len);
        if rest.starts_with(OURS) {
            self.report(conflict(Span::new(self.at, self.at + line_length)));
            self.at += line_length;
            self.is_in_conflict = true;
            // Only the author knows which version is right.
            self.is_sure = false;
            self.found.is_complete = false;
            self.is_damaged |= self.open.len() > 1;
            return true;
        }
        let is_behind_ours = [ANCESTOR, THEIRS, END].iter().any(|marker| rest.starts_with(marker));
        if !(self.is_in_conflict && is_behind_ours) {
            return false;
        }
        self.is_in_conflict = false;
        let end = if rest.starts_with(END) { Some(0) } else { rest.find(&format!("\n{END}")).map(|before| before + 1) };
        let end = end.and_then(|end| Some(end + rest.get(end..)?.lines().next()?.len()));
        self.at += end.unwrap_or(rest.len());
        true
    }

    fn at_line_start(&self) -> bool {
        self.text.get(..self.at).is_some_and(|before| before.is_empty() || before.ends_with('\n'))
    }
}

fn conflict(marker: Span) -> Diagnostic {
    Diagnostic::at(Code::MergeConflict, marker, "two versions follow, because a merge of two branches is unresolved")
        .help("keep one version, or combine them, and delete the lines that start with `<<<<<<<`, `=======` and `>>>>>>>`")
}
