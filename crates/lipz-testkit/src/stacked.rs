//! Every query of a stack of banks that may be damaged.

use lipz_bank::{Bank, BankSet, BankSetError, ClipId, EventName, Layers, LayersError, SetIndex};
use std::hint::black_box;

/// The most banks that are stacked.
pub const MOST: usize = 4;

/// Makes a stack of banks and asks it everything; whether they fit. Panics only if an iterator gives more than it can have.
pub fn every_query(banks: &[Bank<'_>]) -> bool {
    for bank in banks {
        let limit = bank.length_bytes();
        let Some(layer) = bank.layer() else { continue };
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
        black_box((layer.has_texts_of_original(0), layer.borrows(0, 0), layer.borrows(u32::MAX, usize::MAX)));
        assert!(layer.dub_count() <= limit);
        if let Ok(verified) = bank.verified_layer() {
            assert!(verified.is_some() && layer.removed_clips().all(|id| layer.removes(id) && bank.clip(id).is_none()));
        }
    }
    let layers = match Layers::<MOST>::from_slice(banks) {
        Ok(layers) => layers,
        Err(error) => {
            assert!(error.layer() <= banks.len(), "{error}");
            assert_eq!(LayersError::new(error.layer(), error.error()), error);
            return false;
        }
    };
    if let Ok(same) = <[Bank<'_>; MOST]>::try_from(banks) {
        assert!(Layers::new(same).is_ok());
    }
    assert_eq!(layers.layer_count(), banks.len());
    assert!(layers.bank(banks.len()).is_none() && layers.of_babble().is_some());
    black_box((layers.face_profile("robot"), layers.default_face_profile(), layers.of_faces().is_some()));
    black_box((layers.babble("robot").is_some(), layers.default_babble().name().len()));
    let limit: usize = banks.iter().map(Bank::length_bytes).sum();
    let tags: Vec<&str> = layers.locale_tags().take(limit + 1).collect();
    assert!(tags.len() <= limit);
    let locales: Vec<_> = tags.iter().take(8).filter_map(|tag| layers.locale(tag)).collect();
    black_box(layers.default_locale().and_then(|tag| layers.locale_in(tag, &[])));
    let voices: Vec<&str> = lipz_bank::voice_tags(&layers).take(limit + 1).collect();
    assert!(voices.len() <= limit);
    let named = layers.event_name("amy");
    let mut count = 0;
    for clip in layers.clips().take(limit + 1) {
        count += 1;
        black_box((clip.clip().key(), clip.layer(), layers.clip(clip.id()).is_some()));
        black_box((layers.clip_by_key(clip.key()).is_some(), named.and_then(|name| name.of(&clip)).is_some()));
        assert!(clip.texts_layer().is_none_or(|layer| layers.bank(layer).is_some()));
        black_box((clip.texts().map(|texts| texts.slot()), lipz_bank::original_of(&layers, clip.id())));
        black_box(voices.iter().find_map(|voice| lipz_bank::played_in(&layers, clip.id(), voice)));
        for locale in &locales {
            black_box((locale.tag(), locale.tag_in(clip.layer())));
            for segment in [0, 1, clip.segment_count(), u32::MAX] {
                let (text, bytes) = (clip.text(segment, locale), clip.text_bytes(segment, locale));
                assert!(text.is_none_or(|text| Some(text.as_str().as_bytes()) == bytes));
            }
        }
    }
    assert!(count <= limit && layers.clips_under("act1/").take(limit + 1).count() <= limit);
    true
}

/// Asks these banks everything as a set, whether or not their clips are where they belong; whether they are.
pub fn every_set_query(banks: &[Bank<'_>]) -> bool {
    let set = match BankSet::new(banks) {
        Ok(set) => set,
        Err(error) => {
            assert_eq!((error, banks.is_empty() || banks.len() > 4096), (BankSetError::Count, true));
            return false;
        }
    };
    every_query_of_set(&set);
    match set.verify() {
        Ok(_) => true,
        Err(error) => {
            assert!(matches!(error, BankSetError::OtherShard { bank } if bank < banks.len()), "{error}");
            false
        }
    }
}

/// Asks a set everything, whether or not its clips are where they belong.
pub fn every_query_of_set(set: &BankSet<'_, '_>) {
    let limit: usize = set.banks().iter().map(Bank::length_bytes).sum();
    assert!(set.clip_count() <= limit && set.clips().take(limit + 1).count() <= limit);
    let locale = set.default_locale().or_else(|| set.locale("de-de"));
    let name = set.event_name("amy");
    for clip in set.clips().chain(set.clips_under("act1/")) {
        assert!(set.clip(clip.id()).is_none_or(|found| found.id() == clip.id()));
        assert!(set.clip_by_key(clip.key()).is_none_or(|found| found.key() == clip.key()));
        black_box(set.bank_of(clip.id()).map(Bank::checksum));
        black_box(name.and_then(|name| name.of(&clip)).map(EventName::id));
        let Some(of_clip) = locale.and_then(|locale| locale.of(&clip)) else { continue };
        assert_eq!(locale.map(|locale| locale.tag()), Some(of_clip.tag()));
        black_box(clip.segments().filter_map(|segment| segment.text_bytes(of_clip)).count());
        let voice = set.voice("de-de").filter(|voice| voice.tag() == "de-de").and_then(|voice| voice.of(&clip));
        black_box(voice.map(|voice| clip.in_voice(voice).clip.key()));
    }
}

/// Asks the bytes everything as the index of a set, of these banks or of others; the index, if it passes `verify`.
pub fn every_query_of_index<'data>(bytes: &'data [u8], banks: &[Bank<'data>]) -> Option<SetIndex<'data>> {
    let opened = SetIndex::open(bytes).ok()?;
    let limit = bytes.len();
    assert_eq!(opened.length_bytes(), limit);
    assert!(opened.bank_count() <= limit && opened.moved_count() <= limit);
    assert_eq!(opened.banks().count(), opened.bank_count());
    assert!(opened.bank_at(opened.bank_count()).is_none() && opened.bank_at(0).is_some());
    black_box((opened.fingerprint(), opened.checksum(), opened.clip_count()));
    let ids = ["a", "de/a", "nobody"].map(ClipId::from_key);
    black_box(ids.map(|id| opened.bank_of(id)));
    match BankSet::with_index(banks, &opened) {
        Ok(set) => every_query_of_set(&set),
        Err(BankSetError::OtherBank { bank }) => assert!(bank < banks.len()),
        Err(error) => assert_eq!((error, banks.len() == opened.bank_count()), (BankSetError::Count, false)),
    }
    let verified = opened.verify().ok()?;
    let is_beside = |name: &str| std::path::Path::new(name).file_name().is_some_and(|file| file == name);
    assert!(verified.banks().all(|bank| is_beside(bank.file_name)), "a name leads elsewhere");
    assert!(ids.iter().all(|id| verified.bank_of(*id) < verified.bank_count()));
    Some(verified)
}
