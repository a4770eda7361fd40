//! Who looks from where onto which part of the panel.

use embedded_graphics::{
    geometry::{Point, Size},
    primitives::Rectangle,
};

use super::{mesh::Mesh, pose::Pose, projection::Projection};
use crate::math::{
    angle::Turn,
    length,
    quotient::quotient,
    rotation::Rotation,
    screen::{LARGEST, SUBPIXELS},
    vector::{dot_64, Vector},
    Length,
};

/// A pinhole camera. Unturned it looks along −z, with x to the right and y up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Camera {
    viewport: Rectangle,
    field_of_view: Turn,
    near: Length,
    position: [Length; 3],
    /// From the camera's axes to the world's.
    rotation: Rotation,
    /// Of the panel, in quarters, counter-clockwise.
    quarters: u8,
    /// Whether its pictures have sublines.
    is_fine: bool,
}

impl Camera {
    /// A camera that sees nothing; all zeros.
    pub(crate) const NONE: Self = Self {
        viewport: Rectangle::zero(),
        field_of_view: Turn(0),
        near: Length::ZERO,
        position: [Length::ZERO; 3],
        rotation: Rotation([Vector([0; 3]); 3]),
        quarters: 0,
        is_fine: false,
    };

    /// Lines that the picture of a [smooth](Self::smooth) camera has for each line of the panel.
    pub const SUBLINES: u16 = 2;

    /// A camera for a picture of that size, 1024×1024 at most (larger is clamped), at the panel's top left corner;
    /// 40° of vertical field of view, 3 away from the origin on the z axis, near plane at 0.1.
    #[must_use]
    pub const fn new(size: Size) -> Self {
        Self {
            viewport: Rectangle::new(Point::zero(), size),
            field_of_view: Turn::degrees(40),
            near: length(0.1),
            position: [Length::ZERO, Length::ZERO, length(3.0)],
            rotation: Rotation::NONE,
            quarters: 0,
            is_fine: false,
        }
    }

    /// The same with its picture elsewhere on a larger panel.
    #[must_use]
    pub const fn placed_at(mut self, top_left: Point) -> Self {
        self.viewport.top_left = top_left;
        self
    }

    /// The same with another vertical field of view, between 2° and 170°; what lies outside is clamped.
    #[must_use]
    pub const fn field_of_view(mut self, angle: Turn) -> Self {
        let (least, most) = (Turn::degrees(2), Turn::degrees(170));
        self.field_of_view = if angle.0 < least.0 {
            least
        } else if angle.0 > most.0 {
            most
        } else {
            angle
        };
        self
    }

    /// The same at (0, 0, distance).
    #[must_use]
    pub const fn at_distance(self, distance: f32) -> Self {
        self.at([0.0, 0.0, distance])
    }

    /// The same at another place.
    #[must_use]
    pub const fn at(mut self, [x, y, z]: [f32; 3]) -> Self {
        self.position = [length(x), length(y), length(z)];
        self
    }

    /// The same turned: `rotation` takes the camera's axes to the world's.
    #[must_use]
    pub const fn turned(mut self, rotation: Rotation) -> Self {
        self.rotation = rotation;
        self
    }

    /// The same at `eye`, turned to look at `target` with y upright.
    ///
    /// A convenience in `f32` by approximations good to about 0.1°: for exact pictures use [`at`](Self::at) and
    /// [`turned`](Self::turned).
    #[must_use]
    pub fn looking_at(self, eye: [f32; 3], target: [f32; 3]) -> Self {
        use micromath::F32Ext;
        let [x, y, z] = [eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]];
        let yaw = F32Ext::atan2(x, z);
        let pitch = F32Ext::atan2(y, F32Ext::sqrt(x * x + z * z));
        self.at(eye).turned(Rotation::y(Turn::radians(yaw)) * Rotation::x(Turn::radians(-pitch)))
    }

    /// The same with another near plane, 1/1024 to 512 before the eye; what lies outside is clamped.
    #[must_use]
    pub const fn near(mut self, distance: f32) -> Self {
        let bits = length(distance).to_bits();
        let (least, most) = (1 << 6, 512 << 16);
        self.near = Length::from_bits(if bits < least {
            least
        } else if bits > most {
            most
        } else {
            bits
        });
        self
    }

    /// The same for a panel that is mounted turned by so many quarters counter-clockwise; the size stays that of the rows
    /// as the panel takes them.
    #[must_use]
    pub const fn panel_turned(mut self, quarters: u8) -> Self {
        self.quarters = quarters & 3;
        self
    }

    /// The same for [smooth lines](crate::Lines::smooth_line): its picture has two sublines for each line of the size given, which is
    /// 1024×512 at most then, and takes a [`Frame`](crate::Frame) of twice the lines. Whatever else counts lines, such as
    /// [`Lines::line`](crate::Lines::line) and [`Lines::pick`](crate::Lines::pick), counts sublines.
    #[must_use]
    pub const fn smooth(mut self) -> Self {
        self.is_fine = true;
        self
    }

    /// Lines of its picture for each line of the panel.
    const fn sublines(&self) -> u32 {
        1 << self.is_fine as u32
    }

    /// Where the picture lies on the panel, and its size, in [sublines](Self::smooth) if it has them.
    #[must_use]
    pub fn viewport(&self) -> Rectangle {
        let Size { width, height } = self.viewport.size;
        let height = height.min(LARGEST / self.sublines()) * self.sublines();
        Rectangle::new(self.viewport.top_left, Size::new(width.min(LARGEST), height))
    }

    /// The focal length in subpixels: that which makes the field of view span the height as the viewer sees it.
    #[must_use]
    pub fn focal(&self) -> u32 {
        let size = self.viewport().size;
        let height = if self.quarters & 1 == 0 { size.height } else { size.width * self.sublines() };
        let (sin, cos) = self.field_of_view.half().sin_cos();
        let half_height = u64::from(height) * SUBPIXELS as u64 / 2;
        // 1° to 85°: both are positive. The largest focal length, 29 heights, fits 24 bits.
        let [sin, cos] = [sin, cos].map(|part| part.max(1) as u64);
        quotient(half_height * cos + sin / 2, sin).max(1) as u32
    }

    /// The unit vector to the viewer at infinity, in the world.
    #[must_use]
    pub fn viewer(&self) -> Vector {
        self.rotation.turn(Vector([0, 0, 1 << 30]))
    }

    /// Where the viewer is, in the world.
    pub(crate) const fn place(&self) -> [Length; 3] {
        self.position
    }

    /// The way from the positions of that mesh in that pose to the screen.
    #[must_use]
    pub fn project(&self, mesh: &Mesh<'_>, pose: &Pose) -> Projection {
        // The eye's axes: right, down, forward.
        let Rotation([right, down, forward]) = self.panel() * self.rotation.inverse();
        // Where sublines are closer together than columns, all is narrower and the focal length greater.
        let to_eye = Rotation([Vector(right.0.map(|c| c >> u32::from(self.is_fine))), down, forward]);
        let ([x, y, z], [ex, ey, ez]) = (pose.position, self.position);
        let apart = [(x, ex), (y, ey), (z, ez)].map(|(place, eye)| place.saturating_sub(eye).to_bits());
        Projection::new(
            to_eye * pose.rotation,
            i64::from(pose.scale.to_bits()).max(0) * i64::from(mesh.data.extent.to_bits()),
            to_eye.0.map(|row| along(row, apart)),
            self.near,
            self.focal(),
            self.viewport().size,
        )
    }

    /// From the camera's axes (right, up, back) to the panel's (right, down, forward).
    fn panel(&self) -> Rotation {
        let half_turn = Rotation([Vector([1 << 30, 0, 0]), Vector([0, -(1 << 30), 0]), Vector([0, 0, -(1 << 30)])]);
        let quarter = Turn(u32::from(self.quarters) << 30);
        Rotation::z(quarter) * half_turn
    }
}

/// How far along a row of a rotation a place is that is so far away in the world; I12F20, clamped.
#[inline(never)]
fn along(row: Vector, apart: [i32; 3]) -> i32 {
    // Q30 · Q16.
    (dot_64(row.0, apart) >> 26).clamp(-(1 << 30), 1 << 30) as i32
}
