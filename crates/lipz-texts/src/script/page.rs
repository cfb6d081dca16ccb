//! The script as one HTML file that browsers print, with the lines of each session on pages of their own.

use super::{RecordingScript, ScriptLine, seconds};
use crate::exchange::model::joined;
use crate::progress::{html, html_page};
use lipz_file::text::display;
use std::fmt::Write;

/// The boxes in which the director marks the takes of a line.
const TAKE_BOXES: usize = 4;

impl RecordingScript {
    /// Returns the script as an HTML file without scripts: the totals of each character, and a section for each
    /// session, which starts on a new page in print.
    pub fn page(&self) -> String {
        let mut out = String::new();
        let spoken = self.locale.as_deref().unwrap_or(&self.source_locale);
        let _ = writeln!(out, "<p>Lines spoken in <b>{}</b>.</p>", html(spoken));
        self.totals(&mut out);
        let mut number = 0;
        let same_session = |a: &ScriptLine, b: &ScriptLine| a.session == b.session && a.character == b.character;
        for lines in self.lines.chunk_by(same_session) {
            self.section(lines, &mut number, &mut out);
        }
        html_page(&format!("Recording script of {}", self.title), &out)
    }

    /// Appends the cue sheet.
    fn totals(&self, out: &mut String) {
        out.push_str(
            "<div class=\"wide\"><table>\n<caption>Lines by character</caption>\n<tr><th>character</th>\
             <th class=\"n\">lines</th><th class=\"n\">words</th><th class=\"n\">sessions</th>\
             <th class=\"n\">original</th></tr>\n",
        );
        for cues in self.cues() {
            let _ = writeln!(
                out,
                "<tr><th>{}</th><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>\
                 <td class=\"n\">{}</td></tr>",
                named(&cues.character),
                cues.lines,
                cues.words,
                cues.sessions,
                cues.original_us.map(|us| format!("{} s", seconds(us))).unwrap_or_default()
            );
        }
        out.push_str("</table></div>\n");
    }

    /// Appends the lines of one session, and adds their number to `number`.
    fn section(&self, lines: &[ScriptLine], number: &mut usize, out: &mut String) {
        let Some(first) = lines.first() else { return };
        let session = if self.lines.iter().all(|line| line.session == 1) {
            String::new()
        } else {
            format!(" <small>session {}</small>", first.session)
        };
        let translation = self.locale.as_ref().map(|locale| format!("<th>{}</th>", html(locale))).unwrap_or_default();
        let _ = writeln!(
            out,
            "<section class=\"sheet\">\n<h2>{}{session}</h2>\n<div class=\"wide\"><table>\n<thead><tr><th class=\"n\">line</th>\
             <th>recording</th><th>{}</th>{translation}<th>direction</th><th class=\"n\">seconds</th>\
             <th>takes</th></tr></thead>",
            named(&first.character),
            html(&self.source_locale)
        );
        for line in lines {
            *number += 1;
            line.html_row(*number, out);
        }
        out.push_str("</table></div>\n</section>\n");
    }
}

impl ScriptLine {
    fn html_row(&self, number: usize, out: &mut String) {
        let sources = self.unit.segments.iter().map(|segment| shown(&segment.source));
        let translation = self.unit.translations.first().map(|translation| {
            let texts: Vec<String> = translation.texts.iter().map(|text| shown(text)).collect();
            format!("<td dir=\"auto\"><b>{}</b></td>", html(&joined(&texts)))
        });
        let mut times: Vec<String> = self.original_us.map(seconds).into_iter().collect();
        let allowed = self.allowed();
        if !allowed.is_empty() {
            times.push(format!("<small>{allowed}<br>{}</small>", self.sync_status));
        }
        let reason = self.reason.as_deref().map(|reason| format!("<br><small>{}</small>", html(reason)));
        let boxes: String = (1..=TAKE_BOXES).map(|take| format!("<span class=\"take\">{take}</span>")).collect();
        let _ = writeln!(
            out,
            "<tr><td class=\"n\">{number}</td><td class=\"key\">{}{}</td><td dir=\"auto\">{}</td>{}<td>{}</td>\
             <td class=\"n\">{}</td><td class=\"takes\">{boxes}</td></tr>",
            html(&self.recording),
            reason.unwrap_or_default(),
            html(&joined(&sources.collect::<Vec<_>>())),
            translation.unwrap_or_default(),
            html(&self.direction()),
            times.join("<br>")
        );
    }
}

/// Returns a text without `{meta}` and line breaks, as actors speak it.
fn shown(text: &str) -> String {
    display(text).text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn named(character: &str) -> String {
    if character.is_empty() { "without a name".to_owned() } else { html(character) }
}
