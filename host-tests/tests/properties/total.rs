//! No panic, whatever the input; tests are compiled with checks for overflow.

use beamshade::{Choose, DuffBarycentric, Flat, Frame, Gouraud, Scanner, Shade};
use embedded_graphics::pixelcolor::Rgb565;
use proptest::prelude::*;

use crate::cases;
use crate::scene::{scenes, Scene};

/// Draws everything there is in a frame and a scanner of that room.
fn draw<
    S: Shade<LIGHTS>,
    const LIGHTS: usize,
    const V: usize,
    const T: usize,
    const L: usize,
    const O: usize,
    const M: usize,
    const ACTIVE: usize,
>(
    scene: &Scene<LIGHTS>,
) {
    let meshes = scene.meshes();
    let mut frame = Box::<Frame<'_, V, T, L, LIGHTS, O, M>>::default();
    scene.fill(&meshes, &mut frame);
    let mut scanner = Box::<Scanner<ACTIVE, S, LIGHTS>>::default();
    let mut lines = scanner.start(frame.picture());
    let mut row = [Rgb565::new(0, 0, 0); 1024];
    for y in 0..=lines.viewport().size.height as u16 {
        lines.line(y, &mut row);
    }
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn one_light(scene in scenes::<1>()) {
        draw::<DuffBarycentric, 1, 128, 256, 1024, 4, 512, 128>(&scene);
        draw::<Gouraud, 1, 128, 256, 1024, 4, 512, 128>(&scene);
        draw::<Flat, 1, 128, 256, 1024, 4, 512, 128>(&scene);
        draw::<Choose<DuffBarycentric, Choose<Gouraud, Flat>>, 1, 40, 20, 100, 2, 6, 5>(&scene);
    }

    #[test]
    fn four_lights(scene in scenes::<4>()) {
        draw::<DuffBarycentric, 4, 128, 256, 1024, 4, 512, 128>(&scene);
        draw::<Gouraud, 4, 128, 256, 1024, 4, 512, 128>(&scene);
        draw::<Flat, 4, 128, 256, 1024, 4, 512, 128>(&scene);
    }
}
