//! Number formats and the arithmetic on them. Everything here is integer, total and wrapping where it says so.
//!
//! | quantity | format | one unit in the last place | range |
//! |---|---|---|---|
//! | length in the world, public | [`Length`] (I16F16) | 2⁻¹⁶ | ±32768 |
//! | point before the eye | I12F20 in `i32` | 2⁻²⁰ | ±2048 |
//! | position in a mesh | Q15 of its extent, `i16` | 2⁻¹⁵ | ±1 |
//! | normal, product of normal and light | Q14, `i16` | 2⁻¹⁴ | ±1 |
//! | edge constant `1 − n_i·n_j` | Q15, `u16` | 2⁻¹⁵ | 0 … 2 |
//! | angle | [`Turn`](angle::Turn), `u32` | 2⁻³² of a circle | a circle |
//! | angle interpolated or measured, [`arc`] | `i32` | 2⁻³² of a circle | ±½ circle |
//! | sine, rotation, direction | Q30, `i32` | 2⁻³⁰ | ±2 |
//! | point on the screen | 1/256 pixel, 20 bits | 2⁻⁸ | ±2048 pixels |
//! | nearness `1/z`, scaled to the near plane | 23 bits | 2⁻²³ | 0 … 1 |
//! | interpolated product | Q24, wrapping `i32` | 2⁻²⁴ | ±128 |
//! | interpolated cosine with the light | Q30, wrapping `i32` | 2⁻³⁰ | ±2 |
//! | height of the cosine with the half vector, see [`Power`](power::Power) | `i32` | 2⁻²⁹⁻ᵏ | ±4·2⁻ᵏ |
//! | interpolated `u = 1 − |N|²` | Q28, wrapping `i32` | 2⁻²⁸ | ±8 |
//! | intensity, diffuse or specular | Q14, `u32` | 2⁻¹⁴ | 0 … 2 |
//! | colour factor, coefficient | Q15, `u16` | 2⁻¹⁵ | 0 … 1 |

pub mod angle;
pub mod arc;
pub mod gradient;
pub mod interpolant;
pub mod piecewise;
pub mod power;
pub mod product;
pub mod quadratic;
pub mod quotient;
pub mod reciprocal;
pub mod root;
pub mod rotation;
pub mod screen;
pub mod vector;
pub mod weights;

/// A length in the world.
pub type Length = fixed::types::I16F16;

/// The one border for floats: a length from an `f32`, rounded; out of range saturates, NaN is 0.
#[must_use]
pub const fn length(value: f32) -> Length {
    let scaled = value * 65536.0;
    Length::from_bits((if scaled < 0.0 { scaled - 0.5 } else { scaled + 0.5 }) as i32)
}
