//! Which pixels a triangle covers.

use glam::DVec2;

/// A triangle on the screen: x right, y **down**, in pixels; the centre of pixel (x, y) is at (x + ½, y + ½).
///
/// ```text
///   0     1     2     3
/// 0 ┌─────┬─────┬─────┐     A pixel is covered when its centre lies inside,
///   │  ·  │  ·  │  ·  │     or on a left edge, or on a top edge.
/// 1 ├─────┼─────┼─────┤     So of two triangles that meet in an edge
///   │  ·  │  ·  │  ·  │     exactly one covers a centre on that edge.
/// 2 └─────┴─────┴─────┘
/// ```
///
/// From its two sides an edge is the same number with opposite signs, to the bit, so the rule holds for any coordinates.
pub(super) struct Coverage {
    corners: [DVec2; 3],
    front: bool,
}

impl Coverage {
    /// `None` if the triangle has no area.
    pub(super) fn new(corners: [DVec2; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let area = orientation(a, b, c);
        (area != 0.0).then_some(Self { corners, front: area < 0.0 })
    }

    /// Whether the corners run counter-clockwise, as seen.
    pub(super) fn is_front(&self) -> bool {
        self.front
    }

    /// The covered pixels `(x, y)` of a viewport, row by row, with the barycentric coordinates of their centres.
    pub(super) fn pixels(&self, width: usize, height: usize) -> impl Iterator<Item = (usize, usize, [f64; 3])> + '_ {
        let [a, b, c] = self.corners;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let columns = centers(low.x, high.x, width);
        centers(low.y, high.y, height)
            .flat_map(move |y| columns.clone().map(move |x| (x, y)))
            .filter_map(|(x, y)| Some((x, y, self.barycentric(DVec2::new(x as f64 + 0.5, y as f64 + 0.5))?)))
    }

    /// The barycentric coordinates of a covered point.
    fn barycentric(&self, point: DVec2) -> Option<[f64; 3]> {
        let [a, b, c] = self.corners;
        let opposite = [(b, c), (c, a), (a, b)];
        let mut weights = [0.0; 3];
        for (weight, (from, to)) in weights.iter_mut().zip(opposite) {
            // Clockwise, as seen, the inside is to the right of an edge, where orientation is positive.
            let (from, to) = if self.front { (to, from) } else { (from, to) };
            *weight = orientation(from, to, point);
            let top_or_left = to.y < from.y || (to.y == from.y && to.x > from.x);
            if *weight < 0.0 || (*weight == 0.0 && !top_or_left) {
                return None;
            }
        }
        let sum: f64 = weights.iter().sum();
        Some(weights.map(|weight| weight / sum))
    }
}

/// Twice the area of the triangle; positive when it runs clockwise, as seen. To exchange `a` and `b` turns only the sign.
fn orientation(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (a - c).perp_dot(b - c)
}

/// The pixels of `0..limit` whose centres lie from `low` to `high`.
fn centers(low: f64, high: f64, limit: usize) -> std::ops::Range<usize> {
    let first = (low - 0.5).ceil().max(0.0) as usize;
    let end = ((high - 0.5).floor() + 1.0).max(0.0) as usize;
    first..end.min(limit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastrand::Rng;

    const SIZE: usize = 16;

    fn covered(corners: [DVec2; 3]) -> Vec<(usize, usize)> {
        Coverage::new(corners).map_or(vec![], |coverage| coverage.pixels(SIZE, SIZE).map(|(x, y, _)| (x, y)).collect())
    }

    /// The same question in integers, put another way: moved right by next to nothing, and down by next to nothing of
    /// that, is the centre strictly inside? Units are 1/512 px, so that centres are whole; the shift is (2⁻²⁰, 2⁻⁴⁰).
    fn covers(corners: [[i128; 2]; 3], x: usize, y: usize) -> bool {
        let side = |from: usize, to: usize| {
            let [x0, y0] = corners[from];
            let [dx, dy] = [corners[to][0] - x0, corners[to][1] - y0];
            let [px, py] = [512 * x as i128 + 256 - x0, 512 * y as i128 + 256 - y0];
            (((dx * py - dy * px) << 40) + dx - (dy << 20)).signum()
        };
        let sides = [side(0, 1), side(1, 2), side(2, 0)];
        sides == [1; 3] || sides == [-1; 3]
    }

    #[test]
    fn agrees_with_integers_on_snapped_corners() {
        let mut random = Rng::with_seed(1);
        let mut on_an_edge = 0;
        for round in 0..2000 {
            // Coarse grids put many centres on edges and corners.
            let grid = [2, 8, 256, 512][round % 4];
            let corner = |random: &mut Rng| [(); 2].map(|()| random.i32(-2 * 512 / grid..18 * 512 / grid) * grid);
            let corners = [(); 3].map(|()| corner(&mut random));
            let expected: Vec<_> = (0..SIZE * SIZE)
                .map(|index| (index % SIZE, index / SIZE))
                .filter(|&(x, y)| covers(corners.map(|corner| corner.map(i128::from)), x, y))
                .collect();
            let corners = corners.map(|[x, y]| DVec2::new(f64::from(x) / 512.0, f64::from(y) / 512.0));
            assert_eq!(covered(corners), expected, "{corners:?}");
            on_an_edge += Coverage::new(corners)
                .map_or(0, |coverage| coverage.pixels(SIZE, SIZE).filter(|(_, _, weights)| weights.contains(&0.0)).count());
        }
        assert!(on_an_edge > 500, "the rule was hardly tried: {on_an_edge}");
    }

    #[test]
    fn triangles_around_a_point_neither_overlap_nor_leave_gaps() {
        let mut random = Rng::with_seed(2);
        for round in 0..200 {
            // A fan over the whole picture, around any point, or around a pixel's centre.
            let mut anywhere = || random.f64() * SIZE as f64;
            let center = if round % 2 == 0 { DVec2::new(anywhere(), anywhere()) } else { DVec2::new(5.5, 8.5) };
            let size = SIZE as f64;
            let mut rim = vec![DVec2::new(anywhere(), 0.0), DVec2::new(size, 0.0), DVec2::new(size, anywhere())];
            rim.extend([DVec2::new(size, size), DVec2::new(0.0, size), DVec2::new(0.0, anywhere()), DVec2::ZERO]);
            let mut times = [0; SIZE * SIZE];
            for index in 0..rim.len() {
                for (x, y) in covered([rim[index], rim[(index + 1) % rim.len()], center]) {
                    times[y * SIZE + x] += 1;
                }
            }
            assert_eq!(times, [1; SIZE * SIZE], "around {center}");
        }
    }

    #[test]
    fn an_edge_as_close_to_a_center_as_can_be_has_it_on_one_side() {
        let mut random = Rng::with_seed(5);
        let center = DVec2::new(7.5, 3.5);
        for _ in 0..1000 {
            let [a, left, right] = [(); 3].map(|()| DVec2::new(random.f64(), random.f64()) * 30.0 - 10.0);
            // The middle between `a` and `b` is the centre, but for rounding.
            let b = a + (center - a) * 2.0;
            let side = |point| orientation(a, b, point) > 0.0;
            if side(left) == side(right) {
                continue;
            }
            let times = [[a, b, left], [a, b, right]].map(|corners| covered(corners).contains(&(7, 3)));
            assert_ne!(times[0], times[1], "{a} {b}");
        }
    }

    #[test]
    fn barycentric_coordinates_belong_to_their_corners() {
        let corners = [DVec2::new(0.5, 0.5), DVec2::new(8.5, 0.5), DVec2::new(0.5, 4.5)];
        for turned in [false, true] {
            let corners = if turned { [corners[0], corners[2], corners[1]] } else { corners };
            let coverage = Coverage::new(corners).unwrap();
            assert_eq!(coverage.is_front(), turned);
            assert!(coverage.pixels(SIZE, SIZE).count() > 0);
            for (x, y, weights) in coverage.pixels(SIZE, SIZE) {
                let point: DVec2 = corners.iter().zip(weights).map(|(&corner, weight)| corner * weight).sum();
                assert!(point.distance(DVec2::new(x as f64 + 0.5, y as f64 + 0.5)) < 1e-12);
            }
        }
    }

    #[test]
    fn no_area_covers_nothing() {
        assert!(Coverage::new([DVec2::ZERO, DVec2::new(1.0, 3.0), DVec2::new(2.0, 6.0)]).is_none());
    }

    #[test]
    fn the_viewport_bounds_what_is_huge_or_elsewhere() {
        let huge = [DVec2::new(-1e9, -1e9), DVec2::new(3e9, 0.0), DVec2::new(0.0, 3e9)];
        assert_eq!(covered(huge).len(), SIZE * SIZE);
        assert!(covered(huge.map(|corner| corner - DVec2::splat(5e9))).is_empty());
    }
}
