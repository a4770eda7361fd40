//! Where pixels go: encodings, palettes, overlays, displays.

pub mod draw;
pub mod ink;
pub mod overlay;
pub mod palette;
pub(crate) mod row;
