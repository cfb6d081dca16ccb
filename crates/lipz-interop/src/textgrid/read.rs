//! Reading of a TextGrid. Only free-standing numbers, texts in double quotes and flags in `<>` count, in order. All
//! other words are for people (Praat manual, "TextGrid file formats"). Therefore both text forms are read in the same
//! way. Numbers are those that Praat reads: see `number`.

use super::number::{Seconds, count};
use super::{Interval, TextGrid, Tier};
use crate::Time;
use crate::source::{self, Line};
use lipz_diagnostics::{Code, Diagnostic, Span};

/// The first text of every file that Praat saves as text, and the second one of a TextGrid. Old versions of Praat add a
/// word for the form.
const TEXT_FILE: &str = "ooTextFile";
const SHORT_TEXT_FILE: &str = "ooTextFile short";
const TEXT_GRID: &str = "TextGrid";
/// The first bytes of Praat's binary files, and of its chronological ones.
const BINARY_FILE: &[u8] = b"ooBinaryFile";
const CHRONOLOGICAL: &str = "Praat chronological TextGrid text file";
const INTERVALS: &str = "IntervalTier";
const POINTS: &str = "TextTier";

impl TextGrid {
    /// Reads a file in UTF-8 (for other encodings, see [`to_utf8`](crate::to_utf8)). Returns `None` if it is not a
    /// TextGrid, or damaged. Spans count from the first byte after a byte order mark.
    pub fn read(bytes: &[u8], diagnostics: &mut Vec<Diagnostic>) -> Option<TextGrid> {
        if bytes.starts_with(BINARY_FILE) {
            diagnostics.push(another("a binary file of Praat"));
            return None;
        }
        let text = source::text(bytes, diagnostics)?;
        let mut values = Values { text, at: 0, origin: Seconds::ZERO, diagnostics };
        let first = values.string("the type of the file")?;
        if first.label == CHRONOLOGICAL {
            diagnostics.push(another("a TextGrid sorted by time"));
            return None;
        }
        if ![TEXT_FILE, SHORT_TEXT_FILE].contains(&first.label.as_str()) {
            diagnostics.push(first.line.not(&format!("`{TEXT_FILE}`, the type of the file")).help(IS_IT));
            return None;
        }
        let class = values.string("the class of the object")?;
        if class.label != TEXT_GRID {
            diagnostics.push(class.line.not(&format!("`{TEXT_GRID}`, the class of the object")).help(IS_IT));
            return None;
        }
        let start = values.start()?;
        let end = values.time("the end")?;
        let mut grid = TextGrid { start, end, tiers: Vec::new() };
        if !values.has_tiers()? {
            return Some(grid);
        }
        for _ in 0..values.count("the number of tiers")? {
            grid.tiers.push(values.tier()?);
        }
        Some(grid)
    }
}

const IS_IT: &str = "check whether this is a TextGrid that was saved as a text file";

fn another(what: &str) -> Diagnostic {
    Diagnostic::new(Code::ForeignSyntax, format!("the file is {what}"))
        .help("open it in Praat, and save it as a text file or a short text file")
}

/// A text in quotes, and its position.
struct Label<'t> {
    label: String,
    line: Line<'t>,
}

/// The values of a file, in order.
struct Values<'t, 'd> {
    text: &'t str,
    at: usize,
    /// The start of a file whose times start below 0. All times count from it.
    origin: Seconds,
    diagnostics: &'d mut Vec<Diagnostic>,
}

enum GridValue<'t> {
    Number(Line<'t>),
    String(Label<'t>),
    Flag(Line<'t>),
}

impl<'t> Values<'t, '_> {
    /// Returns the next value. If the file ends, reports that `what` is missing.
    fn next(&mut self, what: &str) -> Option<GridValue<'t>> {
        loop {
            let rest = self.text.get(self.at..).unwrap_or_default();
            let start = self.at + rest.len() - rest.trim_start().len();
            let rest = rest.trim_start();
            let word = |length: usize| Line { text: rest.get(..length).unwrap_or(rest), at: start };
            let Some(first) = rest.chars().next() else {
                self.diagnostics.push(source::cut_off(self.text, &format!("{what} is missing")));
                return None;
            };
            let end_of_word = rest.find(char::is_whitespace).unwrap_or(rest.len());
            match first {
                '"' => {
                    let Some((label, length)) = quoted(rest) else {
                        let message = "the closing quote of the text is missing";
                        self.diagnostics.push(
                            Diagnostic::at(Code::ForeignCutOff, Span::new(start, start + 1), message).help(
                                "write the quote, write a quote inside a text twice, or copy the file again if \
                                    it was cut off",
                            ),
                        );
                        return None;
                    };
                    self.at = start + length;
                    return Some(GridValue::String(Label { label, line: word(length) }));
                }
                '!' => self.at = start + rest.find('\n').unwrap_or(rest.len()),
                '<' => {
                    self.at = start + end_of_word;
                    return Some(GridValue::Flag(word(end_of_word)));
                }
                _ => {
                    self.at = start + end_of_word;
                    // Praat does not read a number from `.5`, but other programs write it.
                    let is_signed = first.is_ascii_digit() || matches!(first, '-' | '+');
                    let word = word(end_of_word);
                    if (is_signed && word.text.len() > 1 || first.is_ascii_digit())
                        || (first == '.' && Seconds::parse(word.text).is_some())
                    {
                        return Some(GridValue::Number(word));
                    }
                }
            }
        }
    }

    fn refuse<T>(&mut self, line: Line<'_>, what: &str) -> Option<T> {
        self.diagnostics.push(line.not(what));
        None
    }

    fn string(&mut self, what: &str) -> Option<Label<'t>> {
        match self.next(what)? {
            GridValue::String(label) => Some(label),
            GridValue::Number(line) | GridValue::Flag(line) => self.refuse(line, &format!("{what}, a text in quotes")),
        }
    }

    fn number(&mut self, what: &str) -> Option<Line<'t>> {
        match self.next(what)? {
            GridValue::Number(line) => Some(line),
            GridValue::String(label) => self.refuse(label.line, &format!("{what}, a number")),
            GridValue::Flag(line) => self.refuse(line, &format!("{what}, a number")),
        }
    }

    /// Reads the start of the file. Praat can shift a file so that it starts below 0.
    fn start(&mut self) -> Option<Time> {
        let line = self.number("the start")?;
        match Seconds::parse(line.text) {
            Some(start) if start.is_negative() => {
                self.origin = start;
                Some(Time::ZERO)
            }
            Some(start) => Some(start.since(Seconds::ZERO)?),
            None => self.refuse(line, "the start, a time in seconds"),
        }
    }

    fn time(&mut self, what: &str) -> Option<Time> {
        let line = self.number(what)?;
        match Seconds::parse(line.text).and_then(|time| time.since(self.origin)) {
            Some(time) => Some(time),
            None if self.origin.is_negative() => self.refuse(line, &format!("{what}, a time in seconds, in the file")),
            None => self.refuse(line, &format!("{what}, a time in seconds, 0 or later")),
        }
    }

    fn count(&mut self, what: &str) -> Option<usize> {
        let line = self.number(what)?;
        count(line.text).or_else(|| self.refuse(line, &format!("{what}, a whole number")))
    }

    fn has_tiers(&mut self) -> Option<bool> {
        match self.next("the flag for the presence of tiers")? {
            GridValue::Flag(flag) => Some(flag.text == "<exists>"),
            GridValue::Number(line) | GridValue::String(Label { line, .. }) => {
                self.refuse(line, "`<exists>`, the flag for the presence of tiers")
            }
        }
    }

    fn tier(&mut self) -> Option<Tier> {
        let class = self.string("the class of a tier")?;
        let has_points = class.label == POINTS;
        if !has_points && class.label != INTERVALS {
            return self.refuse(class.line, &format!("the class of a tier, `{INTERVALS}` or `{POINTS}`"));
        }
        let name = self.string("the name of a tier")?.label;
        self.time("the start of a tier")?;
        self.time("the end of a tier")?;
        let mut tier = Tier { name, has_points, intervals: Vec::new() };
        // Memory is not reserved by the count, which may be wrong.
        for _ in 0..self.count("the number of intervals")? {
            let start = self.time("the start of an interval")?;
            let end = if has_points { start } else { self.time("the end of an interval")? };
            let label = self.string("the label of an interval")?;
            let span = label.line.span();
            if end < start {
                let message = "the interval ends before it starts";
                self.diagnostics.push(Diagnostic::at(Code::ForeignValue, span, message));
                return None;
            }
            tier.intervals.push(Interval { start, end, label: label.label, span: Some(span) });
        }
        Some(tier)
    }
}

/// Returns the text in quotes at the start of `text`, in which quotes are doubled, and its length including the quotes.
fn quoted(text: &str) -> Option<(String, usize)> {
    let mut label = String::new();
    let mut at = 1;
    loop {
        let length = text.get(at..)?.find('"')?;
        label += text.get(at..at + length)?;
        at += length + 1;
        if !text.get(at..).is_some_and(|after| after.starts_with('"')) {
            return Some((label, at));
        }
        label.push('"');
        at += 1;
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::indexing_slicing, reason = "tests")]
mod tests {
    use super::*;

    fn read(text: &str) -> (Option<TextGrid>, Vec<String>) {
        let mut diagnostics = Vec::new();
        let grid = TextGrid::read(text.as_bytes(), &mut diagnostics);
        (grid, diagnostics.into_iter().map(|diagnostic| diagnostic.message).collect())
    }

    const HEAD: &str = "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n";

    #[test]
    fn both_forms_say_the_same() {
        let long = format!(
            "{HEAD}xmin = 0 \nxmax = 2.5 \ntiers? <exists> \nsize = 2 \nitem []: \n    item [1]:\n        class = \"IntervalTier\" \n        name = \"a \"\"b\"\"\" \n        xmin = 0 \n        xmax = 2.5 \n        intervals: size = 2 \n        intervals [1]:\n            xmin = 0 \n            xmax = 1e0 \n            text = \"\" \n        intervals [2]:\n            xmin = 1 \n            xmax = 2.5 \n            text = \"é 2\" \n    item [2]:\n        class = \"TextTier\" \n        name = \"bell\" \n        xmin = 0 \n        xmax = 2.5 \n        points: size = 1 \n        points [1]:\n            number = 0.5 \n            mark = \"x\" \n"
        );
        let short = format!(
            "{HEAD}0\n2.5\n<exists> ! a remark with 3 numbers\n2\n\"IntervalTier\"\n\"a \"\"b\"\"\"\n0\n2.5\n2\n0\n1\n\"\"\n1\n2.5\n\"é 2\"\n\"TextTier\"\n\"bell\"\n0\n2.5\n1\n0.5\n\"x\""
        );
        let without_spans = |text: &str| {
            let (grid, found) = read(text);
            assert_eq!(found, Vec::<String>::new());
            let mut grid = grid.unwrap();
            for interval in grid.tiers.iter_mut().flat_map(|tier| &mut tier.intervals) {
                let span = interval.span.take().unwrap();
                assert!(text[span.range()].starts_with('"') && text[span.range()].ends_with('"'));
            }
            grid
        };
        let grid = without_spans(&long);
        assert_eq!(grid, without_spans(&short));
        assert_eq!(grid, without_spans(&grid.write()));
        assert_eq!((grid.tiers[0].name.as_str(), grid.tiers[1].has_points), ("a \"b\"", true));
    }

    /// Praat itself writes `-0`, and other programs write numbers that it reads.
    #[test]
    fn numbers_of_all_programs() {
        let file = |start: &str, middle: &str, end: &str, count: &str| {
            format!(
                "{HEAD}{start} {end} <exists> 1 \"IntervalTier\" \"a\" {start} {end} {count} {start} {middle} \"x\" {middle} {end} \"y\""
            )
        };
        let times = |text: &str| {
            let (grid, found) = read(text);
            assert_eq!(found, Vec::<String>::new(), "{text}");
            let grid = grid.unwrap();
            let ms = |time: Time| time.in_units(1000);
            let middle = ms(grid.tiers[0].intervals[0].end);
            assert_eq!(middle, ms(grid.tiers[0].intervals[1].start));
            (ms(grid.start), middle, ms(grid.end))
        };
        for (text, expected) in [
            (file("-0", "0.5", "1", "2"), (0, 500, 1000)),
            (file("-0.0", "+0.5", "1e0", "2.0"), (0, 500, 1000)),
            (file("-1.3877787807814457e-17", "1/2", "100%", "+2"), (0, 500, 1000)),
            (file("0", ".5", "1.", "2"), (0, 500, 1000)),
            (file("0", "0.5s", "1,", "2"), (0, 500, 1000)),
            (file("-0.25", "0.25", "0.75", "2"), (0, 500, 1000)),
            (file("2", "2.5", "3", "2"), (2000, 2500, 3000)),
        ] {
            assert_eq!(times(&text), expected, "{text}");
        }
        let old = file("0", "0.5", "1", "2").replace("ooTextFile", "ooTextFile short").replace("Object class = ", "");
        assert_eq!(times(&old), (0, 500, 1000));
        let before = read(&file("-0.25", "-0.5", "1", "2")).1;
        assert_eq!(before, ["`-0.5` is not the end of an interval, a time in seconds, in the file"]);
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (text, message) in [
            ("".to_owned(), "the file ends too early: the type of the file is missing"),
            ("\"ooTextFile\" \"Sound\" 0 1".to_owned(), "`\"Sound\"` is not `TextGrid`, the class of the object"),
            ("ooBinaryFile\u{8}TextGrid".to_owned(), "the file is a binary file of Praat"),
            (
                format!("{HEAD}0 1 <exists> 1 \"Tier\""),
                "`\"Tier\"` is not the class of a tier, `IntervalTier` or `TextTier`",
            ),
            (format!("{HEAD}0 -1"), "`-1` is not the end, a time in seconds, 0 or later"),
            (format!("{HEAD}0 1 <exists> 1.5"), "`1.5` is not the number of tiers, a whole number"),
            (format!("{HEAD}0 1 \"x\""), "`\"x\"` is not `<exists>`, the flag for the presence of tiers"),
            (format!("{HEAD}0 1 <exists> 1 \"IntervalTier\" \"a"), "the closing quote of the text is missing"),
            (
                format!("{HEAD}0 1 <exists> 1 \"IntervalTier\" \"a\" 0 1 9999999999999 1 0 \"\""),
                "the interval ends before it starts",
            ),
        ] {
            let (grid, found) = read(&text);
            assert_eq!((grid, found.as_slice()), (None, &[message.to_owned()][..]), "{text}");
        }
        assert_eq!(read(&format!("{HEAD}0 1 <absent>")).1, Vec::<String>::new());
    }
}
