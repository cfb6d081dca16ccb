//! Frames of Oculus (Meta) OVRLipSync as CSV: a line per frame with the weights of its 15 visemes. A first line
//! may name the columns, in any order; without it they are in that of the SDK. The strongest viseme is the shape
//! of the frame; below a floor, it is silence.

use super::Format;
use crate::source::{self, Line};
use crate::{ImportOptions, Shape, Time, Track};
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::rate::Rate;

/// The visemes in the order of their weights.
const VISEMES: [&str; 15] = ["sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou"];
/// Other names of some visemes, as HeadAudio and avatars' blend shapes have them.
const ALIASES: [(&str, &str); 6] =
    [("sil", "silence"), ("kk", "k"), ("nn", "n"), ("ih", "I"), ("oh", "O"), ("ou", "U")];
/// What comes before the names in some tools.
const PREFIX: &str = "viseme_";
/// The column with the time of the frame in milliseconds.
const TIME: [&str; 3] = ["time_ms", "timestamp_ms", "ms"];
/// No viseme weaker than this is shown, as in OpenFaceFX.
const FLOOR: f64 = 0.1;
/// Frames a second of a dump that does not say.
const RATE: Rate = Rate { numerator: 60, denominator: 1, is_exact: true };

pub(super) const FORMAT: Format = Format {
    name: "ovr",
    about: "OVRLipSync frames, CSV with 15 weights a line",
    extension: "csv",
    maps: &["ovr"],
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

/// What a column has.
#[derive(Clone, Copy, PartialEq)]
enum Column {
    /// The weight of a viseme.
    Weight(&'static str),
    /// Milliseconds since the start.
    Time,
    /// Something that says nothing about mouths.
    Other,
}

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let rate = options.file_rate.unwrap_or(RATE);
    let mut track = Track { rate: Some(rate), ..Track::default() };
    let mut lines = source::lines(text).filter(|line| !line.text.trim().is_empty()).peekable();
    let mut columns: Vec<Column> = VISEMES.map(Column::Weight).into();
    if let Some(line) = lines.next_if(|line| fields(*line).iter().any(|field| field.text.parse::<f64>().is_err())) {
        let Some(named) = header(line, diagnostics) else { return Vec::new() };
        columns = named;
    }
    let mut end = Time::ZERO;
    for (frame, line) in (0..).zip(lines) {
        let fields = fields(line);
        if fields.len() != columns.len() {
            let message = format!("a frame has {} columns, not {}", fields.len(), columns.len());
            diagnostics.push(line.diagnostic(Code::ForeignSyntax, message));
            continue;
        }
        let mut start = Time::of_frame(frame, rate);
        let mut strongest = ("sil", FLOOR, line);
        for (column, field) in columns.iter().zip(fields) {
            match (column, field.text.parse::<f64>()) {
                (Column::Other, _) => {}
                (Column::Time, _) => match Time::parse(&format!("{}e-3", field.text)) {
                    Some(time) => start = time,
                    None => diagnostics.push(field.not("a time in milliseconds")),
                },
                (Column::Weight(viseme), Ok(weight)) if weight.is_finite() => {
                    if weight > strongest.1 {
                        strongest = (viseme, weight, field);
                    }
                }
                (Column::Weight(_), _) => diagnostics.push(field.not("a weight from 0 to 1")),
            }
        }
        track.shapes.push(Shape::at(strongest.2.span(), start, strongest.0));
        end = Time::of_frame(start.nearest_frame(rate).saturating_add(1), rate);
    }
    track.end = Some(end);
    vec![track]
}

/// The columns that the first line names; reports visemes that it lacks, and columns that are not read.
fn header(line: Line<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<Column>> {
    let names = fields(line);
    let columns: Vec<Column> = names.iter().map(|name| column(name.text)).collect();
    let is_missing =
        |viseme: &str| !columns.iter().any(|column| matches!(column, Column::Weight(known) if *known == viseme));
    let missing: Vec<&str> = VISEMES.into_iter().filter(|viseme| is_missing(viseme)).collect();
    if !missing.is_empty() {
        let message = format!("the columns lack the visemes {}", missing.join(", "));
        let found = line.diagnostic(Code::ForeignSyntax, message);
        diagnostics.push(found.help(format!("name all of them, in any order: {}", VISEMES.join(","))));
        return None;
    }
    for (index, (column, name)) in columns.iter().zip(&names).enumerate() {
        if *column != Column::Other && columns.iter().take(index).any(|before| before == column) {
            diagnostics.push(name.diagnostic(Code::ForeignSyntax, "two columns have this name"));
            return None;
        }
    }
    let others: Vec<String> = names
        .iter()
        .zip(&columns)
        .filter(|(_, column)| **column == Column::Other)
        .map(|(name, _)| escape::quoted(name.text))
        .collect();
    if !others.is_empty() {
        let message = format!("columns that name no viseme are not read: {}", others.join(", "));
        diagnostics.push(line.diagnostic(Code::ForeignOddity, message));
    }
    Some(columns)
}

/// The column of this name, whatever the case of its letters.
fn column(name: &str) -> Column {
    let name = name.trim_matches('"');
    if TIME.iter().any(|time| time.eq_ignore_ascii_case(name)) {
        return Column::Time;
    }
    let bare = match name.get(..PREFIX.len()) {
        Some(prefix) if prefix.eq_ignore_ascii_case(PREFIX) => name.get(PREFIX.len()..).unwrap_or_default(),
        _ => name,
    };
    let is = |known: &str| known.eq_ignore_ascii_case(bare);
    let viseme = VISEMES.into_iter().find(|viseme| is(viseme));
    let by_alias = || ALIASES.iter().find(|(_, alias)| is(alias)).map(|(viseme, _)| *viseme);
    viseme.or_else(by_alias).map_or(Column::Other, Column::Weight)
}

/// The fields between commas or semicolons, without quotes: weights have none.
fn fields(line: Line<'_>) -> Vec<Line<'_>> {
    let mut at = line.at;
    let field = |text| {
        let field = Line { text, at };
        at += text.len() + 1;
        field.trimmed()
    };
    line.text.split([',', ';']).map(field).collect()
}
