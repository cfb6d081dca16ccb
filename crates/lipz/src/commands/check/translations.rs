//! Problems of texts: translations that are older than their source, or that do not match it, and texts that do not fit
//! their font.

use super::fonts::Fonts;
use crate::console;
use crate::shared::input_file;
use crate::shared::settings_file::Project;
use crate::shared::text_record::RecordFile;
use lipz_compiler::settings::NamedFile;
use lipz_compiler::{Compiler, Input, LintResult, Options};
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_file::Document;
use lipz_file::locale::{canonical_tag, text_name};
use lipz_file::placeholder::PlaceholderPattern;
use lipz_texts::{Terms, TextLints, has_translations};

/// The problems of a project's translations.
#[derive(Default)]
pub(crate) struct TranslationCheck {
    pub(crate) reports: Vec<Report>,
    /// Whether there are translations, but no record of their source texts.
    pub(crate) is_unrecorded: bool,
}

/// The comparison of translations with the default locale, or with their recorded source texts.
pub(super) struct Translations<'p> {
    options: &'p Options,
    placeholders: &'p [PlaceholderPattern],
    file: RecordFile,
    /// Warnings about lines of the record.
    odd_lines: Option<Report>,
    /// `None` if nothing can be compared.
    source_locale: Option<String>,
    terms: TermFile,
    fonts: Fonts<'p>,
}

/// The terms of a project, and the file that they come from.
#[derive(Default)]
struct TermFile {
    terms: Terms,
    bytes: Vec<u8>,
    report: Option<Report>,
}

impl TermFile {
    /// Reads the terms. A file that cannot be read has none, so that all other checks still run.
    fn read(file: Option<&NamedFile>, source_locale: Option<&str>) -> TermFile {
        let Some(file) = file else { return TermFile::default() };
        let bytes = match input_file::read_named(file) {
            Ok(bytes) => bytes,
            Err(report) => return TermFile { report: Some(report), ..TermFile::default() },
        };
        let Some(source_locale) = source_locale else { return TermFile::default() };
        let (terms, report) = Terms::read(console::path(file.path()), &bytes, source_locale);
        TermFile { terms, bytes, report: Some(report).filter(|report| !report.diagnostics.is_empty()) }
    }
}

impl<'p> Translations<'p> {
    /// # Errors
    /// If the record cannot be read, or the file is not a record.
    pub(super) fn open(project: &'p Project, inputs: &[Input]) -> Result<Translations<'p>, Report> {
        let options = &project.settings.options;
        let (file, odd_lines) = RecordFile::open(project, inputs)?;
        let source_locale = source_locale_of(options, &file);
        let terms = TermFile::read(project.settings.terms.as_ref(), source_locale.as_deref());
        let placeholders = &project.settings.placeholders;
        let fonts = Fonts::open(&project.settings.pixel_limits);
        Ok(Translations { options, placeholders, file, odd_lines, source_locale, terms, fonts })
    }

    /// Returns the problems of a file's texts, and counts the file if some of its translations are unrecorded.
    pub(super) fn lint(&self, input: &Input, bytes: &[u8]) -> LintResult {
        let source_locale = self.source_locale.as_deref().filter(|_| has_translations(bytes));
        if source_locale.is_none() && !self.fonts.is_any() {
            return LintResult::default();
        }
        let Some(document) = lipz_file::parse(bytes).document else { return LintResult::default() };
        let mut diagnostics = Vec::new();
        if let Some(source_locale) = source_locale {
            self.compare(source_locale, input, &document, &mut diagnostics);
        }
        self.fonts.check(&document, self.options, &mut diagnostics);
        let report = (!diagnostics.is_empty()).then(|| {
            let mut report = Report::from_bytes(input.name(), bytes, diagnostics);
            self.options.apply_levels(&mut report);
            report
        });
        let report = report.filter(|report| !report.diagnostics.is_empty());
        let mut texts = document.elements.iter().filter(|one| text_name(&one.name.text).is_some());
        LintResult::new(report, source_locale.is_some() && !self.file.exists() && texts.nth(1).is_some())
    }

    /// Reports the problems of a clip's translations.
    fn compare(&self, source_locale: &str, input: &Input, clip: &Document<'_>, diagnostics: &mut Vec<Diagnostic>) {
        let is_recorded = self.file.exists();
        let lints = TextLints::new(source_locale)
            .default_locale(self.options.get_default_locale().map(str::to_owned))
            .record(is_recorded.then_some(&self.file.record))
            .terms(Some(&self.terms.terms))
            .placeholders(self.placeholders);
        let name = if is_recorded { self.file.name(input) } else { String::new() };
        lints.check(&name, clip, diagnostics);
    }

    /// Returns all inputs of these checks except the Lipz files and the options, as bytes to compare.
    pub(super) fn beside(&self) -> Vec<u8> {
        // The same record in a different folder belongs to different files.
        let place =
            [&[u8::from(self.file.exists())], self.file.folders().as_slice(), &[0], &self.terms.bytes, &[0]].concat();
        let place =
            [place.as_slice(), format!("{:?}", self.placeholders).as_bytes(), &[0], &self.fonts.beside()].concat();
        match self.file.renamed.is_empty() {
            true => [place.as_slice(), self.file.bytes()].concat(),
            // Whether a file counts as renamed depends on the deleted files.
            false => [place.as_slice(), self.file.record.to_string().as_bytes()].concat(),
        }
    }

    /// Returns the result, from the reports and the number of counted files.
    pub(super) fn found(self, reports: Vec<Report>, marked: usize) -> TranslationCheck {
        let mut of_record: Vec<Report> =
            self.odd_lines.into_iter().chain(self.terms.report).chain(self.fonts.reports).collect();
        of_record.iter_mut().for_each(|report| self.options.apply_levels(report));
        of_record.retain(|report| !report.diagnostics.is_empty());
        of_record.extend(reports);
        // If the lint is off, the hint is not useful.
        let is_asked = self.options.get_levels().severity(Code::StaleTranslation).is_some();
        TranslationCheck { reports: of_record, is_unrecorded: is_asked && marked > 0 }
    }
}

/// Returns the locale that the texts of a project are translated from: the default locale, or the recorded one.
pub(super) fn source_locale(project: &Project, inputs: &[Input]) -> Option<String> {
    let options = &project.settings.options;
    match RecordFile::open(project, inputs) {
        Ok((file, _)) => source_locale_of(options, &file),
        Err(_) => default_locale(options),
    }
}

fn source_locale_of(options: &Options, file: &RecordFile) -> Option<String> {
    default_locale(options).or_else(|| file.record.source_locales().first().map(|locale| (*locale).to_owned()))
}

fn default_locale(options: &Options) -> Option<String> {
    canonical_tag(options.get_default_locale()?, true)
}

/// Checks the translations of a project.
pub(crate) fn check(project: &Project, inputs: &[Input], quiet: bool) -> TranslationCheck {
    let translations = match Translations::open(project, inputs) {
        Ok(opened) => opened,
        Err(report) => return TranslationCheck { reports: vec![report], is_unrecorded: false },
    };
    if translations.source_locale.is_none() && !translations.fonts.is_any() {
        return translations.found(Vec::new(), 0);
    }
    let bar = console::progress_bar(inputs.len(), quiet);
    let compiler = Compiler::new(translations.options.clone()).progress(|files| bar.inc(files));
    // The check of the files reports those that cannot be read.
    let linted = compiler.each_file(inputs, |input, bytes| translations.lint(input, bytes));
    bar.finish_and_clear();
    let linted: Vec<LintResult> = linted.into_iter().filter_map(Result::ok).collect();
    let marked = linted.iter().filter(|linted| linted.is_marked).count();
    translations.found(linted.into_iter().filter_map(|linted| linted.report).collect(), marked)
}
