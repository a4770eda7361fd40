//! For each triangle the cheapest way that is good enough.

use super::{
    duff_barycentric::{most, most_cosine, rise, Steep},
    flat::bend_at_centroid,
    quadratic_intensity::{self, finer, samples, Bowed, Cosines},
    Intensity, Paint, Shade, Shiny, Surface,
};
use crate::{
    math::{
        gradient::Gradient,
        interpolant::{Interpolant, Plane, Slope, Steps},
        quadratic::{Differences, Quadratic},
        root::inverse_root,
    },
    model::light::LightSource,
    scan::{pair::Pair, triangle::Triangle},
};

/// Shading by differences of the intensity where these are within `LEVELS` levels of 255, by Duff's expression elsewhere.
///
/// A facet is, with highlights of less than half of `LEVELS` left out,
///
/// - linear, where no highlight shows and the best plane for its diffuse intensity is no farther off than that at a corner;
/// - quadratic in both intensities, as [`QuadraticIntensity`](super::quadratic_intensity::QuadraticIntensity), where these agree with
///   the exact ones at the centroid; and where the highlight is not so narrow that six samples, or the quadratics through them, miss it;
/// - else exact, as [`DuffBarycentric`](super::duff_barycentric::DuffBarycentric) is on its steep facets.
///
/// Two triangles that share an edge get one facet, linear in both intensities, where their planes of the diffuse one differ by no more
/// than that, and the specular one, if it shows, is bowed, and twisted, by no more than twice what that allows.
///
/// A ladder from the papers' parts: the differences are those of *Faster Phong Shading*, §2.2, the exact form is its Eq. 2b. On the
/// standard scene the worst frame is 54 dB from the f64 reference with 2 levels, 51 dB with 4, 48 dB with 8 (the exact form alone: 60 dB). Single
/// pixels are off by more than `LEVELS`, as the centroid stands for the whole facet; shared edges show steps of about `LEVELS`.
#[derive(Clone, Copy, Debug)]
pub struct Hybrid<const LEVELS: u32 = 2>;

/// A facet, 52 bytes for one light.
#[derive(Clone, Copy, Debug)]
pub struct Facet<const LIGHTS: usize, N: Interpolant>(Kind<Plane, [Quadratic; 2], Steep<LIGHTS, N>>);

/// What is stepped along a line.
#[derive(Clone, Copy, Debug)]
pub struct Registers<const LIGHTS: usize, N: Steps>(Kind<Slope, [Differences; 2], Steep<LIGHTS, N, Differences>>);

/// How light runs over a facet, or along a line, and whether a highlight shows.
#[derive(Clone, Copy, Debug)]
enum Kind<A, B, C> {
    /// Diffuse intensity alone, in the format of [`finer`].
    Linear(A),
    /// Diffuse and specular intensity, likewise.
    Quadratic { shiny: Shiny, intensity: B },
    /// Cosines, their numerators and denominator apart.
    Exact { shiny: Shiny, cosines: C },
}

impl<const LEVELS: u32, const LIGHTS: usize, L: LightSource> Shade<LIGHTS, L> for Hybrid<LEVELS> {
    type Facet = Facet<LIGHTS, L::Product>;
    type Registers = Registers<LIGHTS, <L::Product as Interpolant>::Steps>;
    const BY_PAIR: bool = !L::IN_SCENE;
    const EMPTY: Self::Facet = Facet(Kind::Linear(Plane::ZERO));

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Self::Facet {
        let gradient = Gradient::new(triangle.points());
        let gradient = gradient.as_ref();
        let middles = triangle.middles();
        let [e01, e12, e20] = triangle.edges.map(u32::from);
        let edge = e01.max(e12).max(e20);
        let material = surface.material;
        let most = LIGHTS as u32 * material.power.at(most_cosine(most(triangle, &middles), edge) << 2);
        let shiny = !within(most as i32, material.specular, LEVELS / 2);
        if !shiny && edge <= GENTLE {
            let diffuse = gentle(triangle, &middles);
            if is_linear::<LEVELS>(&diffuse, material.diffuse) {
                return Facet(Kind::Linear(plane::<LIGHTS>(gradient, &diffuse)));
            }
        }
        curved::<LEVELS, LIGHTS, L>(triangle, surface, gradient, &middles, shiny)
    }

    #[inline(always)]
    fn pair(pair: &Pair<'_, LIGHTS>, surface: &Surface<'_, LIGHTS>, facet: &mut Self::Facet) -> bool {
        joined::<LEVELS, LIGHTS, L>(pair, surface, facet)
    }

    #[inline]
    fn start(facet: &Self::Facet, x: i32, y: i32) -> Self::Registers {
        Registers(match &facet.0 {
            Kind::Linear(diffuse) => Kind::Linear(diffuse.along(x, y)),
            Kind::Quadratic { shiny, intensity } => {
                Kind::Quadratic { shiny: *shiny, intensity: intensity.each_ref().map(|one| one.along(x, y)) }
            }
            Kind::Exact { shiny, cosines } => Kind::Exact { shiny: *shiny, cosines: cosines.along(x, y) },
        })
    }

    #[inline]
    fn run<P>(Registers(light): Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        match light {
            Kind::Linear(mut diffuse) => {
                for pixel in pixels {
                    let value = diffuse.next();
                    let intensity = Intensity { diffuse: (value & !(value >> 31)) as u32 >> finer(LIGHTS), specular: 0 };
                    *pixel = paint.dull(intensity.limited(LIGHTS).diffuse);
                }
            }
            Kind::Quadratic { shiny, intensity } => {
                quadratic_intensity::Registers { shiny: shiny.is(), intensity }.run::<P, LIGHTS>(pixels, paint)
            }
            Kind::Exact { shiny, cosines } => cosines.run::<P, L>(shiny.is(), surface, pixels, paint),
        }
    }
}

/// The largest edge constant at which the diffuse intensity is sampled the cheap way, Q15: 60° between two normals.
const GENTLE: u32 = 1 << 14;

/// The largest bow of what is linear, for each level of tolerance: the best plane is off by a quarter of that at the corners, where
/// all bows are equal, and by 1/16 in the root mean square.
const LINEAR: u32 = 4;

/// The largest bow of a quadratic highlight, for each level of tolerance: that the centroid agrees may be chance with more.
const BOW: u32 = 6;

/// What the exponent and the largest edge constant may make where a highlight is linear or quadratic: with more, it falls between
/// samples.
const NARROW: u32 = 4;

/// Whether an intensity, Q14, times a coefficient, Q15, is no more than so many levels of 255.
#[inline(always)]
fn within(intensity: i32, coefficient: u16, levels: u32) -> bool {
    const LEVEL: u32 = (1 << 29) / 255;
    intensity.unsigned_abs().min(0xffff) * u32::from(coefficient) <= levels.saturating_mul(LEVEL)
}

/// Whether diffuse light is as good as linear.
#[inline(always)]
fn is_linear<const LEVELS: u32>(diffuse: &Bowed, coefficient: u16) -> bool {
    let most = diffuse.bows.iter().fold(0, |most, bow| bow.unsigned_abs().max(most));
    within(most as i32, coefficient, LEVELS.saturating_mul(LINEAR))
}

/// Sets up one facet for two triangles, if one plane is as good for their light as two are; whether it did.
#[inline(always)]
fn joined<const LEVELS: u32, const LIGHTS: usize, L: LightSource>(
    pair: &Pair<'_, LIGHTS>,
    surface: &Surface<'_, LIGHTS>,
    facet: &mut Facet<LIGHTS, L::Product>,
) -> bool {
    let [[ab, bc, _], [ac, cd, da]] = pair.edges.map(|edges| edges.map(u32::from));
    let edge = ab.max(bc).max(ac).max(cd).max(da);
    if edge > GENTLE {
        return false;
    }
    let material = surface.material;
    let heights = pair.corners.iter().flat_map(|corner| corner.dots.iter().map(|[_, height]| *height));
    let most = heights.max().unwrap_or(0).max(0) as u32;
    // As `most_cosine` has it; for edges up to this 1/|N| is at most 1 + e/3 + e²/4.
    let cosine = most * ((1 << 15) + ((edge * ((1 << 15) / 3 + 1 + (edge >> 2))) >> 15));
    let most = LIGHTS as u32 * material.power.at(cosine.min(1 << 29) << 2);
    if !within(most as i32, material.specular, LEVELS / 2) {
        return glossy::<LEVELS, LIGHTS, L>(pair, surface, edge, facet);
    }
    let Some((diffuse, _)) = level::<LEVELS, LIGHTS>(pair, surface, edge) else { return false };
    facet.0 = Kind::Linear(diffuse);
    true
}

/// The same where a highlight may show: then one plane has to be as good for that, too.
#[inline(never)]
fn glossy<const LEVELS: u32, const LIGHTS: usize, L: LightSource>(
    pair: &Pair<'_, LIGHTS>,
    surface: &Surface<'_, LIGHTS>,
    edge: u32,
    facet: &mut Facet<LIGHTS, L::Product>,
) -> bool {
    let material = surface.material;
    if edge * u32::from(material.power.exponent()) > NARROW << 15 {
        return false;
    }
    let Some((diffuse, gradient)) = level::<LEVELS, LIGHTS>(pair, surface, edge) else { return false };
    let Some(specular) = shine::<LEVELS, LIGHTS>(pair, surface) else { return false };
    if specular.is_zero() {
        facet.0 = Kind::Linear(diffuse);
        return true;
    }
    let (specular, apart) = specular.plane::<LIGHTS>(pair, &gradient);
    if !within(apart, material.specular, LEVELS.saturating_mul(GLOSS * TWIST)) {
        return false;
    }
    facet.0 = Kind::Quadratic { shiny: true.into(), intensity: [diffuse.into(), specular.into()] };
    true
}

/// The plane of a pair's diffuse light, if one is as good as two, and the gradient that it was made with.
#[inline(always)]
fn level<const LEVELS: u32, const LIGHTS: usize>(
    pair: &Pair<'_, LIGHTS>,
    surface: &Surface<'_, LIGHTS>,
    edge: u32,
) -> Option<(Plane, Gradient)> {
    let mut corners = [0; 4];
    for light in 0..LIGHTS {
        let lights = pair.corners.map(|corner| corner.dots.get(light).map_or(0, |[diffuse, _]| i32::from(*diffuse)));
        let is_lit = |value: &i32| *value > 0;
        if LIGHTS > 1 && lights.iter().any(is_lit) != lights.iter().all(is_lit) {
            return None;
        }
        for (corner, light) in corners.iter_mut().zip(lights) {
            *corner = if LIGHTS > 1 { (*corner + light.max(0)).min(Intensity::MOST as i32) } else { light };
        }
    }
    let within_levels = |value: i32, levels: u32| within(value, surface.material.diffuse, LEVELS.saturating_mul(levels));
    let brightest = corners.iter().fold(0, |most, value| value.abs().max(most));
    if !within_levels((brightest * rise(edge as i32)) >> 13, LINEAR) {
        return None;
    }
    let [a, b, c, d] = pair.corners.map(|corner| corner.point());
    if (b.x - a.x).unsigned_abs().max((b.y - a.y).unsigned_abs()) >= 1 << 13 {
        return None;
    }
    let gradient = Gradient::new([a, c, a + d - b])?;
    // A bow is about ends · e/2, and its mean over a triangle a twelfth of it.
    let [[ab, bc, _], [ac, cd, da]] = pair.edges.map(|edges| edges.map(i32::from));
    let edges = (ab + bc + 2 * ac + cd + da) >> 3;
    let lift = (((corners.iter().sum::<i32>() * edges) >> 15) * 43) >> 9;
    let (plane, apart) = Lifted { corners, lift }.plane::<LIGHTS>(pair, &gradient);
    within_levels(apart, TWIST).then_some((plane, gradient))
}

/// The specular intensity of a pair, nothing if it is faint; none if it is bowed too much to be linear.
#[inline(always)]
fn shine<const LEVELS: u32, const LIGHTS: usize>(pair: &Pair<'_, LIGHTS>, surface: &Surface<'_, LIGHTS>) -> Option<Lifted> {
    let [[ab, bc, _], [ac, ..]] = pair.edges.map(|edges| edges.map(i32::from));
    let (mut corners, mut middles) = ([0; 4], [0; 3]);
    for (light, strength) in surface.intensities.iter().enumerate() {
        let [a, b, c, d] = pair.corners.map(|corner| corner.dots.get(light).map_or(0, |[_, height]| i32::from(*height)));
        let power = |height: i32| {
            let power = surface.material.power.at((height.max(0) as u32) << 17);
            ((power * u32::from(*strength)) >> 15) as i32
        };
        for (corner, height) in corners.iter_mut().zip([a, b, c, d]) {
            *corner += power(height);
        }
        // Across the other two edges it is bowed about as across those that face them.
        for (middle, (sum, e)) in middles.iter_mut().zip([(a + b, ab), (b + c, bc), (c + a, ac)]) {
            *middle += power((sum + ((sum * rise(e)) >> 15)) >> 1);
        }
    }
    let limited = |sum: i32| sum.min(Intensity::MOST as i32);
    let (corners, middles) = (corners.map(limited), middles.map(limited));
    let within_levels = |value: i32, levels: u32| within(value, surface.material.specular, levels);
    let most = corners.iter().chain(&middles).fold(0, |most, value| *value.max(&most));
    if within_levels(most, LEVELS / 2) {
        return Some(Lifted::ZERO);
    }
    let ([va, vb, vc, _], [ab, bc, ca]) = (corners, middles);
    let bows = [4 * ab - 2 * (va + vb), 4 * bc - 2 * (vb + vc), 4 * ca - 2 * (vc + va)];
    let is_linear = bows.iter().all(|bow| within_levels(*bow, LEVELS.saturating_mul(GLOSS * LINEAR)));
    is_linear.then(|| Lifted { corners, lift: bows.iter().sum::<i32>() / 12 })
}

/// An intensity of a pair, Q14: at its corners, and by how much its mean over both triangles is above that between them.
struct Lifted {
    corners: [i32; 4],
    lift: i32,
}

impl Lifted {
    /// None at all.
    const ZERO: Self = Self { corners: [0; 4], lift: 0 };

    /// Whether it is that.
    #[inline(always)]
    fn is_zero(&self) -> bool {
        self.corners.iter().fold(self.lift, |all, value| all | value) == 0
    }

    /// The plane nearest to it, and twice by how much the diagonals pass each other by; with the gradient of corners 0, 2 and what 3 is
    /// beside 1.
    ///
    /// The plane rises along both diagonals as the corners do. Where these pass each other by, it is a third of that off at the ends of
    /// the one that is an edge, and two thirds at the others: least squares for a parallelogram.
    #[inline(always)]
    fn plane<const LIGHTS: usize>(&self, pair: &Pair<'_, LIGHTS>, gradient: &Gradient) -> (Plane, i32) {
        let [va, vb, vc, vd] = self.corners;
        let [a, b, ..] = pair.corners.map(|corner| corner.point());
        let finer = finer(LIGHTS);
        let [at, x, y] = gradient.linear_here(va, vc - va, vd - vb, finer);
        // Steps in quarters of a unit for a pixel are as exact as is needed, and do not overflow.
        let climb = ((x >> (finer - 2)) * (b.x - a.x)).wrapping_add((y >> (finer - 2)) * (b.y - a.y)) >> 10;
        let apart = vb - va - climb;
        let at = at.wrapping_add((self.lift + ((11 * apart) >> 5)).wrapping_shl(finer as u32));
        (Plane { at, x, y }, 2 * apart)
    }
}

/// How far the diagonals of two triangles with one plane may pass each other by, twice that for each level of tolerance: a corner is then
/// off by one.
const TWIST: u32 = 3;

/// How much farther a highlight may be off than diffuse light where two triangles have one plane: few do.
const GLOSS: u32 = 2;

/// The plane nearest to an intensity, by least squares: a bow of one lifts the corners at its ends by 3/20, the other by −1/20.
fn plane<const LIGHTS: usize>(gradient: Option<&Gradient>, &Bowed { corners, bows }: &Bowed) -> Plane {
    let ([v0, v1, v2], [b01, b12, b20]) = (corners, bows);
    // In 512ths: 3/20 of the sum, less 1/5 of the bow across.
    let sum = 77 * (b01 + b12 + b20);
    let corners = [(v0, b12), (v1, b20), (v2, b01)].map(|(value, across)| value + ((sum - 102 * across) >> 9));
    Plane::new(gradient, corners, finer(LIGHTS))
}

/// The diffuse intensity by six samples, for edge constants up to [`GENTLE`].
#[inline(always)]
fn gentle<const LIGHTS: usize, L: LightSource>(triangle: &Triangle<'_, LIGHTS, L>, middles: &[[[i16; 2]; LIGHTS]; 3]) -> Bowed {
    let sum = |dots: &[[i16; 2]; LIGHTS]| {
        let lit = |[diffuse, _]: &[i16; 2]| if LIGHTS > 1 { i32::from(*diffuse).max(0) } else { (*diffuse).into() };
        dots.iter().map(lit).sum::<i32>().min(Intensity::MOST as i32)
    };
    let ([c0, c1, c2], [m01, m12, m20]) = (triangle.corners, middles);
    let (v0, v1, v2) = (sum(&c0.dots), sum(&c1.dots), sum(&c2.dots));
    let bow = |middle: &[[i16; 2]; LIGHTS], e: u16, ends: i32| {
        let middle = sum(middle);
        4 * middle + ((middle * rise(e.into())) >> 13) - 2 * ends
    };
    let [e01, e12, e20] = *triangle.edges;
    Bowed { corners: [v0, v1, v2], bows: [bow(m01, e01, v0 + v1), bow(m12, e12, v1 + v2), bow(m20, e20, v2 + v0)] }
}

/// A facet of any kind.
#[inline(never)]
fn curved<const LEVELS: u32, const LIGHTS: usize, L: LightSource>(
    triangle: &Triangle<'_, LIGHTS, L>,
    surface: &Surface<'_, LIGHTS>,
    gradient: Option<&Gradient>,
    middles: &[[[i16; 2]; LIGHTS]; 3],
    shiny: bool,
) -> Facet<LIGHTS, L::Product> {
    let material = surface.material;
    let exact = || Facet(Kind::Exact { shiny: shiny.into(), cosines: Steep::new(triangle, middles, shiny, gradient) });
    let edge = triangle.edges.iter().fold(0, |most, e| most.max(*e));
    if shiny && u32::from(edge) * u32::from(material.power.exponent()) > NARROW << 15 {
        return exact();
    }
    let samples = samples(triangle, middles);
    let centroid = Cosines::between(&triangle.centroid(), inverse_root(bend_at_centroid(triangle.edges)));
    let agrees = |bowed: &Bowed, exact: i32, coefficient| {
        within(bowed.nine_at_centroid() - 9 * exact, coefficient, LEVELS.saturating_mul(9))
    };

    let diffuse = Bowed::new(samples, Cosines::diffuse);
    let is_linear = is_linear::<LEVELS>(&diffuse, material.diffuse);
    let mut is_good = is_linear || agrees(&diffuse, centroid.diffuse(), material.diffuse);
    let mut shows = shiny;
    let mut specular = Bowed::default();
    if shiny && is_good {
        specular = Bowed::new(samples, |cosines| cosines.specular(surface));
        let middle = centroid.specular(surface);
        let bowed_up_to = |levels: u32| specular.bows.iter().all(|bow| within(*bow, material.specular, levels));
        is_good = agrees(&specular, middle, material.specular) && bowed_up_to(LEVELS.saturating_mul(BOW));
        let most = specular.corners.iter().fold(middle, |most, corner| most.max(*corner));
        shows = !is_good || !within(most, material.specular, LEVELS / 2) || !bowed_up_to(LEVELS.saturating_mul(2));
    }
    if !is_good {
        return exact();
    }
    let quadratic = |bowed: &Bowed| Quadratic::bowed(gradient, bowed.corners, bowed.bows, finer(LIGHTS));
    Facet(if is_linear && !shows {
        Kind::Linear(plane::<LIGHTS>(gradient, &diffuse))
    } else {
        let diffuse = if is_linear { plane::<LIGHTS>(gradient, &diffuse).into() } else { quadratic(&diffuse) };
        let specular = if shows { quadratic(&specular) } else { Quadratic::ZERO };
        Kind::Quadratic { shiny: shows.into(), intensity: [diffuse, specular] }
    })
}
