//! Frames of Oculus (Meta) OVRLipSync as CSV: a line per frame with the weights of its 15 visemes. A first line may
//! name the columns in any order; without it, they have the order of the SDK. All weights become
//! curves. The strongest viseme becomes the shape of the frame, or rest if it is below a threshold.

use super::Format;
use super::face_frames::{self, Symbols};
use crate::source::{self, Line};
use crate::{ImportOptions, Time, Track, find_map};
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::rate::Rate;

const TABLE: &str = "ovr";
/// The visemes in the order of their weights.
const VISEMES: [&str; 15] = ["sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou"];
/// Alternative names of some visemes, used by HeadAudio and avatars' blend shapes.
const ALIASES: [(&str, &str); 6] =
    [("sil", "silence"), ("kk", "k"), ("nn", "n"), ("ih", "I"), ("oh", "O"), ("ou", "U")];
/// A prefix that some tools add to the names.
const PREFIX: &str = "viseme_";
/// The column with the time of the frame in milliseconds.
const TIME: [&str; 3] = ["time_ms", "timestamp_ms", "ms"];
/// Weaker visemes are ignored, as in OpenFaceFX.
const FLOOR: f32 = 0.1;
/// The frame rate of a dump that does not state one.
const RATE: Rate = Rate { numerator: 60, denominator: 1, is_exact: true };

pub(super) const FORMAT: Format = Format {
    name: "ovr",
    about: "OVRLipSync frames, CSV with 15 weights a line",
    extension: "csv",
    maps: &[TABLE],
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

/// The content of a column.
#[derive(Clone, Copy, PartialEq)]
enum OvrColumn {
    /// The weight of a viseme.
    Weight(&'static str),
    /// Milliseconds since the start.
    Time,
    /// A column that is not about the mouth.
    Other,
}

impl OvrColumn {
    fn weight(self) -> Option<&'static str> {
        match self {
            OvrColumn::Weight(viseme) => Some(viseme),
            OvrColumn::Time | OvrColumn::Other => None,
        }
    }
}

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let rate = options.file_rate.unwrap_or(RATE);
    let mut track = Track { rate: Some(rate), ..Track::default() };
    let mut lines = source::lines(text).filter(|line| !line.text.trim().is_empty()).peekable();
    let mut columns: Vec<OvrColumn> = VISEMES.map(OvrColumn::Weight).into();
    if let Some(line) = lines.next_if(|line| fields(*line).iter().any(|field| field.text.parse::<f64>().is_err())) {
        let Some(named) = header(line, diagnostics) else { return Vec::new() };
        columns = named;
    }
    let Some(map) = options.map.or_else(|| find_map(TABLE)) else { return Vec::new() };
    track.weights.names = columns.iter().filter_map(|column| column.weight()).map(str::to_owned).collect();
    for (frame, line) in (0..).zip(lines) {
        let fields = fields(line);
        if fields.len() != columns.len() {
            let message = format!("a frame has {} columns, not {}", fields.len(), columns.len());
            diagnostics.push(line.diagnostic(Code::ForeignSyntax, message));
            continue;
        }
        let mut start = Time::of_frame(frame, rate);
        let mut weights = Vec::with_capacity(columns.len());
        for (column, field) in columns.iter().zip(fields) {
            match column {
                OvrColumn::Other => {}
                OvrColumn::Time => match Time::parse(&format!("{}e-3", field.text)) {
                    Some(time) => start = time,
                    None => diagnostics.push(field.not("a time in milliseconds")),
                },
                OvrColumn::Weight(_) => weights.extend(face_frames::weight(field, diagnostics)),
            }
        }
        if weights.len() == track.weights.names.len() {
            let symbols = Symbols::Strongest { map, floor: FLOOR, rest: "sil" };
            face_frames::add(&mut track, symbols, Some(line.span()), start, weights);
        }
    }
    face_frames::finish(&mut track, rate);
    vec![track]
}

/// Returns the columns named in the first line. Reports missing visemes and unused columns.
fn header(line: Line<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<OvrColumn>> {
    let names = fields(line);
    let columns: Vec<OvrColumn> = names.iter().map(|name| column(name.text)).collect();
    let is_missing =
        |viseme: &str| !columns.iter().any(|column| matches!(column, OvrColumn::Weight(known) if *known == viseme));
    let missing: Vec<&str> = VISEMES.into_iter().filter(|viseme| is_missing(viseme)).collect();
    if !missing.is_empty() {
        let message = format!("the columns lack the visemes {}", missing.join(", "));
        let found = line.diagnostic(Code::ForeignSyntax, message);
        diagnostics.push(found.help(format!("write all visemes, in any order: {}", VISEMES.join(","))));
        return None;
    }
    for (index, (column, name)) in columns.iter().zip(&names).enumerate() {
        if *column != OvrColumn::Other && columns.iter().take(index).any(|before| before == column) {
            diagnostics.push(name.diagnostic(Code::ForeignSyntax, "a second column has the same name"));
            return None;
        }
    }
    let others: Vec<String> = names
        .iter()
        .zip(&columns)
        .filter(|(_, column)| **column == OvrColumn::Other)
        .map(|(name, _)| escape::quoted(name.text))
        .collect();
    if !others.is_empty() {
        let message = format!("columns without the name of a viseme are not read: {}", others.join(", "));
        diagnostics.push(line.diagnostic(Code::ForeignOddity, message));
    }
    Some(columns)
}

/// Returns the column with this name, in either case.
fn column(name: &str) -> OvrColumn {
    let name = name.trim_matches('"');
    if TIME.iter().any(|time| time.eq_ignore_ascii_case(name)) {
        return OvrColumn::Time;
    }
    let bare = match name.get(..PREFIX.len()) {
        Some(prefix) if prefix.eq_ignore_ascii_case(PREFIX) => name.get(PREFIX.len()..).unwrap_or_default(),
        _ => name,
    };
    let is = |known: &str| known.eq_ignore_ascii_case(bare);
    let viseme = VISEMES.into_iter().find(|viseme| is(viseme));
    let by_alias = || ALIASES.iter().find(|(_, alias)| is(alias)).map(|(viseme, _)| *viseme);
    viseme.or_else(by_alias).map_or(OvrColumn::Other, OvrColumn::Weight)
}

/// Returns the fields between commas or semicolons. Quotes need no support, because weights have none.
fn fields(line: Line<'_>) -> Vec<Line<'_>> {
    let mut at = line.at;
    let field = |text| {
        let field = Line { text, at };
        at += text.len() + 1;
        field.trimmed()
    };
    line.text.split([',', ';']).map(field).collect()
}
