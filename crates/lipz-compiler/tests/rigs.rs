//! The built-in rigs: each phone moves its own shape most.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::articulation::Rig;
use lipz_bank::curve::CurveValue;
use lipz_bank::face::{Emotions, Face};
use lipz_bank::{Bank, Micros};
use lipz_compiler::rigs::built_in;
use lipz_compiler::{Compiler, Input, Options};

/// The shapes of viseme sets with the English phones that move them.
const OVR: &str = "sil: sil; PP: P B M; FF: F V; TH: TH DH; DD: T D N; kk: K G NG; CH: CH JH SH ZH; SS: S Z; nn: L; \
     RR: R ER; aa: AA AE AH; E: EH; ih: IH IY Y; oh: AO; ou: UW UH W";
const AZURE: &str = "0: sil; 1: AE AX AH HH; 2: AA; 3: AO; 4: EH; 5: ER; 6: Y IY IH; 7: W UW UH; 13: R; 14: L; \
     15: S Z; 16: SH CH JH ZH; 17: TH DH; 18: F V; 19: D T N; 20: K G NG; 21: P B M";
const TALKING_HEADS: &str = "P: P B M; F: F V; TH: TH DH; D: T D N; K: K G NG; CH: CH JH SH ZH; S: S Z; L: L; \
     R: R ER; AA: AA AE; AH: AH AX HH; E: EH; I: IH IY Y; O: AO; U: UW UH; W: W";

/// Returns the weights of a rig in the middle of a long phone, by name.
fn weights(rig: &str, phone: &str) -> Vec<(String, i32)> {
    let content = format!("{{ \"fps\": 24, \"visemes\": \"{}\", \"phones\": \"{phone}@0\" }}", "A".repeat(24));
    let rigs = [(rig.to_owned(), built_in(rig).unwrap())].into_iter().collect();
    let options = Options::default().rigs(rigs);
    let bank = Compiler::new(options).compile(&[Input::from_bytes("a", content)]).into_bank().unwrap();
    let bank = Bank::open(&bank).unwrap().verify().unwrap();
    let mouth = bank.clip_by_key("a").unwrap().articulation_at(Micros(500_000), &bank.default_articulation());
    let rig: Rig<'_> = bank.rig(rig).unwrap();
    let mut out = [CurveValue::default(); 64];
    rig.weights(&mouth, &Emotions::default(), &Face::default(), &mut out);
    rig.weight_names().map(str::to_owned).zip(out.iter().map(|value| value.thousandths())).collect()
}

#[test]
fn each_phone_moves_its_own_shape_most() {
    let prefixed = [("ovr", "", OVR), ("vrchat", "vrc.v_", OVR), ("azure", "viseme_", AZURE)];
    let others = [("sapi", "SP_VISEME_", AZURE), ("talking-heads", "", TALKING_HEADS)];
    for (rig, prefix, groups) in prefixed.into_iter().chain(others) {
        for group in groups.split("; ") {
            let (shape, phones) = group.trim().split_once(": ").unwrap();
            let shape = if rig == "vrchat" { shape.to_lowercase() } else { shape.to_owned() };
            for phone in phones.split(' ') {
                let weights = weights(rig, phone);
                let (name, most) = weights.iter().max_by_key(|(_, weight)| *weight).unwrap();
                assert_eq!(*name, format!("{prefix}{shape}"), "{rig}, {phone}: {weights:?}");
                assert!(*most > 300, "{rig}, {phone}: {weights:?}");
            }
        }
    }
}

#[test]
fn closed_lips_move_the_shape_of_closed_lips_in_every_rig() {
    for (rig, shape) in
        [("arkit", "mouthClose"), ("facefx", "PBM"), ("mmd", "ん"), ("ovr", "PP"), ("azure", "viseme_21")]
    {
        let weight = |phone: &str| weights(rig, phone).into_iter().find(|(name, _)| name == shape).unwrap().1;
        assert!(weight("M") > weight("AA") && weight("M") > 100, "{rig}: {} {}", weight("M"), weight("AA"));
    }
    // The jaw is what Second Life's viewer calls aah.
    let aah = |phone: &str| weights("second-life", phone)[0].1;
    assert!(aah("AA") > 800 && aah("S") < 100, "{} {}", aah("AA"), aah("S"));
}
