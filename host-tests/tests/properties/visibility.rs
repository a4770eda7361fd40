//! Who is seen, against depths in f64, against the by-polygon z-buffer, and by either visibility.

use beamshade::model::clip::edge_constant;
use beamshade::{Background, Camera, Color, DepthLine, DuffBarycentric, Light, Scanner, Spanning, Visibility};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Gray8;
use glam::DVec3;
use host_tests::library::{self, read};
use host_tests::reference::{by_polygon, EdgeList, Polygon};
use host_tests::{Owner, Picture};
use proptest::array::uniform3;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::cases;
use crate::scene::{rotations, scenes, unit_normals, Place, Rays, Scene, Shape};

const DISTANCE: f32 = 3.0;

/// Double-sided triangles through each other, before the eye, and some of them behind it.
pub(crate) fn soups() -> impl Strategy<Value = (Scene, Vec<Place>)> {
    let triangle = uniform3(uniform3(-32767..=32767i16)).prop_filter("too thin", |corners| {
        let [a, b, c] = corners.map(|corner| DVec3::from_array(corner.map(f64::from)));
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
        (b - a).cross(c - a).length() > 0.2 * longest
    });
    let shape = vec((triangle, uniform3(unit_normals())), 1..8).prop_map(|triangles| {
        let (positions, normals): (Vec<_>, Vec<_>) = triangles.into_iter().unzip();
        let edges = normals.iter().map(|[a, b, c]| [(a, b), (b, c), (c, a)].map(|(n, m)| edge_constant(*n, *m))).collect();
        let triangles = (0..positions.len() as u16).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        Shape { normals: normals.into_flattened(), edges, ..Shape::plain(positions.into_flattened(), triangles) }
    });
    let at = prop_oneof![2 => uniform3(-0.5f32..0.5), 1 => uniform3(-2f32..3.0)];
    let place = (rotations(), 0.3f32..2.0, at).prop_map(|(rotation, scale, at)| Place { rotation, scale, at });
    (vec((shape, place), 1..4), (1u32..=80, 1u32..=60)).prop_map(|(objects, (width, height))| {
        let (objects, places) = objects.into_iter().map(|(shape, place)| ((shape, place.pose()), place)).unzip();
        let camera = Camera::new(Size::new(width, height)).at_distance(DISTANCE);
        let background = Background::Plain(Color::BLACK);
        (Scene { camera, lights: [Light::OFF], background, objects }, places)
    })
}

/// The owners of all pixels.
fn owners(scene: &Scene) -> Vec<Option<Owner>> {
    scene.show(|picture| read::<Gray8, DuffBarycentric, 1024, 1, _>(&mut Scanner::new().start(picture)).owner)
}

/// The scene as drawn with that visibility and room for so many triangles on a line.
pub(crate) fn drawn<V: Visibility, const ACTIVE: usize>(scene: &Scene) -> Picture<Gray8> {
    scene.show(|picture| {
        let mut scanner = Box::<Scanner<ACTIVE, DuffBarycentric, 1, Light, V>>::default();
        library::read_by(&mut scanner.start(picture))
    })
}

/// Checks that spanning and the one-line z-buffer give equal pictures; returns the number of lines.
fn same_by_either(scene: &Scene) -> usize {
    let expected = drawn::<Spanning, 1024>(scene);
    assert!(drawn::<DepthLine<1024>, 1024>(scene) == expected);
    assert!(drawn::<DepthLine<7>, 1024>(scene) == expected);
    assert!(drawn::<DepthLine<64>, 5>(scene) == drawn::<Spanning, 5>(scene));
    expected.height
}

/// Checks that the owners of all pixels are those of the by-polygon z-buffer, save where two are closer to each other than the
/// library's depths are exact; returns the number of pixels where they differ, and of all that are covered.
fn same_by_polygon(scene: &Scene) -> [usize; 2] {
    scene.show(|picture| {
        let drawn: Picture<Gray8> = read(&mut Box::<Scanner<1024>>::default().start(picture));
        let polygons = library::polygons(&picture);
        let expected = by_polygon(&polygons, drawn.width, drawn.height);
        let mut different = 0;
        for (pixel, owners) in drawn.owner.iter().zip(&expected).enumerate().filter(|(_, (seen, expected))| seen != expected) {
            let (Some(seen), Some(nearest)) = owners else { panic!("{owners:?} at {pixel}") };
            let (x, y) = (pixel % drawn.width, pixel / drawn.width);
            let near = |owner: &Owner| {
                let covers = |polygon: &&Polygon| {
                    let edges = EdgeList::new(&polygon.corners, drawn.height);
                    let found = edges.segments(drawn.width).any(|(line, segment)| line == y && segment.contains(&x));
                    polygon.owner == *owner && found
                };
                polygons.iter().filter(covers).map(|polygon| polygon.nearness_at(x, y)).fold(f64::MIN, f64::max)
            };
            let farther = near(nearest) - near(seen);
            // Each depth is off by less than 2¹⁴ of 2³⁰, where a nearness has 2²³.
            assert!(farther < 256.0, "{seen:?} before {nearest:?}, which is {farther} nearer, at {x} {y}");
            different += 1;
        }
        [different, drawn.covered()]
    })
}

/// 1/z of a triangle's plane as a function of the ray: its product with this vector.
fn nearness([a, b, c]: [DVec3; 3]) -> DVec3 {
    let normal = (b - a).cross(c - a);
    normal / normal.dot(a)
}

/// The larger side of the rectangle on the screen, in pixels, around what lies beyond the near plane.
fn spread(corners: [DVec3; 3], focal: f64) -> f64 {
    const NEAR: f64 = 0.1;
    let ends = [(0, 1), (1, 2), (2, 0)].map(|(from, to)| (corners[from], corners[to]));
    let cut = |(a, b): (DVec3, DVec3)| a.lerp(b, (NEAR + a.z) / (a.z - b.z));
    let cuts = ends.into_iter().filter(|(a, b)| (a.z < -NEAR) != (b.z < -NEAR)).map(cut);
    let points: Vec<_> = corners.into_iter().filter(|corner| corner.z < -NEAR).chain(cuts).collect();
    let range = |axis: fn(DVec3) -> f64| {
        let along = points.iter().map(|point| (axis(*point) * focal / -point.z).clamp(-1535.0, 1535.0));
        along.clone().fold(f64::MIN, f64::max) - along.fold(f64::MAX, f64::min)
    };
    range(|point| point.x).max(range(|point| point.y))
}

proptest! {
    #![proptest_config(cases(1024))]

    #[test]
    fn the_nearest_is_seen((scene, places) in soups()) {
        let rays = Rays::of(&scene.camera);
        let seen = owners(&scene);
        let mut candidates = vec![Vec::new(); seen.len()];
        for (owner, pixels) in scene.coverage() {
            let (shape, _) = &scene.objects[owner.object as usize];
            let corners = shape.triangles[owner.triangle as usize].map(|corner| shape.positions[usize::from(corner)]);
            let eye = DVec3::new(0.0, 0.0, DISTANCE.into());
            let corners = corners.map(|corner| places[owner.object as usize].world(shape, corner) - eye);
            let plane = nearness(corners);
            // Corners are rounded to 1/256 pixel, sides to 1/4096 of the longest: a steep plane makes much of that.
            let slope = (plane.x.abs() + plane.y.abs()) / rays.focal;
            let rounding = slope * (1.0 / 256.0 + spread(corners, rays.focal) / 1024.0);
            for pixel in pixels {
                let near = plane.dot(rays.to(rays.middle(pixel)));
                candidates[pixel].push((owner, near, 1e-4 * near + rounding));
            }
        }
        for (pixel, candidates) in candidates.iter().enumerate() {
            let Some(owner) = seen[pixel] else {
                prop_assert!(candidates.is_empty(), "a hole at {}", pixel);
                continue;
            };
            let Some((_, near, error)) = candidates.iter().find(|(candidate, ..)| *candidate == owner) else {
                return Err(TestCaseError::fail(format!("{owner:?} is seen at {pixel}, which it does not cover")));
            };
            for (other, nearer, tolerance) in candidates {
                prop_assert!(near + error >= nearer - tolerance, "{:?} {} before {:?} {}", owner, near, other, nearer);
            }
        }
    }

    #[test]
    fn of_equals_the_lower_is_seen(scene in scenes::<1>()) {
        let mut twice = scene.clone();
        twice.objects.truncate(2);
        let once = Scene { objects: twice.objects.clone(), ..scene };
        let objects: Vec<_> = twice.objects.iter().map(|(shape, pose)| {
            let again = |list: &Vec<[u16; 3]>| [&list[..], &list[..]].concat();
            let shape = Shape { triangles: again(&shape.triangles), edges: again(&shape.edges), parts: [&shape.parts[..], &shape.parts[..]].concat(), ..shape.clone() };
            (shape, *pose)
        }).collect();
        twice.objects = [objects.clone(), objects].concat();
        prop_assert!(owners(&twice) == owners(&once));
    }

    #[test]
    fn either_visibility_gives_the_same_picture(scene in prop_oneof![1 => scenes::<1>(), 3 => soups().prop_map(|(scene, _)| scene)]) {
        same_by_either(&scene);
    }

    #[test]
    fn the_by_polygon_z_buffer_sees_the_same(scene in prop_oneof![1 => scenes::<1>(), 3 => soups().prop_map(|(scene, _)| scene)]) {
        same_by_polygon(&scene);
    }

    /// At any pixel, in any order, and outside of the picture.
    #[test]
    fn what_is_picked_is_what_is_seen((scene, _) in soups(), places in vec((0u16..90, 0u16..70), 1..40)) {
        scene.show(|picture| {
            let drawn: Picture<Gray8> = read(&mut Scanner::<256>::new().start(picture));
            let mut scanner = Box::<Scanner<256>>::default();
            let mut lines = scanner.start(picture);
            for (x, y) in places {
                let inside = usize::from(x) < drawn.width && usize::from(y) < drawn.height;
                let expected = if inside { drawn.owner[usize::from(y) * drawn.width + usize::from(x)] } else { None };
                assert_eq!(lines.pick(x, y).map(library::owner), expected, "{x} {y}");
            }
        });
    }
}

/// Many triangles through each other, of all sizes.
#[test]
fn a_crowd_looks_the_same_by_all() {
    let mut random = fastrand::Rng::with_seed(7);
    let (mut lines, mut sum) = (0, [0; 2]);
    for _ in 0..80 {
        let mut corner = |around: [i16; 3], size: i16| around.map(|c| c.saturating_add(random.i16(-size..=size)));
        let positions = (0..150).flat_map(|i| {
            let (size, origin) = ([32767, 9000, 3000][i % 3], corner([0; 3], 20000));
            [(); 3].map(|()| corner(origin, size))
        });
        let positions: Vec<_> = positions.collect();
        let triangles = (0..150).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let scene = Scene {
            camera: Camera::new(Size::new(160, 144)).at_distance(DISTANCE),
            lights: [Light::OFF],
            background: Background::Plain(Color::BLACK),
            objects: vec![(Shape::plain(positions, triangles), beamshade::Pose::IDENTITY)],
        };
        lines += same_by_either(&scene);
        let [different, covered] = same_by_polygon(&scene);
        sum = [sum[0] + different, sum[1] + covered];
    }
    let [different, covered] = sum;
    println!("{lines} lines, {covered} pixels, {different} of them closer than depths are exact");
    assert!(lines >= 10_000 && different * 10_000 < covered);
}
