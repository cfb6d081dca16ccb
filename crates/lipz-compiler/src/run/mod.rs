//! Runs: from inputs to a bank on all threads, with a cache, on top of a stack, or on several machines.

#[cfg(feature = "cache")]
pub(crate) mod cache;
pub(crate) mod compile;
mod outputs;
#[cfg(feature = "shards")]
pub mod shard;
mod stack_below;

#[cfg(feature = "cache")]
pub use cache::Memory;
pub use compile::{CheckResult, CompileError, Compiled, Compiler, Lint, LintResult, Phases};
pub use outputs::{DeliveredFiles, Outputs};
pub use stack_below::StackBelow;
