//! The attributes of emotion of "Talking Heads: Facial Animation in The Getaway" (Gavin Moore, 2001).

/// One of the twelve attributes of a face's emotion. Each has a value from 0 to 10; they are added.
///
/// ```
/// use lipz_types::Emotion;
/// assert_eq!(Emotion::Anger.name(), "anger");
/// assert_eq!(Emotion::from_name("joy"), Some(Emotion::Joy));
/// assert_eq!(Emotion::from_name("happy"), None); // a preset, which tools convert to attributes
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[repr(u8)]
pub enum Emotion {
    /// `sadness`: at 10, crying with an open mouth.
    Sadness,
    /// `anger`: at 2, a slight sneer.
    Anger,
    /// `joy`.
    Joy,
    /// `fear`: in small amounts, worry.
    Fear,
    /// `disgust`: in small amounts, disdain.
    Disgust,
    /// `surprise`.
    Surprise,
    /// `shock`.
    Shock,
    /// `perplexed`.
    Perplexed,
    /// `asleep`.
    Asleep,
    /// `pain`.
    Pain,
    /// `exertion`.
    Exertion,
    /// `shout`.
    Shout,
}

impl Emotion {
    /// All attributes, in the order of the source.
    pub const ALL: [Emotion; 12] = [
        Emotion::Sadness,
        Emotion::Anger,
        Emotion::Joy,
        Emotion::Fear,
        Emotion::Disgust,
        Emotion::Surprise,
        Emotion::Shock,
        Emotion::Perplexed,
        Emotion::Asleep,
        Emotion::Pain,
        Emotion::Exertion,
        Emotion::Shout,
    ];

    /// Returns the name of the attribute and of its curve.
    pub const fn name(self) -> &'static str {
        match self {
            Emotion::Sadness => "sadness",
            Emotion::Anger => "anger",
            Emotion::Joy => "joy",
            Emotion::Fear => "fear",
            Emotion::Disgust => "disgust",
            Emotion::Surprise => "surprise",
            Emotion::Shock => "shock",
            Emotion::Perplexed => "perplexed",
            Emotion::Asleep => "asleep",
            Emotion::Pain => "pain",
            Emotion::Exertion => "exertion",
            Emotion::Shout => "shout",
        }
    }

    /// Returns the attribute with this name.
    pub fn from_name(name: &str) -> Option<Emotion> {
        Emotion::ALL.iter().copied().find(|emotion| emotion.name() == name)
    }
}
