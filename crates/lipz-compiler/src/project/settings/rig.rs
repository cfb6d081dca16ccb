//! `[rig]`: the shapes of models that a bank contains.

use super::reading::SettingsReader;
use super::value::{NamedValue, span};
use crate::project::rigs::{RigError, WeightSpec, built_in, built_in_names, inputs, named, weight};
use lipz_diagnostics::{Code, Diagnostic, escape, suggest::nearest};
use toml::de::DeValue;

/// The most bytes of the names of all weights, and the most weights and terms, that fit into a bank.
const MOST: usize = u16::MAX as usize;

impl SettingsReader<'_> {
    /// Reads an entry of `[rig]`: `true` for a built-in rig, or a table with a sum of terms for each weight.
    pub(super) fn rig(&mut self, name: &str, value: &NamedValue<'_>) {
        if name.is_empty() || name.len() > MOST {
            let message = "a rig has a name that is empty or too long";
            let diagnostic = Diagnostic::at(Code::SettingValue, span(&value.key), message);
            return self.diagnostics.push(diagnostic.help("write a name of 1 to 65,535 bytes, as in [rig.otto]"));
        }
        let weights = match value.node.get_ref() {
            DeValue::Table(entries) if entries.is_empty() => {
                return self.refuse(
                    value,
                    "has no weights",
                    "write a sum of terms for each shape: jawOpen = \"0.8 jaw\"",
                );
            }
            DeValue::Table(entries) => {
                let mut weights = Vec::new();
                for (key, node) in entries {
                    let weight = key.get_ref().as_ref();
                    let value = NamedValue { name: format!("{}.{weight}", value.name), key: key.span(), node };
                    weights.extend(self.weight(weight, &value));
                }
                weights
            }
            _ => match value.boolean(&mut self.diagnostics) {
                None => return,
                Some(is_chosen) => match built_in(name) {
                    Some(weights) if is_chosen => weights,
                    Some(_) => return,
                    None => return self.unknown_rig(name, value),
                },
            },
        };
        let names: usize = weights.iter().map(|weight| weight.name.len()).sum();
        let terms: usize = weights.iter().map(WeightSpec::term_count).sum();
        if names.max(terms) > MOST {
            return self.refuse(value, "has too many weights", "write at most 65,535 terms, and bytes of names");
        }
        self.settings.options.rigs.insert(name.to_owned(), weights);
    }

    fn weight(&mut self, name: &str, value: &NamedValue<'_>) -> Option<WeightSpec> {
        let sum = value.text(&mut self.diagnostics)?;
        match weight(name, sum) {
            Ok(weight) => Some(weight),
            Err(RigError::UnknownInput(input)) => {
                let help = match nearest(&input, inputs()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("use {}", inputs().collect::<Vec<_>>().join(", ")),
                };
                self.refuse(value, &format!("has the unknown input {}", escape::quoted(&input)), &help);
                None
            }
            Err(RigError::Factor(factor)) => {
                let what = format!("has the factor {}", escape::quoted(&factor));
                self.refuse(value, &what, "write a factor from -32 to 32 before an input: 0.6 jaw");
                None
            }
            Err(RigError::Name) => {
                let message = format!("{} is not the name of a weight, with or without a range", escape::quoted(name));
                let diagnostic = Diagnostic::at(Code::SettingValue, span(&value.key), message);
                self.diagnostics.push(diagnostic.help("write the lowest and the highest value: \"Smile [-1 1]\""));
                None
            }
            Err(RigError::Syntax) => {
                self.refuse(value, "is not a sum of terms", "write terms, such as 0.35 opening - 0.2 jaw*closure");
                None
            }
        }
    }

    /// Finds the rig to bake among those of the project and the built-in ones.
    pub(super) fn resolve_baked_rig(&mut self) {
        let Some((name, span)) = self.baked.take() else { return };
        match named(&name, &self.settings.options.rigs) {
            Ok(weights) => self.settings.options.baked_rig = Some((name, weights)),
            Err(help) => {
                let message = format!("there is no rig {} to bake", escape::quoted(&name));
                self.diagnostics.push(Diagnostic::at(Code::SettingValue, span, message).help(help));
            }
        }
    }

    fn unknown_rig(&mut self, name: &str, value: &NamedValue<'_>) {
        let help = match nearest(name, built_in_names()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!(
                "write one of {}, or describe the rig in a table: [rig.{}]",
                built_in_names().collect::<Vec<_>>().join(", "),
                escape::text(name)
            ),
        };
        let message = format!("there is no built-in rig {}", escape::quoted(name));
        self.diagnostics.push(Diagnostic::at(Code::SettingValue, span(&value.key), message).help(help));
    }
}
