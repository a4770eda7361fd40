//! The standard scenes by either visibility, and by the by-polygon z-buffer.

use anyhow::Result;
use beamshade::{DepthLine, DuffBarycentric, Light, Spanning};
use embedded_graphics::pixelcolor::Rgb565;
use glam::{DMat3, DVec3};
use host_tests::library::{self, Meshes};
use host_tests::reference::{by_polygon, Mesh, Object, Polygon, Pose, Scene};
use host_tests::scenes::{self, Subject};
use host_tests::{shapes, Owner, Picture};

/// Frames of a turn: all of them would be slow without optimisation.
fn frames() -> impl Iterator<Item = u32> {
    (0..scenes::FRAMES).step_by(if cfg!(debug_assertions) { 10 } else { 1 })
}

/// Checks that all draw the same; returns the number of pixels at which the by-polygon z-buffer has another owner, and the largest
/// difference of nearness there, in parts of the nearer one.
fn check(scene: &Scene<'_>) -> Result<(usize, f64)> {
    let meshes = Meshes::of(scene)?;
    let drawn: Picture<Rgb565> = library::draw_by::<Spanning, _, DuffBarycentric, 1, Light>(scene, &meshes)?;
    assert!(library::draw_by::<DepthLine<240>, Rgb565, DuffBarycentric, 1, Light>(scene, &meshes)? == drawn);
    assert!(library::draw_by::<DepthLine<100>, Rgb565, DuffBarycentric, 1, Light>(scene, &meshes)? == drawn);

    assert!(drawn.covered() > 1000);
    library::frame(scene, &meshes, |picture: beamshade::Picture<'_, '_, 1>| {
        let polygons = library::polygons(&picture);
        let expected = by_polygon(&polygons, drawn.width, drawn.height);
        let near = |owner: Option<Owner>, pixel: usize| {
            let polygon: &Polygon = polygons.iter().find(|polygon| Some(polygon.owner) == owner).expect("covered by both");
            polygon.nearness_at(pixel % drawn.width, pixel / drawn.width)
        };
        let other = (0..expected.len()).filter(|&pixel| drawn.owner[pixel] != expected[pixel]);
        let apart = |pixel| 1.0 - near(drawn.owner[pixel], pixel) / near(expected[pixel], pixel);
        other.fold((0, 0.0), |(count, most), pixel| (count + 1, f64::max(most, apart(pixel))))
    })
}

/// Checks frames of a scene; returns how many pixels differ in the mean, and the largest difference.
fn check_all<'m>(scene: impl Fn(u32) -> Scene<'m>) -> Result<(f64, f64)> {
    let (mut sum, mut most) = (0, 0.0);
    for frame in frames() {
        let (count, apart) = check(&scene(frame))?;
        (sum, most) = (sum + count, f64::max(most, apart));
    }
    let mean = f64::from(sum as u32) / frames().count() as f64;
    println!("{mean:.2} pixels a frame, at most {most:.2e} apart");
    Ok((mean, most))
}

#[test]
fn the_teapots_look_the_same_by_all() -> Result<()> {
    for mesh in [scenes::teapot_880()?, scenes::teapot_5560()?] {
        let (mean, most) = check_all(|frame| scenes::standard(&mesh, scenes::ORANGE, frame))?;
        assert!(mean < 1.0 && most < 1e-4);
    }
    Ok(())
}

/// A ring and a ball through each other and through the teapot.
fn through_each_other<'m>([teapot, ring, ball]: [&'m Mesh; 3], frame: u32) -> Scene<'m> {
    let mut scene = scenes::standard(teapot, scenes::ORANGE, frame);
    let rotation = DMat3::from_rotation_x(0.1 * f64::from(frame));
    let more = [(ring, 0.9, DVec3::ZERO), (ball, 0.55, DVec3::new(0.2, 0.1, 0.3))];
    scene.objects.extend(more.map(|(mesh, scale, translation)| Object {
        mesh,
        materials: vec![scenes::WHITE],
        pose: Pose { rotation, scale, translation },
    }));
    scene
}

#[test]
fn three_objects_through_each_other_look_the_same_by_all() -> Result<()> {
    let (teapot, ring, ball) = (scenes::teapot_880()?, shapes::torus(12), shapes::sphere(9));
    let (mean, most) = check_all(|frame| through_each_other([&teapot, &ring, &ball], frame))?;
    assert!(mean < 1.0 && most < 1e-4);
    Ok(())
}

#[test]
fn the_cases_look_the_same_by_all() -> Result<()> {
    for subject in Subject::ALL {
        let mesh = subject.mesh()?;
        for frame in subject.frames().step_by(if cfg!(debug_assertions) { 20 } else { 1 }) {
            let case = scenes::Case { subject, light: scenes::Illumination::Directional, exponent: 20 };
            check(&case.scene(&mesh, frame))?;
        }
    }
    Ok(())
}

/// A depth line that is named in a scanner's type takes six bytes a pixel, and spanning none.
#[test]
fn what_visibility_takes() {
    type With<V> = beamshade::Scanner<96, DuffBarycentric, 1, Light, V>;
    assert_eq!(size_of::<With<Spanning>>(), size_of::<beamshade::Scanner<96>>());
    assert_eq!(size_of::<With<DepthLine<240>>>(), size_of::<beamshade::Scanner<96>>() + 6 * 240);
}
