//! `heads.lst`: one line per head, with the counts of its fidget files.

use super::{Content, Disposition, HeadFile};
use lipz_diagnostics::{Code, Diagnostic, Severity, Span};

/// A line of `heads.lst`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Head {
    /// The start of the names of its files, in lower case.
    pub root: String,
    /// The numbers of fidget files for a good, a neutral and a bad disposition.
    pub fidgets: [u32; 3],
    /// The position of the line.
    pub span: Span,
}

/// More fidget files than any head has. A greater number is a typing error.
const MOST_FIDGETS: u32 = 1000;

/// Reads `heads.lst`: `ROOT,X,Y,Z` or, as in the game's documentation, `ROOT X, Y, Z`. Text after the last number is a
/// comment. The game also numbers empty lines, so one between others is reported.
///
/// Invalid lines and repeated roots are reported and skipped.
///
/// ```
/// let (heads, diagnostics) = lipz_interop::fallout::heads::read_list("myron,2,3,1\n");
/// assert_eq!((heads[0].root.as_str(), heads[0].fidgets), ("myron", [2, 3, 1]));
/// assert!(diagnostics.is_empty());
/// ```
pub fn read_list(text: &str) -> (Vec<Head>, Vec<Diagnostic>) {
    let (mut heads, mut found) = (Vec::<Head>::new(), Vec::new());
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let written = line.trim_end();
        let span = Span::new(start, start + written.len());
        start += line.len();
        if written.is_empty() {
            if !text.get(start..).unwrap_or_default().trim().is_empty() {
                let mut diagnostic = Diagnostic::at(Code::HeadsList, span, "an empty line counts as a head")
                    .note("the game numbers heads by their lines")
                    .help("remove the line, or write `reser` to keep the number free");
                diagnostic.severity = Severity::Warning;
                found.push(diagnostic);
            }
            continue;
        }
        let Some((root, fidgets)) = parse_line(written) else {
            found.push(Diagnostic::at(Code::HeadsList, span, "the line does not name a head and three numbers").help(
                "write `ROOT,X,Y,Z`: the start of its file names, and the numbers of its good, neutral and bad \
                        fidget files",
            ));
            continue;
        };
        match heads.iter().find(|head| head.root == root) {
            None => heads.push(Head { root, fidgets, span }),
            Some(first) => found.push(
                Diagnostic::at(Code::HeadsList, span, format!("`{root}` has two lines"))
                    .also(first.span, "first definition")
                    .help("remove one of them"),
            ),
        }
    }
    (heads, found)
}

/// Returns the root and the numbers of a line. A root alone reserves a number without a face, like `reser` in the
/// game's own file: the engine counts 0 files for it.
fn parse_line(line: &str) -> Option<(String, [u32; 3])> {
    let is_separator = |c: char| c == ',' || c == ';' || c.is_ascii_whitespace();
    let mut words = line.split(is_separator).filter(|word| !word.is_empty());
    let root = words.next().filter(|root| root.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_'))?;
    let mut words = words.peekable();
    if words.peek().is_none() {
        return Some((root.to_ascii_lowercase(), [0; 3]));
    }
    let mut number = || words.next()?.parse().ok().filter(|&number| number <= MOST_FIDGETS);
    Some((root.to_ascii_lowercase(), [number()?, number()?, number()?]))
}

impl Head {
    /// Whether the line only reserves a number, without fidget files.
    pub fn is_reserved(&self) -> bool {
        self.fidgets == [0; 3]
    }

    /// Returns the files that the game looks for: mouth shapes, transitions and fidgets; nothing for a reserved number.
    pub fn files(&self) -> impl Iterator<Item = HeadFile> {
        use Disposition::{Bad, Good, Neutral};
        let file = |disposition, content| HeadFile { root: self.root.clone(), disposition, content };
        let transitions = [(Good, Neutral), (Neutral, Good), (Neutral, Bad), (Bad, Neutral)];
        let transitions = transitions.map(|(from, to)| file(from, Content::Transition(to)));
        let phonemes = Disposition::ALL.map(|disposition| file(disposition, Content::Phonemes));
        let numbers = Disposition::ALL.into_iter().zip(self.fidgets);
        let fidgets = numbers.flat_map(move |(disposition, count)| {
            (1..=count).map(move |number| file(disposition, Content::Fidget(number)))
        });
        let is_face = !self.is_reserved();
        phonemes.into_iter().chain(transitions).chain(fidgets).filter(move |_| is_face)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Vec<(String, [u32; 3])> {
        read_list(text).0.into_iter().map(|head| (head.root, head.fidgets)).collect()
    }

    #[test]
    fn both_spellings() {
        let expected = vec![("elder".to_owned(), [1, 2, 3]), ("myron".to_owned(), [0, 10, 1])];
        assert_eq!(read("ELDER,1,2,3\r\nmyron,0,10,1 ; the chemist\r\n"), expected);
        assert_eq!(read("elder 1, 2, 3\n\nmyron\t0, 10,1"), expected);
    }

    #[test]
    fn a_root_alone_keeps_a_number() {
        let (heads, found) = read_list("reser\nelder,1,1,1\n");
        assert!(found.is_empty(), "{found:?}");
        assert_eq!(heads.iter().map(|head| head.files().count()).collect::<Vec<_>>(), [0, 10]);
        let (heads, found) = read_list("reser\n\nelder,1,1,1\n\n\n");
        assert_eq!((heads.len(), found.len()), (2, 1), "the one between others: {found:?}");
    }

    #[test]
    fn lines_of_another_form_are_marked() {
        let text = "elder,1,2\nmyron,1,1,x\nä,1,1,1\nlynette,1,1,1\nLYNETTE,2,2,2\nlynette2,1,1,4000000000\n";
        let (heads, found) = read_list(text);
        assert_eq!(heads.len(), 1);
        let marked: Vec<&str> =
            found.iter().filter_map(|diagnostic| text.get(diagnostic.primary.as_ref()?.span.range())).collect();
        assert_eq!(marked, ["elder,1,2", "myron,1,1,x", "ä,1,1,1", "LYNETTE,2,2,2", "lynette2,1,1,4000000000"]);
    }
}
