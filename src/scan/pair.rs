//! Two triangles as shading sees them together.

use super::vertex::Vertex;

/// Two triangles of one material that share an edge and make a convex quadrilateral on the screen: corners 0, 1, 2 and 0, 2, 3, seen
/// from the front.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'f, const LIGHTS: usize> {
    /// The corners, one after the other around both.
    pub corners: [&'f Vertex<LIGHTS>; 4],
    /// The edge constants, Q15, of edges 01, 12, 20 and of 02, 23, 30.
    pub edges: [&'f [u16; 3]; 2],
}
