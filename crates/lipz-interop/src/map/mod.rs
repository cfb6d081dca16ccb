//! Mapping tables: which Lipz code shows what a tool calls `MBP`, and the way back.
//!
//! Publishers disagree about them, so they are data: files in `maps/`, each with its source and a version,
//! which a project can override by a file of its own.

mod built_in;
mod read;

pub use built_in::{built_in, file, find};

use lipz_diagnostics::suggest;
use lipz_types::VisemeType;

/// A mapping table.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Map {
    /// What it is called, `rhubarb`.
    pub name: String,
    /// Counts up when a row changes.
    pub version: u32,
    /// What it maps, in a sentence.
    pub about: String,
    /// Where its rows come from.
    pub source: String,
    /// The viseme type of its codes.
    pub viseme_type: VisemeType,
    /// Symbols that no publication of the source settles.
    pub guessed: Vec<String>,
    /// Whether symbols are the same in upper and lower case.
    pub ignores_case: bool,
    /// Each symbol with its code, in the order of the file.
    to_lipz: Vec<(String, u8)>,
    /// The symbol that a code is written as.
    from_lipz: Vec<(u8, String)>,
}

impl Map {
    /// The code for a symbol.
    pub fn code(&self, symbol: &str) -> Option<u8> {
        let same = |known: &str| known == symbol || (self.ignores_case && known.eq_ignore_ascii_case(symbol));
        self.to_lipz.iter().find(|(known, _)| same(known)).map(|(_, code)| *code)
    }

    /// The symbol for a code.
    pub fn symbol(&self, code: u8) -> Option<&str> {
        self.from_lipz.iter().find(|(known, _)| *known == code).map(|(_, symbol)| symbol.as_str())
    }

    /// Every symbol with its code, in the order of the table.
    pub fn symbols(&self) -> impl Iterator<Item = (&str, u8)> {
        self.to_lipz.iter().map(|(symbol, code)| (symbol.as_str(), *code))
    }

    /// Every code with the symbol that it is written as.
    pub fn codes(&self) -> impl Iterator<Item = (u8, &str)> {
        self.from_lipz.iter().map(|(code, symbol)| (*code, symbol.as_str()))
    }

    /// The symbol that someone who wrote `written` probably meant.
    pub fn nearest(&self, written: &str) -> Option<&str> {
        suggest::nearest(written, self.symbols().map(|(symbol, _)| symbol))
    }

    /// Whether every symbol has a code of its own, and comes back from it.
    pub fn is_lossless(&self) -> bool {
        self.symbols().all(|(symbol, code)| self.symbol(code) == Some(symbol))
    }

    /// Whether every code of the viseme type has a symbol that comes back as that code.
    pub fn keeps_codes(&self) -> bool {
        let comes_back = |code: u8| self.symbol(code).and_then(|symbol| self.code(symbol)) == Some(code);
        self.viseme_type.codes().bytes().all(comes_back)
    }

    /// How reports name the table: `rhubarb 1`.
    pub fn label(&self) -> String {
        format!("{} {}", self.name, self.version)
    }
}
