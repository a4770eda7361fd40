//! The scenes: Newell's teapot of 880 triangles or another mesh, turning once, in Rgb565.

use beamshade::{Camera, Color, Line, Lines, Pose, Rotation, Scanner, Turn};
use embedded_graphics::{
    geometry::Size,
    pixelcolor::{Rgb565, RgbColor},
};

include!(concat!(env!("OUT_DIR"), "/mesh.rs"));
include!(concat!(env!("OUT_DIR"), "/counts.rs"));

#[cfg(feature = "phong")]
type Method = beamshade::Phong;
#[cfg(feature = "phong-planes")]
type Method = beamshade::PhongPlanes;
#[cfg(feature = "duff-direct")]
type Method = beamshade::DuffDirect;
#[cfg(feature = "duff-differences")]
type Method = beamshade::DuffDifferences;
#[cfg(feature = "duff-barycentric")]
type Method = beamshade::DuffBarycentric;
#[cfg(feature = "hybrid")]
type Method = beamshade::Hybrid;
#[cfg(feature = "hybrid-8")]
type Method = beamshade::Hybrid<8>;
#[cfg(feature = "quadratic-dots")]
type Method = beamshade::QuadraticDots;
#[cfg(feature = "bishop-weimer")]
type Method = beamshade::BishopWeimer;
#[cfg(feature = "quadratic-intensity")]
type Method = beamshade::QuadraticIntensity;
#[cfg(feature = "angular-trapezia")]
type Method = beamshade::AngularTrapezia;
#[cfg(feature = "angular-triangle")]
type Method = beamshade::AngularTriangle;
#[cfg(feature = "gouraud-phong")]
type Method = beamshade::GouraudPhong;
#[cfg(feature = "linear-angle")]
type Method = beamshade::LinearAngle;
#[cfg(feature = "linear-angle-byte")]
type Method = beamshade::LinearAngle<beamshade::shade::linear_angle::Byte>;
#[cfg(feature = "flat")]
type Method = beamshade::Flat;
#[cfg(feature = "degrading")]
type Method = beamshade::Degrading;
#[cfg(any(feature = "gouraud", feature = "regular-split", feature = "highlight-split"))]
type Method = beamshade::Gouraud;

#[cfg(feature = "parts")]
type Shading = crate::parts::Parts<Method>;
#[cfg(not(feature = "parts"))]
type Shading = Method;

#[cfg(feature = "depth-line")]
type Seeing = beamshade::DepthLine<WIDTH>;
#[cfg(not(feature = "depth-line"))]
type Seeing = beamshade::Spanning;

#[cfg(feature = "ahead")]
#[path = "ahead.rs"]
mod ahead;
#[cfg(feature = "ways")]
#[path = "ways.rs"]
mod ways;

/// T880: 240×240 pixels, one directional light; the same at 320×240 pixels, with finer meshes, and with a sphere of 80 triangles that
/// fills the picture.
#[cfg(any(
    feature = "t880",
    feature = "t880-parts",
    feature = "t880-320",
    feature = "t5560",
    feature = "i80",
    feature = "growth"
))]
mod setting {
    use beamshade::Light;

    pub(super) type Source = Light;
    pub(super) const LIGHTS: usize = 1;
    pub(super) const WIDTH: usize = if cfg!(feature = "t880-320") { 320 } else { HEIGHT };
    pub(super) const HEIGHT: usize = if cfg!(feature = "growth") { size() } else { 240 };
    pub(super) const FRAMES: u16 = match () {
        _ if cfg!(feature = "parts") => 4,
        _ if cfg!(feature = "growth") => 12,
        _ => 60,
    };
    /// What faces the eye in the worst frame, and what crosses the worst line: pairs of triangles, and single ones.
    pub(super) const SEEN: usize = match () {
        _ if cfg!(any(feature = "i80", feature = "growth")) => super::TRIANGLES,
        _ if cfg!(feature = "t5560") => 1506,
        _ if cfg!(feature = "smooth") => 264,
        _ => 252,
    };
    pub(super) const ACTIVE: usize = match () {
        _ if cfg!(feature = "growth") => 384,
        _ if cfg!(feature = "t5560") => 94,
        _ if cfg!(feature = "smooth") => 40,
        _ => 37,
    };

    /// The number in the variable BEAMSHADE_SIZE of the build, or 240.
    const fn size() -> usize {
        let Some(text) = option_env!("BEAMSHADE_SIZE") else { return 240 };
        match usize::from_str_radix(text, 10) {
            Ok(size) => size,
            Err(_) => panic!("BEAMSHADE_SIZE is no number"),
        }
    }

    pub(super) fn lights() -> [Light; LIGHTS] {
        [Light::directional([-0.5, 0.7, 0.6])]
    }
}

/// Three teapots through each other under the same light.
#[cfg(feature = "three-objects")]
mod setting {
    use beamshade::Light;

    pub(super) type Source = Light;
    pub(super) const LIGHTS: usize = 1;
    pub(super) const WIDTH: usize = 240;
    pub(super) const HEIGHT: usize = 240;
    pub(super) const FRAMES: u16 = 60;
    pub(super) const SEEN: usize = 3 * 252;
    pub(super) const ACTIVE: usize = 3 * 37;

    pub(super) fn lights() -> [Light; LIGHTS] {
        [Light::directional([-0.5, 0.7, 0.6])]
    }
}

/// Random scenes, T880 and three teapots under one directional light.
#[cfg(feature = "ways")]
mod setting {
    use beamshade::Light;

    pub(super) type Source = Light;
    pub(super) const LIGHTS: usize = 1;
    pub(super) const WIDTH: usize = 240;
    pub(super) const HEIGHT: usize = 240;
    pub(super) const FRAMES: u16 = super::ways::FRAMES;
    pub(super) const SEEN: usize = super::ways::SEEN;
    pub(super) const ACTIVE: usize = 512;

    pub(super) fn lights() -> [Light; LIGHTS] {
        [Light::directional([-0.5, 0.7, 0.6])]
    }
}

/// The same under four directional lights.
#[cfg(feature = "t880-four-lights")]
mod setting {
    use beamshade::Light;

    pub(super) type Source = Light;
    pub(super) const LIGHTS: usize = 4;
    pub(super) const WIDTH: usize = 240;
    pub(super) const HEIGHT: usize = 240;
    pub(super) const FRAMES: u16 = 12;
    pub(super) const SEEN: usize = 252;
    pub(super) const ACTIVE: usize = 37;

    pub(super) fn lights() -> [Light; LIGHTS] {
        let light = |towards| Light::directional(towards).intensity(0.4);
        [light([-0.5, 0.7, 0.6]), light([0.7, 0.4, 0.6]), light([0.0, -0.5, 0.8]), light([-0.8, 0.1, 0.3])]
    }
}

/// The same with one point light and the viewer in the scene.
#[cfg(any(feature = "t880-point-light", feature = "t880-point-parts"))]
mod setting {
    use beamshade::SceneLight;

    pub(super) type Source = SceneLight;
    pub(super) const LIGHTS: usize = 1;
    pub(super) const WIDTH: usize = 240;
    pub(super) const HEIGHT: usize = 240;
    pub(super) const FRAMES: u16 = if cfg!(feature = "parts") { 4 } else { 12 };
    pub(super) const SEEN: usize = 252;
    pub(super) const ACTIVE: usize = 37;

    pub(super) fn lights() -> [SceneLight; LIGHTS] {
        [SceneLight::point([-1.5, 2.1, 1.8])]
    }
}

/// The scene of *Adaptive Shading*, §4: four lights and the viewer in the scene, 256×256 and 512×512 pixels.
#[cfg(any(feature = "adaptive-256", feature = "adaptive-512"))]
mod setting {
    use beamshade::SceneLight;

    pub(super) type Source = SceneLight;
    pub(super) const LIGHTS: usize = 4;
    pub(super) const WIDTH: usize = if cfg!(feature = "adaptive-256") { 256 } else { 512 };
    pub(super) const HEIGHT: usize = WIDTH;
    pub(super) const FRAMES: u16 = 60;
    pub(super) const SEEN: usize = 252;
    pub(super) const ACTIVE: usize = 37;

    pub(super) fn lights() -> [SceneLight; LIGHTS] {
        let light = |place| SceneLight::point(place).intensity(0.4);
        [light([-1.5, 2.1, 1.8]), light([2.1, 1.2, 1.8]), light([0.0, -1.5, 2.4]), light([-2.4, 0.3, 0.9])]
    }
}

use setting::{lights, Source, ACTIVE, FRAMES, HEIGHT, LIGHTS, SEEN, WIDTH};

const OBJECTS: usize = if cfg!(feature = "three-objects") {
    3
} else if cfg!(feature = "ways") {
    // As many vertices as the larger teapot has, and more.
    7
} else {
    1
};

/// Panes of two triangles before them.
const PANES: usize = if cfg!(feature = "pane") { 1 } else { 0 };

/// A square, seen from both sides.
#[cfg(feature = "pane")]
static PANE: beamshade::Mesh<'static> = {
    use beamshade::{Color, Material, Mesh, MeshData};
    const SIDE: i16 = i16::MAX;
    let data = MeshData {
        extent: beamshade::Length::ONE,
        center: [0; 3],
        radius: u16::MAX,
        positions: &[[-SIDE, -SIDE, 0], [SIDE, -SIDE, 0], [SIDE, SIDE, 0], [-SIDE, SIDE, 0]],
        normals: &[[0, 0, 1 << 14]; 4],
        triangles: &[[0, 1, 2], [0, 2, 3]],
        edges: &[[0; 3]; 2],
        parts: &[[2, 0]],
        materials: &[Material::new(Color::rgb(0.3, 0.6, 1.0)).exponent(20).double_sided().opacity(0.4)],
    };
    match Mesh::new(data) {
        Ok(mesh) => mesh,
        Err(_) => panic!(),
    }
};

/// Room for the parts of split triangles, and for their vertices.
const MADE: usize = if cfg!(any(feature = "regular-split", feature = "highlight-split")) {
    8192
} else if cfg!(feature = "ways") {
    1024
} else {
    0
};

#[cfg(feature = "lean")]
type TeapotFrame = beamshade::LeanFrame<'static, SEEN, HEIGHT, LIGHTS, OBJECTS, Source>;
#[cfg(not(feature = "lean"))]
type TeapotFrame = beamshade::Frame<
    'static,
    { VERTICES * OBJECTS + 4 * PANES + 2 * MADE },
    { SEEN + 2 * PANES + MADE },
    { HEIGHT * SUBLINES },
    LIGHTS,
    { OBJECTS + PANES },
    MADE,
    Source,
>;
/// Lines of a picture for each one that is drawn.
const SUBLINES: usize = if cfg!(feature = "smooth") { Camera::SUBLINES as usize } else { 1 };
/// What crosses a line.
const CROSS: usize = ACTIVE + 2 * PANES + MADE / 16;
type TeapotScanner = Scanner<CROSS, Shading, LIGHTS, Source, Seeing>;
type TeapotLines<'s> = Lines<'s, 's, CROSS, Shading, LIGHTS, Source, Seeing>;

/// A row of pixels.
#[derive(Debug)]
pub struct Row {
    pixels: [Rgb565; WIDTH],
    /// What smooth lines blend.
    colors: [Color; if cfg!(feature = "smooth") { SUBLINES * WIDTH } else { 0 }],
}

impl core::ops::Deref for Row {
    type Target = [Rgb565];

    fn deref(&self) -> &[Rgb565] {
        &self.pixels
    }
}

impl core::ops::DerefMut for Row {
    fn deref_mut(&mut self) -> &mut [Rgb565] {
        &mut self.pixels
    }
}

/// A measured scene: all state that rendering it needs, and one row of pixels.
#[derive(Debug)]
pub struct Scene {
    frame: TeapotFrame,
    scanner: TeapotScanner,
    row: Row,
    #[cfg(feature = "ahead")]
    tables: ahead::Tables,
    #[cfg(feature = "ways")]
    tables: ways::Tables,
}

impl Scene {
    /// Frames that are measured: a whole turn.
    pub const FRAMES: u16 = FRAMES;
    /// Lines of a frame.
    pub const LINES: u16 = HEIGHT as u16;
    /// Bytes of the mesh, which lies in flash and does not count as code.
    pub const MESH_BYTES: usize = VERTICES * 12 + TRIANGLES * 12 + 4;
    /// What lies in RAM, by type, with its size in bytes.
    pub const RAM: &'static [(&'static str, usize)] = &[
        ("Frame", size_of::<TeapotFrame>()),
        ("Scanner", size_of::<TeapotScanner>()),
        ("rows", 2 * size_of::<[Rgb565; WIDTH]>()),
        #[cfg(feature = "smooth")]
        ("colours", size_of::<Row>() - size_of::<[Rgb565; WIDTH]>()),
        #[cfg(feature = "ahead")]
        ("tables", size_of::<ahead::Tables>()),
    ];

    /// A scene of which no frame was prepared yet.
    pub const fn new() -> Self {
        Scene {
            frame: TeapotFrame::new(),
            scanner: Scanner::new(),
            row: Row { pixels: [Rgb565::BLACK; WIDTH], colors: [Color::BLACK; _] },
            #[cfg(feature = "ahead")]
            tables: ahead::Tables::new(),
            #[cfg(feature = "ways")]
            tables: ways::Tables::new(),
        }
    }

    /// All that is done once for a frame; false if something had no room.
    #[inline(never)]
    pub fn prepare(&mut self, step: u16) -> bool {
        #[cfg(feature = "ways")]
        return if step < ways::RANDOM { self.prepare_random(step) } else { self.prepare_standard(step) };
        #[cfg(not(feature = "ways"))]
        self.begin(i32::from(step) * 360 / i32::from(FRAMES)).is_some_and(|rotation| self.add_all(rotation) && self.add_panes())
    }

    #[cfg(not(any(feature = "pane", feature = "ways")))]
    const fn add_panes(&self) -> bool {
        true
    }

    #[cfg(feature = "pane")]
    fn add_panes(&mut self) -> bool {
        self.frame.add(&PANE, &Pose::turned_y(Turn::degrees(17)).scaled(0.3).at([0.15, 0.1, 1.0])).is_ok()
    }

    /// Begins a frame; gives how the scene is turned.
    fn begin(&mut self, degrees: i32) -> Option<Rotation> {
        let camera = Camera::new(Size::new(WIDTH as u32, HEIGHT as u32)).field_of_view(Turn::degrees(40)).at_distance(2.45);
        let camera = if cfg!(feature = "smooth") { camera.smooth() } else { camera };
        let rotation = Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(degrees));
        self.frame.begin(&camera, &lights()).is_ok().then_some(rotation)
    }

    #[cfg(not(any(feature = "three-objects", feature = "ways")))]
    fn add_all(&mut self, rotation: Rotation) -> bool {
        let pose = Pose::turned(rotation);
        self.add(&if cfg!(feature = "i80") { pose.scaled(1.25) } else { pose })
    }

    #[cfg(feature = "three-objects")]
    fn add_all(&mut self, rotation: Rotation) -> bool {
        self.add_three(rotation)
    }

    /// The teapot thrice, close to each other, the second one turned over and the third one on its side.
    #[cfg(any(feature = "three-objects", feature = "ways"))]
    fn add_three(&mut self, rotation: Rotation) -> bool {
        let pose = |turned, at| Pose::turned(rotation * turned).scaled(0.75).at(at);
        self.add(&pose(Rotation::NONE, [-0.2, 0.1, 0.0]))
            && self.add(&pose(Rotation::x(Turn::degrees(180)), [0.2, 0.0, 0.1]))
            && self.add(&pose(Rotation::z(Turn::degrees(90)), [0.0, -0.1, -0.1]))
    }

    #[cfg(not(any(feature = "regular-split", feature = "highlight-split")))]
    fn add(&mut self, pose: &Pose) -> bool {
        self.frame.add(&MESH, pose).is_ok()
    }

    /// Triangles are split where a highlight may lie.
    #[cfg(any(feature = "regular-split", feature = "highlight-split"))]
    fn add(&mut self, pose: &Pose) -> bool {
        #[cfg(feature = "regular-split")]
        let split = beamshade::Regular { pixels: 32 };
        #[cfg(feature = "highlight-split")]
        let split = beamshade::AtHighlight::new(0.3);
        let splits = self.frame.add_split(&MESH, pose, &split);
        #[cfg(feature = "host")]
        if let Ok(beamshade::Splits { chosen, split, parts, no_room }) = splits {
            std::println!("split {chosen} {split} {parts} {no_room}");
        }
        splits.is_ok_and(|splits| splits.no_room == 0)
    }

    /// The lines of the frame that was prepared, and a row for them.
    pub fn lines(&mut self) -> (TeapotLines<'_>, &mut Row) {
        (self.scanner.start(self.frame.picture()), &mut self.row)
    }

    /// Shades one of them.
    #[inline(always)]
    pub fn shade(lines: &mut TeapotLines<'_>, y: u16, row: &mut Row) -> Line {
        if cfg!(feature = "transparent") {
            lines.transparent_line(y, &mut row.pixels)
        } else if cfg!(feature = "smooth") {
            lines.smooth_line(y, &mut row.colors, &mut row.pixels)
        } else {
            lines.line(y, &mut row.pixels)
        }
    }
}

impl Default for Scene {
    fn default() -> Self {
        Self::new()
    }
}
