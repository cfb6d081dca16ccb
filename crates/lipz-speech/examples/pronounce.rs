//! Prints the pronunciations of words: `echo "Guten Tag" | cargo run -p lipz-speech --example pronounce -- de`. With
//! `--all` after the locale, it prints a line for each pronunciation.

use lipz_speech::{Language, Pronouncer};
use std::io::{Read, Write};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let language = arguments.next().and_then(|locale| Language::from_locale(&locale)).ok_or("which locale?")?;
    let all = arguments.next().is_some_and(|argument| argument == "--all");
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text)?;
    let pronouncer = Pronouncer::new(language);
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    for line in text.lines() {
        for word in pronouncer.script(line).words {
            let shown = if all { word.pronunciations.len() } else { 1 };
            for pronunciation in word.pronunciations.iter().take(shown) {
                writeln!(out, "{}\t{pronunciation}", word.text)?;
            }
        }
    }
    Ok(())
}
