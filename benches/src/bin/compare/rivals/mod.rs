//! One file per rival.

pub mod flat;
pub mod json;
pub mod limit;
pub mod lipz;
pub mod loaded;
pub mod none;
pub mod rkyv;
pub mod serde;
pub mod sqlite;
pub mod zerovec;
