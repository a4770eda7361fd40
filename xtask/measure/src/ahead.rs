//! T880 drawn by way of tables that are made ahead of the beam, or by a plan: of each line one side is marked.

use embedded_graphics::pixelcolor::Rgb565;

use super::{Scene, HEIGHT};
use crate::mark;

/// A line's spans.
#[cfg(any(feature = "baking", feature = "shading"))]
type Line = beamshade::Baked<'static, 64, super::Shading>;
/// A picture's.
#[cfg(feature = "frozen")]
type Whole = beamshade::Frozen<'static, 4096, 448, HEIGHT, super::Shading>;
/// How far down the ladder its lines go.
#[cfg(feature = "planned")]
type Plan = beamshade::Plan<HEIGHT>;

/// The tables, and the plan.
#[derive(Debug)]
pub(super) struct Tables {
    #[cfg(any(feature = "baking", feature = "shading"))]
    baked: Line,
    #[cfg(feature = "frozen")]
    frozen: Whole,
    #[cfg(feature = "planned")]
    plan: Plan,
}

impl Tables {
    pub(super) const fn new() -> Self {
        Self {
            #[cfg(any(feature = "baking", feature = "shading"))]
            baked: Line::new(),
            #[cfg(feature = "frozen")]
            frozen: Whole::new(),
            #[cfg(feature = "planned")]
            plan: Plan::new(),
        }
    }
}

impl Scene {
    /// Draws the frame that was prepared, and hands each row to `see`. False if a table had no room.
    pub fn draw_ahead(&mut self, mut see: impl FnMut(&[Rgb565])) -> bool {
        let Self { frame, scanner, row, tables, .. } = self;
        let picture = frame.picture();
        #[cfg(feature = "frozen")]
        let fits = tables.frozen.take(scanner.start(picture)).left_out == 0;
        #[cfg(not(feature = "frozen"))]
        let mut fits = true;
        #[cfg(feature = "planned")]
        let picture = {
            // For the cycles of a doubled line of VGA.
            tables.plan.make(scanner.start(picture), &beamshade::Price::M0_PLUS_DEGRADING, 8000);
            tables.plan.degrade(picture)
        };
        #[cfg(not(feature = "frozen"))]
        let mut lines = scanner.start(picture);
        for y in 0..HEIGHT as u16 {
            #[cfg(feature = "shading")]
            let line = lines.bake(y, &mut tables.baked);
            mark::line();
            #[cfg(feature = "baking")]
            let line = lines.bake(y, &mut tables.baked);
            #[cfg(feature = "shading")]
            tables.baked.shade(row);
            #[cfg(feature = "frozen")]
            tables.frozen.line(y, row);
            #[cfg(feature = "planned")]
            let line = lines.line(y, row);
            mark::pause();
            #[cfg(feature = "baking")]
            tables.baked.shade(row);
            #[cfg(not(feature = "frozen"))]
            {
                fits &= line.dropped == 0 && line.left_out == 0;
            }
            see(row);
        }
        fits
    }
}
