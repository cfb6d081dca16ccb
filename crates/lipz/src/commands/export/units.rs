//! The texts of clips, with information for translators and actors.

use crate::console;
use crate::shared::formats;
use crate::shared::text_record::RecordFile;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Input};
use lipz_diagnostics::{Report, Severity};
use lipz_file::Document;
use lipz_sync::Recordings;
use lipz_texts::{Collect, Unit};

/// The Lipz files of a project, from which units are made.
pub(super) struct UnitFiles<'a> {
    pub(super) settings: &'a Settings,
    pub(super) record: &'a RecordFile,
    pub(super) recordings: &'a Recordings,
    pub(super) is_quiet: bool,
}

/// The result for one clip.
struct ExportedClip {
    /// The unit of its texts, and those of its variants.
    units: Vec<Unit>,
    report: Option<Report>,
}

impl UnitFiles<'_> {
    /// Returns the units of all clips with a text in the source locale, sorted by key. Those of variants follow that of
    /// their clip.
    pub(super) fn units(
        &self,
        inputs: &[Input],
        (source_locale, locales): (&str, &[String]),
        reports: &mut Vec<Report>,
    ) -> Vec<Unit> {
        let UnitFiles { settings, record, recordings, is_quiet } = *self;
        let options = &settings.options;
        // Files in one locale have its limits.
        let limits = match locales {
            [only] => options.get_text_limits_of(only),
            _ => options.get_text_limits(),
        };
        let on_screen =
            limits.get_line_columns().zip(limits.get_lines()).map(|(columns, lines)| columns as usize * lines as usize);
        let collect = Collect::new(source_locale, locales.iter().cloned())
            .default_locale(options.get_default_locale().map(str::to_owned))
            .default_rate(options.get_default_fps().map(formats::rate))
            .limits(on_screen, limits.get_characters_per_second());
        let bar = console::progress_bar(inputs.len(), is_quiet);
        let compiler = Compiler::new(options.clone()).progress(|count| bar.inc(count));
        let results = compiler.each_file(inputs, |input, bytes| {
            let parsed = lipz_file::parse(bytes);
            let mut diagnostics = parsed.diagnostics;
            // `lipz check` reports the warnings about clips.
            diagnostics.retain(|diagnostic| diagnostic.severity == Severity::Error);
            let document: Document<'_> = parsed.document.unwrap_or_default();
            let mut units = Vec::from_iter(collect.unit(&input.key, &document, &mut diagnostics));
            if let Some(unit) = units.first() {
                units.extend(collect.variants(unit, &document));
            }
            for unit in &mut units {
                record.record.describe(&record.name(input), source_locale, locales, unit);
                unit.file = Some(input.name());
                unit.recording = recordings.find(&input.key).map(|path| path.to_string_lossy().replace('\\', "/"));
            }
            options.get_levels().apply(&mut diagnostics);
            let report = (!diagnostics.is_empty()).then(|| Report::from_bytes(input.name(), bytes, diagnostics));
            ExportedClip { units, report }
        });
        bar.finish_and_clear();
        let mut units = Vec::new();
        for result in results {
            match result {
                Ok(made) => {
                    units.extend(made.units);
                    reports.extend(made.report);
                }
                Err(report) => reports.push(report),
            }
        }
        units.sort_by(|a, b| a.key.cmp(&b.key));
        units
    }
}
