//! What lines cost is known beforehand: bounds before they are resolved, counts after, and how far ahead they must be drawn.

use beamshade::{Baked, Camera, Frozen, Picture, Price, Scanner, Schedule, Work};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb565;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::cases;
use crate::scene::scenes;
use crate::visibility::soups;

/// A count that is larger than another one; pixels are one count, as their kinds are not known before.
fn larger(counts: Work, most: Work) -> Option<(&'static str, u32, u32)> {
    let merged = |work: Work| Work { pixels: pixels(work), pixels_1: 0, pixels_2: 0, pixels_3: 0, ..work };
    let all = Work::NAMES.iter().zip(merged(counts).counts()).zip(merged(most).counts());
    all.map(|((name, count), most)| (*name, count, most)).find(|(_, count, most)| count > most)
}

fn pixels(work: Work) -> u32 {
    work.pixels + work.pixels_1 + work.pixels_2 + work.pixels_3
}

/// Checks each line drawn, baked and frozen against what it has at most to do, and those two against each other.
fn check(picture: Picture<'_, '_>) {
    let size = picture.viewport().size;
    let mut row = vec![Rgb565::default(); size.width as usize];
    let mut frozen = Box::<Frozen<'_, 40000, 1000, 1024>>::default();
    let mut scanner = Box::<Scanner<256>>::default();
    frozen.take(scanner.start(picture));
    let mut lines = scanner.start(picture);
    for y in 0..size.height as u16 {
        let before = lines.walked();
        let line = lines.line(y, &mut row);
        assert_eq!(line.dropped, 0);
        let (walked, shaded, most) = (lines.walked() - before, frozen.work(y), picture.most(y));
        assert_eq!((walked.walked, walked.spans, walked.facets), (1, line.spans.into(), line.facets.into()));
        assert_eq!((shaded.runs, shaded.started, walked.runs), (line.spans.into(), line.spans.into(), 0));
        assert_eq!(pixels(shaded) + shaded.filled, size.width);
        assert_eq!(larger(walked + shaded, most), None, "line {y}");
        let exact = |work: Work| (work.stepped, work.turned, work.entered);
        assert_eq!(exact(walked), exact(most), "line {y}");
    }
    let mut baked = Box::<Baked<'_, 600>>::default();
    let mut lines = scanner.start(picture);
    let price = Price(Work::from([48; Work::COUNT]));
    for y in 0..size.height as u16 {
        let before = lines.walked();
        lines.bake(y, &mut baked);
        assert_eq!(larger(lines.walked() - before, picture.most(y)), None, "line {y}");
        let shaded = frozen.work(y);
        assert_eq!(baked.work(), Work { gradients: 0, started: 0, ..shaded });
        assert!(baked.cost(&price) <= frozen.cost(y, &price) && frozen.cost(y, &price) <= picture.bound(y, &price));
    }
    assert_eq!(frozen.costs(&price).count(), size.height as usize);
    assert_eq!(picture.bounds(&price).last(), (size.height as u16).checked_sub(1).map(|last| picture.bound(last, &price)));
    assert_eq!((picture.most(size.height as u16), frozen.work(size.height as u16)), (Work::NONE, Work::NONE));
}

/// Whether no line is late with so many ahead: a beam that sends a line each period, and a drawer, one unit of time after another.
fn keeps(costs: &[u32], period: u32, ahead: usize) -> bool {
    // Lines that are ready, and what was done of the next one.
    let (mut ready, mut done) = (ahead.min(costs.len()), 0);
    let finish = |ready: &mut usize, done: &mut u32, sent: usize| {
        // A row is free for a line that many below the one that goes out.
        while *ready < costs.len() && *ready <= sent + ahead && *done == costs[*ready] {
            (*ready, *done) = (*ready + 1, 0);
        }
    };
    for sent in 0..costs.len() {
        if ready <= sent && ahead == 0 {
            finish(&mut ready, &mut done, sent);
        }
        if ready <= sent {
            return false;
        }
        for _ in 0..period {
            finish(&mut ready, &mut done, sent);
            if ready < costs.len() && ready <= sent + ahead {
                done += 1;
            }
            finish(&mut ready, &mut done, sent);
        }
    }
    true
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn no_line_has_more_to_do_than_was_known(scene in scenes::<1>(), (soup, _) in soups()) {
        scene.show(check);
        soup.show(check);
    }

    /// Where all that there is begins on the same few pixels.
    #[test]
    fn nor_where_many_begin_at_once(scenes in vec(soups(), 12), width in 1..=3_u32) {
        let (mut scene, _) = scenes[0].clone();
        scene.objects = scenes.into_iter().flat_map(|(scene, _)| scene.objects).take(8).collect();
        scene.camera = Camera::new(Size::new(width, 20)).at_distance(3.0);
        scene.show(check);
    }

    #[test]
    fn the_look_ahead_is_the_smallest_that_keeps_the_period(costs in vec(0..300_u32, 0..40), period in 1..200_u32) {
        let schedule = Schedule::new(costs.iter().copied(), period);
        prop_assert_eq!(schedule.worst, costs.iter().copied().max().unwrap_or(0));
        let total: u32 = costs.iter().sum();
        prop_assert_eq!(schedule.total, u64::from(total));
        prop_assert_eq!(schedule.slack, costs.len() as i64 * i64::from(period) - i64::from(total));
        let least = (0..=costs.len()).find(|ahead| keeps(&costs, period, *ahead));
        prop_assert_eq!(Some(schedule.look_ahead as usize), least);
    }
}

#[test]
fn a_cost_beyond_all_numbers_is_the_largest() {
    let price = Price(Work { pixels: 1 << 20, ..Work::NONE });
    assert_eq!(price.of(Work { pixels: 4095, ..Work::NONE }), 4095 << 16);
    assert_eq!(price.of(Work { pixels: 4096, ..Work::NONE }), u32::MAX >> 4);
    // Rounded up.
    assert_eq!(Price(Work { pixels: 1, ..Work::NONE }).of(Work { pixels: 17, ..Work::NONE }), 2);
}
