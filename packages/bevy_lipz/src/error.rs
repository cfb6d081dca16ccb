//! The problems that reach the observers of a game.

use crate::BankLoadError;
use bevy::asset::AssetLoadError;
use std::fmt;

/// A problem of a player or of a face.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum LipzError {
    /// The bank did not load: its file is missing or damaged. If an earlier version is loaded, it continues to play.
    Bank {
        /// The reason, such as "the checksum does not match: the file was changed or damaged (bank error 12, at byte
        /// 8)".
        reason: String,
    },
    /// The bank does not contain the clip.
    NoClip {
        /// The key of the clip.
        key: String,
    },
    /// The bank does not contain the language. The player shows the default language.
    NoLocale {
        /// The language of the player.
        tag: String,
        /// The languages of the bank.
        known: Vec<String>,
    },
    /// The bank does not contain the rig that the face names.
    NoRig {
        /// The name of the rig.
        name: String,
    },
    /// None of the model's morph targets has the name of a weight of the bank's rigs, or of a viseme.
    NoShapes {
        /// The names of the morph targets.
        names: Vec<String>,
    },
}

impl LipzError {
    /// Returns the error for a bank that the asset server did not load, in the words of lipz where it has some.
    pub(crate) fn of_load(error: &AssetLoadError) -> LipzError {
        let of_bank = match error {
            AssetLoadError::AssetLoaderError(error) => error.error().downcast_ref::<BankLoadError>(),
            _ => None,
        };
        LipzError::Bank { reason: of_bank.map_or_else(|| error.to_string(), ToString::to_string) }
    }
}

impl fmt::Display for LipzError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LipzError::Bank { reason } => write!(f, "the bank did not load: {reason}"),
            LipzError::NoClip { key } => write!(f, "the bank does not contain the clip {key}"),
            LipzError::NoLocale { tag, known } => {
                write!(f, "the bank does not contain texts in {tag}, only in {}", known.join(", "))
            }
            LipzError::NoRig { name } => {
                write!(f, "the bank does not contain the rig {name}: add it to [rig] in lipz.toml")
            }
            LipzError::NoShapes { names } => write!(
                f,
                "the names of the morph targets ({}) are not in a rig of the bank: add one to [rig] in lipz.toml",
                names.join(", ")
            ),
        }
    }
}

impl std::error::Error for LipzError {}
