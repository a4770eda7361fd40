//! A ring of lines, each prepared a little ahead of the beam: dear ones borrow time from cheap ones.
//!
//! The beam does not wait. A row whose line is not there repeats the one above it and is counted; a line that the beam has passed
//! is skipped, so that those below it are where they belong. With the feature `degrade`, lines that may take longer than a row are
//! shaded by cheaper methods, as planned before the first one is made.

use crate::{
    scene::{self, Geometry, Method, ACTIVE},
    vga::{HEIGHT, WIDTH},
};
use beamshade::{Baked, Plan, Price, Scanner};
use core::sync::atomic::{AtomicU32, Ordering::Relaxed};
use embedded_graphics::pixelcolor::Rgb565;
use heapless::spsc::{Consumer, Producer, Queue};

/// Lines of the ring.
const RING: usize = 16;
/// For how many spans there is room in each.
const SPANS: usize = 72;
/// Refreshes for which a frame is shown: planning it takes up to three of them, for which no line is made.
const REFRESHES: u32 = 12;
/// Cycles of a row.
const PERIOD: u32 = 8000;

/// The row that the interrupt shades, or has shaded last.
static BEAM: AtomicU32 = AtomicU32::new(0);

/// When a row is due: the number of the refresh, and in the lowest 8 bits that of the row.
type Due = u32;

const fn after(due: Due) -> Due {
    if due as u8 as u16 == HEIGHT - 1 {
        (due | 0xff) + 1
    } else {
        due + 1
    }
}

/// A line, and when it is due.
struct Line {
    due: Due,
    spans: Baked<'static, SPANS, Method>,
}

type Way = Queue<&'static mut Line, { RING + 1 }>;

/// All the memory.
pub struct Memory {
    geometry: Geometry,
    scanner: Scanner<ACTIVE, Method>,
    plan: Plan<{ HEIGHT as usize }>,
    lines: [Line; RING],
    baked: Way,
    free: Way,
}

impl Memory {
    /// Empty.
    pub const NEW: Memory = Memory {
        geometry: Geometry::new(),
        scanner: Scanner::new(),
        plan: Plan::new(),
        lines: [const { Line { due: 0, spans: Baked::new() } }; RING],
        baked: Queue::new(),
        free: Queue::new(),
    };

    /// What shows lines, in the interrupt, and what makes them.
    pub fn split(&'static mut self) -> (Show, Make) {
        let Memory { geometry, scanner, plan, lines, baked, free } = self;
        let ((mut put, take), (give, next)) = (free.split(), baked.split());
        for line in lines {
            let _ = put.enqueue(line);
        }
        (Show { due: 0, baked: next, free: put }, Make { geometry, scanner, plan, free: take, baked: give })
    }
}

/// The lines that are there.
pub struct Show {
    due: Due,
    baked: Consumer<'static, &'static mut Line>,
    free: Producer<'static, &'static mut Line>,
}

impl Show {
    /// Shades a row, if its line is there.
    pub fn row(&mut self, y: u16, row: &mut [Rgb565; WIDTH]) -> bool {
        let begins_anew = y <= self.due as u8 as u16;
        self.due = if begins_anew { (self.due | 0xff) + 1 } else { self.due & !0xff } + u32::from(y);
        BEAM.store(self.due, Relaxed);
        while self.baked.peek().is_some_and(|line| line.due <= self.due) {
            let Some(line) = self.baked.dequeue() else { break };
            let is_due = line.due == self.due;
            if is_due {
                line.spans.shade(row);
            }
            let _ = self.free.enqueue(line);
            if is_due {
                return true;
            }
        }
        false
    }
}

/// The lines that are made.
pub struct Make {
    geometry: &'static mut Geometry,
    scanner: &'static mut Scanner<ACTIVE, Method>,
    plan: &'static mut Plan<{ HEIGHT as usize }>,
    free: Consumer<'static, &'static mut Line>,
    baked: Producer<'static, &'static mut Line>,
}

impl Make {
    /// Makes frames for ever.
    pub fn run(self) -> ! {
        let Make { geometry, scanner, plan, mut free, mut baked } = self;
        scene::prepare(geometry);
        let mut due: Due = 0;
        for step in 0.. {
            scene::describe(geometry, step);
            let mut picture = geometry.picture();
            if cfg!(feature = "degrade") {
                plan.make(scanner.start(picture), &Price::M0_PLUS_DEGRADING, PERIOD);
                picture = plan.degrade(picture);
            }
            let mut lines = scanner.start(picture);
            // Meanwhile the beam may have gone on for more than a refresh.
            due = due.max(after(after(BEAM.load(Relaxed))));
            let end = (due & !0xff) + (REFRESHES << 8);
            while due < end {
                let Some(line) = free.dequeue() else {
                    cortex_m::asm::wfi();
                    continue;
                };
                // The next row is too near to be made in time.
                due = due.max(after(after(BEAM.load(Relaxed))));
                line.due = due;
                // What has no room is left out of the picture: there is nobody here to tell.
                let _ = lines.bake(due as u8 as u16, &mut line.spans);
                let _ = baked.enqueue(line);
                due = after(due);
            }
        }
        unreachable!()
    }
}
