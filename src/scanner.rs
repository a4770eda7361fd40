//! From a picture to the pixels of line y.

use embedded_graphics::primitives::Rectangle;

use crate::{
    model::material::{Color, Material},
    scan::{
        list::ActiveList,
        picture::{Background, Picture, Source, Triangle},
        resolve::Sweep,
        table::{Span, Table},
    },
    shade::{duff_barycentric::DuffBarycentric, Shade, Surface},
    sink::ink::Ink,
};

/// The state of a walk down a picture: up to `ACTIVE` triangles that cross one line, each with a facet of the shading method.
///
/// Owns its memory: about 116 bytes for each active triangle with the default method and one light.
#[derive(Clone, Debug)]
pub struct Scanner<const ACTIVE: usize, S: Shade<LIGHTS> = DuffBarycentric, const LIGHTS: usize = 1> {
    list: ActiveList<ACTIVE>,
    facets: [S::Facet; ACTIVE],
    table: Table<ACTIVE>,
}

impl<const ACTIVE: usize, S: Shade<LIGHTS>, const LIGHTS: usize> Scanner<ACTIVE, S, LIGHTS> {
    /// A scanner at rest.
    #[must_use]
    pub const fn new() -> Self {
        Self { list: ActiveList::new(), facets: [S::EMPTY; ACTIVE], table: Table::new() }
    }

    /// Starts on a picture, above its first line.
    pub fn start<'s>(&'s mut self, picture: Picture<'s, LIGHTS>) -> Lines<'s, ACTIVE, S, LIGHTS> {
        // The walk to the first line asked for clears the list.
        Lines { scanner: self, picture, line: None, dropped: 0 }
    }
}

impl<const ACTIVE: usize, S: Shade<LIGHTS>, const LIGHTS: usize> Default for Scanner<ACTIVE, S, LIGHTS> {
    fn default() -> Self {
        Self::new()
    }
}

/// What a line was made of, and what had no room.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Line {
    /// Triangles that cross it.
    pub active: u16,
    /// Visible spans; pieces that clipping made of one triangle count apart.
    pub spans: u16,
    /// Facets set up on it.
    pub facets: u16,
    /// Of those, facets whose normals bend beyond what shading follows exactly: u above 63/64 at an edge's middle or the centroid.
    pub bent: u16,
    /// Triangles left out for want of room, on this and all lines above: of those that cross a line, the ones whose nearest
    /// corner is farthest.
    pub dropped: u16,
}

/// The lines of one picture, in any order; from top to bottom is fastest.
#[derive(Debug)]
pub struct Lines<'s, const ACTIVE: usize, S: Shade<LIGHTS> = DuffBarycentric, const LIGHTS: usize = 1> {
    scanner: &'s mut Scanner<ACTIVE, S, LIGHTS>,
    picture: Picture<'s, LIGHTS>,
    /// The line that the active list stands on.
    line: Option<u16>,
    dropped: u16,
}

impl<const ACTIVE: usize, S: Shade<LIGHTS>, const LIGHTS: usize> Lines<'_, ACTIVE, S, LIGHTS> {
    /// Where the picture lies on the panel, and its size.
    #[must_use]
    pub const fn viewport(&self) -> Rectangle {
        self.picture.viewport()
    }

    /// Shades line y into the row: every pixel up to the picture's width stored once, from left to right; a shorter row takes
    /// what fits. A y below the picture leaves the row alone.
    ///
    /// The next line costs a step of each active triangle; a later one that for each line in between, without shading; an
    /// earlier one the walk from the top again. The pixels are the same in whatever order.
    pub fn line<P: Ink>(&mut self, y: u16, row: &mut [P]) -> Line {
        if !self.seek(y) {
            return Line { dropped: self.dropped, ..Line::default() };
        }
        let width = self.picture.width().min(row.len() as i32);
        let mut line = Line { active: self.scanner.list.len() as u16, dropped: self.dropped, ..Line::default() };
        let mut sweep = Sweep::new(y, width);
        let mut from = 0;
        while sweep.fill(&mut self.scanner.list, &self.picture, &mut self.scanner.table) {
            from = self.shade_table(y, from, row, &mut line);
        }
        fill_background(&self.picture, y, row, from, width);
        line
    }

    /// The spans of line y with the triangles seen in them, left to right, handed to `see` one by one.
    pub fn spans(&mut self, y: u16, mut see: impl FnMut(core::ops::Range<u16>, Source)) {
        if !self.seek(y) {
            return;
        }
        let mut sweep = Sweep::new(y, self.picture.width());
        while sweep.fill(&mut self.scanner.list, &self.picture, &mut self.scanner.table) {
            for span in &self.scanner.table {
                let source = self.scanner.list.get(span.slot).and_then(|active| self.picture.source(active.id));
                if let Some(source) = source {
                    see(span.start..span.end, source);
                }
            }
        }
    }

    /// Brings the active list to line y; false if the picture has no such line.
    fn seek(&mut self, y: u16) -> bool {
        if y >= self.picture.height() {
            return false;
        }
        let mut line = match self.line {
            Some(line) if line <= y => line,
            _ => {
                self.scanner.list.clear();
                self.dropped = self.scanner.list.enter(0, &self.picture);
                0
            }
        };
        while line < y {
            line += 1;
            self.dropped = self.dropped.saturating_add(self.scanner.list.advance(line, &self.picture));
        }
        self.line = Some(y);
        true
    }

    /// Shades the table's spans, and the background before each; returns where the last one ends.
    fn shade_table<P: Ink>(&mut self, y: u16, mut from: i32, row: &mut [P], line: &mut Line) -> i32 {
        let Scanner { list, facets, table } = &mut *self.scanner;
        let picture = &self.picture;
        let mut last: Option<(&Material, P::Paint<'_>)> = None;
        for &Span { start, end, slot } in table.iter() {
            fill_background(picture, y, row, from, i32::from(start));
            from = i32::from(end);
            line.spans += 1;
            let (Some(active), Some(facet)) = (list.get_mut(slot), facets.get_mut(usize::from(slot))) else { continue };
            let Some(pixels) = row.get_mut(usize::from(start)..usize::from(end)) else { continue };
            let Some(material) = picture.material(active.look) else { continue };
            let surface = Surface { material, intensities: picture.intensities };
            if !active.shaded {
                let Some(triangle) = picture.triangle(active.id) else { continue };
                let triangle = if active.turned { triangle.turned() } else { triangle };
                *facet = S::facet(&triangle, &surface);
                active.shaded = true;
                line.facets += 1;
                line.bent += u16::from(is_bent(&triangle));
            }
            if !last.as_ref().is_some_and(|(same, _)| core::ptr::eq(*same, material)) {
                last = Some((material, P::paint(material)));
            }
            let Some((_, paint)) = &last else { continue };
            shade::<P, S, LIGHTS>(facet, &surface, paint, i32::from(start), i32::from(y), pixels);
        }
        from
    }
}

/// Fills pixels with the background.
fn fill_background<P: Ink, const LIGHTS: usize>(picture: &Picture<'_, LIGHTS>, y: u16, row: &mut [P], from: i32, to: i32) {
    if from >= to {
        return;
    }
    let color = match picture.background {
        Background::Plain(color) => color,
        Background::Gradient { top, bottom } => between(top, bottom, y, picture.height()),
        Background::Keep => return,
    };
    if let Some(pixels) = row.get_mut(from as usize..to as usize) {
        pixels.fill(P::plain(color));
    }
}

/// Shades one span.
#[inline(never)]
fn shade<P: Ink, S: Shade<LIGHTS>, const LIGHTS: usize>(
    facet: &S::Facet,
    surface: &Surface<'_, LIGHTS>,
    paint: &P::Paint<'_>,
    x: i32,
    y: i32,
    pixels: &mut [P],
) {
    S::run(S::start(facet, x, y), surface, pixels, |intensity| P::mix(paint, intensity));
}

/// Whether `u = 1 − |N|²` passes 63/64 in the middle of an edge (e/2) or at the centroid (2/9 of the sum), e being Q15.
fn is_bent<const LIGHTS: usize>(triangle: &Triangle<LIGHTS>) -> bool {
    const MOST: u32 = (1 << 15) * 63 / 64;
    let edges = triangle.edges.map(u32::from);
    edges.iter().any(|e| *e > 2 * MOST) || 2 * edges.iter().sum::<u32>() > 9 * MOST
}

/// The colour of a gradient on line y.
fn between(top: Color, bottom: Color, y: u16, height: u16) -> Color {
    let steps = u32::from(height.saturating_sub(1)).max(1);
    let (y, rest) = (u32::from(y), steps - u32::from(y).min(steps));
    let mut color = top;
    for (to, from) in color.0.iter_mut().zip(bottom.0) {
        *to = ((u32::from(*to) * rest + u32::from(from) * y + steps / 2).checked_div(steps).unwrap_or(0)) as u16;
    }
    color
}
