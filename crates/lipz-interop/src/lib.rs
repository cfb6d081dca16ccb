//! Lip-sync files of other tools, to and from Lipz files.

pub mod fallout;
mod time;

pub use time::Time;
