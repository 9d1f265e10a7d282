//! Batches of experiments: in parallel, alone, interrupted and continued, in shards, on public data, after panics.

mod apart;
mod claims;
mod command;
mod data;
mod full;
mod interruption;
mod parallel;
mod shards;
mod shared;
mod stale;
