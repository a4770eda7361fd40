//! From meshes to a picture: transform, light, cull, clip, and sort into buckets by line.

use heapless::Vec;

use crate::{
    math::weights::Weights,
    model::{
        camera::Camera,
        clip::{clip, edge_constant, Corner},
        light::{Aim, Light, LightSource},
        material::Color,
        mesh::{Mesh, MeshData},
        pose::Pose,
        projection::{Projection, Short, Sight},
    },
    scan::{
        anew::{Anew, Stored, Vertices, Way},
        bucket::{Buckets, Sorted, TriangleId},
        geometry::{Geometry, Made, Object},
        picture::{Background, Picture, Steps},
        vertex::Vertex,
    },
};

/// One frame's geometry, filled anew for each frame: [`begin`](Frame::begin), then [`add`](Frame::add) each object.
///
/// It owns its memory: 12 bytes a vertex (8 and 4 for each light), 4 a triangle that faces the eye and touches the picture,
/// 2 a line. Two triangles that follow each other in the mesh as a, b, c and a, c, d take the room of one where they are convex
/// together on the screen. `TRIANGLES` is 32767 at most; more does not compile. Meshes are borrowed. `OBJECTS` counts objects in
/// sight; `MADE` triangles and their corners, which take the place of vertices, come from clipping at the near plane and at 1535
/// pixels from the picture's centre, and from [splitting](Frame::add_split) where a highlight may lie; with room for none, no code
/// for either is linked, and what would be clipped is left out whichever way it faces. `V` says whether vertices are stored, as they are
/// but in a [`LeanFrame`].
#[derive(Clone, Debug)]
pub struct Frame<
    'm,
    const VERTICES: usize,
    const TRIANGLES: usize,
    const LINES: usize,
    const LIGHTS: usize = 1,
    const OBJECTS: usize = 4,
    const MADE: usize = 16,
    L: LightSource = Light,
    V: Vertices = Stored,
> {
    pub(crate) camera: Camera,
    background: Background,
    lights: [L; LIGHTS],
    pub(crate) intensities: [u16; LIGHTS],
    pub(crate) vertices: [Vertex<LIGHTS>; VERTICES],
    /// Number of vertices that are there.
    pub(crate) used: usize,
    pub(crate) buckets: Buckets<TRIANGLES, LINES>,
    pub(crate) objects: Vec<Object<'m>, OBJECTS>,
    /// Their ways to the screen, if vertices are made anew.
    ways: Vec<V::Held, OBJECTS>,
    /// The lights as each object sees them.
    pub(crate) aims: Vec<[L::Aim; LIGHTS], OBJECTS>,
    pub(crate) made: Vec<Made, MADE>,
    /// Objects added, those out of sight included.
    added: u16,
    /// Triangles of the objects in sight.
    numbered: u16,
    /// Materials of the objects in sight.
    materials: u16,
}

/// A frame that stores no vertices: each is projected again whenever a triangle of it is culled, starts, turns, is compared, or set up.
///
/// The same pixels for less memory and more time. It takes 4 bytes a triangle or pair, 2 a line, and about 170 an object: for T880 1.8 kB
/// instead of 7.5, so that all of it fits 7 kB with [`Flat`](crate::Flat), at 1.6 to 1.7 times the cycles. Nothing is clipped: triangles
/// that would be are left out, whichever way they face, and counted as [`Full::Made`]; so objects are best wholly in sight, or out of
/// it. Nothing is [split](Frame::add_split), and what a line takes is not [bounded](crate::Price).
///
/// ```
/// # use beamshade::{Camera, Full, LeanFrame, Light, Mesh, Pose, Scanner};
/// # use embedded_graphics::geometry::Size;
/// # fn draw(teapot: &'static Mesh<'static>) -> Result<(), Full> {
/// let mut frame = LeanFrame::<320, 240>::new(); // triangles or pairs that face the eye, lines
/// let mut scanner = Scanner::<48>::new();
/// frame.begin(&Camera::new(Size::new(240, 240)).at_distance(2.45), &[Light::directional([-0.5, 0.7, 0.6])])?;
/// frame.add(teapot, &Pose::IDENTITY)?;
/// let mut lines = scanner.start(frame.picture());
/// lines.line(0, &mut [0u16; 240]);
/// # Ok(())
/// # }
/// ```
pub type LeanFrame<'m, const TRIANGLES: usize, const LINES: usize, const LIGHTS: usize = 1, const OBJECTS: usize = 1, L = Light> =
    Frame<'m, 0, TRIANGLES, LINES, LIGHTS, OBJECTS, 0, L, Anew>;

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
    /// No numbers left for the object's triangles: all meshes in sight and `MADE` together have 65534 at most; nor
    /// more than 65535 materials.
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
        /// Triangles of the object that fitted, clipped ones among them.
        fitted: u16,
        /// Triangles of the object that did not, such as were to be clipped among them.
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
        L: LightSource,
        V: Vertices,
    > Frame<'m, VERTICES, TRIANGLES, LINES, LIGHTS, OBJECTS, MADE, L, V>
{
    /// An empty frame, black; all zeros, so that a `static` takes no flash.
    #[must_use]
    pub const fn new() -> Self {
        const { assert!(V::ARE_STORED || VERTICES == 0, "vertices that are made anew need no room") };
        Self {
            camera: Camera::NONE,
            background: Background::Plain(Color::BLACK),
            lights: [L::OFF; LIGHTS],
            intensities: [0; LIGHTS],
            vertices: [Vertex::NONE; VERTICES],
            used: 0,
            buckets: Buckets::new(),
            objects: Vec::new(),
            ways: Vec::new(),
            aims: Vec::new(),
            made: Vec::new(),
            added: 0,
            numbered: 0,
            materials: 0,
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
    pub fn begin(&mut self, camera: &Camera, lights: &[L; LIGHTS]) -> Result<(), Full> {
        self.camera = *camera;
        self.lights = *lights;
        self.intensities = lights.each_ref().map(L::strength);
        self.used = 0;
        self.buckets.clear(camera.viewport());
        self.objects.clear();
        self.ways.clear();
        self.aims.clear();
        self.made.clear();
        self.added = 0;
        self.numbered = 0;
        self.materials = 0;
        if self.buckets.viewport.size.height as usize > LINES {
            self.buckets.viewport.size.height = LINES as u32;
            return Err(Full::Lines { fitted: LINES as u16 });
        }
        Ok(())
    }

    /// Adds an object.
    ///
    /// # Errors
    /// [`Full`], naming what there was no room for. The frame stays drawable.
    pub fn add(&mut self, mesh: &'m Mesh<'m>, pose: &Pose) -> Result<(), Full> {
        self.add_by(mesh, pose, true)
    }

    /// The same, with triangles kept in pairs where they can be, or one by one.
    pub(crate) fn add_by(&mut self, mesh: &'m Mesh<'m>, pose: &Pose, pairs: bool) -> Result<(), Full> {
        let number = self.added;
        self.added = self.added.saturating_add(1);
        let data = mesh.data();
        let projection = self.camera.project(mesh, pose);
        let sight = projection.sight(data.center, data.radius);
        if matches!(sight, Sight::Hidden) || data.triangles.is_empty() {
            return Ok(());
        }
        let first_vertex = self.used as u16;
        let first_triangle = self.numbered;
        let numbered = usize::from(first_triangle) + data.triangles.len();
        if numbered + MADE > usize::from(TriangleId::MADE) {
            return Err(Full::Numbers { fitted: first_triangle });
        }
        let first_material = self.materials;
        let Some(materials) = u16::try_from(data.materials.len()).ok().and_then(|more| first_material.checked_add(more)) else {
            return Err(Full::Numbers { fitted: first_triangle });
        };
        // Vertices are numbered in 16 bits.
        let room = if V::ARE_STORED { VERTICES.min(0x1_0000) } else { 0x1_0000 }.saturating_sub(self.used);
        if data.positions.len() > room {
            return Err(Full::Vertices { fitted: room as u16 });
        }
        let object = Object { mesh, number, place: self.objects.len() as u16, first_vertex, first_triangle, first_material };
        let aims = self.lights.each_ref().map(|light| light.aim(&self.camera, mesh, pose));
        let way = if let Sight::Whole(way) = sight { Way::Short(way) } else { Way::Long(projection) };
        if self.objects.push(object).is_err() || self.aims.push(aims).is_err() || self.ways.push(V::hold(way)).is_err() {
            return Err(Full::Objects { fitted: OBJECTS as u16 });
        }
        self.numbered = numbered as u16;
        self.materials = materials;
        self.used += data.positions.len();
        if V::ARE_STORED {
            let vertices = self.vertices.get_mut(usize::from(first_vertex)..).unwrap_or_default();
            light::<LIGHTS, L>(&aims, data, vertices);
            match &way {
                Way::Short(way) => place(way, data.positions, vertices),
                Way::Long(way) => {
                    for (vertex, position) in vertices.iter_mut().zip(data.positions) {
                        *vertex = Vertex::new(way.screen(way.eye(*position)), vertex.dots);
                    }
                }
            }
        }
        self.keep(&object, &way, &projection, &aims, pairs)
    }

    /// Culls, clips and sorts the triangles of an object.
    fn keep(
        &mut self,
        object: &Object<'m>,
        way: &Way,
        projection: &Projection,
        aims: &[L::Aim; LIGHTS],
        pairs: bool,
    ) -> Result<(), Full> {
        let data = object.mesh.data();
        let anew = |number: u16| data.positions.get(usize::from(number)).map(|position| way.vertex(*position));
        let mut rest = data.triangles;
        let mut id = object.first_triangle;
        let mut tally = Tally::default();
        for [count, material] in data.parts {
            let double_sided = data.materials.get(usize::from(*material)).is_some_and(|material| material.double_sided);
            let (triangles, others) = rest.split_at_checked(usize::from(*count)).unwrap_or((rest, &[]));
            rest = others;
            let mut triangles = triangles;
            loop {
                let vertices = self.vertices.get(usize::from(object.first_vertex)..self.used).unwrap_or_default();
                let nearness = |number: u16| {
                    if V::ARE_STORED {
                        vertices.get(usize::from(number)).map(|vertex| vertex.nearness())
                    } else {
                        anew(number).map(|corner| corner.nearness())
                    }
                };
                let is_cut = |corners: &[u16; 3]| corners.iter().any(|corner| nearness(*corner) == Some(0));
                let whole = match way {
                    Way::Short(_) => None,
                    Way::Long(_) => triangles.iter().position(is_cut),
                };
                let (run, others) = triangles.split_at_checked(whole.unwrap_or(triangles.len())).unwrap_or((triangles, &[]));
                tally.sorted += if V::ARE_STORED {
                    self.buckets.sort(vertices, run, TriangleId(id), double_sided, pairs)
                } else {
                    self.buckets.sort_anew(anew, run, TriangleId(id), double_sided, pairs)
                };
                id += run.len() as u16;
                let [corners, others @ ..] = others else { break };
                match self.cut(object, *corners, TriangleId(id), double_sided, projection, aims) {
                    Ok(parts) => tally.made += parts,
                    Err(()) => tally.unmade += 1,
                }
                id += 1;
                triangles = others;
            }
        }
        let Tally { sorted: Sorted { fitted, left_out }, made, unmade } = tally;
        if left_out > 0 {
            Err(Full::Triangles { fitted: fitted + made, left_out: left_out + unmade })
        } else if unmade > 0 {
            Err(Full::Made { fitted: made, left_out: unmade })
        } else {
            Ok(())
        }
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
        aims: &[L::Aim; LIGHTS],
    ) -> Result<u16, ()> {
        let data = object.mesh.data();
        let position = |number: u16| data.positions.get(usize::from(number)).copied().unwrap_or_default();
        let corner = |(number, weights): (u16, Weights)| {
            let position = position(number);
            let normal = data.normals.get(usize::from(number)).copied().unwrap_or_default();
            let there = self.vertices.get(usize::from(object.first_vertex) + usize::from(number));
            let vertex = there.filter(|vertex| vertex.nearness() > 0).map(|_| object.first_vertex + number);
            Corner { eye: projection.eye(position), normal, vertex, weights }
        };
        let [w0, w1, w2] = Weights::CORNERS;
        let [n0, n1, n2] = corners;
        let whole_corners = [(n0, w0), (n1, w1), (n2, w2)].map(corner);
        if projection.is_outside(whole_corners.map(|corner| corner.eye)) {
            return Ok(0);
        }
        if MADE == 0 {
            // Nothing can be kept: whoever has no room for parts needs no instruction that makes them.
            return Err(());
        }
        let mut polygon = clip(projection, whole_corners);
        let (used, made, kept) = (self.used, self.made.len(), self.buckets.used);
        for corner in &mut polygon {
            if corner.vertex.is_some() {
                continue;
            }
            let place = corner.weights.mean(corners.map(position)).map(|c| ((c + (1 << 14)) >> 15) as i16);
            let vertex = Vertex::new(projection.screen(corner.eye), aims.each_ref().map(|aim| aim.dots(place, corner.normal)));
            corner.vertex = Some(self.used as u16);
            let Some(room) = self.vertices.get_mut(self.used).filter(|_| self.used <= 0xffff) else {
                self.used = used;
                return Err(());
            };
            *room = vertex;
            self.used += 1;
        }
        let Some((first, rest)) = polygon.split_first() else { return Ok(0) };
        for pair in rest.windows(2) {
            let [second, third] = pair else { continue };
            let [Some(a), Some(b), Some(c)] = [first.vertex, second.vertex, third.vertex] else { continue };
            let id = TriangleId(TriangleId::MADE - self.made.len() as u16);
            let vertices = self.vertices.get(..self.used).unwrap_or_default();
            let sorted = self.buckets.sort(vertices, &[[a, b, c]], id, double_sided, false);
            if sorted.fitted + sorted.left_out == 0 {
                continue;
            }
            let edge = |a: &Corner, b: &Corner| edge_constant(a.normal, b.normal);
            let part = Made {
                whole,
                corners: [a, b, c],
                edges: [edge(first, second), edge(second, third), edge(third, first)],
                weights: [first.weights, second.weights, third.weights],
            };
            if sorted.left_out > 0 || self.made.push(part).is_err() {
                self.buckets.forget(kept);
                self.made.truncate(made);
                self.used = used;
                return Err(());
            }
        }
        Ok(u16::from(self.made.len() > made))
    }

    /// The finished frame.
    #[must_use]
    pub fn picture(&self) -> Picture<'_, 'm, LIGHTS, L> {
        let geometry = Geometry {
            viewport: self.buckets.viewport,
            vertices: self.vertices.get(..self.used).unwrap_or_default(),
            heads: &self.buckets.heads,
            kept: self.buckets.kept.get(..self.buckets.used).unwrap_or_default(),
            objects: &self.objects,
            ways: V::ways(&self.ways),
            anew: V::four,
            made: &self.made,
        };
        Picture {
            geometry,
            background: self.background,
            intensities: &self.intensities,
            aims: &self.aims,
            steps: Steps::NONE,
            lit_anew: V::lit,
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
        L: LightSource,
        V: Vertices,
    > Default for Frame<'_, VERTICES, TRIANGLES, LINES, LIGHTS, OBJECTS, MADE, L, V>
{
    fn default() -> Self {
        Self::new()
    }
}

/// Lights the vertices of an object.
#[inline(never)]
fn light<const LIGHTS: usize, L: LightSource>(aims: &[L::Aim; LIGHTS], data: &MeshData<'_>, vertices: &mut [Vertex<LIGHTS>]) {
    for (vertex, (position, normal)) in vertices.iter_mut().zip(data.positions.iter().zip(data.normals)) {
        vertex.dots = aims.each_ref().map(|aim| aim.dots(*position, *normal));
    }
}

/// Places the vertices of an object that is wholly in sight.
#[inline(never)]
fn place<const LIGHTS: usize>(way: &Short, positions: &[[i16; 3]], vertices: &mut [Vertex<LIGHTS>]) {
    for (vertex, position) in vertices.iter_mut().zip(positions) {
        let (place, nearness) = way.screen(*position);
        vertex.place(place, nearness);
    }
}

/// What became of an object's triangles.
#[derive(Default)]
struct Tally {
    sorted: Sorted,
    /// Clipped.
    made: u16,
    /// To be clipped and left out.
    unmade: u16,
}
