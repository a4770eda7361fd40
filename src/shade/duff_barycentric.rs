//! The default: Phong shading by Duff's expression in barycentric form.

use super::{flat::bend_at_centroid, lit, Intensity, Paint, Shade, Shiny, Surface};
use crate::{
    math::{
        gradient::Gradient,
        interpolant::{Interpolant, Plane, Steps},
        power::Power,
        quadratic::{Differences, Quadratic},
        root::{inverse_root, near_inverse_root},
    },
    model::light::LightSource,
    scan::triangle::Triangle,
};

/// Phong shading by a few additions and look-ups a pixel.
///
/// With unit normals at the corners and barycentric coordinates λ, N = Σ λi ni has
/// `|N|² = 1 − u`, `u = 2 Σ e_ij λi λj`, `e_ij = 1 − n_i·n_j`, constants of the mesh; and N·L, N·H are linear on the screen. So
/// *Faster Phong Shading*'s Eq. 2b, `(ax + by + c)/√(dx² + exy + fy² + gx + hy + i)`, needs no vector products at set-up, and
/// is continuous across shared edges. `1/√` and the power are looked up: exact but for rounding.
///
/// Where normals bend little, as on most facets of a smooth mesh, N·L/|N| and N·H/|N| are as good as quadratic: each is then the
/// quadratic that has its exact values at the corners, d_i, and in the middles of the edges, `(d_i + d_j)/√(2(2 − e_ij))`. Along
/// an edge it depends on that edge alone, so neighbours of this kind fit without a seam; the other kind is less than a level of
/// 255 away. What remains for a pixel is two additions for each cosine. On the standard scene this costs 2.5 dB, of 62.6.
///
/// Where normals bend so much that u passes 63/64 it is clamped there, and the line counts the facet as bent.
#[derive(Clone, Copy, Debug)]
pub struct DuffBarycentric;

/// A facet, 4 + 48 · LIGHTS bytes; for lights in the scene 28 + 48 · LIGHTS.
#[derive(Clone, Copy, Debug)]
pub struct Facet<const LIGHTS: usize, N: Interpolant = Plane>(Cosines<[[Quadratic; 2]; LIGHTS], Steep<LIGHTS, N>>);

/// How the cosines run over a facet, or along a line, and whether a highlight can show.
#[derive(Clone, Copy, Debug)]
enum Cosines<G, S> {
    /// Normals bend so little that the cosines are quadratics: for each light that with l times its intensity, Q30, and the
    /// height of that with h.
    Gentle {
        shiny: Shiny,
        cosines: G,
    },
    Steep {
        shiny: Shiny,
        cosines: S,
    },
}

/// Numerators and denominator of the cosines apart: N is an interpolant on a facet, its steps along a line.
#[derive(Clone, Copy, Debug)]
pub struct Steep<const LIGHTS: usize, N, B = Quadratic> {
    /// For each light N·L (times its intensity) and N·H.
    dots: [[N; 2]; LIGHTS],
    /// u, Q28.
    bend: B,
}

/// What is stepped along a line.
#[derive(Clone, Copy, Debug)]
pub struct Registers<const LIGHTS: usize, N>(Cosines<[[Differences; 2]; LIGHTS], Steep<LIGHTS, N, Differences>>);

impl<const LIGHTS: usize, L: LightSource> Shade<LIGHTS, L> for DuffBarycentric {
    type Facet = Facet<LIGHTS, L::Product>;
    type Registers = Registers<LIGHTS, <L::Product as Interpolant>::Steps>;
    const EMPTY: Self::Facet = Facet(Cosines::Gentle { shiny: Shiny::NOT, cosines: [[Quadratic::ZERO; 2]; LIGHTS] });

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Self::Facet {
        let [e01, e12, e20] = triangle.edges.map(u32::from);
        let edge = e01.max(e12).max(e20);
        let middles = triangle.middles();
        let shiny = is_shiny(most(triangle, &middles), edge, &surface.material.power);
        let gradient = Gradient::new(triangle.points());
        let gradient = gradient.as_ref();
        if let Some(gradient) = gradient.filter(|_| !L::IN_SCENE) {
            if let Some(cosines) = gentle(triangle, edge, shiny.then_some(&surface.material.power), gradient) {
                return Facet(Cosines::Gentle { shiny: shiny.into(), cosines });
            }
        }
        Facet(Cosines::Steep { shiny: shiny.into(), cosines: Steep::new(triangle, &middles, shiny, gradient) })
    }

    #[inline]
    fn start(facet: &Self::Facet, x: i32, y: i32) -> Self::Registers {
        Registers(match &facet.0 {
            Cosines::Gentle { shiny, cosines } => {
                let cosines = cosines.each_ref().map(|pair| pair.each_ref().map(|one| one.along(x, y)));
                Cosines::Gentle { shiny: *shiny, cosines }
            }
            Cosines::Steep { shiny, cosines } => Cosines::Steep { shiny: *shiny, cosines: cosines.along(x, y) },
        })
    }

    /// Dull and shining pixels by quadratics, dull and shining ones by quotients.
    fn kind(Registers(cosines): &Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: usize, least: u32) -> usize {
        match cosines {
            Cosines::Gentle { shiny, cosines } => {
                (shiny.is() && shows(cosines, pixels, first::<LIGHTS>(&surface.material.power, least))).into()
            }
            Cosines::Steep { shiny, .. } => 2 + usize::from(shiny.is()),
        }
    }

    #[inline]
    fn run<P>(Registers(cosines): Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        let power = &surface.material.power;
        let shows = |heights: &_| shows(heights, pixels.len(), first::<LIGHTS>(power, paint.least()));
        match cosines {
            Cosines::Gentle { shiny, mut cosines } if shiny.is() && shows(&cosines) => {
                for pixel in pixels {
                    let mut intensity = Intensity::default();
                    for ([diffuse, height], strength) in cosines.iter_mut().zip(surface.intensities) {
                        intensity.diffuse += diffuse.next().max(0) as u32 >> 16;
                        intensity.specular += (power.at_height(height.next()) * u32::from(*strength)) >> 15;
                    }
                    *pixel = paint.mix(intensity.limited(LIGHTS));
                }
            }
            Cosines::Gentle { mut cosines, .. } => {
                for pixel in pixels {
                    let mut intensity = Intensity::default();
                    for [diffuse, _] in &mut cosines {
                        intensity.diffuse += diffuse.next().max(0) as u32 >> 16;
                    }
                    *pixel = paint.dull(intensity.limited(LIGHTS).diffuse);
                }
            }
            Cosines::Steep { shiny, cosines } => cosines.run::<P, L>(shiny.is(), surface, pixels, paint),
        }
    }
}

/// The first place in a power's table that shows, if less light than that does not; that of several lights may sum up.
#[inline(always)]
const fn first<const LIGHTS: usize>(power: &Power, least: u32) -> u32 {
    if LIGHTS > 1 {
        0
    } else {
        power.first(least)
    }
}

/// Whether a highlight can show on so many pixels, given that place.
#[inline(always)]
fn shows<const LIGHTS: usize>(cosines: &[[Differences; 2]; LIGHTS], pixels: usize, first: u32) -> bool {
    cosines.iter().any(|[_, height]| height.most(pixels as i32 - 1) >= Power::height_of(first))
}

/// Whether the power can show anywhere on the triangle, given its largest edge constant and what its product with h may reach.
pub(super) fn is_shiny(most: i32, edge: u32, power: &Power) -> bool {
    // N·H itself first: 1/|N| is one at least.
    most > (power.start() >> 17) as i32 || most_cosine(most, edge) > power.start() >> 2
}

/// At least as much as N·H/|N| reaches on the triangle, Q29, one at most, given the same.
///
/// |N| is nowhere less than by u = 2/3 of the largest edge constant, as Σ λi λj ≤ 1/3.
#[inline(always)]
pub(super) fn most_cosine(most: i32, edge: u32) -> u32 {
    // Where 1/|N| may pass 2, every facet that faces a highlight at all counts.
    if most <= 0 || edge > 1 << 15 {
        return if most > 0 { 1 << 29 } else { 0 };
    }
    // 2/3 of a Q15 number in Q28, without a division.
    let bend = edge * (16384 / 3 + 1);
    // Q14 · Q15, rounded up a little.
    ((most as u32 + 2) * (inverse_root(bend as i32) + 4)).min(1 << 29)
}

/// At least as much as N·H reaches with any light, Q14.
pub(super) fn most<const LIGHTS: usize, L: LightSource>(
    triangle: &Triangle<'_, LIGHTS, L>,
    middles: &[[[i16; 2]; LIGHTS]; 3],
) -> i32 {
    let [c0, c1, c2] = &triangle.corners;
    let dots = c0.dots.iter().chain(&c1.dots).chain(&c2.dots);
    let most = dots.map(|[_, specular]| *specular).max().unwrap_or(0).into();
    if !L::IN_SCENE {
        // Linear in between.
        return most;
    }
    // Above the corners by a third of the largest bow at most; a bow is four times what the middle is above the mean.
    let middle = middles.iter().flatten().map(|[_, specular]| *specular).max().unwrap_or(0);
    let least = c0.dots.iter().chain(&c1.dots).chain(&c2.dots).map(|[_, specular]| *specular).min().unwrap_or(0);
    let bow = 4 * (i32::from(middle) - i32::from(least)).max(0);
    (most + bow / 3).min(1 << 14)
}

/// The cosines as quadratics, heights where there is a power; none if normals bend too much for that.
fn gentle<const LIGHTS: usize, L: LightSource>(
    triangle: &Triangle<'_, LIGHTS, L>,
    edge: u32,
    power: Option<&Power>,
    gradient: &Gradient,
) -> Option<[[Quadratic; 2]; LIGHTS]> {
    if edge > GENTLE || power.is_some_and(|power| ((edge * edge) >> 14) * u32::from(power.exponent()) > GENTLE_SHINY) {
        return None;
    }
    let rises = triangle.edges.map(|e| rise(e.into()));
    let quadratic = |[v0, v1, v2]: [i32; 3], finer| {
        let [r01, r12, r20] = rises;
        let bows = [((v0 + v1) * r01) >> 14, ((v1 + v2) * r12) >> 14, ((v2 + v0) * r20) >> 14];
        Quadratic::new(gradient, [v0, v1, v2], bows, finer)
    };
    let mut cosines = [[Quadratic::ZERO; 2]; LIGHTS];
    let [c0, c1, c2] = &triangle.corners;
    for ([diffuse, height], ((v0, v1), v2)) in cosines.iter_mut().zip(c0.dots.iter().zip(&c1.dots).zip(&c2.dots)) {
        let ([l0, h0], [l1, h1], [l2, h2]) = (v0.map(i32::from), v1.map(i32::from), v2.map(i32::from));
        *diffuse = quadratic([l0, l1, l2], 16);
        if let Some(power) = power {
            let least = h0.min(h1).min(h2);
            let k = power.zeros();
            // Heights down to −3 · 2²⁹ do not overflow; nor does a quadratic of so many bits.
            if ((power.start() >> 17) as i32 - least) << k > 3 << 14 || 2 * gradient.exponent + 15 + k > Quadratic::MOST {
                return None;
            }
            *height = quadratic([h0, h1, h2], 15 + k);
            height.at = height.at.wrapping_sub(((power.start() >> 2) << k) as i32);
        }
    }
    Some(cosines)
}

/// The largest edge constant at which the diffuse cosines are quadratic, Q15: 48° between two normals.
pub(super) const GENTLE: u32 = 32768 / 3;
/// The same where a highlight shows, as e² times the exponent, Q16: what is off at the highlight's flank grows with both.
const GENTLE_SHINY: u32 = 65536 / 2;

/// `1/√(1 − e/2) − 1` for an edge constant up to [`GENTLE`], Q15: how much longer the normal gets in the middle of the edge.
///
/// By e/4 · (1 + 0.4 e); error at most 3·10⁻⁴, and 5·10⁻³ up to e = 1/2.
#[inline(always)]
pub(super) const fn rise(e: i32) -> i32 {
    (e * ((1 << 15) + ((e * 13107) >> 15))) >> 17
}

impl<const LIGHTS: usize, N: Interpolant> Steep<LIGHTS, N> {
    /// Whatever the triangle; N·H only if it is shiny.
    pub(super) fn new<L: LightSource>(
        triangle: &Triangle<'_, LIGHTS, L>,
        middles: &[[[i16; 2]; LIGHTS]; 3],
        shiny: bool,
        gradient: Option<&Gradient>,
    ) -> Self {
        let mut dots = [[N::ZERO; 2]; LIGHTS];
        let ([c0, c1, c2], [m01, m12, m20]) = (&triangle.corners, middles);
        let corners = c0.dots.iter().zip(&c1.dots).zip(&c2.dots);
        let middles = m01.iter().zip(m12).zip(m20);
        for (([diffuse, specular], ((v0, v1), v2)), ((m01, m12), m20)) in dots.iter_mut().zip(corners).zip(middles) {
            let [[l0, h0], [l1, h1], [l2, h2]] = [*v0, *v1, *v2].map(|dots| dots.map(i32::from));
            let [[l01, h01], [l12, h12], [l20, h20]] = [*m01, *m12, *m20].map(|dots| dots.map(i32::from));
            *diffuse = N::through(gradient, [l0, l1, l2], [l01, l12, l20]);
            if shiny {
                *specular = N::through(gradient, [h0, h1, h2], [h01, h12, h20]);
            }
        }
        let edge = triangle.edges.iter().fold(0, |most, e| most.max(*e));
        Self { dots, bend: bend(gradient, edge.into(), triangle.edges) }
    }

    /// Along line y of the picture, from pixel x on.
    #[inline(always)]
    pub(super) fn along(&self, x: i32, y: i32) -> Steep<LIGHTS, N::Steps, Differences> {
        let dots = self.dots.each_ref().map(|pair| pair.each_ref().map(|one| one.along(x, y)));
        Steep { dots, bend: self.bend.along(x, y) }
    }
}

impl<const LIGHTS: usize, N: Steps> Steep<LIGHTS, N, Differences> {
    /// Shades pixels.
    #[inline(always)]
    pub(super) fn run<P, L: LightSource>(
        self,
        shiny: bool,
        surface: &Surface<'_, LIGHTS>,
        pixels: &mut [P],
        paint: &impl Paint<P>,
    ) {
        let lit = |product| lit(product, L::Product::FINER);
        let Self { mut dots, mut bend } = self;
        if shiny {
            // Most of these pixels show no highlight: no more is done for them than to find that out.
            let power = &surface.material.power;
            let (start, shift, intensities) = (power.start(), power.shift(), *surface.intensities);
            let from = start + (first::<LIGHTS>(power, paint.least()) << shift);
            for pixel in pixels {
                let root = near_inverse_root(bend.next());
                let mut intensity = Intensity::default();
                for ([diffuse, specular], strength) in dots.iter_mut().zip(intensities) {
                    // Q16 · Q15: cosines in Q31.
                    intensity.diffuse += lit(diffuse.next()).wrapping_mul(root) >> 17;
                    let cos = lit(specular.next()).wrapping_mul(root);
                    if cos >= from {
                        intensity.specular += (power.entry((cos - start) >> shift) * u32::from(strength)) >> 15;
                    }
                }
                *pixel = paint.mix(intensity.limited(LIGHTS));
            }
        } else {
            for pixel in pixels {
                let root = near_inverse_root(bend.next());
                let mut intensity = Intensity::default();
                for [diffuse, _] in &mut dots {
                    intensity.diffuse += lit(diffuse.next()).wrapping_mul(root) >> 17;
                }
                *pixel = paint.dull(intensity.limited(LIGHTS).diffuse);
            }
        }
    }
}

/// u, Q28, given the edge constants and the largest of them; that at the centroid for the thinnest triangles where normals bend
/// most.
pub(super) fn bend(gradient: Option<&Gradient>, mut edge: u32, edges: &[u16; 3]) -> Quadratic {
    // Bows of 2e with 13 bits: Q14, and coarser for edges of 1/4 and more.
    let mut coarser = 0;
    while edge >= 1 << 13 {
        edge >>= 1;
        coarser += 1;
    }
    let bows = edges.map(|e| i32::from(e) >> coarser);
    match gradient {
        Some(gradient) if 2 * gradient.exponent + 14 + coarser <= Quadratic::MOST => {
            Quadratic::new(gradient, [0; 3], bows, 14 + coarser)
        }
        _ => Quadratic { at: bend_at_centroid(edges), ..Quadratic::ZERO },
    }
}
