//! Rewriting source files: reading each one, passing it to a tool, and replacing it as a whole.

use crate::files::{FileReader, Replacements};
use crate::run::Compiler;
use crate::sources::{Content, Input};
use crate::util::parallel;
use lipz_diagnostics::Report;
use std::path::Path;

impl Compiler<'_> {
    /// Reads every input and passes its bytes to `work`, on the threads of the compiler. Returns the results in the
    /// order of the inputs, with a report in place of unreadable files.
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

/// Replaces the file at `path`, which was read as `before`, with `after`, like [`replace_file`](crate::replace_file).
/// [`Replacements`] replaces many.
///
/// # Errors
/// Those of [`replace_file`](crate::replace_file); and if the file is read-only, or if another program has changed it
/// between reading and replacing. It stays unchanged.
pub fn rewrite_file(path: &Path, before: &[u8], after: &[u8]) -> Result<(), Report> {
    let files = Replacements::default();
    files.rewrite(path, before, after)?;
    files.finish().pop().map_or(Ok(()), Err)
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
