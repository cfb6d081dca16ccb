//! Frame codes: the legal set, white space, and what people write instead.

use lipz::JsonString;
use lipz::text::DELIMITER;
use lipz::{Code, Diagnostic};
use lipz_bank::VisemeType;

/// Different foreign codes that one element shows; the rest is counted.
const SHOWN: usize = 4;

/// What the codes are checked against.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Expected {
    /// The type of the file or the project.
    Type(VisemeType),
    /// No type is given: the codes must fit one of them.
    Any,
    /// The type is wrong and reported: the codes are not checked.
    Unknown,
}

impl From<Option<VisemeType>> for Expected {
    fn from(viseme_type: Option<VisemeType>) -> Self {
        viseme_type.map_or(Expected::Any, Expected::Type)
    }
}

/// The type that the element `viseme_type` names.
pub(super) fn viseme_type(name: &JsonString<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<VisemeType> {
    let found = VisemeType::from_name(&name.text);
    if found.is_none() {
        let plain = |name: &str| name.to_lowercase().replace(['_', '-', ' '], "");
        let written: String = name.text.chars().take(40).collect();
        let nearest = VisemeType::ALL
            .iter()
            .map(|known| (strsim::damerau_levenshtein(&plain(&written), known.name()), known))
            .filter(|(distance, _)| *distance <= 2)
            .min_by_key(|(distance, _)| *distance);
        let finding = Diagnostic::at(
            Code::UnknownVisemeType,
            name.span(),
            format!("`{}` is not a viseme type", written.escape_debug()),
        )
        .note("the viseme types are blair, toonboom and rms");
        diagnostics.push(match nearest {
            Some((0, known)) => finding.help(format!("write \"{known}\"")).fix(name.span(), format!("\"{known}\"")),
            Some((_, known)) => finding.help(format!("did you mean \"{known}\"?")),
            None => finding,
        });
    }
    found
}

/// Frame codes without delimiters and white space, and the start frame of each segment.
pub(super) fn frames(
    string: &JsonString<'_>,
    expected: Expected,
    diagnostics: &mut Vec<Diagnostic>,
) -> (Vec<u8>, Vec<u32>) {
    let mut frames = Vec::with_capacity(string.text.len());
    let mut starts = vec![0];
    let mut has_white_space = false;
    let mut is_ascii = true;
    for &byte in string.text.as_bytes() {
        match byte {
            // A source file has less than 2²⁸ bytes.
            b'|' => starts.push(u32::try_from(frames.len()).unwrap_or(u32::MAX)),
            b' ' | b'\t' | b'\n' | b'\r' => has_white_space = true,
            code => {
                is_ascii &= code.is_ascii();
                frames.push(code);
            }
        }
    }
    if has_white_space {
        white_space(string, diagnostics);
    }
    let legal = match expected {
        Expected::Type(viseme_type) => viseme_type.contains_all(&frames),
        Expected::Any => VisemeType::ALL.iter().any(|viseme_type| viseme_type.contains_all(&frames)),
        Expected::Unknown => is_ascii,
    };
    if !legal {
        foreign_codes(string, expected, diagnostics);
    }
    (frames, starts)
}

fn white_space(string: &JsonString<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let is_white_space = |c: char| matches!(c, ' ' | '\t' | '\n' | '\r');
    let Some(start) = string.text.find(is_white_space) else { return };
    let length = string.text[start..].find(|c| !is_white_space(c)).unwrap_or(string.text.len() - start);
    let count = string.text.chars().filter(|&c| is_white_space(c)).count();
    let finding = Diagnostic::at(
        Code::WhiteSpaceInVisemes,
        string.span_of(start..start + length),
        "white space between viseme codes is no frame and is ignored",
    )
    .help("remove it; write `-` for a frame at rest");
    diagnostics.push(if count > length {
        finding.note(format!("{count} characters of white space in all"))
    } else {
        finding
    });
}

/// A character that is no code of the expected type.
struct Foreign {
    character: char,
    first_at: usize,
    count: usize,
}

/// The distinct characters that are neither codes of `viseme_type` nor delimiters nor white space.
fn foreign_to(text: &str, viseme_type: VisemeType) -> Vec<Foreign> {
    let mut found: Vec<Foreign> = Vec::new();
    for (at, character) in text.char_indices() {
        let legal = matches!(character, DELIMITER | ' ' | '\t' | '\n' | '\r')
            || u8::try_from(character).is_ok_and(|code| viseme_type.contains(code));
        if legal {
            continue;
        }
        match found.iter().position(|foreign| foreign.character == character) {
            Some(index) => found[index].count += 1,
            None if found.len() < 64 => found.push(Foreign { character, first_at: at, count: 1 }),
            None => {} // not a viseme string at all: enough is known
        }
    }
    found
}

fn foreign_codes(string: &JsonString<'_>, expected: Expected, diagnostics: &mut Vec<Diagnostic>) {
    let text = string.text.as_ref();
    let viseme_type = match expected {
        Expected::Type(viseme_type) => viseme_type,
        Expected::Any | Expected::Unknown => nearest_type(text),
    };
    let foreign = foreign_to(text, viseme_type);
    let in_no_type =
        |c: char| u8::try_from(c).map_or(true, |code| !VisemeType::ALL.iter().any(|known| known.contains(code)));
    if expected == Expected::Any && !foreign.iter().any(|foreign| in_no_type(foreign.character)) {
        if let Some(first) = foreign.first() {
            let finding = Diagnostic::at(
                Code::MixedCodes,
                string.span_of(first.first_at..first.first_at + first.character.len_utf8()),
                "the viseme codes fit no viseme type",
            )
            .label(format!("no code of {viseme_type}, which fits most of the others"));
            let sets = VisemeType::ALL.map(|known| format!("{known}: {}", spaced(known)));
            diagnostics.push(
                sets.into_iter()
                    .fold(finding, Diagnostic::note)
                    .help(format!("correct the codes, and name the type: \"viseme_type\": \"{}\"", viseme_type.name())),
            );
        }
        return;
    }
    let fits = VisemeType::ALL.into_iter().find(|known| foreign_to(text, *known).is_empty());
    let hidden = foreign.len().saturating_sub(SHOWN);
    for (index, foreign) in foreign.iter().take(SHOWN).enumerate() {
        let character = foreign.character;
        let headline = match expected {
            Expected::Type(known) => format!("`{}` is not a {known} code", character.escape_debug()),
            _ => format!("`{}` is not a code of any viseme type", character.escape_debug()),
        };
        let at = foreign.first_at..foreign.first_at + character.len_utf8();
        let mut finding = Diagnostic::at(Code::ForeignCode, string.span_of(at), headline);
        if foreign.count > 1 {
            finding = finding.note(format!("it appears {} times; this is the first", foreign.count));
        }
        if index == 0 {
            finding = finding.note(format!("legal are {}, and `|` between segments", spaced(viseme_type)));
            if let (Some(other), Expected::Type(_)) = (fits, expected) {
                finding = finding.note(format!("all codes of this file are legal in {other}: is `viseme_type` right?"));
            }
        }
        if index + 1 == SHOWN && hidden > 0 {
            finding = finding.note(format!("{hidden} more different characters are not shown"));
        }
        diagnostics.push(match instead(character, viseme_type) {
            Some(help) => finding.help(help),
            None => finding,
        });
    }
}

/// The type with the fewest codes that are foreign to it.
fn nearest_type(text: &str) -> VisemeType {
    let foreign_count =
        |known: &VisemeType| foreign_to(text, *known).iter().map(|foreign| foreign.count).sum::<usize>();
    VisemeType::ALL.into_iter().min_by_key(foreign_count).unwrap_or(VisemeType::Blair)
}

/// The legal codes with blanks between them.
fn spaced(viseme_type: VisemeType) -> String {
    viseme_type.codes().chars().map(String::from).collect::<Vec<_>>().join(" ")
}

/// What the author probably meant by a foreign character.
fn instead(character: char, viseme_type: VisemeType) -> Option<String> {
    let pdf = "files copied from the published specification have this damage";
    let upper = character.to_ascii_uppercase();
    Some(match character {
        'l' | 'I' | '¦' | '│' => format!("this looks like `{character}` used for `|`: {pdf}"),
        '0' if viseme_type == VisemeType::Blair => format!("this looks like `0` used for `O`: {pdf}"),
        'O' if viseme_type == VisemeType::Rms => "this looks like `O` used for `0`".into(),
        ':' if viseme_type == VisemeType::Rms => "the format author's own tool wrote `:` for 9".into(),
        '‐' | '‑' | '‒' | '–' | '—' | '−' | '_' | '.' | 'X' => "rest is the hyphen, `-`".into(),
        _ if upper != character && viseme_type.contains(upper as u8) => format!("codes are upper case: `{upper}`"),
        _ => return None,
    })
}
