//! The content of tiers: by the names that lipz, aligners and annotators use, or as the user chooses.

use super::Tier;
use lipz_diagnostics::{Code, Diagnostic, escape, suggest};
use lipz_file::locale::{TextName, text_name};
use lipz_types::VisemeType;
use std::str::FromStr;

/// The role of a tier in a clip.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum TierRole {
    /// Lipz codes of a type.
    Visemes(VisemeType),
    Phones,
    Words,
    /// Stretches of text that belong together.
    Phrases,
    /// An element of a Lipz file, with a part for each segment.
    Element,
    Unknown,
}

/// A tier that the user chooses for its content, whatever its name.
///
/// ```
/// use lipz_interop::textgrid::TierChoice;
/// let phones: TierChoice = "MAU".parse().expect("phones are the default");
/// let words: TierChoice = "words=ORT-MAU".parse().expect("a role and a name");
/// assert_eq!((phones.role, phones.name.as_str()), ("phones", "MAU"));
/// assert_eq!((words.role, words.name.as_str()), ("words", "ORT-MAU"));
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TierChoice {
    /// The content: `phones`, `visemes`, `words` or `segments`.
    pub role: &'static str,
    /// The name of the tier.
    pub name: String,
}

const CHOICES: [&str; 4] = ["phones", "visemes", "words", "segments"];

impl FromStr for TierChoice {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<TierChoice, &'static str> {
        let role_of = |before: &str| CHOICES.into_iter().find(|role| role.eq_ignore_ascii_case(before.trim()));
        let named = text.split_once('=').and_then(|(before, name)| Some((role_of(before)?, name)));
        let (role, name) = named.unwrap_or(("phones", text));
        match name.trim() {
            "" => Err("write the name of a tier, or words=NAME"),
            name => Ok(TierChoice { role, name: name.to_owned() }),
        }
    }
}

impl TierChoice {
    fn role(&self) -> TierRole {
        match self.role {
            "visemes" => TierRole::Visemes(VisemeType::Blair),
            "words" => TierRole::Words,
            "segments" => TierRole::Phrases,
            _ => TierRole::Phones,
        }
    }

    /// Whether the choice replaces tiers that have this role by their names.
    fn replaces(&self, role: &TierRole) -> bool {
        let is_mouth = |role: &TierRole| matches!(role, TierRole::Visemes(_) | TierRole::Phones);
        let own = self.role();
        own == *role || (is_mouth(&own) && is_mouth(role))
    }
}

/// Returns the role of each tier, and its speaker. Reports a chosen tier that the file lacks, and returns `None`.
pub(super) fn roles<'t>(
    tiers: &'t [Tier],
    chosen: &[TierChoice],
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Vec<(Option<&'t str>, TierRole)>> {
    let is_chosen = |choice: &TierChoice, tier: &Tier| tier.name.trim().eq_ignore_ascii_case(&choice.name);
    let missing = chosen.iter().find(|choice| !tiers.iter().any(|tier| is_chosen(choice, tier)));
    if let Some(missing) = missing {
        let message = format!("the file has no tier called {}", escape::quoted(&missing.name));
        let diagnostic = Diagnostic::new(Code::NoShapes, message).note(listed(tiers));
        let nearest = suggest::nearest(&missing.name, tiers.iter().map(|tier| tier.name.trim()));
        diagnostics.push(match nearest {
            Some(nearest) => diagnostic.help(format!("did you mean {}?", escape::quoted(nearest))),
            None => diagnostic.help("name one of its tiers with `--tier`"),
        });
        return None;
    }
    let of = |tier: &'t Tier| {
        let (speaker, role) = role(&tier.name);
        match chosen.iter().find(|choice| is_chosen(choice, tier)) {
            // A tier of codes states their type in its name.
            Some(choice) if choice.replaces(&role) && matches!(role, TierRole::Visemes(_)) => (speaker, role),
            Some(choice) => (speaker, choice.role()),
            None if chosen.iter().any(|choice| choice.replaces(&role)) => (None, TierRole::Unknown),
            None => (speaker, role),
        }
    };
    Some(tiers.iter().map(of).collect())
}

/// Returns the names of the tiers, as a note.
pub(super) fn listed(tiers: &[Tier]) -> String {
    let names: Vec<String> = tiers.iter().map(|tier| escape::quoted(&tier.name).to_string()).collect();
    if names.is_empty() { "the file has no tiers".into() } else { format!("its tiers: {}", names.join(", ")) }
}

/// Returns the role of a tier from its name, and the speaker at the start of the name.
fn role(name: &str) -> (Option<&str>, TierRole) {
    let whole = content(name.trim());
    if whole != TierRole::Unknown {
        return (None, whole);
    }
    for separator in [" - ", "_", ": "] {
        let Some((speaker, name)) = name.rsplit_once(separator) else { continue };
        let role = content(name.trim());
        // lipz separates the speaker from the name of an element with ` - ` only.
        if role != TierRole::Unknown && (role != TierRole::Element || separator == " - ") {
            return (Some(speaker.trim()).filter(|speaker| !speaker.is_empty()), role);
        }
    }
    (None, TierRole::Unknown)
}

/// Returns the content of a tier with this name, without a speaker.
fn content(name: &str) -> TierRole {
    match name.to_ascii_lowercase().as_str() {
        "visemes" | "viseme" | "mouth" => TierRole::Visemes(VisemeType::Blair),
        // The last ones are those of WebMAUS and SPPAS.
        "phones" | "phone" | "phonemes" | "phoneme" | "mau" | "phonalign" => TierRole::Phones,
        "words" | "word" | "ort-mau" | "tokensalign" => TierRole::Words,
        "segments" | "segment" | "phrases" | "phrase" | "utterances" | "utterance" | "sentences" | "sentence" => {
            TierRole::Phrases
        }
        "events" => TierRole::Element,
        other => match other.strip_prefix("visemes-").and_then(|name| name.parse().ok()) {
            Some(viseme_type) => TierRole::Visemes(viseme_type),
            None if matches!(text_name(name), Some(TextName::Canonical(_))) => TierRole::Element,
            None => TierRole::Unknown,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_tiers() {
        for (name, speaker, expected) in [
            ("phones", None, TierRole::Phones),
            ("Mara - Words", Some("Mara"), TierRole::Words),
            ("mara_phones", Some("mara"), TierRole::Phones),
            ("Mara: phones", Some("Mara"), TierRole::Phones),
            ("ORT-MAU", None, TierRole::Words),
            ("MAU", None, TierRole::Phones),
            ("KAN-MAU", None, TierRole::Unknown),
            ("PhonAlign", None, TierRole::Phones),
            ("visemes-rms", None, TierRole::Visemes(VisemeType::Rms)),
            ("A - visemes-toonboom", Some("A"), TierRole::Visemes(VisemeType::ToonBoom)),
            ("text_en-us", None, TierRole::Element),
            ("Mara - text_en-us", Some("Mara"), TierRole::Element),
            ("mara_events", None, TierRole::Unknown),
            ("a - b", None, TierRole::Unknown),
        ] {
            assert_eq!(role(name), (speaker, expected), "{name}");
        }
    }
}
