//! A panel with memory of its own behind a bus, and what a turn of the teapot takes on it.

use std::convert::Infallible;
use std::ops::Range;

use anyhow::Result;
use beamshade::{Changes, DuffBarycentric, Light, LightSource, Lines, Scanner, Sent, Shade};
use embedded_graphics::pixelcolor::{IntoStorage, Rgb565};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;

use crate::library::{self, Meshes};
use crate::scenes;

/// Set the columns, the rows, and write from the top left corner of both.
const CASET: u8 = 0x2a;
const RASET: u8 = 0x2b;
const RAMWR: u8 = 0x2c;

/// A panel as ST7789, ILI9341 and GC9A01 are: Rgb565 in a memory that is written through a window, both told by bytes.
///
/// Panics on whatever leaves the memory.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Pixels in a row, and rows.
    pub size: [usize; 2],
    /// Its pixels, row by row, high byte first.
    pub memory: Vec<[u8; 2]>,
    /// Bytes that came over the bus.
    pub bytes: u64,
    /// Windows that were written into.
    pub windows: u64,
    command: u8,
    parameters: Vec<u8>,
    /// First and last column, first and last row.
    window: [[usize; 2]; 2],
    /// The next column and row.
    place: [usize; 2],
}

impl Panel {
    /// A panel whose memory holds this all over.
    #[must_use]
    pub fn new(size: [usize; 2], noise: [u8; 2]) -> Self {
        let memory = vec![noise; size[0] * size[1]];
        Self { size, memory, bytes: 0, windows: 0, command: 0, parameters: vec![], window: [[0; 2]; 2], place: [0; 2] }
    }

    /// Takes a command byte.
    pub fn command(&mut self, command: u8) {
        self.bytes += 1;
        self.command = command;
        self.parameters.clear();
        if command == RAMWR {
            self.windows += 1;
            self.place = self.window.map(|[first, _]| first);
        }
    }

    /// Takes bytes of data.
    pub fn data(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.bytes += 1;
            self.parameters.push(*byte);
            match (self.command, &self.parameters[..]) {
                (CASET | RASET, &[a, b, c, d]) => {
                    let axis = usize::from(self.command == RASET);
                    let range = [[a, b], [c, d]].map(|word| u16::from_be_bytes(word).into());
                    assert!(range[0] <= range[1] && range[1] < self.size[axis], "{range:?} of {:?}", self.size);
                    self.window[axis] = range;
                }
                (RAMWR, &[high, low]) => {
                    self.write([high, low]);
                    self.parameters.clear();
                }
                (CASET | RASET | RAMWR, _) => {}
                (command, _) => panic!("no command of a picture's is {command:#x}"),
            }
        }
    }

    fn write(&mut self, pixel: [u8; 2]) {
        let [x, y] = &mut self.place;
        assert!(*y <= self.window[1][1], "more pixels than the window has");
        self.memory[*y * self.size[0] + *x] = pixel;
        *x += 1;
        if *x > self.window[0][1] {
            (*x, *y) = (self.window[0][0], *y + 1);
        }
    }

    /// Sets a window, to be written into.
    pub fn open(&mut self, columns: Range<usize>, rows: Range<usize>) {
        for (command, range) in [(CASET, columns), (RASET, rows)] {
            self.command(command);
            self.data([range.start, range.end - 1].map(|place| (place as u16).to_be_bytes()).as_flattened());
        }
        self.command(RAMWR);
    }

    /// Shows what changed, as a program does that pulls lines.
    pub fn pull<S: Shade<LIGHTS, L>, const LINES: usize, const ACTIVE: usize, const LIGHTS: usize, L: LightSource>(
        &mut self,
        lines: &mut Lines<'_, '_, ACTIVE, S, LIGHTS, L>,
        changes: &mut Changes<LINES>,
        mut finish: impl FnMut(u16, &mut [[u8; 2]]),
    ) {
        let height = self.size[1];
        let mut row = vec![[0; 2]; self.size[0]];
        for y in 0..height as u16 {
            let Some(strip) = changes.line(y, lines.covered(y)) else { continue };
            let columns = strip.columns.range();
            lines.line(y, &mut row[..columns.end]);
            finish(y, &mut row[..columns.end]);
            if strip.opens {
                self.open(columns.clone(), y.into()..height);
            }
            self.data(row[columns].as_flattened());
        }
    }
}

impl OriginDimensions for Panel {
    fn size(&self) -> Size {
        Size::new(self.size[0] as u32, self.size[1] as u32)
    }
}

impl DrawTarget for Panel {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, _: I) -> Result<(), Infallible> {
        panic!("pixels one by one")
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb565>>(&mut self, area: &Rectangle, colors: I) -> Result<(), Infallible> {
        let range = |range: Range<i32>| range.start as usize..range.end as usize;
        self.open(range(area.columns()), range(area.rows()));
        for color in colors.into_iter().take((area.size.width * area.size.height) as usize) {
            self.data(&color.into_storage().to_be_bytes());
        }
        Ok(())
    }
}

/// Of one frame.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Bytes on the bus.
    pub bytes: u64,
    /// Windows set.
    pub windows: u64,
    /// What the library counted.
    pub sent: Sent,
    /// Pixels on the glass that are not those of the whole frame.
    pub wrong: usize,
}

/// The standard scene T880 in a panel, all frames and the first one again, each sent as what changed: the first one whole.
///
/// # Errors
/// If the mesh cannot be read.
pub fn turn(mut changes: Changes<240>, glass: impl Fn(usize, usize) -> bool) -> Result<Vec<Step>> {
    let mesh = scenes::teapot_880()?;
    let meshes = Meshes::of(&scenes::standard(&mesh, scenes::ORANGE, 0))?;
    let mut panel = Panel::new([240, 240], [0x5a, 0xa5]);
    let mut scanner = Box::<Scanner<256, DuffBarycentric>>::default();
    let step = |frame| {
        let scene = scenes::standard(&mesh, scenes::ORANGE, frame);
        library::frame::<_, 1, Light>(&scene, &meshes, |picture| {
            (panel.bytes, panel.windows) = (0, 0);
            panel.pull(&mut scanner.start(picture), &mut changes, |_, _| ());
            let whole = library::read::<[u8; 2], _, 256, 1, _>(&mut scanner.start(picture)).color;
            let wrong = (0..whole.len()).filter(|i| glass(i % 240, i / 240) && panel.memory[*i] != whole[*i]).count();
            Step { bytes: panel.bytes, windows: panel.windows, sent: changes.take_sent(), wrong }
        })
    };
    (0..=scenes::FRAMES).map(step).collect()
}

/// Whether a pixel's middle lies in the circle that fills a square picture.
#[must_use]
pub fn is_in_circle(x: usize, y: usize, diameter: usize) -> bool {
    let square = |place: usize| (2 * place + 1).abs_diff(diameter).pow(2);
    square(x) + square(y) <= diameter * diameter
}
