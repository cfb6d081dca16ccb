//! Forged banks with valid checksums: if they pass verification, no tool panics.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_compiler::{Compiler, Input, Options, Voices};
use lipz_layout::{CHECKED_FROM, checksum};
use lipz_testkit::tools::is_used;

/// Returns a bank with padded, joined, falling back and unknown elements, and a dub.
fn bank() -> Vec<u8> {
    let inputs = [
        Input::from_bytes(
            "act1/a",
            r#"{ "viseme_type": "blair", "fps": 24, "visemes": "AM|O-", "text_en-us": " Aye. | {x} Now?",
                "text_de-de": "Ja.|", "events": "amy points door| feels sad ", "x": [1], "y": "z" }"#,
        ),
        Input::from_bytes("b", r#"{ "visemes": "MA", "text_en-us": " No. ", "Text_en_us": null }"#),
        Input::from_bytes("b_fr", r#"{ "visemes": "EAO", "text_fr-fr": "Non." }"#),
    ];
    let options = Options::new()
        .default_locale("en-us")
        .unwrap()
        .voices(Voices::new("en-us").unwrap().dub("fr-fr", "{key}_fr").unwrap());
    Compiler::new(options.clone()).compile(&inputs).bank.unwrap()
}

#[test]
fn every_forged_byte() {
    let good = bank();
    let mut used = 0;
    for at in CHECKED_FROM..good.len() {
        for change in [0x01, 0x02, 0x04, 0x40, 0x80, 0xFF] {
            let mut forged = good.clone();
            forged[at] ^= change;
            let sum = checksum(&forged[CHECKED_FROM..]);
            forged[CHECKED_FROM - size_of_val(&sum)..CHECKED_FROM].copy_from_slice(&sum.to_le_bytes());
            used += usize::from(is_used(&forged, &good));
        }
    }
    // Texts, names of events and source records may have any content.
    assert!(used > 500, "{used}");
}
