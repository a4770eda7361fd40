//! The by-polygon z-buffer renderer of the course notes: who is seen at each pixel of a snapped scene.

use super::edge_list::EdgeList;
use crate::Owner;

/// A triangle on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Polygon {
    /// Who it is; polygons made by clipping bear the number of the whole.
    pub owner: Owner,
    /// In 1/256 pixel, x right and y down.
    pub corners: [[i32; 2]; 3],
    /// 1/distance at the corners, in any unit.
    pub nearness: [u32; 3],
}

impl Polygon {
    /// 1/distance of its plane in the middle of a pixel; of a triangle without area, NaN.
    #[must_use]
    pub fn nearness_at(&self, x: usize, y: usize) -> f64 {
        let corners = self.corners.map(|corner| corner.map(i128::from));
        let middle = [x, y].map(|c| 256 * c as i128 + 128);
        let area = |[ax, ay]: [i128; 2], [bx, by]: [i128; 2], [cx, cy]: [i128; 2]| (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        let [a, b, c] = corners;
        let [na, nb, nc] = self.nearness.map(i128::from);
        let sum = area(middle, b, c) * na + area(a, middle, c) * nb + area(a, b, middle) * nc;
        sum as f64 / area(a, b, c) as f64
    }
}

/// Draws polygons one after the other: "for each polygon: construct an edge list; for each pair in it: shade the segment", where the
/// z-buffer holds nothing nearer. Of equally near ones the lower owner is seen.
#[must_use]
pub fn by_polygon(polygons: &[Polygon], width: usize, height: usize) -> Vec<Option<Owner>> {
    let mut z_buffer = vec![0.0; width * height];
    let mut owners = vec![None; width * height];
    for polygon in polygons {
        for (y, segment) in EdgeList::new(&polygon.corners, height).segments(width) {
            for x in segment {
                let pixel = y * width + x;
                let near = polygon.nearness_at(x, y);
                let is_lower = owners[pixel].is_some_and(|owner| polygon.owner < owner);
                if near > z_buffer[pixel] || (near == z_buffer[pixel] && is_lower) {
                    (z_buffer[pixel], owners[pixel]) = (near, Some(polygon.owner));
                }
            }
        }
    }
    owners
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: usize = 16;

    fn polygon(triangle: u32, corners: [[i32; 2]; 3], nearness: [u32; 3]) -> Polygon {
        Polygon { owner: Owner { object: 0, triangle }, corners, nearness }
    }

    #[test]
    fn the_nearest_is_seen_whatever_the_order() {
        let all = [[-9000, -9000], [20000, -9000], [-9000, 20000]];
        // Nearer from left to right; as near as the other one in the middle of column 8.
        let slope = [[-1920, -9000], [6272, -9000], [-1920, 200_000]];
        let mut polygons = [polygon(1, all, [1000; 3]), polygon(0, slope, [600, 1400, 600]), polygon(2, all, [900; 3])];
        let expected = by_polygon(&polygons, SIZE, SIZE);
        for (pixel, owner) in expected.iter().enumerate() {
            let (x, y) = (pixel % SIZE, pixel / SIZE);
            let near = polygons[1].nearness_at(x, y);
            assert_eq!(near, 600.0 + 800.0 * (256 * x + 128 + 1920) as f64 / 8192.0);
            assert_eq!(owner.map(|owner| owner.triangle), Some(u32::from(near < 1000.0)), "{x} {y}");
        }
        polygons.reverse();
        assert_eq!(by_polygon(&polygons, SIZE, SIZE), expected);
    }
}
