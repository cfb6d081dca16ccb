//! Mapping tables between the symbols of a tool, such as `MBP`, and Lipz codes.
//!
//! Publishers disagree about them, so they are data: files in `maps/`, each with its source and a version. A project
//! can override them with its own file.

mod built_in;
mod read;

pub use built_in::{built_in, file, find};

use lipz_diagnostics::suggest;
use lipz_types::{Phone, VisemeType};

/// A frequent phone for each code of the type `blair`.
const FREQUENT_PHONES: [(u8, &str); 10] = [
    (b'-', "sil"),
    (b'M', "M"),
    (b'F', "F"),
    (b'L', "L"),
    (b'S', "T"),
    (b'W', "W"),
    (b'U', "UW"),
    (b'O', "AO"),
    (b'A', "AA"),
    (b'E', "AX"),
];

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
    /// Whether the symbols are names of phones, in ARPAbet or the letters of the IPA.
    names_phones: bool,
    /// The phones of other symbols.
    to_phone: Vec<(String, Phone)>,
}

impl Map {
    /// Returns the code for a symbol.
    pub fn code(&self, symbol: &str) -> Option<u8> {
        self.to_lipz.iter().find(|(known, _)| self.is_same(known, symbol)).map(|(_, code)| *code)
    }

    /// Returns the phone for a symbol, if the symbols are phones or classes of phones: the one that the table
    /// `to-phone` lists, the one with the name of the symbol, or a frequent one with the same code.
    pub fn phone(&self, symbol: &str) -> Option<Phone> {
        if !self.has_phones() {
            return None;
        }
        let listed = || self.to_phone.iter().find(|(known, _)| self.is_same(known, symbol)).map(|(_, phone)| *phone);
        let named = || match self.ignores_case {
            true => symbol.to_ascii_uppercase().parse().ok(),
            false => symbol.parse().ok(),
        };
        let of_code = || {
            let code = self.code(symbol)?;
            FREQUENT_PHONES.into_iter().find(|(known, _)| *known == code)?.1.parse().ok()
        };
        listed().or_else(|| named().filter(|_| self.names_phones)).or_else(of_code)
    }

    /// Whether the symbols are phones, or classes of phones.
    pub fn has_phones(&self) -> bool {
        self.names_phones || !self.to_phone.is_empty()
    }

    fn is_same(&self, known: &str, symbol: &str) -> bool {
        known == symbol || (self.ignores_case && known.eq_ignore_ascii_case(symbol))
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
