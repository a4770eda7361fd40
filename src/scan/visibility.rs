//! How it is found who is seen where on a line.

use super::{active::Active, bucket::TriangleId, geometry::Geometry, list::ActiveList, table::Span};

/// A way to find who is seen where on a line, named in the type of a [`Scanner`](crate::Scanner).
///
/// - [`Spanning`](super::resolve::Spanning), the default, compares depths where triangles begin, end or cross, and needs no memory.
/// - [`DepthLine`](super::depth_line::DepthLine), the one-line z-buffer, compares them at each pixel of each triangle.
///
/// Both compare the same integer depths, and equal ones go to the lower (object, triangle): so pictures are equal. Spanning is the
/// cheaper one wherever most triangles lie beside each other, as those of a closed mesh do; the other one's time hardly depends on
/// how triangles lie, but on the pixels that they cover.
pub trait Visibility: Sized {
    /// Before its first line.
    const NEW: Self;

    /// Hands what is seen on the line, left of `width`, to `see`, some spans at a time, with all triangles in their slots: disjoint
    /// spans in the picture, from left to right, some of them empty.
    fn resolve<const N: usize, const L: usize>(
        &mut self,
        line: u16,
        width: i32,
        list: &mut ActiveList<N>,
        geometry: &Geometry<'_, '_, L>,
        see: impl FnMut(&[Span], &mut [Active; N]),
    );
}

/// Whether `other` is in front where both are equally near.
#[cold]
#[inline(never)]
pub(super) fn wins<const L: usize>(other: TriangleId, front: TriangleId, geometry: &Geometry<'_, '_, L>) -> bool {
    (geometry.whole(other), other) <= (geometry.whole(front), front)
}
