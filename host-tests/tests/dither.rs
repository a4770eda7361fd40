//! Greys in black and white.

use beamshade::sink::dither::is_on;
use beamshade::{Dithered, DuffBarycentric, Light, Page};
use embedded_graphics::framebuffer::{buffer_size, Framebuffer};
use embedded_graphics::image::GetPixel;
use embedded_graphics::pixelcolor::raw::{LittleEndian, RawU1};
use embedded_graphics::pixelcolor::{BinaryColor, Gray8};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{Circle, PrimitiveStyle, Rectangle};
use host_tests::library::{self, Meshes};
use host_tests::reference::{Camera, Scene};
use host_tests::{image, scenes, Picture};

const WIDTH: usize = 128;
const HEIGHT: usize = 64;

/// How many of the pixels of a square are on.
fn count(x: u32, y: u32, side: u32, grey: u8) -> u32 {
    let pixels = (0..side * side).map(|i| (x + i % side, y + i / side));
    pixels.filter(|&(x, y)| is_on(x, y, Gray8::new(grey))).count() as u32
}

#[test]
fn of_a_grey_block_so_many_pixels_are_on_as_its_grey_says() {
    let (mut largest, mut squares) = (0.0_f64, 0.0);
    for grey in 0..=255 {
        let share = f64::from(grey) / 255.0;
        // Wherever the block lies.
        for (x, y) in [(0, 0), (8, 56), (3, 5), (1021, 6)] {
            assert_eq!(count(x, y, 8, grey), (64.0 * share).round() as u32, "{grey} at {x}, {y}");
        }
        // Smaller squares are as near as whole pixels let them be, so the pixels that are on lie evenly.
        for place in 0..16 {
            let quarter = f64::from(count(4 * (place % 4), 4 * (place / 4), 4, grey));
            assert!((quarter - 16.0 * share).abs() < 1.0, "{grey}: {quarter} of 16");
        }
        let off = f64::from(count(0, 0, 8, grey)) * 255.0 / 64.0 - f64::from(grey);
        largest = largest.max(off.abs());
        squares += off * off;
    }
    let rms = (squares / 256.0).sqrt();
    // As documented.
    assert!((1.98..=1.99).contains(&largest) && (1.145..=1.15).contains(&rms), "{largest} {rms}");
}

#[test]
fn brighter_pixels_never_go_off() {
    for place in 0..64 {
        let on: Vec<_> = (0..=255).map(|grey| is_on(place % 8, place / 8, Gray8::new(grey))).collect();
        assert!(on.is_sorted() && !on[0] && on[255]);
    }
}

/// Greys without an order, `WIDTH` × `HEIGHT`.
fn noise() -> Vec<Gray8> {
    let mut random = fastrand::Rng::with_seed(1);
    (0..WIDTH * HEIGHT).map(|_| Gray8::new(random.u8(..))).collect()
}

fn pixel_of(page: &[u8], x: usize, y: usize) -> bool {
    page[x] >> (y % 8) & 1 == 1
}

#[test]
fn a_page_holds_eight_lines_whatever_their_order() {
    let noise = noise();
    for order in [[0, 1, 2, 3, 4, 5, 6, 7], [5, 3, 0, 1, 6, 2, 4, 7]] {
        let mut page = Page::<WIDTH>::new();
        for first in (0..HEIGHT).step_by(8) {
            for y in order.map(|line| first + line) {
                let given = page.add(y as u16, &noise[y * WIDTH..][..WIDTH]).is_some();
                assert_eq!(given, y % 8 == 7);
            }
            for (x, y) in (0..8 * WIDTH).map(|i| (i % WIDTH, first + i / WIDTH)) {
                assert_eq!(pixel_of(page.bytes(), x, y), is_on(x as u32, y as u32, noise[y * WIDTH + x]), "{x}, {y}");
            }
        }
    }
}

#[test]
fn rows_and_pages_may_differ_in_length() {
    let mut page = Page::<21>::default();
    for y in 0..8 {
        page.add(y, &[Gray8::WHITE; 100]);
    }
    assert_eq!(page.bytes(), &[0xff; 21]);
    page.add(u16::MAX, &[Gray8::BLACK; 13]);
    assert_eq!(page.bytes(), &std::array::from_fn(|x| if x < 13 { 0x7f } else { 0xff }));
    assert_eq!(Page::<0>::new().add(7, &[Gray8::WHITE]), Some(&[]));
}

type Panel = Framebuffer<BinaryColor, RawU1, LittleEndian, WIDTH, HEIGHT, { buffer_size::<BinaryColor>(WIDTH, HEIGHT) }>;

fn is_lit(panel: &Panel, x: usize, y: usize) -> bool {
    panel.pixel(Point::new(x as i32, y as i32)) == Some(BinaryColor::On)
}

#[test]
fn a_display_of_one_bit_takes_greys() {
    let grey = Gray8::new(100);
    let mut panel = Panel::new();
    let mut display = Dithered(&mut panel);
    assert_eq!(display.bounding_box(), Rectangle::new(Point::zero(), Size::new(128, 64)));
    // Beyond its sides, too: the pattern stays where it is.
    display.fill_contiguous(&Rectangle::new(Point::new(-3, -5), Size::new(50, 20)), [grey; 1000]).unwrap();
    Circle::new(Point::new(60, 20), 30).into_styled(PrimitiveStyle::with_fill(grey)).draw(&mut display).unwrap();
    let inside = |x: usize, y: usize| x < 47 && y < 15 || (x as i32 - 75).pow(2) + (y as i32 - 35).pow(2) < 170;
    for (x, y) in (0..WIDTH * HEIGHT).map(|i| (i % WIDTH, i / WIDTH)) {
        let outside = !inside(x, y) && !(55..95).contains(&x);
        let expected = inside(x, y) && is_on(x as u32, y as u32, grey);
        assert!(is_lit(&panel, x, y) == expected || !inside(x, y) && !outside, "{x}, {y}");
    }
}

/// The means of 8×8 blocks, in levels, of pixels with these levels.
fn blocks(level: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let corners = (0..HEIGHT).step_by(8).flat_map(|y| (0..WIDTH).step_by(8).map(move |x| (x, y)));
    let level = &level;
    corners.map(|(x, y)| (0..64).map(|i| level(x + i % 8, y + i / 8)).sum::<f64>() / 64.0).collect()
}

#[test]
fn the_teapot_is_as_bright_in_black_and_white_as_in_grey() {
    let mesh = scenes::teapot_880().unwrap();
    let (mut largest, mut squares, mut number, mut bias) = (0.0_f64, 0.0, 0.0, 0.0_f64);
    for frame in 0..scenes::FRAMES {
        let focal = Camera::focal_length(HEIGHT, 40_f64.to_radians());
        let standard = scenes::standard(&mesh, scenes::WHITE, frame);
        let scene = Scene { camera: Camera { width: WIDTH, height: HEIGHT, focal, ..standard.camera }, ..standard };
        let meshes = Meshes::of(&scene).unwrap();
        let (grey, panel) = library::frame::<_, 1, Light>(&scene, &meshes, |picture| {
            let mut scanner = Box::<beamshade::Scanner<256, DuffBarycentric>>::default();
            let mut lines = scanner.start(picture);
            let grey: Picture<Gray8> = library::read(&mut lines);
            let mut panel = Panel::new();
            lines.draw(&mut [Gray8::BLACK; WIDTH], &mut Dithered(&mut panel)).unwrap();
            (grey, panel)
        })
        .unwrap();

        // By pages it is the same picture.
        let mut page = Page::<WIDTH>::new();
        for (y, row) in grey.color.chunks(WIDTH).enumerate() {
            let Some(bytes) = page.add(y as u16, row) else { continue };
            for (x, y) in (0..8 * WIDTH).map(|i| (i % WIDTH, y - 7 + i / WIDTH)) {
                assert_eq!(pixel_of(bytes, x, y), is_lit(&panel, x, y), "frame {frame}: {x}, {y}");
            }
        }

        let dithered = blocks(|x, y| if is_lit(&panel, x, y) { 255.0 } else { 0.0 });
        let level = |x: usize, y: usize| f64::from(grey.color[y * WIDTH + x].luma());
        let shaded = blocks(level);
        // A block has no fewer on than if all of it were as dark as its darkest pixel, and no more than if as bright as its brightest.
        for (block, mean) in dithered.iter().enumerate() {
            let (x, y) = (block % (WIDTH / 8) * 8, block / (WIDTH / 8) * 8);
            let levels = || (0..64).map(|i| level(x + i % 8, y + i / 8));
            let (darkest, brightest) = (levels().fold(255.0, f64::min), levels().fold(0.0, f64::max));
            assert!(
                (darkest - 2.0..=brightest + 2.0).contains(mean),
                "frame {frame}, {x}, {y}: {mean}, {darkest} to {brightest}"
            );
        }
        let differences: Vec<f64> = dithered.iter().zip(&shaded).map(|(a, b)| a - b).collect();
        bias = bias.max((differences.iter().sum::<f64>() / differences.len() as f64).abs());
        // Of blocks with something in them.
        for difference in differences.iter().zip(&shaded).filter(|(_, shaded)| **shaded > 0.0).map(|(difference, _)| *difference)
        {
            largest = largest.max(difference.abs());
            squares += difference * difference;
            number += 1.0;
        }
        if frame == 7 {
            let shown = grey.map(|_| Gray8::BLACK);
            let color =
                (0..WIDTH * HEIGHT).map(|i| Gray8::new(if is_lit(&panel, i % WIDTH, i / WIDTH) { 255 } else { 0 })).collect();
            let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
            image::write(folder.join("dithered.png"), &Picture { color, ..shown }).unwrap();
            image::write(folder.join("grey.png"), &grey).unwrap();
        }
    }
    let rms = f64::sqrt(squares / number);
    println!("blocks: largest {largest:.3}, rms {rms:.3} of {number}; bias {bias:.3}");
    // As documented.
    assert!(
        (18.0..=18.2).contains(&largest) && (4.7..=4.8).contains(&rms) && (0.5..=0.6).contains(&bias),
        "{largest} {rms} {bias}"
    );
}
