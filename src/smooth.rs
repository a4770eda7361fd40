//! Lines with anti-aliased silhouettes.

use core::ops::Range;

use heapless::Vec;

use crate::{
    model::{light::LightSource, material::Color},
    scan::{edge::Edge, list::ActiveList, silhouette::Silhouette, table::Span, visibility::Visibility},
    scanner::{Line, Lines},
    seen::Seen,
    shade::Shade,
    sink::{ink::Ink, row::Row},
};

/// Edges that are smoothed on one line; those right of them stay as they are.
const EDGES: usize = 24;

/// Pixels blended at once.
const PIECE: usize = 8;

impl<const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource, V: Visibility>
    Lines<'_, '_, ACTIVE, S, LIGHTS, L, V>
{
    /// As [`line`](Lines::line), with the edges that end a surface blended with what is seen behind them, by the area of the pixel
    /// that they leave (*Faster Phong Shading*, §3.6), and so the lines where surfaces cut each other. An edge between two triangles of
    /// one surface stays as it is.
    ///
    /// A pixel is blended before it becomes ink, and stored once. Behind an edge lies what is seen next to it, shaded as far as
    /// the edge reaches. What falls between the centres of two lines stays missed, and so does an edge over
    /// [`Background::Keep`](crate::Background::Keep), whose colours are not known. Shallow edges reach beyond what is
    /// [`covered`](Lines::covered). Takes 8 bytes of stack for each of `ACTIVE`
    /// spans, and about 1 kB; a line of more spans than that stays as it is, and so do pixels that [do not blend](Ink::BLENDS).
    /// [Transparent](crate::Material::opacity) triangles are opaque in it.
    #[inline(never)]
    pub fn smooth_line<P: Ink>(&mut self, y: u16, row: &mut [P]) -> Line {
        if !self.seek(y) {
            return self.none();
        }
        let width = self.width().min(row.len());
        let mut spans = Vec::new();
        let (line, until) = self.gather(y, 0..width, &mut spans);
        if until < width || !P::BLENDS {
            return self.line(y, row);
        }
        let background = self.background(y);
        let cuts = Edges { list: self.list(), y }.cuts(&spans, width, background.is_some());
        let row = Row::new(row.get_mut(..width).unwrap_or_default(), background);
        let mut smoothing = Smoothing { seen: self.seen(y), spans: &spans, row };
        let (mut cuts, mut x) = (cuts.as_slice(), 0);
        for span in &spans {
            let Range { start, end } = span.range();
            smoothing.store(x..start, None, &mut cuts);
            smoothing.store(start..end, Some(span), &mut cuts);
            x = end;
        }
        smoothing.store(x..width, None, &mut cuts);
        smoothing.row.finish();
        line
    }
}

/// An edge that ends a surface, and the pixels that it cuts.
#[derive(Clone, Copy, Debug)]
struct Cut {
    edge: Silhouette,
    from: u16,
    to: u16,
    /// The first pixel that shows what is right of it.
    at: u16,
    /// The spans on both sides; none for the background.
    sides: [Option<u16>; 2],
}

/// The triangles that cross a line, and the edges at which spans end.
struct Edges<'a, const ACTIVE: usize> {
    list: &'a ActiveList<ACTIVE>,
    y: u16,
}

impl<const ACTIVE: usize> Edges<'_, ACTIVE> {
    /// The edges that end a surface, each between two spans, or a span and the background.
    fn cuts(&self, spans: &[Span], width: usize, over_background: bool) -> Vec<Cut, EDGES> {
        let mut cuts = Vec::<Cut, EDGES>::new();
        let mut add = |edge: Option<Silhouette>, at: i32, sides: [Option<u16>; 2]| {
            let Some(edge) = edge else { return };
            let at = at as u16;
            let [mut from, to] = edge.pixels().map(|pixel| pixel.clamp(0, width as i32) as u16);
            if let Some(last) = cuts.last_mut() {
                last.to = last.to.min(at);
                from = from.max(last.to);
            }
            // What has no room stays as it is.
            let _ = cuts.push(Cut { edge, from, to: to.max(from), at, sides });
        };
        let mut before: Option<(u16, Span)> = None;
        for (place, span) in (0..).map(Some).zip(spans.iter().copied().map(Some).chain([None])) {
            let met = before.zip(span).is_some_and(|((_, last), span)| last.end() == span.start());
            if let Some(((last_place, last), span)) = before.zip(span).filter(|_| met) {
                let [left, right] = [self.own(last, true), self.own(span, false)];
                let is_inside = matches!((left, right), (Some(left), Some(right)) if left.is_near(right));
                if !is_inside {
                    let [left, right] = [self.end(last, true), self.end(span, false)];
                    let is_behind = right.is_some() && self.nearness(last) < self.nearness(span);
                    let edge = if is_behind { right } else { left.or(right) };
                    let edge = edge.or_else(|| self.crossing(last, span));
                    add(edge, span.start(), [Some(last_place), place]);
                }
            } else if over_background {
                if let Some((last_place, last)) = before {
                    add(self.end(last, true), last.end(), [Some(last_place), None]);
                }
                if let Some(span) = span {
                    add(self.end(span, false), span.start(), [None, place]);
                }
            }
            before = place.zip(span);
        }
        cuts
    }

    /// How near a triangle is as a whole.
    fn nearness(&self, span: Span) -> i32 {
        self.list.get(span.slot()).map_or(0, |active| active.reach().iter().sum())
    }

    /// Where the surfaces seen in two spans that meet cut each other.
    fn crossing(&self, left: Span, right: Span) -> Option<Silhouette> {
        let pair = [self.list.get(left.slot())?, self.list.get(right.slot())?];
        Silhouette::crossing(pair, right.start() - 1, self.y)
    }

    /// An edge of the triangle that is seen in a span, if the span ends there.
    fn own(&self, span: Span, is_right: bool) -> Option<&Edge> {
        let [left, right] = self.list.get(span.slot())?.sides();
        let (edge, at) = if is_right { (right, span.end()) } else { (left, span.start()) };
        (i32::from(edge.x()) == at).then_some(edge)
    }

    /// The edge that ends the surface seen in a span, beyond triangles too thin to cover a pixel; none if the surface goes on,
    /// behind what is seen next.
    fn end(&self, span: Span, is_right: bool) -> Option<Silhouette> {
        let mut edge = self.own(span, is_right)?;
        for _ in 0..ACTIVE {
            let at = i32::from(edge.x());
            let near = |other: &&Span| at == if is_right { other.start() } else { other.end() };
            let next = self.list.extents().iter().filter(near).find_map(|other| {
                let [left, right] = self.list.get(other.slot())?.sides();
                let (near, far) = if is_right { (left, right) } else { (right, left) };
                near.is_near(edge).then_some((other.is_empty(), far))
            });
            match next {
                None => return Some(Silhouette::new(edge)),
                Some((true, far)) => edge = far,
                Some((false, ..)) => return None,
            }
        }
        None
    }
}

/// A line on its way into a row.
struct Smoothing<'a, 'f, 'm, 'r, P, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource> {
    seen: Seen<'a, 'f, 'm, S, ACTIVE, LIGHTS, L>,
    spans: &'a [Span],
    row: Row<'r, P>,
}

impl<P: Ink, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource>
    Smoothing<'_, '_, '_, '_, P, S, ACTIVE, LIGHTS, L>
{
    /// Stores pixels that show a span, or the background, and what cuts them.
    fn store(&mut self, pixels: Range<usize>, span: Option<&Span>, cuts: &mut &[Cut]) {
        let Range { start: mut x, end } = pixels;
        while x < end {
            let cut = loop {
                match *cuts {
                    [cut, rest @ ..] if usize::from(cut.to) <= x => *cuts = rest,
                    [cut, ..] => break Some(cut),
                    [] => break None,
                }
            };
            let from = cut.map_or(end, |cut| usize::from(cut.from).min(end));
            match cut {
                Some(cut) if from <= x => {
                    let is_left = x < usize::from(cut.at);
                    let mut to = end.min(cut.to.into()).min(x + PIECE);
                    if is_left {
                        to = to.min(cut.at.into());
                    }
                    let [left, right] = cut.sides;
                    let other = if is_left { right } else { left }.and_then(|place| self.spans.get(usize::from(place)));
                    let (mut here, mut there) = ([Color::BLACK; PIECE], [Color::BLACK; PIECE]);
                    self.seen.colors(span, x, here.get_mut(..to - x).unwrap_or_default());
                    self.seen.colors(other, x, there.get_mut(..to - x).unwrap_or_default());
                    let [left, right] = if is_left { [here, there] } else { [there, here] };
                    let pixels = self.row.span(x, to).unwrap_or_default().iter_mut().zip(x as i32..);
                    for ((pixel, x), (left, right)) in pixels.zip(left.into_iter().zip(right)) {
                        *pixel = P::plain(left.mixed(right, cut.edge.right(x)));
                    }
                    x = to;
                }
                _ => {
                    if let Some(span) = span {
                        self.seen.shade(span, x, self.row.span(x, from).unwrap_or_default());
                    }
                    x = from;
                }
            }
        }
    }
}
