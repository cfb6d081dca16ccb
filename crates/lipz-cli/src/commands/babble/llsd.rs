//! The lip sync settings in a viewer's `settings.xml`: LLSD, an XML of typed maps.

use lipz::diagnostic::show;
use lipz::{Code, Diagnostic, Span, rate};
use lipz_bank::Fps;
use lipz_compiler::babble::{BabbleProfile, Digits, NotDigits};
use roxmltree::{Document, Node, TextPos};
use std::ops::Range;

/// Where findings go.
type Findings = Vec<Diagnostic>;

/// The profile in `text`; `None` if it is no LLSD. Settings that are absent are left open.
pub(super) fn profile(text: &str, name: &str, findings: &mut Findings) -> Option<BabbleProfile> {
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(error) => {
            let at = offset(text, error.pos());
            // The message ends with the place, which the caret shows.
            let message = error.to_string();
            let message = message.split(" at ").next().unwrap_or(&message);
            let headline = format!("`{name}` is not XML: {}", show::text(message));
            let finding = Diagnostic::at(Code::ViewerSettingsSyntax, Span::new(at, at + 1), headline);
            findings.push(finding.help(WHICH_FILE));
            return None;
        }
    };
    let settings = settings(&document, name, findings)?;
    let mut digits = |key| settings.value(key).and_then(|value| value.digits(findings));
    let mut profile = BabbleProfile {
        ooh: digits("LipSyncOoh"),
        aah: digits("LipSyncAah"),
        ooh_power_transfer: digits("LipSyncOohPowerTransfer"),
        aah_power_transfer: digits("LipSyncAahPowerTransfer"),
        rate: None,
    };
    profile.rate = settings.value("LipSyncOohAahRate").and_then(|value| value.rate(findings));
    if let Some(enabled) = settings.value("LipSyncEnabled") {
        enabled.check_enabled(findings);
    }
    findings.sort_by_key(Diagnostic::start);
    Some(profile)
}

const WHICH_FILE: &str = "name the settings.xml in the folder user_settings of the viewer";

/// The map of settings in an LLSD document.
fn settings<'d>(document: &'d Document<'d>, name: &str, findings: &mut Findings) -> Option<Map<'d>> {
    let root = document.root_element();
    let mut refuse = |node: Node<'_, '_>, what: &str| {
        let headline = format!("`{name}` is not LLSD: {what} <{}>", show::text(node.tag_name().name()));
        let finding = Diagnostic::at(Code::ViewerSettingsSyntax, start_tag(node), headline);
        findings.push(finding.help(WHICH_FILE));
    };
    if !root.has_tag_name("llsd") {
        refuse(root, "it starts with");
        return None;
    }
    let map = root.children().find(Node::is_element);
    match map {
        Some(map) if map.has_tag_name("map") => Some(Map(map)),
        _ => {
            refuse(map.unwrap_or(root), "there is no <map> of settings in");
            None
        }
    }
}

/// An LLSD map: keys, each with the element behind it.
struct Map<'d>(Node<'d, 'd>);

impl<'d> Map<'d> {
    fn key(&self, name: &str) -> Option<Node<'d, 'd>> {
        self.0.children().find(|node| node.has_tag_name("key") && node.text().map(str::trim) == Some(name))
    }

    /// The setting with this name. A setting is a map, too; what counts is its `Value`.
    fn value(&self, name: &'static str) -> Option<Value<'d>> {
        let key = self.key(name)?;
        let setting = key.next_sibling_element();
        let map = setting.filter(|node| node.has_tag_name("map")).map(Map);
        let node = map.and_then(|map| map.key("Value")).and_then(|key| key.next_sibling_element());
        Some(Value { name, key, node })
    }
}

/// The value of a setting.
struct Value<'d> {
    name: &'static str,
    key: Node<'d, 'd>,
    /// The typed value, if there is one.
    node: Option<Node<'d, 'd>>,
}

impl<'d> Value<'d> {
    fn digits(&self, findings: &mut Findings) -> Option<Digits> {
        let node = self.of_type(&["string"], "a text of digits", findings)?;
        let text = node.text().unwrap_or("");
        let (what, help) = match Digits::parse(text) {
            Ok(digits) => return Some(digits),
            Err(NotDigits::Empty) => ("is empty".to_owned(), "write at least one digit"),
            Err(NotDigits::Foreign(c, _)) => (
                format!("has {}, which is not a digit", show::character(c)),
                "each digit from 0 to 9 is how far the morph moves",
            ),
            Err(NotDigits::TooMany) => ("has too many digits".to_owned(), "a bank holds loops of up to 65,535 digits"),
        };
        let span = match (Digits::parse(text), node.first_child()) {
            (Err(NotDigits::Foreign(c, at)), Some(child)) if child.range().len() == text.len() => {
                let start = child.range().start + at;
                Span::new(start, start + c.len_utf8())
            }
            _ => whole(node),
        };
        findings.push(Diagnostic::at(Code::BabbleDigits, span, format!("`{}` {what}", self.name)).help(help));
        None
    }

    fn rate(&self, findings: &mut Findings) -> Option<Fps> {
        let node = self.of_type(&["real", "integer"], "a number", findings)?;
        let text = node.text().unwrap_or("0").trim();
        let fps = rate::parse(text).and_then(|rate| Fps::new(rate.numerator, rate.denominator));
        if fps.is_none() {
            let headline = format!("`{}` is outside 1 to 1000", self.name);
            let finding = Diagnostic::at(Code::BabbleRate, whole(node), headline);
            findings.push(finding.help("write digits per second; the viewer's own rate is 24"));
        }
        fps
    }

    /// Warns if lip sync is off.
    fn check_enabled(&self, findings: &mut Findings) {
        let Some(node) = self.of_type(&["integer", "boolean"], "0 or 1", findings) else { return };
        if matches!(node.text().unwrap_or("0").trim(), "0" | "false" | "") {
            let headline = "lip sync is switched off in these settings";
            let finding = Diagnostic::at(Code::LipSyncDisabled, whole(node), headline);
            findings.push(finding.help("look at the profile before you use it: LipSyncEnabled is 0"));
        }
    }

    /// The value, if it has one of these types.
    fn of_type(&self, types: &[&str], expected: &str, findings: &mut Findings) -> Option<Node<'d, 'd>> {
        match self.node {
            Some(node) if types.iter().any(|name| node.has_tag_name(*name)) => return Some(node),
            Some(node) => {
                let found = show::text(node.tag_name().name()).into_owned();
                let headline = format!("`{}` is not {expected}, but of type {found}", self.name);
                let finding = Diagnostic::at(Code::ViewerSettingType, start_tag(node), headline);
                findings.push(finding.help(format!("the viewer writes <{}>", types.join("> or <"))));
            }
            None => {
                let headline = format!("`{}` has no value", self.name);
                let finding = Diagnostic::at(Code::ViewerSettingType, whole(self.key), headline);
                findings
                    .push(finding.help("a setting is a <map> with the <key>Value</key>; remove it for the default"));
            }
        }
        None
    }
}

fn whole(node: Node<'_, '_>) -> Span {
    span(node.range())
}

/// `<map` of an element that may be long.
fn start_tag(node: Node<'_, '_>) -> Span {
    let start = node.range().start;
    Span::new(start, start + 1 + node.tag_name().name().len())
}

fn span(range: Range<usize>) -> Span {
    Span::new(range.start, range.end)
}

/// The byte at a line and a column.
fn offset(text: &str, place: TextPos) -> usize {
    let before = text.split_inclusive('\n').take(place.row.saturating_sub(1) as usize).map(str::len).sum::<usize>();
    let line = text.get(before..).unwrap_or("");
    before + line.chars().take(place.col.saturating_sub(1) as usize).map(char::len_utf8).sum::<usize>()
}
