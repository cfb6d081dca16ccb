//! The punctuation at the end of a translation.

use lipz_file::locale::language;
use lipz_file::text::display;

/// Languages that end sentences without a sign.
const WITHOUT_SIGNS: [&str; 4] = ["th", "lo", "km", "my"];

/// The signs at the ends of sentences in many scripts.
const SIGNS: &str = ".。．।۔｡։!！՜?？;\u{37e}؟՞…⋯,，、،:：；؛-–—―─‥・～〜॥።፧፡፣፤།";

pub(super) const HELP: &str = "end both texts with a sign or neither, or allow `end-punctuation` for these files";

/// Returns a message about a sign at the end of a translation that its source does not have, that is missing, or that is
/// doubled. Both have a text and its locale.
pub(super) fn difference(source: [&str; 2], translation: [&str; 2]) -> Option<String> {
    let ([source, source_locale], [translation, locale]) = (source, translation);
    let (source, translation) = (display(source).text, display(translation).text);
    let doubled = ["..", "!!", "??", "。。", ",,"].into_iter().find(|doubled| is_doubled(&translation, doubled));
    if let Some(doubled) = doubled.filter(|doubled| !is_doubled(&source, doubled)) {
        return Some(format!("the translation ends with `{doubled}`"));
    }
    if [source_locale, locale].iter().any(|locale| WITHOUT_SIGNS.contains(&language(locale))) {
        return None;
    }
    match [end(&source), end(&translation)] {
        [Some(from), None] => Some(format!("the translation lacks the `{from}` at the end")),
        [None, Some(to)] => Some(format!("the translation ends with `{to}`, but the source does not")),
        // Which sign it is depends on the language and the translator.
        [Some(_), Some(_)] | [None, None] => None,
    }
}

/// Whether a text ends with a sign twice, but not more often.
fn is_doubled(text: &str, doubled: &str) -> bool {
    let inner = trimmed(text);
    let sign = doubled.chars().next().unwrap_or_default();
    inner.strip_suffix(doubled).is_some_and(|rest| !rest.ends_with(sign))
}

/// Returns the sign at the end of a text; `None` for a letter or a digit.
fn end(text: &str) -> Option<char> {
    trimmed(text).chars().next_back().filter(|last| SIGNS.contains(*last))
}

/// Returns a text without closing quotes and brackets at its end, which each language writes in its own way.
fn trimmed(text: &str) -> &str {
    text.trim_end_matches(|character: char| {
        character.is_whitespace()
            || matches!(
                character,
                '"' | '\'' | '’' | '”' | '“' | '«' | '»' | '‹' | '›' | ')' | ']' | '」' | '』' | '）' | '*' | '_'
            )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_compared_across_scripts() {
        for (source, locale, translation) in [
            ("Who goes there?", "ja-jp", "誰だ？"),
            ("Who goes there?", "ar-sa", "من هناك؟"),
            ("Who goes there?", "el-gr", "Ποιος είναι;"),
            ("Wait...", "de-de", "Warte …"),
            ("He said \"no.\"", "de-de", "Er sagte „nein.“"),
            ("Stop!", "th-th", "หยุด"),
            ("Otto", "de-de", "Otto"),
            ("Stop.", "de-de", "Halt!"),
            ("I am…", "ja-jp", "僕は・・・"),
            ("If—", "zh-cn", "如果──"),
            ("He goes home.", "am-et", "ወደ ቤት ይሄዳል።"),
            ("Who goes there?", "bo-cn", "དེ་སུ་རེད།"),
            ("Go {to: amy}", "de-de", "Geh {to: amy}"),
        ] {
            assert_eq!(difference([source, "en-us"], [translation, locale]), None, "{translation}");
            assert_eq!(difference([translation, locale], [source, "en-us"]), None, "{translation}");
        }
        for (source, translation, message) in [
            ("Who goes there?", "Wer da", "the translation lacks the `?` at the end"),
            ("Stop", "Halt!", "the translation ends with `!`, but the source does not"),
            ("Stop.", "Halt..", "the translation ends with `..`"),
        ] {
            assert_eq!(difference([source, "en-us"], [translation, "de-de"]).as_deref(), Some(message));
        }
    }
}
