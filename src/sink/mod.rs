//! Where pixels go: encodings, palettes, dither, overlays, displays.

pub mod dither;
pub mod draw;
pub mod ink;
pub mod overlay;
pub mod palette;
pub(crate) mod row;
