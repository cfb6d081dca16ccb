//! The times of words in a project.

use crate::record::{SyncRecord, record_place};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input, WordTimes};
use lipz_diagnostics::Report;
use std::collections::BTreeMap;

/// Returns the word times of these clips, by key, from the record of the project, for
/// [`Options::word_times`](lipz_compiler::Options::word_times). Clips that were not made from a recording have none,
/// nor do those made before records contained word times.
///
/// # Errors
/// If the record cannot be read. [`check`](crate::check()) reports problems of its lines.
pub fn word_times(settings: &Settings, inputs: &[Input]) -> Result<BTreeMap<String, WordTimes>, Report> {
    Ok(word_times_of(&SyncRecord::read(&record_place(settings))?, inputs))
}

/// Returns the same from this record.
pub fn word_times_of(record: &SyncRecord, inputs: &[Input]) -> BTreeMap<String, WordTimes> {
    let times = |input: &Input| {
        let Content::File(lipz_file) = &input.content else { return None };
        // If there are several lines after a merge, those of different texts are ignored later.
        let words = record.lines_for(lipz_file).iter().rev().find_map(|line| line.words.clone())?;
        Some((input.key.clone(), words))
    };
    inputs.iter().filter_map(times).collect()
}

#[cfg(test)]
mod tests {
    use lipz_speech::Language;
    use std::collections::BTreeSet;
    use std::path::Path;

    /// The compiler, which does not depend on lipz-speech, has words for nods and shakes in exactly these languages.
    #[test]
    fn heads_nod_in_each_language() {
        let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("../lipz-compiler/data/gestures.txt");
        let table = std::fs::read_to_string(table).expect("the table of words");
        for gesture in ["nod", "shake"] {
            let lines = table.lines().filter(|line| !line.starts_with('#')).filter_map(|line| line.split_once(": "));
            let codes: BTreeSet<&str> =
                lines.filter_map(|(head, _)| head.strip_suffix(gesture)).map(str::trim).collect();
            assert_eq!(codes, Language::all().map(Language::code).collect(), "{gesture}");
        }
    }
}
