//! How far two pictures are apart.

use crate::{Format, Owner, Picture};

/// The measures between a reference picture and a drawn one, in levels of 8 bits.
///
/// Colours are compared only on *same-owner* pixels: those that show the same triangle in both pictures. One pixel of
/// the silhouette on the wrong side would otherwise drown all that shading does. How many pixels that leaves out is a
/// measure of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// Peak signal-to-noise ratio in dB for a peak of 255, of the squared difference averaged over the same-owner
    /// pixels and their three channels; infinite without any difference.
    pub psnr_db: f64,
    /// Absolute difference averaged over the same-owner pixels and their three channels, 0 to 255.
    pub mean: f64,
    /// Largest difference in any channel of a same-owner pixel.
    pub max: u8,
    /// Share of the same-owner pixels, 0 to 1, with a channel that is off by more than 4 levels.
    pub over4_share: f64,
    /// Same-owner pixels divided by `covered`, 0 to 1; 1 when nothing is covered.
    pub same_owner_share: f64,
    /// Number of pixels covered in one picture only, or by triangles that share no vertex.
    pub wrong_owner: usize,
    /// Number of pixels covered by two different triangles that share a vertex.
    pub wrong_neighbour: usize,
    /// Number of pixels covered in either picture: same owner, wrong owner and wrong neighbour together.
    pub covered: usize,
}

impl Measures {
    /// Compares two pictures of the same size.
    ///
    /// `triangles` holds the vertex numbers of each object's triangles, to tell neighbours; those of different objects
    /// share no vertex. The reference is [rounded](Picture::round) to 8 bits before it comes here: to `Gray8` for a
    /// `Gray8` picture, and to `Rgb888` for one of `Rgb888` *or* `Rgb565`. What the rounding to `Rgb565` costs by itself
    /// is `Measures::between(&reference.round::<Rgb888>(), &reference.round::<Rgb565>(), triangles)`.
    ///
    /// # Panics
    ///
    /// When the sizes differ, or an owner is not among `triangles`.
    #[must_use]
    pub fn between<R: Format, D: Format>(reference: &Picture<R>, drawn: &Picture<D>, triangles: &[&[[u32; 3]]]) -> Self {
        assert_eq!((reference.width, reference.height), (drawn.width, drawn.height), "sizes differ");
        let mut differences = Differences::default();
        let (mut wrong_owner, mut wrong_neighbour) = (0, 0);
        for (index, owners) in reference.owner.iter().zip(&drawn.owner).enumerate() {
            match owners {
                (None, None) => {}
                (Some(a), Some(b)) if a == b => {
                    differences.add(reference.color[index].levels(), drawn.color[index].levels());
                }
                (Some(a), Some(b)) if share_vertex(triangles, *a, *b) => wrong_neighbour += 1,
                _ => wrong_owner += 1,
            }
        }

        let same_owner = differences.pixels;
        let covered = same_owner + wrong_owner + wrong_neighbour;
        let samples = (3 * same_owner).max(1) as f64;
        Self {
            psnr_db: 10.0 * (255.0 * 255.0 * samples / differences.sum_of_squares as f64).log10(),
            mean: differences.sum as f64 / samples,
            max: differences.max,
            over4_share: differences.over4 as f64 / same_owner.max(1) as f64,
            same_owner_share: if covered == 0 { 1.0 } else { same_owner as f64 / covered as f64 },
            wrong_owner,
            wrong_neighbour,
            covered,
        }
    }
}

/// Whether two triangles of one object have a vertex in common.
fn share_vertex(triangles: &[&[[u32; 3]]], a: Owner, b: Owner) -> bool {
    let corners = |owner: Owner| triangles[owner.object as usize][owner.triangle as usize];
    a.object == b.object && corners(a).iter().any(|vertex| corners(b).contains(vertex))
}

/// What adds up over the same-owner pixels.
#[derive(Default)]
struct Differences {
    pixels: usize,
    over4: usize,
    sum: u64,
    sum_of_squares: u64,
    max: u8,
}

impl Differences {
    fn add(&mut self, a: [u8; 3], b: [u8; 3]) {
        let differences = [0, 1, 2].map(|channel| a[channel].abs_diff(b[channel]));
        let largest = differences.into_iter().max().unwrap_or(0);
        self.pixels += 1;
        self.over4 += usize::from(largest > 4);
        self.sum += differences.map(u64::from).iter().sum::<u64>();
        self.sum_of_squares += differences.map(|difference| u64::from(difference).pow(2)).iter().sum::<u64>();
        self.max = self.max.max(largest);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embedded_graphics::pixelcolor::{Gray8, Rgb888};

    /// Triangles 0 and 1 share the edge 1–2, triangle 2 stands alone; the second object has the same numbers.
    const TRIANGLES: &[&[[u32; 3]]] = &[&[[0, 1, 2], [2, 1, 3], [4, 5, 6]], &[[0, 1, 2]]];

    fn owner(object: u32, triangle: u32) -> Option<Owner> {
        Some(Owner { object, triangle })
    }

    fn row<const N: usize>(color: [[u8; 3]; N], owner: [Option<Owner>; N]) -> Picture<Rgb888> {
        let color = color.map(|[red, green, blue]| Rgb888::new(red, green, blue)).to_vec();
        Picture { width: N, height: 1, color, owner: owner.to_vec() }
    }

    #[test]
    fn every_kind_of_pixel_is_counted_once() {
        let black = [[0; 3]; 7];
        let a = [owner(0, 0), owner(0, 0), owner(0, 0), owner(0, 0), owner(0, 0), None, None];
        let b = [owner(0, 0), owner(0, 1), owner(0, 2), owner(1, 0), None, owner(0, 2), None];
        let measures = Measures::between(&row(black, a), &row(black, b), TRIANGLES);
        assert_eq!((measures.covered, measures.wrong_neighbour, measures.wrong_owner), (6, 1, 4));
        assert_eq!(measures.same_owner_share, 1.0 / 6.0);
    }

    #[test]
    fn colors_count_where_the_owner_is_the_same() {
        let owners = [owner(0, 0), owner(0, 1), owner(0, 2), owner(1, 0), None];
        let mut others = owners;
        others[3] = owner(0, 0);
        let a = row([[10, 20, 30], [100; 3], [7; 3], [0; 3], [0; 3]], owners);
        let b = row([[10, 25, 28], [104, 100, 100], [7; 3], [255; 3], [255; 3]], others);
        // Same owner: three pixels, nine samples; differences 5, 2 and 4.
        let measures = Measures::between(&a, &b, TRIANGLES);
        assert_eq!(measures.max, 5);
        assert_eq!(measures.mean, 11.0 / 9.0);
        assert_eq!(measures.over4_share, 1.0 / 3.0);
        assert!((measures.psnr_db - 10.0 * (65025.0 / (45.0 / 9.0_f64)).log10()).abs() < 1e-12);
        assert_eq!(measures, Measures::between(&b, &a, TRIANGLES));
    }

    #[test]
    fn the_least_difference_is_48_db() {
        let one = [owner(0, 0)];
        let measures = Measures::between(&row([[9; 3]], one), &row([[10; 3]], one), TRIANGLES);
        assert!((measures.psnr_db - 48.1308).abs() < 1e-4);
    }

    #[test]
    fn equal_pictures_are_infinitely_alike() {
        let picture = row([[1, 2, 3]], [owner(0, 0)]);
        let measures = Measures::between(&picture, &picture, TRIANGLES);
        assert_eq!((measures.psnr_db, measures.mean, measures.max), (f64::INFINITY, 0.0, 0));
        assert_eq!((measures.same_owner_share, measures.covered), (1.0, 1));
    }

    #[test]
    fn empty_pictures_are_infinitely_alike() {
        let blank = Picture::blank(2, 2, Gray8::new(0));
        let measures = Measures::between(&blank, &blank, &[]);
        assert_eq!((measures.psnr_db, measures.mean, measures.over4_share), (f64::INFINITY, 0.0, 0.0));
        assert_eq!((measures.same_owner_share, measures.covered), (1.0, 0));
    }

    #[test]
    fn grey_measures_as_one_channel_would() {
        let grey = |luma| Picture { width: 1, height: 1, color: vec![Gray8::new(luma)], owner: vec![owner(0, 0)] };
        let measures = Measures::between(&grey(100), &grey(110), TRIANGLES);
        assert_eq!((measures.mean, measures.max), (10.0, 10));
        assert!((measures.psnr_db - 20.0 * 25.5_f64.log10()).abs() < 1e-12);
    }
}
