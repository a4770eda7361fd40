//! What the readers make of a file: loose faces.

use std::path::PathBuf;

use crate::polygon;
use crate::surface::Surface;
use crate::vector::{cross, dot, sub, Vector};

/// Faces as they stand in a file, not yet welded, cut or complete.
#[derive(Debug, Default)]
pub(crate) struct Soup {
    pub(crate) positions: Vec<Vector>,
    pub(crate) faces: Vec<Face>,
    pub(crate) surfaces: Vec<Surface>,
    /// The files that were read, the model's own first.
    pub(crate) files: Vec<PathBuf>,
}

/// Three corners or more, counter-clockwise.
#[derive(Debug)]
pub(crate) struct Face {
    pub(crate) corners: Vec<Corner>,
    /// Number of a surface.
    pub(crate) surface: usize,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    /// Number of a position.
    pub(crate) position: usize,
    /// Of any length; without a direction it counts as missing.
    pub(crate) normal: Option<Vector>,
}

/// A face of three corners that has an area.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    pub(crate) corners: [Corner; 3],
    pub(crate) surface: usize,
}

impl Soup {
    /// Cuts the faces into triangles, in their order; gives the number of those without an area, too, which are dropped.
    pub(crate) fn triangles(&self) -> (Vec<Triangle>, usize) {
        let mut triangles = Vec::with_capacity(self.faces.len());
        let mut dropped = 0;
        for face in &self.faces {
            let corners: Vec<_> = face.corners.iter().map(|corner| self.positions[corner.position]).collect();
            for cut in polygon::triangles(&corners) {
                if has_area(cut.map(|corner| corners[corner])) {
                    triangles.push(Triangle { corners: cut.map(|corner| face.corners[corner]), surface: face.surface });
                } else {
                    dropped += 1;
                }
            }
        }
        (triangles, dropped)
    }
}

/// Whether the corners of a triangle are three and not in line, as far as f64 can tell.
fn has_area([a, b, c]: [Vector; 3]) -> bool {
    let edges = [sub(b, a), sub(c, b), sub(a, c)];
    let area = cross(edges[0], edges[1]);
    let longest = edges.iter().fold(0.0, |max: f64, &edge| max.max(dot(edge, edge)));
    dot(area, area).sqrt() > 1e-12 * longest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn area_does_not_depend_on_scale() {
        for scale in [1e-30, 1.0, 1e30] {
            let points = |points: [[f64; 3]; 3]| points.map(|point| point.map(|x| x * scale));
            assert!(has_area(points([[0.0; 3], [1.0, 0.0, 0.0], [0.5, 1e-6, 0.0]])));
            assert!(!has_area(points([[0.1; 3], [0.2; 3], [0.7; 3]])));
            assert!(!has_area(points([[1.0; 3], [2.0, 3.0, 4.0], [1.0; 3]])));
        }
    }
}
