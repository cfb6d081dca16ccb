//! Writing of visemes: the line of the record, the Lipz file, the TextGrid.

use crate::record::{RecordLine, RecordedText, SyncRecord};
use crate::recordings::paths::shown;
use lipz_compiler::{replace_file, rewrite_file};
use lipz_diagnostics::{Code, Report};
use std::path::Path;

/// Protects writes: must run the function it gets, and prevent the process from ending meanwhile.
pub type WriteGuard<'w> = dyn Fn(&mut dyn FnMut()) + Sync + 'w;

/// The reason why visemes cannot be written.
pub(crate) struct WriteFault {
    pub(crate) report: Report,
    /// Whether the line of the record cannot be written.
    pub(crate) is_of_record: bool,
}

/// Writes a line of the record, then the file, which had the bytes `before`, and the TextGrid.
pub(crate) fn write(
    lipz_file: &Path,
    before: Option<&[u8]>,
    after: &str,
    (line, spoken, grid): (&RecordLine, &[RecordedText], Option<(&Path, &str)>),
    record: &SyncRecord,
    whole: &WriteGuard<'_>,
) -> Result<(), WriteFault> {
    let mut written = Ok(());
    whole(&mut || {
        if let Err(report) = record.append(lipz_file, line, spoken) {
            written = Err(WriteFault { report, is_of_record: true });
            return;
        }
        let file = match before {
            Some(before) => rewrite_file(lipz_file, before, after.as_bytes()),
            None if lipz_file.exists() => Err(Report::failure(
                shown(lipz_file),
                Code::OutputFailed,
                "another program has created the file in the meantime",
                "run the command again",
            )),
            None => replace_file(lipz_file, after.as_bytes()),
        };
        // A TextGrid that has been created meanwhile must not be overwritten.
        let grid = grid.filter(|(place, _)| !place.exists());
        let write_grid = || grid.map_or(Ok(()), |(place, text)| replace_file(place, text.as_bytes()));
        written = file.and_then(|()| write_grid()).map_err(|report| WriteFault { report, is_of_record: false });
    });
    written
}
