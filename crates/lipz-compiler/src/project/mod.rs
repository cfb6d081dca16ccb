//! The settings of a project for its Lipz files, in `lipz.toml` and in options.

pub mod articulation;
pub mod babble;
pub(crate) mod depend;
pub mod face;
pub(crate) mod options;
pub(crate) mod pseudo_locale;
pub mod rigs;
pub mod settings;
mod voices;
mod word_times;

pub use depend::{dependencies, depfile, watched};
pub use options::{
    EmotionCurves, EmotionOptions, FileLevels, GestureKeys, Gestures, KnownNames, LocaleError, MinCoverage, Options,
    TextLimits,
};
pub use voices::{VoiceError, Voices};
pub use word_times::{ParseWordTimesError, WordTime, WordTimes};
