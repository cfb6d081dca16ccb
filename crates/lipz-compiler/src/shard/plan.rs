//! What is to be done: the shards of a project, and what each of them is made of.

use super::hash::Fields;
use super::{ContentHash, MOUTHS_EXTENSION, OBJECT_EXTENSION, shard_of};
use crate::discover::display;
use crate::{Content, Input, Voices, parallel};
use lipz_bank::ClipId;
use lipz_diagnostics::{Code, Diagnostic, Report};
use serde::{Deserialize, Serialize};
use std::num::NonZero;
use std::path::{Path, PathBuf};

/// What a plan says that it is.
pub(super) const FORMAT: &str = "lipz-plan";
/// What the plan of a shard says that it is.
pub(super) const SHARD_FORMAT: &str = "lipz-shard-plan";
/// The version of both formats. What a step makes of its inputs may change with each version of this library, so that is
/// in a plan, too.
pub(super) const VERSION: u32 = 1;
/// The version of this library.
pub(super) const MAKER: &str = env!("CARGO_PKG_VERSION");

/// The shards of a project. The files of each are in a [`ShardPlan`] of its own, so that a step reads no more than what it
/// is about. `docs/guides/many-machines.md` has the JSON of both.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Plan {
    pub(super) format: String,
    pub(super) version: u32,
    /// The version of lipz that made the plan, and that has to make the objects.
    pub lipz: String,
    /// What its steps do.
    #[serde(default, skip_serializing_if = "Step::is_pack")]
    pub step: Step,
    /// The arguments of lipz that make the plan again.
    pub made_by: Vec<String>,
    /// The bank that the objects are linked to; of a plan of lip sync, the file by which engines know that its mouths are in the
    /// Lipz files.
    pub makes: String,
    /// The shards in order. Shard 0 has the clips with the lowest ids.
    pub shards: Vec<PlannedShard>,
}

/// What the steps of a plan do.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Step {
    /// They pack, each an object.
    #[default]
    Pack,
    /// They make mouths of recordings.
    Sync,
}

impl Step {
    #[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks so")]
    fn is_pack(&self) -> bool {
        *self == Step::Pack
    }

    /// What the names of its results end with, behind a dot.
    pub fn extension(self) -> &'static str {
        match self {
            Step::Pack => OBJECT_EXTENSION,
            Step::Sync => MOUTHS_EXTENSION,
        }
    }
}

/// A shard in a plan: the step that makes something of it.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct PlannedShard {
    /// Its number.
    pub shard: u16,
    /// The hash of all that it is made of: what the object is called in a store of results.
    pub id: ContentHash,
    /// Number of clips.
    pub clips: usize,
    /// The file of its [`ShardPlan`], from the folder of the plan.
    pub needs: String,
    /// The result that the step makes.
    pub makes: String,
}

/// What a shard is made of: files, with the hashes of their contents.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ShardPlan {
    pub(super) format: String,
    pub(super) version: u32,
    /// The version of lipz that made the plan.
    pub lipz: String,
    /// What the step does.
    #[serde(default, skip_serializing_if = "Step::is_pack")]
    pub step: Step,
    /// The number of the shard.
    pub shard: u16,
    /// How many shards there are.
    pub shards: u16,
    /// The hash of all fields but this one.
    pub id: ContentHash,
    /// The settings file, if there is one.
    pub settings: Option<PlannedFile>,
    /// Where the record of mouths is, if it is there, or would be. Of it, only what it says of the clips matters.
    pub record: String,
    /// What all shards read beside it.
    pub common: Vec<PlannedFile>,
    /// The Lipz files in the order of their keys.
    pub(super) inputs: Vec<PlannedInput>,
}

/// A file that a step reads.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct PlannedFile {
    /// Its path from the folder in which the plan was made, with `/`.
    pub path: String,
    /// The hash of its contents.
    pub hash: ContentHash,
}

/// A Lipz file, and what else is read for its clip.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlannedInput {
    pub(super) key: String,
    /// What is said in the clip, if that is not its key: the shard is that of its line.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(super) line: Option<String>,
    pub(super) path: String,
    pub(super) hash: ContentHash,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(super) recording: Option<PlannedFile>,
    /// The hash of what the record of mouths says of it, if it says something.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub(super) record: Option<ContentHash>,
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub(super) beside: Vec<PlannedFile>,
}

/// What is read of a clip besides its Lipz file.
#[derive(Clone, Debug, Default)]
pub struct Beside {
    /// Its recording.
    pub recording: Option<PathBuf>,
    /// The hash of what the record of mouths says of it, if it says something.
    pub record: Option<ContentHash>,
    /// All else.
    pub files: Vec<PathBuf>,
}

/// What all shards of a project have in common.
#[derive(Clone, Copy, Debug)]
pub struct Common<'p> {
    /// The settings file, if there is one.
    pub settings: Option<&'p Path>,
    /// Where the record of mouths is, or would be.
    pub record: &'p Path,
    /// What all shards read beside it.
    pub files: &'p [PathBuf],
    /// The voices of the project: a dub is in one shard with its original.
    pub voices: &'p Voices,
}

/// Plans a step for each of so many shards of `inputs`. `beside` finds what is read of a clip besides its Lipz file.
///
/// # Errors
/// What cannot be read, or has a path that is not Unicode.
pub fn plan(
    step: Step,
    inputs: &[Input],
    shards: NonZero<u16>,
    common: Common<'_>,
    beside: impl Fn(&Input) -> Beside + Send + Sync,
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
    /// The plan of these shards, whose own plans are files in the folder `folder` beside it. `made_by` are the arguments of
    /// lipz that make it again.
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

    /// The plan as JSON.
    pub fn to_json(&self) -> String {
        json(self)
    }
}

impl ShardPlan {
    /// What its files are called: `3-of-64`.
    pub fn name(&self) -> String {
        format!("{}-of-{}", self.shard, self.shards)
    }

    /// The plan as JSON.
    pub fn to_json(&self) -> String {
        json(self)
    }

    /// The hash of all that the shard is made of.
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

    /// The Lipz files, with their keys.
    pub fn inputs(&self) -> Vec<Input> {
        let input = |planned: &PlannedInput| Input {
            key: planned.key.clone(),
            content: Content::File(PathBuf::from(&planned.path)),
        };
        self.inputs.iter().map(input).collect()
    }

    /// The paths of all that the step reads, but for the record of mouths: only what that says of its clips matters, and the plan
    /// is another one then.
    pub fn needs(&self) -> impl Iterator<Item = &str> {
        self.files().map(|(path, _)| path)
    }

    /// The same with their hashes.
    pub(super) fn files(&self) -> impl Iterator<Item = (&str, ContentHash)> {
        let common = self.settings.iter().chain(&self.common);
        let beside = self.inputs.iter().flat_map(|input| input.recording.iter().chain(&input.beside));
        let files = common.chain(beside).map(|file| (file.path.as_str(), file.hash));
        files.chain(self.inputs.iter().map(|input| (input.path.as_str(), input.hash)))
    }
}

fn json(value: &impl Serialize) -> String {
    // Strings and numbers: there is nothing that JSON does not have.
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
    fn read(input: &Input, voices: &Voices, beside: Beside) -> Result<PlannedInput, Report> {
        let Content::File(path) = &input.content else {
            let message = "a plan is about files: what is in memory is not there on another machine";
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

    /// The shard to which the clip belongs.
    pub(super) fn shard(&self, shards: NonZero<u16>) -> u16 {
        shard_of(ClipId::from_key(self.line()), shards)
    }
}

/// A path as a plan has it.
fn unicode(path: &Path) -> Result<String, Report> {
    if path.to_str().is_some() {
        return Ok(display(path));
    }
    let (name, help) = (display(path), "rename the file or folder");
    let message = format!("the path of `{name}` is not Unicode, and a plan cannot name it");
    Err(Report::failure(name, Code::UnreadableFile, message, help))
}
