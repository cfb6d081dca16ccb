//! The styles of a timeline, and rows of styled text.

use anstyle::{AnsiColor, Style};
use unicode_width::UnicodeWidthStr;

/// What belongs to one segment has one colour, its neighbours have the other, whatever band it is in.
const SEGMENTS: [AnsiColor; 2] = [AnsiColor::Cyan, AnsiColor::Magenta];

/// The styles of the parts of a timeline; all plain where nobody sees colours.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) struct Palette {
    /// Of the key, and of the headings of segments.
    pub(super) title: Style,
    /// Of the ruler.
    pub(super) ruler: Style,
    /// Of the heights of the mouth.
    pub(super) height: Style,
    /// Of events.
    pub(super) event: Style,
    /// Of the names of locales, curves and `event`.
    pub(super) name: Style,
    segments: [Style; 2],
}

impl Palette {
    /// With colours that are readable on light and on dark.
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

    /// Of the bar and the text of a segment.
    pub(super) fn segment(&self, index: u32) -> Style {
        self.segments[(index % 2) as usize]
    }
}

/// A row that is written from left to right.
#[derive(Default)]
pub(super) struct Row {
    text: String,
    columns: usize,
}

impl Row {
    /// Columns that are taken.
    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    /// Writes `text` at `column`, or behind what is there.
    pub(super) fn put(&mut self, column: usize, text: &str, style: Style) {
        if text.is_empty() {
            return;
        }
        let blanks = column.saturating_sub(self.columns);
        self.columns += blanks + text.width();
        self.text.push_str(&" ".repeat(blanks));
        self.text.push_str(&painted(text, style));
    }

    /// The row as a line with a margin; nothing if it is empty.
    pub(super) fn line(&self, margin: usize) -> String {
        if self.text.is_empty() { String::new() } else { format!("{:margin$}{}\n", "", self.text) }
    }
}

/// The text in its style.
pub(super) fn painted(text: &str, style: Style) -> String {
    format!("{style}{text}{style:#}")
}
