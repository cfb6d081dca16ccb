//! Makes the lip-sync track of one line: `cargo run --release -p lipz-speech --example lip_sync -- mara-hello.wav en-us
//! "Good evening, Mara."`. Prints the frames, and then each word with its time in milliseconds and its confidence.

use lipz_speech::{Language, LipSync};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [recording, locale, text] = arguments.as_slice() else {
        return Err("usage: lip_sync RECORDING LOCALE TEXT".into());
    };
    let language = Language::from_locale(locale).ok_or("no such locale")?;
    let line = LipSync::new(language).file(recording, text)?;
    println!("{}", line.mouth.visemes());
    for (word, time) in line.words() {
        println!("{:6} {:6} {:.2} {}", time.start_us / 1000, time.end_us / 1000, time.confidence, word.text);
    }
    Ok(())
}
