//! Transparent surfaces against the reference.

use std::ops::Range;

use beamshade::{Background, Camera, Color, Frame, Light, Material as Surface, Mesh as Flash, MeshData, Pose as Place, Scanner};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;
use fixed::types::I16F16;
use glam::{DMat3, DVec3};
use host_tests::library::{self, Meshes};
use host_tests::reference::{render, render_opaque, Material, Mesh, Object, Options, Pose, Scene};
use host_tests::scenes::{self, of_glass, standard, with_panes, BEFORE, GLASS, THROUGH};
use host_tests::shapes::{self, pane};
use host_tests::{Format, Measures, Owner, Picture};

/// How two pictures of two levels differ.
#[derive(Debug, Default)]
struct Differences {
    /// Pixels that another triangle shows, in front and behind.
    owners: [usize; 2],
    /// Of those, the ones around which the reference shows it nowhere.
    far: [usize; 2],
    /// Pixels that are blended with a triangle, and with the background.
    blended: [usize; 2],
    /// The largest difference of a channel where both owners are the same, in levels of 255.
    largest: u8,
    /// Of all pixels.
    psnr_db: f64,
}

impl Differences {
    /// Whether they are those of single pixels at edges, and of rounding.
    fn are_small(&self, least_db: f64) -> bool {
        let Self { owners, far, largest, psnr_db, .. } = *self;
        owners.iter().all(|count| *count <= 40) && far[0] <= 2 && far[1] <= 4 && largest <= 2 && psnr_db >= least_db
    }
}

fn compare(scene: &Scene<'_>) -> Differences {
    let draw = |picture: beamshade::Picture<'_, '_>| {
        library::read_transparent::<Rgb888, _, 1024, 1, _, _>(&mut Box::<Scanner<1024>>::default().start(picture))
    };
    let (drawn, behind) = library::frame::<_, 1, Light>(scene, &Meshes::of(scene).unwrap(), draw).unwrap();
    let expected = render(scene, Options::default()).round::<Rgb888>();
    let opaque = render_opaque(scene, Options::default());
    let (width, mut differences) = (expected.width, Differences::default());
    for pixel in 0..drawn.owner.len() {
        let levels = [(drawn.owner[pixel], &expected.owner), (behind[pixel], &opaque.owner)];
        for (level, (seen, expected)) in levels.into_iter().enumerate() {
            let around = (0..9).filter_map(|i| expected.get((pixel + i / 3 * width + i % 3).wrapping_sub(width + 1)));
            differences.owners[level] += usize::from(seen != expected[pixel]);
            differences.far[level] += usize::from(around.clone().all(|owner| *owner != seen));
        }
        if levels.iter().all(|(seen, expected)| *seen == expected[pixel]) {
            let is_clear = |owner: Owner| {
                let object = &scene.objects[owner.object as usize];
                object.materials[object.mesh.materials[owner.triangle as usize]].opacity < 1.0
            };
            if drawn.owner[pixel].is_some_and(is_clear) {
                differences.blended[usize::from(behind[pixel].is_none())] += 1;
            }
            let channels = drawn.color[pixel].levels().into_iter().zip(expected.color[pixel].levels());
            differences.largest = channels.map(|(a, b)| a.abs_diff(b)).fold(differences.largest, u8::max);
        }
    }
    differences.psnr_db = Measures::between(&drawn, &expected, &scene.triangles()).psnr_db;
    differences
}

/// Before the teapot, through it, behind it, two, and through each other and the teapot.
#[test]
fn panes_and_the_teapot() {
    let (teapot, pane) = (scenes::teapot_880().unwrap(), pane());
    let behind = (0.9, [0.0, 0.0, -1.0], 0.0);
    let cases: [(&str, &[_], [Range<usize>; 2], f64); 5] = [
        ("before", &[BEFORE], [4000..40_000, 4000..40_000], 60.0),
        ("through", &THROUGH[..1], [4000..40_000, 4000..40_000], 53.5),
        ("behind", &[behind], [0..1, 4000..40_000], 62.5),
        ("two", &[(0.6, [-0.2, 0.0, 0.7], 0.1), BEFORE], [4000..40_000, 4000..40_000], 56.5),
        ("cross", &THROUGH, [4000..40_000, 4000..40_000], 54.5),
    ];
    for (name, panes, [over_teapot, over_background], least_db) in cases {
        let differences = compare(&with_panes(&teapot, &pane, panes));
        println!("{name}: {differences:?}");
        let [teapot, background] = differences.blended;
        assert!(over_teapot.contains(&teapot) && over_background.contains(&background), "{name}");
        assert!(differences.are_small(least_db), "{name}");
    }
}

/// A glass ball around an opaque one, through a pane: convex glass shows its near side alone.
#[test]
fn a_ball_of_glass() {
    let (ball, pane) = (shapes::icosphere(3), pane());
    let mut scene = with_panes(&ball, &pane, &[(0.9, [0.0; 3], 0.4)]);
    scene.objects[0].pose.scale = 0.4;
    scene.objects[1].materials = vec![Material { opacity: 1.0, ..GLASS }];
    let glass = Material { opacity: 0.3, double_sided: false, ..GLASS };
    let rotation = DMat3::from_rotation_x(0.3);
    scene.objects.push(Object { mesh: &ball, materials: vec![glass], pose: Pose { rotation, scale: 0.7, ..Pose::IDENTITY } });
    let differences = compare(&scene);
    println!("{differences:?}");
    assert!(differences.blended[0] > 10_000 && differences.are_small(61.0));
}

/// A teapot of glass around a ball, as docs/transparent.png shows it.
#[test]
fn a_teapot_of_glass() {
    let (teapot, ball) = (scenes::teapot_880().unwrap(), shapes::icosphere(3));
    let differences = compare(&of_glass(&teapot, &ball));
    println!("{differences:?}");
    assert!(differences.blended[0] > 2000 && differences.blended[1] > 5000 && differences.are_small(58.0));
}

/// Triangles of all sizes through each other, half of them transparent.
#[test]
fn crowds() {
    let mut random = fastrand::Rng::with_seed(7);
    let mut sums = ([0; 2], [0; 2], [0; 2], 0, f64::INFINITY);
    for _ in 0..40 {
        let mut point = |size: f64| DVec3::from_array([(); 3].map(|()| (random.f64() - 0.5) * size));
        let mut mesh = Mesh::new(vec![], vec![], vec![]);
        for triangle in 0..24 {
            let (center, size) = (point(1.2), [1.6, 0.7][triangle % 2]);
            let corners = [(); 3].map(|()| center + point(size));
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
            mesh.triangles.push([0, 1, 2].map(|corner| 3 * triangle as u32 + corner));
            mesh.positions.extend(corners);
            mesh.normals.extend([normal; 3]);
            mesh.materials.push(triangle / 12);
        }
        let mut scene = standard(&mesh, Material { double_sided: true, ..scenes::ORANGE }, 0);
        scene.objects[0].materials.push(Material { opacity: 0.37, ..GLASS });
        let Differences { owners, far, blended, largest, psnr_db } = compare(&scene);
        let (a, b, c, d, e) = sums;
        let add = |a: [usize; 2], b: [usize; 2]| [a[0] + b[0], a[1] + b[1]];
        sums = (add(a, owners), add(b, far), add(c, blended), largest.max(d), psnr_db.min(e));
    }
    let (owners, far, blended, largest, psnr_db) = sums;
    println!("other owners {owners:?}, far {far:?}, blended {blended:?}, largest {largest}, PSNR {psnr_db}");
    assert!(blended[0] > 100_000 && blended[1] > 100_000);
    assert!(owners.iter().zip(blended).all(|(owners, blended)| 100 * owners < blended) && far.iter().all(|far| *far <= 40));
    assert!(largest <= 1 && psnr_db >= 51.0);
}

/// A pane with its colours, before what it holds back of the background.
fn over(background: Background, surface: Surface) -> Picture<Color> {
    let materials = [surface];
    let data = MeshData {
        extent: I16F16::ONE,
        center: [0; 3],
        radius: 32767,
        positions: &[[-9000, -9000, 0], [9000, -9000, 0], [9000, 9000, 0], [-9000, 9000, 0]],
        normals: &[[0, 0, 16384], [0, 8192, 14189], [0, 0, 16384], [8192, 0, 14189]],
        triangles: &[[0, 1, 2], [0, 2, 3]],
        edges: &[[2195; 3]; 2],
        parts: &[[2, 0]],
        materials: &materials,
    };
    let mesh = Flash::new(data).unwrap();
    let mut frame = Box::<Frame<'_, 8, 8, 48>>::default();
    frame
        .background(background)
        .begin(&Camera::new(Size::new(64, 48)).at_distance(3.0), &[Light::directional([0.1, 0.2, 1.0])])
        .unwrap();
    frame.add(&mesh, &Place::IDENTITY.scaled(2.0)).unwrap();
    library::read_transparent(&mut Scanner::<8>::new().start(frame.picture())).0
}

#[test]
fn over_a_gradient_and_over_nothing_known() {
    let [top, bottom] = [Color::rgb(0.1, 0.3, 0.8), Color::rgb(0.9, 0.95, 1.0)];
    let gradient = Background::Gradient { top, bottom };
    let opaque = Surface::new(Color::rgb(0.85, 0.45, 0.2));
    let (drawn, front) = (over(gradient, opaque.opacity(0.4)), over(gradient, opaque));
    let opacity = 102.0 / 256.0;
    for (pixel, owner) in drawn.owner.iter().enumerate() {
        let share = (pixel / drawn.width) as f64 / 47.0;
        for channel in 0..3 {
            let sky = f64::from(top.0[channel]) * (1.0 - share) + f64::from(bottom.0[channel]) * share;
            let own = f64::from(front.color[pixel].0[channel]);
            let expected = if owner.is_some() { opacity * own + (1.0 - opacity) * sky } else { sky };
            assert!((f64::from(drawn.color[pixel].0[channel]) - expected).abs() < 1.1, "{pixel}");
        }
    }
    assert!((200..3000).contains(&drawn.covered()));
    assert!(over(Background::Keep, opaque.opacity(0.4)) == over(Background::Keep, opaque));
}

/// More spans than triangles, in front and behind: what has no room at first comes next.
#[test]
fn more_spans_than_triangles() {
    let triangle = shapes::bent_triangle(0.3);
    let mut scene = with_panes(&triangle, &triangle, &[(0.5, [0.0, 0.1, 0.1], 0.0)]);
    let place = |scale, x, z| Pose { scale, translation: DVec3::new(x, 0.0, z), ..Pose::IDENTITY };
    let opaque = |pose| Object { mesh: &triangle, materials: vec![scenes::ORANGE], pose };
    scene.objects[0] = opaque(place(1.0, 0.0, 0.0));
    scene.objects.extend([-0.25, 0.0, 0.25].map(|x| opaque(place(0.1, x, 0.2))));
    let rows = library::frame::<_, 1, Light>(&scene, &Meshes::of(&scene).unwrap(), |picture| {
        fn row<const ACTIVE: usize>(picture: beamshade::Picture<'_, '_>) -> (Vec<Rgb888>, beamshade::Line) {
            let mut row = vec![Rgb888::new(1, 2, 3); 240];
            let line = Box::<Scanner<ACTIVE>>::default().start(picture).transparent_line(119, &mut row);
            (row, line)
        }
        [row::<5>(picture), row::<1024>(picture)]
    });
    let [(row, line), (expected, _)] = rows.unwrap();
    println!("{line:?}");
    assert_eq!((line.active, line.spans, line.dropped), (5, 9, 0));
    assert!(row == expected);
}

/// The reference's own rule, at one pixel: 0.4 of the nearer pane, 0.6 of the wall.
#[test]
fn the_reference_blends_the_nearest_pane_alone() {
    let pane = pane();
    let flat = |base: [f64; 3], opacity| Material { base, ambient: 1.0, diffuse: 0.0, specular: 0.0, opacity, ..scenes::ORANGE };
    let at = |z, material| Object {
        mesh: &pane,
        materials: vec![material],
        pose: Pose { translation: DVec3::Z * z, ..Pose::IDENTITY },
    };
    let mut scene = standard(&pane, scenes::ORANGE, 0);
    scene.background = [0.0, 0.0, 1.0];
    let middle = |scene: &Scene<'_>| render(scene, Options::default()).color[120 * 240 + 100];
    let near = |a: [f64; 3], b: [f64; 3]| assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12), "{a:?} {b:?}");
    let (glass, red, wall) = (flat([0.0, 1.0, 0.0], 0.4), flat([1.0, 0.0, 0.0], 0.9), flat([1.0; 3], 1.0));
    scene.objects = vec![at(0.0, wall), at(0.2, red), at(0.5, glass)];
    near(middle(&scene), [0.6, 1.0, 0.6]);
    scene.objects[0] = at(0.3, wall);
    near(middle(&scene), [0.6, 1.0, 0.6]);
    scene.objects[0] = at(0.6, wall);
    near(middle(&scene), [1.0; 3]);
    scene.objects.remove(0);
    near(middle(&scene), [0.0, 0.4, 0.6]);
    // Equally near ones: the first.
    scene.objects = vec![at(0.0, glass), at(0.0, wall)];
    near(middle(&scene), [0.6, 1.0, 0.6]);
    scene.objects.reverse();
    near(middle(&scene), [1.0; 3]);
}
