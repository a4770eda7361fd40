//! The turning teapot on a desktop: `cargo run --example desktop` writes `target/desktop.png`.

use beamshade::{Camera, DuffBarycentric, Frame, Light, Pose, Rotation, Scanner, Turn};
use beamshade_mesh::{Model, Options};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};

/// How triangles are shaded: any other method, such as `beamshade::Gouraud`, goes here; docs/shading.md compares them.
type Method = DuffBarycentric;

/// The width and the height of one picture.
const SIDE: usize = 240;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // On a microcontroller the mesh is in flash: a build script makes it of the same file, see beamshade-mesh.
    let options = Options { base: Some([0.85, 0.45, 0.20]), ..Options::default() };
    let model = Model::load(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/teapot-880.obj"), &options)?.quantize()?;
    let teapot = model.mesh();

    // All the memory that rendering takes. `cargo demo` tells how much a model needs.
    let mut frame = Frame::<512, 320, SIDE>::new(); // vertices, triangles or pairs that face the eye, lines
    let mut scanner = Scanner::<48, Method>::new(); // triangles or pairs that cross one line
    let mut row = [Rgb565::BLACK; SIDE];

    // Any DrawTarget will do. This one is wide enough for four pictures side by side.
    let mut display = SimulatorDisplay::<Rgb565>::new(Size::new(4 * SIDE as u32, SIDE as u32));
    let light = Light::directional([-0.5, 0.7, 0.6]);
    let camera = Camera::new(Size::new_equal(SIDE as u32)).field_of_view(Turn::degrees(40)).at_distance(2.7);
    for step in 0..4 {
        let camera = camera.placed_at(Point::new(step * SIDE as i32, 0));
        let pose = Pose::turned(Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(40 * step)));
        frame.begin(&camera, &[light])?;
        frame.add(&teapot, &pose)?;
        scanner.start(frame.picture()).draw(&mut row, &mut display)?;
    }

    std::fs::create_dir_all("target")?;
    display.to_rgb_output_image(&OutputSettings::default()).save_png("target/desktop.png")?;
    println!("target/desktop.png: the teapot in four poses");
    Ok(())
}
