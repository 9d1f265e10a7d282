//! Comparisons with libigl, live.

#![allow(clippy::unwrap_used)]

mod libigl_environment;
mod live;
mod peers;
