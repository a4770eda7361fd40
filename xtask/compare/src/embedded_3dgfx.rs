//! embedded-3dgfx: vertices at whole pixels, a depth buffer of 16 bits.
//!
//! Its Gouraud has no highlight, an ambient term of a tenth of the colour and a diffuse one of all of it; its Blinn–Phong shades whole
//! triangles. So ambient is 0.1 here for 0.15, diffuse 1 for 0.75. Depth is a whole number between the planes' distances, which are
//! chosen for the least errors of visibility.

use core::convert::Infallible;

use embedded_3dgfx::engine::K3dengine;
use embedded_3dgfx::pipeline::command_buffer::CommandBuffer;
use embedded_3dgfx::pipeline::renderer::FrameCtx;
use embedded_3dgfx::pipeline::vertex::mesh::{Geometry, K3dMesh, RenderMode};
use embedded_3dgfx::ZDepth;
use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::Rectangle};
use nalgebra::{Matrix4, Point3, Vector3};

use crate::setting::{BASE, DISTANCE, EXPONENT, LIGHT, SPECULAR};
use crate::teapot::{ACROSS, NORMALS, POSITIONS, ROTATIONS, TRIANGLES};
use crate::{PIXELS, SIZE};

/// Commands of the worst frame: one for each triangle that faces the eye, and one to clear the depth.
const COMMANDS: usize = 491;

/// Distances of the near and the far plane.
const PLANES: (f32, f32) = (0.7, 150.0);

static FACES: [[usize; 3]; TRIANGLES.len()] = {
    let mut all = [[0; 3]; TRIANGLES.len()];
    let mut number = 0;
    while number < TRIANGLES.len() {
        let [a, b, c] = TRIANGLES[number];
        all[number] = [a as usize, b as usize, c as usize];
        number += 1;
    }
    all
};
static VERTICES: [[f32; 3]; POSITIONS.len()] = POSITIONS;
static OF_VERTICES: [[f32; 3]; NORMALS.len()] = NORMALS;
static OF_FACES: [[f32; 3]; ACROSS.len()] = ACROSS;

/// All that drawing needs in RAM.
pub struct Scene {
    target: Target,
    depth: [ZDepth; PIXELS],
    commands: CommandBuffer<COMMANDS>,
}

impl Scene {
    /// What lies in RAM, with its size in bytes.
    pub const RAM: &'static [(&'static str, usize)] = &[
        ("picture", size_of::<Target>()),
        ("depth", size_of::<[ZDepth; PIXELS]>()),
        ("CommandBuffer", size_of::<CommandBuffer<COMMANDS>>()),
        ("K3dengine", size_of::<K3dengine>()),
        ("K3dMesh", size_of::<K3dMesh<'static>>()),
    ];
    /// Bytes of the mesh in flash.
    pub const MESH_BYTES: usize =
        size_of_val(&FACES) + size_of_val(&VERTICES) + size_of_val(&OF_VERTICES) + size_of_val(&OF_FACES);

    /// A scene of which nothing was drawn yet; all zeros, which take no flash.
    pub const fn new() -> Self {
        Self { target: Target([Rgb565::BLACK; PIXELS]), depth: [0; PIXELS], commands: CommandBuffer::new() }
    }

    /// Draws the frame with this place among those that are drawn.
    #[inline(never)]
    pub fn draw(&mut self, frame: usize) {
        self.target.0.fill(Rgb565::BLACK);
        let (engine, mesh) = (engine(), mesh(frame, &FACES, &OF_FACES));
        engine.record(core::iter::once(&mesh), &mut self.commands, None).expect("there is room");
        let mut context = FrameCtx { zbuffer: &mut self.depth, width: SIZE, height: SIZE };
        engine.execute(&mut self.target, &mut context, &self.commands, None).expect("the sizes agree");
    }

    /// The rows of the frame drawn last, one after the other.
    pub fn pixels(&self) -> impl Iterator<Item = Rgb565> + '_ {
        self.target.0.iter().copied()
    }

    /// One more than the number of the triangle that each pixel of a frame shows; 0 for none.
    ///
    /// Each triangle is recorded as a mesh of its own, and drawn with that number for its colour.
    #[cfg(feature = "host")]
    pub fn owners(frame: usize) -> alloc::vec::Vec<u16> {
        use embedded_3dgfx::pipeline::assemble::primitive::DrawPrimitive;
        use embedded_3dgfx::pipeline::command_buffer::RenderCommand;
        use embedded_3dgfx::Z_MAX_VALUE;
        use embedded_graphics::pixelcolor::raw::RawU16;
        let engine = engine();
        let mut all = alloc::boxed::Box::new(CommandBuffer::<COMMANDS>::new());
        all.push(RenderCommand::ClearDepth(Z_MAX_VALUE)).expect("there is room");
        for number in 0..FACES.len() {
            let mut own = CommandBuffer::<4>::new();
            let this = number..number + 1;
            engine
                .record(core::iter::once(&mesh(frame, &FACES[this.clone()], &OF_FACES[this])), &mut own, None)
                .expect("there is room");
            let id = Rgb565::from(RawU16::new(number as u16 + 1));
            for command in own.iter() {
                let mut command = command.clone();
                match &mut command {
                    RenderCommand::Draw(DrawPrimitive::GouraudTriangleWithDepth { colors, .. }) => *colors = [id; 3],
                    RenderCommand::Draw(DrawPrimitive::ColoredTriangleWithDepth { color, .. }) => *color = id,
                    _ => continue,
                }
                all.push(command).expect("there is room");
            }
        }
        let mut target = Target([Rgb565::BLACK; PIXELS]);
        let mut depth = alloc::vec![Z_MAX_VALUE; PIXELS];
        let mut context = FrameCtx { zbuffer: &mut depth, width: SIZE, height: SIZE };
        engine.execute(&mut target, &mut context, &all, None).expect("the sizes agree");
        target.0.iter().map(|pixel| pixel.into_storage()).collect()
    }
}

impl Default for Scene {
    fn default() -> Self {
        Self::new()
    }
}

fn engine() -> K3dengine {
    let mut engine = K3dengine::new(SIZE as u16, SIZE as u16);
    engine.camera.set_fovy(40_f32.to_radians());
    engine.camera.set_near_far(PLANES.0, PLANES.1);
    engine.camera.set_position(Point3::new(0.0, 0.0, DISTANCE));
    engine.camera.set_target(Point3::origin());
    engine
}

fn mesh(frame: usize, faces: &'static [[usize; 3]], normals: &'static [[f32; 3]]) -> K3dMesh<'static> {
    let mut mesh = K3dMesh::new(Geometry::new(&VERTICES, faces).with_normals(normals).with_vertex_normals(&OF_VERTICES));
    let [[a, b, c], [d, e, f], [g, h, i]] = ROTATIONS[frame];
    mesh.model_matrix = Matrix4::new(a, b, c, 0.0, d, e, f, 0.0, g, h, i, 0.0, 0.0, 0.0, 0.0, 1.0);
    let level = |channel: usize, most: u8| (BASE[channel] * f32::from(most) + 0.5) as u8;
    mesh.color = Rgb565::new(level(0, Rgb565::MAX_R), level(1, Rgb565::MAX_G), level(2, Rgb565::MAX_B));
    // It mirrors the light's z itself.
    let light_dir = Vector3::new(LIGHT[0], LIGHT[1], -LIGHT[2]);
    mesh.render_mode = if cfg!(feature = "embedded-3dgfx-gouraud") {
        RenderMode::GouraudLightDir(light_dir)
    } else {
        RenderMode::BlinnPhong { light_dir, specular_intensity: SPECULAR, shininess: EXPONENT }
    };
    mesh
}

/// A picture in RAM.
struct Target([Rgb565; PIXELS]);

impl OriginDimensions for Target {
    fn size(&self) -> Size {
        Size::new_equal(SIZE as u32)
    }
}

impl DrawTarget for Target {
    type Color = Rgb565;
    type Error = Infallible;

    #[inline]
    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(Point { x, y }, color) in pixels {
            // What lies outside to the left or above is huge as an unsigned number.
            if (x as usize) < SIZE && (y as usize) < SIZE {
                self.0[y as usize * SIZE + x as usize] = color;
            }
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: Rgb565) -> Result<(), Infallible> {
        let area = self.bounding_box().intersection(area);
        for y in area.rows() {
            let start = y as usize * SIZE + area.top_left.x as usize;
            self.0[start..start + area.size.width as usize].fill(color);
        }
        Ok(())
    }
}
