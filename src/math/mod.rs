//! Number formats and the arithmetic on them.
pub mod power;
