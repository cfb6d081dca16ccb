//! Names of units for lipz-speech: the part of CLDR's names for units after numbers in texts.

use crate::Failure;
use crate::paths::{temporary_folder, workspace_root};
use crate::speech_numbers::fetched;
use serde_json::Value;
use std::collections::BTreeSet;

/// The package of the names.
const PACKAGE: &str = "cldr-units-full@48.2.0";
const LANGUAGES: &str = "bg ca cs de en es fi fr it ja ko nl pl pt ru tr uk zh";
/// Units, each with its language-independent symbols. The symbols of a language come from CLDR's short names.
const UNITS: &str = "\
mass-kilogram kg
mass-gram g
mass-milligram mg
mass-tonne t
mass-pound lb lbs
mass-ounce oz
length-kilometer km
length-meter m
length-centimeter cm
length-millimeter mm
length-mile mi
length-foot ft
length-yard yd
area-square-kilometer km²
area-square-meter m²
area-hectare ha
volume-cubic-meter m³
volume-liter l
volume-milliliter ml
speed-kilometer-per-hour km/h
speed-meter-per-second m/s
speed-mile-per-hour mph
temperature-celsius °C ℃
temperature-fahrenheit °F ℉
duration-hour h
duration-minute min
duration-second s
duration-millisecond ms
frequency-hertz Hz
frequency-kilohertz kHz
frequency-megahertz MHz
frequency-gigahertz GHz
power-kilowatt kW
digital-kilobyte kB KB
digital-megabyte MB
digital-gigabyte GB
digital-terabyte TB
";
/// The maximal number of characters in a symbol. Longer ones are words.
const LONGEST: usize = 6;

/// Makes `data/numbers/units.txt` of lipz-speech. The same package leads to the same bytes.
pub(crate) fn run() -> Result<(), Failure> {
    let folder = temporary_folder()?;
    let package = fetched(PACKAGE, folder.path())?;
    let mut text = format!("# Made of {PACKAGE} by `cargo xtask speech-units`. LICENSE-UNICODE is its licence.\n");
    for code in LANGUAGES.split(' ') {
        let path = package.join(format!("main/{code}/units.json"));
        let json = std::fs::read(&path).map_err(|error| format!("`{}`: {error}", path.display()))?;
        let json: Value = serde_json::from_slice(&json).map_err(|error| format!("`{}`: {error}", path.display()))?;
        text.push_str(&format!("@{code}\n{}", of_language(code, &json["main"][code]["units"])));
    }
    let target = workspace_root().join("crates/lipz-speech/data/numbers/units.txt");
    println!("units.txt: {} bytes", text.len());
    std::fs::write(target, text).map_err(|error| format!("`units.txt` cannot be written: {error}"))
}

/// Returns a line for each unit: its symbols, then a form for each category of numbers, in which `#` is the number.
fn of_language(code: &str, units: &Value) -> String {
    let universal: Vec<&str> = UNITS.lines().flat_map(|line| line.split(' ').skip(1)).collect();
    let mut known = BTreeSet::new();
    let mut lines = String::new();
    for line in UNITS.lines() {
        let mut names = line.split(' ');
        let key = names.next().unwrap_or_default();
        let form = |length: &str, category: &str| {
            let pattern = units[length][key][format!("unitPattern-count-{category}")].as_str();
            pattern.map(|pattern| pattern.replace("{0}", "#").replace(['\u{a0}', '\u{202f}'], " "))
        };
        let other = form("long", "other").unwrap_or_default();
        let others = categories(code).iter().filter_map(|category| Some((category, form("long", category)?)));
        let others = others.filter(|(_, form)| *form != other).map(|(category, form)| format!("{category}{{{form}}}"));
        let forms: String = others.chain([format!("other{{{other}}}")]).collect();
        let own = form("short", "other").unwrap_or_default().replace('#', "").trim().to_owned();
        let own = Some(own).filter(|own| is_symbol(own) && !universal.contains(&own.as_str()));
        let symbols = names.map(str::to_owned).chain(own).filter(|symbol| known.insert(symbol.clone()));
        let symbols: Vec<String> = symbols.collect();
        if !symbols.is_empty() {
            lines.push_str(&format!("{} {forms}\n", symbols.join(" ")));
        }
    }
    lines
}

/// Returns the categories of whole numbers that lipz-speech distinguishes.
fn categories(code: &str) -> &'static [&'static str] {
    match code {
        "pl" | "ru" | "uk" => &["one", "few", "many"],
        "cs" => &["one", "few"],
        _ => &["one"],
    }
}

/// Whether a short name is a symbol in Latin or Cyrillic letters. Other scripts need none, because their words follow
/// numbers without a space. A single Latin letter is too ambiguous.
fn is_symbol(name: &str) -> bool {
    let is_letter = |c: char| c.is_alphabetic() && (c < '\u{250}' || ('\u{400}'..='\u{52f}').contains(&c));
    let fits = name.chars().all(|c| is_letter(c) || "./²³°".contains(c)) && name.chars().count() <= LONGEST;
    let is_one_latin = name.chars().count() == 1 && name.chars().all(|c| c < '\u{400}');
    fits && !name.is_empty() && !is_one_latin
}
