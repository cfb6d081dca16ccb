//! Writing the files of an export: each as a whole, and over existing files only on request.

use super::ExportTexts;
use crate::console;
use crate::reporter::{Abort, Reporter};
use crate::shared::formats;
use crate::shared::output_file::{OVERWRITE, in_the_way, may_write, write_all};
use lipz_diagnostics::Report;
use lipz_texts::{WriteResult, WrittenFile};

/// Writes the files, and returns their number.
pub(super) fn deliver(
    arguments: &ExportTexts,
    written: &WriteResult,
    reports: &mut Vec<Report>,
    reporter: &mut Reporter,
) -> Result<usize, Abort> {
    if arguments.is_printed() {
        let [only] = written.files.as_slice() else {
            let tip = "name a folder with `--output`, or one locale with `--locale`";
            return Err(reporter.usage("several files cannot go to standard output", tip));
        };
        reporter.print_bytes(&only.bytes)?;
        return Ok(1);
    }
    let extension = arguments.text_format.extension();
    let name = |file: &WrittenFile| file.locale.clone().filter(|locale| !locale.is_empty()).unwrap_or("texts".into());
    let is_folder = written.files.len() > 1 || arguments.output.is_dir();
    let path = |file: &WrittenFile| match is_folder {
        true => formats::path(&arguments.output, &name(file), extension),
        false => arguments.output.clone(),
    };
    let has_extension = arguments.output.extension().is_some_and(|own| own == extension);
    if is_folder && has_extension && !arguments.output.is_dir() {
        let message = format!("`{}` is a single file, but each locale needs its own", console::path(&arguments.output));
        return Err(reporter.usage(message, "name a folder, or one locale with `--locale`"));
    }
    if !arguments.overwrite {
        reports.extend(written.files.iter().filter_map(|file| in_the_way(&path(file), OVERWRITE)));
    }
    if !may_write(reports) {
        return Ok(0);
    }
    Ok(write_all(written.files.iter().map(|file| (path(file), file.bytes.as_slice())), reports))
}
