//! Requirements of a project for the texts of a bank, or of a set of banks, as a whole.

use crate::bank::{Coverage, coverage, shortfalls};
use crate::check::locales::in_no_list;
use crate::locales::fallback::script;
use crate::project::pseudo_locale::is_pseudo;
use crate::project::{MinCoverage, Options};
use lipz_bank::files::DialogueFile;
use lipz_bank::{Bank, Clip, Dialogue, Locale};
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_file::locale;
use std::collections::{BTreeMap, BTreeSet};

/// The data for checking the texts of a bank, or of all banks of a set.
#[derive(Default)]
pub(crate) struct TextFacts {
    /// The locales, if a bank was examined.
    locales: Option<Vec<String>>,
    /// The voices.
    voices: Vec<String>,
    /// Pairs of locales of the same language, of which the second has texts that the first lacks, in a different
    /// script; and the number of clips.
    crossed: Vec<(String, String, usize)>,
    /// Empty if the project requires no coverage.
    coverage: Vec<Coverage>,
}

impl TextFacts {
    /// Collects the data of a bank. Ignores a damaged one, which its verification reports.
    pub(crate) fn of(bank: &[u8], options: &Options) -> TextFacts {
        let mut files = [DialogueFile::ABSENT];
        let Ok(dialogue) = Dialogue::open_unverified(&mut files, [bank]) else { return TextFacts::default() };
        let Some(bank) = dialogue.bank(0) else { return TextFacts::default() };
        let asks = options.min_coverage != MinCoverage::default();
        let coverage = if asks { coverage(&dialogue) } else { Vec::new() };
        TextFacts { coverage, ..TextFacts::without_coverage(bank, options) }
    }

    /// Collects the data of a bank whose coverage was checked before.
    #[cfg(feature = "cache")]
    pub(crate) fn of_old(bank: &[u8], options: &Options) -> TextFacts {
        Bank::open(bank).map_or_else(|_| TextFacts::default(), |bank| TextFacts::without_coverage(&bank, options))
    }

    fn without_coverage(bank: &Bank<'_>, options: &Options) -> TextFacts {
        TextFacts {
            locales: Some(bank.locales().map(|locale| bank.locale_tag(locale).to_owned()).collect()),
            voices: bank.voices().map(|voice| bank.voice_tag(voice).to_owned()).collect(),
            crossed: crossed(bank, options),
            coverage: Vec::new(),
        }
    }

    /// Adds those of another bank of the set, which has the same locales.
    #[cfg(feature = "shards")]
    pub(crate) fn add(&mut self, other: TextFacts) {
        self.locales = self.locales.take().or(other.locales);
        self.voices.extend(other.voices);
        for (tag, from, count) in other.crossed {
            match self.crossed.iter_mut().find(|(known, ..)| *known == tag) {
                Some((.., sum)) => *sum += count,
                None => self.crossed.push((tag, from, count)),
            }
        }
        if self.coverage.is_empty() {
            self.coverage = other.coverage;
            return;
        }
        for (sum, of_bank) in std::iter::zip(&mut self.coverage, &other.coverage) {
            sum.clip_count += of_bank.clip_count;
            sum.own_count += of_bank.own_count;
        }
    }

    /// Checks that the required shares are translated.
    ///
    /// # Errors
    /// If a locale is below its minimum.
    pub(crate) fn check_coverage(&self, options: &Options) -> Result<(), Report> {
        if options.min_coverage == MinCoverage::default() || self.locales.is_none() {
            return Ok(());
        }
        let shortfalls = shortfalls(&self.coverage, &options.min_coverage);
        if shortfalls.is_empty() { Ok(()) } else { Err(Report::all_about("", shortfalls)) }
    }

    /// Returns the warnings about them, at the project's levels.
    pub(crate) fn judged(&self, options: &Options) -> Report {
        let Some(locales) = &self.locales else { return Report::default() };
        let mut diagnostics = Vec::new();
        if let Some(packed) = &options.locales {
            let is_absent = |tag: &&String| !locales.contains(tag) && !is_pseudo(tag);
            diagnostics.extend(packed.iter().filter(is_absent).map(|tag| without_texts(tag)));
        }
        let crossed = self.crossed.iter().filter(|(.., count)| *count > 0);
        diagnostics.extend(crossed.map(|(tag, other, count)| not_crossed(tag, other, *count)));
        // If the project selects the locales of its bank, the voices may have others.
        if options.locales.is_none() && !locales.is_empty() {
            // The voices of a set come from several banks. The original comes first, as in each of them.
            let lonely = self.voices.iter().filter(|voice| !locales.contains(voice));
            let lonely: BTreeSet<_> =
                lonely.map(|voice| (Some(voice) != options.voices.original.as_ref(), voice)).collect();
            diagnostics.extend(lonely.into_iter().map(|(_, voice)| lonely_voice(voice, locales)));
        }
        options.levels.apply(&mut diagnostics);
        Report::all_about("", diagnostics)
    }
}

/// Returns a diagnostic for a voice in whose locale no clip has a text.
fn lonely_voice(voice: &str, locales: &[String]) -> Diagnostic {
    let message = format!("clips are spoken in `{voice}`, but no clip has a text in it");
    let tags = || locales.iter().map(String::as_str);
    let near = tags().find(|tag| locale::language(tag) == locale::language(voice));
    let near = near.or_else(|| lipz_diagnostics::suggest::nearest(voice, tags()));
    Diagnostic::new(Code::VoiceWithoutLocale, message).help(match near {
        Some(tag) => format!("correct the locale in [voices]; did you mean `{tag}`?"),
        None => "correct the locale in [voices], or add the spoken texts in this locale".to_owned(),
    })
}

/// Returns pairs of locales of a bank: one whose missing texts exist in another locale of the same language, but in a
/// different script, and that locale; with the number of affected clips. Locales whose fallback the project sets are
/// excluded.
fn crossed(bank: &Bank<'_>, options: &Options) -> Vec<(String, String, usize)> {
    let mut of_language: BTreeMap<&str, Vec<(Locale, Option<&str>)>> = BTreeMap::new();
    let tag = |locale: &Locale| bank.locale_tag(*locale);
    for locale in bank.locales().filter(|locale| !is_pseudo(tag(locale)) && !locale::is_variant(tag(locale))) {
        let (tag, script) = (tag(&locale), script(tag(&locale)));
        of_language.entry(locale::language(tag)).or_default().push((locale, script));
    }
    let (mut found, default) = (Vec::new(), bank.default_locale());
    for locales in of_language.into_values() {
        let mut scripts: Vec<_> = locales.iter().map(|(_, script)| *script).collect();
        scripts.sort_unstable();
        scripts.dedup();
        if scripts.len() < 2 {
            continue;
        }
        for &(locale, own) in &locales {
            let others = || locales.iter().filter(|(_, script)| *script != own);
            // The default locale is the last fallback of every locale.
            if options.fallbacks.contains_key(tag(&locale)) || others().any(|(other, _)| default == Some(*other)) {
                continue;
            }
            let has_text =
                |clip: &Clip<'_>, locale| clip.segment(0).is_some_and(|segment| segment.has_own_text(locale));
            let is_lost = |clip: &Clip<'_>| {
                let nearer = locales.iter().filter(|(_, script)| *script == own);
                !nearer.copied().any(|(nearer, _)| has_text(clip, nearer))
                    && others().any(|(other, _)| has_text(clip, *other))
            };
            let count = bank.clips().filter(is_lost).count();
            let other = others().next().map(|(other, _)| tag(other).to_owned());
            found.extend(other.map(|other| (tag(&locale).to_owned(), other, count)));
        }
    }
    found
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
        .note(format!("{clips} texts of this language only in a different script"))
        .help(format!(
            "translate them, or name the locale that players of `{tag}` see instead in lipz.toml: [fallbacks] {tag} = \
                [\"{other}\"]"
        ))
}

fn without_texts(tag: &str) -> Diagnostic {
    let diagnostic =
        Diagnostic::new(Code::LocaleWithoutTexts, format!("no clip has a text in `{tag}`, which is a locale to pack"));
    match Some(tag).filter(|tag| locale::has_lipz_shape(tag)).and_then(in_no_list) {
        Some(what) => diagnostic.note(what).help("check its spelling"),
        None => diagnostic.help("check its spelling, or leave it out until clips have texts in it"),
    }
}
