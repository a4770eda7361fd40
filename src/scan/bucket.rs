//! The triangles of a picture by the line on which they start.

/// Number of a triangle in a frame: through the meshes in the order they were added; those made by clipping or splitting count down
/// from 65534.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TriangleId(pub(crate) u16);

impl TriangleId {
    /// The last number, that of the first made triangle.
    pub(crate) const MADE: u16 = 0xfffe;
}

/// A kept triangle, and the next one that starts on the same line.
#[derive(Clone, Copy, Debug)]
pub struct Kept {
    /// One more than its place; 0 at the end.
    pub(crate) next: u16,
    pub(crate) triangle: TriangleId,
}

/// The triangles that start on one line.
#[derive(Clone, Debug)]
pub(crate) struct Starting<'a> {
    pub(crate) kept: &'a [Kept],
    /// One more than the place of the next one; 0 at the end.
    pub(crate) next: u16,
}

impl Iterator for Starting<'_> {
    type Item = TriangleId;

    fn next(&mut self) -> Option<TriangleId> {
        let kept = self.kept.get(usize::from(self.next).wrapping_sub(1))?;
        self.next = kept.next;
        Some(kept.triangle)
    }
}
