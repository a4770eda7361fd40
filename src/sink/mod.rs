//! Where pixels go: encodings, palettes, dither, overlays, displays, and what of a frame they are sent.

pub mod changes;
pub mod dither;
pub mod draw;
pub mod ink;
pub mod overlay;
pub mod palette;
pub mod round;
pub(crate) mod row;
