//! Second Life: the lip-sync settings in a viewer's `settings.xml`, which is LLSD, an XML format of typed maps.

use crate::{source, xml};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::digits::Digits;
use lipz_file::rate::{self, Rate};
use roxmltree::{Document, Node};

/// The lip-sync settings of a viewer that were changed by the user. `None` stands for the viewer's default.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct LipSync {
    /// The loop for the lips, `LipSyncOoh`.
    pub ooh: Option<Digits>,
    /// The loop for the jaw, `LipSyncAah`.
    pub aah: Option<Digits>,
    /// The power transfer of the lips, `LipSyncOohPowerTransfer`.
    pub ooh_power_transfer: Option<Digits>,
    /// The power transfer of the jaw, `LipSyncAahPowerTransfer`.
    pub aah_power_transfer: Option<Digits>,
    /// Digits per second, 1 to 1000, `LipSyncOohAahRate`.
    pub rate: Option<Rate>,
}

/// Reads the lip-sync settings in the `settings.xml` of a viewer; `None` if it is not LLSD. Invalid settings are
/// reported and left at `None`. Messages refer to the file as `name`.
///
/// ```
/// let file = br#"<llsd><map>
///     <key>LipSyncOoh</key><map><key>Value</key><string>0123</string></map>
/// </map></llsd>"#;
/// let mut diagnostics = Vec::new();
/// let settings = lipz_interop::second_life::lip_sync(file, "settings.xml", &mut diagnostics).ok_or("no settings")?;
/// assert_eq!(settings.ooh.map(|digits| digits.to_string()), Some("0123".to_owned()));
/// assert!(settings.aah.is_none() && diagnostics.is_empty());
/// # Ok::<(), &str>(())
/// ```
pub fn lip_sync(bytes: &[u8], name: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<LipSync> {
    let text = source::text(bytes, diagnostics)?;
    if let Some(diagnostic) = xml::too_costly(text, Code::ViewerSettingsSyntax) {
        diagnostics.push(diagnostic.help(WHICH_FILE));
        return None;
    }
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(error) => {
            let (what, span) = xml::mistake(text, &error);
            let message = format!("{} is not XML: {what}", escape::quoted(name));
            diagnostics.push(Diagnostic::at(Code::ViewerSettingsSyntax, span, message).help(WHICH_FILE));
            return None;
        }
    };
    let settings = settings(&document, name, diagnostics)?;
    let mut digits = |key| settings.value(key).and_then(|value| value.digits(diagnostics));
    let mut lip_sync = LipSync {
        ooh: digits("LipSyncOoh"),
        aah: digits("LipSyncAah"),
        ooh_power_transfer: digits("LipSyncOohPowerTransfer"),
        aah_power_transfer: digits("LipSyncAahPowerTransfer"),
        rate: None,
    };
    lip_sync.rate = settings.value("LipSyncOohAahRate").and_then(|value| value.rate(diagnostics));
    if !settings.has_any() {
        let message = format!("{} has no lip sync settings", escape::quoted(name));
        let diagnostic = Diagnostic::new(Code::NoLipSyncSettings, message);
        diagnostics.push(diagnostic.note("the profile has the viewer's defaults").help(WHICH_FILE));
    }
    if let Some(enabled) = settings.value("LipSyncEnabled") {
        enabled.check_enabled(diagnostics);
    }
    diagnostics.sort_by_key(Diagnostic::start);
    Some(lip_sync)
}

const WHICH_FILE: &str = "name settings.xml in the folder user_settings of the viewer";

/// Returns the map of settings in an LLSD document.
fn settings<'d>(document: &'d Document<'d>, name: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<Map<'d>> {
    let root = document.root_element();
    let mut refuse = |node: Node<'_, '_>, what: &str| {
        let message =
            format!("{} is not LLSD: {what} <{}>", escape::quoted(name), escape::text(node.tag_name().name()));
        let diagnostic = Diagnostic::at(Code::ViewerSettingsSyntax, start_tag(node), message);
        diagnostics.push(diagnostic.help(WHICH_FILE));
    };
    if !root.has_tag_name("llsd") {
        refuse(root, "it starts with");
        return None;
    }
    let map = root.children().find(Node::is_element);
    match map {
        Some(map) if map.has_tag_name("map") => Some(Map(map)),
        _ => {
            refuse(map.unwrap_or(root), "no <map> of settings in");
            None
        }
    }
}

/// An LLSD map: keys, each followed by its value.
struct Map<'d>(Node<'d, 'd>);

impl<'d> Map<'d> {
    fn key(&self, name: &str) -> Option<Node<'d, 'd>> {
        self.0.children().find(|node| node.has_tag_name("key") && node.text().map(str::trim) == Some(name))
    }

    /// Whether there is a lip-sync setting.
    fn has_any(&self) -> bool {
        let is_key = |node: &Node<'_, '_>| node.has_tag_name("key");
        let mut keys = self.0.children().filter(is_key).filter_map(|key| key.text());
        keys.any(|key| key.trim().starts_with("LipSync"))
    }

    /// Returns the setting with this name. A setting is itself a map that contains a `Value`.
    fn value(&self, name: &'static str) -> Option<LlsdSetting<'d>> {
        let key = self.key(name)?;
        let setting = key.next_sibling_element();
        let map = setting.filter(|node| node.has_tag_name("map")).map(Map);
        let node = map.and_then(|map| map.key("Value")).and_then(|key| key.next_sibling_element());
        Some(LlsdSetting { name, key, node })
    }
}

/// The value of a setting.
struct LlsdSetting<'d> {
    name: &'static str,
    key: Node<'d, 'd>,
    /// The typed value, if there is one.
    node: Option<Node<'d, 'd>>,
}

impl<'d> LlsdSetting<'d> {
    fn digits(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<Digits> {
        let node = self.of_type(&["string"], "a string of digits", diagnostics)?;
        let text = node.text().unwrap_or("");
        let why = match Digits::parse(text) {
            Ok(digits) => return Some(digits),
            Err(why) => why,
        };
        // Without entities and the like, the text is unchanged in the file.
        let plain = node.first_child().filter(|child| child.range().len() == text.len());
        diagnostics.push(why.diagnostic(self.name, xml::whole(node), plain.map(|child| child.range().start)));
        None
    }

    fn rate(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<Rate> {
        let node = self.of_type(&["real", "integer"], "a number", diagnostics)?;
        let text = node.text().unwrap_or("0").trim();
        let rate = rate::parse(text);
        if rate.is_none() {
            let message = format!("`{}` is outside 1 to 1000", self.name);
            let diagnostic = Diagnostic::at(Code::BabbleRate, xml::whole(node), message);
            diagnostics.push(diagnostic.help("write digits per second; the viewer uses 24"));
        }
        rate
    }

    /// Warns if lip sync is off.
    fn check_enabled(&self, diagnostics: &mut Vec<Diagnostic>) {
        let Some(node) = self.of_type(&["integer", "boolean"], "0 or 1", diagnostics) else { return };
        if matches!(node.text().unwrap_or("0").trim(), "0" | "false" | "") {
            let message = "lip sync is off in these settings";
            let diagnostic = Diagnostic::at(Code::LipSyncDisabled, xml::whole(node), message);
            diagnostics.push(diagnostic.help("check the profile before you use it, or set LipSyncEnabled to 1"));
        }
    }

    /// Returns the value, if it has one of these types.
    fn of_type(&self, types: &[&str], expected: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<Node<'d, 'd>> {
        match self.node {
            Some(node) if types.iter().any(|name| node.has_tag_name(*name)) => return Some(node),
            Some(node) => {
                let found = escape::text(node.tag_name().name()).into_owned();
                let message = format!("`{}` has the type {found}, but must be {expected}", self.name);
                let diagnostic = Diagnostic::at(Code::ViewerSettingType, start_tag(node), message);
                diagnostics.push(diagnostic.help(format!("write <{}>, as the viewer does", types.join("> or <"))));
            }
            None => {
                let message = format!("`{}` has no value", self.name);
                let diagnostic = Diagnostic::at(Code::ViewerSettingType, xml::whole(self.key), message);
                diagnostics.push(
                    diagnostic.help("write a <map> with the <key>Value</key>, or remove the setting for its default"),
                );
            }
        }
        None
    }
}

/// Returns the span of a start tag without attributes: `<map` of an element that may be long.
fn start_tag(node: Node<'_, '_>) -> Span {
    let range = node.range();
    let element = node.document().input_text().get(range.clone()).unwrap_or_default();
    let length = element.find(|c: char| c.is_whitespace() || matches!(c, '/' | '>')).unwrap_or(element.len());
    Span::new(range.start, range.start + length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_an_element_is_marked_with_its_prefix() {
        for (file, marked) in
            [("<a:灯 xmlns:a='b'/>", "<a:灯"), ("<llsd><array/></llsd>", "<array"), ("<灯></灯>", "<灯")]
        {
            let mut found = Vec::new();
            assert_eq!(lip_sync(file.as_bytes(), "settings.xml", &mut found), None);
            let span = found.first().and_then(|found| found.primary.as_ref()).map(|label| label.span.range());
            assert_eq!(span.and_then(|range| file.get(range)), Some(marked));
        }
    }

    #[test]
    fn names_of_files_are_shown_without_what_steers_a_terminal() {
        for file in ["<", "<a/>", "<llsd/>"] {
            let mut found = Vec::new();
            assert_eq!(lip_sync(file.as_bytes(), "\u{1b}[2J.xml", &mut found), None);
            let message = found.first().map(|found| found.message.as_str()).unwrap_or_default();
            assert!(message.starts_with("`\\u001B[2J.xml` is not "), "{message}");
        }
    }

    #[test]
    fn mistakes_at_the_end_and_in_letters_of_many_bytes_are_in_the_file() {
        for file in ["", "<", "<llsd>é", "<llsd>\n灯<é", "\u{feff}<llsd", "<llsd></灯>"] {
            let mut found = Vec::new();
            assert_eq!(lip_sync(file.as_bytes(), "settings.xml", &mut found), None);
            let text = file.trim_start_matches('\u{feff}');
            let span = found.first().and_then(|found| found.primary.as_ref()).map(|label| label.span.range());
            assert!(span.is_some_and(|range| text.get(range).is_some()), "{file}: {found:?}");
        }
    }
}
