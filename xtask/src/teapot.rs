//! Newell's teapot at any fineness, from the finest of the models: its patches are bicubic, so sixteen points of each tell all of it.

use crate::project;
use anyhow::{ensure, Context, Result};
use std::collections::HashMap;
use std::fmt::Write;

type Point = [f64; 3];

/// The model that the patches are read from, its divisions of a patch, and its rows that are read.
const MODEL: &str = "examples/models/teapot-5560.obj";
const DIVISIONS: usize = 10;
const ROWS: [usize; 4] = [0, 3, 7, 10];
const PATCHES: usize = 28;

/// The points of a patch at [`ROWS`] down and across.
type Patch = [[Point; 4]; 4];

/// The teapot of so many divisions of a patch, as an OBJ with analytic normals.
///
/// # Errors
/// If the model is not as expected.
pub(crate) fn obj(divisions: usize) -> Result<String> {
    let text = std::fs::read_to_string(project::root().join(MODEL)).context(MODEL)?;
    let mut out = format!("# Newell's teapot, {divisions}x{divisions} per patch, from {MODEL}\n");
    let mut faces = String::new();
    let mut numbers = HashMap::new();
    for patch in patches(&text)? {
        let mut vertex = |down: usize, across: usize| {
            let (point, normal) = at(&patch, down as f64 / divisions as f64, across as f64 / divisions as f64);
            let grid = |v: Point, step: f64| v.map(|c| (c / step).round() as i64);
            let next = numbers.len() + 1;
            *numbers.entry((grid(point, 1e-5), grid(normal, 2e-2))).or_insert_with(|| {
                let ([x, y, z], [a, b, c]) = (point, normal);
                let _ = writeln!(out, "v {x:.6} {y:.6} {z:.6}\nvn {a:.6} {b:.6} {c:.6}");
                next
            })
        };
        for (down, across) in (0..divisions).flat_map(|down| (0..divisions).map(move |across| (down, across))) {
            let [a, b] = [vertex(down, across), vertex(down, across + 1)];
            let [c, d] = [vertex(down + 1, across + 1), vertex(down + 1, across)];
            for [a, b, c] in [[a, b, c], [a, c, d]] {
                if a != b && b != c && c != a {
                    let _ = writeln!(faces, "f {a}//{a} {b}//{b} {c}//{c}");
                }
            }
        }
    }
    Ok(out + &faces)
}

/// The patches of the model: its faces are the two triangles a b c and a c d of each square, row by row, patch by patch. Where a row's
/// upper or lower side is a single point, one of the two is missing.
fn patches(text: &str) -> Result<Vec<Patch>> {
    let mut points: Vec<Point> = Vec::new();
    let mut faces: Vec<[usize; 3]> = Vec::new();
    for line in text.lines() {
        let words: Vec<_> = line.split_whitespace().collect();
        match words[..] {
            ["v", x, y, z] => points.push([x.parse()?, y.parse()?, z.parse()?]),
            ["f", a, b, c] => {
                let number = |word: &str| word.split('/').next().unwrap_or_default().parse();
                faces.push([number(a)?, number(b)?, number(c)?]);
            }
            _ => {}
        }
    }
    let mut faces = faces.into_iter().peekable();
    let mut square = || -> Option<[usize; 4]> {
        let [a, b, c] = faces.next()?;
        match faces.peek() {
            Some(&[same, also, d]) if (same, also) == (a, c) => {
                faces.next();
                Some([a, b, c, d])
            }
            // The next one fans out from the same point: above is a single point.
            Some(&[same, _, also]) if (same, also) == (a, b) => Some([a, a, b, c]),
            // The last of such a row, or one of a row with a single point below: told apart below.
            _ => Some([a, b, c, 0]),
        }
    };
    let mut all = Vec::new();
    for _ in 0..PATCHES {
        let squares: Option<Vec<_>> = (0..DIVISIONS * DIVISIONS).map(|_| square()).collect();
        let mut squares = squares.context("the model ends too early")?;
        for row in squares.chunks_mut(DIVISIONS) {
            let above = row[0][0] == row[0][1];
            for corners in row.iter_mut().filter(|corners| corners[3] == 0) {
                let [a, b, c, _] = *corners;
                *corners = if above { [a, a, b, c] } else { [a, b, c, c] };
            }
        }
        let point = |down: usize, across: usize| {
            let [a, b, c, d] = squares[down.min(DIVISIONS - 1) * DIVISIONS + across.min(DIVISIONS - 1)];
            let number = match (down == DIVISIONS, across == DIVISIONS) {
                (false, false) => a,
                (false, true) => b,
                (true, true) => c,
                (true, false) => d,
            };
            points.get(number - 1).copied().with_context(|| format!("{MODEL} has no point {number}"))
        };
        let mut patch = Patch::default();
        for (row, down) in patch.iter_mut().zip(ROWS) {
            for (place, across) in row.iter_mut().zip(ROWS) {
                *place = point(down, across)?;
            }
        }
        all.push(patch);
    }
    ensure!(square().is_none(), "the model has more than {PATCHES} patches");
    Ok(all)
}

/// A point of a patch and its unit normal; where the patch's sides meet in a point, that of a point beside it.
fn at(patch: &Patch, down: f64, across: f64) -> (Point, Point) {
    let sum = |down: [f64; 4], across: [f64; 4]| -> Point {
        let mut sum = [0.0; 3];
        for (row, a) in patch.iter().zip(down) {
            for (point, b) in row.iter().zip(across) {
                (0..3).for_each(|axis| sum[axis] += a * b * point[axis]);
            }
        }
        sum
    };
    let normal = |down: f64, across: f64| {
        let [p, q] = [sum(weights(down).0, weights(across).1), sum(weights(down).1, weights(across).0)];
        [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    };
    let length = |v: Point| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    let mut found = normal(down, across);
    if length(found) < 1e-4 {
        found = normal(down.clamp(1e-3, 1.0 - 1e-3), across);
    }
    (sum(weights(down).0, weights(across).0), found.map(|c| c / length(found)))
}

/// Lagrange's weights of the four rows at a place from 0 to 1, and their derivatives.
fn weights(place: f64) -> ([f64; 4], [f64; 4]) {
    let nodes = ROWS.map(|row| row as f64 / DIVISIONS as f64);
    let others = |of: usize| nodes.into_iter().enumerate().filter(move |&(node, _)| node != of);
    let scale = |of: usize| others(of).map(|(_, node)| nodes[of] - node).product::<f64>();
    let weight = |of: usize| others(of).map(|(_, node)| place - node).product::<f64>() / scale(of);
    let slope = |of: usize| {
        let without = |left: usize| others(of).filter(|&(node, _)| node != left).map(|(_, node)| place - node).product::<f64>();
        others(of).map(|(node, _)| without(node)).sum::<f64>() / scale(of)
    };
    (std::array::from_fn(weight), std::array::from_fn(slope))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The coarsest of the models was made here.
    #[test]
    fn at_two_divisions_it_is_the_coarse_model() -> Result<()> {
        assert_eq!(obj(2)?, std::fs::read_to_string(project::root().join("examples/models/teapot-216.obj"))?);
        Ok(())
    }

    fn lines<'a>(text: &'a str, kind: &str) -> Vec<Vec<&'a str>> {
        let words = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
        words.filter(|words| words.first() == Some(&kind)).collect()
    }

    /// The other model is the same teapot, 4×4; each has the radius 1, so that they differ a little in size and place.
    #[test]
    fn at_four_divisions_it_is_the_other_model() -> Result<()> {
        let (made, model) = (obj(4)?, std::fs::read_to_string(project::root().join("examples/models/teapot-880.obj"))?);
        assert_eq!(lines(&made, "f").len(), lines(&model, "f").len());
        let numbers = |text: &str, kind| -> Vec<Point> {
            lines(text, kind).iter().map(|words| [1, 2, 3].map(|at| words[at].parse().unwrap())).collect()
        };
        let near = |a: &Point, b: &Point, by: f64| a.iter().zip(b).all(|(a, b)| (a - b).abs() < by);
        let (points, normals) = (numbers(&made, "v"), numbers(&made, "vn"));
        for (point, normal) in numbers(&model, "v").iter().zip(numbers(&model, "vn")) {
            let same: Vec<_> = points.iter().zip(&normals).filter(|(own, _)| near(own, point, 4e-3)).collect();
            assert!(same.iter().any(|(_, own)| near(own, &normal, 2e-2)), "{point:?} {normal:?}: {same:?}");
        }
        Ok(())
    }
}
