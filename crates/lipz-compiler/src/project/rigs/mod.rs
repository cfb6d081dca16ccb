//! Rigs of a project, and their section in a bank.

mod parse;

pub use parse::{RigError, WeightSpec, inputs, weight};

use lipz_bank::articulation::Articulator;
use lipz_diagnostics::suggest::nearest;
use lipz_layout::{RigRecord, RigTermRecord, RigWeightRecord};
use std::collections::BTreeMap;
use zerocopy::IntoBytes;

/// The rigs that a project can name without describing them: a name, and the description.
const BUILT_IN: [(&str, &str); 11] = [
    ("arkit", include_str!("../../../rigs/arkit.txt")),
    ("azure", include_str!("../../../rigs/azure.txt")),
    ("facefx", include_str!("../../../rigs/facefx.txt")),
    ("live2d", include_str!("../../../rigs/live2d.txt")),
    ("mmd", include_str!("../../../rigs/mmd.txt")),
    ("ovr", include_str!("../../../rigs/ovr.txt")),
    ("sapi", include_str!("../../../rigs/sapi.txt")),
    ("second-life", include_str!("../../../rigs/second-life.txt")),
    ("talking-heads", include_str!("../../../rigs/talking-heads.txt")),
    ("vrchat", include_str!("../../../rigs/vrchat.txt")),
    ("vrm", include_str!("../../../rigs/vrm.txt")),
];

/// The names of the built-in rigs.
pub fn built_in_names() -> impl Iterator<Item = &'static str> {
    BUILT_IN.into_iter().map(|(name, _)| name)
}

/// Returns the weights of a built-in rig.
pub fn built_in(name: &str) -> Option<Vec<WeightSpec>> {
    let (_, text) = BUILT_IN.into_iter().find(|(known, _)| *known == name)?;
    // A test parses all of them.
    parse::description(text).ok()
}

/// The rigs of a project by name, each with its weights.
pub type RigSettings = BTreeMap<String, Vec<WeightSpec>>;

/// Returns the weights of the rig of a project with this name, or of the built-in one.
///
/// # Errors
/// If neither exists: a help line with a similar name, or with all names.
pub fn named(name: &str, project: &RigSettings) -> Result<Vec<WeightSpec>, String> {
    project.get(name).cloned().or_else(|| built_in(name)).ok_or_else(|| {
        let known: Vec<&str> = project.keys().map(String::as_str).chain(BUILT_IN.map(|(name, _)| name)).collect();
        match nearest(name, known.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("name one of {}, or describe the rig in lipz.toml", known.join(", ")),
        }
    })
}

/// Whether a curve has the name of an articulator, or of a weight of a project's or a built-in rig.
pub(crate) fn has_curve(name: &str, project: &RigSettings) -> bool {
    let is_built_in = |text: &str| {
        let names = text.lines().filter(|line| !line.starts_with('#')).filter_map(|line| line.split_once(" = "));
        names.map(|(name, _)| name.split(" [").next().unwrap_or(name)).any(|known| known == name)
    };
    Articulator::ALL.iter().any(|articulator| articulator.name() == name)
        || project.values().flatten().any(|weight| weight.name == name)
        || BUILT_IN.iter().any(|(_, text)| is_built_in(text))
}

/// Returns the section of the bank; empty without rigs. Settings limit names and counts to what fits.
pub(crate) fn section(rigs: &RigSettings) -> Vec<u8> {
    let short = |length: usize| u16::try_from(length).unwrap_or(u16::MAX);
    let mut bytes = Vec::new();
    for (name, weights) in rigs {
        let mut records = Vec::with_capacity(weights.len());
        let (mut terms, mut names) = (Vec::new(), String::new());
        for weight in weights {
            names.push_str(&weight.name);
            terms.extend(weight.terms.iter().map(|term| RigTermRecord {
                factor_thousandths: term.factor_thousandths.into(),
                first: term.first,
                second: term.second,
            }));
            records.push(RigWeightRecord {
                terms_end: short(terms.len()).into(),
                names_end: short(names.len()).into(),
                least: weight.least.into(),
                most: weight.most.into(),
            });
        }
        let record = RigRecord {
            name_length_bytes: short(name.len()).into(),
            weight_count: short(records.len()).into(),
            term_count: short(terms.len()).into(),
            names_length_bytes: short(names.len()).into(),
        };
        bytes.extend_from_slice(record.as_bytes());
        bytes.extend_from_slice(name.as_bytes());
        bytes.extend_from_slice(records.as_bytes());
        bytes.extend_from_slice(terms.as_bytes());
        bytes.extend_from_slice(names.as_bytes());
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn built_in_rigs_can_be_parsed() {
        for (name, text) in BUILT_IN {
            let weights = parse::description(text).unwrap_or_else(|error| panic!("{name}: {error:?}"));
            assert!(!weights.is_empty(), "{name}");
        }
    }
}
