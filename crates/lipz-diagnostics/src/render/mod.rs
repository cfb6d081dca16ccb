//! Reports as text: for people, and for the programs that read them.
//!
//! Each renderer takes all reports of a run and returns one string. Nothing in it steers a terminal or
//! leaves its line, whatever is in keys, paths and texts.

mod cargo;
mod concise;
#[cfg(feature = "human")]
mod excerpt;
mod github;
#[cfg(feature = "json")]
mod gitlab;
#[cfg(feature = "human")]
mod human;
#[cfg(feature = "json")]
mod json;
mod junit;
mod places;
#[cfg(feature = "json")]
mod sarif;
#[cfg(feature = "human")]
mod visible;

pub(crate) use places::Places;

pub use cargo::cargo;
pub use concise::concise;
pub use github::github;
#[cfg(feature = "json")]
pub use gitlab::gitlab;
#[cfg(feature = "human")]
pub use human::{Human, human};
#[cfg(feature = "json")]
pub use json::{json, json_with, to_json};
pub use junit::junit;
#[cfg(feature = "json")]
pub use sarif::sarif;
