//! Lines that transparent triangles cross.

use core::ops::Range;

use heapless::Vec;

use crate::{
    model::{
        light::LightSource,
        material::{Color, Material},
    },
    scan::{
        geometry::{Geometry, Source},
        table::Span,
        visibility::Visibility,
    },
    scanner::{Line, Lines},
    seen::Seen,
    shade::Shade,
    sink::{ink::Ink, row::Row},
};

/// Pixels blended at once.
const PIECE: usize = 32;

impl<const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource, V: Visibility>
    Lines<'_, '_, ACTIVE, S, LIGHTS, L, V>
{
    /// As [`line`](Lines::line), with [transparent](crate::Material::opacity) triangles blended with what is behind them.
    ///
    /// A line that one crosses is resolved twice: with all of its triangles, and with the opaque ones. Where a transparent one is the
    /// nearest of all, the second tells what is behind it; so there is one order for both, crossings and ties included. A pixel is
    /// blended before it becomes ink, and stored once.
    ///
    /// Over [`Background::Keep`](crate::Background::Keep), whose colours are not known, a transparent triangle is opaque, and so it is
    /// in pixels that [do not blend](Ink::BLENDS). Takes 24 bytes of stack for each of `ACTIVE` spans, and about 1 kB.
    #[inline(never)]
    pub fn transparent_line<P: Ink>(&mut self, y: u16, row: &mut [P]) -> Line {
        if !self.seek(y) {
            return self.none();
        }
        let is_transparent = transparent(self.picture().geometry);
        if !P::BLENDS || !self.list().extents().iter().any(is_transparent) {
            return self.line(y, row);
        }
        let (mut x, width) = (0, self.width().min(row.len()));
        let mut row = Row::new(row.get_mut(..width).unwrap_or_default(), self.background(y));
        let mut counts = self.none();
        let (mut all, mut opaque) = (Vec::new(), Vec::new());
        let mut pieces = [[Color::BLACK; PIECE]; 2];
        while x < width {
            // Where there are more spans than room, what is left comes next.
            let (behind, until) = self.without_transparent(|lines| lines.gather(y, x..width, &mut opaque));
            let (front, until) = self.gather(y, x..until, &mut all);
            let Line { facets, bent, .. } = counts;
            counts = Line { facets: facets + front.facets + behind.facets, bent: bent + front.bent + behind.bent, ..front };
            Blending { front: &all, behind: &opaque, seen: self.seen(y), pieces: &mut pieces }.store(x..until, &mut row);
            x = until;
        }
        row.finish();
        counts
    }

    /// As [`spans`](Lines::spans), behind [transparent](crate::Material::opacity) triangles: the spans of line y in which opaque
    /// triangles would be seen without them.
    pub fn opaque_spans(&mut self, y: u16, see: impl FnMut(Range<u16>, Source)) {
        if self.seek(y) {
            self.without_transparent(|lines| lines.spans(y, see));
        }
    }

    /// What is seen of the line that the list stands on, were there opaque triangles alone.
    fn without_transparent<T>(&mut self, see: impl FnOnce(&mut Self) -> T) -> T {
        let mut is_transparent = transparent(self.picture().geometry);
        let extents = self.list_mut().extents_mut();
        let all = extents.clone();
        extents.retain(|extent| !is_transparent(extent));
        let seen = see(self);
        *self.list_mut().extents_mut() = all;
        seen
    }
}

/// Whether what is behind an extent is seen. Most have the material of the one before.
fn transparent<'f, const LIGHTS: usize>(geometry: Geometry<'f, 'f, LIGHTS>) -> impl FnMut(&Span) -> bool + 'f {
    let mut last = (None, false);
    move |extent| {
        let look = extent.look();
        if last.0 != Some(look) {
            last = (Some(look), geometry.material(look).is_some_and(Material::is_transparent));
        }
        last.1
    }
}

/// A line's spans in front, and the opaque ones, on their way into a row.
struct Blending<'a, 'f, 'm, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource> {
    front: &'a [Span],
    behind: &'a [Span],
    seen: Seen<'a, 'f, 'm, S, ACTIVE, LIGHTS, L>,
    /// Colours of pixels in front, and behind.
    pieces: &'a mut [[Color; PIECE]; 2],
}

impl<S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource> Blending<'_, '_, '_, S, ACTIVE, LIGHTS, L> {
    /// Stores those of the pixels that show a triangle.
    fn store<P: Ink>(mut self, pixels: Range<usize>, row: &mut Row<'_, P>) {
        let Range { start: mut x, end } = pixels;
        while x < end {
            let ((front, to), (behind, until)) = (at(&mut self.front, x), at(&mut self.behind, x));
            let to = to.min(until).min(end);
            if let Some(front) = front {
                self.span(front, behind, x..to, row);
            }
            x = to;
        }
    }

    /// Stores pixels of a span, before another one or the background.
    #[inline(never)]
    fn span<P: Ink>(&mut self, front: &Span, behind: Option<&Span>, pixels: Range<usize>, row: &mut Row<'_, P>) {
        let Range { start: mut x, end } = pixels;
        let Some(pixels) = row.span(x, end) else { return };
        let is_known = behind.is_some() || self.seen.background.is_some();
        let Some(material) = self.seen.material(front).filter(|material| material.is_transparent() && is_known) else {
            return self.seen.shade(front, x, pixels);
        };
        for piece in pixels.chunks_mut(PIECE) {
            let [here, there] = self.pieces.each_mut().map(|colors| colors.get_mut(..piece.len()).unwrap_or_default());
            self.seen.colors(Some(front), x, here);
            self.seen.colors(behind, x, there);
            for (pixel, (here, there)) in piece.iter_mut().zip(here.iter().zip(there)) {
                *pixel = P::plain(there.mixed(*here, material.opacity.into()));
            }
            x += piece.len();
        }
    }
}

/// The span that shows pixel x, if there is one, and where it, or the gap, ends; those left of it are taken off.
fn at<'a>(spans: &mut &'a [Span], x: usize) -> (Option<&'a Span>, usize) {
    while let [span, rest @ ..] = *spans {
        let Range { start, end } = span.range();
        if x < end {
            return if start <= x { (Some(span), end) } else { (None, start) };
        }
        *spans = rest;
    }
    (None, usize::MAX)
}
