//! Mapping tables between the symbols of a tool, such as `MBP`, and Lipz codes.
//!
//! Publishers disagree about them, so they are data: files in `maps/`, each with its source and a version. A project
//! can override them with its own file.

mod built_in;
mod read;

pub use built_in::{built_in, file, find};

use lipz_diagnostics::suggest;
use lipz_types::VisemeType;

/// A mapping table.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Map {
    /// The name, `rhubarb`.
    pub name: String,
    /// The version, which increases when a row changes.
    pub version: u32,
    /// A sentence that describes the symbols.
    pub about: String,
    /// The source of the rows.
    pub source: String,
    /// The viseme type of its codes.
    pub viseme_type: VisemeType,
    /// The symbols whose codes no publication of the source defines.
    pub guessed: Vec<String>,
    /// Whether case is ignored in symbols.
    pub ignores_case: bool,
    /// Each symbol with its code, in the order of the file.
    to_lipz: Vec<(String, u8)>,
    /// The symbol that is written for each code.
    from_lipz: Vec<(u8, String)>,
}

impl Map {
    /// Returns the code for a symbol.
    pub fn code(&self, symbol: &str) -> Option<u8> {
        let same = |known: &str| known == symbol || (self.ignores_case && known.eq_ignore_ascii_case(symbol));
        self.to_lipz.iter().find(|(known, _)| same(known)).map(|(_, code)| *code)
    }

    /// Returns the symbol for a code.
    pub fn symbol(&self, code: u8) -> Option<&str> {
        self.from_lipz.iter().find(|(known, _)| *known == code).map(|(_, symbol)| symbol.as_str())
    }

    /// Returns every symbol with its code, in the order of the table.
    pub fn symbols(&self) -> impl Iterator<Item = (&str, u8)> {
        self.to_lipz.iter().map(|(symbol, code)| (symbol.as_str(), *code))
    }

    /// Returns every code with the symbol that is written for it.
    pub fn codes(&self) -> impl Iterator<Item = (u8, &str)> {
        self.from_lipz.iter().map(|(code, symbol)| (*code, symbol.as_str()))
    }

    /// Returns the symbol that an author who wrote `written` probably meant.
    pub fn nearest(&self, written: &str) -> Option<&str> {
        suggest::nearest(written, self.symbols().map(|(symbol, _)| symbol))
    }

    /// Whether every symbol has its own code, and survives a round trip.
    pub fn is_lossless(&self) -> bool {
        self.symbols().all(|(symbol, code)| self.symbol(code) == Some(symbol))
    }

    /// Whether every code of the viseme type has a symbol and survives a round trip.
    pub fn keeps_codes(&self) -> bool {
        let comes_back = |code: u8| self.symbol(code).and_then(|symbol| self.code(symbol)) == Some(code);
        self.viseme_type.codes().bytes().all(comes_back)
    }

    /// Returns the label of the table in reports: `rhubarb 1`.
    pub fn label(&self) -> String {
        format!("{} {}", self.name, self.version)
    }
}
