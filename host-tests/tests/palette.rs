//! Pictures in few colours.

use beamshade::{
    Camera, Color, DuffBarycentric, Frame, Indexed, Ink, Intensity, Light, Material, Mesh, MeshData, Paint, Palette, Pose,
    Scanner,
};
use embedded_graphics::framebuffer::{buffer_size, Framebuffer};
use embedded_graphics::pixelcolor::raw::{BigEndian, RawData, RawU4, RawU8};
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use fixed::types::I16F16;
use host_tests::library::{self, Meshes};
use host_tests::{reference, scenes, Format, Measures, Picture};

const ORANGE: Material = Material::new(Color::rgb(0.85, 0.45, 0.20));
const WHITE: Material = Material::new(Color::WHITE);

/// The worst PSNR and the largest mean between the teapot in `Rgb888` and in so many colours, all frames.
fn errors<const COLORS: usize>(full: &[Picture<Rgb888>], reference: reference::Material, material: &Material) -> (f64, f64) {
    let mesh = scenes::teapot_880().unwrap();
    let palette = Palette::<COLORS>::new(Color::BLACK).with(material);
    let (mut worst, mut mean) = (f64::INFINITY, 0.0_f64);
    for (frame, full) in (0..).zip(full) {
        let scene = scenes::standard(&mesh, reference, frame);
        let meshes = Meshes::of(&scene).unwrap();
        let drawn = library::draw::<Indexed<COLORS>, DuffBarycentric, 1, Light>(&scene, &meshes).unwrap();
        for (Indexed(number), owner) in drawn.color.iter().zip(&drawn.owner) {
            assert_eq!(*number == 0, owner.is_none());
            assert!(usize::from(*number) < COLORS);
        }
        let measures = Measures::between(full, &drawn.map(|pixel| Rgb888::plain(palette.color(pixel))), &scene.triangles());
        worst = worst.min(measures.psnr_db);
        mean = mean.max(measures.mean);
    }
    (worst, mean)
}

#[test]
fn so_near_to_all_colors_as_the_docs_say() {
    let mesh = scenes::teapot_880().unwrap();
    let documented = [
        (scenes::ORANGE, ORANGE, [(36.7, 2.5), (43.4, 0.9), (44.1, 0.8)]),
        (scenes::WHITE, WHITE, [(33.9, 4.1), (45.9, 1.0), (50.6, 0.6)]),
    ];
    for (reference, material, documented) in documented {
        let full = |frame| {
            let scene = scenes::standard(&mesh, reference, frame);
            library::draw::<Rgb888, DuffBarycentric, 1, Light>(&scene, &Meshes::of(&scene).unwrap()).unwrap()
        };
        let full: Vec<_> = (0..scenes::FRAMES).map(full).collect();
        let found = [
            errors::<16>(&full, reference, &material),
            errors::<64>(&full, reference, &material),
            errors::<256>(&full, reference, &material),
        ];
        for ((worst, mean), (db, levels)) in found.into_iter().zip(documented) {
            assert!(
                (0.0..0.1).contains(&(worst - db)) && (0.0..=0.1).contains(&(levels - mean)),
                "{worst} {mean}, stated {db} {levels}"
            );
        }
    }
}

/// The document's formula, by angles from 90° to 0.
#[test]
fn colors_are_those_of_the_documents_formula() {
    const MATERIAL: Material = Material::new(Color::rgb(0.1, 0.35, 0.8))
        .ambient(0.2)
        .diffuse(0.9)
        .specular(0.8)
        .exponent(12)
        .highlight(Color::rgb(1.0, 0.9, 0.6));
    const PALETTE: Palette<64> = Palette::new(Color::WHITE).with(&MATERIAL.colors(10, 40));
    for number in 0..=64 {
        let color = PALETTE.color(Indexed(number));
        let expected = match number {
            64 => [0.0; 3],
            10..=40 => {
                let cos = (f64::from(40 - number) / 30.0 * std::f64::consts::FRAC_PI_2).cos();
                let dull = 0.2 + 0.9 * cos;
                let gloss = 0.8 * cos.powi(12);
                [(0.1, 1.0), (0.35, 0.9), (0.8, 0.6)].map(|(base, highlight)| (dull * base + gloss * highlight).min(1.0))
            }
            _ => [1.0; 3],
        };
        for (found, expected) in color.0.into_iter().zip(expected) {
            assert!((f64::from(found) / 32768.0 - expected).abs() < 1e-4, "{number}: {color:?}, {expected:?}");
        }
    }
    let sent: Vec<_> = PALETTE.colors::<Rgb565>().collect();
    assert_eq!((sent.len(), sent[0], sent[25]), (64, Rgb565::WHITE, Rgb565::plain(PALETTE.color(Indexed(25)))));
}

/// Of all the material's colours a pixel gets the one that is nearest in brightness, but for the steps of the look-up.
#[test]
fn a_number_is_as_bright_as_its_pixel() {
    for (diffuse, specular, exponent) in
        [(0.75, 0.5, 32), (0.75, 0.5, 5), (0.9, 0.0, 1), (0.1, 1.0, 2), (0.0, 0.7, 100), (1.0, 0.1, 250)]
    {
        let material = ORANGE.diffuse(diffuse).specular(specular).exponent(exponent);
        // Orange in grey, and white.
        let orange = (77.0 * 0.85 + 150.0 * 0.45 + 29.0 * 0.20) / 256.0;
        let luma = |d: f64, s: f64| f64::from(diffuse) * orange * d + f64::from(specular) * s;
        let colors: Vec<f64> = (1..=255)
            .map(|number| (f64::from(255 - number) / 254.0 * std::f64::consts::FRAC_PI_2).cos())
            .map(|cos| luma(cos, cos.powi(exponent.into())))
            .collect();
        let paint = <Indexed<256> as Ink>::paint(&material);
        for d in (0..=20).map(|part| 2.0 * f64::from(part) / 20.0) {
            for s in (0..=20).map(|part| f64::from(part) / 20.0) {
                let q14 = |intensity: f64| (intensity * 16384.0).round() as u32;
                let intensity = Intensity { diffuse: q14(d).min(Intensity::MOST), specular: q14(s) };
                let Indexed::<256>(number) = paint.mix(intensity);
                let off = |color: &f64| (color - luma(d, s)).abs();
                let nearest = colors.iter().map(off).fold(f64::INFINITY, f64::min);
                let found = off(&colors[usize::from(number) - 1]);
                // Half a step of light, and half a number where it is steepest, as 256 places stand between.
                assert!(found <= nearest + luma(1.0, 1.0) * 2.0 / 256.0, "{exponent} {d} {s}: {number}, {found} {nearest}");
            }
        }
    }
}

/// A triangle of each material, side by side before the camera.
fn two(materials: &[Material; 2], see: impl FnOnce(&Mesh<'_>)) {
    let mesh = MeshData {
        extent: I16F16::ONE,
        center: [0; 3],
        radius: 32768,
        positions: &[
            [-20000, -9000, 0],
            [-2000, -9000, 0],
            [-2000, 9000, 0],
            [2000, -9000, 0],
            [20000, -9000, 0],
            [2000, 9000, 0],
        ],
        normals: &[[0, 0, 16384], [11585, 0, 11585], [0, 16384, 0], [0, 0, 16384], [11585, 0, 11585], [0, -16384, 0]],
        triangles: &[[0, 1, 2], [3, 4, 5]],
        edges: &[[9597, 32768, 32768], [9597, 32768, 32768]],
        parts: &[[1, 0], [1, 1]],
        materials,
    };
    see(&Mesh::new(mesh).unwrap());
}

#[test]
fn each_material_keeps_to_its_range() {
    for (ranges, expected) in [
        ([[1, 5], [6, 15]], [[1, 5], [6, 15]]),
        ([[3, 3], [9, 255]], [[3, 3], [9, 15]]),
        ([[200, 9], [7, 2]], [[15, 15], [7, 7]]),
    ] {
        let [[a, b], [c, d]] = ranges;
        let materials = [ORANGE.colors(a, b), WHITE.colors(c, d)];
        two(&materials, |mesh| {
            let mut frame = Frame::<'_, 8, 8, 60>::new();
            let camera = Camera::new(Size::new(80, 60)).at_distance(2.0);
            frame.begin(&camera, &[Light::directional([0.2, 0.1, 1.0])]).unwrap();
            frame.add(mesh, &Pose::IDENTITY).unwrap();
            let mut scanner = Scanner::<8>::new();
            let picture = library::read::<Indexed<16>, DuffBarycentric, 8, 1, _>(&mut scanner.start(frame.picture()));
            for (triangle, [first, last]) in (0..).zip(expected) {
                let owned =
                    picture.color.iter().zip(&picture.owner).filter(|(_, owner)| owner.is_some_and(|o| o.triangle == triangle));
                let numbers: Vec<u8> = owned.map(|(Indexed(number), _)| *number).collect();
                assert!(numbers.len() > 100 && numbers.iter().all(|number| (first..=last).contains(number)), "{numbers:?}");
                let used = first..=last;
                assert!(used.clone().count() < 5 || used.filter(|number| numbers.contains(number)).count() >= 4, "{numbers:?}");
            }

            // The same into a display of four bits a pixel.
            let mut display = Framebuffer::<Indexed<16>, RawU4, BigEndian, 80, 60, { buffer_size::<Indexed<16>>(80, 60) }>::new();
            scanner.start(frame.picture()).draw(&mut [Indexed::default(); 80], &mut display).unwrap();
            let pairs = picture.color.chunks(2).map(|pair| Indexed::pair(pair[0], pair[1]));
            assert!(display.data().iter().copied().eq(pairs));
        });
    }
}

#[test]
fn numbers_are_raw_values() {
    assert_eq!(RawU8::from(Indexed::<64>(63)).into_inner(), 63);
    assert_eq!((Indexed::<256>::from(RawU8::new(200)), Indexed::<16>::from(RawU4::new(9))), (Indexed(200), Indexed(9)));
    assert_eq!((RawU4::from(Indexed::<16>(9)).into_inner(), Indexed::pair(Indexed(3), Indexed(12))), (9, 0x3c));
    assert_eq!(<Indexed<16> as Ink>::plain(Color::WHITE), Indexed(0));
    assert_eq!(Rgb888::plain(Palette::<4>::new(Color::WHITE).color(Indexed(4))).levels(), [0; 3]);
}
