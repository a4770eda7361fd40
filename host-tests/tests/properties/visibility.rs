//! Who is seen, against depths in f64.

use beamshade::model::clip::edge_constant;
use beamshade::{Background, Camera, Color, DuffBarycentric, Light, Scanner};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Gray8;
use glam::DVec3;
use host_tests::library::read;
use host_tests::Owner;
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
}
