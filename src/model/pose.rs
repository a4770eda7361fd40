//! Where an object stands.

use crate::math::{angle::Turn, length, quotient::quotient, rotation::Rotation, vector::Vector, Length};

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

    /// A place in the world as a mesh of that extent has it in this pose: in 2⁻¹⁶ of the extent, saturating.
    #[must_use]
    pub(crate) fn back(&self, place: [Length; 3], extent: Length) -> [i32; 3] {
        let apart = |place: Length, position: Length| {
            (i64::from(place.to_bits()) - i64::from(position.to_bits())).clamp(-(1 << 30), 1 << 30) as i32
        };
        let ([x, y, z], [px, py, pz]) = (place, self.position);
        let Vector(turned) = self.rotation.inverse().turn(Vector([apart(x, px), apart(y, py), apart(z, pz)]));
        // Q16 over Q32.
        let size = i64::from(self.scale.to_bits()) * i64::from(extent.to_bits());
        turned.map(|c| {
            let place = quotient(u64::from(c.unsigned_abs()) << 32, size.max(1) as u64).min(FARTHEST);
            c.signum() * place as i32
        })
    }
}

/// So far that the direction changes no more: 2¹⁴ extents.
const FARTHEST: u64 = 1 << 30;
