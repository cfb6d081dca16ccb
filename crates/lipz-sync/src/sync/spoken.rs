//! What recordings say: the text that each was made for, whatever its mouth was made from since.

use super::record::{Line, OriginalThen, parse_hash};

/// What a line says before the hashes of a recording and its text.
const SPOKEN: &str = "spoken:";

/// The text that a recording was made for: somebody has accepted that it says it, or its first mouth was made from it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Spoken {
    /// All bytes of the recording.
    pub sound: u64,
    /// The text that is said in it.
    pub text: u64,
    /// What the original was then, if it is the recording of a dub.
    pub original: Option<OriginalThen>,
}

impl Spoken {
    /// The same text, and of a dub the same original: the recording says what it has to say now.
    pub(crate) fn is_still(&self, now: &Spoken) -> bool {
        self.text == now.text && self.is_of_original(now)
    }

    /// Whether its original was what it is now, as far as that is known.
    fn is_of_original(&self, now: &Spoken) -> bool {
        match (self.original, now.original) {
            (Some(then), Some(now)) => then.is_recorded_as(&now) && then.text == now.text,
            _ => true,
        }
    }

    /// As it would be written today, if the recording says `text` and its original `of_original`.
    pub(crate) fn renewed(self, text: Option<&str>, of_original: Option<&str>) -> Spoken {
        let original = self.original.map(|original| original.renewed(of_original));
        Spoken { text: super::hashes::renewed(self.text, text), original, ..self }
    }

    pub(crate) fn written(&self, file: &str) -> String {
        let Spoken { sound, text, original } = self;
        format!("{SPOKEN}{sound:016x},{text:016x} {}{file}", OriginalThen::written(*original))
    }

    pub(crate) fn parse(line: &str) -> Option<(Spoken, &str)> {
        let (hashes, rest) = line.strip_prefix(SPOKEN)?.split_once(' ')?;
        let (sound, text) = hashes.split_once(',')?;
        let (original, file) = OriginalThen::take(rest)?;
        let spoken = Spoken { sound: parse_hash(sound)?, text: parse_hash(text)?, original };
        (!file.is_empty()).then_some((spoken, file))
    }
}

/// What the recording says that a mouth was made from, as far as nothing else is known.
impl From<&Line> for Spoken {
    fn from(line: &Line) -> Spoken {
        Spoken { sound: line.made.sound, text: line.made.text, original: line.original }
    }
}
