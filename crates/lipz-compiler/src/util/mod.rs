//! Threads, pipes and tables of bytes, independent of Lipz files.

pub(crate) mod hash;
pub(crate) mod parallel;
pub(crate) mod pipe;
pub(crate) mod strings;
