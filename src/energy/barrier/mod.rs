//! Barriers: energies that are +∞ if a boundary is out of order or meets itself.

mod clearance;
mod gaps;
mod order;
mod overlap;
mod point_edge;

pub use clearance::Clearance;
pub use gaps::Gaps;
pub use order::Order;
