//! What a project asks of the texts of a bank as a whole.

use crate::check::locales::in_no_list;
use crate::fallback::script;
use crate::{MinCoverage, Options, coverage, pseudo, shortfalls};
use lipz_bank::{Bank, Clip, Locale, Voice};
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_file::locale;
use std::collections::BTreeMap;

/// Whether as much is translated as the project asks for.
pub(super) fn enough_texts(bank: &[u8], options: &Options) -> Result<(), Report> {
    if options.min_coverage == MinCoverage::default() {
        return Ok(());
    }
    // A damaged bank is found by who verifies it.
    let Ok(bank) = Bank::open(bank) else { return Ok(()) };
    let shortfalls = shortfalls(&coverage(&bank), &options.min_coverage);
    if shortfalls.is_empty() { Ok(()) } else { Err(Report::all_about("", shortfalls)) }
}

/// A diagnostic for each locale that the project packs and the bank does not have, at the project's level.
pub(super) fn locales_without_texts(bank: &[u8], options: &Options) -> Report {
    let (Some(packed), Ok(bank)) = (&options.locales, Bank::open(bank)) else { return Report::default() };
    let is_absent = |tag: &&String| bank.locale(tag).is_none() && !pseudo::is_pseudo(tag);
    let mut diagnostics = packed.iter().filter(is_absent).map(|tag| without_texts(tag)).collect();
    options.levels.apply(&mut diagnostics);
    Report::all_about("", diagnostics)
}

/// A diagnostic for each voice of a bank in whose locale no clip has a text, at the project's level. Those of a project
/// that names the locales of its bank may be of others.
pub(super) fn voices_without_texts(bank: &[u8], options: &Options) -> Report {
    let (None, Ok(bank)) = (&options.locales, Bank::open(bank)) else { return Report::default() };
    let tags: Vec<&str> = bank.locales().map(|locale| locale.tag()).collect();
    let is_lonely = |voice: &Voice<'_>| !tags.is_empty() && !tags.contains(&voice.tag());
    let diagnostic = |voice: Voice<'_>| {
        let message = format!("the clips have a voice in `{}`, but no clip has a text in it", voice.tag());
        let is_near = |tag: &&str| locale::language(tag) == locale::language(voice.tag());
        let near = tags.iter().copied().find(is_near);
        let near = near.or_else(|| lipz_diagnostics::suggest::nearest(voice.tag(), tags.iter().copied()));
        Diagnostic::new(Code::VoiceWithoutLocale, message).help(match near {
            Some(tag) => format!("did you mean `{tag}`? correct the locale in [voices]"),
            None => "correct the locale in [voices], or add what is said as texts of this locale".to_owned(),
        })
    };
    let mut diagnostics = bank.voices().filter(is_lonely).map(diagnostic).collect();
    options.levels.apply(&mut diagnostics);
    Report::all_about("", diagnostics)
}

/// A diagnostic for each locale of a bank whose missing texts another one of the same language has, but in another
/// script, at the project's level. What the project names, it has decided.
pub(super) fn scripts_not_crossed(bank: &[u8], options: &Options) -> Report {
    let Ok(bank) = Bank::open(bank) else { return Report::default() };
    let mut of_language: BTreeMap<&str, Vec<(Locale<'_>, Option<&str>)>> = BTreeMap::new();
    for locale in bank.locales().filter(|locale| !pseudo::is_pseudo(locale.tag())) {
        let (tag, script) = (locale.tag(), script(locale.tag()));
        of_language.entry(locale::language(tag)).or_default().push((locale, script));
    }
    let mut diagnostics = Vec::new();
    for locales in of_language.into_values() {
        let mut scripts: Vec<_> = locales.iter().map(|(_, script)| *script).collect();
        scripts.sort_unstable();
        scripts.dedup();
        if scripts.len() < 2 {
            continue;
        }
        for &(locale, own) in &locales {
            let others = || locales.iter().filter(|(_, script)| *script != own);
            // The default locale is everybody's last resort.
            if options.fallbacks.contains_key(locale.tag()) || others().any(|(other, _)| other.is_default()) {
                continue;
            }
            let has_text = |clip: &Clip<'_, '_>, locale| {
                let text = clip.segment(0).and_then(|segment| segment.text(locale));
                text.is_some_and(|text| !text.is_fallback())
            };
            let is_lost = |clip: &Clip<'_, '_>| {
                let nearer = locales.iter().filter(|(_, script)| *script == own);
                !nearer.copied().any(|(nearer, _)| has_text(clip, nearer))
                    && others().any(|(other, _)| has_text(clip, *other))
            };
            let count = bank.clips().filter(is_lost).count();
            if count > 0 {
                diagnostics.extend(others().next().map(|(other, _)| not_crossed(locale.tag(), other.tag(), count)));
            }
        }
    }
    options.levels.apply(&mut diagnostics);
    Report::all_about("", diagnostics)
}

fn not_crossed(tag: &str, other: &str, count: usize) -> Diagnostic {
    let name = |tag: &str| script(tag).unwrap_or("unknown").to_owned();
    let message = format!(
        "`{tag}` does not fall back to `{other}`, which is written in another script ({}, not {})",
        name(other),
        name(tag)
    );
    let clips = if count == 1 { "1 clip has" } else { &format!("{count} clips have") };
    Diagnostic::new(Code::OtherScript, message)
        .note(format!("{clips} texts of this language in another script only"))
        .help(format!(
            "translate them; or name what players of `{tag}` see instead, in lipz.toml: [fallbacks] {tag} = [\"{other}\"]"
        ))
}

fn without_texts(tag: &str) -> Diagnostic {
    let diagnostic =
        Diagnostic::new(Code::LocaleWithoutTexts, format!("`{tag}` is to be packed, but no clip has a text in it"));
    match Some(tag).filter(|tag| locale::has_lipz_shape(tag)).and_then(in_no_list) {
        Some(what) => diagnostic.note(what).help("is it misspelt?"),
        None => diagnostic.help("is it misspelt? if not, leave it out until there are texts"),
    }
}
