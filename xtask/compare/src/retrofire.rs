//! retrofire-core: triangles in single precision with a depth buffer, attributes in correct perspective.
//!
//! Shaders are the application's, written here as its examples are: Phong normalises the interpolated normal and shades at each pixel,
//! Gouraud at each vertex. The exponent of 32 is five products. Sixteen-bit pixels are cut off and not rounded, by retrofire itself.

use embedded_graphics::pixelcolor::{raw::RawU16, Rgb565};
use retrofire_core::math::{mat::ProjMat3, Mat4};
use retrofire_core::prelude::*;
use retrofire_core::render::{ctx::FaceCull, render, shader, Model, Ndc, Screen, View};
use retrofire_core::util::{dims::Dims, pixfmt, MutSlice2};

use crate::setting::{AMBIENT, BASE, DIFFUSE, DISTANCE, FOCAL, HALF, LIGHT, SPECULAR};
use crate::teapot::{NORMALS, POSITIONS, ROTATIONS, TRIANGLES};
use crate::{PIXELS, SIZE};

const WHOLE: Dims = Dims(SIZE as u32, SIZE as u32);
const VERTICES: usize = POSITIONS.len();

/// In flash.
static MESH: [Vertex3<Vec3<Model>>; VERTICES] = {
    let mut all = [vertex(pt3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 0.0)); VERTICES];
    let mut number = 0;
    while number < VERTICES {
        let ([x, y, z], [a, b, c]) = (POSITIONS[number], NORMALS[number]);
        all[number] = vertex(pt3(x, y, z), vec3(a, b, c));
        number += 1;
    }
    all
};

/// In flash.
static FACES: [Tri<usize>; TRIANGLES.len()] = {
    let mut all = [tri(0, 0, 0); TRIANGLES.len()];
    let mut number = 0;
    while number < TRIANGLES.len() {
        let [a, b, c] = TRIANGLES[number];
        all[number] = tri(a as usize, b as usize, c as usize);
        number += 1;
    }
    all
};

/// What is given to each vertex and pixel.
#[derive(Clone, Copy)]
struct Uniform<'a> {
    to_view: &'a Mat4<Model, View>,
    to_projection: &'a ProjMat3<Model>,
}

/// The colour of a surface with this unit normal in the axes of the view: x to the right, y down, z away.
fn lit(normal: Vec3<View>) -> Color3f {
    const TO_LIGHT: Vec3<View> = vec3(LIGHT[0], -LIGHT[1], -LIGHT[2]);
    const HALF_WAY: Vec3<View> = vec3(HALF[0], -HALF[1], -HALF[2]);
    let diffuse = AMBIENT + DIFFUSE * normal.dot(&TO_LIGHT).max(0.0);
    let mut highlight = normal.dot(&HALF_WAY).max(0.0);
    for _ in 0..5 {
        highlight *= highlight;
    }
    highlight *= SPECULAR;
    rgb(BASE[0] * diffuse + highlight, BASE[1] * diffuse + highlight, BASE[2] * diffuse + highlight)
}

/// All that drawing needs in RAM, but for the heap.
pub struct Scene {
    color: [u16; PIXELS],
    depth: [f32; PIXELS],
}

impl Scene {
    /// What lies in RAM, with its size in bytes.
    pub const RAM: &'static [(&'static str, usize)] = &[("picture", 2 * PIXELS), ("depth", 4 * PIXELS)];
    /// Bytes of the mesh in flash.
    pub const MESH_BYTES: usize = size_of_val(&MESH) + size_of_val(&FACES);

    /// A scene of which nothing was drawn yet.
    pub const fn new() -> Self {
        Self { color: [0; PIXELS], depth: [0.0; PIXELS] }
    }

    /// Draws the frame with this place among those that are drawn.
    #[inline(never)]
    pub fn draw(&mut self, frame: usize) {
        let shade = shader::new(
            |v: Vertex3<Vec3<Model>>, by: Uniform<'_>| {
                let normal = by.to_view.apply(&v.attrib);
                let attribute = if cfg!(feature = "retrofire-phong") { normal.to() } else { Vec3::new(lit(normal).0) };
                vertex(by.to_projection.apply(&v.pos), attribute)
            },
            |pixel: Frag<Vec3<()>>, _: Uniform<'_>| {
                let shaded =
                    if cfg!(feature = "retrofire-phong") { lit(pixel.var.normalize().to()) } else { Color3f::new(pixel.var.0) };
                shaded.to_color4()
            },
        );
        self.color.fill(0);
        self.depth.fill(0.0);
        let color_buf = Colorbuf { buf: MutSlice2::new(WHOLE, SIZE as u32, &mut self.color), fmt: pixfmt::Rgb565 };
        let mut target = Framebuf { color_buf, depth_buf: MutSlice2::new(WHOLE, SIZE as u32, &mut self.depth) };
        let (to_view, to_projection) = transforms(frame);
        let uniform = Uniform { to_view: &to_view, to_projection: &to_projection };
        render(&FACES[..], &MESH[..], &shade, uniform, to_screen(), &mut target, &context());
    }

    /// The rows of the frame drawn last, one after the other.
    pub fn pixels(&self) -> impl Iterator<Item = Rgb565> + '_ {
        self.color.iter().map(|&pixel| RawU16::new(pixel).into())
    }

    /// One more than the number of the triangle that each pixel of a frame shows; 0 for none.
    ///
    /// Each triangle is drawn with vertices of its own, whose attribute is that number.
    #[cfg(feature = "host")]
    pub fn owners(frame: usize) -> alloc::vec::Vec<u16> {
        use alloc::vec::Vec;
        let corners: Vec<_> =
            FACES.iter().enumerate().flat_map(|(number, Tri(corners))| corners.map(|corner| (corner, number))).collect();
        let apart: Vec<Vertex3<f32>> =
            corners.iter().map(|&(corner, number)| vertex(MESH[corner].pos, (number + 1) as f32)).collect();
        let faces: Vec<_> = (0..FACES.len()).map(|number| tri(3 * number, 3 * number + 1, 3 * number + 2)).collect();
        let shade = shader::new(
            |v: Vertex3<f32>, by: Uniform<'_>| vertex(by.to_projection.apply(&v.pos), v.attrib),
            |pixel: Frag<f32>, _: Uniform<'_>| {
                let [high, low] = ((pixel.var + 0.5) as u16).to_be_bytes();
                rgba(0, high, low, 0)
            },
        );
        let (mut color, mut depth) = (alloc::vec![0_u32; PIXELS], alloc::vec![0.0; PIXELS]);
        let color_buf = Colorbuf { buf: MutSlice2::new(WHOLE, SIZE as u32, &mut color), fmt: pixfmt::Xrgb8888 };
        let mut target = Framebuf { color_buf, depth_buf: MutSlice2::new(WHOLE, SIZE as u32, &mut depth) };
        let (to_view, to_projection) = transforms(frame);
        let uniform = Uniform { to_view: &to_view, to_projection: &to_projection };
        render(&faces, &apart, &shade, uniform, to_screen(), &mut target, &context());
        color.into_iter().map(|number| number as u16).collect()
    }
}

impl Default for Scene {
    fn default() -> Self {
        Self::new()
    }
}

/// From the model to the view, and on to the projection.
fn transforms(frame: usize) -> (Mat4<Model, View>, ProjMat3<Model>) {
    let [x, [a, b, c], [d, e, f]] = ROTATIONS[frame];
    let to_view: Mat4<Model, View> =
        Mat4::new([[x[0], x[1], x[2], 0.0], [-a, -b, -c, 0.0], [-d, -e, -f, DISTANCE], [0.0, 0.0, 0.0, 1.0]]);
    let to_projection = to_view.then(&perspective(FOCAL, 1.0, 0.1..10.0));
    (to_view, to_projection)
}

/// With y downwards and z away, the corners of what faces the eye run the other way round than in retrofire's own models.
fn context() -> Context {
    Context { face_cull: Some(FaceCull::Front), ..Context::default() }
}

fn to_screen() -> Mat4<Ndc, Screen> {
    viewport(pt2(0, 0)..pt2(SIZE as u32, SIZE as u32))
}
