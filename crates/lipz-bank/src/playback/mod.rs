//! Playing a clip: a cursor that follows the audio and fires each event once.

mod cursor;
mod due;
mod hold;
mod lead;
mod state;

pub use cursor::Cursor;
pub use due::DueSegments;
pub use hold::ConsonantHold;
pub use lead::Lead;
pub use state::CharacterState;
