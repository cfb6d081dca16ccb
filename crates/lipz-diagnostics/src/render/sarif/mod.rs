//! Diagnostics as SARIF 2.1.0 (OASIS), which editors and several code-scanning services read.
//!
//! Property names are those of the standard. Optional properties are written only if a program reads them.

mod location;
mod rule;

use super::to_json;
use crate::Report;
use crate::{Code, Diagnostic, Fix as OfferedFix};
use location::{ArtifactChange, File, Location, Message};
use rule::Rule;
use serde::Serialize;
use std::collections::BTreeSet;

const SCHEMA: &str = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";

#[derive(Serialize)]
struct Log {
    #[serde(rename = "$schema")]
    schema: &'static str,
    version: &'static str,
    runs: [SarifRun; 1],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct SarifRun {
    tool: Tool,
    invocations: [Invocation; 1],
    column_kind: &'static str,
    results: Vec<ResultEntry>,
}

#[derive(Serialize)]
struct Tool {
    driver: Driver,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Driver {
    name: &'static str,
    semantic_version: &'static str,
    information_uri: &'static str,
    rules: Vec<Rule>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Invocation {
    /// Whether the tool could run, independently of diagnostics.
    execution_successful: bool,
}

/// A diagnostic: the standard's `result`.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct ResultEntry {
    rule_id: &'static str,
    rule_index: usize,
    level: String,
    message: Message,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    locations: Vec<Location>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    related_locations: Vec<Location>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    fixes: Vec<Fix>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Fix {
    #[serde(skip_serializing_if = "Option::is_none")]
    description: Option<Message>,
    artifact_changes: [ArtifactChange; 1],
    properties: FixProperties,
}

/// SARIF has no term for the certainty of a fix.
#[derive(Serialize)]
struct FixProperties {
    applicability: &'static str,
}

/// Returns one SARIF 2.1.0 document with all diagnostics, even if there are none. `is_successful` states whether the
/// tool could run, independently of diagnostics.
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, Report, render};
/// let report = Report::about("voices/aye.lipz", Diagnostic::new(Code::EmptyFile, "the file is empty"));
/// let log: serde_json::Value = serde_json::from_str(&render::sarif(&[report], true)).unwrap();
/// assert_eq!(log["runs"][0]["results"][0]["ruleId"], "LZ0002");
/// ```
pub fn sarif(reports: &[Report], is_successful: bool) -> String {
    to_json(&log(reports, is_successful))
}

fn log(reports: &[Report], is_successful: bool) -> Log {
    let codes: BTreeSet<Code> = reports.iter().flat_map(|report| &report.diagnostics).map(|found| found.code).collect();
    let codes: Vec<Code> = codes.into_iter().collect();
    Log {
        schema: SCHEMA,
        version: "2.1.0",
        runs: [SarifRun {
            tool: Tool {
                driver: Driver {
                    name: "lipz",
                    semantic_version: env!("CARGO_PKG_VERSION"),
                    information_uri: env!("CARGO_PKG_REPOSITORY"),
                    rules: codes.iter().copied().map(Rule::new).collect(),
                },
            },
            invocations: [Invocation { execution_successful: is_successful }],
            column_kind: "unicodeCodePoints",
            results: reports.iter().flat_map(|report| entries(report, &codes)).collect(),
        }],
    }
}

/// Returns the diagnostics in one file.
fn entries(report: &Report, codes: &[Code]) -> Vec<ResultEntry> {
    let file = File::new(report);
    report.diagnostics.iter().map(|diagnostic| entry(&file, diagnostic, codes)).collect()
}

fn entry(file: &File, diagnostic: &Diagnostic, codes: &[Code]) -> ResultEntry {
    let fix = |fix: &OfferedFix| Fix {
        description: diagnostic.help.clone().map(Message::new),
        artifact_changes: [file.change(fix)],
        properties: FixProperties { applicability: fix.applicability.name() },
    };
    ResultEntry {
        rule_id: diagnostic.code.number(),
        rule_index: codes.partition_point(|&code| code < diagnostic.code),
        level: diagnostic.severity.to_string(),
        message: Message::new(message(diagnostic)),
        locations: file.location(diagnostic.primary.as_ref()).into_iter().collect(),
        related_locations: diagnostic.labels.iter().filter_map(|label| file.location(Some(label))).collect(),
        fixes: diagnostic.fix.iter().map(fix).collect(),
    }
}

/// Returns the message as a sentence, then notes and help, one per line. Viewers show only the first sentence if there
/// is little room.
fn message(diagnostic: &Diagnostic) -> String {
    let message = format!("{}.", diagnostic.message);
    let rest = diagnostic.notes.iter().chain(&diagnostic.help).map(String::as_str);
    std::iter::once(message.as_str()).chain(rest).collect::<Vec<_>>().join("\n")
}
