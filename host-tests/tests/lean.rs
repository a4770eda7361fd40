//! Frames that store no vertices, on the teapot.

use std::path::Path;

use beamshade::{
    Baked, Camera, DuffBarycentric, Frame, Frozen, Full, Hybrid, LeanFrame, Light, Mesh, Pose, Rotation, Scanner, Shade, Turn,
};
use beamshade_mesh::{Model, Options, Quantized};
use embedded_graphics::geometry::Size;

const LIGHT: [f32; 3] = [-0.5, 0.7, 0.6];

fn teapot() -> Quantized {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/models/teapot-880.obj");
    Model::load(file, &Options::default()).unwrap().quantize().unwrap()
}

/// All rows of some poses, drawn at once, baked and frozen, are those of a frame that stores its vertices.
fn same<S: Shade<1>>(mesh: &Mesh<'_>) {
    let camera = Camera::new(Size::new(240, 240)).field_of_view(Turn::degrees(40)).at_distance(2.45);
    let mut stored = Box::new(Frame::<512, 320, 240>::new());
    let mut lean = Box::new(LeanFrame::<320, 240>::new());
    let mut scanners = [(); 3].map(|()| Box::new(Scanner::<48, S>::new()));
    let (mut baked, mut frozen) = (Box::new(Baked::<256, S>::new()), Box::new(Frozen::<16384, 1024, 240, S>::new()));
    for step in 0..20 {
        let pose = Pose::turned(Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(18 * step)));
        stored.begin(&camera, &[Light::directional(LIGHT)]).unwrap();
        stored.add(mesh, &pose).unwrap();
        lean.begin(&camera, &[Light::directional(LIGHT)]).unwrap();
        lean.add(mesh, &pose).unwrap();
        let [one, other, third] = &mut scanners;
        assert_eq!(frozen.take(third.start(lean.picture())).left_out, 0);
        let (mut one, mut other, mut third) =
            (one.start(stored.picture()), other.start(lean.picture()), third.start(lean.picture()));
        for y in 0..240 {
            let mut rows = [[0_u16; 240]; 4];
            let [expected, row, of_baked, of_frozen] = &mut rows;
            assert_eq!(one.line(y, expected.as_mut_slice()), other.line(y, row.as_mut_slice()));
            assert_eq!(third.bake(y, &mut baked).left_out, 0);
            baked.shade(of_baked.as_mut_slice());
            frozen.line(y, of_frozen.as_mut_slice());
            assert!([row, of_baked, of_frozen].iter().all(|row| *row == expected), "step {step}, line {y}");
        }
    }
}

#[test]
fn a_lean_frame_shows_the_same_pixels() {
    let quantized = teapot();
    same::<DuffBarycentric>(&quantized.mesh());
    same::<Hybrid<8>>(&quantized.mesh());
}

/// The memory that it is for: less than a third of what a frame takes that stores the teapot's vertices.
#[test]
fn a_lean_frame_is_small() {
    assert!(3 * size_of::<LeanFrame<'_, 252, 240>>() < size_of::<Frame<'_, 481, 252, 240>>());
}

/// Triangles that reach behind the eye are left out and counted; the others are there.
#[test]
fn what_would_be_clipped_is_counted() {
    let quantized = teapot();
    let mesh = quantized.mesh();
    let camera = Camera::new(Size::new(240, 240)).at_distance(0.4);
    let mut frame = LeanFrame::<880, 240>::new();
    frame.begin(&camera, &[Light::directional(LIGHT)]).unwrap();
    let Err(Full::Made { fitted: 0, left_out }) = frame.add(&mesh, &Pose::IDENTITY) else {
        panic!("the body reaches behind the eye")
    };
    assert!((1..440).contains(&left_out), "{left_out}");
    let mut without_room = Frame::<512, 880, 240, 1, 1, 0>::new();
    without_room.begin(&camera, &[Light::directional(LIGHT)]).unwrap();
    assert!(matches!(without_room.add(&mesh, &Pose::IDENTITY), Err(Full::Made { .. })));
    let [all, others] = [frame.picture().triangles(), without_room.picture().triangles()];
    assert!(all > 0 && all == others, "{all} {others}");
}
