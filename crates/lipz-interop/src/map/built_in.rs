//! The built-in mapping tables.

use super::Map;
use std::sync::LazyLock;

macro_rules! tables {
    ($($name:literal)+) => {
        /// The files, from `maps/`.
        const FILES: &[(&str, &str)] = &[$(($name, include_str!(concat!("../../maps/", $name, ".toml")))),+];
    };
}

tables! {
    "arkit"
    "arpabet-blair"
    "azure"
    "blair"
    "bohemia"
    "cmu"
    "fallout"
    "fleming-dobbs"
    "ipa"
    "kotor"
    "ovr"
    "papagayo"
    "polly"
    "polly-languages"
    "rhubarb"
    "rhubarb-toonboom"
    "rms"
    "toonboom"
    "vrm"
    "xsampa"
}

static TABLES: LazyLock<Vec<Map>> =
    LazyLock::new(|| FILES.iter().filter_map(|(_, text)| Map::parse(text).ok()).collect());

/// Returns the built-in mapping tables, sorted by name.
pub fn built_in() -> &'static [Map] {
    &TABLES
}

/// Returns the built-in mapping table with this name.
pub fn find(name: &str) -> Option<&'static Map> {
    TABLES.iter().find(|map| map.name == name)
}

/// Returns the file of a built-in mapping table, as a starting point for a custom one.
pub fn file(name: &str) -> Option<&'static str> {
    FILES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn every_file_is_a_table_of_its_name() {
        for (name, text) in FILES {
            assert_eq!(Map::parse(text).unwrap().name, *name);
        }
        assert_eq!(built_in().len(), FILES.len());
    }

    #[test]
    fn which_tables_lose_nothing() {
        let lossless: Vec<&str> = built_in()
            .iter()
            .filter(|map| map.is_lossless() && map.keeps_codes())
            .map(|map| map.name.as_str())
            .collect();
        assert_eq!(lossless, ["blair", "papagayo", "toonboom"]);
    }

    #[test]
    fn what_is_written_is_read_as_the_same_code() {
        for map in built_in() {
            for (code, symbol) in map.codes() {
                let back = map.code(symbol);
                assert!(back.is_some(), "{}: {symbol}", map.name);
                // Codes may share a symbol. The code for which the symbol stands is among them.
                let reads_as = back.unwrap();
                assert_eq!(map.symbol(reads_as), Some(symbol), "{}: {}", map.name, char::from(code));
            }
        }
    }
}
