//! The reference against truths that do not come from it: another renderer's picture, rays, and a sphere's own formula.

use std::path::Path;

use embedded_graphics::pixelcolor::{Gray8, Rgb565, Rgb888};
use fastrand::Rng;
use glam::{DMat3, DVec3};
use host_tests::reference::{render, Camera, Light, Material, Mesh, Normals, Object, Options, Pose, Scene, Source, Viewer};
use host_tests::scenes::{self, Case, Illumination, Subject};
use host_tests::{image, shapes, Format, Measures, Owner, Picture};

const CORRECT: Options = Options { normals: Normals::PerspectiveCorrect, snap: None };

/// The frames that a test draws: all of them would be slow without optimisation.
fn frames() -> impl Iterator<Item = u32> {
    (0..scenes::FRAMES).step_by(if cfg!(debug_assertions) { 10 } else { 1 })
}

#[test]
fn frame_0_is_what_another_renderer_drew() {
    let golden = image::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("goldens/T880-frame0-phong-f64.png")).unwrap();
    let mesh = scenes::teapot_880().unwrap();
    let mut scene = scenes::standard(&mesh, scenes::ORANGE, 0);
    let differences = |scene: &Scene| -> Vec<u8> {
        let picture = render(scene, CORRECT).round::<Rgb888>();
        let pixels = picture.color.iter().zip(&golden.color);
        let largest = |a: [u8; 3], b: [u8; 3]| (0..3).map(|channel| a[channel].abs_diff(b[channel])).max().unwrap();
        pixels.map(|(a, b)| largest(a.levels(), b.levels())).filter(|&difference| difference > 0).collect()
    };

    // The other renderer did not round the focal length.
    assert_eq!(differences(&scene), [1; 76]);
    scene.camera.focal = 120.0 / 20_f64.to_radians().tan();
    assert_eq!(differences(&scene), [0; 0]);
}

#[test]
fn the_teapots_are_whole() {
    let mesh = scenes::teapot_880().unwrap();
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (481, 880));
    assert_eq!(scenes::teapot_5560().unwrap().triangles.len(), 5560);
    let covered: f64 =
        frames().map(|frame| render(&scenes::standard(&mesh, scenes::WHITE, frame), CORRECT).covered() as f64).sum();
    let share = covered / frames().count() as f64 / (240.0 * 240.0);
    assert!((0.387..0.397).contains(&share), "covered: {share}");
}

/// Figures of the documents, found with other programs: 54.9 dB between the two ways of interpolating normals (worst
/// frame, in white); with 8 subpixel bits 6 pixels of another owner in a frame.
#[test]
fn what_the_documents_measured_is_measured_again() {
    let mesh = scenes::teapot_880().unwrap();
    let (mut orange, mut white, mut format) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
    let mut elsewhere = 0;
    for frame in frames() {
        let scene = scenes::standard(&mesh, scenes::ORANGE, frame);
        let triangles = scene.triangles();
        let drawn = render(&scene, Options::default());
        let eight = drawn.round::<Rgb888>();
        orange = orange.min(Measures::between(&eight, &render(&scene, CORRECT).round::<Rgb888>(), &triangles).psnr_db);
        format = format.min(Measures::between(&eight, &drawn.round::<Rgb565>(), &triangles).psnr_db);

        let snapped = render(&scene, Options { snap: Some(256.0), ..Options::default() });
        let measures = Measures::between(&eight, &snapped.round::<Rgb888>(), &triangles);
        elsewhere += measures.wrong_owner + measures.wrong_neighbour;

        let scene = scenes::standard(&mesh, scenes::WHITE, frame);
        let pictures = [Options::default(), CORRECT].map(|options| render(&scene, options).round::<Gray8>());
        white = white.min(Measures::between(&pictures[0], &pictures[1], &triangles).psnr_db);
    }
    let elsewhere = elsewhere as f64 / frames().count() as f64;
    println!("perspective: orange {orange:.2} dB, white {white:.2} dB; Rgb565: {format:.2} dB; snapped: {elsewhere:.2}");
    assert!((57.8..59.0).contains(&orange), "{orange}");
    assert!((54.8..56.0).contains(&white), "{white}");
    // Uniform errors of 1/31, 1/63 and 1/31 of the range: 41.9 dB.
    assert!((41.8..42.1).contains(&format), "{format}");
    assert!((4.0..9.0).contains(&elsewhere), "{elsewhere}");
}

const PLAIN: Material = Material { double_sided: true, ..scenes::ORANGE };

/// A camera that looks neither from the origin nor along an axis.
fn camera(near: f64) -> Camera {
    let rotation = DMat3::from_rotation_y(0.7) * DMat3::from_rotation_x(-0.4) * DMat3::from_rotation_z(0.2);
    Camera { width: 64, height: 48, focal: 40.0, near, rotation, position: DVec3::new(1.0, 2.0, 3.0) }
}

fn scene(mesh: &Mesh, camera: Camera) -> Scene<'_> {
    let lights = vec![
        Light { intensity: 0.6, ..Light::directional(DVec3::new(0.2, 0.9, 0.5)) },
        Light { intensity: 0.3, viewer: Viewer::Eye, ..Light::directional(DVec3::new(0.6, 0.0, 0.8)) },
        Light { intensity: 0.4, ..Light::point(DVec3::new(2.0, 2.5, 1.0)) },
    ];
    let objects = vec![Object { mesh, materials: vec![PLAIN], pose: Pose::IDENTITY }];
    Scene { camera, lights, objects, background: [0.0, 0.0, 0.1] }
}

/// The direction in which a pixel is seen, in the world, for a step of 1 along the camera's axis.
fn ray(camera: &Camera, pixel: usize) -> DVec3 {
    let (x, y) = (pixel % camera.width, pixel / camera.width);
    let right = (x as f64 + 0.5 - camera.width as f64 / 2.0) / camera.focal;
    let down = (y as f64 + 0.5 - camera.height as f64 / 2.0) / camera.focal;
    camera.rotation * DVec3::new(right, -down, -1.0)
}

/// Diffuse and specular light on a point of the world, by Phong's model written down once more.
fn intensities(scene: &Scene, normal: DVec3, point: DVec3) -> [f64; 2] {
    let exponent = scene.objects[0].materials[0].exponent as i32;
    let mut sums = [0.0; 2];
    for light in &scene.lights {
        let to_light = match light.source {
            Source::Direction(towards) => towards,
            Source::Point(position) => (position - point) / (position - point).length(),
        };
        let to_viewer = match light.viewer {
            Viewer::Infinity => scene.camera.rotation * DVec3::Z,
            Viewer::Eye => (scene.camera.position - point) / (scene.camera.position - point).length(),
        };
        let half = (to_light + to_viewer) / (to_light + to_viewer).length();
        sums[0] += light.intensity * f64::max(0.0, normal.dot(to_light));
        sums[1] += light.intensity * f64::max(0.0, normal.dot(half)).powi(exponent);
    }
    sums
}

/// The colour of that much light on what all materials here share: white highlights, and these coefficients.
fn mixed(base: [f64; 3], [diffuse, specular]: [f64; 2]) -> [f64; 3] {
    base.map(|base| (0.15 * base + 0.75 * diffuse * base + 0.5 * specular).min(1.0))
}

fn lit(scene: &Scene, normal: DVec3, point: DVec3) -> [f64; 3] {
    mixed(PLAIN.base, intensities(scene, normal, point))
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    DVec3::from(a).distance(b.into())
}

/// Where a ray meets a triangle: distance and barycentric coordinates (Cramer's rule).
fn hit(origin: DVec3, ray: DVec3, [a, b, c]: [DVec3; 3]) -> (f64, [f64; 3]) {
    let solve = |right: DVec3| DMat3::from_cols(b - a, c - a, -ray).inverse() * right;
    let solution = solve(origin - a);
    (solution.z, [1.0 - solution.x - solution.y, solution.x, solution.y])
}

/// Triangles through each other, beyond the picture, across the near plane and behind the eye.
#[test]
fn rays_see_the_same_triangles() {
    let mut random = Rng::with_seed(3);
    let camera = camera(0.5);
    let (mut checked, mut clipped_seen, mut background) = (0, 0, 0);
    for _ in 0..20 {
        let mut point = || DVec3::from([(); 3].map(|()| random.f64() * 2.0 - 1.0));
        let mut positions = vec![];
        let mut normals = vec![];
        for _ in 0..8 {
            let corners = [(); 3].map(|()| camera.position + camera.rotation * (point() * 3.0 - DVec3::Z));
            let clipped = corners.iter().any(|&corner| camera.view(corner).z > -camera.near);
            // A cut edge's new normal is brought to length 1, which bends the normals but for equal ones.
            let normal = point();
            positions.extend(corners);
            normals.extend([(); 3].map(|()| if clipped { normal } else { normal + point() * 0.5 }));
        }
        let mesh = Mesh::new(positions, normals, (0..8).map(|index| [3 * index, 3 * index + 1, 3 * index + 2]).collect());
        let scene = scene(&mesh, camera);
        let picture = render(&scene, CORRECT);

        'pixels: for pixel in 0..picture.color.len() {
            let ray = ray(&camera, pixel);
            let mut nearest: Option<(f64, usize, [f64; 3])> = None;
            for triangle in 0..8 {
                let corners = [0, 1, 2].map(|corner| mesh.positions[3 * triangle + corner]);
                let (distance, weights) = hit(camera.position, ray, corners);
                let edge = weights.into_iter().fold(f64::INFINITY, f64::min);
                if edge.abs() < 1e-9 || (distance - camera.near).abs() < 1e-9 {
                    continue 'pixels; // too close to call
                }
                if edge > 0.0 && distance > camera.near && nearest.is_none_or(|(before, ..)| distance < before) {
                    nearest = Some((distance, triangle, weights));
                }
            }
            checked += 1;
            let Some((far, triangle, weights)) = nearest else {
                background += 1;
                assert_eq!((picture.owner[pixel], picture.color[pixel]), (None, scene.background));
                continue;
            };
            assert_eq!(picture.owner[pixel], Some(Owner { object: 0, triangle: triangle as u32 }));

            let corners = [0, 1, 2].map(|corner| 3 * triangle + corner);
            let [a, b, c] = corners.map(|corner| mesh.positions[corner]);
            let normal: DVec3 = (0..3).map(|corner| mesh.normals[corners[corner]] * weights[corner]).sum();
            let side = if (b - a).cross(c - a).dot(ray) < 0.0 { 1.0 } else { -1.0 };
            assert!(distance(picture.color[pixel], lit(&scene, normal.normalize() * side, camera.position + far * ray)) < 1e-9);
            clipped_seen += usize::from(corners.iter().any(|&at| camera.view(mesh.positions[at]).z > -camera.near));
        }
    }
    assert!(checked > 60_000 && clipped_seen > 10_000 && background > 5_000, "{checked} {clipped_seen} {background}");
}

#[test]
fn a_sphere_is_shaded_by_its_formula() {
    let mesh = shapes::sphere(90);
    let mut scene = scene(&mesh, camera(0.1));
    let camera = scene.camera;
    // Off the middle of the picture, turned and enlarged.
    let center = camera.position + camera.rotation * DVec3::new(0.5, -0.3, -4.0);
    scene.objects[0].pose = Pose { rotation: DMat3::from_rotation_x(1.0), scale: 1.5, translation: center };
    scene.objects[0].materials[0].double_sided = false;
    let picture = render(&scene, CORRECT);

    let mut seen = 0;
    for (pixel, &color) in picture.color.iter().enumerate() {
        let ray = ray(&camera, pixel).normalize();
        let closest = (center - camera.position).dot(ray);
        let miss = (camera.position + closest * ray).distance(center);
        if (miss - 1.5).abs() < 0.01 {
            continue; // the mesh is a little smaller than the sphere
        }
        assert_eq!(picture.owner[pixel].is_some(), miss < 1.5);
        if miss < 1.5 {
            let point = camera.position + (closest - (1.5 * 1.5 - miss * miss).sqrt()) * ray;
            let error = distance(color, lit(&scene, (point - center) / 1.5, point));
            assert!(error < 0.5 / 255.0, "{} levels at {pixel}", error * 255.0);
            seen += 1;
        }
    }
    assert!(seen > 500, "{seen}");
}

/// A triangle in the plane z = x, seen from (0, 0, 4): its corners are 7, 1 and 4 away. The pixel looks along (1/2, 0, −1), to the
/// point (4/3, 0, 4/3), where the corners weigh 7, 47 and 36 of 90: on the screen 7·7, 47·1 and 36·4 of 240.
#[test]
fn lights_see_the_point_in_space_and_normals_the_point_on_the_screen() {
    let position = DVec3::new(0.0, 0.0, 4.0);
    let camera = Camera { width: 31, height: 31, focal: 10.0, near: 0.1, rotation: DMat3::IDENTITY, position };
    let corners = [[-3.0, -4.0, -3.0], [3.0, -4.0, 3.0], [0.0, 6.0, 0.0]].map(DVec3::from);
    let mesh = Mesh::new(corners.to_vec(), vec![DVec3::X, DVec3::Y, DVec3::Z], vec![[0, 1, 2]]);
    let mut scene = scene(&mesh, camera);

    // Straight above the point, so l = (0, 0, 1); v = (−1, 0, 2)/√5.
    let above = Light::point(DVec3::new(4.0 / 3.0, 0.0, 3.0));
    let half = DVec3::new(-1.0, 0.0, 2.0 + 5_f64.sqrt()).normalize();
    let parallel = Light::directional(DVec3::Z);
    for (light, half) in [(above, half), (Light { viewer: Viewer::Eye, ..parallel }, half), (parallel, DVec3::Z)] {
        scene.lights = vec![Light { intensity: 0.5, ..light }];
        for (options, normal) in [(Options::default(), [49.0, 47.0, 144.0]), (CORRECT, [7.0, 47.0, 36.0])] {
            let normal = DVec3::from(normal).normalize();
            let expected = mixed(PLAIN.base, [normal.z / 2.0, normal.dot(half).powi(32) / 2.0]);
            let color = render(&scene, options).color[15 * 31 + 20];
            assert!(distance(color, expected) < 1e-12, "{light:?}, {options:?}: {color:?} is not {expected:?}");
        }
    }
}

/// What one triangle of a scene is, to shade it by: for weights of its corners on the screen, the light there.
type Exact<'a> = &'a dyn Fn([f64; 3]) -> [f64; 2];

/// A picture of one object, its colours made anew from the weights of each pixel's corners.
fn shaded(scene: &Scene, picture: &Picture<[f64; 3]>, method: fn(Exact<'_>, [f64; 3]) -> [f64; 2]) -> Picture<[f64; 3]> {
    let (camera, object) = (&scene.camera, &scene.objects[0]);
    let mut picture = picture.clone();
    for (pixel, owner) in picture.owner.iter().enumerate() {
        let Some(owner) = owner else { continue };
        let corners = object.mesh.triangles[owner.triangle as usize].map(|vertex| vertex as usize);
        let positions = corners.map(|vertex| object.pose.position(object.mesh.positions[vertex]));
        let normals = corners.map(|vertex| object.pose.rotation * object.mesh.normals[vertex]);
        let depths = positions.map(|position| -camera.view(position).z);
        let sum = |weights: [f64; 3]| weights.iter().sum::<f64>();
        let blend = |vectors: [DVec3; 3], weights: [f64; 3]| -> DVec3 {
            let weighted = vectors.into_iter().zip(weights).map(|(vector, weight)| vector * weight);
            weighted.sum::<DVec3>() / sum(weights)
        };
        let exact = |weights: [f64; 3]| {
            let point = blend(positions, [0, 1, 2].map(|corner| weights[corner] / depths[corner]));
            intensities(scene, blend(normals, weights).normalize(), point)
        };
        let (_, weights) = hit(camera.position, ray(camera, pixel), positions);
        let on_screen = [0, 1, 2].map(|corner| weights[corner] * depths[corner]);
        picture.color[pixel] = mixed([1.0; 3], method(&exact, on_screen.map(|weight| weight / sum(on_screen))));
    }
    picture
}

fn flat(exact: Exact<'_>, _: [f64; 3]) -> [f64; 2] {
    exact([1.0; 3])
}

fn gouraud(exact: Exact<'_>, [a, b, c]: [f64; 3]) -> [f64; 2] {
    let corners = [exact([1.0, 0.0, 0.0]), exact([0.0, 1.0, 0.0]), exact([0.0, 0.0, 1.0])];
    [0, 1].map(|kind| a * corners[0][kind] + b * corners[1][kind] + c * corners[2][kind])
}

/// The quadratic through the values at corners and edge middles, not below 0.
fn six_samples(exact: Exact<'_>, [a, b, c]: [f64; 3]) -> [f64; 2] {
    let corners = [exact([1.0, 0.0, 0.0]), exact([0.0, 1.0, 0.0]), exact([0.0, 0.0, 1.0])];
    let middles = [exact([0.0, 1.0, 1.0]), exact([1.0, 0.0, 1.0]), exact([1.0, 1.0, 0.0])];
    [0, 1].map(|kind| {
        let at_corners = [a, b, c].iter().zip(corners).map(|(w, value)| w * (2.0 * w - 1.0) * value[kind]).sum::<f64>();
        let at_middles = [b * c, c * a, a * b].iter().zip(middles).map(|(w, value)| 4.0 * w * value[kind]).sum::<f64>();
        (at_corners + at_middles).max(0.0)
    })
}

/// The documents measured flat and Gouraud shading and quadratics of six samples in f64 on a sphere of 80 triangles and on a big
/// triangle: these scenes are as hard. (Their teapot was coarser than T880.)
#[test]
fn the_cases_are_as_hard_as_the_documents() {
    let documents = [
        (Subject::I80, Illumination::Directional, [22.8, 26.7, 38.5]),
        (Subject::I80, Illumination::Point, [22.2, 26.1, 34.6]),
        (Subject::Triangle, Illumination::Directional, [15.9, 13.7, 28.5]),
    ];
    for (subject, light, expected) in documents {
        let mesh = subject.mesh().unwrap();
        let case = Case { subject, light, exponent: 20 };
        let mut sums = [0.0; 3];
        for frame in subject.frames() {
            let scene = case.scene(&mesh, frame);
            let picture = render(&scene, Options::default());
            let same = shaded(&scene, &picture, |exact, weights| exact(weights));
            assert!(picture.color.iter().zip(&same.color).all(|(&a, &b)| distance(a, b) < 1e-9), "{case:?}");
            for (sum, method) in sums.iter_mut().zip([flat, gouraud, six_samples]) {
                let drawn = shaded(&scene, &picture, method).round::<Gray8>();
                *sum += Measures::between(&picture.round::<Gray8>(), &drawn, &scene.triangles()).psnr_db;
            }
        }
        let means = sums.map(|sum| sum / subject.frames().count() as f64);
        println!("{} {}: {means:.1?} dB, documents {expected:?}", subject.name(), light.name());
        assert!(means.iter().zip(expected).all(|(mean, expected)| (mean - expected).abs() < 1.5), "{case:?}: {means:?}");
    }
}

/// A triangle before the camera, facing it, with that normal.
fn facing(camera: &Camera, normal: DVec3) -> Mesh {
    let corners = [[-1.0, -0.7, -2.1], [1.1, -0.9, -3.3], [0.1, 0.8, -1.7]];
    let world = |corner| camera.position + camera.rotation * DVec3::from(corner);
    Mesh::new(corners.map(world).to_vec(), vec![normal; 3], vec![[0, 1, 2]])
}

#[test]
fn equal_depths_show_the_lower_triangle_and_object() {
    let camera = camera(0.1);
    let mut mesh = facing(&camera, DVec3::Y);
    mesh.triangles = vec![[1, 2, 0], [0, 1, 2], [2, 0, 1]];
    mesh.materials = vec![0; 3];
    let mut scene = scene(&mesh, camera);
    scene.objects.push(scene.objects[0].clone());
    let picture = render(&scene, Options::default());
    assert!(picture.covered() > 300);
    assert!(picture.owner.iter().flatten().all(|&owner| owner == Owner { object: 0, triangle: 0 }));
}

#[test]
fn a_back_face_is_culled_or_lit_from_behind() {
    let camera = camera(0.1);
    let front = facing(&camera, camera.rotation.z_axis);
    let mut back = facing(&camera, -camera.rotation.z_axis);
    back.triangles = vec![[0, 2, 1]];

    let expected = render(&scene(&front, camera), Options::default());
    let mut scene = scene(&back, camera);
    let seen = render(&scene, Options::default());
    assert_eq!(seen.owner, expected.owner);
    assert!(seen.color.iter().zip(&expected.color).all(|(&a, &b)| distance(a, b) < 1e-12));

    scene.objects[0].materials[0].double_sided = false;
    assert_eq!(render(&scene, Options::default()).covered(), 0);
}

#[test]
fn snapping_is_drawing_on_the_grid() {
    let mut random = Rng::with_seed(4);
    let camera = Camera { rotation: DMat3::IDENTITY, position: DVec3::ZERO, focal: 64.0, ..camera(0.1) };
    // At distance 1 a step of the 1/16 px grid is 1/1024 long.
    let mesh = |coordinates: &[[f64; 2]]| {
        let position = |&[x, y]: &[f64; 2]| DVec3::new(x / 1024.0, y / 1024.0, -1.0);
        Mesh::new(coordinates.iter().map(position).collect(), vec![DVec3::Z; 3], vec![[0, 1, 2]])
    };
    for _ in 0..100 {
        let on_grid = [(); 3].map(|()| [f64::from(random.i32(-400..400)), f64::from(random.i32(-300..300))]);
        let beside = on_grid.map(|corner| corner.map(|step| step + random.f64() * 0.98 - 0.49));
        let expected = render(&scene(&mesh(&on_grid), camera), Options::default());
        let snapped = render(&scene(&mesh(&beside), camera), Options { snap: Some(16.0), ..Options::default() });
        assert_eq!(snapped.owner, expected.owner);
    }
}
