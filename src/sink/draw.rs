//! Frames to an embedded-graphics display.

use embedded_graphics::{
    draw_target::DrawTarget,
    geometry::{Point, Size},
    pixelcolor::PixelColor,
    primitives::Rectangle,
};

use super::{
    changes::{Changes, Strip},
    ink::Ink,
};
use crate::{
    model::light::LightSource,
    scan::{columns::Columns, visibility::Visibility},
    scanner::Lines,
    shade::Shade,
};

impl<const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource, V: Visibility>
    Lines<'_, '_, ACTIVE, S, LIGHTS, L, V>
{
    /// Draws the whole picture, shading into the row again and again, by one
    /// [`fill_contiguous`](DrawTarget::fill_contiguous). A row shorter than the picture cuts off its right side.
    ///
    /// # Errors
    /// Those of the display.
    pub fn draw<P: Ink + PixelColor, D: DrawTarget<Color = P>>(
        &mut self,
        row: &mut [P],
        display: &mut D,
    ) -> Result<(), D::Error> {
        self.draw_finished(row, display, |_, _| ())
    }

    /// As [`draw`](Self::draw), with a last hand on each row before it goes out: `finish` gets the number of the line and its
    /// pixels; [`Overlay::blit`](super::overlay::Overlay::blit) is made for it.
    ///
    /// # Errors
    /// Those of the display.
    pub fn draw_finished<P: Ink + PixelColor, D: DrawTarget<Color = P>>(
        &mut self,
        row: &mut [P],
        display: &mut D,
        finish: impl FnMut(u16, &mut [P]),
    ) -> Result<(), D::Error> {
        let viewport = self.viewport();
        let width = (viewport.size.width as usize).min(row.len());
        let row = row.get_mut(..width).unwrap_or_default();
        let area = Rectangle::new(viewport.top_left, Size::new(width as u32, viewport.size.height));
        let pixels = Pixels { lines: self, finish, row, x: width, y: 0 };
        display.fill_contiguous(&area, pixels)
    }

    /// Draws what changed since the last frame, as [`draw_finished`](Self::draw_finished) does all: by one
    /// [`fill_contiguous`](DrawTarget::fill_contiguous) for each window, down to the picture's last line, with fewer pixels than
    /// it has room for. The display must leave the others alone. Rows come up to the end of what is sent of them.
    ///
    /// # Errors
    /// Those of the display; the next frame is then sent whole.
    pub fn draw_changes<P: Ink + PixelColor, D: DrawTarget<Color = P>, const LINES: usize>(
        &mut self,
        row: &mut [P],
        changes: &mut Changes<LINES>,
        display: &mut D,
        finish: impl FnMut(u16, &mut [P]),
    ) -> Result<(), D::Error> {
        let Rectangle { top_left, size } = self.viewport();
        let height = size.height as u16;
        changes.cut(size.width.min(row.len() as u32) as u16);
        let mut strips = Strips { lines: self, changes, finish, row, height, y: 0, rest: Columns::NONE, opens: false };
        strips.fetch();
        while strips.opens {
            let Columns { start, end } = strips.rest;
            let line = strips.y - 1;
            let area = Rectangle::new(
                top_left + Point::new(start.into(), line.into()),
                Size::new((end - start).into(), (height - line).into()),
            );
            strips.opens = false;
            let result = display.fill_contiguous(&area, &mut strips);
            if result.is_err() {
                strips.changes.refresh();
                return result;
            }
            // What a display does not take is out of its sight.
            strips.by_ref().for_each(drop);
        }
        Ok(())
    }
}

/// The pixels that changed, window after window: none where one ends, until the next one is no longer marked as to be opened.
struct Strips<
    'r,
    'l,
    'm,
    P,
    F,
    const LINES: usize,
    const ACTIVE: usize,
    S: Shade<LIGHTS, L>,
    const LIGHTS: usize,
    L: LightSource,
    V: Visibility,
> {
    lines: &'r mut Lines<'l, 'm, ACTIVE, S, LIGHTS, L, V>,
    changes: &'r mut Changes<LINES>,
    finish: F,
    row: &'r mut [P],
    height: u16,
    /// The next line.
    y: u16,
    /// What is left of the row.
    rest: Columns,
    /// Whether it begins a window.
    opens: bool,
}

impl<
        P: Ink,
        F: FnMut(u16, &mut [P]),
        const LINES: usize,
        const ACTIVE: usize,
        S: Shade<LIGHTS, L>,
        const LIGHTS: usize,
        L: LightSource,
        V: Visibility,
    > Strips<'_, '_, '_, P, F, LINES, ACTIVE, S, LIGHTS, L, V>
{
    /// Shades the next line of which something is to be sent; no columns are left if there is none.
    fn fetch(&mut self) {
        while self.y < self.height {
            let y = self.y;
            self.y += 1;
            let Some(Strip { columns, opens }) = self.changes.line(y, self.lines.covered(y)) else { continue };
            let row = self.row.get_mut(..columns.range().end).unwrap_or_default();
            self.lines.line(y, row);
            (self.finish)(y, row);
            (self.rest, self.opens) = (columns, opens);
            break;
        }
    }
}

impl<
        P: Ink,
        F: FnMut(u16, &mut [P]),
        const LINES: usize,
        const ACTIVE: usize,
        S: Shade<LIGHTS, L>,
        const LIGHTS: usize,
        L: LightSource,
        V: Visibility,
    > Iterator for Strips<'_, '_, '_, P, F, LINES, ACTIVE, S, LIGHTS, L, V>
{
    type Item = P;

    #[inline]
    fn next(&mut self) -> Option<P> {
        if self.rest.is_empty() {
            self.fetch();
        }
        if self.opens || self.rest.is_empty() {
            return None;
        }
        let pixel = self.row.get(usize::from(self.rest.start)).copied();
        self.rest.start += 1;
        pixel
    }
}

/// The pixels of a picture, row after row.
struct Pixels<'r, 'l, 'm, P, F, const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource, V: Visibility> {
    lines: &'r mut Lines<'l, 'm, ACTIVE, S, LIGHTS, L, V>,
    finish: F,
    row: &'r mut [P],
    x: usize,
    /// The next line.
    y: u16,
}

impl<
        P: Ink,
        F: FnMut(u16, &mut [P]),
        const ACTIVE: usize,
        S: Shade<LIGHTS, L>,
        const LIGHTS: usize,
        L: LightSource,
        V: Visibility,
    > Iterator for Pixels<'_, '_, '_, P, F, ACTIVE, S, LIGHTS, L, V>
{
    type Item = P;

    #[inline]
    fn next(&mut self) -> Option<P> {
        if self.x >= self.row.len() {
            if u32::from(self.y) >= self.lines.viewport().size.height {
                return None;
            }
            self.lines.line(self.y, self.row);
            (self.finish)(self.y, self.row);
            self.y += 1;
            self.x = 0;
        }
        let pixel = self.row.get(self.x).copied();
        self.x += 1;
        pixel
    }
}
