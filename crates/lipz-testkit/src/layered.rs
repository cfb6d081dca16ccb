//! What a stack answers to every query, as text, and the same of the bank that it stands for.

use crate::answers::{write_curves, write_events, write_faces, write_mouth, write_profile, write_text};
use lipz_bank::{Babble, Bank, CharacterState, Clip, ClipId, Cursor, EventName, FaceProfile, Fps, Layers, Spoken};
use std::fmt::{self, Write};

/// Names that the events of tests mention, and one that none does.
const NAMES: [&str; 4] = ["amy", "door", "sad", "nobody"];

/// Beginnings of keys.
const PREFIXES: [&str; 3] = ["act1/", "de/", "z"];

/// Panics, with what differs, if a stack does not answer as the bank.
pub fn assert_same<const N: usize>(layers: &Layers<'_, N>, whole: &Bank<'_>) {
    let (stack, bank) = (of_layers(layers).expect("a string"), of_bank(whole).expect("a string"));
    for (number, (of_stack, of_bank)) in (1..).zip(stack.lines().zip(bank.lines())) {
        assert_eq!(of_stack, of_bank, "line {number} of\n{stack}");
    }
    assert_eq!(stack, bank);
    // What a layer has and another one removes.
    let all = (0..layers.layer_count()).filter_map(|layer| layers.bank(layer)).flat_map(Bank::clips);
    for id in all.map(|clip| clip.id()).chain([ClipId::from_key("nobody")]) {
        assert_eq!(layers.clip(id).is_some(), whole.clip(id).is_some(), "{id}");
    }
}

fn of_bank(bank: &Bank<'_>) -> Result<String, fmt::Error> {
    let mut said = format!("default locale {:?}\n", bank.default_locale().map(|locale| locale.tag()));
    of_profiles(&mut said, bank, bank.default_babble(), bank.default_face_profile())?;
    for voice in bank.voices() {
        writeln!(said, "voice {} {}", voice.tag(), voice.is_original())?;
    }
    for clip in bank.clips() {
        let found = [bank.clip(clip.id()), bank.clip_by_key(clip.key())];
        assert!(found.into_iter().flatten().all(|found| found.slot() == clip.slot()), "{}", clip.key());
        of_clip(&mut said, &clip, bank)?;
        for locale in bank.locales() {
            clip.segments().try_for_each(|segment| write_text(&mut said, locale.tag(), segment.text(locale)))?;
        }
        for voice in bank.voices() {
            let voiced = clip.in_voice(voice);
            let (voice, original) = (voiced.clip.voice(), voiced.clip.original());
            let voice = voice.map_or("", |voice| voice.tag());
            of_voiced(&mut said, &voiced.clip, voiced.spoken, voice, original.as_ref().map(Clip::key))?;
        }
        of_characters(&mut said, &clip, |name| bank.event_name(name))?;
    }
    for prefix in PREFIXES {
        writeln!(said, "under {prefix} {:?}", bank.clips_under(prefix).map(|clip| clip.id()).collect::<Vec<_>>())?;
    }
    Ok(said)
}

/// The same of a stack.
fn of_layers<const N: usize>(layers: &Layers<'_, N>) -> Result<String, fmt::Error> {
    let default = layers.default_locale();
    assert!(default.is_none_or(|tag| layers.locale(tag).is_some()), "{default:?}");
    let mut said = format!("default locale {default:?}\n");
    assert_eq!(layers.of_babble().map(Bank::default_babble), Some(layers.default_babble()));
    let faces = layers.of_faces().expect("some layer has those that count");
    of_profiles(&mut said, faces, layers.default_babble(), layers.default_face_profile())?;
    for voice in layers.voices() {
        writeln!(said, "voice {} {}", voice.tag(), voice.is_original())?;
    }
    let mut tags: Vec<&str> = layers.locale_tags().collect();
    tags.sort_unstable();
    for clip in layers.clips() {
        assert_eq!([layers.clip(clip.id()), layers.clip_by_key(clip.key())], [Some(clip), Some(clip)]);
        of_clip(&mut said, &clip, faces)?;
        for tag in &tags {
            let locale = layers.locale(tag).expect("it is one of the stack");
            for segment in clip.segments() {
                let text = clip.text(segment.index(), &locale);
                assert_eq!(clip.text_bytes(segment.index(), &locale), text.map(|text| text.as_str().as_bytes()));
                write_text(&mut said, tag, text)?;
            }
        }
        for voice in layers.voices() {
            let voiced = clip.in_voice(&voice);
            let (voice, original) = (voiced.clip.voice(layers), voiced.clip.original(layers));
            let voice = voice.map_or("", |voice| voice.tag());
            of_voiced(&mut said, &voiced.clip, voiced.spoken, voice, original.as_ref().map(|clip| clip.key()))?;
        }
        of_characters(&mut said, &clip, |name| layers.event_name(name).and_then(|name| name.of(&clip)))?;
    }
    for prefix in PREFIXES {
        writeln!(said, "under {prefix} {:?}", layers.clips_under(prefix).map(|clip| clip.id()).collect::<Vec<_>>())?;
    }
    Ok(said)
}

fn of_profiles(said: &mut String, faces: &Bank<'_>, babble: Babble<'_>, face: FaceProfile<'_>) -> fmt::Result {
    writeln!(said, "babble {} {:?} {:?} {:?}", babble.name(), babble.rate(), babble.ooh(), babble.aah())?;
    write_profile(said, &face)?;
    faces.face_profiles().try_for_each(|profile| write_profile(said, &profile))
}

/// What a clip says of itself, with the faces of a bank.
fn of_clip(said: &mut String, clip: &Clip<'_, '_>, faces: &Bank<'_>) -> fmt::Result {
    write_mouth(said, clip)?;
    write_curves(said, clip)?;
    clip.segments().try_for_each(|segment| write_events(said, &segment))?;
    faces.face_profiles().try_for_each(|profile| write_faces(said, clip, &profile))
}

fn of_voiced(
    said: &mut String,
    clip: &Clip<'_, '_>,
    spoken: Spoken,
    voice: &str,
    original: Option<&str>,
) -> fmt::Result {
    writeln!(said, "    {} {spoken:?} {voice:?} of {original:?}, {} frames", clip.key(), clip.frame_count())
}

/// What characters feel and do when the clip is over.
fn of_characters<'data>(
    said: &mut String,
    clip: &Clip<'data, '_>,
    name: impl Fn(&str) -> Option<EventName<'data>>,
) -> fmt::Result {
    let given = clip.or_fps(Fps::whole(24));
    let Some(mut cursor) = Cursor::new(&given) else { return Ok(()) };
    cursor.finish(clip).for_each(drop);
    for who in NAMES {
        let state = name(who).map_or_else(CharacterState::default, |name| cursor.state(clip, Some(name)));
        let names = [state.emotion, state.stares_at, state.points_at].map(|name| name.map(EventName::as_str));
        writeln!(said, "    {who} {names:?}")?;
    }
    Ok(())
}
