//! All shading methods in one picture, their errors in another, and transparent surfaces in a third.

use std::convert::Infallible;

use crate::project::{self, progress};
use anyhow::Result;
use beamshade::{Light, Scanner};
use embedded_graphics::mono_font::{ascii::FONT_8X13, MonoTextStyle};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::{Baseline, Text};
use host_tests::accuracy::METHODS;
use host_tests::image;
use host_tests::library::{self, Meshes};
use host_tests::reference::{render, Camera, Material, Options, Scene};
use host_tests::scenes::{self, Case, Illumination, Subject, ORANGE};
use host_tests::{shapes, Picture};

/// Draw docs/methods.png, all shading methods side by side, and docs/errors.png, how far each is from the f64 reference, eightfold.
///
/// A tile has the teapot of the standard scene, a sphere of 80 triangles, and one triangle with a highlight inside. And
/// docs/transparent.png: a pane before the teapot, two through it, and a teapot of glass around a ball.
#[derive(clap::Args)]
pub(crate) struct Arguments {}

/// What is seen in a tile: what it shows, its size in pixels, and the part of its height that is cut off at top and bottom.
const VIEWS: [(Subject, usize, usize); 3] = [(Subject::T880, 240, 24), (Subject::I80, 120, 0), (Subject::Triangle, 120, 0)];
/// Where these are in the tile.
const PLACES: [Point; 3] = [Point::new(0, LABEL), Point::new(0, LABEL + 192), Point::new(120, LABEL + 192)];
/// Height of a label.
pub(crate) const LABEL: i32 = 16;
const TILE: Size = Size::new(240, LABEL as u32 + 192 + 120);
/// How much errors are enlarged.
const FACTOR: u32 = 8;

/// `cargo xtask gallery`.
///
/// # Errors
/// If a scene cannot be drawn, or a picture not be written.
pub(crate) fn run() -> Result<()> {
    transparent()?;
    let tiles = METHODS.len() as u32 + 1;
    let mut methods = Canvas::new(TILE, tiles);
    let mut errors = Canvas::new(TILE, tiles);
    methods.label(0, "f64 reference");
    errors.label(0, "f64 reference");
    for (tile, method) in (1..).zip(METHODS) {
        methods.label(tile, method.name);
        errors.label(tile, method.name);
    }
    for (&(subject, size, cut), place) in VIEWS.iter().zip(PLACES) {
        let mesh = subject.mesh()?;
        let case = Case { subject, light: Illumination::Directional, exponent: 32 };
        let mut scene = case.scene(&mesh, 0);
        resize(&mut scene, size);
        scene.objects[0].materials = vec![Material { exponent: case.exponent.into(), ..ORANGE }];
        let meshes = Meshes::of(&scene)?;
        let truth = render(&scene, Options::default()).round::<Rgb888>();
        methods.show(0, place, &truth, cut);
        for (tile, method) in (1..).zip(METHODS) {
            progress(format!("{}, {}", subject.name(), method.name));
            let drawn = (method.color)(&scene, &meshes)?;
            methods.show(tile, place, &drawn, cut);
            errors.show(tile, place, &difference(&truth, &drawn), cut);
        }
    }
    methods.write("methods")?;
    errors.write("errors")
}

/// Draws docs/transparent.png.
fn transparent() -> Result<()> {
    let mut canvas = Canvas::new(TILE, 3);
    canvas.label(0, "f64 reference");
    canvas.label(1, "transparent_line");
    canvas.label(2, &format!("how far apart, times {FACTOR}"));
    let (teapot, pane, ball) = (scenes::teapot_880()?, shapes::pane(), shapes::icosphere(3));
    let scenes = [
        scenes::with_panes(&teapot, &pane, &[scenes::BEFORE]),
        scenes::with_panes(&teapot, &pane, &scenes::THROUGH),
        scenes::of_glass(&teapot, &ball),
    ];
    for ((mut scene, (_, size, cut)), place) in scenes.into_iter().zip(VIEWS).zip(PLACES) {
        resize(&mut scene, size);
        let truth = render(&scene, Options::default()).round::<Rgb888>();
        let (drawn, _) = library::frame::<_, 1, Light>(&scene, &Meshes::of(&scene)?, |picture| {
            library::read_transparent(&mut Scanner::<1024>::new().start(picture))
        })?;
        for (tile, picture) in (0..).zip([&truth, &drawn, &difference(&truth, &drawn)]) {
            canvas.show(tile, place, picture, cut);
        }
    }
    canvas.write("transparent")
}

/// The same scene in a picture of `size` × `size` pixels.
fn resize(scene: &mut Scene<'_>, size: usize) {
    let Camera { height, focal, .. } = scene.camera;
    scene.camera = Camera { width: size, height: size, focal: focal * size as f64 / height as f64, ..scene.camera };
}

/// How far two pictures are apart, enlarged; black where they show different triangles.
fn difference(truth: &Picture<Rgb888>, drawn: &Picture<Rgb888>) -> Picture<Rgb888> {
    let mut difference = drawn.clone();
    let owners = truth.owner.iter().zip(&drawn.owner);
    for ((pixel, truth), (owner, other)) in difference.color.iter_mut().zip(&truth.color).zip(owners) {
        let apart = |a: u8, b: u8| (u32::from(a.abs_diff(b)) * FACTOR).min(255) as u8;
        let all = Rgb888::new(apart(pixel.r(), truth.r()), apart(pixel.g(), truth.g()), apart(pixel.b(), truth.b()));
        *pixel = if owner == other { all } else { Rgb888::BLACK };
    }
    difference
}

/// Tiles in rows.
pub(crate) struct Canvas {
    tile: Size,
    pub(crate) picture: Picture<Rgb888>,
}

impl Canvas {
    /// Pixels between tiles.
    const GAP: u32 = 8;
    /// Tiles in a row.
    const COLUMNS: u32 = 4;

    /// So many tiles of that size.
    pub(crate) fn new(tile: Size, tiles: u32) -> Self {
        let Size { width, height } = tile + Size::new_equal(Self::GAP);
        let (columns, rows) = (Self::COLUMNS.min(tiles), tiles.div_ceil(Self::COLUMNS));
        let size = Size::new(columns * width, rows * height) + Size::new_equal(Self::GAP);
        Self { tile, picture: Picture::blank(size.width as usize, size.height as usize, Rgb888::CSS_BLACK) }
    }

    /// The top left corner of a tile.
    fn tile(&self, number: u32) -> Point {
        let step = self.tile + Size::new_equal(Self::GAP);
        Point::new_equal(Self::GAP as i32) + step.component_mul(Size::new(number % Self::COLUMNS, number / Self::COLUMNS))
    }

    /// Writes at the top of a tile.
    pub(crate) fn label(&mut self, tile: u32, text: &str) {
        let style = MonoTextStyle::new(&FONT_8X13, Rgb888::WHITE);
        let Ok(_) = Text::with_baseline(text, self.tile(tile), style, Baseline::Top).draw(self);
    }

    fn write(&self, name: &str) -> Result<()> {
        let path = project::root().join("docs").join(name).with_extension("png");
        image::write(&path, &self.picture)?;
        println!("{}", project::shown(&path));
        Ok(())
    }

    /// Puts a picture there, without `cut` of its rows at top and bottom.
    pub(crate) fn show(&mut self, tile: u32, place: Point, picture: &Picture<Rgb888>, cut: usize) {
        let size = Size::new(picture.width as u32, (picture.height - 2 * cut) as u32);
        let area = Rectangle::new(self.tile(tile) + place, size);
        let Ok(()) = self.fill_contiguous(&area, picture.color[cut * picture.width..].iter().copied());
    }
}

impl OriginDimensions for Canvas {
    fn size(&self) -> Size {
        Size::new(self.picture.width as u32, self.picture.height as u32)
    }
}

impl DrawTarget for Canvas {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let inside = self.bounding_box();
        for Pixel(Point { x, y }, color) in pixels.into_iter().filter(|Pixel(point, _)| inside.contains(*point)) {
            self.picture.color[y as usize * self.picture.width + x as usize] = color;
        }
        Ok(())
    }
}
