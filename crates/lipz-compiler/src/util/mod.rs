//! Threads, pipes, patterns and tables of bytes, independent of Lipz files.

pub(crate) mod hash;
pub(crate) mod parallel;
pub(crate) mod patterns;
pub(crate) mod pipe;
pub(crate) mod strings;
