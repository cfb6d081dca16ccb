//! Layers by someone who knows the format, over a bank that they were or were not made for.

use super::forged_bank::Forgery;
use crate::stacked::every_query;
use arbitrary::{Arbitrary, Unstructured};
use lipz_bank::Bank;
use lipz_compiler::{Compiler, Input, Options, Over, Stack};
use std::sync::LazyLock;

/// A base, and a layer that changes a text, a mouth and a default, removes a clip and a locale, and adds both.
static FILES: LazyLock<[Vec<u8>; 2]> = LazyLock::new(|| {
    let inputs = |files: &[(&str, &str)]| -> Vec<Input> {
        files.iter().map(|(key, file)| Input::from_bytes(*key, *file)).collect()
    };
    let old = inputs(&[
        ("a", r#"{ "fps": 24, "visemes": "MA|EO", "text_en-us": "Aye.|No", "events": "|amy points door" }"#),
        ("b", r#"{ "visemes": "A-", "text_en-us": "Aye." }"#),
        ("c", r#"{ "text_de-de": "Ja.", "text_en-us": "Yes." }"#),
    ]);
    let new = inputs(&[
        ("a", r#"{ "fps": 24, "visemes": "MA|EO", "text_en-us": "Nay.|No", "events": "|amy points door" }"#),
        ("b", r#"{ "visemes": "AA", "text_en-us": "Aye." }"#),
        ("d", r#"{ "text_fr-fr": "Oui.", "text_en-us": "Yes.", "curves": { "joy": "0:1" } }"#),
    ]);
    let compiler = |locale: &str| Compiler::new(Options::new().strip(true).default_locale(locale).threads(1));
    let base = compiler("en-us").compile(&old).into_bank().expect("files without errors");
    let over = Over::new(Stack::open([("base", &base)]).expect("a bank"));
    let layer = compiler("fr-fr").compile_over(&new, &over).into_bank().expect("a change");
    [base, layer]
});

/// Makes the changes that the bytes stand for in the layer, and asks stacks everything. The tools take what the reader takes.
pub fn layers(bytes: &[u8]) {
    let Ok(forgery) = Forgery::arbitrary_take_rest(Unstructured::new(bytes)) else { return };
    let [base, layer] = &*FILES;
    let forged = forgery.apply_to(layer);
    let (below, opened) = (Bank::open(base).expect("a bank"), Bank::open(&forged));
    let Ok(opened) = opened else { return };
    for stack in [&[below, opened][..], &[opened, below], &[opened, opened], &[below, opened, opened]] {
        every_query(stack);
    }
    if let Ok(verified) = opened.verify() {
        let fits = every_query(&[below.verify().expect("a whole bank"), verified]);
        let stack = Stack::open([("base", base), ("layer", &forged)]);
        assert_eq!(stack.is_ok(), fits, "reader and tools differ about what fits");
    }
}
