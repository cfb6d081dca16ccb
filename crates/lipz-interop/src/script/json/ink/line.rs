//! Lines of a story while they are read. A line can have several alternatives, which are read side by side.

use super::super::{ExportedLine, span_in};
use crate::json::Node;
use lipz_diagnostics::Span;
use std::collections::BTreeMap;

/// The most alternatives of a line. If there are more, its text is not compared.
const MAX_ALTERNATIVES: usize = 64;

/// The most IDs of a line. Usually, it has one.
const MAX_IDS: usize = 64;

/// The longest line that is compared, in bytes.
const MAX_BYTES: usize = 16 * 1024;

/// Finished lines, by the positions of their IDs.
#[derive(Default)]
pub(super) struct FinishedLines(BTreeMap<u32, ExportedLine>);

impl FinishedLines {
    fn add(&mut self, line: InkLine) {
        let mut text = line.text.split_whitespace().collect::<Vec<_>>().join(" ");
        if text.is_empty() && !line.is_varying {
            return;
        }
        if line.is_varying || line.ids.len() > 1 {
            // With several IDs, each has an unknown part of the text.
            text.clear();
        }
        for (id, span) in line.ids {
            let new = ExportedLine { id, text: text.clone(), span };
            let known = self.0.entry(span.start).or_insert_with(|| new.clone());
            // Different texts at one ID are alternatives.
            if known.text != new.text {
                known.text.clear();
            }
        }
    }

    pub(super) fn into_lines(self) -> Vec<ExportedLine> {
        self.0.into_values().collect()
    }
}

/// One alternative of a line.
#[derive(Clone, PartialEq, Default, Debug)]
struct InkLine {
    text: String,
    /// Whether a part of the text is different each time.
    is_varying: bool,
    ids: Vec<(String, Span)>,
    /// The tag that is being read, with its position.
    tag: Option<(String, Option<Span>)>,
    /// Whether a line break follows, which glue may remove.
    is_ended: bool,
    is_glued: bool,
}

/// The alternatives of the current line; none if the story has moved elsewhere.
#[derive(Clone, PartialEq, Default, Debug)]
pub(super) struct InkLines(Vec<InkLine>);

impl InkLines {
    /// Returns the start of a line.
    pub(super) fn start() -> InkLines {
        InkLines(vec![InkLine::default()])
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds the alternatives of `more`.
    pub(super) fn join(&mut self, more: InkLines, out: &mut FinishedLines) {
        for line in more.0 {
            if !self.0.contains(&line) {
                self.0.push(line);
            }
        }
        if self.0.len() > MAX_ALTERNATIVES {
            self.vary_all();
            self.0.drain(MAX_ALTERNATIVES.min(self.0.len())..).for_each(|line| out.add(line));
        }
    }

    fn vary_all(&mut self) {
        for mut line in std::mem::take(&mut self.0) {
            line.vary();
            if !self.0.contains(&line) {
                self.0.push(line);
            }
        }
    }

    /// Appends a text, or a part of a tag.
    pub(super) fn text(&mut self, text: &str, node: Node<'_>, out: &mut FinishedLines) {
        self.start_next(out);
        for line in &mut self.0 {
            match &mut line.tag {
                Some((tag, span)) => {
                    tag.push_str(text);
                    let id = id_of(text).unwrap_or_else(|| text.trim());
                    span.get_or_insert_with(|| span_in(node, id));
                }
                None if line.text.len() + text.len() > MAX_BYTES => line.vary(),
                None if line.is_varying => {}
                None => line.text.push_str(text),
            }
            line.is_glued &= text.trim().is_empty();
        }
    }

    /// Appends a text that is different each time.
    pub(super) fn vary(&mut self, out: &mut FinishedLines) {
        self.start_next(out);
        self.0.iter_mut().for_each(|line| line.is_glued = false);
        self.vary_all();
    }

    /// Marks lines whose text continues elsewhere.
    pub(super) fn continue_elsewhere(&mut self) {
        for line in self.0.iter_mut().filter(|line| !line.is_ended && !line.text.is_empty()) {
            line.vary();
        }
    }

    /// Adds a whole tag.
    pub(super) fn tag(&mut self, tag: &str, node: Node<'_>, out: &mut FinishedLines) {
        self.open_tag(out);
        self.text(tag, node, out);
        self.close_tag();
    }

    pub(super) fn open_tag(&mut self, out: &mut FinishedLines) {
        self.start_next(out);
        self.0.iter_mut().for_each(|line| line.tag = Some(Default::default()));
    }

    pub(super) fn close_tag(&mut self) {
        for line in &mut self.0 {
            let Some((tag, span)) = line.tag.take() else { continue };
            let id = id_of(&tag).filter(|id| !id.is_empty() && line.ids.len() < MAX_IDS);
            if let (Some(id), Some(span)) = (id, span) {
                line.ids.push((id.to_owned(), span));
            }
        }
    }

    /// Ends the line, unless it is empty.
    pub(super) fn end(&mut self) {
        for line in &mut self.0 {
            line.is_ended |= !line.is_glued && (line.is_varying || !line.text.is_empty());
        }
    }

    /// Removes the line breaks before and after.
    pub(super) fn glue(&mut self) {
        for line in &mut self.0 {
            line.is_ended = false;
            line.is_glued = true;
        }
    }

    /// Finishes the lines. Afterwards, the story is elsewhere.
    pub(super) fn finish(&mut self, out: &mut FinishedLines) {
        self.close_tag();
        std::mem::take(&mut self.0).into_iter().for_each(|line| out.add(line));
    }

    /// Finishes the lines that have ended.
    fn start_next(&mut self, out: &mut FinishedLines) {
        if !self.0.iter().any(|line| line.is_ended) {
            return;
        }
        for mut line in std::mem::take(&mut self.0) {
            if line.is_ended {
                out.add(std::mem::take(&mut line));
            }
            if !self.0.contains(&line) {
                self.0.push(line);
            }
        }
    }
}

impl InkLine {
    fn vary(&mut self) {
        match &mut self.tag {
            // An ID that is different each time has no clip.
            Some((tag, span)) => {
                tag.clear();
                *span = None;
            }
            None => {
                self.is_varying = true;
                self.text.clear();
            }
        }
    }
}

/// Returns the ID in a tag such as `id: mara_hello`.
fn id_of(tag: &str) -> Option<&str> {
    tag.trim().strip_prefix("id:").map(str::trim)
}
