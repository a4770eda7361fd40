//! Where an object stands.

use crate::math::{angle::Turn, length, rotation::Rotation, Length};

/// Rotation, then uniform scale, then translation: from a mesh's space to the world's.
///
/// The scale is uniform so that light can be turned into the object's space: normals are never transformed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pose {
    pub(crate) rotation: Rotation,
    pub(crate) scale: Length,
    pub(crate) position: [Length; 3],
}

impl Pose {
    /// At the origin, unturned, in the mesh's own size.
    pub const IDENTITY: Self = Self { rotation: Rotation::NONE, scale: Length::ONE, position: [Length::ZERO; 3] };

    /// Turned about the origin.
    #[must_use]
    pub const fn turned(rotation: Rotation) -> Self {
        Self { rotation, ..Self::IDENTITY }
    }

    /// Turned about the y axis.
    #[must_use]
    pub const fn turned_y(angle: Turn) -> Self {
        Self::turned(Rotation::y(angle))
    }

    /// The same at another place in the world, −1024 to 1024 in each direction from the camera.
    #[must_use]
    pub const fn at(mut self, [x, y, z]: [f32; 3]) -> Self {
        self.position = [length(x), length(y), length(z)];
        self
    }

    /// The same in another size. Scale times the mesh's extent counts up to 512; 0 and less make the object a point.
    #[must_use]
    pub const fn scaled(mut self, scale: f32) -> Self {
        self.scale = length(scale);
        self
    }
}
