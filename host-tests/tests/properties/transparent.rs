//! Transparent triangles, against pictures without them and pictures in which they are opaque.

use std::iter::repeat_n;

use beamshade::{Background, Color, DepthLine, DuffBarycentric, Indexed, Ink, Light, Line, Scanner, Spanning, Visibility};
use embedded_graphics::pixelcolor::Rgb565;
use host_tests::library::{read_by, read_transparent};
use host_tests::{Owner, Picture};
use proptest::prelude::*;

use crate::cases;
use crate::scene::{colors, scenes, Scene, OPAQUE};
use crate::visibility::soups;

/// The scene with other materials, as told for each triangle; without those that are told none.
fn with_materials(scene: &Scene, mut material: impl FnMut(u16) -> Option<u16>) -> Scene {
    let mut scene = scene.clone();
    for (shape, _) in &mut scene.objects {
        let before = shape.parts.iter().flat_map(|[count, material]| repeat_n(*material, (*count).into()));
        let after: Vec<_> = before.map(&mut material).collect();
        let mut kept = after.iter();
        shape.triangles.retain(|_| kept.next().is_some_and(Option::is_some));
        let mut kept = after.iter();
        shape.edges.retain(|_| kept.next().is_some_and(Option::is_some));
        shape.parts = after.into_iter().flatten().map(|material| [1, material]).collect();
    }
    scene
}

/// A scene in which the triangles that a bit is set for are transparent.
fn with_panes(scene: &Scene, mut bits: u64) -> Scene {
    with_materials(scene, |material| {
        bits = bits.rotate_right(1);
        Some(material + if bits >> 63 == 1 { OPAQUE } else { 0 })
    })
}

/// The scene as drawn, and the owners of its opaque level.
fn drawn<V: Visibility, P: Ink, const ACTIVE: usize>(scene: &Scene) -> (Picture<P>, Vec<Option<Owner>>) {
    scene.show(|picture| read_transparent(&mut Box::<Scanner<ACTIVE, DuffBarycentric, 1, Light, V>>::default().start(picture)))
}

/// The scene by lines that know no transparency.
fn plain<P: Ink>(scene: &Scene) -> Picture<P> {
    scene.show(|picture| read_by(&mut Box::<Scanner<256>>::default().start(picture)))
}

/// For each triangle of the scene its material, and its number among the opaque ones of its object.
fn materials(scene: &Scene) -> Vec<Vec<(u16, u32)>> {
    let of = |parts: &[[u16; 2]]| {
        let mut opaque = 0;
        let number = |[_, material]: &[u16; 2]| {
            let number = opaque;
            opaque += u32::from(*material < OPAQUE);
            (*material, number)
        };
        parts.iter().map(number).collect()
    };
    scene.objects.iter().map(|(shape, _)| of(&shape.parts)).collect()
}

/// Checks each pixel: what is in front, as it is if it were opaque, over what is seen without transparent triangles. Returns the
/// number of pixels that are blended, and of those the ones before a triangle.
fn is_front_over_opaque(scene: &Scene) -> [usize; 2] {
    let materials = materials(scene);
    let (blended, behind) = drawn::<Spanning, Color, 256>(scene);
    let front = plain::<Color>(&with_materials(scene, |material| Some(material % OPAQUE)));
    let opaque = plain::<Color>(&with_materials(scene, |material| (material < OPAQUE).then_some(material)));
    assert!(blended.owner == front.owner && plain::<Color>(scene) == front);
    let mut counts = [0; 2];
    for (pixel, behind) in behind.into_iter().enumerate() {
        let number = |owner: Owner| Owner { triangle: materials[owner.object as usize][owner.triangle as usize].1, ..owner };
        assert_eq!(behind.map(number), opaque.owner[pixel]);
        let material = front.owner[pixel].map(|owner| materials[owner.object as usize][owner.triangle as usize].0);
        let is_blended = material.is_some_and(|material| material >= OPAQUE);
        let is_known = behind.is_some() || scene.background != Background::Keep;
        let expected = if is_blended && is_known {
            counts[0] += 1;
            counts[1] += usize::from(behind.is_some());
            let opacity = [0.4, 0.75, 0.1, 0.9, 0.5][usize::from(material.unwrap() - OPAQUE)];
            let opacity: f64 = f64::round(opacity * 256.0) / 256.0;
            [0, 1, 2]
                .map(|i| opacity * f64::from(front.color[pixel].0[i]) + (1.0 - opacity) * f64::from(opaque.color[pixel].0[i]))
        } else {
            front.color[pixel].0.map(f64::from)
        };
        let near = |(actual, expected): (u16, f64)| (f64::from(actual) - expected).abs() <= 0.5;
        assert!(
            blended.color[pixel].0.into_iter().zip(expected).all(near),
            "{pixel}: {:?} is not {expected:?}",
            blended.color[pixel]
        );
    }
    counts
}

proptest! {
    #![proptest_config(cases(512))]

    #[test]
    fn the_front_is_over_the_opaque((scene, _) in soups(), bits: u64, color in colors(), keep: bool) {
        let background = if keep { Background::Keep } else { Background::Plain(color) };
        is_front_over_opaque(&with_panes(&Scene { background, ..scene }, bits));
    }

    /// Anything, and clipped triangles too.
    #[test]
    fn the_front_of_any_scene_is_over_the_opaque(scene in scenes::<1>(), bits: u64) {
        is_front_over_opaque(&with_panes(&scene, bits));
    }

    #[test]
    fn either_visibility_blends_the_same((scene, _) in soups(), bits: u64) {
        let scene = with_panes(&scene, bits);
        let expected = drawn::<Spanning, Rgb565, 256>(&scene);
        assert!(drawn::<DepthLine<7>, Rgb565, 256>(&scene) == expected);
        assert!(drawn::<DepthLine<64>, Rgb565, 5>(&scene) == drawn::<Spanning, Rgb565, 5>(&scene));
    }

    /// With room for five, one or no triangles on a line; from the last line to the first; among lines of other kinds.
    #[test]
    fn no_scene_is_too_much(scene in scenes::<1>(), bits: u64) {
        let scene = with_panes(&scene, bits);
        drawn::<Spanning, Rgb565, 1>(&scene);
        drawn::<Spanning, Rgb565, 0>(&scene);
        let (expected, _) = drawn::<Spanning, Rgb565, 5>(&scene);
        scene.show(|picture| {
            let mut scanner = Box::<Scanner<5>>::default();
            let mut lines = scanner.start(picture);
            let mut other = vec![Rgb565::new(0, 0, 0); expected.width];
            for (y, row) in expected.color.chunks(expected.width).enumerate().rev() {
                let y = y as u16;
                let mut again = vec![Rgb565::new(0, 0, 0); expected.width];
                let [blended, plain] = [lines.transparent_line(y, &mut again), lines.line(y, &mut other)];
                assert_eq!(again, row);
                let counts = |line: Line| (line.active, line.spans, line.dropped);
                assert_eq!(counts(blended), counts(plain));
            }
        });
    }

    /// A row that is too short holds the first of the pixels, one that is too long keeps what lies beyond, and so does any row the
    /// pixels of which nothing is known.
    #[test]
    fn nothing_else_is_stored((scene, _) in soups(), bits: u64, keep: bool, length in 0..150_usize) {
        let scene = with_panes(&scene, bits);
        let scene = if keep { Scene { background: Background::Keep, ..scene } } else { scene };
        const BEFORE: Color = Color([1, 2, 3]);
        scene.show(|picture| {
            let mut scanner = Box::<Scanner<256>>::default();
            let mut lines = scanner.start(picture);
            let [width, height] = [picture.viewport().size.width, picture.viewport().size.height].map(|side| side as usize);
            for y in 0..height as u16 + 2 {
                let (mut row, mut part) = (vec![BEFORE; width], vec![BEFORE; length]);
                lines.transparent_line(y, &mut row);
                lines.transparent_line(y, &mut part);
                let mut seen = vec![!keep && usize::from(y) < height; width];
                lines.spans(y, |span, _| seen[usize::from(span.start)..usize::from(span.end)].fill(true));
                assert!(row.iter().zip(seen).all(|(pixel, is_stored)| (*pixel != BEFORE) == is_stored));
                row.resize(length.max(width), BEFORE);
                assert_eq!(part, row[..length]);
            }
        });
    }

    #[test]
    fn numbers_of_a_palette_are_opaque((scene, _) in soups(), bits: u64) {
        let expected = plain::<Indexed<64>>(&scene);
        assert!(drawn::<Spanning, Indexed<64>, 256>(&with_panes(&scene, bits)).0 == expected);
    }
}

#[test]
fn random_panes_are_worth_drawing() {
    use proptest::{strategy::ValueTree, test_runner::TestRunner};
    let mut runner = TestRunner::new(cases(0));
    let mut sums = [0; 2];
    for round in 0..200_u64 {
        let (scene, _) = soups().new_tree(&mut runner).unwrap().current();
        let counts = is_front_over_opaque(&with_panes(&scene, round.wrapping_mul(0x9e37_79b9_7f4a_7c15)));
        sums = [sums[0] + counts[0], sums[1] + counts[1]];
    }
    println!("of 200 scenes {} pixels are blended, {} of them before a triangle", sums[0], sums[1]);
    assert!(sums[1] > 5000 && sums[0] > sums[1] + 5000);
}
