//! The locales of translations, and their source locale.

use crate::reporter::{Abort, Reporter};
use lipz_compiler::{Compiler, Input, Options};
use lipz_file::locale::{is_variant, text_name};
use lipz_texts::{ClipTexts, texts_of};
use std::collections::BTreeSet;

/// Returns the locale that the texts are translated from.
pub(crate) fn source_locale(
    from: Option<&String>,
    options: &Options,
    reporter: &mut Reporter,
) -> Result<String, Abort> {
    let default = || lipz_file::locale::canonical_tag(options.get_default_locale()?, true);
    from.cloned().or_else(default).ok_or_else(|| {
        let tip = "name it with `--from`, as in en-us, or set `default-locale` in lipz.toml";
        reporter.usage("the source locale is not set", tip)
    })
}

/// Returns the locales of the files, without the source locale.
pub(crate) fn locales_of(inputs: &[Input], options: &Options, source_locale: &str) -> Vec<String> {
    let each = Compiler::new(options.clone()).each_file(inputs, |_, bytes| {
        let document = lipz_file::parse(bytes).document.unwrap_or_default();
        document.elements.iter().filter_map(|element| text_name(&element.name.text)?.tag()).collect::<Vec<String>>()
    });
    let all: BTreeSet<String> = each.into_iter().flatten().flatten().collect();
    all.into_iter().filter(|locale| locale != source_locale && !is_variant(locale)).collect()
}

/// Returns the keys and texts of clips.
pub(crate) fn texts_of_clips(inputs: &[Input], options: &Options) -> Vec<(String, ClipTexts)> {
    let each = Compiler::new(options.clone()).each_file(inputs, |_, bytes| {
        let document = lipz_file::parse(bytes).document.unwrap_or_default();
        texts_of(&document, options.get_default_locale())
    });
    let pairs = inputs.iter().zip(each);
    pairs.filter_map(|(input, texts)| Some((input.key.clone(), texts.ok()?))).collect()
}
