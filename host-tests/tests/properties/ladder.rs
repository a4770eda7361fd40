//! Degraded lines keep the period, by the bound; what was degraded is counted.

use beamshade::{Baked, Degrading, DuffBarycentric, Frozen, Picture, Plan, Price, Scanner, Work};
use embedded_graphics::pixelcolor::{Gray8, Rgb565, RgbColor};
use host_tests::library::read;
use proptest::prelude::*;

use crate::cases;
use crate::scene::scenes;
use crate::visibility::soups;

/// Prices of a ladder, not in order for everything, as those of real methods need not be.
const PRICES: [Price; 4] = {
    const fn price(facets: u32, started: u32, pixels: [u32; 2]) -> Price {
        let [pixels, pixels_1] = pixels;
        let own = Work { facets, started, runs: 90, pixels, pixels_1, pixels_2: pixels, pixels_3: pixels_1, ..Work::NONE };
        Price(Work { walked: 500, active: 90, fronts: 300, compared: 200, deepened: 700, lines: 100, filled: 3, ..own })
    }
    [price(1500, 200, [40, 90]), price(1900, 210, [35, 60]), price(900, 120, [50, 50]), price(400, 60, [10, 10])]
};

/// Checks plans of a picture against what it takes to draw it as planned.
fn check(picture: Picture<'_, '_>, part: u32) {
    let height = picture.viewport().size.height as usize;
    let mut scanner = Box::<Scanner<256, Degrading>>::default();
    let (mut all, mut flat, mut plan) = (Plan::<1024>::new(), Plan::<1024>::new(), Plan::<1024>::new());
    all.make(scanner.start(picture), &PRICES[..1], u32::MAX);
    flat.make(scanner.start(picture), &PRICES, 0);
    assert!((0..).zip(all.bounds()).all(|(y, bound)| *bound <= picture.bound(y, &PRICES[0])));
    assert_eq!((all.bounds().len(), flat.bounds().len(), all.late()), (height, height, 0));

    // Between what the dearest line takes and what all flat ones do.
    let [most, least] = [&all, &flat].map(|plan| plan.bounds().iter().copied().max().unwrap_or(0));
    let period = least.min(most) + (most.abs_diff(least) / 16) * part;
    plan.make(scanner.start(picture), &PRICES, period);
    for ((bound, flat), step) in plan.bounds().iter().zip(flat.bounds()).zip(plan.steps()) {
        assert!(*bound <= period || *step == 6, "{bound} at step {step}");
        assert!(*bound <= period || *flat > period, "flat alone fits");
    }
    assert_eq!(usize::from(plan.late()), plan.bounds().iter().filter(|bound| **bound > period).count());

    let degraded = plan.degrade(picture);
    let mut frozen = Box::<Frozen<'_, 40000, 1000, 1024, Degrading>>::default();
    frozen.take(scanner.start(degraded));
    let mut lines = scanner.start(degraded);
    let mut row = vec![Rgb565::default(); picture.viewport().size.width as usize];
    let mut facets = [0; 4];
    for (y, bound) in (0..).zip(plan.bounds()) {
        let (before, made) = (lines.walked(), lines.degraded());
        let line = lines.line(y, &mut row);
        let walked = lines.walked() - before;
        // Facets set up on each rung; the rest were on the first.
        let counts = [0, 1, 2].map(|rung| u32::from(lines.degraded().0[rung] - made.0[rung]));
        let counts = [u32::from(line.facets) - counts.iter().sum::<u32>(), counts[0], counts[1], counts[2]];
        facets.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
        let set_up = PRICES.iter().zip(counts).map(|(price, facets)| price.of(Work { facets, ..Work::NONE })).sum::<u32>();
        let walked = Price::dearest(&PRICES).of(Work { facets: 0, ..walked });
        let cost = walked + set_up + frozen.cost_on(y, &PRICES);
        // Each part of the sum is rounded up.
        assert!(cost <= *bound + 9, "line {y} takes {cost}, known were {bound}");
        // Each span is on one rung.
        let runs = |rung: usize| {
            let mut prices = [Price(Work::NONE); 4];
            prices[rung] = Price(Work { runs: 16, ..Work::NONE });
            frozen.cost_on(y, &prices)
        };
        assert_eq!((0..4).map(runs).sum::<u32>(), u32::from(line.spans));
    }
    if plan.steps().iter().all(|step| *step == 0) {
        assert_eq!(facets[1..], [0; 3]);
    }

    // The same pixels in whatever order, and by tables.
    let mut baked = Box::<Baked<'_, 600, Degrading>>::default();
    let expected = read::<Rgb565, Degrading, 256, 1, _>(&mut scanner.start(degraded)).color;
    let mut lines = scanner.start(degraded);
    let mut other = row.clone();
    for (y, expected) in expected.chunks(row.len()).enumerate().rev() {
        // A background may keep what a row held.
        row.fill(Rgb565::BLACK);
        other.fill(Rgb565::BLACK);
        lines.line(y as u16, &mut row);
        lines.bake(y as u16, &mut baked);
        baked.shade(&mut other);
        assert!(row == expected && other == expected, "line {y}");
        row.fill(Rgb565::BLACK);
        frozen.line(y as u16, &mut row);
        assert!(row == expected, "line {y}");
        assert!(baked.cost_on(&PRICES) <= frozen.cost_on(y as u16, &PRICES));
    }
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn degraded_lines_keep_the_period(scene in scenes::<1>(), (soup, _) in soups(), part in 0..=16_u32) {
        scene.show(|picture| check(picture, part));
        soup.show(|picture| check(picture, part));
    }

    #[test]
    fn a_plan_without_need_changes_nothing(scene in scenes::<1>()) {
        scene.show(|picture| {
            let mut scanner = Box::<Scanner<256, Degrading>>::default();
            // With room for more lines than numbers of 16 bits count.
            let mut plan = Box::<Plan<0x1_0000>>::default();
            plan.make(scanner.start(picture), &PRICES, u32::MAX);
            assert_eq!(plan.bounds().len(), picture.viewport().size.height as usize);
            let with = read::<Gray8, Degrading, 256, 1, _>(&mut scanner.start(plan.degrade(picture)));
            let mut scanner = Box::<Scanner<256>>::default();
            assert!(with == read::<Gray8, DuffBarycentric, 256, 1, _>(&mut scanner.start(picture)));
        });
    }
}
