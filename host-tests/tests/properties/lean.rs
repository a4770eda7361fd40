//! Frames that store no vertices.

use beamshade::{DuffBarycentric, Frame, LeanFrame, LightSource, Scanner, SceneLight, Source};
use embedded_graphics::pixelcolor::Rgb565;
use proptest::prelude::*;
use std::ops::Range;

use crate::cases;
use crate::scene::{scenes, Scene};

/// Draws a scene with vertices that are stored, and with vertices that are made anew: the same triangles, spans and pixels, but for
/// triangles that would be clipped, which are left out of both.
fn same<const LIGHTS: usize, L: LightSource>(scene: &Scene<LIGHTS>, lights: &[L; LIGHTS]) -> Result<(), TestCaseError> {
    let meshes = scene.meshes();
    let mut stored = Box::<Frame<'_, 2048, 1024, 1024, LIGHTS, 8, 0, L>>::default();
    let mut lean = Box::<LeanFrame<'_, 1024, 1024, LIGHTS, 8, L>>::default();
    let began = stored.background(scene.background).begin(&scene.camera, lights);
    prop_assert_eq!(began, lean.background(scene.background).begin(&scene.camera, lights));
    for (mesh, (_, pose)) in meshes.iter().zip(&scene.objects) {
        let (stored, lean) = (stored.add(mesh, pose), lean.add(mesh, pose));
        prop_assert!(lean.is_err() || stored.is_ok(), "{:?}", stored);
    }
    let (one, other) = (stored.picture(), lean.picture());
    prop_assert_eq!(one.triangles(), other.triangles());
    prop_assert!(one
        .outlines()
        .map(|(source, corners)| (source, corners.map(|corner| (corner.point(), corner.nearness()))))
        .eq(other.outlines().map(|(source, corners)| (source, corners.map(|corner| (corner.point(), corner.nearness()))))));
    let mut scanners = [(); 2].map(|()| Box::<Scanner<256, DuffBarycentric, LIGHTS, L>>::default());
    let [first, second] = &mut scanners;
    let (mut one, mut other) = (first.start(one), second.start(other));
    for y in 0..scene.camera.viewport().size.height as u16 {
        let mut rows = [[Rgb565::new(0, 0, 0); 1024]; 2];
        let [row, other_row] = &mut rows;
        prop_assert_eq!(one.line(y, row), other.line(y, other_row), "line {}", y);
        prop_assert!(row == other_row, "line {}", y);
        let mut seen = [(); 2].map(|()| Vec::<(Range<u16>, Source)>::new());
        let [spans, other_spans] = &mut seen;
        one.spans(y, |span, source| spans.push((span, source)));
        other.spans(y, |span, source| other_spans.push((span, source)));
        prop_assert_eq!(spans, other_spans);
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn vertices_made_anew_are_the_same(scene in scenes::<2>()) {
        same(&scene, &scene.lights)?;
    }

    #[test]
    fn vertices_made_anew_are_lit_the_same_in_the_scene(scene in scenes::<1>(), place in prop::array::uniform3(-2.0..2.0_f32)) {
        same(&scene, &[SceneLight::point(place)])?;
    }
}
