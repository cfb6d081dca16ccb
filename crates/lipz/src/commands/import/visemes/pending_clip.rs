//! Conversion of other tools' files into clips, which go into new or existing Lipz files.

use super::options::Settings;
use super::text::TextSource;
use super::{ImportVisemes, joined, phones};
use crate::interrupt::Files;
use crate::shared::existing_file::ExistingFile;
use crate::shared::formats::{self, ToolFile};
use lipz_compiler::{Content, Input, key};
use lipz_diagnostics::{Diagnostic, Report};
use lipz_file::format::{Style, format};
use lipz_interop::{ImportResult, ImportedClip, Script, import};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// An imported clip, before it is written.
pub(super) struct PendingClip {
    pub(super) input: Input,
    pub(super) clip: ImportedClip,
    /// The existing file, if there is one.
    existing: Option<ExistingFile>,
    /// The name of the file without folders and extension.
    pub(super) stem: String,
    /// Whether it has a text.
    pub(super) has_text: bool,
}

/// The destination of a clip.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum ClipDestination {
    /// A file of its own.
    File,
    /// An existing file, which keeps everything else.
    Merged,
    /// None, because of an error.
    Nowhere,
}

/// Reads every file. Files with errors or with unusable keys produce no clips.
pub(super) fn read(
    arguments: &ImportVisemes,
    files: &[PathBuf],
    folder: Option<&Path>,
    settings: &Settings<'_>,
    texts: &TextSource,
    script: &Script,
    reports: &mut Vec<Report>,
) -> Vec<PendingClip> {
    let mut made = Vec::new();
    let encoding = arguments.options.recordings.encoding;
    for file in files {
        let clips = ToolFile::read(file, arguments.tool_format, arguments.root.as_deref(), encoding)
            .and_then(|source| one(arguments, file, &source, folder, settings, texts, script, reports));
        match clips {
            Ok(clips) => made.extend(clips),
            Err(report) => reports.push(report),
        }
    }
    key::check(&made.iter().map(|made| made.input.clone()).collect::<Vec<_>>(), reports);
    let mut files_of_key = HashMap::<String, usize>::new();
    for made in &made {
        *files_of_key.entry(key::folded(&made.input.key)).or_default() += 1;
    }
    let is_usable = |key: &str| key::refusal(key).is_none() && files_of_key.get(&key::folded(key)) == Some(&1);
    made.retain(|made| is_usable(&made.input.key));
    match joined::report(arguments, files, &made, settings, texts, script) {
        Ok(report) => reports.extend(report),
        Err(report) => reports.push(report),
    }
    made
}

/// Returns the clips of one file.
#[allow(clippy::too_many_arguments, reason = "they are the data of one run")]
fn one(
    arguments: &ImportVisemes,
    file: &Path,
    source: &ToolFile,
    folder: Option<&Path>,
    settings: &Settings<'_>,
    texts: &TextSource,
    script: &Script,
    reports: &mut Vec<Report>,
) -> Result<Vec<PendingClip>, Report> {
    let tool_format = arguments.tool_format;
    let mut odd = Vec::new();
    let text = texts.of_key(&source.key, &mut odd)?;
    for mut report in odd {
        settings.apply_levels(&mut report.diagnostics);
        reports.push(report);
    }
    let mut options = settings.import_options().text(text.as_deref());
    arguments.options.recordings.apply(file, source, script, &mut options);
    let mut imported = import(tool_format, &source.bytes, &options);
    let key = |clip: &ImportedClip| match &clip.name {
        Some(name) => format!("{}-{}", source.key, formats::file_name(name)),
        None => source.key.clone(),
    };
    let existing = |clip: &ImportedClip| match folder {
        Some(folder) => ExistingFile::find(&formats::path(folder, &key(clip), key::EXTENSION)),
        None => Ok(None),
    };
    let existing: Vec<Option<ExistingFile>> = imported.clips.iter().map(existing).collect::<Result<_, _>>()?;
    if !arguments.overwrite
        && let Some(as_before) = settings.as_before(existing.iter().flatten(), &options)
    {
        options = as_before;
        imported = import(tool_format, &source.bytes, &options);
    }
    let mut diagnostics = source.diagnostics.clone();
    if let Some(by_phones) =
        phones::by_phones(tool_format, source, settings, &options, (&imported, &existing), &mut diagnostics)
    {
        imported = by_phones;
    }
    let ImportResult { clips, diagnostics: found, .. } = imported;
    diagnostics.extend(found);
    settings.apply_levels(&mut diagnostics);
    let is_wrong = diagnostics.iter().any(Diagnostic::is_error);
    reports.extend(source.report(tool_format, diagnostics));
    let made = |(clip, existing)| {
        let input = Input { key: key(&clip), content: Content::File(file.to_owned()) };
        PendingClip { input, clip, existing, stem: source.stem().to_owned(), has_text: options.text.is_some() }
    };
    Ok(if is_wrong { Vec::new() } else { clips.into_iter().zip(existing).map(made).collect() })
}

impl PendingClip {
    /// Returns the clip as a Lipz file in canonical layout.
    pub(super) fn layout(&self, settings: &Settings<'_>) -> String {
        let style = Style { default_locale: settings.default_locale(), ..Style::default() };
        format(&self.clip.document, style)
    }

    /// Returns the Lipz file of the clip.
    pub(super) fn output(&self, folder: &Path) -> Input {
        let path = formats::path(folder, &self.input.key, key::EXTENSION);
        Input { key: self.input.key.clone(), content: Content::File(path) }
    }

    /// Writes the clip: as a new file, over the existing one, or into it.
    pub(super) fn write(
        &self,
        files: &Files,
        replace: bool,
        folder: &Path,
        settings: &Settings<'_>,
        reports: &mut Vec<Report>,
    ) -> Result<ClipDestination, Report> {
        let Some(existing) = &self.existing else {
            let path = formats::path(folder, &self.input.key, key::EXTENSION);
            return files.replace(&path, self.layout(settings).as_bytes()).map(|()| ClipDestination::File);
        };
        let mut may_go_on = |mut diagnostics: Vec<Diagnostic>| {
            settings.apply_levels(&mut diagnostics);
            let has_errors = diagnostics.iter().any(Diagnostic::is_error);
            if !diagnostics.is_empty() {
                reports.push(existing.report(diagnostics));
            }
            !has_errors
        };
        if replace {
            if may_go_on(existing.loss(&self.clip.document).into_iter().collect()) {
                return existing.replace(files, &self.layout(settings)).map(|()| ClipDestination::File);
            }
            return Ok(ClipDestination::Nowhere);
        }
        let before = existing.document()?;
        let merged = self.clip.merge(&before, &settings.merge_options());
        if may_go_on(merged.diagnostics) {
            return existing
                .update(files, &before, &merged.document, settings.default_locale())
                .map(|()| ClipDestination::Merged);
        }
        Ok(ClipDestination::Nowhere)
    }
}
