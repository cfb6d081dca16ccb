//! Plans: the shards of a project, and the inputs of each of them.

use super::hash::Fields;
use super::{ContentHash, MOUTHS_EXTENSION, OBJECT_EXTENSION, shard_of};
use crate::files::path::display;
use crate::project::Voices;
use crate::sources::{Content, Input};
use crate::util::parallel;
use lipz_bank::ClipId;
use lipz_diagnostics::{Code, Diagnostic, Report};
use serde::{Deserialize, Serialize};
use std::num::NonZero;
use std::path::{Path, PathBuf};

/// The format name in a plan.
pub(super) const FORMAT: &str = "lipz-plan";
/// The format name in the plan of a shard.
pub(super) const SHARD_FORMAT: &str = "lipz-shard-plan";
/// The version of both formats. A plan also contains the version of this library, because the results of steps may
/// change with it.
pub(super) const VERSION: u32 = 1;
/// The version of this library.
pub(super) const MAKER: &str = env!("CARGO_PKG_VERSION");

/// The shards of a project. The files of each are in a separate [`ShardPlan`], so that a step reads only its own part.
/// `docs/guides/many-machines.md` describes the JSON of both.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Plan {
    pub(super) format: String,
    pub(super) version: u32,
    /// The version of lipz that made the plan, which must also make the objects.
    pub lipz: String,
    /// The kind of its steps.
    #[serde(default, skip_serializing_if = "Step::is_pack")]
    pub step: Step,
    /// The arguments of lipz that make the plan again.
    pub made_by: Vec<String>,
    /// The bank that the objects are linked to; in a lip-sync plan, the file that indicates to engines that the visemes
    /// have been merged into the Lipz files.
    pub makes: String,
    /// The shards in order. Shard 0 has the clips with the lowest ids.
    pub shards: Vec<PlannedShard>,
}

/// The kind of a plan's steps.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Step {
    /// Each packs an object.
    #[default]
    Pack,
    /// Each makes visemes from recordings.
    Sync,
}

impl Step {
    #[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks so")]
    fn is_pack(&self) -> bool {
        *self == Step::Pack
    }

    /// Returns the extension of its results, without a dot.
    pub fn extension(self) -> &'static str {
        match self {
            Step::Pack => OBJECT_EXTENSION,
            Step::Sync => MOUTHS_EXTENSION,
        }
    }
}

/// A shard in a plan, with the result of its step.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct PlannedShard {
    /// Its number.
    pub shard: u16,
    /// The hash of all inputs, which names the result in a store.
    pub id: ContentHash,
    /// The number of clips.
    pub clips: usize,
    /// The file of its [`ShardPlan`], relative to the folder of the plan.
    pub needs: String,
    /// The result of the step.
    pub makes: String,
}

/// The inputs of a shard: files, with the hashes of their contents.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ShardPlan {
    pub(super) format: String,
    pub(super) version: u32,
    /// The version of lipz that made the plan.
    pub lipz: String,
    /// The kind of the step.
    #[serde(default, skip_serializing_if = "Step::is_pack")]
    pub step: Step,
    /// The number of the shard.
    pub shard: u16,
    /// The number of shards.
    pub shards: u16,
    /// The hash of all other fields.
    pub id: ContentHash,
    /// The settings file, if there is one.
    pub settings: Option<PlannedFile>,
    /// The path of the sync record, which may not exist. Only its entries about these clips matter.
    pub record: String,
    /// Other inputs of all shards.
    pub common: Vec<PlannedFile>,
    /// The Lipz files in the order of their keys.
    pub(super) inputs: Vec<PlannedInput>,
}

/// A file that a step reads.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct PlannedFile {
    /// Its path relative to the folder in which the plan was made, with `/`.
    pub path: String,
    /// The hash of its contents.
    pub hash: ContentHash,
}

/// A Lipz file, and the other inputs of its clip.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlannedInput {
    pub(super) key: String,
    /// The line of the clip, if it differs from its key. It determines the shard.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(super) line: Option<String>,
    pub(super) path: String,
    pub(super) hash: ContentHash,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(super) recording: Option<PlannedFile>,
    /// The hash of its entry in the sync record, if there is one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(super) record: Option<ContentHash>,
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub(super) beside: Vec<PlannedFile>,
}

/// The inputs of a clip besides its Lipz file.
#[derive(Clone, Debug, Default)]
pub struct ExtraInputs {
    /// Its recording.
    pub recording: Option<PathBuf>,
    /// The hash of its entry in the sync record, if there is one.
    pub record: Option<ContentHash>,
    /// All other files.
    pub files: Vec<PathBuf>,
}

/// The common inputs of all shards of a project.
#[derive(Clone, Copy, Debug)]
pub struct CommonInputs<'p> {
    /// The settings file, if there is one.
    pub settings: Option<&'p Path>,
    /// The path of the sync record, which may not exist.
    pub record: &'p Path,
    /// Other inputs of all shards.
    pub files: &'p [PathBuf],
    /// The voices of the project. A dub is in the same shard as its original.
    pub voices: &'p Voices,
}

/// Plans a step for each of this number of shards of `inputs`. `beside` returns the inputs of a clip besides its Lipz
/// file.
///
/// # Errors
/// If a file cannot be read, or if its path is not Unicode.
pub fn plan(
    step: Step,
    inputs: &[Input],
    shards: NonZero<u16>,
    common: CommonInputs<'_>,
    beside: impl Fn(&Input) -> ExtraInputs + Send + Sync,
) -> Result<Vec<ShardPlan>, Vec<Report>> {
    let mut faults = Vec::new();
    let mut file = |path: &Path| PlannedFile::read(path).map_err(|report| faults.push(report)).ok();
    let settings = common.settings.and_then(&mut file);
    let voices = common.voices;
    let record = unicode(common.record).map_err(|report| vec![report])?;
    let common: Vec<PlannedFile> = common.files.iter().filter_map(|path| file(path)).collect();
    let read: Vec<Result<PlannedInput, Report>> = parallel::in_pool(None, || {
        parallel::map_init(inputs, || (), |(), input: &Input| PlannedInput::read(input, voices, beside(input)))
    });
    let mut of_shards: Vec<Vec<PlannedInput>> = vec![Vec::new(); usize::from(shards.get())];
    for input in read {
        match input {
            Ok(input) => of_shards[usize::from(input.shard(shards))].push(input),
            Err(report) => faults.push(report),
        }
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    let shard_plan = |(shard, mut inputs): (u16, Vec<PlannedInput>)| {
        inputs.sort_by(|one, other| one.key.cmp(&other.key));
        let mut plan = ShardPlan {
            format: SHARD_FORMAT.to_owned(),
            version: VERSION,
            lipz: MAKER.to_owned(),
            step,
            shard,
            shards: shards.get(),
            id: ContentHash::of(&[]),
            settings: settings.clone(),
            record: record.clone(),
            common: common.clone(),
            inputs,
        };
        plan.id = plan.hash();
        plan
    };
    Ok((0..).zip(of_shards).map(shard_plan).collect())
}

impl Plan {
    /// Creates the plan of these shards, whose own plans are files in the folder `folder` next to it. `made_by` are the
    /// arguments of lipz that make it again.
    ///
    /// # Errors
    /// If `makes` is not Unicode.
    pub fn new(shards: &[ShardPlan], folder: &str, makes: &Path, made_by: Vec<String>) -> Result<Plan, Report> {
        let shard = |plan: &ShardPlan| {
            let name = plan.name();
            let needs = format!("{folder}/{name}.json");
            PlannedShard {
                shard: plan.shard,
                id: plan.id,
                clips: plan.inputs.len(),
                needs,
                makes: format!("{name}.{}", plan.step.extension()),
            }
        };
        Ok(Plan {
            format: FORMAT.to_owned(),
            version: VERSION,
            lipz: MAKER.to_owned(),
            step: shards.first().map_or(Step::Pack, |shard| shard.step),
            made_by,
            makes: unicode(makes)?,
            shards: shards.iter().map(shard).collect(),
        })
    }

    /// Returns the plan as JSON.
    pub fn to_json(&self) -> String {
        json(self)
    }
}

impl ShardPlan {
    /// Returns the base name of its files: `3-of-64`.
    pub fn name(&self) -> String {
        format!("{}-of-{}", self.shard, self.shards)
    }

    /// Returns the plan as JSON.
    pub fn to_json(&self) -> String {
        json(self)
    }

    /// Returns the hash of all inputs of the shard.
    pub(super) fn hash(&self) -> ContentHash {
        let mut fields = Fields::default();
        fields.add(&self.lipz);
        fields.add(self.step.extension());
        fields.add(self.shard);
        fields.add(self.shards);
        fields.add(self.settings.is_some());
        fields.add(&self.record);
        fields.add(self.common.len());
        let files = self.settings.iter().chain(&self.common);
        files.for_each(|file| file.add_to(&mut fields));
        for input in &self.inputs {
            fields.add(&input.key);
            fields.add(input.line());
            fields.add(&input.path);
            fields.add(input.hash);
            fields.add(input.recording.is_some());
            input.recording.iter().for_each(|recording| recording.add_to(&mut fields));
            fields.add(input.record.is_some());
            input.record.iter().for_each(|record| fields.add(record));
            fields.add(input.beside.len());
            input.beside.iter().for_each(|file| file.add_to(&mut fields));
        }
        fields.hash()
    }

    /// Returns the Lipz files, with their keys.
    pub fn inputs(&self) -> Vec<Input> {
        let input = |planned: &PlannedInput| Input {
            key: planned.key.clone(),
            content: Content::File(PathBuf::from(&planned.path)),
        };
        self.inputs.iter().map(input).collect()
    }

    /// Returns the paths of all inputs of the step, except for the sync record: only its entries about these clips
    /// matter, and they change the plan itself.
    pub fn needs(&self) -> impl Iterator<Item = &str> {
        self.files().map(|(path, _)| path)
    }

    /// Returns the same with their hashes.
    pub(super) fn files(&self) -> impl Iterator<Item = (&str, ContentHash)> {
        let common = self.settings.iter().chain(&self.common);
        let beside = self.inputs.iter().flat_map(|input| input.recording.iter().chain(&input.beside));
        let files = common.chain(beside).map(|file| (file.path.as_str(), file.hash));
        files.chain(self.inputs.iter().map(|input| (input.path.as_str(), input.hash)))
    }
}

fn json(value: &impl Serialize) -> String {
    // The value consists of strings and numbers, which JSON can always represent.
    let mut text = serde_json::to_string_pretty(value).unwrap_or_default();
    text.push('\n');
    text
}

impl PlannedFile {
    fn read(path: &Path) -> Result<PlannedFile, Report> {
        let name = unicode(path)?;
        let hash = ContentHash::of_file(path).map_err(|error| {
            let message = format!("`{name}` cannot be read: {error}");
            Report::about(name.as_str(), Diagnostic::new(Code::UnreadableFile, message))
        })?;
        Ok(PlannedFile { path: name, hash })
    }

    fn add_to(&self, fields: &mut Fields) {
        fields.add(&self.path);
        fields.add(self.hash);
    }
}

impl PlannedInput {
    fn read(input: &Input, voices: &Voices, beside: ExtraInputs) -> Result<PlannedInput, Report> {
        let Content::File(path) = &input.content else {
            let message = "a plan cannot contain data in memory, which other machines do not have";
            return Err(Report::failure(input.name(), Code::UnreadableFile, message, "name files and folders"));
        };
        let PlannedFile { path, hash } = PlannedFile::read(path)?;
        let recording = beside.recording.map(|path| PlannedFile::read(&path)).transpose()?;
        let record = beside.record;
        let beside = beside.files.iter().map(|path| PlannedFile::read(path)).collect::<Result<_, _>>()?;
        let line = Some(voices.line_of(&input.key)).filter(|line| *line != input.key).map(str::to_owned);
        Ok(PlannedInput { key: input.key.clone(), line, path, hash, recording, record, beside })
    }

    fn line(&self) -> &str {
        self.line.as_ref().unwrap_or(&self.key)
    }

    /// Returns the shard of the clip.
    pub(super) fn shard(&self, shards: NonZero<u16>) -> u16 {
        shard_of(ClipId::from_key(self.line()), shards)
    }
}

/// Returns a path as a plan stores it.
fn unicode(path: &Path) -> Result<String, Report> {
    if path.to_str().is_some() {
        return Ok(display(path));
    }
    let (name, help) = (display(path), "rename the file or folder");
    let message = format!("the path of `{name}` is not Unicode, so a plan cannot contain it");
    Err(Report::failure(name, Code::UnreadableFile, message, help))
}
