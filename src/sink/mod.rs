//! Where pixels go: encodings, overlays, displays.

pub mod draw;
pub mod ink;
pub mod overlay;
