//! What of a frame is sent to a panel that has memory of its own.

use embedded_graphics::primitives::Rectangle;

use super::round::Round;
use crate::scan::columns::Columns;

/// Lines that a window is planned ahead.
const AHEAD: usize = 16;

/// What a panel with memory of its own shows beside the background, line by line, and so what of the next frame is to be sent.
///
/// Of each line that is what the last frame or this one covers; all else is background, there and here. Lines of much the same
/// columns share a window, see [`window_price`](Self::window_price). The first frame is sent whole.
///
/// That the background stays is assumed: who changes it, moves the picture, or draws into it by other means, asks for a
/// [`refresh`](Self::refresh); who changes a part of it, as an overlay, [touches](Self::touch) that. Pixels are the same
/// as if whole frames were sent.
///
/// [`Lines::draw_changes`](crate::Lines::draw_changes) does all for an embedded-graphics display. Or pull:
///
/// ```
/// # use beamshade::{Camera, Frame, Scanner};
/// # use embedded_graphics::prelude::*;
/// use beamshade::Changes;
/// # let mut frame = Frame::<8, 8, 240>::new();
/// # let mut scanner = Scanner::<8>::new();
/// # frame.begin(&Camera::new(Size::new(240, 240)), &[beamshade::Light::OFF])?;
/// # fn wait_for_the_tearing_effect_pin() {}
/// # fn set_window(_: core::ops::Range<usize>, _: core::ops::Range<u16>) {}
/// # fn write(_: &[u8]) {}
///
/// let mut changes = Changes::<240>::new(240); // lines, columns
/// let mut row = [[0u8; 2]; 240];
///
/// // Each frame:
/// let mut lines = scanner.start(frame.picture());
/// wait_for_the_tearing_effect_pin();
/// for y in 0..240 {
///     let Some(strip) = changes.line(y, lines.covered(y)) else { continue }; // nothing to shade, nothing to send
///     lines.line(y, &mut row[..strip.columns.range().end]);
///     if strip.opens {
///         set_window(strip.columns.range(), y..240); // the column range, the row range, "memory write"
///     }
///     write(row[strip.columns.range()].as_flattened());
/// }
/// let sent = changes.take_sent();
/// assert_eq!(sent.bytes(2), 240 * 240 * 2 + 11);
/// # Ok::<(), beamshade::Full>(())
/// ```
///
/// A window is opened down to the last line, and is left when the next one is opened: what it still has room for keeps its pixels.
///
/// # The tearing-effect pin
///
/// A panel reads its memory line by line to light the glass. Where this passes the line that is being written, one part of the
/// glass shows the new frame and the other the old one. Lines go out from top to bottom, so all that is needed is when to
/// start: before the first line is pulled, or before `draw_changes`. Nothing here waits; the program does, on the pin that the
/// panel raises between two scans (`TearingEffect::Vertical` of mipidsi's `set_tearing_effect`).
///
/// - If the changed lines take less time than a scan, start where the pin rises: writing stays ahead of the scan.
/// - If they take longer, but less than two scans, start where it falls, and send each line after the scan has passed it: the next
///   scan does not catch up. As unchanged lines take no time, the first ones may have to wait: line y for y/lines of a scan.
///
/// A scan follows the lines of the memory, not a rotation set by MADCTL:
/// [`Camera::panel_turned`](crate::Camera::panel_turned) turns the picture instead.
#[derive(Clone, Debug)]
pub struct Changes<const LINES: usize> {
    /// Of each line, the columns where the panel does not show what it would without triangles.
    stale: [Columns; LINES],
    /// Whether that is known.
    known: bool,
    width: u16,
    round: Option<Round>,
    /// Of a window, in pixels.
    price: u32,
    window: Columns,
    /// The line with which the window would go on.
    next: Option<u16>,
    /// Pixels sent in the window that need not have been.
    waste: u32,
    sent: Sent,
}

/// What is to be sent of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Strip {
    /// Its columns: those of the window.
    pub columns: Columns,
    /// Whether a window is to be set first: of these columns, from this line down to the last one.
    pub opens: bool,
}

/// What went over the bus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sent {
    /// Windows set.
    pub windows: u32,
    /// Pixels sent.
    pub pixels: u32,
    /// Pixels of the picture that were not.
    pub saved: u32,
}

impl Sent {
    /// What setting a window takes on ST7789, ILI9341 and GC9A01: CASET and RASET of five bytes each, RAMWR of one.
    pub const WINDOW_BYTES: u32 = 11;

    /// Bytes sent, with so many for a pixel, and [`WINDOW_BYTES`](Self::WINDOW_BYTES) for a window.
    #[must_use]
    pub const fn bytes(self, pixel: u32) -> u32 {
        self.windows.wrapping_mul(Self::WINDOW_BYTES).wrapping_add(self.pixels.wrapping_mul(pixel))
    }
}

impl<const LINES: usize> Changes<LINES> {
    /// Of a picture of so many columns, nothing known yet. Lines from `LINES` on are sent always.
    #[must_use]
    pub const fn new(width: u16) -> Self {
        let (stale, sent) = ([Columns::NONE; LINES], Sent { windows: 0, pixels: 0, saved: 0 });
        let window = Columns::NONE;
        Self { stale, known: false, width, round: None, price: 5, window, next: None, waste: 0, sent }
    }

    /// Of a picture that fills a round panel, whose corners are never sent.
    ///
    /// A line handed a row up to its strip's end is not shaded right of it; what is left of it is.
    #[must_use]
    pub const fn round(diameter: u16) -> Self {
        Self { round: Some(Round::new(diameter)), ..Self::new(diameter) }
    }

    /// The price of a window, in pixels: a window is shared as long as all that is sent in it needlessly is at most that.
    ///
    /// From the start 5, as 11 bytes are at two for a pixel. More if setting one takes the program long.
    #[must_use]
    pub const fn window_price(self, pixels: u16) -> Self {
        Self { price: pixels as u32, ..self }
    }

    /// Has the next frame sent whole.
    pub fn refresh(&mut self) {
        self.stale.fill(Columns::ALL);
        self.known = true;
    }

    /// Has an area sent with the next frame, counted from the picture's top left corner.
    pub fn touch(&mut self, area: &Rectangle) {
        let cut = |x: i32| x.clamp(0, u16::MAX.into()) as u16;
        let (columns, rows) = (area.columns(), area.rows());
        let columns = Columns { start: cut(columns.start), end: cut(columns.end) };
        let (top, bottom) = (usize::from(cut(rows.start)), usize::from(cut(rows.end)));
        for stale in self.stale.iter_mut().take(bottom).skip(top) {
            *stale = stale.hull(columns);
        }
    }

    /// What is to be sent of line y, of which the new frame [covers](crate::Lines::covered) these columns; from now on the panel
    /// is taken to show it.
    pub fn line(&mut self, y: u16, covered: Columns) -> Option<Strip> {
        if !self.known {
            self.refresh();
        }
        let stale = self.stale.get_mut(usize::from(y)).map_or(Columns::ALL, |stale| core::mem::replace(stale, covered));
        let visible = self.visible(y);
        let columns = stale.hull(covered).within(visible);
        if columns.is_empty() {
            self.next = None;
            self.sent.saved = self.sent.saved.wrapping_add(self.width.into());
            return None;
        }
        let unused = |window: Columns| u32::from(window.len() - columns.len());
        let goes_on =
            self.next == Some(y) && self.window.hull(columns) == self.window && self.waste + unused(self.window) <= self.price;
        if !goes_on {
            self.window = self.plan(y, stale.within(visible), columns);
            self.waste = 0;
            self.sent.windows = self.sent.windows.wrapping_add(1);
        }
        self.next = y.checked_add(1);
        self.waste += unused(self.window);
        self.sent.pixels = self.sent.pixels.wrapping_add(self.window.len().into());
        self.sent.saved = self.sent.saved.wrapping_add(self.width.saturating_sub(self.window.len()).into());
        Some(Strip { columns: self.window, opens: !goes_on })
    }

    /// What was sent since this was asked last.
    pub fn take_sent(&mut self) -> Sent {
        core::mem::take(&mut self.sent)
    }

    /// No columns from there on are sent any more.
    pub(super) fn cut(&mut self, width: u16) {
        self.width = self.width.min(width);
    }

    /// The columns of a line that are seen.
    fn visible(&self, y: u16) -> Columns {
        let whole = Columns { start: 0, end: self.width };
        self.round.map_or(whole, |round| round.columns(y).within(whole))
    }

    /// The window to open on line y for these columns, wide enough for lines below where that wastes no more than its price.
    ///
    /// Of those lines what is stale is known; what the frame covers there is expected to reach as far beyond as on line y.
    fn plan(&self, y: u16, stale: Columns, columns: Columns) -> Columns {
        let (left, right) = match stale.is_empty() {
            true => (0, 0),
            false => (stale.start - columns.start, columns.end - stale.end),
        };
        let (mut window, mut lines, mut waste) = (columns, 1, 0);
        let below = y.saturating_add(1);
        for (stale, y) in self.stale.iter().skip(below.into()).take(AHEAD).zip(below..=u16::MAX) {
            let visible = self.visible(y);
            let stale = stale.within(visible);
            if stale.is_empty() {
                break;
            }
            let expected =
                Columns { start: stale.start.saturating_sub(left), end: stale.end.saturating_add(right) }.within(visible);
            let wider = window.hull(expected);
            waste += lines * u32::from(wider.len() - window.len()) + u32::from(wider.len() - expected.len());
            if waste > self.price {
                break;
            }
            window = wider;
            lines += 1;
        }
        window
    }
}
