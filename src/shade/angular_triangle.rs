//! Phong shading by angles, for triangles.

use core::{array::from_fn, marker::PhantomData, mem::swap};

use embedded_graphics::geometry::Point;

use super::{
    angular::{Fit, Parabolas, Refit, Registers},
    duff_barycentric::is_shiny,
    trapezium::{first_line, versine, Bend, Facet, InverseSine, Products, Side, Trapezium},
    Paint, Shade, Surface,
};
use crate::{
    math::{arc::arc_cosine, interpolant::Slope, screen::area, vector::turned},
    model::{
        clip::edge_constant,
        light::{Aim, Blank, LightSource, PerProduct, Rays},
    },
    scan::triangle::Triangle,
};

/// Phong shading by angles, for triangles alone: *Faster Phong Shading*, §3.4, §4 (Table 2, row 7).
///
/// The picture is that of [`AngularTrapezia`](super::angular_trapezia::AngularTrapezia), which tells more of it, from a simpler
/// set-up without vector products. At the middle corner's height the triangle is cut in two trapezia, and in each both sides end in
/// one corner: there their arcs meet. So λ and ρ are 0 there, η is the angle of that corner's normal to l or h, and S an angle of the
/// spherical triangle of the three normals, whose sides `a_ij = arccos(1 − e_ij)` come from the mesh's edge constants:
/// `cos S = (cos a_jk − cos a_ij cos a_ik)/(sin a_ij sin a_ik)`, `sin η cos S1 = (n_j·l − n_i·l cos a_ij)/sin a_ij`. For lights in the
/// scene the edge constants are those of normals turned as §3.5 says, by which the products at the corners stay what they are.
///
/// Degenerate cases: an edge of equal normals has λ = 0 all along it, so that neither S nor S1 counts; three normals in one plane
/// have S = 0 or half a circle, as the formula says.
///
/// Facet: 84 + 24 · LIGHTS bytes for light from far, 44 + 104 · LIGHTS in the scene.
#[derive(Clone, Copy, Debug)]
pub struct AngularTriangle<F = Refit>(PhantomData<F>);

impl<const LIGHTS: usize, L: LightSource, F: Fit> Shade<LIGHTS, L> for AngularTriangle<F> {
    type Facet = Facet<LIGHTS, L>;
    type Registers = Registers<LIGHTS>;
    const EMPTY: Self::Facet = Facet::EMPTY;

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Self::Facet {
        let [p0, p1, p2] = triangle.points();
        let [(top, t), (middle, m), (bottom, b)] = by_height([(p0, 0), (p1, 1), (p2, 2)]);
        let order = [t, m, b];
        // Of the normals, or of those turned to suit each product; the middle corner has the others nearest.
        let arcs = <L::PerProduct<Arcs, LIGHTS>>::each(|light, product| {
            let edges = if L::IN_SCENE { turned_edges(triangle, m, light, product) } else { *triangle.edges };
            Arcs::new(edges, order)
        });
        let arcs_of = |light, product| arcs.of(light, product).copied().unwrap_or(Arcs::BLANK);
        let dots = |light, product| order.map(|corner| dot(triangle, corner, light, product));
        // Whether the edges that meet in the middle corner are on the left.
        let bent_left = area(top, middle, bottom) < 0;
        // Above the middle corner arcs meet in the top one, below it in the bottom one.
        let bands = [(top, middle, false), (middle, bottom, true)].map(|(from, to, below)| {
            let line = first_line(from.y);
            let edges = [Side::new(from, to, line.into()), Side::new(top, bottom, line.into())];
            // The arc of the bent side, the straight one, and the one across.
            let arcs = |light, product| {
                let Arcs { upper, lower, long } = arcs_of(light, product);
                if below {
                    [lower, long, upper]
                } else {
                    [upper, long, lower]
                }
            };
            Trapezium {
                line,
                edges: sides(bent_left, edges.map(|edge| edge.edge())),
                bends: <L::PerProduct<Bend, LIGHTS>>::each(|light, product| {
                    let ([bent, long, across], [bent_edge, straight]) = (arcs(light, product), edges);
                    let turn = |edge: Side, arc: &Edge| {
                        let Slope { value, step } = edge.turn(arc.angle);
                        if below {
                            Slope { value: arc.angle - value, step: -step }
                        } else {
                            Slope { value, step }
                        }
                    };
                    let ends = sides(bent_left, [turn(bent_edge, &bent), turn(straight, &long)]);
                    Bend { ends, versine: bent.corner(&long, &across) }
                }),
                products: from_fn(|light| {
                    from_fn(|product| {
                        let ([bent, long, _], [t, m, b]) = (arcs(light, product), dots(light, product));
                        let (meeting, far) = if below { (b, t) } else { (t, b) };
                        let along = [bent.along(meeting, m), long.along(meeting, far)];
                        Products { meeting: meeting as i16, along: sides(bent_left, along) }
                    })
                }),
            }
        });
        let shiny = (0..LIGHTS).any(|light| {
            let [t, m, b] = dots(light, 1);
            is_shiny(t.max(m).max(b), arcs_of(light, 1).most(), &surface.material.power)
        });
        Facet { shiny, bands }
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

/// The arc between the normals at an edge's ends.
#[derive(Clone, Copy, Debug)]
struct Edge {
    /// The edge constant, Q15.
    lack: i32,
    /// Its length, in 2⁻³² of a circle.
    angle: i32,
    inverse: InverseSine,
}

impl Edge {
    fn new(constant: u16) -> Self {
        let lack = i32::from(constant);
        Self { lack, angle: arc_cosine((1 << 30) - (lack << 15)), inverse: InverseSine::of((lack << 15) as u32) }
    }

    /// Of a product that is `from` at one end and `to` at the other, Q14, that of the direction from the one along the arc.
    fn along(&self, from: i32, to: i32) -> i16 {
        // (to − from cos)/sin, Q30.
        let rest = ((to - from) << 16).wrapping_add((from * self.lack) << 1);
        ((self.inverse.times(rest) + (1 << 15)) >> 16) as i16
    }

    /// 1 − cos S of the corner between this edge and another, Q30, by the third.
    fn corner(&self, other: &Self, across: &Self) -> u32 {
        // sin · sin · cos S = cos − cos · cos
        let rest = ((self.lack + other.lack - across.lack) << 15).wrapping_sub(self.lack.wrapping_mul(other.lack));
        versine(other.inverse.times(self.inverse.times(rest)))
    }
}

/// The arcs of a triangle's edges: from the top to the middle corner, from there to the bottom, and from the top to the bottom.
#[derive(Clone, Copy, Debug)]
struct Arcs {
    upper: Edge,
    lower: Edge,
    long: Edge,
}

impl Blank for Arcs {
    const BLANK: Self = {
        const NONE: Edge = Edge { lack: 0, angle: 0, inverse: InverseSine::NONE };
        Self { upper: NONE, lower: NONE, long: NONE }
    };
}

impl Arcs {
    /// From the constants of edges 01, 12, 20, and the numbers of the corners from top to bottom.
    fn new([e01, e12, e20]: [u16; 3], order: [usize; 3]) -> Self {
        // Each is across from a corner.
        let [lower, long, upper] = order.map(|corner| {
            Edge::new(match corner {
                0 => e12,
                1 => e20,
                _ => e01,
            })
        });
        Self { upper, lower, long }
    }

    /// The largest edge constant.
    fn most(&self) -> u32 {
        self.upper.lack.max(self.lower.lack).max(self.long.lack) as u32
    }
}

/// The edge constants of a triangle's normals turned as §3.5 says: each by the rotation that takes the l or h there to that at the
/// chosen corner.
fn turned_edges<const LIGHTS: usize, L: LightSource>(
    triangle: &Triangle<'_, LIGHTS, L>,
    chosen: usize,
    light: usize,
    product: usize,
) -> [u16; 3] {
    let Some(aim) = triangle.aims.get(light) else { return *triangle.edges };
    let vectors @ [v0, v1, v2] = triangle.positions().map(|position| {
        let Rays { light, half, .. } = aim.rays(position);
        if product == 0 {
            light
        } else {
            half
        }
    });
    let [n0, n1, n2] = triangle.normals();
    let to = vectors.get(chosen).copied().unwrap_or_default();
    let [n0, n1, n2] = [turned(n0, v0, to), turned(n1, v1, to), turned(n2, v2, to)];
    [edge_constant(n0, n1), edge_constant(n1, n2), edge_constant(n2, n0)]
}

/// A corner's product, Q14.
fn dot<const LIGHTS: usize, L: LightSource>(
    triangle: &Triangle<'_, LIGHTS, L>,
    corner: usize,
    light: usize,
    product: usize,
) -> i32 {
    let dots = triangle.corners.get(corner).and_then(|corner| corner.dots.get(light));
    dots.and_then(|dots| dots.get(product)).copied().unwrap_or(0).into()
}

/// What belongs to the edge with the middle corner and to the long one, as left and right.
fn sides<T>(bent_left: bool, [bent, long]: [T; 2]) -> [T; 2] {
    if bent_left {
        [bent, long]
    } else {
        [long, bent]
    }
}

/// The corners from top to bottom.
fn by_height([mut a, mut b, mut c]: [(Point, usize); 3]) -> [(Point, usize); 3] {
    if b.0.y < a.0.y {
        swap(&mut a, &mut b);
    }
    if c.0.y < b.0.y {
        swap(&mut b, &mut c);
        if b.0.y < a.0.y {
            swap(&mut a, &mut b);
        }
    }
    [a, b, c]
}
