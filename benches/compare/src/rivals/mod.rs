//! One file per rival.

pub mod json;
pub mod limit;
pub mod lipz;
pub mod loaded;
pub mod none;
pub mod rkyv;
