//! Positions that are one and the same.

use std::collections::HashMap;

use crate::vector::{dot, sub, Vector};

/// Gives each position the number of the first one that is no farther from it than the tolerance.
pub(crate) fn weld(positions: &[Vector], tolerance: f64) -> Vec<usize> {
    if tolerance > 0.0 {
        near(positions, tolerance)
    } else {
        identical(positions)
    }
}

fn identical(positions: &[Vector]) -> Vec<usize> {
    let mut first = HashMap::new();
    // Adding zero makes −0 the same as 0.
    let key = |position: &Vector| position.map(|x| (x + 0.0).to_bits());
    positions.iter().enumerate().map(|(i, position)| *first.entry(key(position)).or_insert(i)).collect()
}

/// Sorts the first ones into cubes as wide as the tolerance, so that only 27 cubes need a look.
fn near(positions: &[Vector], tolerance: f64) -> Vec<usize> {
    let mut cubes: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    let mut firsts = Vec::with_capacity(positions.len());
    for (i, &position) in positions.iter().enumerate() {
        let cube = position.map(|x| (x / tolerance).floor() as i64);
        let is_near = |&&first: &&usize| {
            let gap = sub(positions[first], position);
            dot(gap, gap) <= tolerance * tolerance
        };
        let found = neighbours(cube).filter_map(|cube| cubes.get(&cube)).flatten().filter(is_near).min().copied();
        firsts.push(found.unwrap_or_else(|| {
            cubes.entry(cube).or_default().push(i);
            i
        }));
    }
    firsts
}

fn neighbours(cube: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    (0..27).map(move |n| {
        let offset = [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1];
        std::array::from_fn(|axis| cube[axis].saturating_add(offset[axis]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identical_and_near_ones() {
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [-0.0, 0.0, 0.0], [1.0, 0.009, 0.0], [1.0, 0.02, 0.0], [-0.001; 3]];
        assert_eq!(weld(&positions, 0.0), [0, 1, 0, 3, 4, 5]);
        assert_eq!(weld(&positions, 0.01), [0, 1, 0, 1, 4, 0]);
        assert_eq!(weld(&positions, f64::INFINITY), [0; 6]);
        assert_eq!(weld(&positions, f64::NAN), weld(&positions, 0.0));
    }

    #[test]
    fn a_tolerance_out_of_proportion() {
        assert_eq!(weld(&[[1e30; 3], [1e30; 3], [-1e30; 3]], 1e-30), [0, 0, 2]);
    }
}
