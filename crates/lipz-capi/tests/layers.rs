//! A stack gives the answers of the reader: clips, texts, locales, and what does not fit.
#![allow(unsafe_code, clippy::unwrap_used, clippy::cast_possible_truncation, reason = "tests")]

mod common;

use common::{Answer, DRAMA, ptr, text_of};
use lipz_bank::{Layers, Micros};
use lipz_capi::*;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Input, Options, Over, Stack, Voices};
use std::ptr::null;

/// A base, a patch that changes a text, removes a clip and adds a locale, and a mod that changes a mouth.
fn files() -> [Vec<u8>; 3] {
    let inputs = |files: &[(&str, &str)]| -> Vec<Input> {
        files.iter().map(|(key, file)| Input::from_bytes(*key, *file)).collect()
    };
    let aye = r#"{ "fps": 24, "visemes": "AEE-", "text_en-us": "Aye." }"#;
    let base = inputs(&[("aye", aye), ("no", r#"{ "text_en-us": "No." }"#), ("so", r#"{ "text_en-us": "So." }"#)]);
    let next = inputs(&[("aye", aye), ("so", r#"{ "text_en-us": "So!", "text_de-de": "So!" }"#)]);
    let addition = inputs(&[("aye", r#"{ "fps": 24, "visemes": "MAM-", "text_en-us": "Aye." }"#)]);
    let compiler = Compiler::new(Options::new().default_locale("en-us").strip(true));
    let base = compiler.compile(&base).into_bank().unwrap();
    let patch = compiler.compile_over(&next, &Over::new(Stack::open([("base", &base)]).unwrap())).into_bank().unwrap();
    let over = Over::new(Stack::open([("base", &base), ("patch", &patch)]).unwrap()).keep_others(true);
    let addition = compiler.compile_over(&addition, &over).into_bank().unwrap();
    [base, patch, addition]
}

fn opened(bytes: &[u8]) -> Bank {
    Answer::from_call(|out| unsafe { lipz_bank_open(bytes.as_ptr(), bytes.len(), out, None) }).ok()
}

#[test]
fn a_stack_answers_as_that_of_the_reader() {
    let files = files();
    let banks = files.each_ref().map(|file| opened(file));
    let (array, count) = (banks.as_ptr(), banks.len() as u32);
    let read = files.each_ref().map(|file| lipz_bank::Bank::open(file).unwrap().verify().unwrap());
    let layers = Layers::new(read).unwrap();
    assert_eq!(unsafe { lipz_layers_check(array, count, None) }, LIPZ_OK);
    let tags: Vec<&str> = layers.locale_tags().collect();
    let mut texts = 0;
    for key in ["aye", "no", "so", "nowhere"] {
        let (data, length) = ptr(key);
        let id = lipz_bank::ClipId::from_key(key);
        let by_key =
            Answer::<LayeredClip>::from_call(|out| unsafe { lipz_layers_clip_by_key(array, count, data, length, out) });
        let by_id =
            Answer::<LayeredClip>::from_call(|out| unsafe { lipz_layers_clip_by_id(array, count, id.get(), out) });
        let Some(expected) = layers.clip(id) else {
            assert_eq!((by_key.status, by_id.status), (LIPZ_NONE, LIPZ_NONE));
            continue;
        };
        let (found, by_id) = (by_key.ok(), by_id.ok());
        assert_eq!((found.layer, found.clip.slot), (by_id.layer, by_id.clip.slot));
        assert_eq!((found.layer as usize, found.clip.slot), (expected.layer(), expected.slot()));
        assert_eq!(Some(found.texts_layer as usize), expected.texts_layer());
        for tag in &tags {
            let locale = layers.locale(tag).unwrap();
            let (data, length) = ptr(tag);
            let of_layer = Answer::<LayeredLocale>::from_call(|out| unsafe {
                lipz_layers_locale(array, count, found.texts_layer, data, length, out)
            });
            let of_layer = of_layer.some();
            assert_eq!(of_layer.map(|it| text_of(it.locale.tag)), locale.tag_in(found.texts_layer as usize));
            let Some(of_layer) = of_layer else { continue };
            let text = Answer::<Text>::from_call(|out| unsafe {
                lipz_layers_text(array, count, Some(&found), 0, Some(&of_layer), out)
            });
            let text = text.some().map(|text| {
                (text_of(String { data: text.data, length_bytes: text.length_bytes }), text.is_fallback == 1)
            });
            let expected = expected.text(0, &locale).map(|text| (text.as_str(), text.is_fallback()));
            texts += usize::from(expected.is_some());
            assert_eq!(text, expected, "{key} {tag}");
        }
    }
    assert_eq!(texts, 4, "two clips in two locales");
}

#[test]
fn what_does_not_fit_is_refused() {
    let files = files();
    let [base, patch, addition] = files.each_ref().map(|file| opened(file));
    let other = opened(DRAMA);
    let check = |banks: &[Bank]| {
        let found = Answer::from_call(|out| unsafe { lipz_layers_check(banks.as_ptr(), banks.len() as u32, out) });
        (found.status, found.written())
    };
    assert_eq!(check(&[base, patch, addition]), (LIPZ_OK, 0));
    assert_eq!(check(&[patch]), (37, 0));
    assert_eq!(check(&[base, addition]), (37, 1));
    assert_eq!(check(&[other, patch]), (37, 1));
    assert_eq!(check(&[base, patch, other]), (38, 2));
    assert_eq!(unsafe { lipz_layers_check(null(), 0, None) }, 39);
    assert_eq!(unsafe { lipz_layers_check(null(), 1, None) }, LIPZ_NULL_POINTER);
    let clip = Answer::<LayeredClip>::from_call(|out| unsafe { lipz_layers_clip_by_id(null(), 3, 1, out) });
    assert_eq!((clip.status, clip.written().layer), (LIPZ_NULL_POINTER, LIPZ_NO_LAYER));
    let text = Answer::<Text>::from_call(|out| unsafe {
        lipz_layers_text(null(), 3, Some(&LayeredClip::default()), 0, Some(&LayeredLocale::default()), out)
    });
    assert_eq!(text.status, LIPZ_NONE);
}

#[test]
fn the_bank_that_says_what_is_said_once() {
    let compiler = |locale: &str| Compiler::new(Options::new().default_locale(locale).strip(true));
    let input = [Input::from_bytes("aye", r#"{ "text_en-us": "Aye.", "text_de-de": "Ja." }"#)];
    let base = compiler("en-us").compile(&input).into_bank().unwrap();
    let over = Over::new(Stack::open([("base", &base)]).unwrap());
    let patch = compiler("de-de").compile_over(&input, &over).into_bank().unwrap();
    let banks = [opened(&base), opened(&patch)];
    let info = Answer::<LayersInfo>::from_call(|out| unsafe { lipz_layers_info(banks.as_ptr(), 2, out) }).ok();
    assert_eq!((info.babble_layer, info.default_locale_layer, info.faces_layer), (0, 1, 0));
}

/// The base has clips, the patch the profiles that count: faces are those of the reader.
#[test]
fn faces_of_a_stack_have_the_profiles_of_the_topmost_bank_with_some() {
    let options = |settings: &str| {
        let (settings, report) = Settings::parse(settings.as_bytes(), "lipz.toml", "".as_ref());
        assert_eq!(report.diagnostics, []);
        Compiler::new(settings.options.strip(true))
    };
    let aye = r#"{ "fps": 24, "visemes": "AEAEAEAEAEAE", "text_en-us": "{anger 4} Aye." }"#;
    let input = [Input::from_bytes("aye", aye)];
    let base = options("face.robot.blink = 3").compile(&input).into_bank().unwrap();
    let over = Over::new(Stack::open([("base", &base)]).unwrap());
    let patch = options("face.blink = 1\nface.robot.blink = 0").compile_over(&input, &over).into_bank().unwrap();
    let banks = [opened(&base), opened(&patch)];
    let (array, count) = (banks.as_ptr(), 2);
    let read = [&base, &patch].map(|file| lipz_bank::Bank::open(file).unwrap().verify().unwrap());
    let layers = Layers::new(read).unwrap();
    let clip = layers.clip_by_key("aye").unwrap();
    assert_eq!((clip.layer(), layers.of_faces().map(lipz_bank::Bank::checksum)), (0, Some(read[1].checksum())));
    let id = clip.id().get();
    let found = Answer::<LayeredClip>::from_call(|out| unsafe { lipz_layers_clip_by_id(array, count, id, out) }).ok();
    let info = Answer::<LayersInfo>::from_call(|out| unsafe { lipz_layers_info(array, count, out) }).ok();
    assert_eq!(info.faces_layer, 1);
    let (data, length) = ptr("robot");
    let of = |bank: usize| {
        Answer::<FaceProfile>::from_call(|out| unsafe {
            lipz_face_profile_by_name(Some(&banks[bank]), data, length, out)
        })
        .ok()
    };
    let (own, other) = (of(1), of(0));
    let (mut blinks, mut robots) = (0, 0);
    for us in (0..4_000_000).step_by(40_000) {
        let ask = |profile| {
            Answer::<Face>::from_call(|out| unsafe {
                lipz_layers_face_at_us(array, count, Some(&found), profile, None, us, out)
            })
        };
        let expected = |profile| clip.face_at(Micros(us), &profile, lipz_bank::LookAt::AHEAD).blink.thousandths();
        assert_eq!(ask(None).ok().blink, expected(layers.default_face_profile()));
        assert_eq!(ask(Some(&own)).ok().blink, expected(layers.face_profile("robot").unwrap()));
        assert_eq!(ask(Some(&other)).status, LIPZ_NONE);
        of_amy((array, count), (&clip, &found), us, &layers.default_face_profile());
        blinks += ask(None).ok().blink;
        robots += ask(Some(&own)).ok().blink;
        let seconds = us as f64 / 1e6;
        let all = [
            Answer::<Face>::from_call(|out| unsafe {
                lipz_layers_face_at_samples(array, count, Some(&found), None, None, us, 1_000_000, out)
            }),
            Answer::<Face>::from_call(|out| unsafe {
                lipz_layers_face_at_seconds(array, count, Some(&found), None, None, seconds, out)
            }),
        ];
        assert_eq!(all.map(|face| face.ok().blink), [ask(None).ok().blink; 2]);
    }
    assert!(blinks > 0 && robots == 0, "{blinks} {robots}");
    let nowhere = LayeredClip { layer: 2, ..found };
    let none = Answer::<Face>::from_call(|out| unsafe {
        lipz_layers_face_at_seconds_f32(array, count, Some(&nowhere), None, None, 0.0, out)
    });
    assert_ne!(none.status, LIPZ_OK);
}

/// The face of somebody who listens, in each unit of time, with the profile of the stack.
fn of_amy(
    (array, count): (*const Bank, u32),
    (clip, found): (&lipz_bank::Clip<'_, '_>, &LayeredClip),
    us: i64,
    usual: &lipz_bank::FaceProfile<'_>,
) {
    let (data, length_bytes) = ptr("amy");
    let amy = Who { name: String { data, length_bytes }, is_speaker: 0 };
    let (amy, found, seconds) = (Some(&amy), Some(found), us as f64 / 1e6);
    let short = lipz_bank::Seconds(seconds as f32);
    let of_c = [
        Answer::<Face>::from_call(|out| unsafe {
            lipz_layers_face_of_us(array, count, found, amy, None, None, us, out)
        }),
        Answer::from_call(|out| unsafe {
            lipz_layers_face_of_samples(array, count, found, amy, None, None, us, 1_000_000, out)
        }),
        Answer::from_call(|out| unsafe {
            lipz_layers_face_of_seconds(array, count, found, amy, None, None, seconds, out)
        }),
        Answer::from_call(|out| unsafe {
            lipz_layers_face_of_seconds_f32(array, count, found, amy, None, None, short.0, out)
        }),
    ];
    let numbers = |face: lipz_bank::Face| (face.blink.thousandths(), face.eye_yaw.thousandths());
    let at_us = numbers(clip.face_of("amy", Micros(us), usual, lipz_bank::LookAt::AHEAD));
    let at_short = numbers(clip.face_of("amy", short, usual, lipz_bank::LookAt::AHEAD));
    let found = of_c.map(|face| (face.ok().blink, face.ok().eye_yaw));
    assert_eq!(found, [at_us, at_us, at_us, at_short]);
}

#[test]
fn a_stack_with_dubs_answers_in_each_voice_as_that_of_the_reader() {
    let inputs =
        |files: &[(&str, &str)]| files.iter().map(|(key, file)| Input::from_bytes(*key, *file)).collect::<Vec<_>>();
    let aye = r#"{ "fps": 24, "visemes": "MA-", "text_en-us": "Aye.", "text_de-de": "Ja." }"#;
    let dub = r#"{ "fps": 24, "visemes": "AAA" }"#;
    let voices = Voices::new("en-us").dub("de-at", "at/{key}").dub("de-de", "de/{key}");
    let compiler = Compiler::new(Options::new().default_locale("en-us").strip(true).voices(voices));
    let base = compiler.compile(&inputs(&[("aye", aye), ("no", aye)])).into_bank().unwrap();
    let over = Over::new(Stack::open([("base", &base)]).unwrap());
    let dubbed = inputs(&[("aye", aye), ("de/aye", dub), ("no", aye)]);
    let files = [base, compiler.compile_over(&dubbed, &over).into_bank().unwrap()];
    let banks = files.each_ref().map(|file| opened(file));
    let (array, count) = (banks.as_ptr(), banks.len() as u32);
    let layers =
        Layers::new(files.each_ref().map(|file| lipz_bank::Bank::open(file).unwrap().verify().unwrap())).unwrap();
    let tag_at = |index| Answer::<String>::from_call(|out| unsafe { lipz_layers_voice_at(array, count, index, out) });
    let tags = ["en-us", "de-at", "de-de"];
    assert_eq!([0, 1, 2].map(|index| text_of(tag_at(index).ok())), tags);
    assert_eq!(tag_at(3).status, LIPZ_NONE);
    let mut dubs = 0;
    for (key, tag) in ["aye", "de/aye", "no"].iter().flat_map(|key| tags.map(|tag| (*key, tag))) {
        let clip = layers.clip_by_key(key).unwrap();
        let (data, length) = ptr(tag);
        let voiced = Answer::<LayeredVoicedClip>::from_call(|out| unsafe {
            lipz_layers_clip_in_voice(array, count, clip.id().get(), data, length, out)
        });
        let (voiced, expected) = (voiced.ok(), clip.in_voice(&layers.voice(tag).unwrap()));
        assert_eq!(
            (voiced.clip.clip.id, voiced.clip.layer as usize),
            (expected.clip.id().get(), expected.clip.layer())
        );
        assert_eq!(voiced.spoken, expected.spoken as u32, "{key} in {tag}");
        assert_eq!(Some(voiced.clip.texts_layer as usize), expected.clip.texts_layer());
        assert_eq!(Some(voiced.clip.texts_id), expected.clip.texts().map(|texts| texts.id().get()));
        dubs += voiced.spoken;
        let voice =
            Answer::<String>::from_call(|out| unsafe { lipz_layers_clip_voice(array, count, clip.id().get(), out) });
        assert_eq!(text_of(voice.ok()), clip.voice(&layers).unwrap().tag());
    }
    assert_eq!(dubs, 6, "the dub twice, and twice for the other voice");
    let (data, length) = ptr("it-it");
    let none = Answer::<LayeredVoicedClip>::from_call(|out| unsafe {
        lipz_layers_clip_in_voice(array, count, 1, data, length, out)
    });
    assert_eq!(none.status, LIPZ_NONE);
}

/// What `layers.cpp` prints, by the reader.
#[test]
fn the_expected_answers_of_the_program_in_cpp_are_those_of_the_reader() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/banks/v1");
    let files = ["small", "patch", "dubbed", "redub"].map(|name| {
        let path = folder.join(name).with_extension("lipzbank");
        std::fs::read(path).unwrap()
    });
    let banks = files.each_ref().map(|file| lipz_bank::Bank::open(file).unwrap().verify().unwrap());
    let mut lines = std::string::String::new();
    let stacks = [
        ([banks[0], banks[1]], &["act1/blair", "act2/bare", "act2/no-frames", "patch/new"][..]),
        ([banks[2], banks[3]], &["aye", "no", "de/no"]),
    ];
    for (banks, keys) in stacks {
        let layers = Layers::new(banks).unwrap();
        for key in keys {
            print(&layers, key, &mut lines);
        }
    }
    lines +=
        &format!("another base: status {}\n", Layers::new([banks[0], banks[3]]).unwrap_err().error().kind().number());
    let expected = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/layers.expected");
    if std::env::var_os("LIPZ_BLESS").is_some() {
        std::fs::write(&expected, &lines).unwrap();
    }
    assert_eq!(lines, std::fs::read_to_string(expected).unwrap());
}

/// The lines about a clip.
fn print(layers: &Layers<'_, 2>, key: &str, out: &mut std::string::String) {
    use std::fmt::Write;
    let Some(clip) = layers.clip_by_key(key) else {
        let _ = writeln!(out, "{key}: none");
        return;
    };
    let plays = if lipz_bank::Cursor::new(&clip).is_some() { "plays" } else { "has no frame rate" };
    let _ = writeln!(out, "{}: layer {}, {} frames, {plays}", clip.key(), clip.layer(), clip.frame_count());
    for tag in ["de-de", "en-us", "fr-fr"] {
        let Some(locale) = layers.locale(tag) else { continue };
        for segment in 0..clip.segment_count() {
            let Some(text) = clip.text(segment, &locale) else { continue };
            let mark = if text.is_fallback() { "?" } else { "" };
            let _ = writeln!(out, "  {tag} {segment}{mark}: {text}");
        }
    }
    for voice in layers.voices() {
        let _ = writeln!(out, "  {}: {}", voice.tag(), clip.in_voice(&voice).clip.key());
    }
    let has_profile = layers.face_profile("default").is_some();
    let _ = writeln!(out, "  {} profile", if has_profile { "own" } else { "usual" });
    for (whose, face) in faces(layers, &clip) {
        let [blink, yaw, eye_pitch, eye_yaw] =
            [face.blink, face.head_yaw, face.eye_pitch, face.eye_yaw].map(lipz_bank::CurveValue::thousandths);
        let _ = writeln!(out, "  {whose}: blink {blink}, head {yaw}, eyes {eye_pitch} {eye_yaw}");
    }
    out.push_str("  of another bank: none\n");
}

/// The faces that `layers.cpp` asks for, each in its unit of time.
fn faces(layers: &Layers<'_, 2>, clip: &lipz_bank::Clip<'_, '_>) -> [(&'static str, lipz_bank::Face); 9] {
    use lipz_bank::{CurveValue, LookAt, Samples, Seconds, Who};
    let (us, samples) = (Micros(300_000), Samples { position: 14_400, rate_hz: 48_000 });
    let (seconds, short) = (Seconds(0.3), Seconds(0.3_f32));
    let point = LookAt::point(CurveValue::default(), CurveValue::from_thousandths(5000));
    let (profile, look) = (&layers.default_face_profile(), LookAt::AHEAD);
    [
        ("speaks", clip.face_at(us, profile, look)),
        ("speaks", clip.face_at(samples, profile, look)),
        ("speaks", clip.face_at(seconds, profile, look)),
        ("speaks", clip.face_at(short, profile, point)),
        ("amy", clip.face_of("amy", us, profile, look)),
        ("amy", clip.face_of(Who::SpeakerNamed("amy"), samples, profile, look)),
        ("amy", clip.face_of("amy", seconds, profile, look)),
        ("amy", clip.face_of("amy", short, profile, point)),
        ("idle", profile.idle_at(us, 7, look)),
    ]
}

/// A locale of a patch for which another one stands in, of a bank for which yet another one does: C follows both.
#[test]
fn a_stand_in_has_a_stand_in_below_it() {
    let packed = |locale: &str, text: &str| Input::from_bytes("aye", format!(r#"{{ "text_{locale}": "{text}" }}"#));
    let other = |key: &str, texts: &str| Input::from_bytes(key, format!("{{ {texts} }}"));
    let compiler = |locale: &str| Compiler::new(Options::new().default_locale(locale).strip(true));
    let base = compiler("en-us").compile(&[packed("en-us", "Aye.")]).into_bank().unwrap();
    let over = Over::new(Stack::open([("base", &base)]).unwrap()).keep_others(true);
    let german = other("ja", r#""text_en-us": "Yes.", "text_de-de": "Ja.""#);
    let patch = compiler("en-us").compile_over(&[german], &over).into_bank().unwrap();
    let over = Over::new(Stack::open([("base", &base), ("patch", &patch)]).unwrap()).keep_others(true);
    let austrian = other("jo", r#""text_en-us": "Yep.", "text_de-de": "Jo.", "text_de-at": "Jo eh.""#);
    let addition = compiler("en-us").compile_over(&[austrian], &over).into_bank().unwrap();
    let files = [base, patch, addition];
    let banks = files.each_ref().map(|file| opened(file));
    let read = files.each_ref().map(|file| lipz_bank::Bank::open(file).unwrap().verify().unwrap());
    let layers = Layers::new(read).unwrap();
    let mut stand_ins = 0;
    for tag in ["en-us", "de-de", "de-at"] {
        let locale = layers.locale(tag).unwrap();
        for layer in 0..3 {
            let (data, length) = ptr(tag);
            let found = Answer::<LayeredLocale>::from_call(|out| unsafe {
                lipz_layers_locale(banks.as_ptr(), 3, layer, data, length, out)
            });
            let found = found.some().map(|found| text_of(found.locale.tag));
            assert_eq!(found, locale.tag_in(layer as usize), "{tag} in {layer}");
            stand_ins += usize::from(found.is_some_and(|found| found != tag));
        }
    }
    assert_eq!(stand_ins, 3, "German in the base, Austrian in the base and in the patch");
}
