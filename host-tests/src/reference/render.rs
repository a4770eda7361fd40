//! From a scene to its picture.

use glam::{DVec2, DVec3};

use super::clip::{clip_near, Corner};
use super::coverage::Coverage;
use super::light::Lighting;
use super::{Camera, Material, Object, Scene};
use crate::{Owner, Picture};

/// How normals are interpolated over a triangle. Positions always are linear on the triangle in space, so lights and viewers are
/// seen from where the surface is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normals {
    /// Linear on the screen, as in the papers, and as the library does it.
    #[default]
    ScreenLinear,
    /// Linear on the triangle in space.
    PerspectiveCorrect,
}

/// What may be varied in drawing, to tell the causes of an error apart. By default nothing is quantised.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// How normals are interpolated.
    pub normals: Normals,
    /// Steps to the pixel that projected corners are rounded to (256 for 8 subpixel bits); `None` leaves them exact.
    pub snap: Option<f64>,
}

/// Depths this close, relative to each other, are equal: rounding must not decide who is in front.
const DEPTH_TIE: f64 = 1e-12;

/// Draws a scene.
///
/// A triangle cut into a quadrilateral by the near plane is drawn as a fan around the first corner, in the order of the
/// triangle's corners; normals are interpolated over each of the two pieces. A triangle without area on the screen draws
/// nothing. Of equally near triangles the lower (object, triangle) is seen.
///
/// Opaque and transparent triangles are drawn apart. Where the nearest transparent one is in front of the nearest opaque one, or of
/// the background, the pixel is its colour over that one's, and its own; transparent ones behind it are not seen.
///
/// # Panics
///
/// When a triangle refers to a vertex or a material that is not there.
#[must_use]
pub fn render(scene: &Scene, options: Options) -> Picture<[f64; 3]> {
    let Canvas { picture: mut front, nearness, .. } = draw(scene, options, |material| material.opacity == 1.0);
    let clear = draw(scene, options, |material| material.opacity < 1.0);
    for (pixel, owner) in clear.picture.owner.iter().enumerate() {
        let Some(owner) = *owner else { continue };
        let (near, behind) = (clear.nearness[pixel], nearness[pixel]);
        let tie = (near - behind).abs() <= behind * DEPTH_TIE;
        let is_front = if tie { front.owner[pixel].is_none_or(|other| owner < other) } else { near > behind };
        if is_front {
            let object = &scene.objects[owner.object as usize];
            let opacity = object.materials[object.mesh.materials[owner.triangle as usize]].opacity;
            let (own, other) = (clear.picture.color[pixel], front.color[pixel]);
            front.color[pixel] = [0, 1, 2].map(|channel| opacity * own[channel] + (1.0 - opacity) * other[channel]);
            front.owner[pixel] = Some(owner);
        }
    }
    front
}

/// The same without transparent triangles.
///
/// # Panics
///
/// As [`render`].
#[must_use]
pub fn render_opaque(scene: &Scene, options: Options) -> Picture<[f64; 3]> {
    draw(scene, options, |material| material.opacity == 1.0).picture
}

/// Draws the triangles of such materials.
fn draw<'a>(scene: &'a Scene, options: Options, is_drawn: impl Fn(&Material) -> bool) -> Canvas<'a> {
    let camera = &scene.camera;
    let mut canvas = Canvas {
        picture: Picture::blank(camera.width, camera.height, scene.background),
        nearness: vec![0.0; camera.width * camera.height],
        camera,
        lighting: Lighting::new(&scene.lights, camera),
        normals: options.normals,
    };
    for (object, number) in scene.objects.iter().zip(0..) {
        let corners = corners(scene, object);
        for ((triangle, &material), index) in object.mesh.triangles.iter().zip(&object.mesh.materials).zip(0..) {
            if !is_drawn(&object.materials[material]) {
                continue;
            }
            let polygon = clip_near(triangle.map(|vertex| corners[vertex as usize]), camera.near);
            for second in 2..polygon.len() {
                let piece = [polygon[0], polygon[second - 1], polygon[second]];
                let screen = piece.map(|corner| snapped(camera.project(corner.position), options.snap));
                canvas.draw(piece, screen, &object.materials[material], Owner { object: number, triangle: index });
            }
        }
    }
    canvas
}

/// The vertices of an object, positions in view space, normals in the world.
fn corners(scene: &Scene, object: &Object) -> Vec<Corner> {
    let mesh = object.mesh;
    let vertices = mesh.positions.iter().zip(&mesh.normals);
    let corner = |(&position, &normal)| Corner {
        position: scene.camera.view(object.pose.position(position)),
        normal: object.pose.rotation * normal,
    };
    vertices.map(corner).collect()
}

/// A point rounded to the nearest of so many steps to the pixel.
fn snapped(point: DVec2, steps: Option<f64>) -> DVec2 {
    steps.map_or(point, |steps| (point * steps).round() / steps)
}

/// The picture being drawn.
struct Canvas<'a> {
    picture: Picture<[f64; 3]>,
    /// 1 / distance of what each pixel shows, 0 for the background: linear on the screen.
    nearness: Vec<f64>,
    camera: &'a Camera,
    lighting: Lighting<'a>,
    normals: Normals,
}

impl Canvas<'_> {
    fn draw(&mut self, corners: [Corner; 3], screen: [DVec2; 3], material: &Material, owner: Owner) {
        let Some(coverage) = Coverage::new(screen) else { return };
        if !coverage.is_front() && !material.double_sided {
            return;
        }
        let side = if coverage.is_front() { 1.0 } else { -1.0 };
        let nearness = corners.map(|corner| 1.0 / -corner.position.z);
        for (x, y, weights) in coverage.pixels(self.picture.width, self.picture.height) {
            let pixel = y * self.picture.width + x;
            let near = [0, 1, 2].map(|corner| weights[corner] * nearness[corner]);
            let total: f64 = near.iter().sum();
            if total <= self.nearness[pixel] * (1.0 + DEPTH_TIE) {
                continue;
            }
            // Any common factor goes when the normal is brought to length 1.
            let shares = match self.normals {
                Normals::ScreenLinear => weights,
                Normals::PerspectiveCorrect => near,
            };
            let normal: DVec3 = corners.iter().zip(shares).map(|(corner, share)| corner.normal * share).sum();
            self.nearness[pixel] = total;
            self.picture.owner[pixel] = Some(owner);
            let point: DVec3 = corners.iter().zip(near).map(|(corner, share)| corner.position * (share / total)).sum();
            let normal = normal.normalize_or_zero() * side;
            self.picture.color[pixel] = self.lighting.shade(material, normal, self.camera.world(point));
        }
    }
}
