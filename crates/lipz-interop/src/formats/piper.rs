//! Phones of Piper's voices, JSON: `phoneme_alignments` lists phones in IPA with their numbers of samples, and
//! `sample_rate` the samples per second. A stream has a chunk per sentence.

use super::Format;
use crate::json::{self, Node};
use crate::textgrid::symbols::phone_symbol;
use crate::{ImportOptions, Shape, Time, Track, source};
use lipz_diagnostics::Diagnostic;

/// The sample rate of chunks that do not state one: that of Piper's voices of medium and high quality.
const SAMPLE_RATE_HZ: u32 = 22_050;
/// Marks of Piper around a sentence, and between its phones.
const MARKS: [&str; 3] = ["^", "$", "_"];

pub(super) const FORMAT: Format = Format {
    name: "piper",
    about: "Piper voices, JSON with phoneme_alignments",
    extension: "json",
    maps: &["ipa"],
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let mut chunks = json::joined(text, diagnostics);
    if let [only] = chunks.as_slice()
        && let Some(items) = only.items()
    {
        chunks = items;
    }
    let mut track = Track::default();
    let (mut samples, mut rate_hz) = (0_u64, SAMPLE_RATE_HZ);
    for chunk in chunks {
        if let Some(node) = chunk.get(&["sample_rate"]) {
            match node.number().and_then(|number| number.parse().ok()).filter(|rate| *rate > 0) {
                Some(rate) => rate_hz = rate,
                None => diagnostics.push(node.not("a sample rate in hertz")),
            }
        }
        let Some(phones) = chunk.get(&["phoneme_alignments"]).and_then(Node::items) else {
            let lacks = chunk.lacks("a list \"phoneme_alignments\"");
            diagnostics.push(lacks.help("use a voice with alignments, and store the alignments of each audio chunk"));
            continue;
        };
        for phone in phones {
            let label = phone.get(&["phoneme"]).and_then(Node::string);
            let count = phone.get(&["num_samples"]).and_then(Node::number).and_then(|count| count.parse::<u64>().ok());
            let (Some(label), Some(count)) = (label, count) else {
                diagnostics.push(phone.lacks("a \"phoneme\" or its \"num_samples\""));
                continue;
            };
            let start = Time::new(samples, rate_hz);
            samples = samples.saturating_add(count);
            // Marks of stress and length belong to the phone before them.
            if is_mark(&label) && !track.shapes.is_empty() {
                continue;
            }
            let is_pause = MARKS.contains(&label.as_str()) || !label.chars().any(char::is_alphabetic);
            let symbol = phone_symbol(if is_pause || is_mark(&label) { "" } else { &label }, options.map);
            track.shapes.push(Shape::at(phone.span(), start, symbol));
        }
    }
    track.end = Some(Time::new(samples, rate_hz));
    vec![track]
}

/// Whether a label consists of modifier letters and combining marks.
fn is_mark(label: &str) -> bool {
    !label.is_empty() && label.chars().all(|c| ('\u{2b0}'..='\u{36f}').contains(&c))
}
