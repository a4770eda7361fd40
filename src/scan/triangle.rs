//! A triangle as shading sees it.

use embedded_graphics::geometry::Point;

use super::{geometry::Numbers, vertex::Vertex};
use crate::{
    math::{product::scale, reciprocal::Reciprocal, screen::area, weights::Weights},
    model::{
        light::{Aim, Light, LightSource},
        mesh::MeshData,
    },
};

/// A triangle with all that set-up needs.
#[derive(Clone, Copy, Debug)]
pub struct Triangle<'f, const LIGHTS: usize, L: LightSource = Light> {
    /// Its corners; on the screen they may run either way round.
    pub corners: [&'f Vertex<LIGHTS>; 3],
    /// The edge constants of edges 01, 12, 20, Q15.
    pub edges: &'f [u16; 3],
    /// The lights as its object sees them.
    pub aims: &'f [L::Aim; LIGHTS],
    pub(crate) numbers: Numbers<'f>,
    /// The nearness of the corners of the triangle that it is a part of; 0 if that was clipped, or if nothing depends on positions.
    pub(crate) nearness: [u32; 3],
    /// Whether its normals are turned, as it is seen from behind.
    pub(crate) turned: bool,
    /// How far down a [ladder](crate::ladder) of methods it is to be shaded; 0 without one.
    pub rung: u8,
}

impl<const LIGHTS: usize, L: LightSource> Triangle<'_, LIGHTS, L> {
    /// Its corners on the screen.
    #[inline]
    #[must_use]
    pub fn points(&self) -> [Point; 3] {
        self.corners.map(|corner| corner.point())
    }

    /// Whether it is seen from behind.
    pub(crate) fn is_turned(&self) -> bool {
        let [a, b, c] = self.points();
        area(a, b, c) > 0
    }

    /// Its corners as seen from behind: with turned normals.
    pub(crate) fn turned(&self) -> [Vertex<LIGHTS>; 3] {
        let mut corners = self.corners.map(|corner| *corner);
        for corner in &mut corners {
            corner.dots = corner.dots.map(|dots| dots.map(i16::wrapping_neg));
        }
        corners
    }

    /// The unit normals at its corners, in the object's space, Q14.
    #[must_use]
    pub fn normals(&self) -> [[i16; 3]; 3] {
        let normals = self.whole(|data| data.normals);
        let normals = match self.numbers.part {
            None => normals,
            Some(made) => made.weights.map(|weights| weights.normal(normals)),
        };
        if self.turned {
            normals.map(|normal| normal.map(i16::wrapping_neg))
        } else {
            normals
        }
    }

    /// The positions of its corners in the mesh, Q15 of its extent.
    #[must_use]
    pub fn positions(&self) -> [[i16; 3]; 3] {
        let positions = self.whole(|data| data.positions);
        match self.numbers.part {
            None => positions,
            Some(made) => made.weights.map(|place| in_space(place, self.nearness).position(positions)),
        }
    }

    /// What the mesh has for the corners of the triangle that this one is, or is a part of.
    fn whole<'m>(&'m self, of: impl Fn(&'m MeshData<'m>) -> &'m [[i16; 3]]) -> [[i16; 3]; 3] {
        let data = self.numbers.object.mesh.data();
        let corners = data.triangles.get(usize::from(self.numbers.triangle)).copied().unwrap_or_default();
        corners.map(|corner| of(data).get(usize::from(corner)).copied().unwrap_or_default())
    }

    /// In the middles of edges 01, 12, 20 on the screen, for each light `[intensity · N·l, N·h]`, Q14: N the mean of the two
    /// normals, not normalised, l and h at the place that is seen there.
    #[must_use]
    pub fn middles(&self) -> [[[i16; 2]; LIGHTS]; 3] {
        self.samples([[1 << 13, 1 << 13, 0], [0, 1 << 13, 1 << 13], [1 << 13, 0, 1 << 13]])
    }

    /// The same at the centroid, with the mean of the three normals.
    #[must_use]
    pub fn centroid(&self) -> [[i16; 2]; LIGHTS] {
        const THIRD: u16 = (1 << 14) / 3;
        let [sample] = self.samples([[THIRD + 1, THIRD, THIRD]]);
        sample
    }

    /// The same at places given by their barycentric coordinates on the screen, Q14.
    fn samples<const N: usize>(&self, places: [[u16; 3]; N]) -> [[[i16; 2]; LIGHTS]; N] {
        if L::IN_SCENE {
            let (normals, positions) = (self.normals(), self.positions());
            let nearness = self.corners.map(|corner| corner.nearness());
            places.map(|place| {
                let normal = mean(place, normals);
                let position = mean(seen(place, nearness), positions);
                self.aims.each_ref().map(|aim| aim.dots(position, normal))
            })
        } else {
            let [c0, c1, c2] = self.corners;
            places.map(|place| {
                let mut dots = [[0; 2]; LIGHTS];
                for (dots, ((d0, d1), d2)) in dots.iter_mut().zip(c0.dots.iter().zip(&c1.dots).zip(&c2.dots)) {
                    let with_third = |[l, h]: [i16; 2]| [l, h, 0];
                    let [l, h, _] = mean(place, [with_third(*d0), with_third(*d1), with_third(*d2)]);
                    *dots = [l, h];
                }
                dots
            })
        }
    }
}

/// The barycentric coordinates in space, Q14, of what is seen at these on the screen, where corners have that nearness.
fn seen(place: [u16; 3], nearness: [u32; 3]) -> [u16; 3] {
    // Shares are as the screen's times the nearness: 14 bits for the largest.
    let up = nearness.iter().fold(1, |all, w| all | w).leading_zeros() as i32 - 18;
    let (mut shares, mut sum) = ([0; 3], 0);
    for ((share, part), w) in shares.iter_mut().zip(place).zip(nearness) {
        *share = (u32::from(part) * scale(w as i32, up) as u32) >> 14;
        sum += *share;
    }
    let inverse = Reciprocal::of(sum);
    let short = inverse.short();
    // 14 bits and 17; Q14.
    shares.map(|share| ((share * short) >> (33 - inverse.zeros).clamp(0, 31)) as u16)
}

/// The place in space that is seen at one on the screen, where corners have that nearness; itself if that is nothing.
pub(crate) fn in_space(place: Weights, nearness: [u32; 3]) -> Weights {
    if nearness.contains(&0) {
        return place;
    }
    let [w0, w1, _] = seen(place.shares().map(|share| share >> 1), nearness);
    let w0 = w0.min(1 << 14);
    Weights::new([2 * w0, 2 * w1.min((1 << 14) - w0), 0])
}

/// The mean with these weights, Q14.
fn mean([w0, w1, w2]: [u16; 3], [[ax, ay, az], [bx, by, bz], [cx, cy, cz]]: [[i16; 3]; 3]) -> [i16; 3] {
    let [w0, w1, w2] = [w0, w1, w2].map(i32::from);
    [(ax, bx, cx), (ay, by, cy), (az, bz, cz)]
        .map(|(a, b, c)| ((w0 * i32::from(a) + w1 * i32::from(b) + w2 * i32::from(c) + (1 << 13)) >> 14) as i16)
}
