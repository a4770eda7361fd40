//! From meshes to a picture: transform, light, cull, clip, and sort into buckets by line.

use embedded_graphics::{geometry::Point, primitives::Rectangle};
use heapless::Vec;

use crate::{
    math::{
        screen::{area, first_at},
        vector::Vector,
    },
    model::{
        camera::Camera,
        clip::{clip, edge_constant, Corner},
        light::{Aim, Light},
        material::Color,
        mesh::Mesh,
        pose::Pose,
        projection::Projection,
    },
    scan::{
        bucket::{Kept, TriangleId},
        picture::{Background, Made, Object, Picture},
        vertex::Vertex,
    },
};

/// One frame's geometry, filled anew for each frame: [`begin`](Frame::begin), then [`add`](Frame::add) each object.
///
/// It owns its memory: 12 bytes a vertex (8 and 4 for each light), 4 a triangle that faces the eye and touches the picture,
/// 2 a line. Meshes are borrowed. `OBJECTS` counts objects in sight; `MADE` triangles and their corners, which take the place
/// of vertices, come from clipping at the near plane and at 1535 pixels from the picture's centre.
#[derive(Clone, Debug)]
pub struct Frame<
    'm,
    const VERTICES: usize,
    const TRIANGLES: usize,
    const LINES: usize,
    const LIGHTS: usize = 1,
    const OBJECTS: usize = 4,
    const MADE: usize = 16,
> {
    camera: Camera,
    viewport: Rectangle,
    background: Background,
    lights: [Light; LIGHTS],
    intensities: [u16; LIGHTS],
    viewer: Vector,
    vertices: Vec<Vertex<LIGHTS>, VERTICES>,
    heads: [u16; LINES],
    kept: Vec<Kept, TRIANGLES>,
    objects: Vec<Object<'m>, OBJECTS>,
    made: Vec<Made, MADE>,
    /// Objects added, those out of sight included.
    added: u16,
    /// Triangles of the objects in sight.
    numbered: u16,
}

/// A frame has no room for more; it stays drawable, with what fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Full {
    /// The picture has more lines than the frame, which draws the first `fitted`.
    Lines {
        /// Lines of the frame.
        fitted: u16,
    },
    /// No room for one more object in sight.
    Objects {
        /// Objects that fitted before.
        fitted: u16,
    },
    /// No numbers left for the object's triangles: all meshes in sight and `MADE` together have 65534 at most.
    Numbers {
        /// Triangles of objects in sight before.
        fitted: u16,
    },
    /// No room for all vertices of the object, or for more than 65536 in all; it is left out whole.
    Vertices {
        /// Vertices that would have fitted.
        fitted: u16,
    },
    /// No room for all triangles of the object that face the eye: the later ones are left out.
    Triangles {
        /// Triangles of the object that fitted.
        fitted: u16,
        /// Triangles of the object that did not.
        left_out: u16,
    },
    /// No room for all triangles, or their corners, that clipping makes of the object: the later ones are left out.
    Made {
        /// Triangles of the object that were clipped and fitted.
        fitted: u16,
        /// Triangles of the object that were to be clipped and did not fit.
        left_out: u16,
    },
}

impl core::fmt::Display for Full {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match *self {
            Self::Lines { fitted } => write!(f, "the frame has room for {fitted} lines only"),
            Self::Objects { fitted } => write!(f, "the frame has room for {fitted} objects only"),
            Self::Numbers { fitted } => write!(f, "after {fitted} triangles, no numbers are left for all of the object's"),
            Self::Vertices { fitted } => {
                write!(f, "the object has more than the {fitted} vertices that the frame still has room for")
            }
            Self::Triangles { fitted, left_out } => write!(f, "{left_out} triangles left out after {fitted} that fitted"),
            Self::Made { fitted, left_out } => write!(f, "{left_out} clipped triangles left out after {fitted} that fitted"),
        }
    }
}

impl core::error::Error for Full {}

impl<
        'm,
        const VERTICES: usize,
        const TRIANGLES: usize,
        const LINES: usize,
        const LIGHTS: usize,
        const OBJECTS: usize,
        const MADE: usize,
    > Frame<'m, VERTICES, TRIANGLES, LINES, LIGHTS, OBJECTS, MADE>
{
    /// An empty frame, black; all zeros, so that a `static` takes no flash.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            camera: Camera::NONE,
            viewport: Rectangle::zero(),
            background: Background::Plain(Color::BLACK),
            lights: [Light::OFF; LIGHTS],
            intensities: [0; LIGHTS],
            viewer: Vector([0; 3]),
            vertices: Vec::new(),
            heads: [0; LINES],
            kept: Vec::new(),
            objects: Vec::new(),
            made: Vec::new(),
            added: 0,
            numbered: 0,
        }
    }

    /// Fills what no triangle covers with this, in this frame and the next ones.
    pub fn background(&mut self, background: Background) -> &mut Self {
        self.background = background;
        self
    }

    /// Starts a new frame: forgets all objects.
    ///
    /// # Errors
    /// [`Full::Lines`], if the camera's picture is higher than the frame; its first lines can be drawn.
    pub fn begin(&mut self, camera: &Camera, lights: &[Light; LIGHTS]) -> Result<(), Full> {
        self.camera = *camera;
        self.viewport = camera.viewport();
        self.lights = *lights;
        self.intensities = lights.each_ref().map(Light::strength);
        self.viewer = camera.viewer();
        self.vertices.clear();
        self.heads = [0; LINES];
        self.kept.clear();
        self.objects.clear();
        self.made.clear();
        self.added = 0;
        self.numbered = 0;
        if self.viewport.size.height as usize > LINES {
            self.viewport.size.height = LINES as u32;
            return Err(Full::Lines { fitted: LINES as u16 });
        }
        Ok(())
    }

    /// Adds an object.
    ///
    /// # Errors
    /// [`Full`], naming what there was no room for. The frame stays drawable.
    pub fn add(&mut self, mesh: &'m Mesh<'m>, pose: &Pose) -> Result<(), Full> {
        let number = self.added;
        self.added = self.added.saturating_add(1);
        let data = mesh.data();
        let projection = self.camera.project(mesh, pose);
        if projection.hides(data.center, data.radius) {
            return Ok(());
        }
        let first_vertex = self.vertices.len() as u16;
        let first_triangle = self.numbered;
        let numbered = usize::from(first_triangle) + data.triangles.len();
        if numbered + MADE > usize::from(TriangleId::MADE) {
            return Err(Full::Numbers { fitted: first_triangle });
        }
        // Vertices are numbered in 16 bits.
        let room = VERTICES.min(0x1_0000).saturating_sub(self.vertices.len());
        if data.positions.len() > room {
            return Err(Full::Vertices { fitted: room as u16 });
        }
        let object = Object { mesh, number, first_vertex, first_triangle };
        if self.objects.push(object).is_err() {
            return Err(Full::Objects { fitted: OBJECTS as u16 });
        }
        self.numbered = numbered as u16;
        let aims = self.lights.map(|light| light.aim(self.viewer, pose.rotation));
        for (position, normal) in data.positions.iter().zip(data.normals) {
            let place = projection.screen(projection.eye(*position));
            let _ = self.vertices.push(Vertex::new(place, aims.each_ref().map(|aim| aim.dots(*normal))));
        }
        self.keep(&object, &projection, &aims)
    }

    /// Culls, clips and sorts the triangles of an object whose vertices are there.
    fn keep(&mut self, object: &Object<'m>, projection: &Projection, aims: &[Aim; LIGHTS]) -> Result<(), Full> {
        let data = object.mesh.data();
        let mut triangles = data.triangles.iter();
        let mut id = object.first_triangle;
        let (mut fitted, mut left_out) = (0, 0);
        let (mut made, mut unmade) = (0, 0);
        for [count, material] in data.parts {
            let double_sided = data.materials.get(usize::from(*material)).is_some_and(|material| material.double_sided);
            for corners in triangles.by_ref().take(usize::from(*count)) {
                let kept = self.vertices_at(object.first_vertex, *corners).map_or(Fate::Unseen, |[a, b, c]| {
                    if a.nearness() == 0 || b.nearness() == 0 || c.nearness() == 0 {
                        Fate::Clip
                    } else {
                        self.judge([a.point(), b.point(), c.point()], double_sided)
                    }
                });
                match kept {
                    Fate::Unseen => {}
                    Fate::Starts(line) => match self.start(line, TriangleId(id)) {
                        Ok(()) => fitted += 1,
                        Err(()) => left_out += 1,
                    },
                    Fate::Clip => match self.cut(object, *corners, TriangleId(id), double_sided, projection, aims) {
                        Ok(parts) => made += parts,
                        Err(()) => unmade += 1,
                    },
                }
                id += 1;
            }
        }
        if left_out > 0 {
            Err(Full::Triangles { fitted, left_out })
        } else if unmade > 0 {
            Err(Full::Made { fitted: made, left_out: unmade })
        } else {
            Ok(())
        }
    }

    /// The vertices with these numbers, counted from `first`.
    #[inline]
    fn vertices_at(&self, first: u16, corners: [u16; 3]) -> Option<[&Vertex<LIGHTS>; 3]> {
        let [a, b, c] = corners.map(|corner| self.vertices.get(usize::from(first) + usize::from(corner)));
        Some([a?, b?, c?])
    }

    /// Whether a projected triangle faces the eye and can cover a pixel, and from which line on.
    #[inline]
    fn judge(&self, [a, b, c]: [Point; 3], double_sided: bool) -> Fate {
        let area = area(a, b, c);
        if area == 0 || (area > 0 && !double_sided) {
            return Fate::Unseen;
        }
        let lines = |least: i32, most: i32| (first_at(least), first_at(most));
        let (top, bottom) = lines(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y));
        let (left, right) = lines(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x));
        let size = self.viewport.size;
        if top >= bottom || bottom <= 0 || top >= size.height as i32 || left >= right || right <= 0 || left >= size.width as i32 {
            return Fate::Unseen;
        }
        Fate::Starts(top.max(0) as u16)
    }

    /// Puts a triangle into the bucket of the line on which it starts.
    #[inline]
    fn start(&mut self, line: u16, triangle: TriangleId) -> Result<(), ()> {
        let Some(head) = self.heads.get_mut(usize::from(line)) else { return Err(()) };
        self.kept.push(Kept { next: *head, triangle }).map_err(|_| ())?;
        *head = self.kept.len() as u16;
        Ok(())
    }

    /// Clips a triangle and keeps what is left, all of it or nothing; returns 1 if anything is left.
    #[cold]
    #[inline(never)]
    fn cut(
        &mut self,
        object: &Object<'m>,
        corners: [u16; 3],
        whole: TriangleId,
        double_sided: bool,
        projection: &Projection,
        aims: &[Aim; LIGHTS],
    ) -> Result<u16, ()> {
        let data = object.mesh.data();
        let corner = |number: u16| {
            let position = data.positions.get(usize::from(number)).copied().unwrap_or_default();
            let normal = data.normals.get(usize::from(number)).copied().unwrap_or_default();
            let there = self.vertices.get(usize::from(object.first_vertex) + usize::from(number));
            let vertex = there.filter(|vertex| vertex.nearness() > 0).map(|_| object.first_vertex + number);
            Corner { eye: projection.eye(position), normal, vertex }
        };
        let mut polygon = clip(projection, corners.map(corner));
        let (vertices, made, kept) = (self.vertices.len(), self.made.len(), self.kept.len());
        for corner in &mut polygon {
            if corner.vertex.is_some() {
                continue;
            }
            let vertex = Vertex::new(projection.screen(corner.eye), aims.each_ref().map(|aim| aim.dots(corner.normal)));
            corner.vertex = Some(self.vertices.len() as u16);
            if self.vertices.len() > 0xffff || self.vertices.push(vertex).is_err() {
                self.vertices.truncate(vertices);
                return Err(());
            }
        }
        let Some((first, rest)) = polygon.split_first() else { return Ok(0) };
        for pair in rest.windows(2) {
            let [second, third] = pair else { continue };
            let [Some(a), Some(b), Some(c)] = [first.vertex, second.vertex, third.vertex] else { continue };
            let Some([va, vb, vc]) = self.vertices_at(0, [a, b, c]) else { continue };
            let Fate::Starts(line) = self.judge([va.point(), vb.point(), vc.point()], double_sided) else { continue };
            let edge = |a: &Corner, b: &Corner| edge_constant(a.normal, b.normal);
            let part = Made { whole, corners: [a, b, c], edges: [edge(first, second), edge(second, third), edge(third, first)] };
            let id = TriangleId(TriangleId::MADE - self.made.len() as u16);
            if self.made.push(part).is_err() || self.start(line, id).is_err() {
                self.forget(vertices, made, kept);
                return Err(());
            }
        }
        Ok(u16::from(self.made.len() > made))
    }

    /// Takes back all that was made after so many vertices, made and kept triangles.
    fn forget(&mut self, vertices: usize, made: usize, kept: usize) {
        while self.kept.len() > kept {
            let place = self.kept.len() as u16;
            let Some(last) = self.kept.pop() else { break };
            if let Some(head) = self.heads.iter_mut().find(|head| **head == place) {
                *head = last.next;
            }
        }
        self.made.truncate(made);
        self.vertices.truncate(vertices);
    }

    /// The finished frame.
    #[must_use]
    pub fn picture(&self) -> Picture<'_, LIGHTS> {
        Picture {
            viewport: self.viewport,
            background: self.background,
            intensities: &self.intensities,
            vertices: &self.vertices,
            heads: &self.heads,
            kept: &self.kept,
            objects: &self.objects,
            made: &self.made,
        }
    }
}

impl<
        const VERTICES: usize,
        const TRIANGLES: usize,
        const LINES: usize,
        const LIGHTS: usize,
        const OBJECTS: usize,
        const MADE: usize,
    > Default for Frame<'_, VERTICES, TRIANGLES, LINES, LIGHTS, OBJECTS, MADE>
{
    fn default() -> Self {
        Self::new()
    }
}

/// What becomes of a triangle.
enum Fate {
    /// It faces away, is empty, or lies beside the picture.
    Unseen,
    /// It is to be drawn from that line on.
    Starts(u16),
    /// It must be clipped first.
    Clip,
}
