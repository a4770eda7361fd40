//! Out of room: what is said, and what is still drawn.

use beamshade::{Background, Camera, Color, DuffBarycentric, Frame, Full, LeanFrame, Light, Pose, Scanner};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;
use host_tests::library::read;
use host_tests::Picture;
use proptest::prelude::*;

use crate::cases;
use crate::scene::{scenes, Scene, Shape};

/// The drawn picture of a frame.
fn draw<const V: usize, const T: usize, const L: usize, const O: usize, const M: usize>(
    frame: &Frame<'_, V, T, L, 1, O, M>,
) -> Picture<Rgb888> {
    read::<_, DuffBarycentric, 512, 1, _>(&mut Scanner::new().start(frame.picture()))
}

/// The objects that are seen.
fn seen(picture: &Picture<Rgb888>) -> Vec<u32> {
    let mut objects: Vec<_> = picture.owner.iter().flatten().map(|owner| owner.object).collect();
    objects.sort_unstable();
    objects.dedup();
    objects
}

/// Columns of one triangle each, side by side before the camera; z of the nearest corner, which is the upper one, is given.
fn columns(nearest: &[f32]) -> Scene {
    let object = |(i, near): (usize, &f32)| {
        // Every other one leans far back.
        let foot = if i % 2 == 0 { -20000 } else { -100 };
        let shape = Shape::plain(vec![[-2000, -30000, foot], [2000, -30000, foot], [0, 30000, 0]], vec![[0, 1, 2]]);
        let x = (i as f32 - (nearest.len() - 1) as f32 / 2.0) * 0.2;
        (shape, Pose::IDENTITY.at([x * (3.0 - near) / 3.0, 0.0, *near]))
    };
    Scene {
        camera: Camera::new(Size::new(64, 48)),
        lights: [Light::OFF],
        background: Background::Plain(Color::BLACK),
        objects: nearest.iter().enumerate().map(object).collect(),
    }
}

#[test]
fn a_frame_of_too_few_lines_draws_the_first_ones() {
    let scene = columns(&[0.0, 0.5]);
    let meshes = scene.meshes();
    let mut frame = Frame::<'_, 64, 64, 20>::new();
    assert_eq!(frame.begin(&scene.camera, &scene.lights), Err(Full::Lines { fitted: 20 }));
    assert_eq!(scene.fill(&meshes, &mut frame), [Ok(()), Ok(())]);
    let whole = scene.show(|picture| read::<Rgb888, DuffBarycentric, 512, 1, _>(&mut Scanner::new().start(picture)));
    let drawn = draw(&frame);
    assert_eq!((drawn.width, drawn.height), (64, 20));
    assert!(drawn.color == whole.color[..64 * 20] && drawn.owner == whole.owner[..64 * 20]);
}

#[test]
fn objects_beyond_the_frames_are_left_out_but_numbered() {
    let mut scene = columns(&[0.0; 5]);
    scene.objects[1].1 = Pose::IDENTITY.at([100.0, 0.0, 0.0]);
    let meshes = scene.meshes();
    let mut frame = Frame::<'_, 64, 64, 48, 1, 3>::new();
    // The one out of sight needs no room.
    assert_eq!(scene.fill(&meshes, &mut frame), [Ok(()), Ok(()), Ok(()), Ok(()), Err(Full::Objects { fitted: 3 })]);
    assert_eq!(seen(&draw(&frame)), [0, 2, 3]);
}

#[test]
fn an_object_of_too_many_vertices_is_left_out_whole() {
    let mut scene = columns(&[0.0; 3]);
    let [_, large, _] = &mut scene.objects[..] else { unreachable!() };
    large.0.positions = large.0.positions.repeat(2);
    large.0.normals = large.0.normals.repeat(2);
    let meshes = scene.meshes();
    let mut frame = Frame::<'_, 8, 64, 48>::new();
    assert_eq!(scene.fill(&meshes, &mut frame), [Ok(()), Err(Full::Vertices { fitted: 5 }), Ok(())]);
    assert_eq!(seen(&draw(&frame)), [0, 2]);
}

/// Triangles with two corners behind the eye, and the third before it: each is cut to one triangle with two new corners. And
/// an object that needs room for one vertex.
fn clipped() -> Scene {
    let mut scene = columns(&[0.0]);
    let corners = |i: i16| {
        let x = 400 * (i - 3);
        [[x, -300, -32000], [x, -400, 32000], [x + 400, -400, 32000]]
    };
    let positions = (0..6).flat_map(corners).collect();
    let triangles = (0..6).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let point = Shape::plain(vec![[0; 3]], vec![[0; 3]]);
    let behind = Pose::IDENTITY.at([0.0, 0.0, 2.5]);
    scene.objects = vec![(Shape::plain(positions, triangles), behind), (point, Pose::IDENTITY)];
    scene
}

#[test]
fn triangles_to_be_clipped_need_room_for_triangles_and_corners() {
    fn fill<const V: usize, const M: usize>() -> (Vec<Result<(), Full>>, Picture<Rgb888>) {
        let scene = clipped();
        let meshes = scene.meshes();
        let mut frame = Frame::<'_, V, 64, 48, 1, 4, M>::new();
        (scene.fill(&meshes, &mut frame), draw(&frame))
    }
    let triangles = |picture: &Picture<Rgb888>| {
        let mut triangles: Vec<_> = picture.owner.iter().flatten().map(|owner| owner.triangle).collect();
        triangles.sort_unstable();
        triangles.dedup();
        triangles
    };
    let (enough, whole) = fill::<31, 6>();
    assert_eq!((enough, triangles(&whole)), (vec![Ok(()), Ok(())], vec![0, 1, 2, 3, 4, 5]));
    let (few_triangles, drawn) = fill::<31, 4>();
    assert_eq!((few_triangles, triangles(&drawn)), (vec![Err(Full::Made { fitted: 4, left_out: 2 }), Ok(())], vec![0, 1, 2, 3]));
    let (few_corners, drawn) = fill::<25, 6>();
    assert_eq!((few_corners, triangles(&drawn)), (vec![Err(Full::Made { fitted: 3, left_out: 3 }), Ok(())], vec![0, 1, 2]));
}

proptest! {
    #![proptest_config(cases(512))]

    /// A frame with room for eight triangles draws the picture of the triangles up to the eighth that faces the eye; pairs of them take the
    /// place of one.
    #[test]
    fn the_first_triangles_that_fit_are_drawn(scene in scenes::<1>()) {
        let scene = Scene { objects: scene.objects[..1].to_vec(), ..scene };
        let meshes = scene.meshes();
        let mut large = Box::<Frame<'_, 256, 256, 1024, 1, 1, 0>>::default();
        if scene.fill(&meshes, &mut large) != [Ok(())] {
            // To be clipped, which is another matter.
            return Ok(());
        }
        let all = large.picture().triangles();
        let mut small = Box::<Frame<'_, 256, 8, 1024, 1, 1, 0>>::default();
        let fitted = match scene.fill(&meshes, &mut small)[..] {
            [Ok(())] => all,
            [Err(Full::Triangles { fitted, left_out })] => {
                prop_assert_eq!(usize::from(fitted + left_out), all);
                fitted.into()
            }
            ref other => panic!("{other:?}"),
        };
        prop_assert!((all.min(8)..=16).contains(&fitted));
        prop_assert_eq!(small.picture().triangles(), fitted);

        let mut expected = scene.clone();
        while expected.show(|picture| picture.triangles()) > fitted {
            expected.objects[0].0.pop();
        }
        prop_assert!(draw(&small) == expected.show(|picture| read(&mut Scanner::<512>::new().start(picture))));
    }

    /// On lines that all of them cross, the nearest are left, in whatever order they came.
    #[test]
    fn a_full_line_keeps_the_nearest(nearest in Just([-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5f32]).prop_shuffle()) {
        let scene = columns(&nearest);
        scene.show(|picture| {
            let mut scanner = Scanner::<3>::new();
            let mut lines = scanner.start(picture);
            let line = lines.line(24, &mut [Rgb888::default(); 64]);
            assert_eq!((line.active, line.dropped), (3, 4));
            lines.spans(24, |_, source| assert!(nearest[usize::from(source.object)] > 0.2, "{source:?}"));
        });
    }
}

#[test]
fn a_mesh_of_nothing_hides_nothing() {
    // All numbers of vertices are taken before it.
    let mut shape = Shape::plain(vec![[0; 3]; 0xffff], vec![[0, 1, 2]]);
    (shape.positions[1], shape.positions[2]) = ([9000, 0, 0], [0, 9000, 0]);
    let shapes = [shape, Shape::plain(vec![[0; 3]], vec![]), Shape { radius: 100, ..Shape::plain(vec![], vec![]) }];
    let meshes = shapes.each_ref().map(Shape::mesh);
    let camera = Camera::new(Size::new(64, 48));
    let mut lean = Box::<LeanFrame<'_, 8, 48, 1, 3>>::default();
    let mut stored = Box::<Frame<'_, 0x1_0000, 8, 48, 1, 3>>::default();
    lean.begin(&camera, &[Light::OFF]).unwrap();
    stored.begin(&camera, &[Light::OFF]).unwrap();
    for mesh in &meshes {
        lean.add(mesh, &Pose::IDENTITY).unwrap();
        stored.add(mesh, &Pose::IDENTITY).unwrap();
    }
    let expected = Scanner::<8>::new().start(stored.picture()).pick(33, 22);
    assert!(expected.is_some());
    assert_eq!(Scanner::<8>::new().start(lean.picture()).pick(33, 22), expected);
}

#[test]
fn what_is_not_clipped_counts_beside_what_has_no_room() {
    let before = |x: i16| [[x, -300, 0], [x + 400, -300, 0], [x, 300, 0]];
    let around = |x: i16| [[x, -300, 0], [x + 400, -300, 0], [x, 300, 32000]];
    let positions = [before(-900), before(0), before(900), around(-400), around(400)].as_flattened().to_vec();
    let shape = Shape::plain(positions, (0..5).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect());
    let (mesh, camera) = (shape.mesh(), Camera::new(Size::new(64, 48)).at_distance(0.5));
    let mut frame = Box::<LeanFrame<'_, 2, 48>>::default();
    frame.begin(&camera, &[Light::OFF]).unwrap();
    assert_eq!(frame.add(&mesh, &Pose::IDENTITY), Err(Full::Triangles { fitted: 2, left_out: 3 }));
}
