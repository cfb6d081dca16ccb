//! Two texts with marked differences.

use anstyle::{AnsiColor, Style};
use lipz_diagnostics::escape;
use lipz_texts::difference;
use similar::ChangeTag;
use std::fmt::Write;

const OLD: Style = AnsiColor::Red.on_default();
const NEW: Style = AnsiColor::Green.on_default();

/// Returns both texts for display one above the other: in different colours, with the words underlined that the other
/// text lacks.
pub(super) fn marked(old: &str, new: &str) -> (String, String) {
    if old.is_empty() || new.is_empty() {
        return (only_old(old), only_new(new));
    }
    let (old, new) = (escape::text(old), escape::text(new));
    let words = difference::by_word(&old, &new);
    let side = |style: Style, own: ChangeTag| {
        let mut text = String::new();
        for change in words.iter().filter(|change| [own, ChangeTag::Equal].contains(&change.tag())) {
            let style = if change.tag() == own { style.underline() } else { style };
            let _ = write!(text, "{style}{}{style:#}", change.value());
        }
        text
    };
    (side(OLD, ChangeTag::Delete), side(NEW, ChangeTag::Insert))
}

/// Returns a text that only the old side has.
pub(super) fn only_old(text: &str) -> String {
    alone(text, OLD)
}

/// Returns a text that only the new side has.
pub(super) fn only_new(text: &str) -> String {
    alone(text, NEW)
}

fn alone(text: &str, style: Style) -> String {
    if text.is_empty() {
        return "(empty)".into();
    }
    format!("{style}{}{style:#}", escape::text(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the style sequences as brackets: `[` begins a marked word.
    fn seen(text: &str) -> String {
        let (old, new) = (OLD.underline().to_string(), NEW.underline().to_string());
        let marks = text.replace(&old, "[").replace(&new, "[");
        let plain = marks.replace(&OLD.to_string(), "").replace(&NEW.to_string(), "");
        plain.replace("\u{1b}[0m", "]")
    }

    #[test]
    fn words_that_differ_are_marked() {
        let (old, new) = marked("Good evening, Otto.", "Good morning, Otto.");
        assert!(seen(&old).contains("[evening]"), "{}", seen(&old));
        assert!(seen(&new).contains("[morning]"), "{}", seen(&new));
        assert_eq!(seen(&old).replace(['[', ']'], ""), "Good evening, Otto.");
        let (_, japanese) = marked("灯台です", "灯台でした");
        assert!(seen(&japanese).starts_with("灯]台]で]["), "{}", seen(&japanese));
    }

    #[test]
    fn nothing_of_a_text_is_a_control_character() {
        let (old, new) = marked("a\u{1b}[2J", "b\u{9b}");
        let plain = |text: &str| seen(text).replace(['[', ']'], "");
        assert_eq!((plain(&old), plain(&new)), ("a\\u001B2J".into(), "b\\u009B".into()));
    }
}
