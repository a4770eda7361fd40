//! Visibility: the one-line z-buffer.

use super::{
    active::Active,
    geometry::Geometry,
    list::ActiveList,
    table::{Span, Table},
    visibility::{wins, Visibility},
};

/// The one-line z-buffer: a depth and an owner for each of `WIDTH` pixels, six bytes each.
///
/// Triangles are drawn into it one after the other; spans are the runs of pixels of one owner. A line of more than `WIDTH` pixels
/// is resolved piece by piece, with a pass over its triangles for each: so any `WIDTH` above 0 gives the same picture.
///
/// ```
/// use beamshade::{DepthLine, DuffBarycentric, Light, Scanner};
///
/// type DepthScanner = Scanner<96, DuffBarycentric, 1, Light, DepthLine<320>>;
/// # assert!(size_of::<DepthScanner>() <= size_of::<Scanner<96>>() + 6 * 320 + 8);
/// ```
#[derive(Clone, Debug)]
pub struct DepthLine<const WIDTH: usize> {
    /// What is seen at each pixel: 2³¹ more than its depth.
    depths: [u32; WIDTH],
    /// And one more than the place of its triangle in the list. Zeros between one line and the next, as the depths are: behind
    /// whatever comes.
    owners: [u16; WIDTH],
}

impl<const WIDTH: usize> Visibility for DepthLine<WIDTH> {
    const NEW: Self = {
        assert!(WIDTH > 0, "a line has pixels");
        Self { depths: [0; WIDTH], owners: [0; WIDTH] }
    };

    #[inline(always)]
    fn resolve<const N: usize, const L: usize>(
        &mut self,
        line: u16,
        width: i32,
        list: &mut ActiveList<N>,
        geometry: &Geometry<'_, '_, L>,
        mut see: impl FnMut(&[Span], &mut [Active; N]),
    ) {
        let (extents, slots) = list.split();
        let mut table = Table::default();
        let mut from = 0;
        while from < width {
            let piece = [from, width.min(from + WIDTH as i32)];
            let used = self.draw(piece, line, extents, slots, geometry);
            let (depths, owners) = (self.depths.get_mut(..used), self.owners.get_mut(..used));
            let (depths, owners) = (depths.unwrap_or_default(), owners.unwrap_or_default());
            let mut rest = &*owners;
            while let [owner, ..] = rest {
                let length = rest.iter().position(|other| other != owner).unwrap_or(rest.len());
                let place = usize::from(*owner);
                rest = rest.get(length..).unwrap_or_default();
                let start = from;
                from += length as i32;
                let Some(extent) = extents.get(place.wrapping_sub(1)) else { continue };
                let span = extent.with(start, from);
                if !table.resume(span) {
                    see(table.spans(), slots);
                    table.clear();
                    table.push(span);
                }
            }
            depths.fill(0);
            owners.fill(0);
            let [_, end] = piece;
            from = end;
        }
        if !table.spans().is_empty() {
            see(table.spans(), slots);
        }
    }
}

impl<const WIDTH: usize> DepthLine<WIDTH> {
    /// Draws the triangles into the pixels from there to there. Returns how many of them, from the first, may show one.
    #[inline(never)]
    fn draw<const N: usize, const L: usize>(
        &mut self,
        [from, end]: [i32; 2],
        line: u16,
        extents: &[Span],
        slots: &mut [Active; N],
        geometry: &Geometry<'_, '_, L>,
    ) -> usize {
        let mut used = 0;
        for (extent, owner) in extents.iter().zip(1..) {
            if !extent.starts_before(end) {
                break;
            }
            let Some(active) = slots.get_mut(usize::from(extent.slot())) else { continue };
            for (half, span) in [0, 1].into_iter().zip(extent.halves(active.middle().into())) {
                let start = span.start().max(from);
                let range = (start - from).max(0) as usize..(span.end().min(end) - from).max(0) as usize;
                let Some(depths) = self.depths.get_mut(range.clone()).filter(|depths| !depths.is_empty()) else { continue };
                let Some(owners) = self.owners.get_mut(range.clone()) else { continue };
                let Some(active) = slots.get_mut(usize::from(extent.slot())) else { continue };
                if active.depths.get(half).is_some_and(|depth| !depth.is_known()) {
                    active.deepen(half, geometry);
                }
                let Some(plane) = active.depths.get(half) else { continue };
                let (id, step) = (active.id(half), plane.step() as u32);
                let mut depth = (plane.at(start, line) as u32).wrapping_add(1 << 31);
                let wins_against = |owner: u16, x: i32| {
                    let extent = extents.get(usize::from(owner).wrapping_sub(1));
                    let seen = extent.and_then(|extent| slots.get(usize::from(extent.slot())));
                    seen.is_none_or(|active| wins(id, active.id(usize::from(i32::from(active.middle()) <= x)), geometry))
                };
                for ((nearest, seen), x) in depths.iter_mut().zip(owners).zip(start..) {
                    if depth >= *nearest && (depth > *nearest || wins_against(*seen, x)) {
                        (*nearest, *seen) = (depth, owner);
                    }
                    depth = depth.wrapping_add(step);
                }
                used = used.max(range.end);
            }
        }
        used
    }
}
