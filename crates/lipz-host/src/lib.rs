//! Dialogue banks as files, for programs with an operating system.
//!
//! `lipz-bank` reads bytes and does not access files. This crate supplies the bytes: a [`Dialogue`] is any number of
//! files with their contents. You can keep it, send it to other threads, and refresh it after `lipz watch` or an update
//! has replaced files.
//!
//! ```no_run
//! use lipz_bank::{ClipId, Cursor, Locale, Micros};
//! use lipz_host::{Dialogue, OpenError};
//!
//! struct Game {
//!     dialogue: Dialogue,
//!     german: Option<Locale>,
//!     playing: Option<(ClipId, Cursor)>,
//! }
//!
//! impl Game {
//!     fn start(&mut self, id: ClipId) {
//!         let cursor = self.dialogue.clip(id).and_then(|clip| Cursor::new(&clip));
//!         self.playing = cursor.map(|cursor| (id, cursor.with_speaker(self.dialogue.event_name("mara"))));
//!     }
//!
//!     /// Once per rendered frame.
//!     fn draw(&mut self, audio: Micros) {
//!         let Some((id, cursor)) = &mut self.playing else { return };
//!         let Some(clip) = self.dialogue.clip(*id) else { return };
//!         for event in cursor.advance_to(&clip, audio).events() {
//!             println!("{event}");
//!         }
//!         let text = self.german.and_then(|german| cursor.segment(&clip)?.text(german));
//!         println!("{} {}", cursor.viseme(&clip), text.map_or("", |text| text.as_str()));
//!     }
//!
//!     /// Now and then, between rendered frames.
//!     fn refresh(&mut self) {
//!         match self.dialogue.refresh() {
//!             Ok(changes) if changes.is_empty() => {}
//!             Ok(_) => self.german = self.dialogue.locale("de-de"), // the cursor continues in the new version
//!             Err(why) => eprintln!("the old dialogue stays in use: {why}"),
//!         }
//!     }
//! }
//!
//! # fn main() -> Result<(), OpenError> {
//! // Only this list changes when a patch and a text bank are added.
//! let dialogue = Dialogue::open(["dialogue.lipzbank", "patch.lipzbank", "dialogue.de-de.lipztexts"])?;
//! let german = dialogue.locale("de-de");
//! let mut game = Game { dialogue, german, playing: None };
//! game.start(ClipId::from_key("act1/mara-good-evening"));
//! game.refresh();
//! game.draw(Micros(1_500_000));
//! # Ok(())
//! # }
//! ```
//!
//! # Memory or map
//!
//! [`Dialogue::open`] reads the files into memory. Later changes to the files do not matter: verified contents stay
//! verified.
//!
//! [`Dialogue::open_mapped`] maps the files. Programs then share memory, and only the pages that are accessed are read,
//! but the bytes are still those of the files. It is therefore `unsafe`: the caller guarantees that no process changes
//! or truncates the files while they are mapped. On Unix, replacing them is safe: `lipz pack` and `lipz watch` write a
//! new file and rename it over the old one, and a map of the old file stays intact until it is dropped. *Windows* does
//! not allow replacing a mapped file.
//!
//! [dialogue-files.md](https://github.com/lipz/lipz/blob/main/docs/guides/dialogue-files.md) is the manual, and
//! [design.md](https://github.com/lipz/lipz/blob/main/docs/inside/design.md) explains this API.
//!
//! # Features
//!
//! `simdutf8` halves the time of verification.

#![deny(unsafe_op_in_unsafe_fn)]

mod bytes;
mod changes;
mod dialogue;
mod error;
mod files;
mod queries;
mod source;
mod stamp;

pub use bytes::FileBytes;
pub use changes::Changes;
pub use dialogue::Dialogue;
pub use error::OpenError;
pub use source::Source;

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
