//! Dialogue banks as files, for programs with an operating system.
//!
//! `lipz-bank` reads a bank from any bytes and knows no files. This crate supplies the bytes:
//! [`FileBytes`] reads or maps a file, [`OwnedBank`] is a bank together with its bytes, and
//! [`LiveBank`] switches to a new version of the file while the program runs, for instance when
//! `lipz watch` has written one. [`OwnedLayers`] and [`LiveLayers`] are the same for a bank with layers over it,
//! and [`OwnedSet`] is a set of banks.
//!
//! A game keeps a version of the bank and what is playing in one struct:
//!
//! ```no_run
//! use lipz_bank::{ClipId, Cursor, Micros};
//! use lipz_host::{LiveBank, OpenError, OwnedBank};
//! use std::sync::Arc;
//!
//! struct Game {
//!     bank: Arc<OwnedBank>,
//!     playing: Option<(ClipId, Cursor)>,
//! }
//!
//! impl Game {
//!     fn start(&mut self, id: ClipId) {
//!         let cursor = self.bank.bank().clip(id).and_then(|clip| Cursor::new(&clip));
//!         self.playing = cursor.map(|cursor| (id, cursor));
//!     }
//!
//!     fn draw(&mut self, sound: Micros) {
//!         let Some((id, cursor)) = &mut self.playing else { return };
//!         let Some(clip) = self.bank.bank().clip(*id) else { return };
//!         for event in cursor.advance_to(&clip, sound).events() {
//!             println!("{event}");
//!         }
//!         println!("{}", cursor.viseme(&clip));
//!     }
//! }
//!
//! # fn main() -> Result<(), OpenError> {
//! let live = LiveBank::open("dialogue.lipzbank")?;
//! let mut game = Game { bank: live.current(), playing: None };
//! game.start(ClipId::from_key("act1/mara-good-evening"));
//! // Now and then, between pictures:
//! match live.refresh() {
//!     Ok(true) => game.bank = live.current(), // the cursor goes on with the new version of its clip
//!     Ok(false) => {}                         // the file is the same
//!     Err(why) => eprintln!("the old dialogue stays in use: {why}"),
//! }
//! game.draw(Micros(1_500_000));
//! # Ok(())
//! # }
//! ```
//!
//! # Memory or map
//!
//! `open` reads the file into memory. What happens to the file afterwards does not matter: what was verified
//! stays verified.
//!
//! `open_mapped` maps the file. That is faster and shares memory between programs, but the bytes are still those
//! of the file, so it is `unsafe`: the caller guarantees that nobody changes or truncates the file while it is
//! mapped. Replacing it is fine on Unix: `lipz pack` and `lipz watch` write a new file and rename it over the old
//! one, and a map of the old file stays whole until it is dropped. *Windows* refuses to replace a file that is
//! mapped, and the program that writes the new one gets an error. There, do not map banks that change.
//!
//! `docs/HOST.md` says more about both, and about text banks.
//!
//! What is not here: threads, and watching (the program calls [`LiveBank::refresh`] when it suits it).

#![deny(unsafe_op_in_unsafe_fn)]

mod bytes;
mod error;
mod layers;
mod live;
mod live_layers;
mod owned;
mod set;
mod stamp;

pub use bytes::FileBytes;
pub use error::OpenError;
pub use layers::{LayersOpenError, MAX_LAYERS, OwnedLayers};
pub use live::LiveBank;
pub use live_layers::LiveLayers;
pub use owned::OwnedBank;
pub use set::OwnedSet;

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
