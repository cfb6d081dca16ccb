//! The file with the mouths of a shard: JSON, with a hash of itself.

use crate::Kept;
use crate::sync::listed::Listed;
use lipz_compiler::shard::{ContentHash, ShardPlan, WireReport};
use serde::{Deserialize, Serialize};

/// What such a file says that it is.
const FORMAT: &str = "lipz-mouths";
/// The version of its format.
const VERSION: u32 = 1;
/// The version of this library: another one may make other mouths.
const MAKER: &str = env!("CARGO_PKG_VERSION");

/// What a step of lip sync has made of the clips of a shard.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Mouths {
    format: String,
    version: u32,
    lipz: String,
    /// The number of the shard.
    pub shard: u16,
    /// How many shards there are.
    pub shards: u16,
    /// The hash of all that the mouths were made from.
    pub id: ContentHash,
    /// The settings file, if there is one.
    pub settings: Option<String>,
    /// Where the record is, or would be.
    pub record: String,
    /// The hash of the settings and of all that every shard reads.
    pub common: ContentHash,
    pub(super) made: Vec<MadeMouth>,
    /// The keys of the clips whose mouths are what they would become, and their words to look at.
    pub(super) unchanged: Vec<(String, Listed)>,
    pub(super) kept: Vec<(String, Kept)>,
    /// How many clips could not be made.
    pub refused: usize,
    pub(super) reports: Vec<WireReport>,
    /// The hash of the document without this one.
    hash: ContentHash,
}

/// A mouth, and the file that gets it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MadeMouth {
    pub(super) key: String,
    pub(super) lipz_file: String,
    /// The hash of the file before; `None` if there is none.
    pub(super) before: Option<ContentHash>,
    /// The file with the mouth.
    pub(super) after: String,
    /// The recording.
    pub(super) recording: String,
    /// The hash of what the record said of the file and its recordings, if it said something.
    pub(super) known: Option<ContentHash>,
    /// The line of the record.
    pub(super) line: String,
    /// Lines of it about what the recording says, if the mouth is made for other words.
    pub(super) spoken: Vec<String>,
    pub(super) listed: Listed,
    /// Place and text of the TextGrid that is not there yet.
    pub(super) grid: Option<(String, String)>,
    pub(super) has_new_text: bool,
    /// The locale, if its language has no rules.
    pub(super) read_by_letters: Option<String>,
    /// Dubs come after the originals, whose texts they borrow.
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

    /// How many clips have got a mouth.
    pub fn made_count(&self) -> usize {
        self.made.len()
    }

    /// The file.
    pub fn to_json(&self) -> String {
        let hash = self.hash();
        json(&Mouths { hash, ..self.clone() })
    }

    /// The mouths in the bytes of a file.
    ///
    /// # Errors
    /// Why it is not such a file, or not whole.
    pub fn parse(bytes: &[u8]) -> Result<Mouths, String> {
        let mouths: Mouths = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
        if mouths.format != FORMAT || mouths.version != VERSION {
            return Err(format!("it is `{}` of version {}", mouths.format, mouths.version));
        }
        if mouths.lipz != MAKER {
            return Err(format!("it was made by lipz {}, and this is lipz {MAKER}", mouths.lipz));
        }
        if mouths.shard >= mouths.shards {
            return Err(format!("there is no shard {} of {}", mouths.shard, mouths.shards));
        }
        let is_whole = mouths.hash == mouths.hash();
        is_whole.then_some(mouths).ok_or_else(|| "it is damaged, or was changed by hand".to_owned())
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
    // Strings and numbers: there is nothing that JSON does not have.
    let mut text = serde_json::to_string_pretty(mouths).unwrap_or_default();
    text.push('\n');
    text
}
