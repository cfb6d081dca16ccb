//! Timestamps of Cartesia's voices: the messages of its stream, each a JSON object. `phoneme_timestamps` has phones in
//! IPA with starts and ends in seconds, and `word_timestamps` has the words. All other messages are audio.
//!
//! A connection carries several utterances. `context_id` states the utterance of a message, and the times of each start
//! at 0.

use super::Format;
use crate::json::{self, Node};
use crate::source::{self, Line};
use crate::textgrid::symbols::phone_symbol;
use crate::{ImportOptions, Shape, Time, TimedText, Track};
use lipz_diagnostics::{Code, Diagnostic};
use std::collections::HashMap;

pub(super) const FORMAT: Format = Format {
    name: "cartesia",
    about: "Cartesia voices, messages with timestamps",
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
    let mut utterances: Vec<Utterance> = Vec::new();
    let mut index_of: HashMap<Option<String>, usize> = HashMap::new();
    for message in messages(text, diagnostics) {
        let phones = stretches(message, "phoneme_timestamps", "phonemes", diagnostics);
        let words = stretches(message, "word_timestamps", "words", diagnostics);
        if message.get(&["type"]).and_then(Node::string).is_some_and(|kind| kind == "error") {
            let what = message.get(&["message", "error"]).and_then(Node::string).unwrap_or_default();
            let diagnostic =
                Diagnostic::at(Code::ForeignValue, message.span(), format!("the service reports an error: {what}"));
            diagnostics.push(diagnostic.help("request the recording again"));
        }
        if phones.is_empty() && words.is_empty() {
            continue;
        }
        let context = message.get(&["context_id"]).and_then(Node::string);
        let index = *index_of.entry(context.clone()).or_insert(utterances.len());
        if index == utterances.len() {
            utterances.push(Utterance { track: Track { name: context, ..Track::default() }, ended: None });
        }
        utterances.get_mut(index).into_iter().for_each(|utterance| utterance.add(&phones, &words, options));
    }
    if utterances.is_empty() {
        return vec![Track::default()];
    }
    utterances.into_iter().map(|utterance| Track { end: utterance.ended, ..utterance.track }).collect()
}

/// An utterance that is being read.
struct Utterance {
    track: Track,
    /// The end of the phones up to now.
    ended: Option<Time>,
}

impl Utterance {
    fn add(&mut self, phones: &[Stretch], words: &[Stretch], options: &ImportOptions<'_>) {
        for phone in phones {
            let shape = |start, label: &str| Shape::at(phone.span, start, phone_symbol(label, options.map));
            if let Some(gap) = self.ended.filter(|ended| *ended < phone.start) {
                self.track.shapes.push(shape(gap, ""));
            }
            self.track.shapes.push(shape(phone.start, &phone.label));
            self.ended = self.ended.max(Some(phone.end));
        }
        self.track.words.extend(words.iter().map(|word| TimedText { start: word.start, text: word.label.clone() }));
    }
}

/// Returns the messages, which may be concatenated, an array, or the `data:` of server-sent events.
fn messages<'t>(text: &'t str, diagnostics: &mut Vec<Diagnostic>) -> Vec<Node<'t>> {
    let data = |line: Line<'t>| {
        let json = line.text.strip_prefix("data:")?;
        Some(Line { text: json, at: line.at + line.text.len() - json.len() })
    };
    let first = text.trim_start();
    if first.starts_with('[') {
        return json::root(text, diagnostics).and_then(Node::items).unwrap_or_default();
    }
    if first.starts_with('{') || !source::lines(text).any(|line| data(line).is_some()) {
        return json::joined(text, diagnostics);
    }
    let mut messages = Vec::new();
    for line in source::lines(text).filter_map(data) {
        match json::root(line.text, &mut Vec::new()) {
            Some(root) => messages.push(Node { line: Line { at: line.at + root.line.at, ..root.line } }),
            None => diagnostics.push(line.not("a message, a JSON object on a line")),
        }
    }
    messages
}

/// A phone or a word.
struct Stretch {
    start: Time,
    end: Time,
    label: String,
    span: lipz_diagnostics::Span,
}

/// Returns the stretches that a message has under `name`, with their labels under `labels`.
fn stretches(message: Node<'_>, name: &str, labels: &str, diagnostics: &mut Vec<Diagnostic>) -> Vec<Stretch> {
    // In some versions, the whole message consists of the timestamps.
    let holder = message.get(&[name]).or_else(|| message.get(&[labels]).map(|_| message));
    let Some(holder) = holder.filter(|holder| holder.is_object()) else { return Vec::new() };
    let mut list = |name: &str| {
        let items = holder.get(&[name]).and_then(Node::items);
        if items.is_none() {
            diagnostics.push(holder.lacks(&format!("a list \"{name}\"")));
        }
        items
    };
    let (Some(names), Some(starts), Some(ends)) = (list(labels), list("start"), list("end")) else { return Vec::new() };
    if names.len() != starts.len() || names.len() != ends.len() {
        let message = format!("{} {labels} have {} starts and {} ends", names.len(), starts.len(), ends.len());
        diagnostics.push(Diagnostic::at(Code::ForeignSyntax, holder.span(), message));
        return Vec::new();
    }
    let mut stretches = Vec::with_capacity(names.len());
    for ((label, start), end) in names.into_iter().zip(starts).zip(ends) {
        let mut time = |node: Node<'_>| {
            let time = node.number().and_then(|seconds| Time::parse(&seconds));
            if time.is_none() {
                diagnostics.push(node.not("a time in seconds, 0 or later"));
            }
            time
        };
        let (Some(start), Some(end)) = (time(start), time(end)) else { continue };
        match label.string() {
            Some(text) => stretches.push(Stretch { start, end: end.max(start), label: text, span: label.span() }),
            None => diagnostics.push(label.not("a text")),
        }
    }
    stretches
}
