//! Phong-quality 3D scanlines for microcontrollers: fixed point, no frame buffer, no z-buffer, no allocation.
//!
//! A lit triangle mesh goes in; shaded scanlines come out, one at a time, when the display wants them. The way of the data is the
//! order of the modules:
//!
//! 1. [`math`]: number formats, and the arithmetic on them.
//! 2. [`model`]: what you describe. [`Mesh`] and [`Material`] live in flash; a [`Pose`] says where an object stands, a [`Camera`]
//!    who looks, a [`Light`] from where it shines.
//! 3. [`Frame`]: once a frame. `begin(camera, lights)`, then `add(mesh, pose)` for each object: transforms, lights, culls, clips,
//!    and sorts the triangles into buckets by the line on which they start.
//! 4. [`Scanner`]: once a line. Takes in the triangles that start, steps the ones that are there, resolves who is seen where, and
//!    makes the line's span table: shaded into a row at once, by [`Lines::line`] or, with smooth silhouettes, [`Lines::smooth_line`],
//!    or, with transparent surfaces, [`Lines::transparent_line`];
//!    or kept for later, a line [`Baked`], a whole picture [`Frozen`].
//! 5. [`shade`]: one file for each method, behind one trait. The default, [`shade::duff_barycentric`], is exact Phong shading for
//!    a few additions, products and look-ups a pixel.
//! 6. [`sink`]: pixel encodings, palettes, dither, the overlay, and frames to any embedded-graphics display, whole or what of them
//!    changed.
//! 7. [`price`], [`look_ahead`], [`ladder`]: what lines cost, known before the first one is sent; how far ahead they must be drawn; and
//!    cheaper methods for those that would be late.
//! 8. [`split`]: other ways into a frame, by which triangles with a highlight on them are split for Gouraud shading.
//!
//! The application owns every buffer and pulls lines; nothing here waits, calls back, allocates, panics, or knows a peripheral.
//!
//! ```
//! use beamshade::{Camera, Frame, Light, Pose, Scanner, Turn};
//! use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
//! # use beamshade::{Color, Material, Mesh, MeshData};
//! # use fixed::types::I16F16;
//! # static TEAPOT: Mesh<'static> = match Mesh::new(MeshData {
//! #     extent: I16F16::ONE, center: [0; 3], radius: 32768, positions: &[[-16384, -16384, 0], [16384, -16384, 0], [0, 16384, 0]],
//! #     normals: &[[0, 0, 16384]; 3], triangles: &[[0, 1, 2]], edges: &[[0; 3]], parts: &[[1, 0]],
//! #     materials: &[Material::new(Color::rgb(0.85, 0.45, 0.20))],
//! # }) { Ok(mesh) => mesh, Err(_) => panic!() };
//! # let mut display = MockDisplay::<Rgb565>::new();
//!
//! let camera = Camera::new(Size::new(64, 48)).field_of_view(Turn::degrees(40)).at_distance(2.45);
//! let light = Light::directional([-0.5, 0.7, 0.6]);
//! let mut frame = Frame::<512, 320, 48>::new(); // vertices, triangles or pairs that face the eye, lines
//! let mut scanner = Scanner::<48>::new(); // triangles or pairs that cross one line
//! let mut row = [Rgb565::BLACK; 64];
//!
//! frame.begin(&camera, &[light])?;
//! frame.add(&TEAPOT, &Pose::turned_y(Turn::degrees(6)))?; // Err(Full { .. }) says what had no room
//! scanner.start(frame.picture()).draw(&mut row, &mut display)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Or line by line, one row shaded while the other is sent:
//!
//! ```
//! # use beamshade::{Camera, Frame, Scanner};
//! # use embedded_graphics::prelude::*;
//! # let mut frame = Frame::<8, 8, 48>::new();
//! # let mut scanner = Scanner::<8>::new();
//! # frame.begin(&Camera::new(Size::new(64, 48)), &[beamshade::Light::OFF])?;
//! let mut lines = scanner.start(frame.picture());
//! let mut rows = [[[0u8; 2]; 64]; 2]; // Rgb565, high byte first
//! for y in 0..48 {
//!     rows.swap(0, 1);
//!     let [row, _sending] = &mut rows;
//!     lines.line(y, row);
//!     let _bytes: &[u8] = row.as_flattened(); // to SPI or DMA
//! }
//! # Ok::<(), beamshade::Full>(())
//! ```
//!
//! # Determinism
//!
//! Floats end where a scene is described: an `f32` becomes an integer once, by one multiplication and `as`. Below that border all
//! is integer, so the same scene gives the same bytes on every target.

#![no_std]

pub mod baked;
pub mod frame;
pub mod frozen;
pub mod ladder;
pub mod look_ahead;
pub mod math;
pub mod model;
pub mod price;
mod prices;
pub mod scan;
pub mod scanner;
pub(crate) mod seen;
pub mod shade;
pub mod sink;
pub(crate) mod smooth;
pub mod split;
pub(crate) mod transparent;
pub(crate) mod walk;
pub mod work;

pub use baked::Baked;
pub use frame::{Frame, Full, LeanFrame};
pub use frozen::Frozen;
pub use ladder::{Degraded, Degrading, Plan};
pub use look_ahead::Schedule;
pub use math::{angle::Turn, rotation::Rotation, Length};
pub use model::{
    camera::Camera,
    light::{Light, LightSource, SceneLight},
    material::{Color, Material},
    mesh::{Mesh, MeshData, MeshError},
    pose::Pose,
};
pub use price::Price;
pub use scan::{
    columns::Columns,
    depth_line::DepthLine,
    geometry::Source,
    picture::{Background, Picture},
    resolve::Spanning,
    visibility::Visibility,
};
pub use scanner::{Line, Lines, Scanner};
pub use shade::{
    angular_trapezia::AngularTrapezia,
    angular_triangle::AngularTriangle,
    bishop_weimer::BishopWeimer,
    choose::{ByHighlight, ByMaterial, ByRung, Choose, GouraudPhong},
    duff_barycentric::DuffBarycentric,
    duff_differences::DuffDifferences,
    duff_direct::DuffDirect,
    flat::Flat,
    gouraud::Gouraud,
    hybrid::Hybrid,
    linear_angle::LinearAngle,
    phong::Phong,
    phong_planes::PhongPlanes,
    quadratic_dots::QuadraticDots,
    quadratic_intensity::QuadraticIntensity,
    Intensity, Paint, Shade,
};
pub use sink::{
    changes::{Changes, Sent, Strip},
    dither::{Dithered, Page},
    ink::Ink,
    overlay::Overlay,
    palette::{Indexed, Palette},
    round::Round,
};
pub use split::{highlight::AtHighlight, regular::Regular, Split, Splits};
pub use work::Work;
