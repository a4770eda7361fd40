//! The standard scene T880, stage by stage, as the benches run it.

use beamshade::{Camera, Frame, Light, Pose, Rotation, Scanner, Shade, Turn};
use beamshade_mesh::{Model, Options, Quantized};
use embedded_graphics::{geometry::Size, pixelcolor::Rgb565, prelude::RgbColor};
use std::path::Path;

/// Room for the teapot in any pose.
pub(crate) type Filled<'m> = Frame<'m, 512, 512, 240>;

/// The teapot.
pub(crate) fn teapot() -> Quantized {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/models/teapot-880.obj");
    let orange = Options { base: Some([0.85, 0.45, 0.20]), ..Options::default() };
    Model::load(file, &orange).and_then(|model| model.quantize()).expect("the model is a teapot")
}

/// First stage, once a frame: vertices, lights, culling, buckets.
pub(crate) fn prepare<'m>(mesh: &'m beamshade::Mesh<'m>, frame: &mut Filled<'m>) {
    let camera = Camera::new(Size::new(240, 240)).field_of_view(Turn::degrees(40)).at_distance(2.45);
    let pose = Pose::turned(Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(42)));
    frame.begin(&camera, &[Light::directional([-0.5, 0.7, 0.6])]).and_then(|()| frame.add(mesh, &pose)).expect("there is room");
}

/// Second stage, of every line: edges, and who is seen where. The number of spans.
pub(crate) fn resolve(frame: &Filled<'_>, scanner: &mut Scanner<96, beamshade::Flat>) -> usize {
    let mut lines = scanner.start(frame.picture());
    let mut spans = 0;
    (0..240).for_each(|y| lines.spans(y, |_, _| spans += 1));
    spans
}

/// The second stage and all others, of every line: set-up of facets, shading, the ink.
pub(crate) fn shade<S: Shade<1>>(frame: &Filled<'_>, scanner: &mut Scanner<96, S>) -> [Rgb565; 240] {
    let mut row = [Rgb565::BLACK; 240];
    let mut lines = scanner.start(frame.picture());
    for y in 0..240 {
        lines.line(y, &mut row);
    }
    row
}
