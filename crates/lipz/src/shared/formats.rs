//! Formats of other tools: their names on the command line, mapping tables, and files.

use crate::Abort;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::format_examples::{Direction, example};
use crate::shared::input_file::{self, unreadable};
use crate::shared::stdio;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use lipz_bank::Fps;
use lipz_diagnostics::{Code, Diagnostic, Report, escape, suggest};
use lipz_file::rate::Rate;
use lipz_interop::{Encoding, Format, Map, find_map, formats, maps, to_utf8};
use std::path::{Path, PathBuf};

/// Returns a parser for format names on the command line.
pub(crate) fn parser(is_meant: fn(&Format) -> bool) -> impl TypedValueParser<Value = &'static Format> {
    let names = formats::ALL.iter().filter(|format| is_meant(format)).map(|format| format.name);
    PossibleValuesParser::new(names.collect::<Vec<_>>())
        .try_map(|name| formats::find(&name).ok_or("the format does not exist"))
}

/// Returns the formats with an example each, for the help.
pub(crate) fn examples(direction: Direction, is_meant: impl Fn(&Format) -> bool) -> String {
    let mut text = String::from("Formats, with Examples:\n");
    for format in formats::ALL.iter().filter(|format| is_meant(format)) {
        let line = example(format.name, direction).unwrap_or_default();
        text += &format!("\n  {}: {}\n  {line}\n", format.name, format.about);
    }
    text
}

/// Returns the names of the formats with one example, for the short help.
pub(crate) fn names(direction: Direction, is_meant: impl Fn(&Format) -> bool) -> String {
    let meant: Vec<&Format> = formats::ALL.iter().filter(|format| is_meant(format)).collect();
    let names = meant.iter().map(|format| format.name).collect::<Vec<_>>().join(", ");
    let line = meant.first().and_then(|format| example(format.name, direction)).unwrap_or_default();
    let names = textwrap::fill(&names, textwrap::Options::new(98).initial_indent("  ").subsequent_indent("  "));
    format!("Formats:\n{names}\n\nExample:\n  {line}")
}

/// A mapping table from the command line.
pub(crate) enum MapChoice {
    BuiltIn(&'static Map),
    OfFile(Box<Map>),
}

impl MapChoice {
    pub(crate) fn map(&self) -> &Map {
        match self {
            MapChoice::BuiltIn(map) => map,
            MapChoice::OfFile(map) => map,
        }
    }
}

/// Returns the mapping table with this name, or in this file.
pub(crate) fn map(named: &str, reporter: &mut Reporter) -> Result<MapChoice, Abort> {
    let path = Path::new(named);
    if let Some(map) = find_map(named).filter(|_| !path.is_file()) {
        return Ok(MapChoice::BuiltIn(map));
    }
    if !path.exists() {
        let message = format!("{} is neither a mapping table nor a file", escape::quoted(named));
        let known = suggest::nearest(named, maps().iter().map(|map| map.name.as_str()));
        let help = known
            .map_or("list the tables with `lipz print maps`".to_owned(), |known| format!("did you mean `{known}`?"));
        return Err(reporter.fail(Report::about("", Diagnostic::new(Code::MapRefused, message).help(help))));
    }
    let bytes = input_file::read(path).map_err(|error| {
        let message = format!("the mapping table {} cannot be read: {error}", escape::quoted(named));
        reporter.fail(Report::about(console::path(path), Diagnostic::new(Code::MapRefused, message)))
    })?;
    let mut diagnostics = Vec::new();
    let read = lipz_file::decode_marked(&bytes, &mut diagnostics).map(Map::parse);
    match read {
        Some(Ok(map)) => Ok(MapChoice::OfFile(Box::new(map))),
        Some(Err(found)) => Err(reporter.fail(Report::from_bytes(console::path(path), &bytes, found))),
        None => Err(reporter.fail(Report::from_bytes(console::path(path), &bytes, diagnostics))),
    }
}

/// Parses the name of an encoding from the command line.
pub(crate) fn encoding(name: &str) -> Result<&'static Encoding, String> {
    Encoding::for_label(name.as_bytes())
        .ok_or_else(|| "expected an encoding of the WHATWG standard, such as windows-1251".into())
}

/// Converts a rate from the command line to the spelling in Lipz files.
pub(crate) fn rate(fps: Fps) -> Rate {
    Rate { numerator: fps.numerator(), denominator: fps.denominator(), is_exact: true }
}

/// A file of another tool.
pub(crate) struct ToolFile {
    /// The file's name without its extension; below a root, its path relative to the root.
    pub(crate) key: String,
    /// The bytes, converted to UTF-8 if they are text.
    pub(crate) bytes: Vec<u8>,
    /// The problems of reading it.
    pub(crate) diagnostics: Vec<Diagnostic>,
    name: String,
}

impl ToolFile {
    /// Reads a file, or standard input.
    pub(crate) fn read(
        path: &Path,
        format: &Format,
        root: Option<&Path>,
        encoding: Option<&'static Encoding>,
    ) -> Result<ToolFile, Report> {
        let (key, bytes, name) = if stdio::is_meant(path) {
            (stdio::input_key(None), stdio::lipz_bytes()?, stdio::input_name())
        } else {
            let bytes = input_file::read(path).map_err(|error| unreadable(path, &error))?;
            (key_below(root, path, format.extension)?, bytes, console::path(path))
        };
        let mut diagnostics = Vec::new();
        let bytes = match format.is_binary {
            true => bytes,
            false => to_utf8(&bytes, encoding, format.is_legacy, &mut diagnostics).into_owned(),
        };
        Ok(ToolFile { key, bytes, diagnostics, name })
    }

    /// Returns the name of the file without folders and extension.
    pub(crate) fn stem(&self) -> &str {
        self.key.rsplit('/').next().unwrap_or(&self.key)
    }

    /// Returns the report about the file, if there are diagnostics.
    pub(crate) fn report(&self, format: &Format, diagnostics: Vec<Diagnostic>) -> Option<Report> {
        if diagnostics.is_empty() {
            return None;
        }
        Some(match format.is_binary {
            true => Report::all_about(self.name.clone(), diagnostics),
            false => Report::from_bytes(self.name.clone(), &self.bytes, diagnostics),
        })
    }
}

/// Returns the key of a file: its name without extension, or its path below the root.
pub(crate) fn key_below(root: Option<&Path>, path: &Path, extension: &str) -> Result<String, Report> {
    let Some(root) = root else { return Ok(stem(path, extension)) };
    let (shown, shown_root) = (console::path(path), console::path(root));
    let Ok(inside) = path.strip_prefix(root) else {
        let diagnostic = Diagnostic::new(Code::RefusedKey, format!("`{shown}` is not below the root `{shown_root}`"));
        return Err(Report::about(
            shown,
            diagnostic.help("write root and files both as relative or both as absolute paths"),
        ));
    };
    let folders = inside.parent().into_iter().flat_map(Path::components);
    let mut parts: Vec<String> = folders.map(|part| part.as_os_str().to_string_lossy().into_owned()).collect();
    parts.push(stem(path, extension));
    Ok(parts.join("/"))
}

/// Returns the name of a file without the extension of its format, or else without its last one.
pub(crate) fn stem(path: &Path, extension: &str) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let stem = name.len().checked_sub(extension.len() + 1).filter(|&stem| stem > 0);
    let of_format = stem.filter(|&stem| {
        name.get(stem..).is_some_and(|end| end.strip_prefix('.').is_some_and(|end| end.eq_ignore_ascii_case(extension)))
    });
    let stem = of_format.or_else(|| name.rfind('.').filter(|&stem| stem > 0)).unwrap_or(name.len());
    name.get(..stem).unwrap_or(&name).to_owned()
}

/// Converts a name from a file for use in a file name: letters and digits of any script, `-` for everything else.
pub(crate) fn file_name(name: &str) -> String {
    let safe: String = name.trim().chars().map(|c| if c.is_alphanumeric() || c == '_' { c } else { '-' }).collect();
    if safe.is_empty() { "unnamed".to_owned() } else { safe }
}

/// Returns the path for the clip with this key.
pub(crate) fn path(folder: &Path, key: &str, extension: &str) -> PathBuf {
    folder.join(format!("{key}.{extension}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_names_of_files_without_extension() {
        let keys = [
            ("in/mayor.tsv", "tsv", "mayor"),
            ("mayor.lipz.txt", "lipz.txt", "mayor"),
            ("mayor.take.2.JSON", "json", "mayor.take.2"),
            ("mayor.json.bak", "json", "mayor.json"),
            (".tsv", "tsv", ".tsv"),
            ("灯台", "tsv", "灯台"),
        ];
        for (path, extension, expected) in keys {
            assert_eq!(stem(Path::new(path), extension), expected);
        }
        assert_eq!(file_name(" Mara / 2 "), "Mara---2");
        let below = |root: &str, path: &str| key_below(Some(Path::new(root)), Path::new(path), "tsv").ok();
        assert_eq!(below("in", "in/act1/a.tsv").as_deref(), Some("act1/a"));
        assert_eq!(below(".", "./act1/a.tsv").as_deref(), Some("act1/a"));
        assert_eq!(below("in/", "in/a.tsv").as_deref(), Some("a"));
        assert_eq!(below("in", "out/a.tsv"), None);
    }
}
