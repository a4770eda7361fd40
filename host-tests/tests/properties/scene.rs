//! Random scenes.

use std::f64::consts::TAU;
use std::iter::{repeat_n, zip};

use beamshade::{
    Background, Camera, Color, Flat, Frame, Full, Light, LightSource, Material, Mesh, MeshData, Picture, Pose, Rotation, Scanner,
    Turn,
};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Gray8;
use fixed::types::I16F16;
use glam::{DMat3, DVec3};
use host_tests::library::read;
use host_tests::Owner;
use proptest::array::{uniform, uniform3};
use proptest::collection::vec;
use proptest::num::f32::ANY;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// Number of opaque materials; each has a transparent one like it, so much further on.
pub(crate) const OPAQUE: u16 = 5;

/// One of each kind: one- and double-sided, glossy and matte, saturating, plain for [`Choose`](beamshade::Choose).
static MATERIALS: [Material; 2 * OPAQUE as usize] = {
    let [a, b, c, d, e] = OPAQUE_MATERIALS;
    [a, b, c, d, e, a.opacity(0.4), b.opacity(0.75), c.opacity(0.1), d.opacity(0.9), e.opacity(0.5)]
};

static OPAQUE_MATERIALS: [Material; OPAQUE as usize] = [
    Material::new(Color::rgb(0.85, 0.45, 0.20)),
    Material::new(Color::rgb(0.2, 0.6, 0.9)).double_sided().specular(0.0),
    Material::new(Color::WHITE).ambient(1.0).diffuse(1.0).specular(1.0).exponent(1).plain(),
    Material::new(Color::rgb(0.3, 0.8, 0.3)).highlight(Color::rgb(1.0, 0.5, 0.0)).exponent(200).plain().double_sided(),
    Material::new(Color::WHITE).ambient(1.0).diffuse(0.0).specular(0.0).plain().double_sided(),
];

/// A mesh that owns its arrays.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub(crate) extent: I16F16,
    pub(crate) center: [i16; 3],
    pub(crate) radius: u16,
    pub(crate) positions: Vec<[i16; 3]>,
    pub(crate) normals: Vec<[i16; 3]>,
    pub(crate) triangles: Vec<[u16; 3]>,
    pub(crate) edges: Vec<[u16; 3]>,
    pub(crate) parts: Vec<[u16; 2]>,
}

impl Shape {
    /// Triangles of the double-sided material, in units of 1/32768, all normals towards +z.
    pub(crate) fn plain(positions: Vec<[i16; 3]>, triangles: Vec<[u16; 3]>) -> Self {
        Self {
            extent: I16F16::ONE,
            center: [0; 3],
            radius: u16::MAX,
            normals: vec![[0, 0, 1 << 14]; positions.len()],
            edges: vec![[0; 3]; triangles.len()],
            parts: vec![[triangles.len() as u16, 1]],
            positions,
            triangles,
        }
    }

    /// Takes away the last triangle.
    pub(crate) fn pop(&mut self) {
        self.triangles.pop();
        self.edges.pop();
        if let Some([count, _]) = self.parts.iter_mut().rev().find(|[count, _]| *count > 0) {
            *count -= 1;
        }
    }

    pub(crate) fn mesh(&self) -> Mesh<'_> {
        let Self { extent, center, radius, positions, normals, triangles, edges, parts } = self;
        let data = MeshData {
            extent: *extent,
            center: *center,
            radius: *radius,
            positions,
            normals,
            triangles,
            edges,
            parts,
            materials: &MATERIALS,
        };
        Mesh::new(data).unwrap()
    }
}

/// A pose, and what it does to points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) rotation: Rotation,
    pub(crate) scale: f32,
    pub(crate) at: [f32; 3],
}

impl Place {
    pub(crate) fn pose(&self) -> Pose {
        Pose::turned(self.rotation).scaled(self.scale).at(self.at)
    }

    /// The rows of the rotation in f64.
    pub(crate) fn matrix(&self) -> DMat3 {
        let rows = self.rotation.0.map(|row| DVec3::from_array(row.0.map(f64::from)) / f64::from(1 << 30));
        DMat3::from_cols_array_2d(&rows.map(|row| row.to_array())).transpose()
    }

    /// A position of a mesh in the world.
    pub(crate) fn world(&self, shape: &Shape, position: [i16; 3]) -> DVec3 {
        let unit = shape.extent.to_num::<f64>() / 32768.0 * f64::from(self.scale);
        self.matrix() * DVec3::from_array(position.map(f64::from)) * unit + DVec3::from_array(self.at.map(f64::from))
    }
}

/// The way of the light to each pixel of an unturned camera.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rays {
    pub(crate) focal: f64,
    pub(crate) width: usize,
    pub(crate) height: usize,
}

impl Rays {
    pub(crate) fn of(camera: &Camera) -> Self {
        let size = camera.viewport().size;
        Self { focal: f64::from(camera.focal()) / 256.0, width: size.width as usize, height: size.height as usize }
    }

    /// From the eye to a point of the screen, in pixels from the picture's top left corner; −1 along z.
    pub(crate) fn to(&self, [x, y]: [f64; 2]) -> DVec3 {
        DVec3::new((x - self.width as f64 / 2.0) / self.focal, (self.height as f64 / 2.0 - y) / self.focal, -1.0)
    }

    /// The middle of a pixel, given as its index row by row.
    pub(crate) fn middle(&self, pixel: usize) -> [f64; 2] {
        [(pixel % self.width) as f64 + 0.5, (pixel / self.width) as f64 + 0.5]
    }
}

/// What a frame is made of.
#[derive(Clone, Debug)]
pub(crate) struct Scene<const LIGHTS: usize = 1> {
    pub(crate) camera: Camera,
    pub(crate) lights: [Light; LIGHTS],
    pub(crate) background: Background,
    pub(crate) objects: Vec<(Shape, Pose)>,
}

impl<const LIGHTS: usize> Scene<LIGHTS> {
    /// Draws the scene into a frame of any capacity; whether there was room, for each object.
    pub(crate) fn fill<'m, const V: usize, const T: usize, const L: usize, const O: usize, const M: usize>(
        &self,
        meshes: &'m [Mesh<'m>],
        frame: &mut Frame<'m, V, T, L, LIGHTS, O, M>,
    ) -> Vec<Result<(), Full>> {
        self.fill_under(&self.lights, meshes, frame)
    }

    /// The same under other lights.
    fn fill_under<'m, const V: usize, const T: usize, const L: usize, const O: usize, const M: usize, S: LightSource>(
        &self,
        lights: &[S; LIGHTS],
        meshes: &'m [Mesh<'m>],
        frame: &mut Frame<'m, V, T, L, LIGHTS, O, M, S>,
    ) -> Vec<Result<(), Full>> {
        let _ = frame.background(self.background).begin(&self.camera, lights);
        meshes.iter().zip(&self.objects).map(|(mesh, (_, pose))| frame.add(mesh, pose)).collect()
    }

    pub(crate) fn meshes(&self) -> Vec<Mesh<'_>> {
        self.objects.iter().map(|(shape, _)| shape.mesh()).collect()
    }

    /// The vertex numbers of each object's triangles, as [`Measures`](host_tests::Measures) asks for them.
    pub(crate) fn triangles(&self) -> Vec<Vec<[u32; 3]>> {
        let corners = |(shape, _): &(Shape, Pose)| shape.triangles.iter().map(|corners| corners.map(u32::from)).collect();
        self.objects.iter().map(corners).collect()
    }

    /// Each triangle in a scene of its own.
    pub(crate) fn alone(&self) -> Vec<(Owner, Self)> {
        let mut scenes = Vec::new();
        for ((shape, pose), object) in self.objects.iter().zip(0..) {
            let materials = shape.parts.iter().flat_map(|[count, material]| repeat_n(*material, (*count).into()));
            for ((corners, material), triangle) in shape.triangles.iter().zip(materials).zip(0..) {
                let alone = Shape { triangles: vec![*corners], edges: vec![[0; 3]], parts: vec![[1, material]], ..shape.clone() };
                scenes.push((Owner { object, triangle }, Self { objects: vec![(alone, *pose)], ..self.clone() }));
            }
        }
        scenes
    }

    /// The pixels that each triangle covers when it is drawn alone, as indices row by row.
    pub(crate) fn coverage(&self) -> Vec<(Owner, Vec<usize>)> {
        let covered = |scene: &Self| {
            let picture = scene.show(|picture| read::<Gray8, Flat, 8, LIGHTS, _>(&mut Scanner::new().start(picture)));
            (0..picture.owner.len()).filter(|pixel| picture.owner[*pixel].is_some()).collect()
        };
        self.alone().iter().map(|(owner, scene)| (*owner, covered(scene))).collect()
    }

    /// Shows the scene's picture, from a frame with room for everything.
    pub(crate) fn show<T>(&self, see: impl FnOnce(Picture<'_, '_, LIGHTS>) -> T) -> T {
        self.show_under(&self.lights, see)
    }

    /// The same under other lights.
    pub(crate) fn show_under<T, S: LightSource>(
        &self,
        lights: &[S; LIGHTS],
        see: impl FnOnce(Picture<'_, '_, LIGHTS, S>) -> T,
    ) -> T {
        let meshes = self.meshes();
        let mut frame = Box::<Frame<'_, 2048, 1024, 1024, LIGHTS, 8, 1024, S>>::default();
        for result in self.fill_under(lights, &meshes, &mut frame) {
            result.unwrap();
        }
        see(frame.picture())
    }
}

/// Anything that can be described, most of it in sight.
pub(crate) fn scenes<const LIGHTS: usize>() -> impl Strategy<Value = Scene<LIGHTS>> {
    (cameras(), uniform(lights()), backgrounds(), vec((shapes(), poses()), 1..=4))
        .prop_map(|(camera, lights, background, objects)| Scene { camera, lights, background, objects })
}

fn cameras() -> impl Strategy<Value = Camera> {
    let size = prop_oneof![
        8 => (1u32..=320, 1u32..=240),
        1 => Just((1, 1)),
        1 => (Just(1024), 1u32..=20),
        1 => (1u32..=20, Just(1024)),
    ];
    let view = prop_oneof![6 => (20..100).prop_map(Turn::degrees), 1 => turns()];
    let near = prop_oneof![8 => 0.001f32..1.0, 1 => ANY];
    let place = prop_oneof![16 => Just([0.0, 0.0, 3.0]), 2 => uniform3(-4f32..4.0), 1 => uniform3(ANY)];
    let rotation = prop_oneof![8 => Just(Rotation::NONE), 1 => rotations()];
    (size, view, near, place, rotation, any::<u8>()).prop_map(|((width, height), view, near, place, rotation, quarters)| {
        Camera::new(Size::new(width, height)).field_of_view(view).near(near).at(place).turned(rotation).panel_turned(quarters)
    })
}

fn lights() -> impl Strategy<Value = Light> {
    let towards = prop_oneof![4 => uniform3(-1f32..1.0), 1 => uniform3(ANY)];
    let intensity = prop_oneof![2 => Just(1.0), 2 => 0f32..1.0, 1 => ANY];
    (towards, intensity).prop_map(|(towards, intensity)| Light::directional(towards).intensity(intensity))
}

pub(crate) fn colors() -> impl Strategy<Value = Color> {
    uniform3(0..=1u16 << 15).prop_map(Color)
}

fn backgrounds() -> impl Strategy<Value = Background> {
    prop_oneof![
        colors().prop_map(Background::Plain),
        (colors(), colors()).prop_map(|(top, bottom)| Background::Gradient { top, bottom }),
        Just(Background::Keep),
    ]
}

fn turns() -> impl Strategy<Value = Turn> {
    any::<u32>().prop_map(Turn)
}

pub(crate) fn rotations() -> impl Strategy<Value = Rotation> {
    uniform3(turns()).prop_map(|[x, y, z]| Rotation::x(x) * Rotation::y(y) * Rotation::z(z))
}

/// Before the eye, behind it, around it, and far beyond what is documented to be drawn.
fn poses() -> impl Strategy<Value = Pose> {
    let scale = prop_oneof![8 => 0.1f32..2.0, 2 => 2f32..600.0, 1 => 0f32..0.01, 1 => ANY];
    let place =
        prop_oneof![8 => uniform3(-1f32..1.0), 2 => uniform3(-10f32..10.0), 1 => uniform3(-1100f32..1100.0), 1 => uniform3(ANY)];
    (rotations(), scale, place).prop_map(|(rotation, scale, place)| Pose::turned(rotation).scaled(scale).at(place))
}

/// The least sphere around positions with that centre, or one around all that there can be.
fn around(positions: &[[i16; 3]], center: [i16; 3]) -> ([i16; 3], u16) {
    let square =
        |position: &[i16; 3]| -> f64 { zip(*position, center).map(|(p, c)| (f64::from(p) - f64::from(c)).powi(2)).sum() };
    let radius = positions.iter().map(square).fold(0.0, f64::max).sqrt().ceil();
    if radius > f64::from(u16::MAX) {
        ([0; 3], u16::MAX)
    } else {
        (center, radius as u16)
    }
}

/// Up to 40 triangles, in every other shape pairs that share an edge: slivers, points, repeated vertices and all bit patterns of positions, normals and edges among them.
fn shapes() -> impl Strategy<Value = Shape> {
    let coordinate =
        || prop_oneof![4 => any::<i16>(), 2 => -300..=300i16, 1 => Just(0), 1 => prop_oneof![Just(i16::MIN), Just(i16::MAX)]];
    let normal = || prop_oneof![3 => unit_normals(), 1 => uniform3(any::<i16>())];
    let vertex = (uniform3(coordinate()), normal());
    let edges = prop_oneof![2 => uniform3(0..3000u16), 1 => uniform3(any::<u16>())];
    let extent = prop_oneof![12 => Just(1 << 16), 1 => 1..=i32::MAX, 1 => 1..1000].prop_map(I16F16::from_bits);
    let center = prop_oneof![1 => Just([0; 3]), 1 => uniform3(any::<i16>())];
    let triangles = vec((any::<[u16; 3]>(), edges), 1..=40);
    (vec(vertex, 1..=20), triangles, any::<bool>(), extent, center, any::<[u16; 3]>()).prop_map(
        |(vertices, triangles, pairs, extent, center, [split, first, second])| {
            let (positions, normals): (Vec<_>, Vec<_>) = vertices.into_iter().unzip();
            let (center, radius) = around(&positions, center);
            let (corners, edges): (Vec<_>, Vec<_>) = triangles.into_iter().unzip();
            let corner = |number: u16| number % positions.len() as u16;
            let mut triangles: Vec<_> = corners.into_iter().map(|corners| corners.map(corner)).collect();
            if pairs {
                for pair in triangles.chunks_exact_mut(2) {
                    let [a, _, c] = pair[0];
                    pair[1] = [a, c, pair[1][2]];
                }
            }
            let split = split % (triangles.len() as u16 + 1);
            let parts = vec![[split, first % OPAQUE], [triangles.len() as u16 - split, second % OPAQUE]];
            Shape { extent, center, radius, positions, normals, triangles, edges, parts }
        },
    )
}

pub(crate) fn unit_normals() -> impl Strategy<Value = [i16; 3]> {
    (0.0..TAU, -1f64..=1.0).prop_map(|(turn, z)| {
        let ring = (1.0 - z * z).sqrt();
        [ring * turn.cos(), ring * turn.sin(), z].map(|c| (c * 16384.0).round() as i16)
    })
}

#[test]
fn random_scenes_are_worth_drawing() {
    let mut runner = TestRunner::new(crate::cases(0));
    let (mut seen, mut cut) = (0, 0);
    for _ in 0..400 {
        let scene = scenes::<1>().new_tree(&mut runner).unwrap().current();
        let owners = scene.show(|picture| read::<Gray8, Flat, 256, 1, _>(&mut Scanner::new().start(picture)).owner);
        seen += usize::from(owners.iter().any(Option::is_some));
        let meshes = scene.meshes();
        let mut frame = Box::<Frame<'_, 256, 256, 1024, 1, 4, 0>>::default();
        let made = |result: &Result<(), Full>| matches!(result, Err(Full::Made { .. }));
        cut += usize::from(scene.fill(&meshes, &mut frame).iter().any(made));
    }
    println!("of 400 scenes {seen} are seen, {cut} are clipped");
    assert!(seen > 200 && cut > 80);
}
