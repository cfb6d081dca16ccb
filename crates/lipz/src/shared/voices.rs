//! The voices of a project, and their recordings.

use crate::reporter::{Abort, Reporter};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Input, Voices};
use lipz_diagnostics::{Report, escape};
use lipz_file::locale::canonical_tag;
use lipz_sync::Recordings;
use std::collections::HashSet;

/// Returns the locale of the original recordings.
pub(crate) fn original_locale(settings: &Settings, reporter: &mut Reporter) -> Result<String, Abort> {
    let original = settings.voices().original.and_then(|locale| canonical_tag(&locale, true));
    original.ok_or_else(|| {
        let tip = "set `default-locale` in lipz.toml, or `locale` in [audio] if the recordings are in a different one";
        reporter.usage("the locale of the original recordings is not set", tip)
    })
}

/// Refuses a locale without a pattern in [voices], because its recordings would have no paths.
pub(crate) fn refuse_unknown_voice(
    locale: Option<&str>,
    settings: &Settings,
    reporter: &mut Reporter,
) -> Result<(), Abort> {
    let Some(locale) = locale.filter(|locale| !settings.audio.voices.contains_key(*locale)) else { return Ok(()) };
    let locale = escape::text(locale);
    let tip = format!("add it to [voices] of lipz.toml: {locale} = \"{locale}/{{key}}\"");
    Err(reporter.usage(format!("the project has no voice in {locale}"), &tip))
}

/// Returns the clips that are not dubs of others.
pub(crate) fn originals<'i>(inputs: &'i [Input], voices: &Voices) -> Vec<&'i Input> {
    let keys: HashSet<&str> = inputs.iter().map(|input| input.key.as_str()).collect();
    let is_original = |input: &&Input| voices.original_of(&input.key, |key| keys.contains(key)).is_none();
    inputs.iter().filter(is_original).collect()
}

/// Returns the recordings of a project, whose folder need not exist before the first session.
pub(crate) fn recordings(settings: &Settings) -> (Recordings, Vec<Report>) {
    match &settings.audio.folder {
        Some(folder) if folder.symlink_metadata().is_err() => (Recordings::planned(settings), Vec::new()),
        _ => Recordings::discover_with_reports(settings),
    }
}
