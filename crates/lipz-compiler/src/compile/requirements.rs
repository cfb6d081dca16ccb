//! What a project asks of the texts of a bank, or of a set of banks, as a whole.

use crate::check::locales::in_no_list;
use crate::fallback::script;
use crate::{Coverage, MinCoverage, Options, coverage, pseudo, shortfalls};
use lipz_bank::files::DialogueFile;
use lipz_bank::{Bank, Clip, Dialogue, Locale};
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_file::locale;
use std::collections::{BTreeMap, BTreeSet};

/// What the texts of a bank, or of all banks of a set, are judged by.
#[derive(Default)]
pub(crate) struct Texts {
    /// The locales, if a bank was looked at.
    locales: Option<Vec<String>>,
    /// The voices.
    voices: Vec<String>,
    /// Locales that another one of their language has texts for, in another script: both, and how many clips.
    crossed: Vec<(String, String, usize)>,
    /// Empty if nothing is asked of it.
    coverage: Vec<Coverage>,
}

impl Texts {
    /// Those of a bank. Nothing is said of a damaged one, which is found by who verifies it.
    pub(crate) fn of(bank: &[u8], options: &Options) -> Texts {
        let mut files = [DialogueFile::ABSENT];
        let Ok(dialogue) = Dialogue::open_unverified(&mut files, [bank]) else { return Texts::default() };
        let Some(bank) = dialogue.bank(0) else { return Texts::default() };
        let asks = options.min_coverage != MinCoverage::default();
        let coverage = if asks { coverage(&dialogue) } else { Vec::new() };
        Texts { coverage, ..Texts::without_coverage(bank, options) }
    }

    /// The same for a bank whose coverage was judged before.
    #[cfg(feature = "cache")]
    pub(crate) fn of_old(bank: &[u8], options: &Options) -> Texts {
        Bank::open(bank).map_or_else(|_| Texts::default(), |bank| Texts::without_coverage(&bank, options))
    }

    fn without_coverage(bank: &Bank<'_>, options: &Options) -> Texts {
        Texts {
            locales: Some(bank.locales().map(|locale| bank.locale_tag(locale).to_owned()).collect()),
            voices: bank.voices().map(|voice| bank.voice_tag(voice).to_owned()).collect(),
            crossed: crossed(bank, options),
            coverage: Vec::new(),
        }
    }

    /// Adds those of another bank of the set, which has the same locales.
    #[cfg(feature = "shards")]
    pub(crate) fn add(&mut self, other: Texts) {
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

    /// Whether as much is translated as the project asks for.
    pub(crate) fn are_enough(&self, options: &Options) -> Result<(), Report> {
        if options.min_coverage == MinCoverage::default() || self.locales.is_none() {
            return Ok(());
        }
        let shortfalls = shortfalls(&self.coverage, &options.min_coverage);
        if shortfalls.is_empty() { Ok(()) } else { Err(Report::all_about("", shortfalls)) }
    }

    /// What the project should know of them, at its levels.
    pub(crate) fn judged(&self, options: &Options) -> Report {
        let Some(locales) = &self.locales else { return Report::default() };
        let mut diagnostics = Vec::new();
        if let Some(packed) = &options.locales {
            let is_absent = |tag: &&String| !locales.contains(tag) && !pseudo::is_pseudo(tag);
            diagnostics.extend(packed.iter().filter(is_absent).map(|tag| without_texts(tag)));
        }
        let crossed = self.crossed.iter().filter(|(.., count)| *count > 0);
        diagnostics.extend(crossed.map(|(tag, other, count)| not_crossed(tag, other, *count)));
        // The voices of a project that names the locales of its bank may be of others.
        if options.locales.is_none() && !locales.is_empty() {
            // Of a set, they come from several banks. The original first, as in each of these.
            let lonely = self.voices.iter().filter(|voice| !locales.contains(voice));
            let lonely: BTreeSet<_> =
                lonely.map(|voice| (Some(voice) != options.voices.original.as_ref(), voice)).collect();
            diagnostics.extend(lonely.into_iter().map(|(_, voice)| lonely_voice(voice, locales)));
        }
        options.levels.apply(&mut diagnostics);
        Report::all_about("", diagnostics)
    }
}

/// A diagnostic for a voice in whose locale no clip has a text.
fn lonely_voice(voice: &str, locales: &[String]) -> Diagnostic {
    let message = format!("the clips have a voice in `{voice}`, but no clip has a text in it");
    let tags = || locales.iter().map(String::as_str);
    let near = tags().find(|tag| locale::language(tag) == locale::language(voice));
    let near = near.or_else(|| lipz_diagnostics::suggest::nearest(voice, tags()));
    Diagnostic::new(Code::VoiceWithoutLocale, message).help(match near {
        Some(tag) => format!("did you mean `{tag}`? correct the locale in [voices]"),
        None => "correct the locale in [voices], or add what is said as texts of this locale".to_owned(),
    })
}

/// The locales of a bank whose missing texts another one of the same language may have, but in another script, with that and
/// with the number of clips of which this is so. What the project names, it has decided.
fn crossed(bank: &Bank<'_>, options: &Options) -> Vec<(String, String, usize)> {
    let mut of_language: BTreeMap<&str, Vec<(Locale, Option<&str>)>> = BTreeMap::new();
    let tag = |locale: &Locale| bank.locale_tag(*locale);
    for locale in bank.locales().filter(|locale| !pseudo::is_pseudo(tag(locale))) {
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
            // The default locale is everybody's last resort.
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
