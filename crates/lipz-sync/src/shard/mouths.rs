//! The file with the visemes of a shard: JSON, with a hash of its content.

use crate::job::outcome::KeepReason;
use crate::job::review_list::ReviewList;
use lipz_compiler::shard::{ContentHash, ShardPlan, WireReport};
use serde::{Deserialize, Serialize};

/// The name of the format in the file.
const FORMAT: &str = "lipz-mouths";
/// The version of its format.
const VERSION: u32 = 1;
/// The version of this crate, because different versions may produce different visemes.
const MAKER: &str = env!("CARGO_PKG_VERSION");

/// The result of a lip-sync step for the clips of a shard.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Mouths {
    format: String,
    version: u32,
    lipz: String,
    /// The number of the shard.
    pub shard: u16,
    /// The number of shards.
    pub shards: u16,
    /// The hash of everything from which the visemes were made.
    pub id: ContentHash,
    /// The settings file, if there is one.
    pub settings: Option<String>,
    /// The path of the record, which may not exist.
    pub record: String,
    /// The hash of the settings and of everything that all shards read.
    pub common: ContentHash,
    pub(super) made: Vec<MadeMouth>,
    /// The keys of the clips whose visemes are up to date, and their words to check.
    pub(super) unchanged: Vec<(String, ReviewList)>,
    pub(super) kept: Vec<KeptMouth>,
    /// The number of clips with errors.
    pub refused: usize,
    pub(super) reports: Vec<WireReport>,
    /// The hash of the document without this field.
    hash: ContentHash,
}

/// A clip whose visemes stay.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct KeptMouth {
    pub(super) key: String,
    pub(super) reason: KeepReason,
    /// The new times of its words, if the record lacked some.
    pub(super) words: Option<KeptWords>,
}

/// The times of words, for the record.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct KeptWords {
    pub(super) lipz_file: String,
    /// The hash of the bytes of the recording.
    pub(super) sound: u64,
    pub(super) words: String,
}

/// Visemes, and the file that gets them.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MadeMouth {
    pub(super) key: String,
    pub(super) lipz_file: String,
    /// The hash of the old file; `None` if it does not exist.
    pub(super) before: Option<ContentHash>,
    /// The file with the visemes.
    pub(super) after: String,
    /// The recording.
    pub(super) recording: String,
    /// The hash of the record's lines about the file and its recordings, if it had any.
    pub(super) known: Option<ContentHash>,
    /// The line of the record.
    pub(super) line: String,
    /// The lines about the recording's text, if it differs from that of the visemes.
    pub(super) spoken: Vec<String>,
    pub(super) listed: ReviewList,
    /// The path and the text of the missing TextGrid.
    pub(super) grid: Option<(String, String)>,
    pub(super) has_new_text: bool,
    /// The locale, if its language has no rules.
    pub(super) read_by_letters: Option<String>,
    /// Whether the clip is a dub. Dubs come after the originals, whose texts they borrow.
    pub(super) is_dub: bool,
}

impl Mouths {
    pub(super) fn new(plan: &ShardPlan) -> Mouths {
        Mouths {
            format: FORMAT.to_owned(),
            version: VERSION,
            lipz: MAKER.to_owned(),
            shard: plan.shard,
            shards: plan.shards,
            id: plan.id,
            settings: plan.settings.as_ref().map(|file| file.path.clone()),
            record: plan.record.clone(),
            common: common(plan),
            made: Vec::new(),
            unchanged: Vec::new(),
            kept: Vec::new(),
            refused: 0,
            reports: Vec::new(),
            hash: ContentHash::of(&[]),
        }
    }

    /// Returns the number of clips with new visemes.
    pub fn made_count(&self) -> usize {
        self.made.len()
    }

    /// Returns the file.
    pub fn to_json(&self) -> String {
        let hash = self.hash();
        json(&Mouths { hash, ..self.clone() })
    }

    /// Parses the bytes of a file.
    ///
    /// # Errors
    /// The reason why it is not such a file, or is damaged.
    pub fn parse(bytes: &[u8]) -> Result<Mouths, String> {
        let mouths: Mouths = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
        if mouths.format != FORMAT || mouths.version != VERSION {
            return Err(format!("its format is `{}` version {}", mouths.format, mouths.version));
        }
        if mouths.lipz != MAKER {
            return Err(format!("it was made by lipz {}, but this is lipz {MAKER}", mouths.lipz));
        }
        if mouths.shard >= mouths.shards {
            return Err(format!("shard {} of {} does not exist", mouths.shard, mouths.shards));
        }
        let is_whole = mouths.hash == mouths.hash();
        is_whole.then_some(mouths).ok_or_else(|| "it is damaged, or was edited".to_owned())
    }

    fn hash(&self) -> ContentHash {
        ContentHash::of(json(&Mouths { hash: ContentHash::of(&[]), ..self.clone() }).as_bytes())
    }
}

fn common(plan: &ShardPlan) -> ContentHash {
    let files = plan.settings.iter().chain(&plan.common).map(|file| format!("{} {}\n", file.hash, file.path));
    ContentHash::of(files.collect::<String>().as_bytes())
}

fn json(mouths: &Mouths) -> String {
    // Serialising strings and numbers cannot fail.
    let mut text = serde_json::to_string_pretty(mouths).unwrap_or_default();
    text.push('\n');
    text
}
