//! Whole frames: one is shown while the next one is made, and a slow one leaves the last one on the screen.

use crate::{
    scene::{self, Geometry, Method, ACTIVE, TEAPOTS},
    vga::{HEIGHT, WIDTH},
};
use beamshade::{Frozen, Scanner};
use embedded_graphics::pixelcolor::Rgb565;
use heapless::spsc::{Consumer, Producer, Queue};

/// Room for a frame's spans, on all lines.
const SPANS: usize = if cfg!(feature = "heavy") { 6656 } else { 2560 };

/// A frame's spans, and the facets of its visible triangles.
pub type Table = Frozen<'static, SPANS, { TEAPOTS * 440 }, { HEIGHT as usize }, Method>;
type Way = Queue<&'static mut Table, 2>;

/// All the memory.
pub struct Memory {
    geometry: Geometry,
    scanner: Scanner<ACTIVE, Method>,
    tables: [Table; 2],
    finished: Way,
    free: Way,
}

impl Memory {
    /// Empty.
    pub const NEW: Memory = Memory {
        geometry: Geometry::new(),
        scanner: Scanner::new(),
        tables: [const { Table::new() }; 2],
        finished: Queue::new(),
        free: Queue::new(),
    };

    /// What shows frames, in the interrupt, and what makes them.
    pub fn split(&'static mut self) -> (Show, Make) {
        let Memory { geometry, scanner, tables: [shown, spare], finished, free } = self;
        let ((mut put, take), (give, next)) = (free.split(), finished.split());
        let _ = put.enqueue(spare);
        (Show { shown, finished: next, free: put }, Make { geometry, scanner, free: take, finished: give })
    }
}

/// The frame that is shown.
pub struct Show {
    shown: &'static mut Table,
    finished: Consumer<'static, &'static mut Table>,
    free: Producer<'static, &'static mut Table>,
}

impl Show {
    /// Shades a row. Before the first one of a picture the next frame takes over, if there is one.
    pub fn row(&mut self, y: u16, row: &mut [Rgb565; WIDTH]) -> bool {
        if y == 0 {
            if let Some(next) = self.finished.dequeue() {
                let _ = self.free.enqueue(core::mem::replace(&mut self.shown, next));
            }
        }
        self.shown.line(y, row);
        true
    }
}

/// The frame that is made.
pub struct Make {
    geometry: &'static mut Geometry,
    scanner: &'static mut Scanner<ACTIVE, Method>,
    free: Consumer<'static, &'static mut Table>,
    finished: Producer<'static, &'static mut Table>,
}

impl Make {
    /// Makes frames for ever.
    pub fn run(self) -> ! {
        let Make { geometry, scanner, mut free, mut finished } = self;
        scene::prepare(geometry);
        let mut step = 0;
        loop {
            scene::describe(geometry, step);
            let table = loop {
                match free.dequeue() {
                    Some(table) => break table,
                    None => cortex_m::asm::wfi(),
                }
            };
            // What has no room is left out here too.
            let _ = table.take(scanner.start(geometry.picture()));
            let _ = finished.enqueue(table);
            step += 1;
        }
    }
}
