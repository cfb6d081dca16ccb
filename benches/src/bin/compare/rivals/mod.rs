//! One file per rival.

pub(crate) mod flat;
pub(crate) mod json;
pub(crate) mod limit;
pub(crate) mod lipz;
pub(crate) mod loaded;
pub(crate) mod none;
pub(crate) mod rkyv;
pub(crate) mod serde;
pub(crate) mod sqlite;
pub(crate) mod zerovec;
