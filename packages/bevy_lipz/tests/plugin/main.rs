//! The plugin in an app without a window.
#![allow(clippy::unwrap_used, reason = "tests")]

mod face;
mod failures;
mod game;
mod playback;
mod readme;
mod reload;
mod rest;
mod speed;
mod sprite;
