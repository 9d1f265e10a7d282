//! Comparisons with other programs: libigl, and the maps of peers.

pub mod libigl;
pub mod moebius_fit;
pub mod peer;
pub mod verify;
