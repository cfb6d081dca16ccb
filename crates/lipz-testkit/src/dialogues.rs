//! The answers of a dialogue of several files to every query, as text, and the same for the equivalent bank.

use crate::answers::{write_curves, write_events, write_faces, write_mouth, write_profile, write_text};
use lipz_bank::files::DialogueFile;
use lipz_bank::playback::CharacterState;
use lipz_bank::{Bank, Clip, ClipId, Cursor, Dialogue, EventName, Fps};
use std::fmt::{self, Write};

/// Names in the events of tests, and one that is in no event.
const NAMES: [&str; 4] = ["amy", "door", "sad", "nobody"];

/// Prefixes of keys.
const PREFIXES: [&str; 3] = ["act1/", "de/", "z"];

/// Returns places for this many files.
pub fn places<'data>(count: usize) -> Vec<DialogueFile<'data>> {
    vec![DialogueFile::ABSENT; count]
}

/// Opens and verifies files as a dialogue of this name.
#[macro_export]
macro_rules! dialogue {
    ($name:ident = $($bytes:expr),+ $(,)?) => {
        let contents: &[&[u8]] = &[$($bytes),+];
        let mut files = $crate::dialogues::places(contents.len());
        let $name = ::lipz_bank::Dialogue::open(&mut files, contents.iter().copied()).unwrap();
    };
}

/// Returns the result of `look` for the dialogue of these files, all of them verified.
pub fn with<T>(contents: &[&[u8]], look: impl FnOnce(&Dialogue<'_>) -> T) -> T {
    let mut files = places(contents.len());
    look(&Dialogue::open(&mut files, contents.iter().copied()).expect("files that fit"))
}

/// Panics with the difference if a dialogue and a bank return different answers.
pub fn assert_same(dialogue: &Dialogue<'_>, whole: &Bank<'_>) {
    let said = (of_dialogue(dialogue, whole), of_bank(whole, whole));
    let (several, bank) = (said.0.expect("a string"), said.1.expect("a string"));
    for (number, (several, bank)) in (1..).zip(several.lines().zip(bank.lines())) {
        assert_eq!(several, bank, "line {number}");
    }
    assert_eq!(several, bank);
    assert_eq!(dialogue.clip_count(), whole.clip_count());
    // Includes names in a file that another file removes.
    let banks = (0..dialogue.file_count()).filter_map(|number| dialogue.bank(number));
    for id in banks.flat_map(Bank::clips).map(|clip| clip.id()).chain([ClipId::from_key("nobody")]) {
        assert_eq!(dialogue.clip(id).is_some(), whole.clip(id).is_some(), "{id}");
    }
}

/// A function that writes the answers of a bank or of a dialogue, with the same queries. It queries the names of the
/// whole bank, because a dialogue also has those of events that a patch replaces.
macro_rules! answers {
    ($name:ident($asked:ident: $type:ty)) => {
        fn $name($asked: $type, whole: &Bank<'_>) -> Result<String, fmt::Error> {
            let default = $asked.default_locale().map(|locale| $asked.locale_tag(locale));
            let mut said = format!("default locale {default:?}\n");
            let babble = $asked.default_babble();
            writeln!(said, "babble {} {:?} {:?} {:?}", babble.name(), babble.rate(), babble.ooh(), babble.aah())?;
            $asked.babbles().try_for_each(|babble| writeln!(said, "babble {babble:?}"))?;
            write_profile(&mut said, &$asked.default_face_profile())?;
            $asked.face_profiles().try_for_each(|profile| write_profile(&mut said, &profile))?;
            for voice in $asked.voices() {
                assert_eq!($asked.voice($asked.voice_tag(voice)), Some(voice));
                writeln!(said, "voice {} {}", $asked.voice_tag(voice), voice.is_original())?;
            }
            let mut locales: Vec<_> = $asked.locales().map(|locale| ($asked.locale_tag(locale), locale)).collect();
            locales.sort_unstable_by_key(|(tag, _)| *tag);
            let mut clips: Vec<Clip<'_>> = $asked.clips().collect();
            clips.sort_unstable_by_key(Clip::key);
            for clip in clips {
                assert_eq!([$asked.clip(clip.id()), $asked.clip_by_key(clip.key())], [Some(clip); 2], "{clip:?}");
                write_mouth(&mut said, &clip)?;
                write_curves(&mut said, &clip)?;
                clip.segments().try_for_each(|segment| write_events(&mut said, &segment))?;
                $asked.face_profiles().try_for_each(|profile| write_faces(&mut said, &clip, &profile))?;
                for (tag, locale) in &locales {
                    assert_eq!($asked.locale(tag), Some(*locale));
                    for segment in clip.segments() {
                        let text = segment.text(*locale);
                        assert_eq!(segment.text_bytes(*locale), text.map(|text| text.as_str().as_bytes()));
                        assert_eq!(segment.has_own_text(*locale), text.is_some_and(|text| !text.is_fallback()));
                        write_text(&mut said, tag, text)?;
                    }
                }
                for voice in $asked.voices() {
                    let voiced = clip.in_voice(voice);
                    let of_clip = voiced.clip.voice().map_or("", |voice| $asked.voice_tag(voice));
                    let original = voiced.clip.original();
                    let original = original.as_ref().map(Clip::key);
                    write!(said, "    {} {:?}", voiced.clip.key(), voiced.spoken)?;
                    writeln!(said, " {of_clip:?} of {original:?}, {} frames", voiced.clip.frame_count())?;
                }
                let known = |name: &str| whole.event_name(name).map(|_| $asked.event_name(name).expect("a name"));
                of_characters(&mut said, &clip, known)?;
            }
            for prefix in PREFIXES {
                let mut under: Vec<_> = $asked.clips_under(prefix).map(|clip| clip.id()).collect();
                under.sort_unstable();
                writeln!(said, "under {prefix} {under:?}")?;
            }
            Ok(said)
        }
    };
}

answers!(of_bank(asked: &Bank<'_>));
answers!(of_dialogue(asked: &Dialogue<'_>));

/// Writes the state of characters at the end of the clip, and the events fired on the way.
fn of_characters<'d>(said: &mut String, clip: &Clip<'d>, name: impl Fn(&str) -> Option<EventName<'d>>) -> fmt::Result {
    let given = clip.or_fps(Fps::whole(24));
    let Some(cursor) = Cursor::new(&given) else { return Ok(()) };
    let mut cursor = cursor.with_speaker(name("amy"));
    for event in cursor.finish(clip).events() {
        writeln!(said, "    {event}")?;
    }
    for who in NAMES {
        let state = name(who).map_or_else(CharacterState::default, |name| cursor.state(clip, Some(name)));
        let names = [state.emotion, state.stares_at, state.points_at].map(|name| name.map(EventName::as_str));
        writeln!(said, "    {who} {names:?}")?;
    }
    Ok(())
}
