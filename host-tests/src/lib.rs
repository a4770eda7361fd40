//! The independent truth that the fixed-point library is tested against.
//!
//! - [`reference`](mod@reference) draws a scene in f64, with nothing quantised and nothing approximated;
//! - [`scenes`] holds the standard scenes T880 and T5560, and the cases that methods are compared in;
//! - [`Picture`] is what either renderer draws: colours, and the [`Owner`] of each pixel;
//! - [`Format`] takes colours to the levels of an output format and back;
//! - [`Measures`] tells how far two pictures are apart;
//! - [`panel`] is a display behind a bus, which counts what comes;
//! - [`image`] keeps pictures in PNG files.
//!
//! The reference shares no code with the library.

pub mod accuracy;
pub mod image;
pub mod library;
pub mod methods;
pub mod panel;
pub mod reference;
pub mod scenes;
pub mod shapes;

mod compare;
mod format;
mod picture;

pub use compare::Measures;
pub use format::Format;
pub use picture::{Owner, Picture};
