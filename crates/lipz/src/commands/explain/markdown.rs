//! The page of a rule for a terminal: wrapped, with bold headings.

use anstyle::Style;
use lipz_diagnostics::Code;
use pulldown_cmark::{Event, Parser, Tag, TagEnd};
use std::fmt::{Display, Write};
use std::mem;

/// The indentation of each line of a code block.
const CODE_INDENT: &str = "    ";

/// The longest line. Longer ones are hard to read, even on wide terminals.
const WIDEST: usize = 100;

const STRONG: Style = Style::new().bold();

/// Returns the text in bold for a terminal.
pub(crate) fn heading(text: &str) -> String {
    format!("{STRONG}{text}{STRONG:#}")
}

/// Returns number, name, level and summary, then the page, in lines of at most `width` columns.
pub(crate) fn terminal(code: Code, width: usize) -> String {
    let title = heading(&format!("{code} {}", code.name()));
    let mut text = format!("{title} ({} by default)\n{}\n", super::default_level(code), code.summary());
    let mut block = Block::default();
    for event in Parser::new(code.page()) {
        match event {
            Event::Start(Tag::Strong) => block.push(STRONG.render()),
            Event::End(TagEnd::Strong) => block.push(STRONG.render_reset()),
            Event::Start(Tag::Item) => block.is_item = true,
            Event::Text(words) => block.push(words),
            Event::Code(words) => block.push(format_args!("`{words}`")),
            Event::SoftBreak | Event::HardBreak => block.push(' '),
            Event::End(TagEnd::CodeBlock) => text.push_str(&mem::take(&mut block).into_code()),
            Event::End(TagEnd::Paragraph | TagEnd::Item) => {
                text.push_str(&mem::take(&mut block).into_paragraph(width.min(WIDEST)));
            }
            _ => {}
        }
    }
    text
}

/// A paragraph, a list item or a code block.
#[derive(Default)]
struct Block {
    text: String,
    is_item: bool,
}

impl Block {
    fn push(&mut self, text: impl Display) {
        let _ = write!(self.text, "{text}");
    }

    fn into_code(self) -> String {
        let lines = self.text.lines().map(|line| format!("{CODE_INDENT}{line}").trim_end().to_owned() + "\n");
        std::iter::once("\n".to_owned()).chain(lines).collect()
    }

    fn into_paragraph(self, width: usize) -> String {
        if self.text.is_empty() {
            return String::new();
        }
        let (first, others) = if self.is_item { ("* ", "  ") } else { ("", "") };
        // Names and flags with hyphens are not wrapped, because people copy them.
        let options = textwrap::Options::new(width)
            .initial_indent(first)
            .subsequent_indent(others)
            .word_splitter(textwrap::WordSplitter::NoHyphenation);
        format!("\n{}\n", textwrap::fill(&self.text, options))
    }
}
