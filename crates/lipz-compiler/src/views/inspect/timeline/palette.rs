//! The styles of a timeline, and rows of styled text.

use anstyle::{AnsiColor, Style};
use unicode_width::UnicodeWidthStr;

/// The colours of segments in all bands, which alternate between neighbours.
const SEGMENTS: [AnsiColor; 2] = [AnsiColor::Cyan, AnsiColor::Magenta];

/// The styles of the parts of a timeline. All of them are plain without colours.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) struct Palette {
    /// The key, and the headings of segments.
    pub(super) title: Style,
    /// The ruler.
    pub(super) ruler: Style,
    /// The openness of the mouth.
    pub(super) height: Style,
    /// Events.
    pub(super) event: Style,
    /// The names of locales, curves and `event`.
    pub(super) name: Style,
    segments: [Style; 2],
}

impl Palette {
    /// Returns colours that are readable on light and dark backgrounds.
    pub(super) fn coloured() -> Palette {
        Palette {
            title: Style::new().bold(),
            ruler: Style::new().dimmed(),
            height: AnsiColor::Green.on_default(),
            event: AnsiColor::Yellow.on_default(),
            name: Style::new().dimmed(),
            segments: SEGMENTS.map(AnsiColor::on_default),
        }
    }

    /// Returns the style of the bar and the text of a segment.
    pub(super) fn segment(&self, index: u32) -> Style {
        self.segments[(index % 2) as usize]
    }
}

/// A row that is written from left to right.
#[derive(Default)]
pub(super) struct StyledRow {
    text: String,
    columns: usize,
}

impl StyledRow {
    /// Returns the number of columns in use.
    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    /// Writes `text` at `column`, or after the existing text.
    pub(super) fn put(&mut self, column: usize, text: &str, style: Style) {
        if text.is_empty() {
            return;
        }
        let blanks = column.saturating_sub(self.columns);
        self.columns += blanks + text.width();
        self.text.push_str(&" ".repeat(blanks));
        self.text.push_str(&painted(text, style));
    }

    /// Returns the row as a line with a margin, or an empty string for an empty row.
    pub(super) fn line(&self, margin: usize) -> String {
        if self.text.is_empty() { String::new() } else { format!("{:margin$}{}\n", "", self.text) }
    }
}

/// Returns the text in its style.
pub(super) fn painted(text: &str, style: Style) -> String {
    format!("{style}{text}{style:#}")
}
