//! The plugin in an app without a window.

mod face;
mod failures;
mod game;
mod playback;
mod readme;
mod reload;
mod rest;
mod sprite;
