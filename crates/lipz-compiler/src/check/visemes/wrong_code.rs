//! Codes that are not in the viseme type.

use super::ExpectedCodes;
use super::instead::{NINE_OF_THE_AUTHORS_TOOL, instead};
use super::tally::{CharacterCount, Tally, contains};
use lipz_bank::VisemeType;
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::JsonString;

/// The maximum number of distinct foreign codes to show per element; the rest are counted.
const SHOWN: usize = 4;

/// Reports codes that do not fit. If there is a common reason, there is one diagnostic, and otherwise one per distinct
/// character.
pub(super) fn report(string: &JsonString<'_>, expected: ExpectedCodes, diagnostics: &mut Vec<Diagnostic>) {
    let tally = Tally::new(&string.text);
    let given = match expected {
        ExpectedCodes::Named(viseme_type) | ExpectedCodes::Default(viseme_type) => Some(viseme_type),
        ExpectedCodes::Any | ExpectedCodes::Unknown => None,
    };
    let is_candidate = |known: &VisemeType| given.is_none_or(|given| given == *known);
    let lower = VisemeType::ALL.into_iter().filter(is_candidate).find(|known| tally.is_lower_case_of(*known));
    if let Some(viseme_type) = lower {
        diagnostics.push(lower_case(string, viseme_type));
        return;
    }
    let viseme_type = given.unwrap_or_else(|| tally.nearest());
    let foreign: Vec<&CharacterCount> = tally.foreign_to(viseme_type).collect();
    let Some(first) = foreign.first() else { return };
    let fitting: Vec<&str> = tally.fitting().map(VisemeType::name).collect();
    if !fitting.is_empty() {
        diagnostics.push(other_type(string, first, viseme_type, &fitting, expected));
    } else if given.is_none() && foreign.iter().all(|found| is_of_some_type(found)) {
        diagnostics.push(mixed(string, first, viseme_type, &foreign));
    } else {
        for index in 0..foreign.len().min(SHOWN) {
            diagnostics.extend(one_of(string, index, viseme_type, &foreign, expected));
        }
    }
}

/// Returns the diagnostic about a single foreign character.
fn one_of(
    string: &JsonString<'_>,
    index: usize,
    viseme_type: VisemeType,
    foreign: &[&CharacterCount],
    expected: ExpectedCodes,
) -> Option<Diagnostic> {
    let found = *foreign.get(index)?;
    let shown = escape::numbered(found.character);
    let message = match expected {
        ExpectedCodes::Named(known) | ExpectedCodes::Default(known) => {
            let article = if known == VisemeType::Rms { "an" } else { "a" };
            format!("{shown} is not {article} {known} code")
        }
        _ if is_of_some_type(found) => {
            let others = if foreign.len() == 1 { "the others" } else { "most of the others" };
            format!("{shown} is not a code of {viseme_type}, unlike {others}")
        }
        _ => format!("{shown} is not a code of any viseme type"),
    };
    let mut diagnostic = repeated(Diagnostic::at(Code::ForeignCode, span(string, found), message), found);
    if index == 0 {
        diagnostic = with_valid_codes(diagnostic, viseme_type, expected);
    }
    if index + 1 == SHOWN && foreign.len() > SHOWN {
        diagnostic = diagnostic.note(format!("{} more different characters are not shown", foreign.len() - SHOWN));
    }
    diagnostic.help = instead(found.character, viseme_type, foreign);
    let is_named = !matches!(expected, ExpectedCodes::Any | ExpectedCodes::Unknown);
    if (found.character, viseme_type, is_named) == (NINE_OF_THE_AUTHORS_TOOL, VisemeType::Rms, true) {
        diagnostic =
            diagnostic.fix(string.span(), lipz_file::literal(&string.text.replace(NINE_OF_THE_AUTHORS_TOOL, "9")));
    }
    Some(diagnostic)
}

/// Returns the diagnostic for codes of several types if none of the types has all of them.
fn mixed(
    string: &JsonString<'_>,
    first: &CharacterCount,
    viseme_type: VisemeType,
    foreign: &[&CharacterCount],
) -> Diagnostic {
    let shown = escape::numbered(first.character);
    let message =
        format!("{shown} is not one of the {viseme_type} codes, and no viseme type has all codes of this file");
    let diagnostic = repeated(Diagnostic::at(Code::MixedCodes, span(string, first), message), first);
    let sets = VisemeType::ALL.map(|known| format!("{known}: {}", spaced(known)));
    let correct = || format!("correct the codes, and name the type: \"viseme_type\": \"{viseme_type}\"");
    let help = instead(first.character, viseme_type, foreign).unwrap_or_else(correct);
    sets.into_iter().fold(diagnostic, Diagnostic::note).help(help)
}

/// Returns the diagnostic for codes that all belong to a type other than the given one.
fn other_type(
    string: &JsonString<'_>,
    first: &CharacterCount,
    viseme_type: VisemeType,
    fitting: &[&str],
    expected: ExpectedCodes,
) -> Diagnostic {
    let message = format!("these are {} codes, not {viseme_type}", fitting.join(" or "));
    let diagnostic = Diagnostic::at(Code::ForeignCode, span(string, first), message);
    with_valid_codes(diagnostic, viseme_type, expected).help(match (fitting, expected) {
        ([one], ExpectedCodes::Default(_)) => {
            format!("write \"viseme_type\": \"{one}\" in the file, or change `default-viseme-type`")
        }
        ([one], _) => format!("write \"viseme_type\": \"{one}\", or correct the codes"),
        _ => "write the viseme type of these codes, or correct them".into(),
    })
}

/// Returns the diagnostic for codes that belong to the type but are all in lower case.
fn lower_case(string: &JsonString<'_>, viseme_type: VisemeType) -> Diagnostic {
    let first = string.text.find(|c: char| c.is_ascii_lowercase()).unwrap_or_default();
    let diagnostic =
        Diagnostic::at(Code::ForeignCode, string.span_of(first..first + 1), "the viseme codes are in lower case")
            .note(format!("valid codes are {}; `|` separates segments", spaced(viseme_type)))
            .help("write them in upper case");
    // An `l` may be a damaged `|`.
    if string.text.contains('l') {
        return diagnostic;
    }
    diagnostic.fix(string.span(), lipz_file::literal(&string.text.to_ascii_uppercase()))
}

/// Whether the character is a code of any type.
fn is_of_some_type(found: &CharacterCount) -> bool {
    VisemeType::ALL.iter().any(|known| contains(*known, found.character))
}

/// Returns the span of the first occurrence of the character.
fn span(string: &JsonString<'_>, found: &CharacterCount) -> lipz_diagnostics::Span {
    string.span_of(found.first_at..found.first_at + found.character.len_utf8())
}

fn repeated(diagnostic: Diagnostic, found: &CharacterCount) -> Diagnostic {
    match found.count {
        1 => diagnostic,
        count => diagnostic.note(format!("it appears {count} times; this is the first")),
    }
}

/// Adds the legal codes, and the source of the type if the file does not name it.
fn with_valid_codes(diagnostic: Diagnostic, viseme_type: VisemeType, expected: ExpectedCodes) -> Diagnostic {
    let diagnostic = diagnostic.note(format!("valid codes are {}; `|` separates segments", spaced(viseme_type)));
    match expected {
        ExpectedCodes::Default(_) => diagnostic.note("the viseme type comes from `default-viseme-type`"),
        _ => diagnostic,
    }
}

/// Returns the legal codes with spaces between them.
fn spaced(viseme_type: VisemeType) -> String {
    viseme_type.codes().chars().map(String::from).collect::<Vec<_>>().join(" ")
}
