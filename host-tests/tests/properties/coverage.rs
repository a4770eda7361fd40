//! Triangles that share edges leave no gap and overlap nowhere.

use std::f64::consts::TAU;

use beamshade::{Background, Camera, Color, Flat, Light, Rotation, Scanner};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Gray8;
use fixed::types::I16F16;
use glam::DVec3;
use host_tests::library::{polygons, read};
use host_tests::reference::EdgeList;
use host_tests::Owner;
use proptest::array::{uniform2, uniform3};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::cases;
use crate::scene::{rotations, scenes, Place, Rays, Scene, Shape};

const SIZE: usize = 48;
const DISTANCE: f64 = 3.0;

fn camera() -> Camera {
    Camera::new(Size::new(SIZE as u32, SIZE as u32)).at_distance(DISTANCE as f32)
}

fn scene(shape: Shape, place: Place) -> Scene {
    Scene {
        camera: camera(),
        lights: [Light::OFF],
        background: Background::Plain(Color::BLACK),
        objects: vec![(shape, place.pose())],
    }
}

/// How often each pixel is covered, and by which triangle last.
fn times(scene: &Scene) -> (Vec<i32>, Vec<Option<Owner>>) {
    let (mut times, mut owners) = (vec![0; SIZE * SIZE], vec![None; SIZE * SIZE]);
    for (owner, pixels) in scene.coverage() {
        for pixel in pixels {
            times[pixel] += 1;
            owners[pixel] = Some(owner);
        }
    }
    (times, owners)
}

/// A partition of more than the picture: points in 1/64 pixel from its centre, and triangles.
#[derive(Clone, Debug)]
struct Partition {
    points: Vec<[i32; 2]>,
    triangles: Vec<[u16; 3]>,
}

impl Partition {
    /// A mesh that is seen so. Each vertex is at that share of the distance; at 1 all points are met exactly.
    fn shape(&self, nearer: &[f64]) -> Shape {
        // Such that a unit of the mesh is 1/64 pixel where the camera looks at.
        let unit = DISTANCE / (64.0 * Rays::of(&camera()).focal);
        let vertex = |([x, y], share): (&[i32; 2], &f64)| {
            let [x, y] = [*x, -*y].map(|c| f64::from(c) * share);
            [x, y, (1.0 - share) * DISTANCE / unit].map(|c| c.round() as i16)
        };
        let positions = self.points.iter().zip(nearer.iter().cycle()).map(vertex).collect();
        Shape { extent: I16F16::from_num(unit * 32768.0), ..Shape::plain(positions, self.triangles.clone()) }
    }
}

/// In 1/64 pixel: mostly a quarter of a pixel or a centre, where the fill rule decides.
fn coordinates(most: i32) -> impl Strategy<Value = i32> {
    prop_oneof![2 => (-most / 32..=most / 32).prop_map(|c| c * 32), 1 => (-most / 16..=most / 16).prop_map(|c| c * 16), 1 => -most..=most]
}

/// Triangles around a point of the picture, out to a circle beyond it.
fn fans() -> impl Strategy<Value = Partition> {
    (uniform2(coordinates(64 * 24)), vec(0.0..0.6, 6..12), 60f64..400.0).prop_map(|(center, jitter, radius)| {
        let step = TAU / jitter.len() as f64;
        let rim = jitter.iter().zip(0u16..).map(|(jitter, i)| {
            let (sin, cos) = f64::sin_cos((f64::from(i) + jitter) * step);
            [cos, sin].map(|c| (c * radius * 64.0).round() as i32)
        });
        let points: Vec<_> = std::iter::once(center).chain(rim).collect();
        let last = points.len() as u16 - 1;
        let triangles = (1..=last).map(|i| [0, i, i % last + 1]).collect();
        Partition { points, triangles }
    })
}

/// A grid with each vertex moved a little, the cells cut along either diagonal.
fn grids() -> impl Strategy<Value = Partition> {
    const CELLS: u16 = 7;
    const CELL: i32 = 64 * 9;
    const VERTICES: usize = (CELLS as usize + 1).pow(2);
    (vec(uniform2(coordinates(CELL / 5)), VERTICES), vec(any::<bool>(), usize::from(CELLS).pow(2))).prop_map(|(moved, cut)| {
        let vertex = |x: u16, y: u16| y * (CELLS + 1) + x;
        let place = |i: usize| [i as i32 % i32::from(CELLS + 1), i as i32 / i32::from(CELLS + 1)];
        let at = |i: usize, axis: usize| (2 * place(i)[axis] - i32::from(CELLS)) * CELL / 2 + moved[i][axis];
        let points = (0..VERTICES).map(|i| [at(i, 0), at(i, 1)]).collect();
        let cells = (0..CELLS).flat_map(|y| (0..CELLS).map(move |x| (x, y))).zip(cut);
        let triangles = cells.flat_map(|((x, y), cut)| {
            let [a, b, c, d] = [vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)];
            if cut {
                [[a, b, c], [c, d, a]]
            } else {
                [[b, c, d], [d, a, b]]
            }
        });
        Partition { points, triangles: triangles.collect() }
    })
}

proptest! {
    #![proptest_config(cases(512))]

    #[test]
    fn a_partition_covers_each_pixel_once(
        partition in prop_oneof![fans(), grids()],
        nearer in prop_oneof![Just(vec![1.0]), vec(0.1..1.0, 64)],
    ) {
        let scene = scene(partition.shape(&nearer), Place { rotation: Rotation::NONE, scale: 1.0, at: [0.0; 3] });
        let (times, owners) = times(&scene);
        prop_assert_eq!(times, vec![1; SIZE * SIZE]);
        let together = scene.show(|picture| read::<Gray8, Flat, 128, 1, _>(&mut Scanner::new().start(picture)));
        prop_assert!(together.owner == owners);
    }

    /// Each triangle by itself, in the pieces that clipping made of it.
    #[test]
    fn linked_edge_lists_cover_the_same(scene in scenes::<1>()) {
        for ((owner, pixels), (_, alone)) in scene.coverage().iter().zip(scene.alone()) {
            let covered = alone.show(|picture| {
                let size = picture.viewport().size;
                let (width, height) = (size.width as usize, size.height as usize);
                let mut covered = vec![false; width * height];
                for polygon in polygons(&picture) {
                    for (y, segment) in EdgeList::new(&polygon.corners, height).segments(width) {
                        covered[y * width + segment.start..y * width + segment.end].fill(true);
                    }
                }
                (0..covered.len()).filter(|pixel| covered[*pixel]).collect::<Vec<_>>()
            });
            prop_assert!(covered == *pixels, "{:?}", owner);
        }
    }

    /// A floor through the near plane and far beyond the guard band, wherever it lies.
    #[test]
    fn what_is_clipped_covers_each_pixel_once(
        partition in grids(), rotation in rotations(), scale in 1f32..400.0, at in uniform3(-1f32..1.0),
    ) {
        let place = Place { rotation, scale, at };
        let shape = Shape::plain(partition.points.iter().map(|[x, y]| [*x as i16, 0, *y as i16]).collect(), partition.triangles);
        // Rounding to the subpixel grid may turn a triangle seen edge-on: it then takes away what its neighbours have twice.
        let turned = shape.triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        let turned = Shape { triangles: turned, ..shape.clone() };
        let [front, back] = [shape, turned].map(|shape| {
            let parts = vec![[shape.triangles.len() as u16, 0]];
            times(&scene(Shape { parts, ..shape }, place)).0
        });
        let rays = Rays::of(&camera());
        let eye = DVec3::new(0.0, 0.0, DISTANCE) - DVec3::from_array(at.map(f64::from));
        let matrix = place.matrix().transpose();
        let unit = f64::from(scale) / 32768.0;
        let covered = |point: [f64; 2]| {
            // Where the ray meets y = 0 in the mesh's own space.
            let ray = rays.to(point);
            let (from, along) = (matrix * eye / unit, matrix * ray / unit);
            let z = -from.y / along.y;
            let there = from + along * z;
            // The border is not straight: only what lies a cell inside or outside of it is certain.
            let cells = there.x.abs().max(there.z.abs()) / (64.0 * 9.0);
            let (inside, outside) = (z > 0.1001 && cells < 2.5, z < 0.0999 || cells > 4.5);
            (inside || outside).then_some(inside)
        };
        // The corners run clockwise seen from above, where x is right and z is down.
        let once = if (matrix * eye).y > 0.0 { -1 } else { 1 };
        for (pixel, times) in front.iter().zip(&back).map(|(front, back)| front - back).enumerate() {
            let [x, y] = rays.middle(pixel);
            let around = [[0.0, 0.0], [-0.02, 0.0], [0.02, 0.0], [0.0, -0.02], [0.0, 0.02]];
            let around = around.map(|[dx, dy]| covered([x + dx, y + dy]));
            prop_assert!(times == 0 || times == once, "{} times at {} {}", times, x, y);
            for (certain, expected) in [(true, once), (false, 0)] {
                if around == [Some(certain); 5] {
                    prop_assert_eq!(times, expected, "{} {}", x, y);
                }
            }
        }
    }
}
