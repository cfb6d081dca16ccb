//! Rewriting source files: each is read, handed to a tool, and replaced as a whole.

use crate::compile::FileReader;
use crate::{Compiler, Content, Input, discover, parallel, replace_file};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::path::Path;

impl Compiler<'_> {
    /// Reads every input and hands its bytes to `work`, on the threads of the compiler. The results are in the
    /// order of the inputs; files that cannot be read have a report instead.
    pub fn each_file<R: Send>(
        &self,
        inputs: &[Input],
        work: impl Fn(&Input, &[u8]) -> R + Send + Sync,
    ) -> Vec<Result<R, Report>> {
        let one = |reader: &mut FileReader, input: &Input| {
            let result = match &input.content {
                Content::Bytes { bytes, .. } => Ok(work(input, bytes)),
                Content::File(path) => reader.read(path).map(|bytes| work(input, bytes)),
            };
            (self.progress)(1);
            result
        };
        parallel::in_pool(self.options.threads, || parallel::map_init(inputs, FileReader::default, one))
    }
}

/// Replaces the file at `path`, which was read as `before`, by `after`, as [`replace_file`] does.
///
/// # Errors
/// As [`replace_file`]; a file that is read-only, and one that somebody else has changed since it was
/// read. It is unchanged then.
pub fn rewrite_file(path: &Path, before: &[u8], after: &[u8]) -> Result<(), Report> {
    let refused = |why: &str, help: &str| {
        let shown = discover::display(path);
        let diagnostic = Diagnostic::new(Code::OutputFailed, format!("`{shown}` cannot be written: {why}"));
        Err(Report::about(shown, diagnostic.note("it is unchanged").help(help)))
    };
    if path.metadata().is_ok_and(|metadata| metadata.permissions().readonly()) {
        return refused("it is read-only", "make it writable, or check it out if your version control locks files");
    }
    let mut reader = FileReader::default();
    let now = reader.read(path).ok();
    if now == Some(after) {
        return Ok(()); // through another name of the same file
    }
    if now != Some(before) {
        return refused("another program has changed it in the meantime", "run the command again");
    }
    replace_file(path, after)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn files_that_changed_or_are_locked_stay() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.lipz");
        fs::write(&path, "new").unwrap();
        let report = rewrite_file(&path, b"old", b"mine").unwrap_err();
        assert!(report.diagnostics[0].message.ends_with("another program has changed it in the meantime"));
        assert_eq!(fs::read(&path).unwrap(), b"new");

        let mut permissions = path.metadata().unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&path, permissions).unwrap();
        let report = rewrite_file(&path, b"new", b"mine").unwrap_err();
        assert!(report.diagnostics[0].message.ends_with("it is read-only"));
        assert_eq!(fs::read(&path).unwrap(), b"new");
    }

    #[cfg(unix)]
    #[test]
    fn a_replaced_file_keeps_its_permissions() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.lipz");
        fs::write(&path, "old").unwrap();
        for mode in [0o600, 0o775] {
            fs::set_permissions(&path, fs::Permissions::from_mode(mode)).unwrap();
            let before = fs::read(&path).unwrap();
            rewrite_file(&path, &before, format!("{mode}").as_bytes()).unwrap();
            assert_eq!(path.metadata().unwrap().permissions().mode() & 0o777, mode);
        }
        assert_eq!(fs::read(&path).unwrap(), b"509");
    }
}
