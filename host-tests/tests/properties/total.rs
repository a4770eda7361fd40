//! No panic, whatever the input; tests are compiled with checks for overflow.

use beamshade::{
    Background, Camera, Choose, Color, DuffBarycentric, Flat, Frame, Gouraud, Light, LightSource, Material, Mesh, Picture, Pose,
    Scanner, SceneLight, Shade,
};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb565;
use host_tests::every_method;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;

use crate::cases;
use crate::scene::{scenes, Scene, Shape, OPAQUE};

/// Draws all lines of a picture.
fn draw<S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource>(picture: Picture<'_, '_, LIGHTS, L>) {
    let mut scanner = Box::<Scanner<ACTIVE, S, LIGHTS, L>>::default();
    let mut lines = scanner.start(picture);
    let mut dropped = 0;
    for y in 0..picture.viewport().size.height as u16 {
        let line = lines.line(y, &mut [Rgb565::new(0, 0, 0); 1024]);
        assert!(usize::from(line.active) <= ACTIVE && line.dropped >= dropped);
        dropped = line.dropped;
    }
}

/// Draws all lines of a picture with smooth silhouettes; of sublines that do not blend the upper one is the line.
fn draw_smooth<const ACTIVE: usize, const LIGHTS: usize>(picture: Picture<'_, '_, LIGHTS>, blends: bool) {
    let mut scanner = Box::<Scanner<ACTIVE, DuffBarycentric, LIGHTS>>::default();
    let mut lines = scanner.start(picture);
    for y in 0..picture.viewport().size.height as u16 / 2 {
        let mut row = [Rgb565::new(0, 0, 0); 1024];
        let smooth = lines.smooth_line(y, &mut [Color::BLACK; 2048], &mut row);
        let [upper, lower] = [2 * y, 2 * y + 1].map(|y| lines.line(y, &mut row));
        let expected = if blends {
            (upper.active + lower.active, upper.spans + lower.spans, lower.dropped)
        } else {
            (upper.active, upper.spans, upper.dropped)
        };
        assert_eq!((smooth.active, smooth.spans, smooth.dropped), expected);
    }
}

/// Draws a scene with room for all of it, and with next to none, by each method.
fn draw_all<const LIGHTS: usize>(scene: &Scene<LIGHTS>) {
    macro_rules! draw_by_each {
        ($($name:literal $type:ty,)*) => {
            |picture, lit| {
                $(draw::<$type, 256, LIGHTS, Light>(picture);
                draw::<$type, 256, LIGHTS, SceneLight>(lit);)*
            }
        };
    }
    let by_each: fn(Picture<'_, '_, LIGHTS>, Picture<'_, '_, LIGHTS, SceneLight>) = every_method!(draw_by_each);
    let place = [[0.0; 3], [f32::MAX, -1.0, f32::NAN], [0.5, 1.0, -2.0]][scene.objects.len() % 3];
    scene.show(|picture| scene.show_under(&[SceneLight::point(place); LIGHTS], |lit| by_each(picture, lit)));
    let blends = scene.background != Background::Keep;
    for camera in [scene.camera, scene.camera.smooth()] {
        Scene { camera, ..scene.clone() }.show(|picture| draw_smooth::<256, LIGHTS>(picture, blends));
    }
    let meshes = scene.meshes();
    let mut small = Frame::<'_, 30, 20, 100, LIGHTS, 2, 6>::new();
    scene.fill(&meshes, &mut small);
    draw::<Choose<DuffBarycentric, Choose<Gouraud, Flat>>, 5, LIGHTS, Light>(small.picture());
    draw::<DuffBarycentric, 1, LIGHTS, Light>(small.picture());
    draw::<Flat, 0, LIGHTS, Light>(small.picture());
    draw_smooth::<5, LIGHTS>(small.picture(), blends);
}

/// Normals twice as long as they should be, and edge constants that say they have no length in the middle.
#[test]
fn normals_that_are_too_long_do_not_overflow() {
    let shape = Shape::plain(vec![[0, 0, 0], [9000, 0, 0], [0, 9000, 0]], vec![[0, 1, 2]]);
    let shape = Shape { normals: vec![[0, 0, i16::MAX]; 3], edges: vec![[u16::MAX; 3]], ..shape };
    draw_all(&Scene {
        camera: Camera::new(Size::new(64, 48)),
        lights: [Light::directional([0.0, 0.0, 1.0])],
        background: Background::Keep,
        objects: vec![(shape, Pose::IDENTITY)],
    });
}

/// One triangle, or two, that look towards the viewer, of a material without diffuse and specular reflection, and bright lights.
fn dull<const LIGHTS: usize>(size: i16, normals: [[i16; 3]; 4], edges: &[[u16; 3]]) -> Scene<LIGHTS> {
    let corners = vec![[0, 0, 0], [size, 0, 0], [size, size, 0], [0, size, 0]];
    let triangles = [[0, 1, 2], [0, 2, 3]].into_iter().take(edges.len()).collect();
    let shape = Shape::plain(corners, triangles);
    let shape =
        Shape { normals: normals.to_vec(), edges: edges.to_vec(), parts: vec![[edges.len() as u16, OPAQUE - 1]], ..shape };
    Scene {
        camera: Camera::new(Size::new(64, 48)),
        lights: [Light::directional([0.0, 0.0, 1.0]); LIGHTS],
        background: Background::Keep,
        objects: vec![(shape, Pose::IDENTITY)],
    }
}

/// One facet for both triangles of a pair: what it is lifted by for the bows of all edges.
#[test]
fn bows_of_a_dull_pair_do_not_overflow() {
    // 29.9° about one axis, 40° about the other.
    let normals = [[8167, 0, 14203], [0, 10531, 12551], [-8167, 0, 14203], [0, -10531, 12551]];
    draw_all(&dull::<4>(16000, normals, &[[11008, 11008, 16285], [16285, 11008, 11008]]));
    draw_all(&dull::<1>(16000, [[0, 0, i16::MAX]; 4], &[[16384; 3]; 2]));
}

/// The plane nearest to the light of a triangle: how far apart that moves its corners.
#[test]
fn corners_of_a_dull_plane_do_not_overflow() {
    let normals = [[0, 0, i16::MIN], [0, 0, i16::MAX], [0, 0, i16::MAX], [0, 0, i16::MIN]];
    // In one of these the reciprocal of the area has its largest mantissa.
    for size in 0..40 {
        draw_all(&dull::<1>(8000 + 200 * size, normals, &[[0, 16384, 0]]));
    }
}

/// The binary form of a mesh with two parts and two materials, in words.
fn binary() -> Vec<u16> {
    let vertices: [u16; 12] = [0, 0, 0, 9000, 0, 0, 0, 9000, 0, 0, 0, 9000];
    let normals = [0, 0, 16384].repeat(4);
    let triangles: [u16; 6] = [0, 1, 2, 0, 3, 1];
    let header = [Mesh::MAGIC[0], Mesh::MAGIC[1], Mesh::VERSION, 4, 2, 2, 2, 0, 1, 0, 0, 0, 16384];
    let tail = [[0; 6].as_slice(), &[1, 0, 1, 1], &[9000; 2 * Material::WORDS]].concat();
    [&header, vertices.as_slice(), &normals, &triangles, &tail].concat()
}

proptest! {
    #![proptest_config(cases(1024))]

    #[test]
    fn scenes_of_one_light(scene in scenes::<1>()) {
        draw_all(&scene);
    }

    #[test]
    fn scenes_of_two_lights(scene in scenes::<2>()) {
        draw_all(&scene);
    }

    #[test]
    fn scenes_of_four_lights(scene in scenes::<4>()) {
        draw_all(&scene);
    }

    #[test]
    fn what_is_read_from_bytes_can_be_drawn(changes in vec((any::<Index>(), any::<u16>()), 0..4), cut in 0..3usize) {
        let mut words = binary();
        for (place, word) in &changes {
            let place = place.index(words.len());
            words[place] = *word;
        }
        let bytes: &[u8] = bytemuck::cast_slice(&words);
        let materials = [Material::new(Color::WHITE); 2];
        let mesh = Mesh::from_bytes(&bytes[..bytes.len() - cut], &materials);
        prop_assert!(mesh.is_err() || cut == 0);
        prop_assert!(mesh.is_ok() || cut > 0 || !changes.is_empty());
        if let Ok(mesh) = mesh {
            let mut frame = Frame::<'_, 16, 16, 48>::new();
            frame.begin(&Camera::new(Size::new(64, 48)), &[Light::OFF]).unwrap();
            let _ = frame.add(&mesh, &Pose::IDENTITY);
            draw::<DuffBarycentric, 8, 1, Light>(frame.picture());
        }
    }
}
