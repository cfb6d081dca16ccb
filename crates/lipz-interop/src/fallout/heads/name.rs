//! Names of the FRM files of a head: root, disposition, content, number.

use super::Disposition;

/// The form of a name, for messages.
pub(super) const FORM: &str = "names are root, disposition (g, n, b) and content (f with a number, g, n, b, p, v): \
                               `eldergp.frm` contains Elder's mouth shapes for a good disposition";

/// The extension of the files.
const EXTENSION: &str = "frm";

/// The content of a file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Content {
    /// Blinking or nodding: shown at random, numbered from 1.
    Fidget(u32),
    /// The transition to a different disposition.
    Transition(Disposition),
    /// The mouth shapes.
    Phonemes,
    /// Letter `v`, which the game accepts but none of its files uses.
    Unused,
}

/// The parsed name of an FRM file of a head.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct HeadFile {
    /// The name of the head, in lower case.
    pub root: String,
    /// The disposition for which it is shown.
    pub disposition: Disposition,
    /// The content.
    pub content: Content,
}

impl HeadFile {
    /// Parses the name of a file; `None` if it cannot belong to a head.
    ///
    /// ```
    /// use lipz_interop::fallout::heads::{Content, Disposition, HeadFile};
    /// let file = HeadFile::parse("ELDERNF2.FRM").ok_or("not a name")?;
    /// assert_eq!((file.root.as_str(), file.disposition), ("elder", Disposition::Neutral));
    /// assert_eq!(file.content, Content::Fidget(2));
    /// assert_eq!(HeadFile::parse("elderxp.frm"), None);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn parse(name: &str) -> Option<HeadFile> {
        let name = name.to_ascii_lowercase();
        let (stem, extension) = name.rsplit_once('.')?;
        let letters = stem.trim_end_matches(|c: char| c.is_ascii_digit());
        let number = stem.get(letters.len()..)?;
        let mut from_the_end = letters.chars();
        let (content, disposition) = (from_the_end.next_back()?, from_the_end.next_back()?);
        let root = from_the_end.as_str();
        let disposition = Disposition::of_letter(disposition)?;
        if extension != EXTENSION || root.is_empty() {
            return None;
        }
        let content = match (content, number) {
            ('f', number) => Content::Fidget(fidget(number)?),
            (_, "") => Content::from_letter(content, disposition)?,
            _ => return None,
        };
        Some(HeadFile { root: root.to_owned(), disposition, content })
    }

    /// Returns the name of the file, in lower case.
    pub fn file_name(&self) -> String {
        let HeadFile { root, disposition, content } = self;
        let disposition = disposition.letter();
        let content = match content {
            Content::Fidget(number) => format!("f{number}"),
            Content::Transition(to) => to.letter().to_string(),
            Content::Phonemes => "p".into(),
            Content::Unused => "v".into(),
        };
        format!("{root}{disposition}{content}.{EXTENSION}")
    }
}

/// Parses the number of a fidget file, which starts at 1 and has no leading zero.
fn fidget(number: &str) -> Option<u32> {
    number.parse().ok().filter(|_| !number.starts_with('0'))
}

impl Content {
    /// Returns the content with this letter. There is no transition between good and bad.
    fn from_letter(letter: char, disposition: Disposition) -> Option<Content> {
        match (letter, disposition) {
            ('p', _) => Some(Content::Phonemes),
            ('v', Disposition::Good | Disposition::Bad) => Some(Content::Unused),
            ('n', Disposition::Good | Disposition::Bad) | ('g' | 'b', Disposition::Neutral) => {
                Disposition::of_letter(letter).map(Content::Transition)
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_suffixes_of_the_document() {
        for suffix in ["gv", "gf1", "gn", "ng", "nf1", "nb", "bn", "bf10", "bv", "gp", "np", "bp"] {
            let name = format!("myron{suffix}.frm");
            let file = HeadFile::parse(&name);
            assert_eq!(file.as_ref().map(HeadFile::file_name), Some(name));
        }
    }

    #[test]
    fn other_names() {
        let others = [
            "gp.frm",
            "myronnv.frm",
            "myrongb.frm",
            "myronnn.frm",
            "myrongf.frm",
            "myrongf0.frm",
            "myrongf01.frm",
            "myrongp1.frm",
            "myrongp.fr0",
            "myrongp",
            "myrongf99999999999.frm",
            ".frm",
            "élèveg",
            "1.frm",
            "",
        ];
        for name in others {
            assert_eq!(HeadFile::parse(name), None, "{name}");
        }
    }
}
