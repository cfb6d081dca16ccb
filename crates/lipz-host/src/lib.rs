//! Dialogue banks as files, for programs with an operating system.
//!
//! `lipz-bank` reads a bank from any bytes and knows no files. This crate gets it the bytes:
//! [`FileBytes`] maps a file or reads it, [`OwnedBank`] is a bank together with its bytes, and
//! [`LiveBank`] takes in a new version of the file while the program runs, with `lipz watch` on the
//! other side:
//!
//! ```no_run
//! use lipz_host::{Hold, LiveBank};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let live = LiveBank::open("dialogue.lipzbank", Hold::Mapped)?;
//! // Now and then, between frames:
//! match live.refresh() {
//!     Ok(true) => println!("the new dialogue is in use"),
//!     Ok(false) => {} // the file is the same
//!     Err(why) => eprintln!("the old dialogue stays in use: {why}"),
//! }
//! // Per conversation: what is playing keeps its version of the bank.
//! let version = live.current();
//! let bank = version.bank();
//! assert!(bank.clip_by_key("act1/blair").is_some());
//! # Ok(())
//! # }
//! ```
//!
//! # Living files
//!
//! *Replace a bank, never write into it.* `lipz pack` and `lipz watch` write a new file and rename it over
//! the old one. A map of the old file stays whole for as long as somebody holds it.
//!
//! A *mapped* file stays the file of the system. If another process truncates it, touching the missing
//! pages ends the program (`SIGBUS` on Unix); if another writes into it, the bytes change under the
//! reader, also after they were verified. So map files that only your own tools write, and hold all others
//! [in memory](Hold::InMemory): then what was verified stays verified.
//!
//! *On Windows* the system refuses to replace a file as long as it is mapped, and whoever writes the new one
//! gets an error. Hold a bank that is to be replaced in memory there.
//!
//! What is not here: threads, watching (the program calls [`LiveBank::refresh`] when it suits it), text
//! banks of a live bank (hold their files as [`FileBytes`] and open them beside each new version).

mod bytes;
mod error;
mod live;
mod owned;
mod stamp;

pub use bytes::{FileBytes, Hold};
pub use error::Error;
pub use live::LiveBank;
pub use owned::OwnedBank;

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
