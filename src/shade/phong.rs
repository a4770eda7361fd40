//! Phong shading as it was first described: normals interpolated along edges, then along lines.

use embedded_graphics::geometry::Point;

use super::{lit, Intensity, Paint, Shade, Surface};
use crate::{
    math::{
        interpolant::{Slope, Steps},
        product::{mul_high, scale},
        reciprocal::Reciprocal,
        root::inverse_root,
        screen::{area, center, first_at, SUBPIXELS},
    },
    model::light::{Aim, Change, LightSource},
    scan::triangle::Triangle,
};

/// Basic Phong shading: normals are interpolated from the corners along two edges and from there along the line, renormalised at
/// each pixel, and lit there.
///
/// Course notes (ENDS 489), "Phong interpolation"; *Faster Phong Shading* (CS-R9228), §1 and method 1 of Table 2. For lights in the
/// scene l and h are interpolated and renormalised likewise (81 operations a pixel, not 64 as Table 2 has it: a reciprocal root is
/// missing there). Edges are evaluated at each line, not stepped from line to line, so that lines may come in any order.
///
/// Exact but for rounding, on thin triangles too; dear, as each vector has three components. With normals at most 60° apart, diffuse
/// intensity is off by at most 2.5·10⁻⁴ on triangles no less than 12 pixels high, 6.1·10⁻⁴ from 2 pixels on (RMS 1.3·10⁻⁴), and
/// 3.4·10⁻³ on thinner ones (RMS 1.5·10⁻⁴). Where vectors bend so much that |N|² (for lights in the scene, |N|²·|l|² or |N|²·|h|²)
/// falls below 1/64, it counts as that.
#[derive(Clone, Copy, Debug)]
pub struct Phong;

/// Vectors at the corners, and the edges: 60 + 24 · LIGHTS bytes for directional lights, 64 + 72 · LIGHTS for lights in the scene.
///
/// Corners are in the order of their height.
#[derive(Clone, Copy, Debug)]
pub struct Facet<const LIGHTS: usize, L: LightSource> {
    /// The corners' x, counted from the centre of pixel 0, 2⁻¹⁶ pixel.
    x: [i32; 3],
    /// Along the edges from top to bottom, top to middle, middle to bottom: the part of the way on the edge's first line, and its
    /// increase a line, Q30.
    ways: [Slope; 3],
    /// The first lines below the top and the middle corner.
    lines: [i16; 2],
    /// Whether the middle corner is on the left.
    middle_left: bool,
    /// Normals, Q14.
    normals: [[i16; 3]; 3],
    /// For each light l and h at the top, Q24.
    rays: [[[i32; 3]; 2]; LIGHTS],
    /// What they are more in the middle and at the bottom.
    others: L::Change<[[[[i32; 3]; 2]; LIGHTS]; 2]>,
}

/// Vectors along a line.
#[derive(Clone, Copy, Debug)]
pub struct Registers<const LIGHTS: usize, L: LightSource> {
    /// N, Q24.
    pub(super) normal: [Slope; 3],
    /// For each light l and h, Q24; directional ones have the light's intensity in l.
    pub(super) rays: [[[i32; 3]; 2]; LIGHTS],
    /// What they increase by to the next pixel.
    pub(super) steps: L::Change<[[[i32; 3]; 2]; LIGHTS]>,
}

impl<const LIGHTS: usize, L: LightSource> Shade<LIGHTS, L> for Phong {
    type Facet = Facet<LIGHTS, L>;
    type Registers = Registers<LIGHTS, L>;
    const EMPTY: Self::Facet = Facet {
        x: [0; 3],
        ways: [Slope { value: 0, step: 0 }; 3],
        lines: [0; 2],
        middle_left: false,
        normals: [[0; 3]; 3],
        rays: [[[0; 3]; 2]; LIGHTS],
        others: L::Change::NONE,
    };

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Self::Facet {
        let (points, normals, positions) = (triangle.points(), triangle.normals(), triangle.positions());
        let ([p0, p1, p2], [n0, n1, n2], [q0, q1, q2]) = (points, normals, positions);
        let [(a, na, qa), (b, nb, qb), (c, nc, qc)] = by_height([(p0, n0, q0), (p1, n1, q1), (p2, n2, q2)]);
        let (rays, others) = if L::IN_SCENE {
            let at = |position| triangle.aims.each_ref().map(|aim| directions(aim, position));
            let [top, middle, bottom] = [qa, qb, qc].map(at);
            (top, L::Change::of(|| [less(middle, &top), less(bottom, &top)]))
        } else {
            (far(triangle, surface), L::Change::NONE)
        };
        let lines = [a, b].map(|corner| first_at(corner.y));
        let [top, middle] = lines;
        Facet {
            x: [a, b, c].map(|corner| (corner.x - SUBPIXELS / 2) << 8),
            ways: [way(a, c, top), way(a, b, top), way(b, c, middle)],
            lines: lines.map(|line| line as i16),
            middle_left: area(a, b, c) < 0,
            normals: [na, nb, nc],
            rays,
            others,
        }
    }

    #[inline]
    fn start(facet: &Self::Facet, x: i32, y: i32) -> Self::Registers {
        let [top, middle] = facet.lines.map(|line| y - i32::from(line));
        let [whole, upper, lower] = &facet.ways;
        let ([xa, xb, xc], [na, nb, nc]) = (facet.x, facet.normals);
        let straight = part(whole, top);
        let below = middle >= 0;
        let bent = if below { part(lower, middle) } else { part(upper, top) };
        let ends = if below { [(xb, nb), (xc, nc)] } else { [(xa, na), (xb, nb)] };
        let [(x0, n0), (x1, n1)] = ends;
        let sides = [(between(xa, xc, straight), on_edge(na, nc, straight)), (between(x0, x1, bent), on_edge(n0, n1, bent))];
        let [(left, normal_left), (right, normal_right)] = if facet.middle_left { turned(sides) } else { sides };
        let line = Across::new(left, right, x);
        let [[ax, ay, az], [bx, by, bz]] = [normal_left, normal_right];
        let normal = [(ax, bx), (ay, by), (az, bz)].map(|(a, b)| line.slope(a, b - a));
        let Some([middle, bottom]) = facet.others.get() else {
            return Registers { normal, rays: facet.rays, steps: L::Change::NONE };
        };
        let mut rays = facet.rays;
        let mut steps = [[[0; 3]; 2]; LIGHTS];
        let others = flat(middle).iter().zip(flat(bottom));
        for ((value, step), (middle, bottom)) in
            rays.as_flattened_mut().as_flattened_mut().iter_mut().zip(steps.as_flattened_mut().as_flattened_mut()).zip(others)
        {
            // From the corner at the top on.
            let on_bent = if below { between(*middle, *bottom, bent) } else { mul_high(*middle, bent) };
            let sides = [mul_high(*bottom, straight), on_bent];
            let [left, right] = if facet.middle_left { turned(sides) } else { sides };
            let slope = line.slope(left, right.wrapping_sub(left));
            (*value, *step) = (value.wrapping_add(slope.value), slope.step);
        }
        Registers { normal, rays, steps: L::Change::of(|| steps) }
    }

    #[inline]
    fn run<P>(registers: Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        run(registers, surface, pixels, paint);
    }
}

/// Renormalises and lights at each pixel.
#[inline(always)]
pub(super) fn run<P, const LIGHTS: usize, L: LightSource>(
    registers: Registers<LIGHTS, L>,
    surface: &Surface<'_, LIGHTS>,
    pixels: &mut [P],
    paint: &impl Paint<P>,
) {
    let Registers { mut normal, mut rays, steps } = registers;
    let power = &surface.material.power;
    // A product of two vectors in Q15, clamped at 0, in Q16, times a root in Q15: a cosine in Q31.
    let cosine = |a, b, root: u32| lit(dot(a, b), 16).wrapping_mul(root);
    match steps.get() {
        None => {
            let rays = rays.map(|pair| pair.map(short));
            for pixel in pixels {
                let normal = normal.each_mut().map(|c| c.next() >> 9);
                let root = inverse_root(bend(normal));
                let mut intensity = Intensity::default();
                for ([light, half], strength) in rays.iter().zip(surface.intensities) {
                    intensity.diffuse += cosine(normal, *light, root) >> 17;
                    intensity.specular += (power.at(cosine(normal, *half, root)) * u32::from(*strength)) >> 15;
                }
                *pixel = paint.mix(intensity.limited(LIGHTS));
            }
        }
        Some(steps) => {
            for pixel in pixels {
                let normal = normal.each_mut().map(|c| c.next() >> 9);
                let bend_normal = bend(normal);
                let mut intensity = Intensity::default();
                for ((rays, steps), strength) in rays.iter_mut().zip(steps).zip(surface.intensities) {
                    let [light, half] =
                        rays.map(short).map(|ray| cosine(normal, ray, inverse_root(joint(bend_normal, bend(ray)))));
                    intensity.diffuse += ((light >> 17) * u32::from(*strength)) >> 15;
                    intensity.specular += (power.at(half) * u32::from(*strength)) >> 15;
                    for (value, step) in rays.as_flattened_mut().iter_mut().zip(steps.as_flattened()) {
                        *value = value.wrapping_add(*step);
                    }
                }
                *pixel = paint.mix(intensity.limited(LIGHTS));
            }
        }
    }
}

/// A vector in Q24 as Q15.
#[inline(always)]
fn short(vector: [i32; 3]) -> [i32; 3] {
    vector.map(|c| c >> 9)
}

/// A scalar product, wrapping.
#[inline(always)]
pub(super) fn dot([ax, ay, az]: [i32; 3], [bx, by, bz]: [i32; 3]) -> i32 {
    ax.wrapping_mul(bx).wrapping_add(ay.wrapping_mul(by)).wrapping_add(az.wrapping_mul(bz))
}

/// `1 − |v|²` in Q28 of a vector in Q15.
#[inline(always)]
fn bend(vector: [i32; 3]) -> i32 {
    (1_i32 << 30).wrapping_sub(dot(vector, vector)) >> 2
}

/// `1 − (1 − u)(1 − v)`, Q28: for the reciprocal root of a product. Error at most 2⁻¹⁵ · (u + v).
#[inline(always)]
pub(super) fn joint(u: i32, v: i32) -> i32 {
    u.wrapping_add(v).wrapping_sub((u >> 13).wrapping_mul(v >> 13) >> 2)
}

/// For each light l times its intensity and h, Q24, the same everywhere.
pub(super) fn far<const LIGHTS: usize, L: LightSource>(
    triangle: &Triangle<'_, LIGHTS, L>,
    surface: &Surface<'_, LIGHTS>,
) -> [[[i32; 3]; 2]; LIGHTS] {
    let mut rays = triangle.aims.each_ref().map(|aim| directions(aim, [0; 3]));
    for ([light, _], strength) in rays.iter_mut().zip(surface.intensities) {
        *light = light.map(|c| mul_high(c, 2 * u32::from(*strength)));
    }
    rays
}

/// l and h from a position, Q24.
fn directions(aim: &impl Aim, position: [i16; 3]) -> [[i32; 3]; 2] {
    let rays = aim.rays(position);
    [rays.light, rays.half].map(|ray| ray.map(|c| c << 8))
}

/// Vectors less others.
fn less<const LIGHTS: usize>(mut vectors: [[[i32; 3]; 2]; LIGHTS], others: &[[[i32; 3]; 2]; LIGHTS]) -> [[[i32; 3]; 2]; LIGHTS] {
    for (value, other) in vectors.as_flattened_mut().as_flattened_mut().iter_mut().zip(flat(others)) {
        *value -= other;
    }
    vectors
}

/// All components of vectors.
#[inline(always)]
fn flat<const LIGHTS: usize>(vectors: &[[[i32; 3]; 2]; LIGHTS]) -> &[i32] {
    vectors.as_flattened().as_flattened()
}

/// A corner: its place on the screen, its normal, its position.
type Corner = (Point, [i16; 3], [i16; 3]);

/// Corners from top to bottom.
fn by_height([mut a, mut b, mut c]: [Corner; 3]) -> [Corner; 3] {
    let height = |(point, ..): Corner| point.y;
    if height(b) < height(a) {
        core::mem::swap(&mut a, &mut b);
    }
    if height(c) < height(b) {
        core::mem::swap(&mut b, &mut c);
        if height(b) < height(a) {
            core::mem::swap(&mut a, &mut b);
        }
    }
    [a, b, c]
}

/// The part of the way along an edge on line `line`, the first one below its upper end, and its increase a line; Q30.
fn way(upper: Point, lower: Point, line: i32) -> Slope {
    let inverse = Reciprocal::of((lower.y - upper.y).unsigned_abs());
    // Where an edge is less than half a pixel high, there is no second line.
    let below = (center(line) - upper.y) as u32;
    let value = scale(below.wrapping_mul(inverse.mantissa >> 8) as i32, inverse.zeros - 24);
    let step = inverse.mantissa.checked_shr((24 - inverse.zeros) as u32).unwrap_or(0) as i32;
    Slope { value, step }
}

/// The part so many lines further on, Q16.
#[inline(always)]
fn part(way: &Slope, lines: i32) -> u32 {
    (way.value.wrapping_add(way.step.wrapping_mul(lines)) as u32) >> 14
}

/// A value a part of the way from one to another, the part in Q16.
#[inline(always)]
fn between(a: i32, b: i32, part: u32) -> i32 {
    a.wrapping_add(mul_high(b.wrapping_sub(a), part))
}

/// The normal there, Q24; those at the ends in Q14.
#[inline(always)]
fn on_edge([ax, ay, az]: [i16; 3], [bx, by, bz]: [i16; 3], part: u32) -> [i32; 3] {
    let part = (part >> 1) as i32;
    [(ax, bx), (ay, by), (az, bz)].map(|(a, b)| {
        let (a, b) = (i32::from(a), i32::from(b));
        (a << 10) + ((b - a).wrapping_mul(part) >> 5)
    })
}

#[inline(always)]
fn turned<T>([a, b]: [T; 2]) -> [T; 2] {
    [b, a]
}

/// How far left of an edge a pixel's centre still counts as on it, 2⁻¹⁶ pixel.
const NEAR: i32 = 1 << 8;

/// From the left edge to the right one, on a line.
struct Across {
    /// The part of the way at the first pixel right of the left edge, Q16.
    first: u32,
    /// The reciprocal of the way's length in 2⁻¹⁶ pixel.
    short: u32,
    shift: i32,
    /// Pixels from that first one to where values begin.
    ahead: i32,
}

impl Across {
    /// Between two places in 2⁻¹⁶ pixel, beginning at pixel x.
    #[inline(always)]
    fn new(left: i32, right: i32, x: i32) -> Self {
        let inverse = Reciprocal::of(right.wrapping_sub(left).max(1) as u32);
        let short = inverse.short();
        // An edge is placed with less precision than it is walked: a centre just left of it counts as on it.
        let pixel = left.wrapping_add(0xffff - NEAR) >> 16;
        let past = (pixel << 16).wrapping_sub(left).max(0) as u32;
        // Less than 2¹⁶ by at most 2¹⁵.
        let first = ((past * (short >> 1)) >> (30 - inverse.zeros).max(0)).min(1 << 16);
        // Less than a pixel holds one centre at most: no step is taken there.
        Self { first, short, shift: (15 - inverse.zeros).max(0), ahead: x - pixel }
    }

    /// A value that is `left` there, and `more` than that on the right.
    #[inline(always)]
    fn slope(&self, left: i32, more: i32) -> Slope {
        let step = mul_high(more, self.short) >> self.shift;
        let first = left.wrapping_add(mul_high(more, self.first));
        Slope { value: first.wrapping_add(step.wrapping_mul(self.ahead)), step }
    }
}
