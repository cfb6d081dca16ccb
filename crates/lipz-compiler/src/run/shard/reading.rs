//! Reading and validation of plans, including everything that a step relies on.

use super::plan::{FORMAT, MAKER, SHARD_FORMAT, VERSION};
use super::{MAX_SHARDS, Plan, PlannedShard, ShardPlan};
use crate::files::path::display;
use lipz_diagnostics::{Code, Diagnostic, Report, Span, escape};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::num::NonZero;
use std::path::Path;

/// The help for a plan that `lipz shard plan` did not write.
const AGAIN: &str = "make the plan again with `lipz shard plan`";

/// The fields to check first, because other versions may have different other fields.
#[derive(Deserialize)]
struct VersionHead {
    format: String,
    version: u32,
}

/// The text to mark, and the problem with it.
type Fault = (String, String);

impl Plan {
    /// Reads and validates the plan in the file at `path`.
    ///
    /// # Errors
    /// If it is invalid, with the position.
    pub fn read(path: &Path) -> Result<Plan, Report> {
        let (name, bytes) = contents(path)?;
        Plan::parse(&bytes, &name)
    }

    /// Reads the plan in `bytes`, with its `name` in messages.
    ///
    /// # Errors
    /// Those of [`read`](Plan::read).
    pub fn parse(bytes: &[u8], name: &str) -> Result<Plan, Report> {
        parse(bytes, name, FORMAT, Plan::fault)
    }

    /// Reads the plan of a shard of this plan from the file at `path`.
    ///
    /// # Errors
    /// If it is invalid or belongs to a different plan, with the position.
    pub fn read_shard(&self, shard: &PlannedShard, path: &Path) -> Result<ShardPlan, Report> {
        let (name, bytes) = contents(&path.with_file_name(&shard.needs))?;
        let found = ShardPlan::parse(&bytes, &name)?;
        let is_meant = (found.shard, usize::from(found.shards)) == (shard.shard, self.shards.len());
        if is_meant && found.step == self.step && found.id == shard.id && found.inputs.len() == shard.clips {
            return Ok(found);
        }
        let message = format!("this plan of a shard differs from the one in `{}`", display(path));
        Err(Report::failure(name, Code::PlanUnreadable, message, AGAIN))
    }

    fn fault(&self) -> Option<Fault> {
        if !(1..=usize::from(MAX_SHARDS)).contains(&self.shards.len()) {
            let message = format!("the plan has {} shards, outside 1 to {MAX_SHARDS}", self.shards.len());
            return Some(("\"shards\"".to_owned(), message));
        }
        let is_name = |path: &str| !path.is_empty() && !path.contains(['\\', ':', '\n']);
        let is_below =
            |path: &str| is_name(path) && !path.starts_with('/') && !path.split('/').any(|part| part == "..");
        let fault = |(at, shard): (u16, &PlannedShard)| {
            if shard.shard != at {
                Some((shard.id.to_string(), format!("shard {} is in the position of shard {at}", shard.shard)))
            } else if !is_below(&shard.needs) {
                Some((quoted(&shard.needs), "the plan of a shard is outside the folder of the plan".to_owned()))
            } else if !is_below(&shard.makes) || shard.makes.contains('/') {
                Some((quoted(&shard.makes), "an object has no name, or its name contains a folder".to_owned()))
            } else {
                None
            }
        };
        other_version(&self.lipz).or_else(|| (0..).zip(&self.shards).find_map(fault))
    }
}

impl ShardPlan {
    /// Reads the plan of a shard in `bytes`, with its `name` in messages. Validates the format, each hash, and that
    /// every clip belongs to the shard and occurs once.
    ///
    /// # Errors
    /// If it is invalid, with the position.
    pub fn parse(bytes: &[u8], name: &str) -> Result<ShardPlan, Report> {
        parse(bytes, name, SHARD_FORMAT, ShardPlan::fault)
    }

    fn fault(&self) -> Option<Fault> {
        let version = other_version(&self.lipz);
        if version.is_some() {
            return version;
        }
        let count = NonZero::new(self.shards).filter(|count| count.get() <= MAX_SHARDS && self.shard < count.get());
        let Some(count) = count else {
            return Some(("\"shards\"".to_owned(), format!("shard {} of {} does not exist", self.shard, self.shards)));
        };
        if let Some([_, next]) = self.inputs.array_windows().find(|[one, next]| one.key >= next.key) {
            return Some((quoted(&next.key), "the inputs are not sorted by key, or one appears twice".to_owned()));
        }
        if let Some(input) = self.inputs.iter().find(|input| input.shard(count) != self.shard) {
            let (key, right) = (escape::text(&input.key), input.shard(count));
            return Some((
                quoted(&input.key),
                format!("the clip `{key}` belongs to shard {right}, not {}", self.shard),
            ));
        }
        (self.hash() != self.id).then(|| {
            (self.id.to_string(), "the id is not the hash of the other fields, so the plan was edited".to_owned())
        })
    }
}

fn other_version(lipz: &str) -> Option<Fault> {
    let message = || format!("the plan was made by lipz {}, but this is lipz {MAKER}", escape::text(lipz));
    (lipz != MAKER).then(|| (quoted(lipz), message()))
}

/// Returns the name of a plan in messages, and its bytes.
fn contents(path: &Path) -> Result<(String, Vec<u8>), Report> {
    let name = display(path);
    let bytes = std::fs::read(path).map_err(|error| {
        let message = format!("the plan `{name}` cannot be read: {error}");
        Report::failure(name.as_str(), Code::UnreadableFile, message, "make a plan with `lipz shard plan`")
    })?;
    Ok((name, bytes))
}

/// Parses a document of this format and validates it with `fault`.
fn parse<T: DeserializeOwned>(
    bytes: &[u8],
    name: &str,
    format: &str,
    fault: impl Fn(&T) -> Option<Fault>,
) -> Result<T, Report> {
    let refuse = |diagnostic: Diagnostic| Report::from_bytes(name, bytes, vec![diagnostic.help(AGAIN)]);
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let place = Span::new(error.valid_up_to(), error.valid_up_to() + 1);
        refuse(Diagnostic::at(Code::PlanUnreadable, place, "the plan is not UTF-8"))
    })?;
    let syntax = |error: serde_json::Error| {
        let message = error.to_string();
        let message = message.split(" at line ").next().unwrap_or_default();
        let message = format!("the plan cannot be read: {message}");
        refuse(Diagnostic::at(Code::PlanUnreadable, place_of(&error, text), message))
    };
    let head: VersionHead = serde_json::from_str(text).map_err(syntax)?;
    if head.format != format || head.version != VERSION {
        let (found, version) = (escape::text(&head.format), head.version);
        let message = format!("the format is `{found}` version {version}, not `{format}` version {VERSION}");
        return Err(refuse(Diagnostic::new(Code::PlanUnreadable, message)));
    }
    let document: T = serde_json::from_str(text).map_err(syntax)?;
    let Some((marked, message)) = fault(&document) else { return Ok(document) };
    Err(refuse(match text.find(&marked) {
        Some(at) => Diagnostic::at(Code::PlanUnreadable, Span::new(at, at + marked.len()), message),
        None => Diagnostic::new(Code::PlanUnreadable, message),
    }))
}

/// Returns the position at which serde_json stopped. Its columns count bytes, and 0 stands for the line break before.
fn place_of(error: &serde_json::Error, text: &str) -> Span {
    let start: usize = text.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
    let mut at = (start + error.column()).saturating_sub(1).min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    Span::new(at, at + text[at..].chars().next().map_or(0, char::len_utf8))
}

/// Returns a string in JSON syntax.
fn quoted(text: &str) -> String {
    serde_json::to_string(text).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::super::plan::{CommonInputs, ExtraInputs, Step, plan};
    use super::*;
    use crate::project::Voices;
    use crate::sources::discover;

    fn plans() -> (Plan, Vec<ShardPlan>) {
        let folder = tempfile::tempdir().unwrap();
        for name in ["a", "b", "c", "d"] {
            std::fs::write(folder.path().join(name).with_extension("lipz"), "{}").unwrap();
        }
        let inputs = discover(&[folder.path().into()], None).unwrap();
        let voices = Voices::default();
        let common = CommonInputs { settings: None, record: Path::new("r.txt"), files: &[], voices: &voices };
        let shards = plan(Step::Pack, &inputs, NonZero::new(2).unwrap(), common, |_| ExtraInputs::default()).unwrap();
        (Plan::new(&shards, "p", Path::new("d.lipzbank"), vec!["x".to_owned()]).unwrap(), shards)
    }

    #[test]
    fn plans_are_read_as_they_were_written() {
        let (plan, shards) = plans();
        assert_eq!(Plan::parse(plan.to_json().as_bytes(), "p"), Ok(plan));
        assert_eq!(shards.iter().map(|shard| shard.inputs.len()).sum::<usize>(), 4);
        for shard in shards {
            assert_eq!(ShardPlan::parse(shard.to_json().as_bytes(), "p"), Ok(shard));
        }
    }

    #[test]
    fn every_change_is_noticed_and_none_panics() {
        let (plan, shards) = plans();
        let shard = shards.into_iter().find(|shard| !shard.inputs.is_empty()).unwrap();
        let json = shard.to_json();
        for at in 0..json.len() {
            let mut changed = json.clone().into_bytes();
            changed[at] ^= 1;
            let is_space = json.as_bytes()[at].is_ascii_whitespace();
            assert!(is_space || ShardPlan::parse(&changed, "p").is_err(), "byte {at}");
            // The last byte is a line break.
            assert!(at + 1 == json.len() || ShardPlan::parse(&json.as_bytes()[..at], "p").is_err());
        }
        let index = plan.to_json();
        for (from, to) in [
            ("\"version\": 1", "\"version\": 2"),
            ("\"shard\": 1", "\"shard\": 0"),
            ("p/0-of-2.json", "../0-of-2.json"),
            ("0-of-2.lipzobj", "x/0-of-2.lipzobj"),
            (MAKER, "0.0.0"),
            ("\"makes\"", "\"Makes\""),
        ] {
            assert!(index.contains(from), "{from}");
            let report = Plan::parse(index.replacen(from, to, 1).as_bytes(), "p").unwrap_err();
            assert_eq!(report.diagnostics[0].code, Code::PlanUnreadable);
        }
    }
}
