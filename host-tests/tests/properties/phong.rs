//! The methods that are Phong shading itself, on anything that can be described.

use beamshade::{
    model::light::LightSource, Background, Color, DuffDifferences, DuffDirect, Frame, Ink, Intensity, Material, Paint, Phong,
    PhongPlanes, Picture, Scanner, SceneLight, Shade,
};
use proptest::array::uniform3;
use proptest::num::f32::ANY;
use proptest::prelude::*;

use crate::cases;
use crate::scene::{scenes, Scene};

/// A pixel that keeps its light.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lit(Option<Intensity>);

impl Ink for Lit {
    type Paint<'m> = ();

    fn paint(_: &Material) {}

    fn plain(_: Color) -> Self {
        Self(None)
    }
}

impl Paint<Lit> for () {
    fn mix(&self, intensity: Intensity) -> Lit {
        Lit(Some(intensity))
    }
}

/// The light of each pixel, with whose triangle it shows.
fn draw<S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource>(
    picture: Picture<'_, '_, LIGHTS, L>,
) -> Vec<(Lit, Option<(u16, u16)>)> {
    let mut scanner = Box::<Scanner<256, S, LIGHTS, L>>::default();
    let mut lines = scanner.start(picture);
    let mut pixels = Vec::new();
    for y in 0..picture.viewport().size.height as u16 {
        let mut row = [Lit(None); 1024];
        let row = &mut row[..picture.viewport().size.width as usize];
        lines.line(y, row);
        let start = pixels.len();
        pixels.extend(row.iter().map(|lit| (*lit, None)));
        lines.spans(y, |span, source| {
            for x in span {
                pixels[start + usize::from(x)].1 = Some((source.object, source.triangle));
            }
        });
    }
    pixels
}

/// Draws a scene under lights in it.
fn show<T, const LIGHTS: usize>(
    scene: &Scene<LIGHTS>,
    lights: &[SceneLight; LIGHTS],
    see: impl FnOnce(Picture<'_, '_, LIGHTS, SceneLight>) -> T,
) -> T {
    let meshes = scene.meshes();
    let mut frame = Box::<Frame<'_, 2048, 1024, 1024, LIGHTS, 8, 1024, SceneLight>>::default();
    let _ = frame.background(Background::Keep).begin(&scene.camera, lights);
    for (mesh, (_, pose)) in meshes.iter().zip(&scene.objects) {
        let _ = frame.add(mesh, pose);
    }
    see(frame.picture())
}

fn lights() -> impl Strategy<Value = SceneLight> {
    let place = prop_oneof![4 => uniform3(-2f32..2.0), 1 => uniform3(ANY)];
    let intensity = prop_oneof![2 => Just(1.0), 2 => 0f32..1.0, 1 => ANY];
    (any::<bool>(), place, intensity).prop_map(|(is_point, place, intensity)| {
        if is_point { SceneLight::point(place) } else { SceneLight::directional(place) }.intensity(intensity)
    })
}

/// That pixels of the same triangle are the same in both pictures.
fn same_behind<S>(alone: &[(Lit, Option<(u16, u16)>)], whole: &[(Lit, Option<(u16, u16)>)]) {
    for (index, (alone, whole)) in alone.iter().zip(whole).enumerate() {
        if alone.1 == whole.1 {
            assert_eq!(alone, whole, "{} at {index}", std::any::type_name::<S>());
        }
    }
}

proptest! {
    #![proptest_config(cases(256))]

    /// The other objects hide parts of the first one.
    #[test]
    fn pixels_are_the_same_wherever_their_span_starts(scene in scenes::<2>(), lights in [lights(), lights()]) {
        let mut alone = scene.clone();
        alone.objects.truncate(1);
        macro_rules! check {
            ($($method:ty)*) => { $(
                let (few, all) = (alone.show(draw::<$method, 2, _>), scene.show(draw::<$method, 2, _>));
                same_behind::<$method>(&few, &all);
                let (few, all) = (show(&alone, &lights, draw::<$method, 2, _>), show(&scene, &lights, draw::<$method, 2, _>));
                same_behind::<$method>(&few, &all);
            )* };
        }
        check!(Phong PhongPlanes DuffDirect DuffDifferences);
    }

    #[test]
    fn differences_are_the_terms(scene in scenes::<1>(), light in lights()) {
        prop_assert_eq!(scene.show(draw::<DuffDirect, 1, _>), scene.show(draw::<DuffDifferences, 1, _>));
        let lights = [light];
        prop_assert_eq!(show(&scene, &lights, draw::<DuffDirect, 1, _>), show(&scene, &lights, draw::<DuffDifferences, 1, _>));
    }
}
