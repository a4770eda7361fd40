//! A model that turns before the camera.

use super::figures::Figures;
use anyhow::Result;
use beamshade::{Camera, Light, Lines, Mesh, Pose, Rotation, Scanner, Shade, Turn};
use embedded_graphics::pixelcolor::{raw::ToBytes, Rgb888};
use embedded_graphics::prelude::*;
use image::RgbImage;
use std::time::Instant;

/// Room on a PC: as many vertices, triangles and lines as there can be, and triangles on a line.
type Frame<'m> = beamshade::Frame<'m, 0xffff, 0x7fff, { LARGEST as usize }, 1, 1>;
const ACTIVE: usize = 8192;
/// The largest width and height of a picture.
pub(super) const LARGEST: u32 = 1024;

/// A model on a turntable, the standard scene's camera and light, and the memory of the renderer.
pub(super) struct Turntable<'m, S: Shade<1>> {
    mesh: &'m Mesh<'m>,
    camera: Camera,
    light: Light,
    frame: Box<Frame<'m>>,
    scanner: Box<Scanner<ACTIVE, S>>,
}

impl<'m, S: Shade<1>> Turntable<'m, S> {
    /// The model about the origin, seen from that far away.
    pub(super) fn new(mesh: &'m Mesh<'m>, size: Size, distance: f32) -> Self
    where
        S::Facet: Send,
    {
        Self {
            mesh,
            camera: Camera::new(size).field_of_view(field_of_view(size)).at_distance(distance),
            light: Light::directional([-0.5, 0.7, 0.6]),
            frame: boxed(),
            scanner: boxed(),
        }
    }

    /// The lines of the picture at that angle.
    pub(super) fn lines(&mut self, angle: Turn) -> Result<Lines<'_, '_, ACTIVE, S>> {
        let pose = Pose::turned(Rotation::x(Turn::degrees(25)) * Rotation::y(angle));
        self.frame.begin(&self.camera, &[self.light])?;
        self.frame.add(self.mesh, &pose)?;
        Ok(self.scanner.start(self.frame.picture()))
    }

    /// The picture at that angle, line by line as a display would take it; `figures` takes note of what it took.
    pub(super) fn picture(&mut self, angle: Turn, figures: &mut Figures) -> Result<RgbImage> {
        let begin = Instant::now();
        let mut lines = self.lines(angle)?;
        let Size { width, height } = lines.viewport().size;
        let mut row = vec![Rgb888::BLACK; width as usize];
        let mut bytes = Vec::new();
        for y in 0..height as u16 {
            figures.line(&lines.line(y, &mut row));
            bytes.extend(row.iter().flat_map(|pixel| pixel.to_be_bytes()));
        }
        figures.frame(&self.frame.picture(), begin.elapsed());
        Ok(RgbImage::from_raw(width, height, bytes).expect("as many bytes as rows and columns"))
    }
}

/// Something large, made on a stack of its own: without optimisation it is moved from there to the heap.
fn boxed<T: Default + Send>() -> Box<T> {
    std::thread::scope(|scope| {
        let maker = std::thread::Builder::new().stack_size(64 << 20).spawn_scoped(scope, Box::default);
        maker.expect("there is room for a thread").join().expect("making it does not panic")
    })
}

/// The vertical field of view that spans 40° on the shorter side.
fn field_of_view(Size { width, height }: Size) -> Turn {
    if width >= height {
        return Turn::degrees(40);
    }
    let half_width = 20_f32.to_radians().tan();
    Turn::radians(2.0 * (half_width * height as f32 / width as f32).atan())
}

#[cfg(test)]
mod tests {
    use super::*;
    use beamshade::DuffBarycentric;
    use beamshade_mesh::{Model, Options};

    #[test]
    fn the_model_is_in_the_middle_whatever_the_shape_of_the_picture() {
        let teapot = crate::project::root().join("examples/models/teapot-880.obj");
        let model = Model::load(teapot, &Options::default()).unwrap().quantize().unwrap();
        let mesh = model.mesh();
        for (width, height) in [(40, 40), (20, 60), (60, 20)] {
            let mut turntable = Turntable::<DuffBarycentric>::new(&mesh, Size::new(width, height), 3.0);
            let picture = turntable.picture(Turn(0), &mut Figures::default()).unwrap();
            assert_eq!(picture.dimensions(), (width, height));
            assert_ne!(picture.get_pixel(width / 2, height / 2).0, [0; 3]);
            let border = picture.enumerate_pixels().filter(|&(x, y, _)| x % (width - 1) == 0 || y % (height - 1) == 0);
            assert!(border.map(|(_, _, pixel)| pixel.0).all(|color| color == [0; 3]));
        }
    }
}
