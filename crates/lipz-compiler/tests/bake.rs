//! Baked rigs: the weights that a program would compute, as ordinary curves.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::articulation::Articulator;
use lipz_bank::{Bank, Micros};
use lipz_compiler::{ClipWeights, Compiler, Documents, Input, Options, rigs};
use lipz_testkit::dialogue;

const MAMA: &str = r#"{ "fps": 24, "visemes": "------------------------", "text": "{joy 5} Mama!",
    "phones": "sil@0 M@200 AA@280 M@420 AA@500 sil@700", "curves": { "jawForward": "0:0.2", "mouthPucker": "0:0.5" } }"#;

fn options() -> Options {
    Options::new().default_locale("en-us").unwrap()
}

fn bank(options: Options, content: &str) -> Vec<u8> {
    Compiler::new(options).compile(&[Input::from_bytes("a", content)]).into_bank().unwrap()
}

fn baked(content: &str) -> Vec<u8> {
    bank(options().baked_rig(("arkit".to_owned(), rigs::built_in("arkit").unwrap())), content)
}

#[test]
fn baked_curves_are_the_weights_of_the_reader() {
    let arkit = [("arkit".to_owned(), rigs::built_in("arkit").unwrap())];
    let computed = bank(options().rigs(arkit.into()), MAMA);
    let baked = baked(MAMA);
    let (computed, baked) = (Bank::open(&computed).unwrap(), Bank::open(&baked).unwrap().verify().unwrap());
    assert!(baked.rig("arkit").is_none(), "tiny readers do not need it");
    let [source, clip] = [&computed, &baked].map(|bank| bank.clip_by_key("a").unwrap());
    let weights = ClipWeights::new(&computed, source, computed.rig("arkit").unwrap());
    let mut largest = 0;
    for frame in 0..24 {
        let expected = weights.at(Micros(i64::from(frame) * 1_000_000 / 24));
        for (name, expected) in weights.names().zip(expected) {
            let value = clip.curve(name).map_or(0, |curve| curve.value(frame).thousandths());
            assert!((value - expected.thousandths()).abs() <= 10, "{name} in frame {frame}: {value} {expected}");
            largest = largest.max(value);
        }
    }
    assert!(largest > 400, "the mouth moves");
    assert_eq!(clip.curve("mouthPucker").unwrap().value(12).thousandths(), 500, "curves of the file stay");
    assert_eq!(clip.curve("jawForward").unwrap().value(12).thousandths(), 200);
    let names: Vec<&str> = clip.curves().map(|curve| curve.name().as_str()).collect();
    assert!(
        names.is_sorted() && !names.contains(&"mouthFrownLeft"),
        "weights that never move have no curve: {names:?}"
    );
}

#[test]
fn a_baked_bank_restores_the_file() {
    let packed = baked(MAMA);
    dialogue!(restored = &packed);
    let documents = Documents::from_dialogue(&restored).unwrap();
    let (_, document) = documents.iter().next().unwrap().unwrap();
    assert_eq!(document, lipz_file::parse(MAMA.as_bytes()).document.unwrap());
}

#[test]
fn clips_without_phones_are_baked_from_their_shapes() {
    let packed = baked(r#"{ "fps": 24, "viseme_type": "blair", "visemes": "--MMAAAA--" }"#);
    let bank = Bank::open(&packed).unwrap();
    let clip = bank.clip_by_key("a").unwrap();
    let [closed, open] = [2, 6].map(|frame| clip.curve("jawOpen").unwrap().value(frame).thousandths());
    assert!(closed < open && open > 300, "{closed} {open}");
    assert!(clip.curve("mouthClose").unwrap().value(3).thousandths() > 0);
    let silent = baked(r#"{ "text": "Hi." }"#);
    let bank = Bank::open(&silent).unwrap();
    assert_eq!(bank.clip_by_key("a").unwrap().curves().count(), 0);
}

#[test]
fn a_curve_with_the_name_of_an_articulator_moves_the_weights() {
    let content = MAMA.replace("\"jawForward\"", "\"jaw\": \"0:0 23:0\", \"jawForward\"");
    let packed = baked(&content);
    let bank = Bank::open(&packed).unwrap();
    let clip = bank.clip_by_key("a").unwrap();
    let profile = bank.default_articulation();
    let mouth = clip.articulation_at(Micros(350_000), &profile);
    assert_eq!(mouth.thousandths(Articulator::Jaw), 0);
    let most =
        |name: &str| clip.curve(name).map_or(0, |curve| curve.keys().map(|key| key.value.thousandths()).max().unwrap());
    assert!(most("jawOpen") < 200, "only joy opens it: {}", most("jawOpen"));
}
