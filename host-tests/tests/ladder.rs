//! The standard scene under ever shorter line periods.

use anyhow::Result;
use beamshade::{Degrading, DuffBarycentric, Plan, Price, Scanner};
use embedded_graphics::pixelcolor::Gray8;
use embedded_graphics::prelude::*;
use host_tests::library::{self, read, Meshes};
use host_tests::{scenes, Picture};

/// How alike two pictures are where a triangle is seen, in dB.
fn psnr(a: &Picture<Gray8>, b: &Picture<Gray8>) -> f64 {
    let apart = a.color.iter().zip(&b.color).map(|(a, b)| f64::from(a.luma()) - f64::from(b.luma()));
    let square = apart.map(|d| d * d).sum::<f64>() / a.covered() as f64;
    10.0 * (255.0 * 255.0 / square).log10()
}

#[test]
fn a_shorter_period_degrades_gracefully() -> Result<()> {
    let mesh = scenes::teapot_880()?;
    let scene = scenes::standard(&mesh, scenes::ORANGE, 0);
    let meshes = Meshes::of(&scene)?;
    let exact: Picture<Gray8> = library::draw::<_, DuffBarycentric, 1, beamshade::Light>(&scene, &meshes)?;
    let prices = &Price::M0_PLUS_DEGRADING;
    library::frame(&scene, &meshes, |picture: beamshade::Picture<'_, '_, 1>| {
        let mut scanner = Box::<Scanner<96, Degrading>>::default();
        let mut plan = Plan::<240>::new();
        plan.make(scanner.start(picture), prices, 0);
        let least = plan.bounds().iter().copied().max().unwrap_or(0);
        plan.make(scanner.start(picture), prices, u32::MAX);
        let most = plan.bounds().iter().copied().max().unwrap_or(0);
        assert!(least < most);
        let mut before = f64::INFINITY;
        for part in (0..=8).rev() {
            let period = least + (most - least) / 8 * part + if part == 8 { 8 } else { 0 };
            plan.make(scanner.start(picture), prices, period);
            assert_eq!(plan.late(), 0);
            assert!(plan.bounds().iter().all(|bound| *bound <= period));
            let mut lines = scanner.start(plan.degrade(picture));
            let drawn = read::<Gray8, Degrading, 96, 1, _>(&mut lines);
            assert!(drawn.owner == exact.owner);
            let (quality, degraded) = (psnr(&exact, &drawn), lines.degraded().0);
            println!("period {period}: {quality:.1} dB, {degraded:?} facets on the rungs");
            // Never better by more than chance, and never worse than flat.
            assert!(quality <= before + 1.0 && quality > 20.0);
            assert_eq!(part == 8, degraded == [0; 3]);
            before = quality;
        }
        // Each rung for all of it.
        let mut before = f64::INFINITY;
        for rung in 0..4 {
            let price = |above: bool| Price(beamshade::Work { facets: above.into(), ..beamshade::Work::NONE });
            plan.make(scanner.start(picture), &[price(rung > 0), price(rung > 1), price(rung > 2), price(false)], 0);
            let mut lines = scanner.start(plan.degrade(picture));
            let quality = psnr(&exact, &read::<Gray8, Degrading, 96, 1, _>(&mut lines));
            println!("rung {rung}: {quality:.1} dB, {:?} facets", lines.degraded().0);
            assert!(quality <= before);
            let others = (1..4).filter(|other| *other != rung).map(|other| lines.degraded().0[other - 1]).sum::<u16>();
            assert_eq!(others, 0);
            before = quality;
        }
    })
}
