//! A drawn picture.

use crate::Format;

/// The triangle that a pixel shows.
///
/// Ordered as depth ties are broken: the lower one wins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Owner {
    /// Number of the object in its scene.
    pub object: u32,
    /// Number of the triangle in the object's mesh; pieces made by clipping bear the number of the whole.
    pub triangle: u32,
}

/// Colours and owners of `width` × `height` pixels, row by row from the top, from left to right.
///
/// `C` is a pixel of an output [`Format`], or `[f64; 3]`: red, green and blue from 0 to 1, not rounded.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture<C> {
    /// Pixels in a row.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// The colour of each pixel.
    pub color: Vec<C>,
    /// The triangle that each pixel shows; `None` where the background is seen.
    pub owner: Vec<Option<Owner>>,
}

impl<C: Copy> Picture<C> {
    /// A picture of nothing but background.
    #[must_use]
    pub fn blank(width: usize, height: usize, background: C) -> Self {
        Self { width, height, color: vec![background; width * height], owner: vec![None; width * height] }
    }

    /// The same picture, each colour taken through `f`.
    #[must_use]
    pub fn map<D>(&self, f: impl Fn(C) -> D) -> Picture<D> {
        Picture {
            width: self.width,
            height: self.height,
            color: self.color.iter().map(|&color| f(color)).collect(),
            owner: self.owner.clone(),
        }
    }

    /// Number of pixels that show a triangle.
    #[must_use]
    pub fn covered(&self) -> usize {
        self.owner.iter().flatten().count()
    }
}

impl Picture<[f64; 3]> {
    /// The same picture, each colour rounded to the nearest of an output format.
    #[must_use]
    pub fn round<F: Format>(&self) -> Picture<F> {
        self.map(F::round)
    }
}
