//! Whole frames to an embedded-graphics display.

use embedded_graphics::{draw_target::DrawTarget, geometry::Size, pixelcolor::PixelColor, primitives::Rectangle};

use super::ink::Ink;
use crate::{model::light::LightSource, scan::visibility::Visibility, scanner::Lines, shade::Shade};

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
