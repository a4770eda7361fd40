//! What a line may touch, and that its pixels depend on the scene alone.

use std::cell::Cell;
use std::ops::Range;

use beamshade::{
    AngularTriangle, Background, Choose, Color, DuffBarycentric, Flat, Frame, Gouraud, Ink, Intensity, Line, LinearAngle, Lines,
    Material, Paint, Scanner, Shade,
};
use embedded_graphics::pixelcolor::Rgb565;
use host_tests::library;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;

use crate::cases;
use crate::scene::{scenes, Scene};

/// A pixel that knows how many had been shaded when its value was made, itself included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Made {
    Never,
    Plain(u32),
    Shaded(u32),
}

thread_local! {
    static SHADED: Cell<u32> = const { Cell::new(0) };
    static FILLS: Cell<usize> = const { Cell::new(0) };
}

impl Ink for Made {
    type Paint<'m> = ();

    fn paint(_: &Material) {}

    fn plain(_: Color) -> Self {
        FILLS.set(FILLS.get() + 1);
        Self::Plain(SHADED.get())
    }
}

impl Paint<Made> for () {
    fn mix(&self, _: Intensity) -> Made {
        SHADED.set(SHADED.get() + 1);
        Made::Shaded(SHADED.get())
    }
}

/// The spans of a line.
fn spans<S: Shade<LIGHTS>, const ACTIVE: usize, const LIGHTS: usize>(
    lines: &mut Lines<'_, '_, ACTIVE, S, LIGHTS>,
    y: u16,
) -> Vec<Range<usize>> {
    let mut spans = Vec::new();
    lines.spans(y, |span, _| spans.push(span.start.into()..span.end.into()));
    spans
}

/// Draws lines of a picture in that order and compares them with those drawn from top to bottom.
fn same_in_any_order<S: Shade<1>, const ACTIVE: usize>(scene: &Scene, order: &[Index]) {
    scene.show(|picture| {
        let mut scanner = Box::<Scanner<ACTIVE, S>>::default();
        let mut lines = scanner.start(picture);
        let size = picture.viewport().size;
        let draw = |lines: &mut Lines<'_, '_, ACTIVE, S>, y| {
            let mut row = vec![Rgb565::new(1, 2, 3); size.width as usize];
            let Line { active, spans, dropped, .. } = lines.line(y, &mut row);
            (row, active, spans, dropped)
        };
        let expected: Vec<_> = (0..size.height as u16).map(|y| draw(&mut lines, y)).collect();
        for y in order {
            let y = y.index(expected.len());
            assert_eq!(draw(&mut lines, y as u16), expected[y], "line {y}");
        }
    });
}

proptest! {
    #![proptest_config(cases(512))]

    #[test]
    fn each_pixel_is_stored_once_from_left_to_right(scene in scenes::<1>(), longer in 0..3usize) {
        scene.show(|picture| {
            let size = picture.viewport().size;
            let width = size.width as usize;
            let mut scanner = Box::<Scanner<256>>::default();
            let mut lines = scanner.start(picture);
            for y in 0..size.height as u16 {
                let mut row = vec![Made::Never; width + longer];
                SHADED.set(0);
                FILLS.set(0);
                let line = lines.line(y, &mut row);
                let spans = spans(&mut lines, y);

                let (inside, beyond) = row.split_at(width);
                assert_eq!(beyond, vec![Made::Never; longer]);
                assert!(spans.iter().all(|span| span.start < span.end && span.end <= width), "{spans:?}");
                assert!(spans.windows(2).all(|pair| pair[0].end <= pair[1].start), "{spans:?}");
                assert_eq!(usize::from(line.spans), spans.len());
                // Each value was made after all those to the left of it, and before all those to the right.
                let mut shaded = 0;
                for (x, pixel) in inside.iter().enumerate() {
                    let expected = if spans.iter().any(|span| span.contains(&x)) {
                        shaded += 1;
                        Made::Shaded(shaded)
                    } else if scene.background == Background::Keep {
                        Made::Never
                    } else {
                        Made::Plain(shaded)
                    };
                    assert_eq!(*pixel, expected, "{x}");
                }
                assert_eq!(SHADED.get(), shaded, "something shaded was stored over");
                let gaps = inside.chunk_by(|a, b| a == b).filter(|run| matches!(run, [Made::Plain(_), ..])).count();
                assert_eq!(FILLS.get(), gaps, "some background was stored over");
            }
        });
    }

    #[test]
    fn a_shorter_row_gets_the_same_pixels(scene in scenes::<1>(), short in any::<Index>()) {
        scene.show(|picture| {
            let size = picture.viewport().size;
            let whole = library::read::<Rgb565, DuffBarycentric, 256, 1, beamshade::Light>(&mut Scanner::new().start(picture));
            let mut scanner = Box::<Scanner<256>>::default();
            let mut lines = scanner.start(picture);
            for (y, expected) in whole.color.chunks(whole.width).enumerate() {
                let mut row = vec![Rgb565::default(); short.index(size.width as usize)];
                lines.line(y as u16, &mut row);
                assert_eq!(row, expected[..row.len()]);
            }
            let mut below = [Rgb565::new(1, 2, 3); 4];
            let line = lines.line(size.height as u16, &mut below);
            assert_eq!((below, line.active, line.spans), ([Rgb565::new(1, 2, 3); 4], 0, 0));
        });
    }

    #[test]
    fn any_order_of_lines_gives_the_same_pixels(scene in scenes::<1>(), order in vec(any::<Index>(), 1..30)) {
        same_in_any_order::<DuffBarycentric, 256>(&scene, &order);
        same_in_any_order::<Choose<Gouraud, Flat>, 256>(&scene, &order);
        same_in_any_order::<LinearAngle, 256>(&scene, &order);
        same_in_any_order::<AngularTriangle, 256>(&scene, &order);
        same_in_any_order::<DuffBarycentric, 5>(&scene, &order);
    }

    #[test]
    fn what_was_drawn_before_leaves_no_trace(before in scenes::<2>(), scene in scenes::<2>(), stop in any::<Index>()) {
        type Drawn = Choose<DuffBarycentric, Gouraud>;
        let [old, new] = [before.meshes(), scene.meshes()];
        let mut fresh = Box::<Frame<'_, 256, 256, 256, 2, 8, 64>>::default();
        let mut frame = fresh.clone();
        let expected = (scene.fill(&new, &mut fresh), {
            library::read::<Rgb565, Drawn, 64, 2, beamshade::Light>(&mut Scanner::new().start(fresh.picture()))
        });

        let mut scanner = Box::<Scanner<64, Drawn, 2>>::default();
        before.fill(&old, &mut frame);
        let mut lines = scanner.start(frame.picture());
        for y in 0..stop.index(256) {
            lines.line(y as u16, &mut [Rgb565::default(); 100]);
        }
        for _ in 0..2 {
            let room = scene.fill(&new, &mut frame);
            let drawn = library::read(&mut scanner.start(frame.picture()));
            assert!((room, drawn) == expected);
        }
    }
}
