//! Phong shading by angles, for triangles and other convex polygons.

use core::{array::from_fn, iter::zip, marker::PhantomData};

use embedded_graphics::geometry::Point;

use super::{
    angular::{Fit, Parabolas, Refit, Registers},
    duff_barycentric::is_shiny,
    trapezium::{first_line, versine, Bend, Facet, Products, Side, Trapezium},
    Paint, Shade, Surface,
};
use crate::{
    math::{
        arc::arc_tangent,
        interpolant::Slope,
        screen::area,
        vector::{cross, dot, turned, unit},
    },
    model::light::{Aim, Blank, LightSource, PerProduct, Rays},
    scan::triangle::Triangle,
};

/// Phong shading by angles: *Faster Phong Shading*, §3 and appendix (Table 2, row 6).
///
/// A polygon is cut into [trapezia](Trapezium) at the heights of its corners; a triangle gives two. In each, the normals on the left
/// and on the right side rotate about two axes, `n_upper × n_lower`, by equal angles from line to line; λ and ρ are their angles
/// from the intersection of the two planes in which they turn. cos S is the product of the axes, η the angle from the intersection
/// to l or h. What a line makes of that is told with [`Trapezium`], what its pixels do with [`angular`](super::angular).
///
/// Degenerate cases (§3.4), all by the same few steps:
///
/// - *Constant* normals on one side: they turn by nothing, in the plane with the other side's upper normal (or its lower one).
/// - *One plane*, axes less than 0.002° apart: its normals meet everywhere; angles are taken from the upper left one.
/// - *All equal*: both of these; Δθ is 0, and light is the same everywhere.
///
/// For lights in the scene (§3.5) each normal is turned by the rotation that takes the l there to that at a middle corner, the same
/// for h, and shaded as by a directional light: so λ, ρ, S are one set for each. That is exact at the corners, and an approximation
/// between them, good while l and h turn little: on the comparison's one big triangle it costs 4 to 6 dB, on its spheres nothing at
/// exponents from 20 on. Where l or h turn by more than 151° a normal stays as it is.
///
/// Corrected of the appendix, `shader`: cos Δθ has a product of the sines; λ0 is the angle from the intersection in the sense of
/// rotation and steps are positive, where the printed sign of `lambdastep` is mostly wrong; the intersection need not be reversed
/// for the light's sake, and is for the normals', so that angles are small; the lower line is not shaded twice, and a trapezium
/// without height has no line.
///
/// Good at: two additions a pixel and product without a table, for any exponent, and highlights between the corners. Bad at: a line
/// costs hundreds of operations, which only long ones pay back; parabolas are up to 6 levels of 255 beside the cosine, and begin anew
/// on each line of each triangle, so that neighbours do not quite meet; angles between normals should be below 90°, and normals of
/// one side that are opposite stay what its upper one is. On the standard teapot 41 dB beside exact Phong shading, as its model in f64
/// has, from which it is 64 dB apart.
///
/// Facet: 84 + 24 · LIGHTS bytes for light from far, 44 + 104 · LIGHTS in the scene.
#[derive(Clone, Copy, Debug)]
pub struct AngularTrapezia<F = Refit>(PhantomData<F>);

impl<const LIGHTS: usize, L: LightSource, F: Fit> Shade<LIGHTS, L> for AngularTrapezia<F> {
    type Facet = Facet<LIGHTS, L>;
    type Registers = Registers<LIGHTS>;
    const EMPTY: Self::Facet = Facet::EMPTY;

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Self::Facet {
        let mut corners = [Corner::default(); 3];
        let places = zip(triangle.normals(), triangle.positions());
        for (corner, (point, (normal, position))) in corners.iter_mut().zip(zip(triangle.points(), places)) {
            *corner = Corner { point, normal, position };
        }
        let [e01, e12, e20] = triangle.edges.map(u32::from);
        let most = triangle.corners.iter().flat_map(|corner| corner.dots).map(|[_, specular]| specular).max().unwrap_or(0);
        // In the scene it depends on the turned normals.
        let shiny = L::IN_SCENE || is_shiny(most.into(), e01.max(e12).max(e20), &surface.material.power);
        Facet { shiny, bands: bands(&corners, triangle.aims, surface.intensities) }
    }

    #[inline]
    fn start(facet: &Self::Facet, x: i32, y: i32) -> Self::Registers {
        facet.start(x, y)
    }

    #[inline]
    fn run<P>(registers: Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        Parabolas::<F>::run(registers, surface, pixels, paint);
    }
}

/// A corner of a polygon.
#[derive(Clone, Copy, Debug, Default)]
pub struct Corner {
    /// On the screen, in subpixels; ±2048 pixels, clamped.
    pub point: Point,
    /// The unit normal there in the object's space, Q14.
    pub normal: [i16; 3],
    /// The position in the mesh, Q15 of its extent.
    pub position: [i16; 3],
}

impl<F> AngularTrapezia<F> {
    /// The facet of a convex quadrilateral, its corners either way round: three trapezia at most, with four different normals each.
    ///
    /// Lights are as the object sees them, see [`LightSource::aim`]; their intensities are Q15. Meshes hold triangles only, so a
    /// scanner does not come by here: the registers of [`Facet::start`] are for [`run`](Shade::run).
    #[must_use]
    pub fn quadrilateral<const LIGHTS: usize, L: LightSource>(
        corners: &[Corner; 4],
        aims: &[L::Aim; LIGHTS],
        intensities: &[u16; LIGHTS],
    ) -> Facet<LIGHTS, L, 3> {
        const MOST: i32 = 1 << 19;
        let corners = corners.map(|corner| {
            let Point { x, y } = corner.point;
            Corner { point: Point::new(x.clamp(-MOST, MOST - 1), y.clamp(-MOST, MOST - 1)), ..corner }
        });
        Facet { shiny: true, bands: bands(&corners, aims, intensities) }
    }
}

/// The normals of a polygon's corners, as a product sees them.
///
/// In the scene, normals turned as §3.5 says: each by the rotation that takes the vector there to that at the chosen corner.
#[derive(Clone, Copy, Debug)]
struct View<const CORNERS: usize> {
    normals: [[i16; 3]; CORNERS],
}

impl<const CORNERS: usize> Blank for View<CORNERS> {
    const BLANK: Self = Self { normals: [[0; 3]; CORNERS] };
}

/// Cuts a convex polygon into trapezia at the heights of its corners: one less than corners.
fn bands<const CORNERS: usize, const BANDS: usize, const LIGHTS: usize, L: LightSource>(
    corners: &[Corner; CORNERS],
    aims: &[L::Aim; LIGHTS],
    intensities: &[u16; LIGHTS],
) -> [Trapezium<LIGHTS, L>; BANDS] {
    let mut heights = corners.map(|corner| corner.point.y);
    sort(&mut heights);
    // §3.5 leaves open which; one in the middle has the others nearest.
    let chosen = corners.iter().find(|corner| heights.get(1) == Some(&corner.point.y)).copied().unwrap_or_default();
    // l (0) or h (1) of a light at a corner.
    let vector = |corner: &Corner, light: usize, product: usize| {
        let Rays { light, half, .. } = aims.get(light).map_or(Rays::NONE, |aim| aim.rays(corner.position));
        [light, half].get(product).copied().unwrap_or_default()
    };
    let views = <L::PerProduct<View<CORNERS>, LIGHTS>>::each(|light, product| View {
        normals: corners.map(|corner| match L::IN_SCENE {
            true => turned(corner.normal, vector(&corner, light, product), vector(&chosen, light, product)),
            false => corner.normal,
        }),
    });
    let clockwise = is_clockwise(corners);
    let mut bands = [Trapezium::EMPTY; BANDS];
    for (band, (&top, &bottom)) in bands.iter_mut().zip(heights.iter().zip(heights.iter().skip(1))) {
        let line = first_line(top);
        band.line = line;
        let sides = [!clockwise, clockwise].map(|down| side(corners, down, top, bottom));
        let [Some(left), Some(right)] = sides else { continue };
        let sides = [left, right].map(|[(_, top), (_, bottom)]| Side::new(top.point, bottom.point, line.into()));
        band.edges = sides.map(|side| side.edge());
        let ends = |light, product| {
            let normal = |(number, _): (usize, &Corner)| views.of(light, product).and_then(|view| view.normals.get(number));
            [left, right].map(|ends| ends.map(|end| normal(end).copied().unwrap_or_default()))
        };
        let arcs = <L::PerProduct<Arcs, LIGHTS>>::each(|light, product| Arcs::of(ends(light, product)));
        let arcs = |light, product| arcs.of(light, product).copied().unwrap_or(Arcs::BLANK);
        band.bends = <L::PerProduct<Bend, LIGHTS>>::each(|light, product| arcs(light, product).bend(ends(light, product), sides));
        band.products = from_fn(|light| {
            from_fn(|product| {
                let strength = if product == 0 { intensities.get(light).copied().unwrap_or(0) } else { 1 << 15 };
                arcs(light, product).products(vector(&chosen, light, product), strength)
            })
        });
    }
    bands
}

/// The ends of the side that spans the heights and goes down, or up, as one follows the corners; with their numbers, the upper first.
fn side<const CORNERS: usize>(corners: &[Corner; CORNERS], down: bool, top: i32, bottom: i32) -> Option<[(usize, &Corner); 2]> {
    let next = corners.iter().enumerate().cycle().skip(1);
    // Cyclic, so that the last one goes to the first.
    let mut sides = corners.iter().enumerate().zip(next).map(|(from, to)| if down { [from, to] } else { [to, from] });
    sides.find(|[(_, upper), (_, lower)]| upper.point.y <= top && top < bottom && bottom <= lower.point.y)
}

/// Whether the corners run clockwise as seen.
fn is_clockwise<const CORNERS: usize>(corners: &[Corner; CORNERS]) -> bool {
    let first = corners.first().copied().unwrap_or_default().point;
    zip(corners, corners.iter().skip(1)).map(|(a, b)| area(first, a.point, b.point)).sum::<i64>() > 0
}

/// From the least to the largest.
fn sort(numbers: &mut [i32]) {
    for _ in 1..numbers.len() {
        let mut rest = numbers.iter_mut();
        let Some(mut before) = rest.next() else { return };
        for number in rest {
            if *number < *before {
                core::mem::swap(number, before);
            }
            before = number;
        }
    }
}

/// The two arcs on which the normals at a trapezium's sides lie. All Q16.
#[derive(Clone, Copy, Debug)]
struct Arcs {
    /// Where their circles meet: the unit vector along the intersection of the planes.
    meeting: [i32; 3],
    /// From there a right angle on along the left and the right one.
    along: [[i32; 3]; 2],
    /// The axes about which the normals rotate.
    axes: [[i32; 3]; 2],
}

impl Blank for Arcs {
    const BLANK: Self = Self { meeting: [0; 3], along: [[0; 3]; 2], axes: [[0; 3]; 2] };
}

impl Arcs {
    /// The arcs between the normals at the ends, upper and lower, of the left and the right side.
    fn of([[l0, lk], [r0, rk]]: [[[i16; 3]; 2]; 2]) -> Self {
        let (left, right) = (axis(l0, lk), axis(r0, rk));
        // A side of constant normals has an axis with the nearest that differs.
        let left = left.or_else(|| axis(l0, r0)).or_else(|| axis(l0, rk)).or(right);
        let right = right.or_else(|| axis(l0, r0)).or_else(|| axis(lk, r0)).or(left);
        let axes = [left, right].map(|axis| axis.unwrap_or_default());
        let [left, right] = axes.map(short);
        let across = cross(left, right);
        // In one plane, or all equal: any normal is where they meet.
        let wide = l0.map(|c| i32::from(c) << 2);
        let meeting = if across.iter().all(|c| c.unsigned_abs() < 1 << 15) { unit(wide) } else { unit(across) };
        // Of the two places the one on the side of the normals.
        let meeting = if dot(short(meeting), short(wide)) < 0 { meeting.map(|c| -c) } else { meeting };
        let along = [left, right].map(|axis| cross(axis, short(meeting)).map(|c| (c + (1 << 13)) >> 14));
        Self { meeting, along, axes }
    }

    /// How normals turn down the sides.
    fn bend(&self, ends: [[[i16; 3]; 2]; 2], sides: [Side; 2]) -> Bend {
        let mut turns = [Slope::default(); 2];
        for (turn, ((along, normals), side)) in turns.iter_mut().zip(zip(zip(self.along, ends), sides)) {
            let [upper, lower] = normals.map(|normal| {
                let normal = normal.map(i32::from);
                arc_tangent(dot(normal, along), dot(normal, self.meeting))
            });
            let Slope { value, step } = side.turn(lower.wrapping_sub(upper));
            *turn = Slope { value: upper.wrapping_add(value), step };
        }
        let [left, right] = self.axes.map(short);
        // By the difference of the two, or their sum, whichever is less.
        let facing = dot(left, right) < 0;
        let mut square = 0_u32;
        for (l, r) in zip(left, right) {
            let apart = if facing { l + r } else { l - r };
            square = square.wrapping_add(apart.wrapping_mul(apart) as u32);
        }
        let half = (square >> 1) as i32;
        Bend { ends: turns, versine: versine(if facing { half - (1 << 30) } else { (1 << 30) - half }) }
    }

    /// The products with a unit vector (Q16), times the strength (Q15).
    fn products(&self, vector: [i32; 3], strength: u16) -> Products {
        let vector = short(vector);
        let product = |with: [i32; 3]| {
            let product = (dot(short(with), vector).wrapping_add(1 << 15)) >> 16;
            ((product * i32::from(strength)) >> 15) as i16
        };
        Products { meeting: product(self.meeting), along: self.along.map(product) }
    }
}

/// The axis of the rotation from one normal to another, Q16; none if they are within 0.01° of each other, or opposite.
fn axis(from: [i16; 3], to: [i16; 3]) -> Option<[i32; 3]> {
    let axis = cross(from.map(i32::from), to.map(i32::from));
    axis.iter().any(|c| c.unsigned_abs() >= 1 << 15).then(|| unit(axis))
}

/// Q16 to Q15.
fn short(vector: [i32; 3]) -> [i32; 3] {
    vector.map(|c| (c + 1) >> 1)
}
