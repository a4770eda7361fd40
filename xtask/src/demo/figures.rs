//! What the pictures took, and what a program needs for them.

use crate::table;
use beamshade::{Frame, Line, Picture, Scanner, Shade};
use beamshade_mesh::Report;
use embedded_graphics::{geometry::Size, pixelcolor::Rgb565};
use std::time::Duration;

/// What the pictures took.
#[derive(Debug, Default)]
pub(super) struct Figures {
    frames: u32,
    time: Duration,
    /// Visible spans and facets of all frames.
    spans: u64,
    facets: u64,
    /// Most triangles that face the eye in a frame; most places that they take; most that cross a line; most spans on a line.
    facing: usize,
    places: usize,
    active: u16,
    line_spans: u16,
    /// Triangles left out, most in a frame.
    dropped: u16,
}

impl Figures {
    /// Takes note of a line.
    pub(super) fn line(&mut self, line: &Line) {
        self.spans += u64::from(line.spans);
        self.facets += u64::from(line.facets);
        self.active = self.active.max(line.active);
        self.line_spans = self.line_spans.max(line.spans);
        self.dropped = self.dropped.max(line.dropped);
    }

    /// Takes note of a frame, after its lines.
    pub(super) fn frame(&mut self, picture: &Picture<'_, '_>, time: Duration) {
        self.frames += 1;
        self.time += time;
        self.facing = self.facing.max(picture.triangles());
        self.places = self.places.max(picture.places());
    }

    /// Prints them as a table.
    pub(super) fn print(&self, head: &[&str; 2], mesh: &Report) {
        let frames = self.frames.max(1);
        let count = |number: u64| table::number(number);
        let mean = |sum: u64| count(sum.div_ceil(u64::from(frames)));
        let mut rows = vec![
            ("vertices", count(mesh.vertices as u64)),
            ("triangles", count(mesh.triangles as u64)),
            ("facing the eye, worst frame", count(self.facing as u64)),
            ("places that they take, pairs one", count(self.places as u64)),
            ("places on one line, worst", count(self.active.into())),
            ("visible spans on one line, worst", count(self.line_spans.into())),
            ("visible spans, mean frame", mean(self.spans)),
            ("facets set up, mean frame", mean(self.facets)),
            ("mesh in flash, bytes", count(mesh.flash as u64)),
            ("time on this machine, mean frame", format!("{:.2} ms", self.time.as_secs_f64() * 1e3 / f64::from(frames))),
        ];
        if self.dropped > 0 {
            rows.push(("LEFT OUT for want of room, worst frame", count(self.dropped.into())));
        }
        table::print(head, rows.into_iter().map(|(what, value)| vec![what.to_owned(), value]).collect());
    }

    /// Prints the types that a program needs for these pictures, and their bytes.
    pub(super) fn print_needs<S: Shade<1>>(&self, vertices: usize, size: Size) {
        let Self { places, active, .. } = *self;
        let Size { width, height } = size;
        let method = std::any::type_name::<S>().rsplit("::").next().unwrap_or_default();
        let frame = frame_bytes(vertices, places, height as usize);
        let scanner = scanner_bytes::<S>(active.into());
        let rows = 2 * width as usize * size_of::<Rgb565>();
        let bytes = |bytes: usize| format!("{:>7} bytes", table::number(bytes as u64));
        println!("A program needs for these pictures:");
        println!("    {:<36} // {}", format!("Frame::<{vertices}, {places}, {height}>"), bytes(frame));
        println!("    {:<36} // {}", format!("Scanner::<{active}, {method}>"), bytes(scanner));
        println!("    {:<36} // {}", format!("[[Rgb565; {width}]; 2]"), bytes(rows));
        println!("    {:<36} // {}\n", "in all", bytes(frame + scanner + rows));
    }
}

/// `size_of::<Frame<V, T, L>>()` for numbers known only now, but for some padding: what it holds of each is in proportion.
fn frame_bytes(vertices: usize, triangles: usize, lines: usize) -> usize {
    const NONE: usize = size_of::<Frame<'_, 0, 0, 0>>();
    let per = |some: usize| (some - NONE) / 1024;
    let (vertex, triangle) = (per(size_of::<Frame<'_, 1024, 0, 0>>()), per(size_of::<Frame<'_, 0, 1024, 0>>()));
    let line = per(size_of::<Frame<'_, 0, 0, 1024>>());
    NONE + (vertices * vertex + triangles * triangle + lines * line).next_multiple_of(align_of::<Frame<'_, 0, 0, 0>>())
}

/// The same for `size_of::<Scanner<ACTIVE, S>>()`, again but for some padding.
fn scanner_bytes<S: Shade<1>>(active: usize) -> usize {
    let none = size_of::<Scanner<0, S>>();
    let each = (size_of::<Scanner<1024, S>>() - none) / 1024;
    none + (active * each).next_multiple_of(align_of::<Scanner<0, S>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use beamshade::{DuffBarycentric, Flat};

    #[test]
    fn sizes_are_those_of_the_types() {
        assert!(frame_bytes(481, 470, 240).abs_diff(size_of::<Frame<'_, 481, 470, 240>>()) <= align_of::<Frame<'_, 0, 0, 0>>());
        assert!(scanner_bytes::<DuffBarycentric>(61).abs_diff(size_of::<Scanner<61>>()) <= align_of::<Scanner<61>>());
        assert!(scanner_bytes::<Flat>(62).abs_diff(size_of::<Scanner<62, Flat>>()) <= align_of::<Scanner<62, Flat>>());
    }
}
