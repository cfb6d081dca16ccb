//! Limits the number of diagnostics per kind and file: the rest is counted.

use crate::{Code, Diagnostic};
use std::collections::BTreeMap;

/// The number of diagnostics of one code that are kept per file. All others become one diagnostic, which states their
/// number.
pub const PER_FILE_AND_CODE: usize = 1_000;

/// The length from which [`limit_many`] counts. A file cannot have as many diagnostics that concern its elements.
const MANY: usize = 1 << 16;

/// Keeps the first [`PER_FILE_AND_CODE`] diagnostics of each code in a file, and replaces the others by one, at the
/// position of the first of these. The memory for a file therefore hardly depends on how often an error is repeated.
/// Only the fixes of the others are kept ([`Diagnostic::fixes`]).
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, bound};
/// let mut diagnostics = vec![Diagnostic::new(Code::UnknownElement, "`x` is not an element"); 1_200];
/// bound::limit(&mut diagnostics);
/// assert_eq!(diagnostics.len(), 1_001);
/// assert_eq!(diagnostics[1_000].message, "200 more LZ0203 in this file are not shown");
/// assert_eq!(diagnostics[1_000].count(), 200);
/// ```
pub fn limit(diagnostics: &mut Vec<Diagnostic>) {
    if diagnostics.len() <= PER_FILE_AND_CODE {
        return;
    }
    let mut kept: BTreeMap<Code, usize> = BTreeMap::new();
    let mut rest: BTreeMap<Code, Diagnostic> = BTreeMap::new();
    diagnostics.retain_mut(|diagnostic| {
        let kept = kept.entry(diagnostic.code).or_default();
        if diagnostic.rest == 0 && *kept < PER_FILE_AND_CODE {
            *kept += 1;
            return true;
        }
        let all = rest.entry(diagnostic.code).or_insert_with(|| {
            let mut first = Diagnostic::new(diagnostic.code, "");
            first.primary = diagnostic.primary.take();
            first
        });
        all.severity = all.severity.max(diagnostic.severity);
        all.rest += diagnostic.count();
        diagnostic.fixes().for_each(|fix| all.add_fix_of_rest(&fix));
        false
    });
    for mut all in rest.into_values() {
        all.message = format!("{} more {} in this file are not shown", all.rest, all.code);
        diagnostics.push(all.help("fix those shown first; the next run shows the rest"));
    }
}

/// The same for very long lists only, for loops that add one diagnostic at a time.
pub fn limit_many(diagnostics: &mut Vec<Diagnostic>) {
    if diagnostics.len() >= MANY {
        limit(diagnostics);
    }
}

/// The same for diagnostics of several files, each with the number of its file.
pub fn limit_many_of_files(diagnostics: &mut Vec<(usize, Diagnostic)>) {
    if diagnostics.len() < MANY {
        return;
    }
    let mut by_file: BTreeMap<usize, Vec<Diagnostic>> = BTreeMap::new();
    for (file, diagnostic) in diagnostics.drain(..) {
        by_file.entry(file).or_default().push(diagnostic);
    }
    for (file, mut of_file) in by_file {
        limit(&mut of_file);
        diagnostics.extend(of_file.into_iter().map(|diagnostic| (file, diagnostic)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Severity, Span};

    #[test]
    fn counting_goes_on_where_it_stopped() {
        let at = |start| Diagnostic::at(Code::DuplicateElement, Span::new(start, start + 1), "");
        let mut diagnostics: Vec<Diagnostic> = (0..1_500).map(at).collect();
        diagnostics.insert(7, Diagnostic::new(Code::ByteOrderMark, ""));
        limit(&mut diagnostics);
        diagnostics.extend((1_500..1_600).map(at));
        limit(&mut diagnostics);
        assert_eq!(diagnostics.len(), 1_002);
        let all = diagnostics.last().unwrap();
        assert_eq!((all.count(), all.start(), all.severity), (600, 1_000, Severity::Error));
        assert_eq!(all.message, "600 more LZ0201 in this file are not shown");
        assert_eq!(diagnostics.iter().map(Diagnostic::count).sum::<usize>(), 1_601);
    }

    #[test]
    fn each_file_has_its_own_limit() {
        let mut diagnostics = Vec::new();
        for number in 0..200_000 {
            diagnostics.push((number % 2, Diagnostic::new(Code::UnknownElement, "")));
            limit_many_of_files(&mut diagnostics);
            assert!(diagnostics.len() < MANY);
        }
        let count =
            |file: usize| diagnostics.iter().filter(|(of, _)| *of == file).map(|(_, one)| one.count()).sum::<usize>();
        assert_eq!([count(0), count(1)], [100_000; 2]);
    }

    #[test]
    fn few_stay_as_they_are() {
        let mut diagnostics = vec![Diagnostic::new(Code::UnknownElement, ""); PER_FILE_AND_CODE];
        limit(&mut diagnostics);
        assert_eq!(diagnostics.len(), PER_FILE_AND_CODE);
        assert!(diagnostics.iter().all(|diagnostic| diagnostic.count() == 1));
    }
}
