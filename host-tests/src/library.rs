//! The library's renderings of the reference's scenes.

use anyhow::{bail, ensure, Context, Result};
use beamshade::{
    scan::vertex::Vertex, Background, Camera, Color, Frame, Ink, Light, LightSource, Lines, Pose, Regular, Rotation, Scanner,
    SceneLight, Shade, Spanning, Split, Splits, Turn, Visibility,
};
use beamshade_mesh::{Model, Part, Quantized, Surface};
use embedded_graphics::geometry::Size;
use glam::{DMat3, DVec3};

use crate::{
    reference::{self, Polygon, Scene, Source, Viewer},
    Owner, Picture,
};

/// Room on a PC: vertices, triangles, lines, objects, made triangles, and triangles on a line.
const VERTICES: usize = 16384;
const TRIANGLES: usize = 16384;
const LINES: usize = 1024;
const OBJECTS: usize = 16;
const MADE: usize = 4096;
const ACTIVE: usize = 2048;

type BigFrame<'m, const LIGHTS: usize, L> = Frame<'m, VERTICES, TRIANGLES, LINES, LIGHTS, OBJECTS, MADE, L>;

/// The meshes of a scene in the library's number formats.
#[derive(Debug)]
pub struct Meshes(Vec<Quantized>);

impl Meshes {
    /// Quantises the meshes of a scene, with its materials.
    ///
    /// # Errors
    ///
    /// When a mesh does not fit the formats, or its triangles are not sorted by material.
    pub fn of(scene: &Scene<'_>) -> Result<Self> {
        scene.objects.iter().map(|object| model(object)?.quantize().map_err(Into::into)).collect::<Result<_>>().map(Self)
    }
}

impl Meshes {
    /// The first mesh as the library has it, back in f64, with the triangles of the mesh that it came from.
    ///
    /// # Errors
    ///
    /// When there is none.
    pub fn dequantized(&self, mesh: &reference::Mesh) -> Result<reference::Mesh> {
        let quantized = self.0.first().context("no mesh")?.mesh();
        let data = quantized.data();
        let back = |from: &[[i16; 3]], one: f64| from.iter().map(|v| DVec3::from_array(v.map(|c| f64::from(c) / one))).collect();
        let positions: Vec<DVec3> = back(data.positions, 32768.0 / data.extent.to_num::<f64>());
        let normals: Vec<DVec3> = back(data.normals, 16384.0);
        let normals = normals.into_iter().map(DVec3::normalize_or_zero).collect();
        Ok(reference::Mesh { positions, normals, ..mesh.clone() })
    }
}

/// The model that the mesh tool would have read.
fn model(object: &reference::Object<'_>) -> Result<Model> {
    let reference::Mesh { positions, normals, triangles, materials } = object.mesh;
    ensure!(materials.is_sorted(), "the triangles are not sorted by material");
    let mut parts: Vec<Part> = Vec::new();
    for (triangle, material) in materials.iter().enumerate() {
        match parts.last_mut() {
            Some(part) if part.surface == *material => part.triangles.end = triangle + 1,
            _ => parts.push(Part { triangles: triangle..triangle + 1, surface: *material }),
        }
    }
    Ok(Model {
        positions: positions.iter().map(|p| p.to_array()).collect(),
        normals: normals.iter().map(|n| n.to_array()).collect(),
        triangles: triangles.clone(),
        parts,
        surfaces: object.materials.iter().map(surface).collect::<Result<_>>()?,
        ..Model::default()
    })
}

fn surface(material: &reference::Material) -> Result<Surface> {
    ensure!(material.exponent.fract() == 0.0, "the library's exponents are whole");
    Ok(Surface {
        name: String::new(),
        base: material.base,
        highlight: material.highlight,
        ambient: material.ambient,
        diffuse: material.diffuse,
        specular: material.specular,
        exponent: material.exponent as u16,
        double_sided: material.double_sided,
        opacity: material.opacity,
    })
}

/// A rotation to the library's 2⁻³⁰.
fn rotation(matrix: DMat3) -> Rotation {
    let rows = matrix.transpose();
    let q30 = |v: DVec3| beamshade::math::vector::Vector(v.to_array().map(|c| (c * f64::from(1 << 30)).round() as i32));
    Rotation([q30(rows.x_axis), q30(rows.y_axis), q30(rows.z_axis)])
}

fn camera(camera: &reference::Camera) -> Camera {
    let half = (camera.height as f64 / 2.0 / camera.focal).atan();
    let turn = Turn((half / std::f64::consts::PI * 4_294_967_296.0).round() as u32);
    Camera::new(Size::new(camera.width as u32, camera.height as u32))
        .field_of_view(turn)
        .near(camera.near as f32)
        .at(single(camera.position))
        .turned(rotation(camera.rotation))
}

impl TryFrom<reference::Light> for Light {
    type Error = anyhow::Error;

    fn try_from(light: reference::Light) -> Result<Self> {
        match (light.source, light.viewer) {
            (Source::Direction(towards), Viewer::Infinity) => {
                Ok(Self::directional(single(towards)).intensity(light.intensity as f32))
            }
            other => bail!("no light of the library's is {other:?}"),
        }
    }
}

impl TryFrom<reference::Light> for SceneLight {
    type Error = anyhow::Error;

    fn try_from(light: reference::Light) -> Result<Self> {
        let there = match (light.source, light.viewer) {
            (Source::Direction(towards), Viewer::Eye) => Self::directional(single(towards)),
            (Source::Point(place), Viewer::Eye) => Self::point(single(place)),
            other => bail!("no light of the library's is {other:?}"),
        };
        Ok(there.intensity(light.intensity as f32))
    }
}

/// A kind of light that the reference's can be turned into, if they are of that kind.
pub trait FromReference: LightSource + TryFrom<reference::Light, Error = anyhow::Error> {}

impl<L: LightSource + TryFrom<reference::Light, Error = anyhow::Error>> FromReference for L {}

fn single(vector: DVec3) -> [f32; 3] {
    vector.to_array().map(|c| c as f32)
}

/// Fills a frame with the scene and hands it to `see`.
///
/// # Errors
///
/// When the scene has another number of lights, or lights of another kind, or no room.
pub fn frame<T, const LIGHTS: usize, L: FromReference>(
    scene: &Scene<'_>,
    meshes: &Meshes,
    see: impl FnOnce(beamshade::Picture<'_, '_, LIGHTS, L>) -> T,
) -> Result<T> {
    fill(scene, camera(&scene.camera), meshes, None::<&Regular>, |picture, _| see(picture))
}

/// The same, for smooth lines.
///
/// # Errors
///
/// As [`frame`].
pub fn fine_frame<T, const LIGHTS: usize, L: FromReference>(
    scene: &Scene<'_>,
    meshes: &Meshes,
    see: impl FnOnce(beamshade::Picture<'_, '_, LIGHTS, L>) -> T,
) -> Result<T> {
    fill(scene, camera(&scene.camera).smooth(), meshes, None::<&Regular>, |picture, _| see(picture))
}

/// The same, triangles split that way if any; `see` is told what became of each object's.
fn fill<T, const LIGHTS: usize, L: FromReference>(
    scene: &Scene<'_>,
    camera: Camera,
    meshes: &Meshes,
    split: Option<&impl Split<LIGHTS, L>>,
    see: impl FnOnce(beamshade::Picture<'_, '_, LIGHTS, L>, Vec<Splits>) -> T,
) -> Result<T> {
    let borrowed: Vec<_> = meshes.0.iter().map(Quantized::mesh).collect();
    let mut frame: Box<BigFrame<'_, LIGHTS, L>> = Box::default();
    let lights: Vec<L> = scene.lights.iter().map(|&light| light.try_into()).collect::<Result<_>>()?;
    let lights: &[L; LIGHTS] = lights.as_slice().try_into().context("another number of lights")?;
    let [r, g, b] = scene.background.map(|c| c as f32);
    frame.background(Background::Plain(Color::rgb(r, g, b)));
    frame.begin(&camera, lights)?;
    let mut splits = Vec::new();
    for (mesh, object) in borrowed.iter().zip(&scene.objects) {
        let pose =
            Pose::turned(rotation(object.pose.rotation)).scaled(object.pose.scale as f32).at(single(object.pose.translation));
        match split {
            Some(split) => splits.push(frame.add_split(mesh, &pose, split)?),
            None => frame.add(mesh, &pose)?,
        }
    }
    Ok(see(frame.picture(), splits))
}

/// Draws the scene by the library, every line from top to bottom.
///
/// # Errors
///
/// As [`frame`].
pub fn draw<P: Ink, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: FromReference>(
    scene: &Scene<'_>,
    meshes: &Meshes,
) -> Result<Picture<P>> {
    draw_by::<Spanning, P, S, LIGHTS, L>(scene, meshes)
}

/// The same with that visibility, in place of spanning.
///
/// # Errors
///
/// As [`frame`].
pub fn draw_by<V: Visibility, P: Ink, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: FromReference>(
    scene: &Scene<'_>,
    meshes: &Meshes,
) -> Result<Picture<P>> {
    frame(scene, meshes, |picture| {
        let mut scanner: Box<Scanner<ACTIVE, S, LIGHTS, L, V>> = Box::default();
        read_by(&mut scanner.start(picture))
    })
}

/// As [`draw`], with triangles split that way, and what became of each object's.
///
/// # Errors
///
/// As [`frame`].
pub fn draw_split<P: Ink, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: FromReference>(
    scene: &Scene<'_>,
    meshes: &Meshes,
    split: &impl Split<LIGHTS, L>,
) -> Result<(Picture<P>, Vec<Splits>)> {
    fill(scene, camera(&scene.camera), meshes, Some(split), |picture, splits| {
        let mut scanner: Box<Scanner<ACTIVE, S, LIGHTS, L>> = Box::default();
        (read(&mut scanner.start(picture)), splits)
    })
}

/// The triangles of a picture as they lie on the screen.
#[must_use]
pub fn polygons<const LIGHTS: usize, L: LightSource>(picture: &beamshade::Picture<'_, '_, LIGHTS, L>) -> Vec<Polygon> {
    let polygon = |(source, corners): (beamshade::Source, [Vertex<LIGHTS>; 3])| Polygon {
        owner: owner(source),
        corners: corners.map(|corner| [corner.point().x, corner.point().y]),
        nearness: corners.map(|corner| corner.nearness()),
    };
    picture.outlines().map(polygon).collect()
}

/// The library's name of a triangle, in the reference's words.
#[must_use]
pub fn owner(source: beamshade::Source) -> Owner {
    Owner { object: source.object.into(), triangle: source.triangle.into() }
}

/// All lines of a picture, with the owners of its pixels.
pub fn read<P: Ink, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource>(
    lines: &mut Lines<'_, '_, ACTIVE, S, LIGHTS, L>,
) -> Picture<P> {
    read_by(lines)
}

/// The same with any visibility.
pub fn read_by<P: Ink, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource, V: Visibility>(
    lines: &mut Lines<'_, '_, ACTIVE, S, LIGHTS, L, V>,
) -> Picture<P> {
    let size = lines.viewport().size;
    let mut picture = Picture::blank(size.width as usize, size.height as usize, P::plain(Color::BLACK));
    let (mut colors, mut owners) = (picture.color.chunks_mut(picture.width), picture.owner.chunks_mut(picture.width));
    for y in 0..size.height as u16 {
        let (Some(row), Some(row_owners)) = (colors.next(), owners.next()) else { break };
        lines.line(y, row);
        lines.spans(y, |span, source| {
            row_owners[usize::from(span.start)..usize::from(span.end)].fill(Some(owner(source)));
        });
    }
    picture
}

/// The same by lines that know transparency, with the opaque triangle of each pixel, be it behind a transparent one or not.
pub fn read_transparent<P: Ink, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource, V: Visibility>(
    lines: &mut Lines<'_, '_, ACTIVE, S, LIGHTS, L, V>,
) -> (Picture<P>, Vec<Option<Owner>>) {
    let mut picture = read_by(lines);
    let mut opaque = vec![None; picture.owner.len()];
    let rows = picture.color.chunks_mut(picture.width).zip(opaque.chunks_mut(picture.width));
    for ((row, opaque), y) in rows.zip(0..) {
        row.fill(P::plain(Color::BLACK));
        lines.transparent_line(y, row);
        lines.opaque_spans(y, |span, source| {
            opaque[usize::from(span.start)..usize::from(span.end)].fill(Some(owner(source)));
        });
    }
    (picture, opaque)
}
