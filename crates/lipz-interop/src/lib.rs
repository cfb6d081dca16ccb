//! Other tools' lip-sync formats to and from Lipz files.

pub mod fallout;
