//! Span tables ahead of the beam: baked lines and frozen pictures give the rows that a scanner gives, wherever they are shaded.

use std::thread;

use beamshade::{Baked, DuffBarycentric, Frame, Frozen, Gouraud, GouraudPhong, LinearAngle, Picture, Scanner, Shade};
use embedded_graphics::pixelcolor::Rgb565;
use heapless::spsc::Queue;
use host_tests::{library, Owner};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;

use crate::cases;
use crate::scene::{scenes, Scene};

/// What a row holds before.
const BEFORE: Rgb565 = Rgb565::new(1, 2, 3);

/// The rows of a picture, from top to bottom.
fn rows<S: Shade<1>>(picture: Picture<'_, '_>) -> Vec<Vec<Rgb565>> {
    let size = picture.viewport().size;
    let mut scanner = Box::<Scanner<256, S>>::default();
    let mut lines = scanner.start(picture);
    (0..size.height as u16)
        .map(|y| {
            let mut row = vec![BEFORE; size.width as usize];
            lines.line(y, &mut row);
            row
        })
        .collect()
}

/// A row of that length, shaded.
fn row(length: usize, shade: impl FnOnce(&mut [Rgb565])) -> Vec<Rgb565> {
    let mut row = vec![BEFORE; length];
    shade(&mut row);
    row
}

/// Draws lines in that order from tables of both kinds.
fn same_from_tables<S: Shade<1>>(scene: &Scene, order: &[Index]) {
    scene.show(|picture| {
        let expected = rows::<S>(picture);
        let width = picture.viewport().size.width as usize;
        let mut scanner = Box::<Scanner<256, S>>::default();

        let mut lines = scanner.start(picture);
        let mut tables = Vec::new();
        for y in 0..expected.len() as u16 {
            let mut table = Box::<Baked<'_, 600, S>>::default();
            let counts = lines.bake(y, &mut table);
            assert_eq!((table.y(), table.counts(), counts.left_out), (y, counts, 0));
            tables.push(table);
        }
        // In the middle of a picture, with facets set up.
        let mut frozen = Box::<Frozen<'_, 40000, 1000, 1024, S>>::default();
        let sums = frozen.take(lines);
        assert_eq!((usize::from(frozen.lines()), sums.left_out), (expected.len(), 0));
        assert_eq!(sums.spans, tables.iter().map(|table| table.counts().spans).sum::<u16>());
        for y in order {
            let y = y.index(expected.len());
            assert_eq!(row(width, |row| tables[y].shade(row)), expected[y], "baked line {y}");
            assert_eq!(row(width, |row| frozen.line(y as u16, row)), expected[y], "frozen line {y}");
            assert_eq!(row(width / 2, |row| tables[y].shade(row)), expected[y][..width / 2], "half a row of {y}");
            assert_eq!(row(width / 2, |row| frozen.line(y as u16, row)), expected[y][..width / 2], "half a row of {y}");
        }
        assert_eq!(row(width, |row| frozen.line(expected.len() as u16, row)), [BEFORE].repeat(width));
    });
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn tables_give_the_rows_that_a_scanner_gives(scene in scenes::<1>(), order in vec(any::<Index>(), 1..30)) {
        same_from_tables::<DuffBarycentric>(&scene, &order);
        same_from_tables::<GouraudPhong>(&scene, &order);
        same_from_tables::<LinearAngle>(&scene, &order);
    }

    #[test]
    fn what_is_picked_is_what_is_seen(scene in scenes::<1>()) {
        scene.show(|picture| {
            let mut scanner = Box::<Scanner<256>>::default();
            let seen = library::read::<Rgb565, _, 256, 1, _>(&mut scanner.start(picture));
            let mut frozen = Box::<Frozen<'_, 40000, 1000, 1024>>::default();
            frozen.take(scanner.start(picture));
            for (pixel, owner) in seen.owner.iter().enumerate() {
                let (x, y) = (pixel % seen.width, pixel / seen.width);
                let picked = frozen.pick(x as u16, y as u16);
                let picked = picked.map(|source| Owner { object: source.object.into(), triangle: source.triangle.into() });
                assert_eq!(picked, *owner, "({x}, {y})");
            }
            assert_eq!(frozen.pick(seen.width as u16, 0), None);
            assert_eq!(frozen.pick(0, seen.height as u16), None);
        });
    }

    #[test]
    fn what_a_table_has_no_room_for_is_counted(scene in scenes::<1>()) {
        scene.show(|picture| {
            let width = picture.viewport().size.width as usize;
            let mut scanner = Box::<Scanner<256>>::default();
            let mut lines = scanner.start(picture);
            let mut whole = Vec::new();
            for y in 0..picture.viewport().size.height as u16 {
                let mut table = Baked::<'_, 3>::default();
                let full = lines.line(y, &mut vec![BEFORE; width]);
                let counts = lines.bake(y, &mut table);
                assert_eq!((counts.spans + counts.left_out, counts.spans.min(3)), (full.spans, counts.spans));
                whole.push(full.spans);
            }
            let wanted: u16 = whole.iter().sum();

            // Few spans; few facets.
            let few_spans = Frozen::<'_, 20, 1000, 1024>::new().take(scanner.start(picture));
            assert_eq!((few_spans.spans, few_spans.left_out), (wanted.min(20), wanted.saturating_sub(20)));
            let few_facets = Frozen::<'_, 40000, 4, 1024>::new().take(scanner.start(picture));
            assert_eq!(few_facets.spans + few_facets.left_out, wanted);
            assert_eq!(few_facets.left_out > 0, few_facets.facets > 4);

            // Fewer lines than the picture has.
            let mut short = Box::new(Frozen::<'_, 40000, 1000, 7>::new());
            let sums = short.take(scanner.start(picture));
            assert_eq!(sums.spans, whole.iter().take(7).sum::<u16>());
            assert_eq!(usize::from(short.lines()), whole.len().min(7));

            // More lines than numbers of 16 bits count.
            let mut long = Box::<Frozen<'_, 40000, 1000, 0x1_0000>>::default();
            assert_eq!(long.take(scanner.start(picture)).spans, wanted);
            assert_eq!(usize::from(long.lines()), whole.len());
        });
    }
}

/// A few scenes, one after the other.
fn some_scenes() -> Vec<Scene> {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::new(cases(0));
    (0..40).map(|_| scenes::<1>().new_tree(&mut runner).unwrap().current()).collect()
}

/// A ring of tables between two threads, one that bakes and one that shades, neither waiting for the other but for a table.
#[test]
fn tables_shaded_on_another_thread_give_the_same_rows() {
    for scene in some_scenes() {
        scene.show(|picture| {
            let expected = rows::<DuffBarycentric>(picture);
            let width = picture.viewport().size.width as usize;
            let mut tables: [Baked<'_, 600>; 4] = Default::default();
            let (mut ready, mut free) = (Queue::<&mut Baked<'_, 600>, 5>::new(), Queue::<&mut Baked<'_, 600>, 5>::new());
            let ((mut give, mut take), (mut give_back, mut take_back)) = (ready.split(), free.split());
            for table in &mut tables {
                assert!(give_back.enqueue(table).is_ok());
            }
            let height = expected.len() as u16;
            let drawn = thread::scope(|scope| {
                scope.spawn(move || {
                    let mut scanner = Box::<Scanner<256>>::default();
                    let mut lines = scanner.start(picture);
                    for y in 0..height {
                        let table = loop {
                            match take_back.dequeue() {
                                Some(table) => break table,
                                None => thread::yield_now(),
                            }
                        };
                        lines.bake(y, table);
                        assert!(give.enqueue(table).is_ok());
                    }
                });
                let mut drawn = Vec::new();
                while drawn.len() < expected.len() {
                    let Some(table) = take.dequeue() else {
                        thread::yield_now();
                        continue;
                    };
                    assert_eq!(usize::from(table.y()), drawn.len());
                    drawn.push(row(width, |row| table.shade(row)));
                    assert!(give_back.enqueue(table).is_ok());
                }
                drawn
            });
            assert_eq!(drawn, expected);
        });
    }
}

/// Frozen pictures change places between two threads: one makes frame n + 1 in the same frame memory while the other shows n.
#[test]
fn a_picture_is_shown_whole_while_the_next_is_made() {
    let scenes = some_scenes();
    let meshes: Vec<_> = scenes.iter().map(Scene::meshes).collect();
    let expected: Vec<_> = scenes.iter().map(|scene| scene.show(rows::<Gouraud>)).collect();
    type Shown<'m> = Frozen<'m, 40000, 1000, 1024, Gouraud>;
    let mut pictures = [Box::<Shown<'_>>::default(), Box::<Shown<'_>>::default()];
    let (mut ready, mut free) = (Queue::<&mut Shown<'_>, 3>::new(), Queue::<&mut Shown<'_>, 3>::new());
    let ((mut give, mut take), (mut give_back, mut take_back)) = (ready.split(), free.split());
    for picture in &mut pictures {
        assert!(give_back.enqueue(picture).is_ok());
    }
    thread::scope(|scope| {
        scope.spawn(|| {
            let mut frame = Box::<Frame<'_, 2048, 1024, 1024, 1, 8, 1024>>::default();
            let mut scanner = Box::<Scanner<256, Gouraud>>::default();
            for (scene, meshes) in scenes.iter().zip(&meshes) {
                scene.fill(meshes, &mut frame);
                let picture = loop {
                    match take_back.dequeue() {
                        Some(picture) => break picture,
                        None => thread::yield_now(),
                    }
                };
                picture.take(scanner.start(frame.picture()));
                assert!(give.enqueue(picture).is_ok());
            }
        });
        // Refreshes: the last picture again, until the next one is there.
        let (mut shown, mut number): (Option<&mut Shown<'_>>, usize) = (None, 0);
        while number < expected.len() || shown.is_some() {
            if let Some(next) = take.dequeue() {
                number += 1;
                if let Some(last) = shown.replace(next) {
                    assert!(give_back.enqueue(last).is_ok());
                }
            }
            let Some(picture) = &shown else {
                thread::yield_now();
                continue;
            };
            for (y, expected) in expected[number - 1].iter().enumerate() {
                assert_eq!(row(expected.len(), |row| picture.line(y as u16, row)), *expected, "line {y} of picture {number}");
            }
            if number == expected.len() {
                break;
            }
        }
    });
}
