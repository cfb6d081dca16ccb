//! What is to be done: the shards of a project, and what each of them is made of.

use super::hash::Fields;
use super::{ContentHash, OBJECT_EXTENSION, shard_of};
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
/// is about. `docs/SCALE.md` has the JSON of both.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Plan {
    pub(super) format: String,
    pub(super) version: u32,
    /// The version of lipz that made the plan, and that has to make the objects.
    pub lipz: String,
    /// The arguments of lipz that make the plan again.
    pub made_by: Vec<String>,
    /// The bank that the objects are linked to.
    pub makes: String,
    /// The shards in order. Shard 0 has the clips with the lowest ids.
    pub shards: Vec<PlannedShard>,
}

/// A shard in a plan: the step that packs it.
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
    /// The object that the step makes.
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
    /// The number of the shard.
    pub shard: u16,
    /// How many shards there are.
    pub shards: u16,
    /// The hash of all fields but this one.
    pub id: ContentHash,
    /// The settings file, if there is one.
    pub settings: Option<PlannedFile>,
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

/// A Lipz file, and perhaps the recording of its clip.
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
}

/// What all shards of a project have in common.
#[derive(Clone, Copy, Debug)]
pub struct Common<'p> {
    /// The settings file, if there is one.
    pub settings: Option<&'p Path>,
    /// What all shards read beside it.
    pub files: &'p [PathBuf],
    /// The voices of the project: a dub is in one shard with its original.
    pub voices: &'p Voices,
}

/// Plans the packing of `inputs` in so many shards. `recording` finds what is read of a clip beside its Lipz file.
///
/// # Errors
/// What cannot be read, or has a path that is not Unicode.
pub fn plan(
    inputs: &[Input],
    shards: NonZero<u16>,
    common: Common<'_>,
    recording: impl Fn(&str) -> Option<PathBuf> + Send + Sync,
) -> Result<Vec<ShardPlan>, Vec<Report>> {
    let mut faults = Vec::new();
    let mut file = |path: &Path| PlannedFile::read(path).map_err(|report| faults.push(report)).ok();
    let settings = common.settings.and_then(&mut file);
    let voices = common.voices;
    let common: Vec<PlannedFile> = common.files.iter().filter_map(|path| file(path)).collect();
    let read: Vec<Result<PlannedInput, Report>> = parallel::in_pool(None, || {
        parallel::map_init(inputs, || (), |(), input: &Input| PlannedInput::read(input, voices, &recording))
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
            shard,
            shards: shards.get(),
            id: ContentHash::of(&[]),
            settings: settings.clone(),
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
                makes: format!("{name}.{OBJECT_EXTENSION}"),
            }
        };
        Ok(Plan {
            format: FORMAT.to_owned(),
            version: VERSION,
            lipz: MAKER.to_owned(),
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
        fields.add(self.shard);
        fields.add(self.shards);
        fields.add(self.settings.is_some());
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

    /// The paths of all that the step reads.
    pub fn needs(&self) -> impl Iterator<Item = &str> {
        let common = self.settings.iter().chain(&self.common).map(|file| file.path.as_str());
        let recordings = self.inputs.iter().filter_map(|input| input.recording.as_ref());
        common
            .chain(self.inputs.iter().map(|input| input.path.as_str()))
            .chain(recordings.map(|file| file.path.as_str()))
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
    fn read(
        input: &Input,
        voices: &Voices,
        recording: &impl Fn(&str) -> Option<PathBuf>,
    ) -> Result<PlannedInput, Report> {
        let Content::File(path) = &input.content else {
            let message = "a plan is about files: what is in memory is not there on another machine";
            return Err(Report::failure(input.name(), Code::UnreadableFile, message, "name files and folders"));
        };
        let PlannedFile { path, hash } = PlannedFile::read(path)?;
        let recording = recording(&input.key).map(|path| PlannedFile::read(&path)).transpose()?;
        let line = Some(voices.line_of(&input.key)).filter(|line| *line != input.key).map(str::to_owned);
        Ok(PlannedInput { key: input.key.clone(), line, path, hash, recording })
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
