//! Dialogues of any files.

use super::articulation::{profiles_asked, rig_asked};
use super::clips::clip_asked;
use super::{See, asked, core_utf8, see_bytes, see_dialogue_error, see_error};
use core::mem::MaybeUninit;
use lipz_bank::files::{DialogueError, DialogueFile, Files};
use lipz_bank::{ClipId, Dialogue};

/// The room for files of a dialogue. There may be more contents.
const FILES: usize = 8;

/// Files of a program that opens them on demand.
struct Given<'a>(&'a [DialogueFile<'a>]);

impl Files for Given<'_> {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn file(&self, number: usize) -> Option<&DialogueFile<'_>> {
        self.0.get(number)
    }
}

pub(super) fn dialogues_asked(contents: &[&[u8]], name: &str, number: u32, see: See) {
    let see_opened = |opened: Result<Dialogue<'_>, DialogueError>| match opened {
        Ok(dialogue) => dialogue_asked(&dialogue, name, number, see),
        Err(error) => see_dialogue_error(see, error),
    };
    see_opened(Dialogue::open(&mut [DialogueFile::ABSENT; FILES], contents.iter().copied()));
    see_opened(Dialogue::open_with(&mut [DialogueFile::ABSENT; FILES], contents.iter().copied(), core_utf8));
    see_opened(Dialogue::open_unverified(&mut [DialogueFile::ABSENT; FILES], contents.iter().copied()));
    if let Some(bytes) = contents.first() {
        match Dialogue::open_bank(&mut MaybeUninit::uninit(), bytes) {
            Ok(dialogue) => dialogue_asked(&dialogue, name, number, see),
            Err(error) => see_error(see, error),
        }
    }
    let mut files = [DialogueFile::ABSENT; FILES];
    for at in 0..FILES.min(contents.len()) {
        let opened = contents.get(at).map(|bytes| DialogueFile::open(bytes, at));
        let file = match opened {
            Some(Ok(file)) => file,
            Some(Err(error)) => return see_error(see, error),
            None => DialogueFile::ABSENT,
        };
        let file = match file.verify_in(&files[..], at, core_utf8) {
            Ok(verified) => verified,
            Err(error) => {
                see_error(see, error);
                file
            }
        };
        if let Some(place) = files.get_mut(at) {
            *place = file;
        }
    }
    let files = files.get(..contents.len()).unwrap_or(&files);
    see_opened(Dialogue::new(files));
    see_opened(Dialogue::with_files(&Given(files)));
}

fn dialogue_asked(dialogue: &Dialogue<'_>, name: &str, number: u32, see: See) {
    see(dialogue.clip_count() as u64 ^ u64::from(dialogue.version()));
    see(dialogue.set_index().map_or(0, |index| index.checksum()));
    see(u64::from(dialogue.has_bank()) | dialogue.missing_bank(ClipId::from_key(name)).map_or(0, |at| at as u64) << 1);
    for at in (0..dialogue.file_count()).chain([number as usize]) {
        if let Some(file) = dialogue.file(at) {
            see(file.length_bytes() as u64 ^ file.checksum() ^ file.kind() as u64);
            see(u64::from(file.bank().is_some()) | u64::from(file.set_index().is_some()) << 1);
        }
        if let Some(bank) = dialogue.bank(at) {
            see(bank.checksum());
        }
    }
    let named = dialogue.event_name(name).or_else(|| dialogue.event_name_of_words([number, number >> 3]));
    let mut asked = asked(name, number, named);
    for locale in dialogue.locales().chain(dialogue.locale(name)).chain(dialogue.default_locale()).chain([asked.locale])
    {
        see_bytes(see, dialogue.locale_tag(locale).as_bytes());
        see_bytes(see, dialogue.locale_tag(dialogue.variant(locale, name)).as_bytes());
        locale.to_words().iter().for_each(|word| see(u64::from(*word)));
        asked.locale = dialogue.variant(locale, name);
    }
    for voice in dialogue.voices().chain(dialogue.voice(name)).chain([asked.voice]) {
        see_bytes(see, dialogue.voice_tag(voice).as_bytes());
        voice.to_words().iter().for_each(|word| see(u64::from(*word)));
        asked.voice = voice;
    }
    for babble in dialogue.babbles().chain(dialogue.babble(name)).chain([dialogue.default_babble()]) {
        see_bytes(see, babble.name().as_bytes());
    }
    let profiles = dialogue.face_profiles().chain(dialogue.face_profile(name));
    for profile in profiles.chain([dialogue.default_face_profile()]) {
        see_bytes(see, profile.name().as_bytes());
        asked.profile = profile;
    }
    let named = dialogue.articulations().chain(dialogue.articulation(name));
    let articulation = profiles_asked(named.chain([dialogue.default_articulation()]), see);
    if let Some(clip) = dialogue.clip_by_key(name) {
        let rigs = dialogue.rigs().chain(dialogue.rig(name));
        rigs.for_each(|rig| rig_asked(&rig, &clip, &articulation, number, see));
    }
    let id = ClipId::from_key(name);
    see(dialogue.slot_of_texts(id).map_or(0, |(file, slot)| u64::from(file) << 32 | u64::from(slot)));
    let behind = dialogue.clip_behind(u64::from(number) << 32 | u64::from(number >> 3), name);
    let behind = behind.map(|(clip, position)| {
        see(position);
        clip
    });
    let found = [dialogue.clip(id), dialogue.clip_by_key(name), dialogue.clip_at(number, number >> 3), behind];
    for clip in dialogue.clips().chain(dialogue.clips_under(name)).chain(IntoIterator::into_iter(found).flatten()) {
        clip_asked(&clip, &asked, see);
    }
}
