//! Conversion of a Lipz document to a track in the symbols of another tool, and to its file.

use crate::import::{REST, element};
use crate::textgrid::Tier;
use crate::{Format, Map, Shape, Text, Time, TimedText, Track, map};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::locale::{TextName, text_name};
use lipz_file::rate::Rate;
use lipz_file::text::{DELIMITER, is_white_space};
use lipz_file::{Document, Element, Value, curve, phones};
use lipz_types::VisemeType;

/// The options of an export.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct ExportOptions<'a> {
    /// The table to use instead of the one of the format.
    pub map: Option<&'a Map>,
    /// The frame rate of files without `fps`.
    pub default_rate: Option<Rate>,
    /// The viseme type of files without `viseme_type`.
    pub default_viseme_type: Option<VisemeType>,
    /// The name of the exported file, without folders and extension, for formats that store it.
    pub name: Option<&'a str>,
    /// The number of the first frame in Moho files, 0 or 1.
    pub dat_base: u64,
    /// Additional tiers of a TextGrid, with the times of words and phones.
    pub tiers: &'a [Tier],
}

impl Default for ExportOptions<'_> {
    fn default() -> Self {
        ExportOptions { map: None, default_rate: None, default_viseme_type: None, name: None, dat_base: 1, tiers: &[] }
    }
}

/// Setters; each takes a value or an `Option`.
impl<'a> ExportOptions<'a> {
    /// Returns the default options.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the table to use instead of the one of the format.
    #[must_use]
    pub fn map(self, map: impl Into<Option<&'a Map>>) -> Self {
        ExportOptions { map: map.into(), ..self }
    }

    /// Sets the frame rate of files without `fps`.
    #[must_use]
    pub fn default_rate(self, default_rate: impl Into<Option<Rate>>) -> Self {
        ExportOptions { default_rate: default_rate.into(), ..self }
    }

    /// Sets the viseme type of files without `viseme_type`.
    #[must_use]
    pub fn default_viseme_type(self, default_viseme_type: impl Into<Option<VisemeType>>) -> Self {
        ExportOptions { default_viseme_type: default_viseme_type.into(), ..self }
    }

    /// Sets the number of the first frame in Moho files, 0 or 1.
    #[must_use]
    pub fn dat_base(self, dat_base: u64) -> Self {
        ExportOptions { dat_base, ..self }
    }

    /// Sets the name of the exported file, without folders and extension.
    #[must_use]
    pub fn name(self, name: impl Into<Option<&'a str>>) -> Self {
        ExportOptions { name: name.into(), ..self }
    }

    /// Sets the additional tiers of a TextGrid.
    #[must_use]
    pub fn tiers(self, tiers: &'a [Tier]) -> Self {
        ExportOptions { tiers, ..self }
    }
}

/// The result of an export.
#[derive(Debug, Default)]
#[non_exhaustive]
pub struct ExportResult {
    /// The file; `None` if a diagnostic is an error.
    pub bytes: Option<Vec<u8>>,
    /// The table that was used: `rhubarb 1`.
    pub map: String,
    /// The parts of the clip that the format cannot store, such as `texts`.
    pub left_out: Vec<&'static str>,
    /// The problems and losses.
    pub diagnostics: Vec<Diagnostic>,
}

/// Writes a Lipz document in a format of another tool.
pub fn export(format: &Format, document: &Document<'_>, options: &ExportOptions<'_>) -> ExportResult {
    let mut exported = ExportResult::default();
    let diagnostics = &mut exported.diagnostics;
    let Some(write) = format.write else { return exported };
    let Some((track, map)) = track(format, document, options, diagnostics) else { return exported };
    exported.left_out = left_out(document, format.keeps_texts, options.tiers);
    exported.map = map.label();
    exported.bytes = Some(write(&track, &mut exported.diagnostics));
    exported
}

/// Returns the document as a track in the symbols of the format, and the mapping table used.
fn track<'m>(
    format: &Format,
    document: &Document<'_>,
    options: &ExportOptions<'m>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<(Track, &'m Map)> {
    let Some(visemes) = document.string("visemes") else {
        diagnostics.push(refusal("the clip has no mouth shapes").help("export clips with \"visemes\""));
        return None;
    };
    let codes: Vec<u8> = visemes
        .chars()
        .filter(|&c| c != DELIMITER && !is_white_space(c))
        .map(|c| u8::try_from(c).unwrap_or(0))
        .collect();
    let Some(rate) = rate(document).or(options.default_rate) else {
        diagnostics.push(
            refusal("the clip has no frame rate").help("add \"fps\" to the file, or set `default-fps` in lipz.toml"),
        );
        return None;
    };
    let viseme_type = viseme_type(document, &codes, options);
    let of_format = || format.maps.iter().filter_map(|name| map::find(name));
    let fits = |map: &&Map| Some(map.viseme_type) == viseme_type && map.viseme_type.contains_all(&codes);
    let Some(map) = options.map.filter(fits).or_else(|| of_format().find(fits).filter(|_| options.map.is_none()))
    else {
        let name = viseme_type.map_or("of an unknown viseme type", VisemeType::name);
        let message = format!("`{}` has no mapping table for the codes of the clip, which are {name}", format.name);
        diagnostics.push(refusal(message).help(match viseme_type {
            Some(VisemeType::Rms) => {
                "export clips of the types blair and toonboom; loudness (rms) is not a mouth shape"
            }
            _ => "convert the clip to blair or toonboom first",
        }));
        return None;
    };
    let mut shapes: Vec<Shape> = Vec::new();
    for (frame, run) in runs(&codes) {
        let Some(symbol) = map.symbol(run) else {
            let message = format!("`{}` has no symbol for the code `{}`", map.name, char::from(run));
            diagnostics.push(refusal(message).help("use a mapping table that has it"));
            return None;
        };
        shapes.push(Shape::new(Time::of_frame(frame, rate), symbol));
    }
    report_merged(&codes, map, diagnostics);
    let end = Some(Time::of_frame(codes.len() as u64, rate));
    let (name, phrases) = (options.name.map(str::to_owned), segments(visemes, rate));
    let rest = map.symbol(REST).map(str::to_owned);
    let (texts, elements) = if format.keeps_texts { divided(document) } else { Default::default() };
    let (first_frame, tiers) = (options.dat_base, options.tiers.to_vec());
    let track = Track {
        tiers,
        name,
        shapes,
        end,
        rate: Some(rate),
        first_frame,
        rest,
        phrases,
        texts,
        elements,
        ..Track::default()
    };
    Some((Track { map: map::find(&map.name).map(|map| map.name.as_str()), ..track }, map))
}

/// Returns the texts and the events of a document.
fn divided(document: &Document<'_>) -> (Vec<Text>, Vec<Element<'static>>) {
    let (mut texts, mut elements) = (Vec::new(), Vec::new());
    for Element { name, value } in &document.elements {
        let Value::String(string) = value else { continue };
        if let Some(TextName::Canonical(locale)) = text_name(&name.text) {
            texts.push(Text { locale: Some(locale), text: string.text.to_string() });
        } else if name.text == "events" {
            elements.push(element(&name.text, string.text.to_string()));
        }
    }
    (texts, elements)
}

/// Returns the starts of the segments. Formats of mouth shapes cannot store their texts.
fn segments(visemes: &str, rate: Rate) -> Vec<TimedText> {
    let mut frame = 0;
    let of_segment = |codes: &str| {
        let start = Time::of_frame(frame, rate);
        frame += codes.chars().filter(|&c| !is_white_space(c)).count() as u64;
        TimedText { start, text: String::new() }
    };
    visemes.split(DELIMITER).map(of_segment).collect()
}

/// Returns the diagnostic for a clip that cannot be exported.
pub(crate) fn refusal(message: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Code::NotExportable, message)
}

/// Returns the frame rate of a document, if it has one.
pub(crate) fn rate(document: &Document<'_>) -> Option<Rate> {
    match &document.get("fps")?.value {
        Value::Number(number) => lipz_file::rate::parse(&number.text),
        _ => None,
    }
}

/// Returns the type of the codes: from the file, the project's default, or the first type that contains them all.
fn viseme_type(document: &Document<'_>, codes: &[u8], options: &ExportOptions<'_>) -> Option<VisemeType> {
    match document.string("viseme_type") {
        Some(name) => name.parse::<VisemeType>().ok(),
        None => options
            .default_viseme_type
            .or_else(|| VisemeType::ALL.into_iter().find(|viseme_type| viseme_type.contains_all(codes))),
    }
}

/// Returns the first frame and the code of each run of equal codes.
pub(crate) fn runs(codes: &[u8]) -> impl Iterator<Item = (u64, u8)> {
    let mut frame = 0;
    codes.chunk_by(|a, b| a == b).map(move |run| {
        let start = frame;
        frame += run.len() as u64;
        (start, run.first().copied().unwrap_or(REST))
    })
}

/// Reports codes that change in a round trip, because they share a symbol.
fn report_merged(codes: &[u8], map: &Map, diagnostics: &mut Vec<Diagnostic>) {
    for code in map.viseme_type.codes().bytes() {
        let frames = codes.iter().filter(|&&other| other == code).count();
        let Some(symbol) = map.symbol(code).filter(|_| frames > 0) else { continue };
        if let Some(back) = map.code(symbol).filter(|&back| back != code) {
            let (code, back) = (char::from(code), char::from(back));
            let message = format!("{frames} frames of `{code}` are written as `{symbol}`, which means `{back}`");
            diagnostics.push(
                Diagnostic::new(Code::ExportLoss, message)
                    .note(format!("the mapping table `{}` has no separate symbol for `{code}`", map.name)),
            );
        }
    }
}

/// Returns the parts of the document that a format of mouth shapes cannot store, with these additional tiers.
fn left_out(document: &Document<'_>, keeps_texts: bool, tiers: &[Tier]) -> Vec<&'static str> {
    let has = |is: &dyn Fn(&str) -> bool| document.elements.iter().any(|element| is(&element.name.text));
    let is_text = |name: &str| text_name(name).is_some();
    let is_known = |name: &str| {
        matches!(name, "visemes" | "viseme_type" | "fps" | "events" | phones::ELEMENT | curve::ELEMENT) || is_text(name)
    };
    let is_divided = document.string("visemes").is_some_and(|visemes| visemes.contains(DELIMITER));
    let has_phone_tier = tiers.iter().any(|tier| tier.name == phones::ELEMENT);
    let parts: [(&'static str, bool); 6] = [
        ("segments", is_divided && !keeps_texts),
        ("texts", has(&is_text) && !keeps_texts),
        ("events", document.get("events").is_some() && !keeps_texts),
        ("phones", document.get(phones::ELEMENT).is_some() && !has_phone_tier),
        ("curves", document.get(curve::ELEMENT).is_some()),
        ("unknown elements", has(&|name| !is_known(name))),
    ];
    parts.into_iter().filter(|(_, is_there)| *is_there).map(|(what, _)| what).collect()
}
