//! From files of other tools to clips, and from there to Lipz files: new ones, or those that exist.

use super::options::Settings;
use super::text::Texts;
use super::{Import, joined, phones};
use crate::interrupt::Files;
use crate::shared::existing::Existing;
use crate::shared::formats::{self, Source};
use lipz_compiler::{Content, Input, key};
use lipz_diagnostics::{Diagnostic, Report};
use lipz_file::format::{Style, format};
use lipz_interop::{Clip, Imported, Script, import};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// A clip on its way to its file.
pub(super) struct Made {
    pub(super) input: Input,
    pub(super) clip: Clip,
    /// The file that is there already.
    existing: Option<Existing>,
    /// The name of the file without folders and extension.
    pub(super) stem: String,
    /// Whether a text for it was found.
    pub(super) has_text: bool,
}

/// Where a clip went.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// Into a file of its own.
    File,
    /// Into a file that existed, which kept everything else.
    Merged,
    /// A diagnostic that is an error forbids it.
    Nowhere,
}

/// Reads every file. Those with errors give no clips, nor do those whose keys cannot be used.
pub(super) fn read(
    arguments: &Import,
    files: &[PathBuf],
    folder: Option<&Path>,
    settings: &Settings<'_>,
    texts: &Texts,
    script: &Script,
    reports: &mut Vec<Report>,
) -> Vec<Made> {
    let mut made = Vec::new();
    let encoding = arguments.options.recordings.encoding;
    for file in files {
        let clips = Source::read(file, arguments.tool_format, arguments.root.as_deref(), encoding)
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

/// The clips of one file.
#[allow(clippy::too_many_arguments, reason = "what a run of the command has")]
fn one(
    arguments: &Import,
    file: &Path,
    source: &Source,
    folder: Option<&Path>,
    settings: &Settings<'_>,
    texts: &Texts,
    script: &Script,
    reports: &mut Vec<Report>,
) -> Result<Vec<Made>, Report> {
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
    let key = |clip: &Clip| match &clip.name {
        Some(name) => format!("{}-{}", source.key, formats::file_name(name)),
        None => source.key.clone(),
    };
    let existing = |clip: &Clip| match folder {
        Some(folder) => Existing::find(&formats::path(folder, &key(clip), key::EXTENSION)),
        None => Ok(None),
    };
    let existing: Vec<Option<Existing>> = imported.clips.iter().map(existing).collect::<Result<_, _>>()?;
    if !arguments.replace
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
    let Imported { clips, diagnostics: found, .. } = imported;
    diagnostics.extend(found);
    settings.apply_levels(&mut diagnostics);
    let is_wrong = diagnostics.iter().any(Diagnostic::is_error);
    reports.extend(source.report(tool_format, diagnostics));
    let made = |(clip, existing)| {
        let input = Input { key: key(&clip), content: Content::File(file.to_owned()) };
        Made { input, clip, existing, stem: source.stem().to_owned(), has_text: options.text.is_some() }
    };
    Ok(if is_wrong { Vec::new() } else { clips.into_iter().zip(existing).map(made).collect() })
}

impl Made {
    /// The clip as a Lipz file in canonical layout.
    pub(super) fn layout(&self, settings: &Settings<'_>) -> String {
        let style = Style { default_locale: settings.default_locale(), ..Style::default() };
        format(&self.clip.document, style)
    }

    /// Writes the clip: as a new file, in place of the one that is there, or into that.
    pub(super) fn write(
        &self,
        files: &Files,
        replace: bool,
        folder: &Path,
        settings: &Settings<'_>,
        reports: &mut Vec<Report>,
    ) -> Result<Place, Report> {
        let Some(existing) = &self.existing else {
            let path = formats::path(folder, &self.input.key, key::EXTENSION);
            return files.replace(&path, self.layout(settings).as_bytes()).map(|()| Place::File);
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
                return existing.replace(files, &self.layout(settings)).map(|()| Place::File);
            }
            return Ok(Place::Nowhere);
        }
        let before = existing.document()?;
        let merged = self.clip.merge(&before, &settings.merge_options());
        if may_go_on(merged.diagnostics) {
            return existing
                .update(files, &before, &merged.document, settings.default_locale())
                .map(|()| Place::Merged);
        }
        Ok(Place::Nowhere)
    }
}
