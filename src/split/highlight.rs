//! Triangles into a fan around the centre of the highlight.

use heapless::Vec;

use super::{Corner, Parts, Split, Whole};
use crate::{
    math::weights::Weights,
    model::{highlight::is_potential, light::LightSource},
    shade::Intensity,
};

/// Highlight subdivision: a vertex at the centre of the highlight, and others on the way from there to the corners, each half way
/// to the one before, until the intensity interpolated half way is off by no more than a threshold.
///
/// *Adaptive Shading*, §3.1. Where the [centre](crate::model::highlight::Bent::center) falls outside the triangle, the vertex is on
/// an edge and splits the triangle in two. It is found in space and put at the same share of the corners on the screen. Along each
/// edge from there to a corner, both sides ask the same question, so that the parts fit. Of several highlights, the brightest at
/// its centre is taken; neighbours are left alone. The number of parts does not depend on the size on the screen, 39 at most. A
/// light in the very direction of the viewer makes no plane with it, and no centre is found.
///
/// At 0.3 and exponent 20, by Gouraud shading: 20.5 dB of one big triangle that has 13.7 when whole, 30.8 for 27.1 of a sphere of 80
/// triangles, 31.8 for 30.3 of the standard teapot. What it shows is a star rather than a disc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AtHighlight {
    /// Share of the intensity, Q15.
    threshold: u16,
}

/// New vertices on the way to one corner, at most.
const MOST: usize = 6;

impl AtHighlight {
    /// With a threshold from 0.0 to 1.0, clamped, relative to the true intensity (ambient, diffuse and specular light on white);
    /// 0.3 in the document.
    #[must_use]
    pub const fn new(threshold: f32) -> Self {
        let scaled = (threshold * 32768.0 + 0.5) as u16;
        Self { threshold: if scaled > 1 << 15 { 1 << 15 } else { scaled } }
    }

    /// Whether an intensity is interpolated well enough.
    fn fits(self, interpolated: u32, exact: u32) -> bool {
        u64::from(interpolated.abs_diff(exact)) << 15 <= u64::from(exact) * u64::from(self.threshold)
    }

    /// The places from a corner towards the centre, the corner first, the centre left out.
    fn ray<const LIGHTS: usize, L: LightSource>(
        self,
        whole: &Whole<'_, LIGHTS, L>,
        parts: &mut Parts<'_, LIGHTS>,
        center: Weights,
        corner: Corner,
    ) -> Option<Ray> {
        let mut ray = Ray::new();
        let _ = ray.push(corner);
        let (_, corner) = corner;
        let (near, mut far) = (gray(whole, center), gray(whole, corner));
        for halves in 1..=MOST {
            let middle = center.towards(corner, (1 << 30) >> halves);
            let exact = gray(whole, middle);
            if self.fits((near + far) / 2, exact) {
                break;
            }
            let _ = ray.push(parts.vertex(whole, middle)?);
            far = exact;
        }
        Some(ray)
    }
}

type Ray = Vec<Corner, { MOST + 1 }>;

/// The intensity on white at a place, Q28: less than 5, so that two have a sum.
fn gray<const LIGHTS: usize, L: LightSource>(whole: &Whole<'_, LIGHTS, L>, place: Weights) -> u32 {
    let Intensity { diffuse, specular } = whole.intensity(place);
    let material = whole.surface.material;
    ((u32::from(material.ambient) << 14) + diffuse * u32::from(material.diffuse) + specular * u32::from(material.specular)) >> 1
}

impl<const LIGHTS: usize, L: LightSource> Split<LIGHTS, L> for AtHighlight {
    const NEIGHBOURS: bool = false;

    fn split(&self, whole: &Whole<'_, LIGHTS, L>, parts: &mut Parts<'_, LIGHTS>) -> Option<()> {
        let centers = whole.aims.iter().filter(|aim| is_potential(whole.bent.leans(*aim)));
        let centers = centers.filter_map(|aim| whole.bent.center(aim, whole.numbers()));
        let Some(center) = centers.max_by_key(|center| whole.intensity(*center).specular) else { return Some(()) };
        let shares = center.shares();
        if shares.iter().filter(|share| **share > 0).count() < 2 {
            // A corner is at the centre.
            return Some(());
        }
        let top = parts.vertex(whole, center)?;
        let [c0, c1, c2] = Parts::corners(whole);
        let mut ray = |corner| self.ray(whole, parts, center, corner);
        let (r0, r1, r2) = (ray(c0)?, ray(c1)?, ray(c2)?);
        for ((mut left, mut right), share) in [(&*r1, &*r2), (&*r2, &*r0), (&*r0, &*r1)].into_iter().zip(shares) {
            if share == 0 {
                // The centre is on the edge between them.
                continue;
            }
            // From the edge inwards, in turn on both sides.
            while let ([a, rest_a @ ..], [b, rest_b @ ..]) = (left, right) {
                let next = match (rest_a.first(), rest_b.first()) {
                    (Some(next), other) if other.is_none() || rest_a.len() >= rest_b.len() => {
                        left = rest_a;
                        next
                    }
                    (_, Some(next)) => {
                        right = rest_b;
                        next
                    }
                    _ => {
                        (left, right) = (&[], &[]);
                        &top
                    }
                };
                parts.triangle(whole, [*a, *b, *next])?;
            }
        }
        Some(())
    }
}
