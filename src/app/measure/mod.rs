//! Measurements of processes: times, memory, medians.

pub mod median;
pub mod process;
pub mod stopwatch;
