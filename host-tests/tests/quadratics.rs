//! Shading by quadratics: each method against the same in f64, and against true Phong shading.

use beamshade::{BishopWeimer, Hybrid, Light, QuadraticDots, QuadraticIntensity, SceneLight, Shade};
use embedded_graphics::pixelcolor::Gray8;
use glam::{DVec2, DVec3};
use host_tests::library::{self, Meshes};
use host_tests::reference::{render, Object, Options, Pose, Scene};
use host_tests::scenes::{self, Case, Illumination, Subject};
use host_tests::{shapes, Measures, Picture};

/// What a pixel's barycentric coordinates, the unit normals at the corners, and two unit vectors l and h make of a pixel: diffuse
/// and specular intensity at some exponent.
type Method = fn(DVec3, [DVec3; 3], [DVec3; 2], f64) -> [f64; 2];

/// The quadratic through six samples.
fn through_six(place: DVec3, corners: [f64; 3], middles: [f64; 3]) -> f64 {
    let l = place.to_array();
    (0..3).map(|i| l[i] * (2.0 * l[i] - 1.0) * corners[i] + 4.0 * l[i] * l[(i + 1) % 3] * middles[i]).sum()
}

fn middles([a, b, c]: [DVec3; 3]) -> [DVec3; 3] {
    [a + b, b + c, c + a].map(DVec3::normalize)
}

fn quadratic_dots(place: DVec3, normals: [DVec3; 3], lights: [DVec3; 2], exponent: f64) -> [f64; 2] {
    let [diffuse, specular] =
        lights.map(|v| through_six(place, normals.map(|n| n.dot(v)), middles(normals).map(|n| n.dot(v))).clamp(0.0, 1.0));
    [diffuse, specular.powf(exponent)]
}

fn quadratic_intensity(place: DVec3, normals: [DVec3; 3], [l, h]: [DVec3; 2], exponent: f64) -> [f64; 2] {
    let power = |n: DVec3| n.dot(h).max(0.0).powf(exponent);
    let diffuse = through_six(place, normals.map(|n| n.dot(l)), middles(normals).map(|n| n.dot(l)));
    [diffuse.max(0.0), through_six(place, normals.map(power), middles(normals).map(power)).max(0.0)]
}

/// The Taylor quadratic about the centroid, its derivatives by differences, not by the paper's coefficients.
fn bishop_weimer(place: DVec3, normals: [DVec3; 3], lights: [DVec3; 2], exponent: f64) -> [f64; 2] {
    const STEP: f64 = 1e-4;
    let [diffuse, specular] = lights.map(|v| {
        let at = |x: f64, y: f64| {
            let [l1, l2] = [1.0 / 3.0 + x * STEP, 1.0 / 3.0 + y * STEP];
            (normals[0] * (1.0 - l1 - l2) + normals[1] * l1 + normals[2] * l2).normalize_or_zero().dot(v)
        };
        let (x, y) = ((place.y - 1.0 / 3.0) / STEP, (place.z - 1.0 / 3.0) / STEP);
        let middle = at(0.0, 0.0);
        let first = [(at(1.0, 0.0) - at(-1.0, 0.0)) / 2.0, (at(0.0, 1.0) - at(0.0, -1.0)) / 2.0];
        let second = [at(1.0, 0.0) + at(-1.0, 0.0) - 2.0 * middle, at(0.0, 1.0) + at(0.0, -1.0) - 2.0 * middle];
        let mixed = (at(1.0, 1.0) + at(-1.0, -1.0) - at(1.0, -1.0) - at(-1.0, 1.0)) / 4.0;
        (middle + first[0] * x + first[1] * y + second[0] * x * x / 2.0 + second[1] * y * y / 2.0 + mixed * x * y).clamp(0.0, 1.0)
    });
    [diffuse, specular.powf(exponent)]
}

/// The scene's picture by a method in f64, in the reference's outlines.
fn drawn_in_f64(scene: &Scene<'_>, reference: &Picture<[f64; 3]>, method: Method) -> Picture<[f64; 3]> {
    let object = &scene.objects[0];
    let material = &object.materials[0];
    let l = DVec3::new(-0.5, 0.7, 0.6).normalize();
    let lights = [l, (l + DVec3::Z).normalize()];
    let mut picture = reference.clone();
    for (index, (color, owner)) in picture.color.iter_mut().zip(&picture.owner).enumerate() {
        let Some(owner) = owner else { continue };
        let triangle = object.mesh.triangles[owner.triangle as usize];
        let corner = |vertex: u32| object.pose.position(object.mesh.positions[vertex as usize]);
        let [a, b, c] = triangle.map(|vertex| scene.camera.project(scene.camera.view(corner(vertex))));
        let pixel = DVec2::new((index % picture.width) as f64 + 0.5, (index / picture.width) as f64 + 0.5);
        let area = (b - a).perp_dot(c - a);
        let (l1, l2) = ((pixel - a).perp_dot(c - a) / area, (b - a).perp_dot(pixel - a) / area);
        let normals = triangle.map(|vertex| object.pose.rotation * object.mesh.normals[vertex as usize]);
        let [diffuse, specular] = method(DVec3::new(1.0 - l1 - l2, l1, l2), normals, lights, material.exponent);
        *color = [(material.ambient + material.diffuse * diffuse + material.specular * specular).min(1.0); 3];
    }
    picture
}

/// The least PSNR of some frames of the teapot at an exponent: the library's picture against the method in f64, and both against
/// true Phong shading.
fn teapot<S: Shade<1>>(method: Method, exponent: u16) -> [f64; 3] {
    let case = Case { subject: Subject::T880, light: Illumination::Directional, exponent };
    let mesh = case.subject.mesh().unwrap();
    let meshes = Meshes::of(&case.scene(&mesh, 0)).unwrap();
    let mut least = [f64::INFINITY; 3];
    for frame in [0, 18, 45] {
        let scene = case.scene(&mesh, frame);
        let reference = render(&scene, Options::default());
        let drawn = library::draw::<Gray8, S, 1, Light>(&scene, &meshes).unwrap();
        let same = drawn_in_f64(&scene, &reference, method).round::<Gray8>();
        let truth = reference.round::<Gray8>();
        let triangles = scene.triangles();
        let pairs = [(&same, &drawn), (&truth, &drawn), (&truth, &same)];
        for (least, (a, b)) in least.iter_mut().zip(pairs) {
            *least = least.min(Measures::between(a, b, &triangles).psnr_db);
        }
    }
    least
}

fn assert_like_f64<S: Shade<1>>(method: Method, agreement: f64) {
    for exponent in [5, 20, 125] {
        let [same, library, exact] = teapot::<S>(method, exponent);
        assert!(same >= agreement, "exponent {exponent}: {same} dB from the method in f64");
        assert!(library >= exact - 0.2, "exponent {exponent}: {library} dB from the truth, {exact} in f64");
    }
}

#[test]
fn bishop_weimer_is_a_taylor_series() {
    assert_like_f64::<BishopWeimer>(bishop_weimer, 57.0);
}

#[test]
fn quadratic_dots_are_exact_at_six_places() {
    assert_like_f64::<QuadraticDots>(quadratic_dots, 58.0);
}

#[test]
fn quadratic_intensities_are_exact_at_six_places() {
    assert_like_f64::<QuadraticIntensity>(quadratic_intensity, 58.0);
}

/// The least PSNR of a case, and the largest difference.
fn quality<S: Shade<1> + Shade<1, SceneLight>>(case: Case, frames: &[u32]) -> (f64, u8) {
    let mesh = case.subject.mesh().unwrap();
    let meshes = Meshes::of(&case.scene(&mesh, 0)).unwrap();
    let measure = |frame: &u32| {
        let scene = case.scene(&mesh, *frame);
        let drawn = match case.light {
            Illumination::Directional => library::draw::<Gray8, S, 1, Light>(&scene, &meshes),
            Illumination::Point => library::draw::<Gray8, S, 1, SceneLight>(&scene, &meshes),
        };
        let reference = render(&scene, Options::default()).round::<Gray8>();
        let measures = Measures::between(&reference, &drawn.unwrap(), &scene.triangles());
        (measures.psnr_db, measures.max)
    };
    frames.iter().map(measure).fold((f64::INFINITY, 0), |(psnr, max), (p, m)| (psnr.min(p), max.max(m)))
}

#[test]
fn the_hybrid_keeps_to_its_levels() {
    for case in Case::all() {
        let frames: &[u32] = match case.subject {
            Subject::T880 => &[0, 24, 57],
            Subject::I80 | Subject::I320 => &[0, 7],
            _ => continue,
        };
        let (two, four) = (quality::<Hybrid>(case, frames), quality::<Hybrid<4>>(case, frames));
        assert!(two.0 >= 50.0 && four.0 >= 46.0, "{case:?}: {two:?}, {four:?}");
    }
}

/// All methods follow a light and a viewer in the scene, on spheres of 320 triangles.
#[test]
fn lights_in_the_scene() {
    for exponent in [5, 50] {
        let case = Case { subject: Subject::I320, light: Illumination::Point, exponent };
        let found = [
            quality::<BishopWeimer>(case, &[0, 7]),
            quality::<QuadraticDots>(case, &[0, 7]),
            quality::<QuadraticIntensity>(case, &[0, 7]),
            quality::<Hybrid>(case, &[0, 7]),
        ];
        let least = if exponent == 5 { [54.0, 54.0, 50.0, 50.0] } else { [54.0, 54.0, 40.0, 50.0] };
        assert!(found.iter().zip(least).all(|((psnr, _), least)| *psnr >= least), "{exponent}: {found:?}");
    }
}

#[test]
fn the_standard_scene_by_the_hybrid() {
    let mesh = scenes::teapot_880().unwrap();
    let meshes = Meshes::of(&scenes::standard(&mesh, scenes::WHITE, 0)).unwrap();
    let mut least = [f64::INFINITY; 2];
    for frame in (0..60).step_by(3) {
        let scene = scenes::standard(&mesh, scenes::WHITE, frame);
        let reference = render(&scene, Options::default()).round::<Gray8>();
        let two = library::draw::<Gray8, Hybrid, 1, Light>(&scene, &meshes).unwrap();
        let four = library::draw::<Gray8, Hybrid<4>, 1, Light>(&scene, &meshes).unwrap();
        for (least, drawn) in least.iter_mut().zip([two, four]) {
            *least = least.min(Measures::between(&reference, &drawn, &scene.triangles()).psnr_db);
        }
    }
    assert!(least[0] >= 54.0 && least[1] >= 51.1, "{least:?}");
}

/// What hides the left part of a triangle does not change the rest: spans may start anywhere.
fn assert_starts_anywhere<S: Shade<1>>() {
    let (teapot, ball) = (scenes::teapot_880().unwrap(), shapes::sphere(8));
    let alone = scenes::standard(&teapot, scenes::WHITE, 7);
    let mut hidden = alone.clone();
    for place in [DVec3::new(-0.25, 0.0, 1.2), DVec3::new(0.1, 0.1, 1.2)] {
        let pose = Pose { scale: 0.1, translation: place, ..Pose::IDENTITY };
        hidden.objects.push(Object { mesh: &ball, materials: vec![scenes::WHITE], pose });
    }
    let [alone, hidden] = [alone, hidden].map(|scene| {
        let meshes = Meshes::of(&scene).unwrap();
        library::draw::<Gray8, S, 1, Light>(&scene, &meshes).unwrap()
    });
    let mut resumed = 0;
    for index in 1..alone.color.len() {
        if alone.owner[index].is_some() && alone.owner[index] == hidden.owner[index] {
            assert_eq!(alone.color[index], hidden.color[index], "pixel {index}");
            let before = index - 1;
            resumed += usize::from(alone.owner[before] == alone.owner[index] && hidden.owner[before] != hidden.owner[index]);
        }
    }
    assert!(resumed > 50, "{resumed} spans started within their triangle");
}

#[test]
fn spans_start_anywhere() {
    assert_starts_anywhere::<BishopWeimer>();
    assert_starts_anywhere::<QuadraticDots>();
    assert_starts_anywhere::<QuadraticIntensity>();
    assert_starts_anywhere::<Hybrid>();
}
