//! The remaining work in a project's Lipz files: missing and stale texts of each locale.

use crate::console;
use crate::reporter::{Abort, Reporter};
use crate::shared::inputs::find;
use crate::shared::settings_file::Project;
use crate::shared::text_record::RecordFile;
use lipz_compiler::Compiler;
use lipz_file::locale::{canonical_tag, is_variant};
use lipz_texts::{ClipTexts, Work, texts_of};
use std::collections::BTreeSet;

/// Returns the work in all locales of the files and in those of `wanted`, or `None` without a default locale to
/// translate from.
pub(super) fn of_project(
    project: &Project,
    wanted: &[String],
    quiet: bool,
    reporter: &mut Reporter,
) -> Result<Option<Work>, Abort> {
    let options = &project.settings.options;
    let Some(source_locale) = options.get_default_locale().and_then(|locale| canonical_tag(locale, true)) else {
        return Ok(None);
    };
    // Problems of the files are reported when they are packed.
    let (inputs, _) = find(&project.settings);
    let (file, odd_lines) = RecordFile::open(project, &inputs).map_err(|report| reporter.fail(report))?;
    reporter.add(Vec::from_iter(odd_lines));
    let bar = console::progress_bar(inputs.len(), quiet);
    let compiler = Compiler::new(options.clone()).progress(|files| bar.inc(files));
    let texts = compiler.each_file(&inputs, |_, bytes| {
        let document = lipz_file::parse(bytes).document.unwrap_or_default();
        texts_of(&document, options.get_default_locale())
    });
    bar.finish_and_clear();
    let mut clips: Vec<(&str, String, ClipTexts)> = inputs
        .iter()
        .zip(texts)
        .filter_map(|(input, texts)| Some((input.key.as_str(), file.name(input), texts.ok()?)))
        .collect();
    clips.sort_by(|a, b| a.0.cmp(b.0));
    let packed =
        |locale: &&String| !is_variant(locale) && options.get_locales().is_none_or(|packed| packed.contains(*locale));
    let locales: BTreeSet<&String> = clips.iter().flat_map(|(_, _, texts)| texts.keys()).filter(packed).collect();
    let locales: BTreeSet<String> = locales.into_iter().chain(wanted).cloned().collect();
    let mut work = Work::new(source_locale.as_str(), locales.into_iter().filter(|locale| *locale != source_locale));
    for (key, name, texts) in &clips {
        work.add(key, name, texts, Some(&file.record));
    }
    Ok(Some(work))
}
