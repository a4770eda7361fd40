//! Small pictures, exact to the bit, each held against the f64 reference as well.
//!
//! `BEAMSHADE_BLESS=1 cargo test -p host-tests --test goldens` makes them again.

use std::env;
use std::path::Path;

use beamshade::{Background, Color, DuffBarycentric, Flat, Frame, Gouraud, Ink, Overlay, Rotation, Scanner, Shade, Turn};
use embedded_graphics::framebuffer::{buffer_size, Framebuffer};
use embedded_graphics::mono_font::{ascii::FONT_6X10, MonoTextStyle};
use embedded_graphics::pixelcolor::raw::{BigEndian, RawU24};
use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::text::{Baseline, Text};
use glam::{DMat3, DVec3};
use host_tests::library::{self, Meshes};
use host_tests::reference::{render, Camera, Material, Mesh, Object, Options, Pose, Scene};
use host_tests::{image, scenes, shapes, Format, Measures, Picture};

const WIDTH: usize = 96;
const HEIGHT: usize = 72;
/// Of the standard scene.
const FRAME: u32 = 5;

/// Holds a picture against the reference, which must be at least so many dB away from it, and only then against its golden.
fn check<P: Format>(name: &str, drawn: &Picture<P>, scene: &Scene<'_>, least_db: f64) {
    let reference = render(scene, Options::default()).round::<P>();
    let measures = Measures::between(&reference, drawn, &scene.triangles());
    println!("{name}: {measures:?}");
    assert!(measures.psnr_db >= least_db && measures.wrong_owner <= 2 && measures.covered > 1000, "{name}: {measures:?}");

    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("goldens").join(name).with_extension("png");
    if env::var_os("BEAMSHADE_BLESS").is_some() {
        image::write(&path, drawn).unwrap();
    }
    let levels = |pixel: Rgb888| pixel.levels();
    let golden = image::read(&path).unwrap();
    let different = golden.color.iter().zip(&drawn.color).filter(|(golden, drawn)| levels(**golden) != drawn.levels()).count();
    assert_eq!((golden.width, golden.height), (drawn.width, drawn.height), "{name}");
    assert_eq!(different, 0, "pixels of {name} are not those of {}", path.display());
}

fn draw<P: Ink, S: Shade<1>>(scene: &Scene<'_>) -> Picture<P> {
    library::draw::<P, S, 1, beamshade::Light>(scene, &Meshes::of(scene).unwrap()).unwrap()
}

fn camera(near: f64) -> Camera {
    Camera {
        width: WIDTH,
        height: HEIGHT,
        focal: Camera::focal_length(HEIGHT, 40_f64.to_radians()),
        near,
        rotation: DMat3::IDENTITY,
        position: DVec3::new(0.0, 0.0, 2.45),
    }
}

/// The teapot of the standard scene, smaller.
fn teapot(mesh: &Mesh, material: Material) -> Scene<'_> {
    Scene { camera: camera(0.1), ..scenes::standard(mesh, material, FRAME) }
}

const BLUE: Material =
    Material { base: [0.1, 0.35, 0.8], highlight: [1.0, 0.9, 0.6], specular: 0.8, exponent: 12.0, ..scenes::ORANGE };

#[test]
fn the_teapot_by_each_method() {
    let mesh = scenes::teapot_880().unwrap();
    let scene = teapot(&mesh, scenes::ORANGE);
    check("teapot-duff-barycentric", &draw::<Rgb888, DuffBarycentric>(&scene), &scene, 60.0);
    check("teapot-gouraud", &draw::<Rgb888, Gouraud>(&scene), &scene, 29.0);
    check("teapot-flat", &draw::<Rgb888, Flat>(&scene), &scene, 27.0);
}

#[test]
fn the_teapot_in_sixteen_greys() {
    let mesh = scenes::teapot_880().unwrap();
    let scene = teapot(&mesh, scenes::WHITE);
    check("teapot-gray4", &draw::<Gray4, DuffBarycentric>(&scene), &scene, 40.0);
}

/// A ring around a ball, and another ball through the ring.
#[test]
fn three_objects_through_each_other() {
    let (ring, ball) = (shapes::torus(12), shapes::sphere(9));
    let pose = |tilt: f64, scale, translation: [f64; 3]| Pose {
        rotation: DMat3::from_rotation_z(0.3) * DMat3::from_rotation_x(tilt),
        scale,
        translation: translation.into(),
    };
    let object = |mesh, material, pose| Object { mesh, materials: vec![material], pose };
    let objects = vec![
        object(&ring, scenes::ORANGE, pose(0.6, 0.8, [-0.1, 0.0, 0.0])),
        object(&ball, BLUE, pose(0.0, 0.4, [-0.1, 0.05, 0.0])),
        object(&ball, BLUE, pose(1.0, 0.38, [0.5, -0.1, 0.25])),
    ];
    let scene = Scene { objects, ..teapot(&ring, scenes::ORANGE) };
    check("three-objects", &draw::<Rgb888, DuffBarycentric>(&scene), &scene, 57.0);
}

/// A bowl seen from inside and outside, its near part cut away.
#[test]
fn an_open_mesh_through_the_near_plane() {
    let bowl = shapes::bowl(8);
    let rotation = DMat3::from_rotation_x(0.35);
    let objects = vec![Object {
        mesh: &bowl,
        materials: vec![Material { double_sided: true, ..scenes::ORANGE }],
        pose: Pose { rotation, scale: 0.9, translation: DVec3::new(0.0, 0.15, 0.0) },
    }];
    let scene = Scene { camera: camera(1.75), objects, background: [0.05, 0.1, 0.15], ..teapot(&bowl, scenes::ORANGE) };
    check("open-bowl", &draw::<Rgb888, DuffBarycentric>(&scene), &scene, 60.0);
}

/// The sky behind the teapot and a line of text over it, as an application would draw them.
#[test]
fn a_gradient_and_an_overlay() {
    const TOP: [f64; 3] = [0.1, 0.3, 0.8];
    const BOTTOM: [f64; 3] = [0.9, 0.95, 1.0];
    const TEXT: Rgb888 = Rgb888::new(255, 240, 120);
    let mut overlay = Overlay::<36, 10, { buffer_size::<BinaryColor>(36, 10) }>::new(Point::new(2, 1));
    let style = MonoTextStyle::new(&FONT_6X10, BinaryColor::On);
    Text::with_baseline("60 fps", Point::zero(), style, Baseline::Top).draw(&mut overlay).unwrap();

    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/models/teapot-880.obj");
    let options = beamshade_mesh::Options { base: Some(scenes::ORANGE.base), ..Default::default() };
    let quantized = beamshade_mesh::Model::load(file, &options).unwrap().quantize().unwrap();
    let mesh = quantized.mesh();
    let camera = beamshade::Camera::new(Size::new(WIDTH as u32, HEIGHT as u32)).at_distance(2.45);
    let [top, bottom] = [TOP, BOTTOM].map(|[r, g, b]| Color::rgb(r as f32, g as f32, b as f32));
    let mut frame = Box::<Frame<'_, 512, 1024, HEIGHT>>::default();
    frame.background(Background::Gradient { top, bottom });
    frame.begin(&camera, &[beamshade::Light::directional([-0.5, 0.7, 0.6])]).unwrap();
    let pose = beamshade::Pose::turned(Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(6 * FRAME as i32)));
    frame.add(&mesh, &pose).unwrap();

    let mut scanner = Box::<Scanner<96>>::default();
    let mut lines = scanner.start(frame.picture());
    let mut picture = library::read(&mut lines);
    for (y, row) in picture.color.chunks_mut(WIDTH).enumerate() {
        overlay.blit(y as u16, row, TEXT);
    }
    let mut display = Framebuffer::<Rgb888, RawU24, BigEndian, WIDTH, HEIGHT, { buffer_size::<Rgb888>(WIDTH, HEIGHT) }>::new();
    lines.draw_finished(&mut [Rgb888::BLACK; WIDTH], &mut display, |y, row| overlay.blit(y, row, TEXT)).unwrap();
    let levels: Vec<_> = picture.color.iter().map(|pixel| pixel.levels()).collect();
    assert!(display.data() == levels.as_flattened(), "a display shows something else");

    for (pixel, owner) in picture.owner.iter().enumerate() {
        let down = (pixel / WIDTH) as f64 / (HEIGHT - 1) as f64;
        let sky = Rgb888::round([0, 1, 2].map(|i| TOP[i] + (BOTTOM[i] - TOP[i]) * down));
        let near = sky.levels().into_iter().zip(levels[pixel]).all(|(a, b)| a.abs_diff(b) <= 1);
        assert!(owner.is_some() || near || picture.color[pixel] == TEXT, "pixel {pixel}: {:?}, {sky:?}", picture.color[pixel]);
    }
    let teapot = scenes::teapot_880().unwrap();
    check("gradient-overlay", &picture, &self::teapot(&teapot, scenes::ORANGE), 60.0);
}
