//! The arguments that register the names of a project's events.

use clap::Args;
use lipz_compiler::Registry;
use std::collections::BTreeSet;

/// Names that events may mention.
#[derive(Args, Debug)]
pub(crate) struct Registries {
    /// Characters of the scenes, `amy,rob`: events that name another one are reported
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    characters: Option<Vec<String>>,

    /// Things that characters look and point at; checked together with the characters
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    props: Option<Vec<String>>,

    /// Emotions beyond those of the specification
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    emotions: Option<Vec<String>>,

    /// Actions of `does`
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    actions: Option<Vec<String>>,
}

impl Registries {
    /// The compiler's registry.
    pub(crate) fn registry(&self) -> Registry {
        Registry {
            characters: self.characters.as_deref().map(set),
            props: self.props.as_deref().map(set),
            emotions: self.emotions.as_deref().map(set).unwrap_or_default(),
            actions: self.actions.as_deref().map(set),
        }
    }
}

/// The names without blanks around them; `--props ""` registers that there are none.
fn set(names: &[String]) -> BTreeSet<String> {
    names.iter().map(|name| name.trim()).filter(|name| !name.is_empty()).map(str::to_owned).collect()
}
