//! A panel to which only changes are sent shows what whole frames would.

use beamshade::{Changes, Columns, Flat, Round, Scanner};
use embedded_graphics::pixelcolor::{raw::RawU16, Rgb565};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use host_tests::library::read;
use host_tests::panel::Panel;
use proptest::array::uniform4;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::cases;
use crate::scene::{scenes, Scene};
use crate::sinks::filled;

/// In the corners of a round panel, never to be seen again anywhere else.
const NOISE: [u8; 2] = [0x5a, 0xa5];

/// What happens before a frame.
#[derive(Clone, Debug)]
struct Event {
    /// Other objects.
    scene: Scene,
    /// Another background, and all is sent.
    background: bool,
    /// A patch of that colour lies over the picture from now on, here.
    patch: Option<([i8; 4], u16)>,
}

fn events() -> impl Strategy<Value = Vec<Event>> {
    let patch = prop_oneof![2 => Just(None), 1 => (uniform4(any::<i8>()), any::<u16>()).prop_map(Some)];
    let event = (filled(), prop_oneof![4 => Just(false), 1 => Just(true)], patch);
    vec(event.prop_map(|(scene, background, patch)| Event { scene, background, patch }), 2..6)
}

fn prices() -> impl Strategy<Value = u16> {
    prop_oneof![3 => Just(5), 1 => 0u16..100, 1 => any::<u16>()]
}

fn area([x, y, width, height]: [i8; 4]) -> Rectangle {
    Rectangle::new(Point::new(x.into(), y.into()), Size::new(width.unsigned_abs().into(), height.unsigned_abs().into()))
}

/// Lays a patch over a line.
fn lay<P: Copy>(patch: Option<(Rectangle, P)>, y: u16, row: &mut [P]) {
    let Some((area, color)) = patch else { return };
    for (x, pixel) in row.iter_mut().enumerate() {
        if area.contains(Point::new(x as i32, y.into())) {
            *pixel = color;
        }
    }
}

/// Plays the events on two panels, one fed line by line and one by an embedded-graphics driver, and looks at both each time.
fn play<const LINES: usize>(events: &[Event], changes: Changes<LINES>, side: Option<u16>) -> Result<(), TestCaseError> {
    let Scene { mut camera, mut background, .. } = events[0].scene.clone();
    if let Some(side) = side {
        camera = beamshade::Camera::new(Size::new_equal(side.into()));
    }
    let size = camera.viewport().size;
    let size = [size.width as usize, size.height as usize];
    let (mut pulled, mut pushed) = (changes.clone(), changes);
    let (mut panel, mut driven) = (Panel::new(size, NOISE), Panel::new(size, NOISE));
    let mut patch = None;
    let mut scanner = Box::<Scanner<256, Flat>>::default();
    for (step, event) in events.iter().enumerate() {
        if event.background {
            background = event.scene.background;
            [&mut pulled, &mut pushed].into_iter().for_each(Changes::refresh);
        }
        if let Some((place, color)) = event.patch {
            for area in patch.iter().map(|(area, _)| *area).chain([area(place)]) {
                [&mut pulled, &mut pushed].into_iter().for_each(|changes| changes.touch(&area));
            }
            patch = Some((area(place), color));
        }
        let bytes = patch.map(|(area, color)| (area, color.to_be_bytes()));
        let color = patch.map(|(area, color)| (area, Rgb565::from(RawU16::new(color))));
        let scene = Scene { camera, background, ..event.scene.clone() };
        let whole = scene.show(|picture| {
            panel.pull(&mut scanner.start(picture), &mut pulled, |y, row| lay(bytes, y, row));
            let mut row = vec![Rgb565::default(); size[0]];
            let finish = |y: u16, row: &mut [Rgb565]| lay(color, y, row);
            scanner.start(picture).draw_changes(&mut row, &mut pushed, &mut driven, finish).unwrap();
            let mut whole = read::<[u8; 2], Flat, 256, 1, _>(&mut scanner.start(picture)).color;
            whole.chunks_mut(size[0]).zip(0..).for_each(|(row, y)| lay(bytes, y, row));
            whole
        });
        prop_assert_eq!(panel.bytes, driven.bytes);
        for (place, pixel) in whole.iter().enumerate() {
            let (x, y) = (place % size[0], (place / size[0]) as u16);
            let seen = side.is_none_or(|side| Round::new(side).columns(y).range().contains(&x));
            prop_assert_eq!(panel.memory[place], driven.memory[place]);
            prop_assert!(!seen || panel.memory[place] == *pixel, "step {}, pixel {}, {}", step, x, y);
        }
    }
    let sent = pulled.take_sent();
    prop_assert_eq!(sent, pushed.take_sent());
    prop_assert_eq!((u64::from(sent.bytes(2)), u64::from(sent.windows)), (panel.bytes, panel.windows));
    prop_assert_eq!((sent.pixels + sent.saved) as usize, size[0] * size[1] * events.len());
    Ok(())
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn what_is_covered_is_known_before_it_is_shaded(scene in scenes::<1>()) {
        scene.show(|picture| {
            let mut scanner = Box::<Scanner<256, Flat>>::default();
            let mut lines = scanner.start(picture);
            for y in 0..=picture.viewport().size.height as u16 {
                let covered = lines.covered(y);
                let mut hull = Columns::NONE;
                lines.spans(y, |span, _| hull = hull.hull(Columns { start: span.start, end: span.end }));
                assert_eq!(covered, hull, "line {y}");
            }
        });
    }

    #[test]
    fn a_panel_that_gets_changes_shows_whole_frames(events in events(), price in prices()) {
        let width = events[0].scene.camera.viewport().size.width as u16;
        play(&events, Changes::<1024>::new(width).window_price(price), None)?;
    }

    #[test]
    fn lines_without_a_memory_are_sent_always(events in events()) {
        play(&events, Changes::<20>::new(events[0].scene.camera.viewport().size.width as u16), None)?;
    }

    #[test]
    fn a_round_panel_shows_all_but_its_corners(events in events(), side in 1u16..200) {
        play(&events, Changes::<200>::round(side), Some(side))?;
    }

    /// What is sent needlessly in a window costs no more than another one, beside what is sent line by line.
    #[test]
    fn windows_are_shared_where_that_pays(lines in vec((0u16..100, 0u16..100), 1..60), price in 0u16..40) {
        let mut changes = Changes::<60>::new(100).window_price(price);
        let mut previous = vec![Columns::ALL; lines.len()];
        for turn in 0..3 {
            let (mut needed, mut strips, mut wasted) = (0u32, 0, 0u32);
            for (y, stale) in previous.iter_mut().enumerate() {
                let (start, end) = lines[(y + turn * 7) % lines.len()];
                let covered = Columns { start, end };
                let need = stale.hull(covered).within(Columns { start: 0, end: 100 });
                *stale = covered;
                match changes.line(y as u16, covered) {
                    None => prop_assert!(need.is_empty()),
                    Some(strip) => {
                        prop_assert_eq!(strip.columns.hull(need), strip.columns);
                        wasted = if strip.opens { 0 } else { wasted } + u32::from(strip.columns.len() - need.len());
                        prop_assert!(wasted <= u32::from(price), "{} on line {}", wasted, y);
                        needed += u32::from(need.len());
                        strips += 1;
                    }
                }
            }
            let sent = changes.take_sent();
            prop_assert!(sent.windows <= strips);
            prop_assert!(sent.pixels <= needed + sent.windows * u32::from(price));
        }
    }
}

#[test]
fn a_circle_touches_the_columns_of_a_round_panel_and_no_others() {
    for diameter in 0..=1024u64 {
        for y in 0..diameter {
            let columns = Round::new(diameter as u16).columns(y as u16);
            // Squares of half pixels, to the nearest point of a pixel.
            let near = |place: u64| (2 * place + 1).abs_diff(diameter).saturating_sub(1).pow(2);
            let touched = |x: u64| near(x) + near(y) < diameter * diameter;
            let (start, end) = (u64::from(columns.start), u64::from(columns.end));
            assert!(start < end && end <= diameter && start + end == diameter, "{diameter}: {y}");
            assert!(touched(start) && touched(end - 1), "{diameter}: line {y} is too long");
            assert!(start == 0 || !touched(start - 1), "{diameter}: line {y} is too short");
        }
        assert_eq!(Round::new(diameter as u16).columns(diameter as u16), Columns::NONE);
    }
}

/// On a turn of the standard scene; `cargo xtask bus` prints the mean.
#[test]
fn a_turn_of_the_teapot_takes_less_than_its_frames() {
    let round = |x, y| host_tests::panel::is_in_circle(x, y, 240);
    let turns = [
        (host_tests::panel::turn(Changes::new(240), |_, _| true), 240 * 240),
        (
            host_tests::panel::turn(Changes::round(240), round),
            (0..240).map(|y| u64::from(Round::new(240).columns(y).len())).sum(),
        ),
    ];
    for (steps, pixels) in turns {
        let steps = steps.unwrap();
        let mean = steps[1..].iter().map(|step| step.bytes).sum::<u64>() / 60;
        println!("{} bytes first, then {mean} in the mean", steps[0].bytes);
        assert!(steps.iter().all(|step| step.wrong == 0));
        assert!(steps.iter().all(|step| step.bytes == u64::from(step.sent.bytes(2))));
        assert!((2 * pixels..2 * pixels + 2400).contains(&steps[0].bytes));
        assert!(mean < 115_200 / 2);
    }
}
