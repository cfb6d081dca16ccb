//! What is wrong with translations: those that are older than their source, or say something else.

use crate::shared::settings_file::Project;
use crate::shared::text_record::RecordFile;
use crate::{console, interrupt};
use lipz_compiler::{Compiler, Input};
use lipz_diagnostics::Report;
use lipz_file::locale::{canonical_tag, text_name};
use lipz_texts::{TextLints, has_translations};
use std::sync::atomic::{AtomicBool, Ordering};

/// What is wrong with the translations of a project.
#[derive(Default)]
pub(crate) struct Checked {
    pub(crate) reports: Vec<Report>,
    /// Whether there are translations, and no record that knows what they were made from.
    pub(crate) is_unrecorded: bool,
}

/// Compares the translations of a project with its default locale, or with what they were made from.
pub(crate) fn check(project: &Project, inputs: &[Input], quiet: bool) -> Checked {
    let options = &project.settings.options;
    let (file, report) = match RecordFile::open(project, inputs) {
        Ok(opened) => opened,
        Err(report) => return Checked { reports: vec![report], is_unrecorded: false },
    };
    let mut reports = Vec::from_iter(report);
    let has_some = AtomicBool::new(false);
    let default = options.default_locale.as_deref().and_then(|locale| canonical_tag(locale, true));
    let recorded = || file.record.source_locales().first().map(|locale| (*locale).to_owned());
    if let Some(source_locale) = default.or_else(recorded) {
        let lints = TextLints::new(source_locale)
            .default_locale(options.default_locale.clone())
            .record(file.exists().then_some(&file.record));
        let bar = console::progress_bar(inputs.len(), quiet);
        let compiler = Compiler::new(options.clone()).progress(|files| {
            bar.inc(files);
            interrupt::point();
        });
        let found = compiler.each_file(inputs, |input, bytes| {
            let document = Some(bytes).filter(|bytes| has_translations(bytes));
            let document = document.and_then(|bytes| lipz_file::parse(bytes).document)?;
            if !file.exists()
                && document.elements.iter().filter(|one| text_name(&one.name.text).is_some()).nth(1).is_some()
            {
                has_some.store(true, Ordering::Relaxed);
            }
            let mut diagnostics = Vec::new();
            lints.check(&file.name(input), &document, &mut diagnostics);
            (!diagnostics.is_empty()).then(|| Report::from_bytes(input.name(), bytes, diagnostics))
        });
        bar.finish_and_clear();
        // What cannot be read is reported by the check of the files.
        reports.extend(found.into_iter().filter_map(Result::ok).flatten());
    }
    reports.iter_mut().for_each(|report| options.apply_levels(report));
    reports.retain(|report| !report.diagnostics.is_empty());
    Checked { reports, is_unrecorded: has_some.into_inner() }
}
