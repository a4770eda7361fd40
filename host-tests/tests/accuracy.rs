//! The gates on accuracy: T880 by the default method, the worst of 60 frames; `cargo xtask accuracy` prints what is held here.

use beamshade::DuffBarycentric;
use host_tests::{
    accuracy::{self, Row, Truth},
    scenes,
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
    assert!(worst.psnr_db >= 60.0, "{worst:?}");
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
    assert!(worst.psnr_db >= 58.0, "{worst:?}");
    assert!(worst.same_owner_share >= 0.98, "{worst:?}");
}
