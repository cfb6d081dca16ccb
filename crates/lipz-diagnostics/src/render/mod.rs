//! Reports as text, for people and for programs.
//!
//! Each renderer converts all reports of a run to one string. Keys, paths and texts in it can neither control a
//! terminal nor break out of their line.

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
mod visible_text;

pub(crate) use places::Places;

pub use cargo::cargo;
pub use concise::concise;
pub use github::github;
#[cfg(feature = "json")]
pub use gitlab::gitlab;
#[cfg(feature = "human")]
pub use human::{HumanStyle, human};
#[cfg(feature = "json")]
pub use json::{json, json_with, to_json};
pub use junit::junit;
#[cfg(feature = "json")]
pub use sarif::sarif;
