//! What is wrong with translations: those that are older than their source, or say something else.

use crate::console;
use crate::shared::settings_file::Project;
use crate::shared::text_record::RecordFile;
use lipz_compiler::{Compiler, Input, Linted, Options};
use lipz_diagnostics::{Code, Report};
use lipz_file::locale::{canonical_tag, text_name};
use lipz_texts::{TextLints, has_translations};

/// What is wrong with the translations of a project.
#[derive(Default)]
pub(crate) struct Checked {
    pub(crate) reports: Vec<Report>,
    /// Whether there are translations, and no record that knows what they were made from.
    pub(crate) is_unrecorded: bool,
}

/// How the translations of a project are compared: with its default locale, or with what they were made from.
pub(super) struct Translations<'p> {
    options: &'p Options,
    file: RecordFile,
    /// What is odd about the record.
    odd_lines: Option<Report>,
    /// `None` if nothing can be compared.
    source_locale: Option<String>,
}

impl<'p> Translations<'p> {
    /// # Errors
    /// If the record cannot be read, or is another file.
    pub(super) fn open(project: &'p Project, inputs: &[Input]) -> Result<Translations<'p>, Report> {
        let options = &project.settings.options;
        let (file, odd_lines) = RecordFile::open(project, inputs)?;
        let default = options.get_default_locale().and_then(|locale| canonical_tag(locale, true));
        let recorded = || file.record.source_locales().first().map(|locale| (*locale).to_owned());
        let source_locale = default.or_else(recorded);
        Ok(Translations { options, file, odd_lines, source_locale })
    }

    /// What is wrong with the translations of a file. Counted are those that have some which no record knows.
    pub(super) fn lint(&self, input: &Input, bytes: &[u8]) -> Linted {
        let Some(source_locale) = self.source_locale.as_ref().filter(|_| has_translations(bytes)) else {
            return Linted::default();
        };
        let Some(document) = lipz_file::parse(bytes).document else { return Linted::default() };
        let is_recorded = self.file.exists();
        let texts = || document.elements.iter().filter(|one| text_name(&one.name.text).is_some());
        let lints = TextLints::new(source_locale.as_str())
            .default_locale(self.options.get_default_locale().map(str::to_owned))
            .record(is_recorded.then_some(&self.file.record));
        let mut diagnostics = Vec::new();
        let name = if is_recorded { self.file.name(input) } else { String::new() };
        lints.check(&name, &document, &mut diagnostics);
        let report = (!diagnostics.is_empty()).then(|| {
            let mut report = Report::from_bytes(input.name(), bytes, diagnostics);
            self.options.apply_levels(&mut report);
            report
        });
        let report = report.filter(|report| !report.diagnostics.is_empty());
        Linted::new(report, !is_recorded && texts().nth(1).is_some())
    }

    /// All that decides about the translations besides the Lipz files and the options.
    pub(super) fn beside(&self) -> Vec<u8> {
        // The same record in another folder is about other files.
        let place = [&[u8::from(self.file.exists())], self.file.folders().as_slice(), &[0]].concat();
        match self.file.renamed.is_empty() {
            true => [place.as_slice(), self.file.bytes()].concat(),
            // What is known of a file that was renamed depends on which files are no more.
            false => [place.as_slice(), self.file.record.to_string().as_bytes()].concat(),
        }
    }

    /// What is wrong with them, as was found in files of which so many were counted.
    pub(super) fn found(self, reports: Vec<Report>, marked: usize) -> Checked {
        let mut of_record = Vec::from_iter(self.odd_lines);
        of_record.iter_mut().for_each(|report| self.options.apply_levels(report));
        of_record.retain(|report| !report.diagnostics.is_empty());
        of_record.extend(reports);
        // Who does not want to know which translations are stale need not know why none is.
        let is_asked = self.options.get_levels().severity(Code::StaleTranslation).is_some();
        Checked { reports: of_record, is_unrecorded: is_asked && marked > 0 }
    }
}

/// Compares the translations of a project.
pub(crate) fn check(project: &Project, inputs: &[Input], quiet: bool) -> Checked {
    let translations = match Translations::open(project, inputs) {
        Ok(opened) => opened,
        Err(report) => return Checked { reports: vec![report], is_unrecorded: false },
    };
    if translations.source_locale.is_none() {
        return translations.found(Vec::new(), 0);
    }
    let bar = console::progress_bar(inputs.len(), quiet);
    let compiler = Compiler::new(translations.options.clone()).progress(|files| bar.inc(files));
    // What cannot be read is reported by the check of the files.
    let linted = compiler.each_file(inputs, |input, bytes| translations.lint(input, bytes));
    bar.finish_and_clear();
    let linted: Vec<Linted> = linted.into_iter().filter_map(Result::ok).collect();
    let marked = linted.iter().filter(|linted| linted.is_marked).count();
    translations.found(linted.into_iter().filter_map(|linted| linted.report).collect(), marked)
}
