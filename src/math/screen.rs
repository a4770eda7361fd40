//! The screen's coordinates and its one fill rule.
//!
//! Points lie on a grid of 1/256 pixel, x to the right, y down, the picture's top left corner at (0, 0).
//! Pixel (c, r) is covered where its centre lies inside; a centre exactly on a left or top edge counts as inside, one on a
//! right or bottom edge does not. So triangles that share an edge leave no gap and overlap nowhere.
//!
//! ```text
//!     0   256  512  768
//!   0 ┌────┬────┬────┐
//!     │ ·  │ ·  │ ·  │   centres at 128 + 256·k
//! 256 ├────┼────┼────┤
//! ```

use embedded_graphics::geometry::Point;

/// Subpixels of a pixel.
pub const SUBPIXELS: i32 = 256;

/// The largest distance of a projected point from the picture's centre, in subpixels; beyond it triangles are clipped.
pub const GUARD: i32 = 1535 * SUBPIXELS;

/// The largest width and height of a picture, in pixels.
pub const LARGEST: u32 = 1024;

/// Of pixel centres in a row or a column, the number of the first at or after the coordinate.
#[inline(always)]
#[must_use]
pub const fn first_at(coordinate: i32) -> i32 {
    (coordinate + SUBPIXELS / 2 - 1) >> 8
}

/// The centre of pixel number `pixel` in its row or column.
#[inline(always)]
#[must_use]
pub const fn center(pixel: i32) -> i32 {
    pixel.wrapping_mul(SUBPIXELS).wrapping_add(SUBPIXELS / 2)
}

/// Whether a distance is short enough for products of two to fit 32 bits: below 128 pixels.
#[inline(always)]
#[must_use]
pub const fn is_short(distance: i32) -> bool {
    (distance + (1 << 15)) as u32 >> 16 == 0
}

/// Twice the area of the triangle a, b, c, in square subpixels: positive where its corners run clockwise as seen.
#[inline]
#[must_use]
pub const fn area(a: Point, b: Point, c: Point) -> i64 {
    let (bx, by, cx, cy) = (b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
    if is_short(bx) && is_short(by) && is_short(cx) && is_short(cy) {
        // Two products of at most 2³⁰, one of them subtracted: 2³¹ itself needs all four at −2¹⁵, where they cancel.
        bx.wrapping_mul(cy).wrapping_sub(by.wrapping_mul(cx)) as i64
    } else {
        bx as i64 * cy as i64 - by as i64 * cx as i64
    }
}
