//! Pixel encodings, displays, overlays, backgrounds and turned panels.

use std::convert::Infallible;

use beamshade::{Background, Camera, DuffBarycentric, Ink, Light, Overlay, Scanner};
use embedded_graphics::framebuffer::buffer_size;
use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Gray8, GrayColor, IntoStorage, Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use host_tests::library::read;
use host_tests::{Format, Measures, Picture};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::cases;
use crate::scene::{colors, scenes, Scene};
use crate::visibility::soups;

/// A display that takes whole pictures only.
#[derive(Default)]
struct Panel(Vec<(Rectangle, Vec<Rgb565>)>);

impl DrawTarget for Panel {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, _: I) -> Result<(), Infallible> {
        panic!("pixels one by one")
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb565>>(&mut self, area: &Rectangle, colors: I) -> Result<(), Infallible> {
        self.0.push((*area, colors.into_iter().collect()));
        Ok(())
    }
}

impl OriginDimensions for Panel {
    fn size(&self) -> Size {
        Size::new_equal(u32::MAX)
    }
}

fn drawn<P: Ink>(scene: &Scene) -> Picture<P> {
    scene.show(|picture| read::<P, DuffBarycentric, 256, 1, _>(&mut Scanner::new().start(picture)))
}

/// Random scenes that fill all of their pixels.
pub(crate) fn filled() -> impl Strategy<Value = Scene> {
    (scenes(), colors(), colors()).prop_map(|(scene, top, bottom)| match scene.background {
        Background::Keep => Scene { background: Background::Gradient { top, bottom }, ..scene },
        _ => scene,
    })
}

proptest! {
    #![proptest_config(cases(512))]

    #[test]
    fn a_display_gets_all_pixels_at_once(scene in filled(), x in any::<i16>(), y in any::<i16>(), short in 0usize..400) {
        let place = Point::new(x.into(), y.into());
        let scene = Scene { camera: scene.camera.placed_at(place), ..scene };
        let expected = drawn::<Rgb565>(&scene);
        let size = scene.camera.viewport().size;
        scene.show(|picture| {
            let mut scanner = Box::<Scanner<256>>::default();
            let mut panel = Panel::default();
            let mut lines = scanner.start(picture);
            lines.draw(&mut [Rgb565::default(); 1024], &mut panel).unwrap();
            lines.draw(&mut vec![Rgb565::default(); short], &mut panel).unwrap();
            let width = short.min(expected.width);
            let cut = expected.color.chunks(expected.width).flat_map(|row| row[..width].to_vec()).collect();
            let area = Rectangle::new(place, Size::new(width as u32, size.height));
            assert!(panel.0 == [(Rectangle::new(place, size), expected.color), (area, cut)]);
        });
    }

    #[test]
    fn an_overlay_changes_its_pixels_only(
        row in vec(any::<u32>(), 0..40), on in vec(any::<bool>(), 17 * 5), x in -20..40i32, y in -6..12i32, line in 0..12u16,
    ) {
        let at = Point::new(x, y);
        let mut overlay = Overlay::<17, 5, { buffer_size::<BinaryColor>(17, 5) }>::new(at);
        overlay.fill_contiguous(&overlay.bounding_box(), on.iter().copied().map(BinaryColor::from)).unwrap();
        let mut after = row.clone();
        overlay.blit(line, &mut after, 7);
        for (x, (before, after)) in row.into_iter().zip(after).enumerate() {
            let there = Point::new(x as i32, line.into()) - at;
            let touched = overlay.bounding_box().contains(there) && on[(there.y * 17 + there.x) as usize];
            assert_eq!(after, if touched { 7 } else { before }, "{x}");
        }
    }

    #[test]
    fn the_last_hand_is_on_every_row(scene in filled()) {
        let mut expected = drawn::<Rgb565>(&scene);
        for (y, row) in expected.color.chunks_mut(expected.width).enumerate() {
            row[y % row.len()] = Rgb565::new(1, 2, 3);
        }
        scene.show(|picture| {
            let mut panel = Panel::default();
            let mut row = vec![Rgb565::default(); expected.width];
            let finish = |y: u16, row: &mut [Rgb565]| row[usize::from(y) % row.len()] = Rgb565::new(1, 2, 3);
            Scanner::<256>::new().start(picture).draw_finished(&mut row, &mut panel, finish).unwrap();
            assert!(panel.0[0].1 == expected.color);
        });
    }

    #[test]
    fn a_gradient_runs_from_the_first_line_to_the_last(top in colors(), bottom in colors(), height in 1u32..300) {
        let camera = Camera::new(Size::new(1, height));
        let background = Background::Gradient { top, bottom };
        let scene = Scene { camera, lights: [Light::OFF], background, objects: vec![] };
        for (y, color) in drawn::<Rgb888>(&scene).color.into_iter().enumerate() {
            let down = y as f64 / f64::from(height - 1).max(1.0);
            let between = |i: usize| (f64::from(top.0[i]) * (1.0 - down) + f64::from(bottom.0[i]) * down) / 32768.0;
            for (level, exact) in color.levels().into_iter().zip([0, 1, 2].map(between)) {
                prop_assert!((f64::from(level) - 255.0 * exact).abs() <= 0.51, "{} {} {}", y, level, 255.0 * exact);
            }
        }
    }

    #[test]
    fn numbers_and_swapped_bytes_are_the_same_pixels(scene in scenes::<1>()) {
        let numbers = drawn::<Rgb565>(&scene).map(|pixel| pixel.into_storage());
        prop_assert!(numbers == drawn::<u16>(&scene));
        let swapped = drawn::<Rgb565>(&scene).map(|pixel| pixel.into_storage().to_be_bytes());
        prop_assert!(swapped == drawn::<[u8; 2]>(&scene));
    }

    /// Both are rounded once from the same light: half a step of each apart, and what their coefficients lose.
    #[test]
    fn four_bits_of_grey_are_eight_bits_rounded(scene in scenes::<1>()) {
        let (four, eight) = (drawn::<Gray4>(&scene), drawn::<Gray8>(&scene));
        for (four, eight) in four.color.iter().zip(eight.color) {
            prop_assert!((17 * i32::from(four.luma())).abs_diff(eight.luma().into()) <= 9, "{:?} {:?}", four, eight);
        }
    }

    /// But for centres exactly on edges, and colours rounded the other way.
    #[test]
    fn a_turned_panel_shows_the_turned_picture((scene, _) in soups(), side in 1usize..100, quarters in 1u8..=7) {
        let camera = Camera::new(Size::new_equal(side as u32));
        let lights = [Light::directional([0.3, 0.5, 0.8])];
        let turned = |quarters| drawn::<Rgb888>(&Scene { camera: camera.panel_turned(quarters), lights, ..scene.clone() });
        let (upright, mut panel) = (turned(0), turned(quarters));
        for _ in 0..quarters % 4 {
            // A quarter counter-clockwise: what was to the right is above.
            let from = |i: usize| (i % side) * side + (side - 1 - i / side);
            panel.color = (0..side * side).map(|i| panel.color[from(i)]).collect();
            panel.owner = (0..side * side).map(|i| panel.owner[from(i)]).collect();
        }
        let triangles = scene.triangles();
        let measures = Measures::between(&upright, &panel, &triangles.iter().map(Vec::as_slice).collect::<Vec<_>>());
        prop_assert!(measures.wrong_owner <= 4.max(measures.covered / 100), "{:?}", measures);
        prop_assert!(measures.psnr_db >= 44.0 || measures.covered < 100, "{:?}", measures);
    }
}
