//! Vertices that are stored, or made anew whenever they are needed.

use core::fmt::Debug;

use super::{geometry::Geometry, picture::Picture, vertex::Vertex};
use crate::model::{
    light::{Aim, LightSource},
    projection::{Projection, Short},
};

/// The way of an object's positions to the screen.
#[derive(Clone, Copy, Debug)]
pub enum Way {
    /// Of an object that is wholly in sight.
    Short(Short),
    /// Of any.
    Long(Projection),
}

impl Way {
    /// The vertex there, without light.
    pub(crate) fn vertex(&self, position: [i16; 3]) -> Vertex<0> {
        match self {
            Self::Short(way) => {
                let (place, nearness) = way.screen(position);
                let mut vertex = Vertex::NONE;
                vertex.place(place, nearness);
                vertex
            }
            Self::Long(way) => Vertex::new(way.screen(way.eye(position)), []),
        }
    }
}

/// Where a [`Frame`](crate::Frame) has its vertices: [`Stored`] or [`Anew`].
///
/// A picture knows what makes its vertices anew by pointers: where they are stored there is no instruction of it in flash.
pub trait Vertices: Debug {
    /// What the frame holds of an object.
    type Held: Copy + Debug;

    /// Whether they are stored.
    const ARE_STORED: bool;

    /// What is held of an object whose positions go that way.
    fn hold(way: Way) -> Self::Held;

    /// The ways of all objects, where they are held.
    fn ways(held: &[Self::Held]) -> &[Way];

    /// Four vertices by their numbers in the frame, made anew, without light; none if they are stored.
    fn four<const LIGHTS: usize>(geometry: &Geometry<'_, '_, LIGHTS>, numbers: [u16; 4]) -> Option<[Vertex<LIGHTS>; 4]>;

    /// The same with light.
    fn lit<const LIGHTS: usize, L: LightSource>(
        picture: &Picture<'_, '_, LIGHTS, L>,
        numbers: [u16; 4],
    ) -> Option<[Vertex<LIGHTS>; 4]>;
}

/// Each vertex is projected and lit once a frame, and stored: 8 bytes, and 4 for each light.
#[derive(Clone, Copy, Debug)]
pub struct Stored;

impl Vertices for Stored {
    type Held = ();
    const ARE_STORED: bool = true;

    fn hold(_: Way) {}

    fn ways(_: &[()]) -> &[Way] {
        &[]
    }

    fn four<const LIGHTS: usize>(_: &Geometry<'_, '_, LIGHTS>, _: [u16; 4]) -> Option<[Vertex<LIGHTS>; 4]> {
        None
    }

    fn lit<const LIGHTS: usize, L: LightSource>(_: &Picture<'_, '_, LIGHTS, L>, _: [u16; 4]) -> Option<[Vertex<LIGHTS>; 4]> {
        None
    }
}

/// No vertex is stored: each is projected again whenever a triangle is culled, starts, turns, is compared, or is set up.
#[derive(Clone, Copy, Debug)]
pub struct Anew;

impl Vertices for Anew {
    type Held = Way;
    const ARE_STORED: bool = false;

    fn hold(way: Way) -> Way {
        way
    }

    fn ways(held: &[Way]) -> &[Way] {
        held
    }

    fn four<const LIGHTS: usize>(geometry: &Geometry<'_, '_, LIGHTS>, numbers: [u16; 4]) -> Option<[Vertex<LIGHTS>; 4]> {
        each(numbers, |number| {
            let (object, place) = geometry.origin(number)?;
            let way = geometry.ways.get(usize::from(object.place))?;
            Some(way.vertex(*object.mesh.data().positions.get(place)?).lit([[0; 2]; LIGHTS]))
        })
    }

    fn lit<const LIGHTS: usize, L: LightSource>(
        picture: &Picture<'_, '_, LIGHTS, L>,
        numbers: [u16; 4],
    ) -> Option<[Vertex<LIGHTS>; 4]> {
        let geometry = &picture.geometry;
        each(numbers, |number| {
            let (object, place) = geometry.origin(number)?;
            let (data, object) = (object.mesh.data(), usize::from(object.place));
            let (way, aims) = (geometry.ways.get(object)?, picture.aims.get(object)?);
            let (position, normal) = (data.positions.get(place)?, data.normals.get(place)?);
            Some(way.vertex(*position).lit(aims.each_ref().map(|aim| aim.dots(*position, *normal))))
        })
    }
}

/// What is made of four numbers; of three, the last one being there twice, it is made once.
fn each<T: Copy>([a, b, c, d]: [u16; 4], make: impl Fn(u16) -> Option<T>) -> Option<[T; 4]> {
    let third = make(c)?;
    Some([make(a)?, make(b)?, third, if d == c { third } else { make(d)? }])
}
