//! Arbitrary files as files of translators.

use super::file::is_about;
use lipz_diagnostics::Diagnostic;
use lipz_texts::{Format, Merge, ReadOptions, Standing, State, TextRecord, read};

/// The clip that the translations belong to, with everything that a merge has to preserve.
const CLIP: &str = r#"{ "visemes": "MA|EO", "text_en-us": "a {b} \u00e9|c", "note": [1,  2],
  "text_de-de": "x {b}  |", "events": "|feels sad" }"#;

/// The first byte selects the format. Positions are in their text. After any merge, the clip is still a Lipz file in
/// which only texts of other locales have changed; merging again changes nothing.
pub fn texts(bytes: &[u8]) {
    let Some((first, rest)) = bytes.split_first() else { return };
    let format = match first {
        b'X' => Format::Xliff,
        b'C' => Format::Csv,
        b'S' => Format::Xlsx,
        b'J' => Format::Json,
        _ => Format::Po,
    };
    let incoming = read(format, rest, &ReadOptions::new("en-us"));
    incoming.diagnostics.iter().for_each(|found| is_about(found, &incoming.text));
    let is_inside = |span: lipz_diagnostics::Span| incoming.text.get(span.range()).is_some();
    assert!(incoming.entries.iter().all(|entry| is_inside(entry.text.span) && is_inside(entry.key.span)));
    let mut entries = incoming.entries.clone();
    // Entries of other clips serve as well.
    entries.retain(|entry| &*entry.locale != "en-us");
    entries.truncate(64);
    let before = lipz_file::parse(CLIP.as_bytes()).document.unwrap();
    let merge = Merge::new("en-us").min_state(State::Initial).forced(true);
    let merged = merge.merge(CLIP, &before, &entries.iter().collect::<Vec<_>>());
    merged.found.iter().for_each(|(_, found): &(usize, Diagnostic)| is_about(found, &incoming.text));
    let Some(text) = merged.text else { return };
    let after = lipz_file::parse(text.as_bytes()).document.unwrap();
    for name in ["visemes", "text_en-us", "events", "note"] {
        assert_eq!(after.get(name).map(|element| &element.value), before.get(name).map(|element| &element.value));
    }
    let again = merge.merge(&text, &after, &entries.iter().collect::<Vec<_>>());
    assert_eq!(again.text, None, "{text}");
}

/// Reads any bytes as the record of source texts. Positions are in the file, and a written record is read as an equal
/// one, even after git has merged two branches. Accepted entries are up to date.
pub fn text_record(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let Some((mut record, found)) = TextRecord::parse(&text) else { return };
    found.iter().for_each(|found| is_about(found, &text));
    let written = record.to_string();
    for twice in [written.clone(), format!("{written}{written}")] {
        let (again, found) = TextRecord::parse(&twice).expect("it is a record");
        assert_eq!((again.to_string(), found.len()), (written.clone(), 0));
    }
    let files: Vec<String> = record.files().take(4).map(str::to_owned).collect();
    let (sources, texts) = (["Aye.", "No | one."], ["Ja.", ""]);
    for file in &files {
        let standings = record.standings(file, "en-us", "de-de", &sources, &texts);
        assert_eq!(standings.len(), texts.len());
        record.approve(file, "en-us", "de-de", &sources, &texts, &[Some(State::Translated), None]);
        let standings = record.standings(file, "en-us", "de-de", &sources, &texts);
        assert_eq!(standings[0], Standing::Current(State::Translated), "{record}");
    }
}
