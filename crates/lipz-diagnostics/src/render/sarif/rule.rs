//! The description of a code in SARIF: the same as its page.

use super::location::Message;
use crate::Code;
use serde::Serialize;

/// The delimiter of bold words in Markdown.
const STRONG: &str = "**";

/// The standard's `reportingDescriptor`.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Rule {
    id: &'static str,
    name: &'static str,
    short_description: Message,
    full_description: Message,
    help: Help,
    help_uri: String,
    default_configuration: Configuration,
}

/// The page, for viewers with and without Markdown.
#[derive(Serialize)]
struct Help {
    text: String,
    markdown: &'static str,
}

#[derive(Serialize)]
struct Configuration {
    level: String,
}

impl Rule {
    pub(super) fn new(code: Code) -> Rule {
        let (number, name) = (code.number(), code.name());
        let anchor = format!("{}-{name}", number.to_lowercase());
        Rule {
            id: number,
            name,
            short_description: Message::new(code.summary()),
            full_description: Message::new(what(code)),
            help: Help { text: code.page().replace(STRONG, ""), markdown: code.page() },
            help_uri: format!("{}/blob/main/docs/reference/diagnostics.md#{anchor}", env!("CARGO_PKG_REPOSITORY")),
            default_configuration: Configuration { level: code.default_severity().to_string() },
        }
    }
}

/// Returns the first paragraph of the page, about the problem.
fn what(code: Code) -> String {
    let paragraph = code.page().split("\n\n").next().unwrap_or_default();
    paragraph.trim_start_matches("**What.** ").replace('\n', " ")
}
