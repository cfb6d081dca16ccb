//! Views of a dialogue for tools: summaries, differences, statistics, and ids for programs.

#[cfg(feature = "diff")]
pub mod diff;
#[cfg(feature = "ids")]
pub mod ids;
#[cfg(feature = "inspect")]
pub mod inspect;
#[cfg(feature = "json")]
mod json;
#[cfg(feature = "stats")]
pub mod stats;
