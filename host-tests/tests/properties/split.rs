//! Any scene can be split.

use beamshade::{AtHighlight, Frame, Gouraud, Light, LightSource, Regular, Scanner, SceneLight, Split};
use embedded_graphics::pixelcolor::Gray8;
use host_tests::library::read;
use host_tests::Picture;
use proptest::array::uniform3;
use proptest::prelude::*;

use crate::cases;
use crate::scene::{scenes, Scene};

/// The picture of a scene in other light, its triangles split; and how often one had no room.
fn draw<const V: usize, const M: usize, L: LightSource>(
    scene: &Scene<2>,
    lights: &[L; 2],
    split: Option<&impl Split<2, L>>,
) -> (Picture<Gray8>, u16) {
    let meshes = scene.meshes();
    let mut frame = Box::<Frame<'_, V, 2048, 1024, 2, 8, M, L>>::default();
    let _ = frame.begin(&scene.camera, lights);
    let mut no_room = 0;
    for (mesh, (_, pose)) in meshes.iter().zip(&scene.objects) {
        match split {
            Some(split) => no_room += frame.add_split(mesh, pose, split).map_or(0, |splits| splits.no_room),
            None => drop(frame.add(mesh, pose)),
        }
    }
    let mut scanner = Box::<Scanner<1024, Gouraud, 2, L>>::default();
    (read(&mut scanner.start(frame.picture())), no_room)
}

fn split_every_way<L: LightSource>(scene: &Scene<2>, lights: &[L; 2], pixels: u16, threshold: f32) -> Result<(), TestCaseError> {
    let (regular, highlight) = (Regular { pixels }, AtHighlight::new(threshold));
    let (whole, _) = draw::<2048, 0, L>(scene, lights, None::<&Regular>);
    let (unsplit, _) = draw::<2048, 0, L>(scene, lights, Some(&regular));
    prop_assert!(unsplit == whole);
    let (unsplit, _) = draw::<2048, 0, L>(scene, lights, Some(&highlight));
    prop_assert!(unsplit == whole);
    draw::<4096, 1024, L>(scene, lights, Some(&regular));
    draw::<4096, 1024, L>(scene, lights, Some(&highlight));
    draw::<100, 30, L>(scene, lights, Some(&regular));
    draw::<100, 30, L>(scene, lights, Some(&highlight));
    Ok(())
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn by_lights_far_away(scene in scenes::<2>(), pixels in any::<u16>(), threshold in 0f32..1.0) {
        let lights: [Light; 2] = scene.lights;
        split_every_way(&scene, &lights, pixels >> (pixels % 16), threshold)?;
    }

    #[test]
    fn by_lights_in_the_scene(
        scene in scenes::<2>(), place in uniform3(-4f32..4.0), towards in uniform3(-1f32..1.0), pixels in any::<u16>(),
    ) {
        let lights = [SceneLight::point(place), SceneLight::directional(towards)];
        split_every_way(&scene, &lights, pixels >> (pixels % 16), 0.1)?;
    }
}
