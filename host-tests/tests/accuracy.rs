//! The gates on accuracy: T880 by the default method, the worst of 60 frames; `cargo xtask accuracy` prints what is held here.

use beamshade::{DuffBarycentric, LinearAngle};
use embedded_graphics::pixelcolor::Gray8;
use host_tests::{
    accuracy::{self, Method, Row, Truth},
    library::{self, Meshes},
    reference::Light,
    scenes::{self, Case, Illumination, Subject},
    shapes,
};

/// Rows of one output against the ideal scene.
fn rows<'r>(all: &'r [Row], output: &str) -> Vec<&'r Row> {
    all.iter().filter(|row| row.output == output && row.truth == Truth::Ideal).collect()
}

#[test]
fn the_default_method_on_the_teapot() {
    let mesh = scenes::teapot_880().unwrap();
    let all = accuracy::standard::<DuffBarycentric>(&mesh, |_| ()).unwrap();

    let gray = rows(&all, "gray8");
    let worst = accuracy::worst(&gray).unwrap();
    assert!(worst.psnr_db >= 59.0, "{worst:?}");
    assert!(worst.mean <= 0.1, "{worst:?}");
    assert!(worst.over4_share <= 0.001, "{worst:?}");
    assert!(worst.same_owner_share >= 0.995, "{worst:?}");
    assert!(worst.wrong_owner <= 2 * gray.len(), "{worst:?}");

    for row in rows(&all, "rgb565") {
        let rounding = row.rounding_db.unwrap();
        assert!(row.measures.psnr_db >= rounding - 0.2, "frame {}: {:?}, rounding alone {rounding}", row.frame, row.measures);
    }
}

#[test]
fn both_teapots_are_owned_by_the_right_triangles() {
    let mesh = scenes::teapot_5560().unwrap();
    let all = accuracy::standard::<DuffBarycentric>(&mesh, |_| ()).unwrap();
    let worst = accuracy::worst(&rows(&all, "gray8")).unwrap();
    assert!(worst.psnr_db >= 57.9, "{worst:?}");
    assert!(worst.same_owner_share >= 0.98, "{worst:?}");
}

#[test]
fn linear_angles_and_gouraud_on_the_teapot() {
    let cases = Case::EXPONENTS.map(|exponent| Case { subject: Subject::T880, light: Illumination::Directional, exponent });
    let methods = ["linear-angle", "linear-angle-byte", "gouraud"].map(|name| Method::named(name).unwrap());
    let outcomes = accuracy::compare(&cases, &methods, |_| ()).unwrap();
    let worst: Vec<_> =
        outcomes.iter().map(|outcome| accuracy::worst(&outcome.rows.iter().collect::<Vec<_>>()).unwrap().psnr_db).collect();
    let documented = [[31.3, 29.0], [30.2, 29.5], [31.6, 30.1], [33.6, 30.9]];
    for (found, [linear, gouraud]) in worst.chunks(3).zip(documented) {
        assert!((found[0] - linear).abs() < 0.06 && (found[2] - gouraud).abs() < 0.06, "{found:?}");
        assert!(found[1] > found[0] - 0.2, "{found:?}");
    }
}

/// Normals that lean away from the light by the same angle at all corners make a facet of one colour; its highlight is lost.
#[test]
fn equal_angles_hide_a_highlight() {
    let mesh = shapes::bent_triangle(26_f64.to_radians());
    let mut scene = scenes::standard(&mesh, scenes::WHITE, 0);
    scene.objects[0].pose.rotation = glam::DMat3::IDENTITY;
    scene.lights = vec![Light::directional(glam::DVec3::Z)];
    let meshes = Meshes::of(&scene).unwrap();
    let linear = library::draw::<Gray8, LinearAngle, 1, beamshade::Light>(&scene, &meshes).unwrap();
    let exact = library::draw::<Gray8, DuffBarycentric, 1, beamshade::Light>(&scene, &meshes).unwrap();
    let levels = |picture: &host_tests::Picture<Gray8>| {
        let covered = picture.color.iter().zip(&picture.owner).filter(|(_, owner)| owner.is_some());
        let levels: Vec<u8> = covered.map(|(color, _)| embedded_graphics::pixelcolor::GrayColor::luma(color)).collect();
        (*levels.iter().min().unwrap(), *levels.iter().max().unwrap())
    };
    let ((least, most), (dark, bright)) = (levels(&linear), levels(&exact));
    assert!(most - least <= 1 && dark.abs_diff(least) <= 3 && bright > most + 40, "{least} {most} {dark} {bright}");
}
