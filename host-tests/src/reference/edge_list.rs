//! The linked edge lists of the course notes: which pixels a polygon covers, without an edge function.
//!
//! *Rasterizing polygons*: for each scan line the list of the places where it meets an edge, each put in where it belongs; what is
//! covered lies between the first and the second, the third and the fourth, and so on.

use std::ops::Range;

/// The edge list of one polygon.
///
/// The notes take a pixel's sample at its corner, "displaced half a pixel", as corners of polygons have whole coordinates there.
/// Here they have 1/256 pixel, so that samples may lie in the middle: it is the polygon that moves by half a pixel. The rules are the
/// notes' own: horizontal edges are left out, an edge counts on its first line and not on its last, a pixel on the left border and
/// not on the right one.
#[derive(Clone, Debug)]
pub struct EdgeList {
    /// For each line of the picture, the first pixel right of each edge that meets it, or on it.
    lines: Vec<Vec<i64>>,
}

impl EdgeList {
    /// The list of the polygon with these corners, in 1/256 pixel, x right and y down, in a picture of that many lines.
    #[must_use]
    pub fn new(corners: &[[i32; 2]], height: usize) -> Self {
        let mut lines = vec![Vec::new(); height];
        let corners = || corners.iter().map(|corner| corner.map(|c| i64::from(c) - 128));
        for (from, to) in corners().zip(corners().cycle().skip(1)) {
            let (start, end) = if from[1] < to[1] { (from, to) } else { (to, from) };
            rasterize(start, end, |x, y| {
                if let Some(line) = usize::try_from(y).ok().and_then(|y| lines.get_mut(y)) {
                    line.insert(line.partition_point(|other| *other < x), x);
                }
            });
        }
        Self { lines }
    }

    /// The covered pixels of each line from the top, of those left of `width`.
    pub fn segments(&self, width: usize) -> impl Iterator<Item = (usize, Range<usize>)> + '_ {
        let pixel = move |x: i64| x.clamp(0, width as i64) as usize;
        self.lines.iter().enumerate().flat_map(move |(y, line)| {
            let (pairs, rest) = line.as_chunks();
            assert!(rest.is_empty(), "a polygon is closed");
            pairs.iter().map(move |[left, right]| (y, pixel(*left)..pixel(*right)))
        })
    }
}

/// The integer DDA of Swanson and Thayer: the first pixel at or right of an edge on each line from its start to before its end.
///
/// Two corrections of the program in the notes. For edges that run to the left its `div` and `mod` must be the floor's, or the
/// fraction leaves its range and x is wrong. And its loop runs to `ye`, where rule (2) below it has it stop at ye − 1.
///
/// As edges need not start on a line, the walk starts at the first one below; and as x is rounded up, not to nearest, the fraction
/// starts in −1 to 0, not at −½.
fn rasterize([xs, ys]: [i64; 2], [xe, ye]: [i64; 2], mut output: impl FnMut(i64, i64)) {
    const PIXEL: i64 = 256;
    let (dx, dy) = (xe - xs, ye - ys);
    if dy == 0 {
        return;
    }
    // Fractions of a pixel are counted in 1/scale.
    let scale = PIXEL * dy;
    let mi = dx.div_euclid(dy);
    let mf = PIXEL * dx.rem_euclid(dy);
    let mut y = (ys + PIXEL - 1).div_euclid(PIXEL);
    let x = xs * dy + dx * (PIXEL * y - ys);
    let mut xi = -(-x).div_euclid(scale);
    let mut xf = x - xi * scale;
    while PIXEL * y < ye {
        output(xi, y);
        xi += mi;
        xf += mf;
        if xf > 0 {
            xi += 1;
            xf -= scale;
        }
        y += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::super::coverage::Coverage;
    use super::*;
    use fastrand::Rng;
    use glam::DVec2;

    const SIZE: usize = 24;

    fn pixels(corners: &[[i32; 2]]) -> Vec<(usize, usize)> {
        EdgeList::new(corners, SIZE).segments(SIZE).flat_map(|(y, xs)| xs.map(move |x| (x, y))).collect()
    }

    #[test]
    fn triangles_cover_what_edge_functions_say() {
        let mut random = Rng::with_seed(1);
        let mut covered = 0;
        for round in 0..4000 {
            // Coarse grids put many samples on edges and corners.
            let grid = [1, 4, 64, 128][round % 4];
            let corners = [(); 3].map(|()| [(); 2].map(|()| random.i32(-4 * 256 / grid..28 * 256 / grid) * grid));
            let exact = corners.map(|[x, y]| DVec2::new(f64::from(x), f64::from(y)) / 256.0);
            let exact: Vec<_> =
                Coverage::new(exact).map_or(vec![], |coverage| coverage.pixels(SIZE, SIZE).map(|(x, y, _)| (x, y)).collect());
            assert_eq!(pixels(&corners), exact, "{corners:?}");
            covered += exact.len();
        }
        assert!(covered > 100_000, "{covered}");
    }

    /// "Powerful enough to cope with concave polygons".
    #[test]
    fn a_concave_polygon_is_the_sum_of_its_triangles() {
        let corners = [[100, 100], [3000, 700], [5900, 90], [3100, 5800]];
        let [a, b, c, d] = corners;
        let mut sum = [pixels(&[a, b, d]), pixels(&[b, c, d])].concat();
        sum.sort_unstable_by_key(|&(x, y)| (y, x));
        assert_eq!(pixels(&corners), sum);
        let two = EdgeList::new(&corners, SIZE).lines.iter().filter(|line| line.len() == 4).count();
        assert!(two > 0, "it is convex");
    }

    /// The notes' polygon of 3 × 3 pixels, which must not become 4 × 4.
    #[test]
    fn a_polygon_of_nine_pixels_fills_nine() {
        assert_eq!(pixels(&[[256, 256], [1024, 256], [1024, 1024], [256, 1024]]).len(), 9);
    }
}
