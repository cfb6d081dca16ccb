//! The text format of tables of letter-to-sound rules, described in `data/languages/README.md`.

use super::stress::Stress;
use crate::Phone;
use crate::pronounce::lexicon::arpabet;
use std::cmp::Reverse;
use std::collections::HashMap;

/// The letter-to-sound rules of a language.
#[derive(Default, Debug)]
pub(in crate::pronounce) struct RuleTable {
    /// The rules by their first letter: long ones first, then those with more context, then in the order of the table.
    pub(super) rules: HashMap<char, Vec<Rule>>,
    /// Words that do not follow the rules.
    pub(super) words: HashMap<String, Vec<Vec<Phone>>>,
    /// The names of letters, spelled in the language.
    pub(super) names: HashMap<char, String>,
    /// Words that end with an additional sound before a vowel.
    pub(in crate::pronounce) links: HashMap<String, Phone>,
    pub(super) vowels: Vec<char>,
    pub(super) stress: Stress,
    /// Whether `I` is the capital of `ı`.
    pub(super) dotless: bool,
}

/// A rule: `before<letters>after  sounds`.
#[derive(Debug)]
pub(super) struct Rule {
    pub(super) letters: Vec<char>,
    /// The context before the letters, the nearest first.
    pub(super) before: Vec<Item>,
    pub(super) after: Vec<Item>,
    /// One or more alternatives.
    pub(super) sounds: Vec<Sounds>,
}

/// The sounds of letters in a stressed syllable, and in unstressed ones.
#[derive(Debug)]
pub(super) struct Sounds {
    pub(super) stressed: Vec<Phone>,
    pub(super) unstressed: Vec<Phone>,
}

/// One position of the context of a rule.
#[derive(Debug)]
pub(super) enum Item {
    /// The end of the word, or a character other than a letter: an apostrophe.
    Edge,
    /// One of these letters.
    One(Vec<char>),
    /// A letter that is not one of these.
    NotOne(Vec<char>),
}

impl Item {
    pub(super) fn fits(&self, letter: Option<&char>) -> bool {
        match (self, letter) {
            (Item::Edge, letter) => letter.is_none_or(|letter| !letter.is_alphabetic()),
            (Item::One(letters), Some(letter)) => letters.contains(letter),
            (Item::One(_), None) => false,
            (Item::NotOne(letters), letter) => letter.is_none_or(|letter| !letters.contains(letter)),
        }
    }
}

/// The numbers of invalid lines.
pub(super) type BadLines = Vec<usize>;

impl RuleTable {
    /// Reads a table. Invalid lines are skipped; a test checks that the tables of this crate have none.
    pub(super) fn parse(text: &str) -> (RuleTable, BadLines) {
        let mut table = RuleTable::default();
        let mut classes: HashMap<char, Vec<char>> = HashMap::new();
        let mut bad = BadLines::new();
        for (index, line) in text.lines().enumerate() {
            let line = line.split(" #").next().unwrap_or(line).trim();
            if line.is_empty() || line.starts_with("# ") {
                continue;
            }
            if table.line(line, &mut classes).is_none() {
                bad.push(index + 1);
            }
        }
        for rules in table.rules.values_mut() {
            let context = |rule: &Rule| rule.before.len() + rule.after.len();
            rules.sort_by_key(|rule| Reverse((rule.letters.len(), context(rule)))); // stable
        }
        (table, bad)
    }

    fn line(&mut self, line: &str, classes: &mut HashMap<char, Vec<char>>) -> Option<()> {
        let (first, rest) = line.split_once(char::is_whitespace)?;
        let rest = rest.trim();
        match first {
            "class" => {
                let (name, letters) = rest.split_once(' ')?;
                let letters: Vec<char> = letters.trim().chars().collect();
                if name == "V" {
                    self.vowels.clone_from(&letters);
                }
                classes.insert(single(name)?, letters);
            }
            "stress" => self.stress = Stress::parse(rest)?,
            "dotless" => self.dotless = rest == "yes",
            "names" => {
                for name in rest.split_whitespace() {
                    let (letter, name) = name.split_once('=')?;
                    self.names.insert(single(letter)?, name.to_owned());
                }
            }
            "link" => {
                let (sound, words) = rest.split_once(' ')?;
                let sound = arpabet(sound)?;
                self.links.extend(words.split_whitespace().map(|word| (word.to_owned(), sound)));
            }
            "word" => {
                let (word, sounds) = rest.split_once(char::is_whitespace)?;
                let ways: Option<Vec<Vec<Phone>>> = sounds.split('|').map(phones).collect();
                self.words.insert(word.to_owned(), ways?);
            }
            pattern => {
                let rule = rule(pattern, rest, classes)?;
                self.rules.entry(*rule.letters.first()?).or_default().push(rule);
            }
        }
        Some(())
    }
}

fn single(text: &str) -> Option<char> {
    let mut chars = text.chars();
    chars.next().filter(|_| chars.next().is_none())
}

fn rule(pattern: &str, sounds: &str, classes: &HashMap<char, Vec<char>>) -> Option<Rule> {
    let (before, letters, after) = match pattern.split_once('<') {
        Some((before, rest)) => {
            let (letters, after) = rest.split_once('>')?;
            (before, letters, after)
        }
        None => ("", pattern, ""),
    };
    let mut before = items(before, classes)?;
    before.reverse();
    let alternative = |text: &str| {
        let (stressed, unstressed) = text.split_once('~').unwrap_or((text, text));
        Some(Sounds { stressed: phones(stressed)?, unstressed: phones(unstressed)? })
    };
    let sounds: Option<Vec<Sounds>> = sounds.split('|').map(alternative).collect();
    Some(Rule { letters: letters.chars().collect(), before, after: items(after, classes)?, sounds: sounds? })
}

/// Returns phones from their names; `-` stands for none.
fn phones(text: &str) -> Option<Vec<Phone>> {
    match text.trim() {
        "-" => Some(Vec::new()),
        "" => None,
        names => names.split_whitespace().map(arpabet).collect(),
    }
}

/// Parses the positions of a context: a letter, a class in capitals, `#` for an edge, `[…]` for one of several letters,
/// `[^…]` for a letter that is not one of them.
fn items(text: &str, classes: &HashMap<char, Vec<char>>) -> Option<Vec<Item>> {
    let letters = |text: &str| {
        let all = text.chars().map(|c| classes.get(&c).cloned().or((!c.is_uppercase()).then(|| vec![c])));
        all.collect::<Option<Vec<_>>>().map(|all| all.concat())
    };
    let mut items = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let (item, length) = match first {
            '#' => (Item::Edge, 1),
            '[' => {
                let end = rest.find(']')?;
                let inside = rest.get(1..end)?;
                let item = match inside.strip_prefix('^') {
                    Some(inside) => Item::NotOne(letters(inside)?),
                    None => Item::One(letters(inside)?),
                };
                (item, end + 1)
            }
            letter => (Item::One(letters(letter.encode_utf8(&mut [0; 4]))?), letter.len_utf8()),
        };
        items.push(item);
        rest = rest.get(length..)?;
    }
    Some(items)
}
