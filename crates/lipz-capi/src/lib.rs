//! C ABI of the reader of lipz banks, declared in `include/lipz.h`.
//!
//! Every function takes plain structs by pointer, writes its answer to its last pointers and returns a [`Status`].
//! `docs/guides/c.md` shows how to use them.
//!
//! # Contract
//!
//! The caller guarantees only the following:
//!
//! * Each pointer is null or leads to a value of its type, or to as many bytes as the length next to it. This includes
//!   the pointers in a [`Bytes`] and a [`Who`].
//! * The library has written the words of a [`Dialogue`] and of its files. The files stay at their addresses, and their
//!   contents stay valid, while the dialogue and strings from it are used.
//! * No thread writes to any of these during a call, and answers do not overlap arguments.
//!
//! Everything else is total. A null pointer results in a status. The numbers in all other structs are checked like the
//! bytes of a file: a struct of another version, or with random numbers, leads to [`LIPZ_NONE`] or to other contents of
//! the dialogue, but never out of it.

#![no_std]
#![deny(unsafe_op_in_unsafe_fn)]
#![allow(unsafe_code)] // the pointers of C; see `pointer`
#![allow(clippy::missing_safety_doc)] // all functions have one contract: the one above
#![cfg_attr(not(test), deny(clippy::indexing_slicing, clippy::arithmetic_side_effects))]

mod articulation;
mod babble;
mod character;
mod clip;
mod cursor;
mod curve;
mod dialogue;
mod event;
mod face;
mod find;
mod handle;
mod open;
#[cfg(feature = "panic-handler")]
mod panic;
mod pointer;
mod segment;
mod status;
mod string;
mod time;
mod version;
mod who;

pub use articulation::*;
pub use babble::*;
pub use character::*;
pub use clip::*;
pub use cursor::*;
pub use curve::*;
pub use dialogue::*;
pub use event::*;
pub use face::*;
pub use find::*;
pub use handle::*;
pub use open::*;
pub use segment::*;
pub use status::*;
pub use string::{String, c_char};
pub use time::*;
pub use version::*;
pub use who::Who;
