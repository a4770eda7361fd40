//! Scenes of whose lines the cost is foretold, drawn by all methods that have prices, in all ways: at once, baked, and frozen.

use core::ops::RangeInclusive;

use beamshade::{
    Background, Baked, Camera, Color, Degrading, DuffBarycentric, Flat, Frozen, Gouraud, Light, Picture, Plan, Pose, Price,
    QuadraticIntensity, Rotation, Scanner, Shade, Turn, Work,
};
use embedded_graphics::{geometry::Size, pixelcolor::Rgb565};

use super::{Scene, ACTIVE, HEIGHT, LIGHTS, MESH, WIDTH};
use crate::mark;

include!(concat!(env!("OUT_DIR"), "/soups.rs"));
include!(concat!(env!("OUT_DIR"), "/teapot-5560.rs"));
include!(concat!(env!("OUT_DIR"), "/sphere-80.rs"));

/// Random scenes to calibrate with, then others to check, then the standard ones.
const CALIBRATE: u16 = 1000;
pub(super) const RANDOM: u16 = CALIBRATE + 1000;
/// The scenes T880, T5560, i80, and three teapots through each other.
const STANDARD: u16 = 4;
/// Frames of each.
const TURNS: u16 = 2;
pub(super) const FRAMES: u16 = RANDOM + STANDARD * TURNS;
/// Of T5560, visible triangles.
pub(super) const SEEN: usize = 4096;

/// For each method that has prices, what it draws with.
#[derive(Debug)]
pub(super) struct Tables {
    duff: Ways<DuffBarycentric>,
    quadratic: Ways<QuadraticIntensity>,
    gouraud: Ways<Gouraud>,
    flat: Ways<Flat>,
    ladder: Ways<Degrading>,
    plan: Plan<HEIGHT>,
}

/// A scanner, and tables that are filled now to be shaded later.
#[derive(Debug)]
struct Ways<S: Shade<LIGHTS>> {
    scanner: Scanner<ACTIVE, S>,
    baked: Baked<'static, 512, S>,
    frozen: Frozen<'static, 32768, SEEN, HEIGHT, S>,
}

impl Tables {
    pub(super) const fn new() -> Self {
        Self {
            duff: Ways::new(),
            quadratic: Ways::new(),
            gouraud: Ways::new(),
            flat: Ways::new(),
            ladder: Ways::new(),
            plan: Plan::new(),
        }
    }
}

impl<S: Shade<LIGHTS>> Ways<S> {
    const fn new() -> Self {
        Self { scanner: Scanner::new(), baked: Baked::new(), frozen: Frozen::new() }
    }

    /// Draws a frame in all ways, each line marked, and hands each row to `see`. A PC says what there was to do: for each mark the
    /// kind of scene, the method, the way, the counts, and those that were known before. False if a table had no room.
    #[inline(never)]
    fn draw(
        &mut self,
        picture: Picture<'_, 'static>,
        row: &mut [Rgb565],
        name: [&str; 2],
        see: &mut dyn FnMut(&[Rgb565]),
    ) -> bool {
        let Self { scanner, baked, frozen } = self;
        let size = picture.viewport().size;
        let Some(row) = row.get_mut(..size.width as usize) else { return false };
        let mut fits = frozen.take(scanner.start(picture)).left_out == 0;
        let mut lines = scanner.start(picture);
        for y in 0..size.height as u16 {
            let before = lines.walked();
            mark::line();
            let line = lines.line(y, row);
            mark::pause();
            fits &= line.dropped == 0;
            say(name, "line", || (lines.walked() - before + frozen.work(y), picture.most(y)));
            see(row);
        }
        let mut lines = scanner.start(picture);
        for y in 0..size.height as u16 {
            let before = lines.walked();
            mark::line();
            let line = lines.bake(y, baked);
            mark::pause();
            fits &= line.left_out == 0;
            let Work { gradients, started, .. } = frozen.work(y);
            say(name, "bake", || (lines.walked() - before + Work { gradients, started, ..Work::NONE }, picture.most(y)));
            mark::line();
            baked.shade(row);
            mark::pause();
            say(name, "shade", || (baked.work(), picture.most(y)));
            see(row);
        }
        for y in 0..size.height as u16 {
            mark::line();
            frozen.line(y, row);
            mark::pause();
            say(name, "frozen", || (frozen.work(y), picture.most(y)));
            see(row);
        }
        fits
    }
}

/// Random numbers: a linear congruential generator, of which the upper half is used.
struct Random(u64);

impl Random {
    fn next(&mut self, range: RangeInclusive<i32>) -> i32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let count = (range.end() - range.start() + 1) as u64;
        range.start() + (((self.0 >> 32) * count) >> 32) as i32
    }

    /// A number of so many 256ths.
    fn part(&mut self, range: RangeInclusive<i32>) -> f32 {
        self.next(range) as f32 / 256.0
    }

    fn turn(&mut self) -> Turn {
        Turn::degrees(self.next(0..=359))
    }

    fn color(&mut self) -> Color {
        let mut part = || self.part(0..=256);
        Color::rgb(part(), part(), part())
    }
}

impl Scene {
    /// A random scene: up to four objects, anywhere, of any size, some of them clipped, in a small picture. False if something has
    /// no room.
    pub(super) fn prepare_random(&mut self, step: u16) -> bool {
        let mut random = Random(step.into());
        random.next(0..=1);
        // Wide and low, or narrow and high.
        let width = random.next(8..=WIDTH as i32);
        let size = Size::new(width as u32, random.next(3..=(48 - width / 6).max(4)) as u32);
        let angle = Turn::degrees(random.next(20..=90));
        let camera = Camera::new(size).field_of_view(angle).at_distance(random.part(300..=900));
        let background = match random.next(0..=3) {
            0 => Background::Gradient { top: random.color(), bottom: random.color() },
            _ => Background::Plain(random.color()),
        };
        self.frame.background(background);
        let towards = [(); 3].map(|()| random.part(-256..=256));
        let mut fits = self.frame.begin(&camera, &[Light::directional(towards)]).is_ok();
        for _ in 0..random.next(0..=4) {
            let rotation = Rotation::x(random.turn()) * Rotation::y(random.turn());
            let at = [random.part(-256..=256), random.part(-256..=256), random.part(-256..=256)];
            let pose = Pose::turned(rotation).scaled(random.part(16..=512)).at(at);
            let mesh = match SOUPS.get(random.next(0..=SOUPS.len() as i32) as usize) {
                Some(mesh) => mesh,
                None => &MESH,
            };
            fits &= self.frame.add(mesh, &pose).is_ok();
        }
        fits
    }

    /// A standard scene, as the accuracy is measured with.
    pub(super) fn prepare_standard(&mut self, step: u16) -> bool {
        self.frame.background(Background::Plain(Color::BLACK));
        let step = step - RANDOM;
        self.begin(360 / i32::from(TURNS) * i32::from(step % TURNS)).is_some_and(|rotation| {
            let mesh = match step / TURNS {
                0 => &MESH,
                1 => &TEAPOT_5560,
                2 => &SPHERE,
                _ => return self.add_three(rotation),
            };
            self.frame.add(mesh, &Pose::turned(rotation)).is_ok()
        })
    }

    /// Draws the frame that was prepared by all methods in all ways, and hands each row to `see`. False if a table had no room.
    pub fn draw_all_ways(&mut self, step: u16, mut see: impl FnMut(&[Rgb565])) -> bool {
        let Self { frame, row, tables: Tables { duff, quadratic, gouraud, flat, ladder, plan }, .. } = self;
        let (picture, row) = (frame.picture(), &mut row.pixels);
        let scene = if step < CALIBRATE { "calibrate" } else { "check" };
        let mut fits = duff.draw(picture, row, [scene, "duff-barycentric"], &mut see)
            & quadratic.draw(picture, row, [scene, "quadratic-intensity"], &mut see)
            & gouraud.draw(picture, row, [scene, "gouraud"], &mut see)
            & flat.draw(picture, row, [scene, "flat"], &mut see);
        for (rung, name) in ["degrading-0", "degrading-1", "degrading-2", "degrading-3"].into_iter().enumerate() {
            // A facet is too dear on each rung above.
            let dear = |above: bool| Price(Work { facets: above.into(), ..Work::NONE });
            plan.make(ladder.scanner.start(picture), &[dear(rung > 0), dear(rung > 1), dear(rung > 2), dear(false)], 0);
            fits &= ladder.draw(plan.degrade(picture), row, [scene, name], &mut see);
        }
        fits
    }
}

/// What a line has to do, and has at most; the edges that are long are the same.
fn say(_name: [&str; 2], _way: &str, _works: impl Fn() -> (Work, Work)) {
    #[cfg(feature = "host")]
    {
        let (work, most) = _works();
        let work = Work { long: if work.walked > 0 { most.long } else { 0 }, ..work };
        let text = |work: Work| work.counts().map(|count| std::format!("{count}")).join(" ");
        let [scene, method] = _name;
        std::println!("{scene} {method} {_way} {} {}", text(work), text(most));
    }
}

const _: () = assert!(LIGHTS == 1, "prices are those of one light");
