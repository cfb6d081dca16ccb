//! The dispositions of heads towards the player, and the emotions of events that they show.

use std::fmt;

/// The disposition of a head towards the player.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Disposition {
    /// Letter `g`.
    Good,
    /// Letter `n`.
    Neutral,
    /// Letter `b`.
    Bad,
}

impl Disposition {
    /// All dispositions, in the order of `heads.lst`.
    pub const ALL: [Disposition; 3] = [Disposition::Good, Disposition::Neutral, Disposition::Bad];

    /// Returns the letter in the names of files.
    pub const fn letter(self) -> char {
        match self {
            Disposition::Good => 'g',
            Disposition::Neutral => 'n',
            Disposition::Bad => 'b',
        }
    }

    /// Returns the disposition with this letter, in either case.
    pub fn of_letter(letter: char) -> Option<Disposition> {
        Disposition::ALL.into_iter().find(|disposition| disposition.letter().eq_ignore_ascii_case(&letter))
    }

    /// Returns the emotions that heads show with this disposition (the event `feels happy`). The first one stands for
    /// the disposition itself.
    pub const fn emotions(self) -> &'static [&'static str] {
        match self {
            Disposition::Good => &["happy", "amused"],
            Disposition::Neutral => &["neutral", "confused", "thinking"],
            Disposition::Bad => &["angry", "irritated", "sad", "suspicious", "afraid", "evil"],
        }
    }

    /// Returns the emotion that stands for the disposition.
    pub const fn emotion(self) -> &'static str {
        match self {
            Disposition::Good => "happy",
            Disposition::Neutral => "neutral",
            Disposition::Bad => "angry",
        }
    }

    /// Returns the disposition that shows an emotion of the specification.
    ///
    /// ```
    /// use lipz_interop::fallout::heads::Disposition;
    /// assert_eq!(Disposition::of_emotion("amused"), Some(Disposition::Good));
    /// assert_eq!(Disposition::of_emotion("nervous"), None);
    /// ```
    pub fn of_emotion(emotion: &str) -> Option<Disposition> {
        Disposition::ALL.into_iter().find(|disposition| disposition.emotions().contains(&emotion))
    }
}

impl fmt::Display for Disposition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Disposition::Good => "good",
            Disposition::Neutral => "neutral",
            Disposition::Bad => "bad",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_emotion_of_the_specification_has_a_disposition() {
        for emotion in lipz_file::event::EMOTIONS {
            let with_it = Disposition::ALL.into_iter().filter(|known| known.emotions().contains(&emotion));
            assert_eq!(with_it.count(), 1, "{emotion}");
        }
    }

    #[test]
    fn there_and_back() {
        for disposition in Disposition::ALL {
            assert_eq!(Disposition::of_emotion(disposition.emotion()), Some(disposition));
            assert_eq!(Disposition::of_letter(disposition.letter()), Some(disposition));
        }
    }
}
