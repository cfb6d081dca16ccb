//! Every query of a dialogue whose files may be damaged.

use crate::said;
use lipz_bank::files::{DialogueError, DialogueFile, Files, SetIndex};
use lipz_bank::{Bank, ClipId, Dialogue, EventName, Locale, Voice};
use std::hint::black_box;
use std::mem::MaybeUninit;

/// Makes a dialogue of these files without verifying them, and makes every query. Returns whether the files match.
/// Panics only if an iterator returns more items than possible.
pub fn every_query(contents: &[&[u8]]) -> bool {
    if let [bytes] = contents {
        let mut file = MaybeUninit::uninit();
        let mut files = crate::dialogues::places(1);
        let version = Dialogue::open_unverified(&mut files, [*bytes]).ok().map(|dialogue| dialogue.version());
        let opened = Dialogue::open_bank(&mut file, bytes).ok();
        assert_eq!(opened.as_ref().map(Dialogue::version), version.filter(|_| SetIndex::open(bytes).is_err()));
        opened.iter().for_each(every_query_of);
    }
    let mut files = crate::dialogues::places(contents.len());
    match Dialogue::open_unverified(&mut files, contents.iter().copied()) {
        Ok(dialogue) => {
            every_query_of(&dialogue);
            true
        }
        Err(error) => {
            assert!(error.file() <= contents.len(), "{error}");
            assert_eq!(DialogueError::new(error.file(), error.error()), error);
            false
        }
    }
}

/// Whether these files match, after verifying all of them. If so, makes every query.
pub fn every_query_verified(contents: &[&[u8]]) -> bool {
    let one_by_one = OneByOne::open(contents);
    let version = one_by_one.as_ref().and_then(|files| Some(Dialogue::with_files(files).ok()?.version()));
    let mut files = crate::dialogues::places(contents.len());
    let utf8 = |bytes| std::str::from_utf8(bytes).ok();
    let opened = Dialogue::open_with(&mut files, contents.iter().copied(), utf8);
    let Ok(dialogue) = opened else {
        assert!(version.is_none(), "verified one by one, the files fit");
        return false;
    };
    assert_eq!(version, Some(dialogue.version()));
    every_query_of(&dialogue);
    true
}

/// Files that a program opens and verifies one at a time.
struct OneByOne<'data>(Vec<DialogueFile<'data>>);

impl<'data> OneByOne<'data> {
    /// Empty bytes stand for a missing file.
    fn open(contents: &[&'data [u8]]) -> Option<OneByOne<'data>> {
        let mut files = Vec::new();
        for (number, bytes) in contents.iter().enumerate() {
            let file = if bytes.is_empty() { DialogueFile::ABSENT } else { DialogueFile::open(bytes, number).ok()? };
            let index = file.set_index().map(SetIndex::bank_count);
            assert!(index.is_none_or(|count| count > 0) && file.length_bytes() == bytes.len());
            files.push(file.verify_in(files.as_slice(), number, |bytes| std::str::from_utf8(bytes).ok()).ok()?);
        }
        Some(OneByOne(files))
    }
}

impl Files for OneByOne<'_> {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn file(&self, number: usize) -> Option<&DialogueFile<'_>> {
        self.0.get(number)
    }
}

/// Makes every query of a patch's description of the banks below it.
fn every_query_of_layer(bank: &Bank<'_>) {
    let limit = bank.length_bytes();
    let Some(layer) = bank.layer() else { return };
    let counts = [layer.made_over().count(), layer.removed_clips().count(), layer.removed_locales().count()];
    assert!(counts.iter().sum::<usize>() <= limit, "{layer:?}");
    black_box((
        layer.may_have(ClipId::from_u64(1)),
        layer.removes(ClipId::from_u64(1)),
        layer.removes_locale("de-de"),
        layer.stand_in(0),
    ));
    black_box((layer.parts(0), layer.parts(u32::MAX), layer.has_babble(), layer.has_default_locale()));
    black_box((layer.has_faces(), layer.has_voices(), layer.voices().count()));
    black_box((layer.has_articulation(), layer.has_rigs()));
    black_box((layer.has_texts_of_original(0), layer.borrows(0, 0), layer.borrows(u32::MAX, usize::MAX)));
    assert!(layer.dub_count() <= limit);
    if let Ok(verified) = bank.verified_layer() {
        assert!(verified.is_some() && layer.removed_clips().all(|id| layer.removes(id) && bank.clip(id).is_none()));
    }
}

/// Makes every query of a dialogue.
pub fn every_query_of(dialogue: &Dialogue<'_>) {
    let banks = || (0..dialogue.file_count()).filter_map(|number| dialogue.bank(number));
    banks().for_each(every_query_of_layer);
    let limit: usize = banks().map(Bank::length_bytes).sum();
    assert!(dialogue.bank(usize::MAX).is_none() && dialogue.clip_at(u32::MAX, 0).is_none());
    black_box((dialogue.face_profile("robot"), dialogue.default_face_profile()));
    let missing = dialogue.missing_bank(ClipId::from_key("robot"));
    assert!(missing.is_none_or(|number| dialogue.bank(number).is_none()));
    let mut base = dialogue.set_index().map_or(0..1, |index| 1..index.bank_count() + 1);
    assert_eq!(dialogue.has_bank(), base.any(|number| dialogue.bank(number).is_some()));
    black_box((dialogue.babble("robot").is_some(), dialogue.default_babble().name().len()));
    assert!(
        dialogue.babbles().take(limit + 1).count() <= limit
            && dialogue.face_profiles().take(limit + 1).count() <= limit
    );
    let locales: Vec<Locale> = dialogue.locales().take(8).collect();
    for locale in &locales {
        assert_eq!(Locale::from_words(locale.to_words()), *locale);
        black_box(dialogue.locale(dialogue.locale_tag(*locale)).is_some());
        for key in said::VARIANTS {
            let variant = dialogue.variant(*locale, key);
            assert!(variant == *locale || dialogue.locale_tag(variant).contains("-x-"));
        }
    }
    let foreign = [Locale::from_words([1, u32::MAX]), Locale::from_words([u32::MAX, 0])];
    assert!(foreign.iter().all(|locale| dialogue.locale_tag(*locale).is_empty()));
    black_box(dialogue.default_locale().map(|locale| dialogue.locale_tag(locale)));
    black_box(foreign.map(|locale| dialogue.variant(locale, "few-fem")));
    let voices: Vec<Voice> = dialogue.voices().take(8).collect();
    for voice in &voices {
        assert_eq!(Voice::from_words(voice.to_words()), *voice);
        black_box(dialogue.voice(dialogue.voice_tag(*voice)));
    }
    let name = dialogue.event_name("amy");
    assert_eq!(name.and_then(|name| dialogue.event_name_of_words(name.to_words())), name);
    assert_eq!(dialogue.event_name_of_words([u32::MAX; 2]).map(EventName::as_str), None);
    let (mut count, mut position) = (0, 0);
    for clip in dialogue.clips().take(limit + 1) {
        count += 1;
        let walked = dialogue.clip_behind(position, "").expect("as many clips");
        assert!(walked.0 == clip && walked.1 > position);
        position = walked.1;
        black_box((clip.key(), dialogue.clip_at(clip.file(), clip.slot()).is_some()));
        let of_texts = dialogue.slot_of_texts(clip.id());
        assert!(of_texts.is_none_or(|(file, slot)| dialogue.clip_at(file, slot).is_some()));
        black_box((dialogue.clip_by_key(clip.key()).is_some(), clip.voice(), clip.original().is_some()));
        for voice in voices.iter().chain([&Voice::from_words([u32::MAX; 2])]) {
            black_box(clip.in_voice(*voice).clip.key());
        }
        for locale in locales.iter().chain(&foreign) {
            for segment in clip.segments().take(3) {
                let (text, bytes) = (segment.text(*locale), segment.text_bytes(*locale));
                assert!(text.is_none_or(|text| Some(text.as_str().as_bytes()) == bytes));
                black_box(segment.has_own_text(*locale));
            }
        }
        black_box(clip.segments().flat_map(|segment| segment.events()).filter(|event| event.character == name).count());
    }
    assert!(count <= limit && dialogue.clips_under("act1/").take(limit + 1).count() <= limit);
    black_box(dialogue.clip_behind(u64::MAX, "").is_some());
}

/// Makes every query of the bytes as the index of a set, with matching or other banks. Returns the index, if it passes
/// `verify`.
pub fn every_query_of_index<'data>(bytes: &'data [u8], banks: &[&'data [u8]]) -> Option<SetIndex<'data>> {
    let opened = SetIndex::open(bytes).ok()?;
    let limit = bytes.len();
    assert_eq!(opened.length_bytes(), limit);
    assert!(opened.bank_count() <= limit && opened.moved_count() <= limit);
    assert_eq!(opened.banks().count(), opened.bank_count());
    assert!(opened.bank_at(opened.bank_count()).is_none() && opened.bank_at(0).is_some());
    black_box((opened.fingerprint(), opened.checksum(), opened.clip_count()));
    for (number, bank) in banks.iter().enumerate().filter_map(|(number, bytes)| Some((number, Bank::open(bytes).ok()?)))
    {
        let is_named = opened.bank_at(number).is_some_and(|named| named.is_of(&bank));
        assert!(opened.check_bank(number, &bank).is_ok() == is_named);
        assert!(is_named || opened.verify_bank(number, &bank).is_err());
    }
    let ids = ["a", "de/a", "nobody"].map(ClipId::from_key);
    black_box(ids.map(|id| opened.bank_of(id)));
    let contents: Vec<&[u8]> = [bytes].into_iter().chain(banks.iter().copied()).collect();
    let fits = every_query(&contents);
    assert!(!fits || banks.len() >= opened.bank_count());
    // Without its banks, a set has no clips.
    let absent: Vec<&[u8]> = [bytes].into_iter().chain((0..opened.bank_count()).map(|_| &[][..])).collect();
    assert!(every_query(&absent));
    let verified = opened.verify().ok()?;
    let is_beside = |name: &str| std::path::Path::new(name).file_name().is_some_and(|file| file == name);
    assert!(verified.banks().all(|bank| is_beside(bank.file_name)), "a name leads elsewhere");
    assert!(ids.iter().all(|id| verified.bank_of(*id) < verified.bank_count()));
    Some(verified)
}
