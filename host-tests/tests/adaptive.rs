//! Adaptive shading: the highlight test, and what is split or shaded by the pixel because of it.

use std::path::Path;

use beamshade::{
    model::{highlight::Bent, light::LightSource},
    AtHighlight, ByHighlight, Camera, Choose, DuffBarycentric, Frame, Full, Gouraud, Light, Material, Mesh, MeshData, Pose,
    Regular, Rotation, Scanner, SceneLight, Shade, Split, Splits, Turn,
};
use beamshade_mesh::{Model, Options, Quantized};
use embedded_graphics::{geometry::Size, pixelcolor::Gray8};
use fixed::types::I16F16;
use glam::DVec3;
use host_tests::{
    library::{self, FromReference, Meshes},
    reference::{render, Scene},
    scenes::{Case, Illumination, Subject},
    Measures, Picture,
};

type GouraudPhong = Choose<DuffBarycentric, Gouraud, ByHighlight>;

/// A case at exponent 20, some of its frames drawn by the reference.
struct Shown {
    case: Case,
    mesh: host_tests::reference::Mesh,
    frames: Vec<u32>,
}

impl Shown {
    fn new(subject: Subject, light: Illumination) -> Self {
        let frames = if subject == Subject::T880 { (0..60).step_by(12).collect() } else { subject.frames().collect() };
        Self { case: Case { subject, light, exponent: 20 }, mesh: subject.mesh().unwrap(), frames }
    }

    /// The measures of each frame.
    fn measure(&self, mut draw: impl FnMut(&Scene<'_>, &Meshes) -> Picture<Gray8>) -> Vec<Measures> {
        let meshes = Meshes::of(&self.case.scene(&self.mesh, 0)).unwrap();
        let one = |frame: &u32| {
            let scene = self.case.scene(&self.mesh, *frame);
            let reference = render(&scene, Default::default()).round::<Gray8>();
            Measures::between(&reference, &draw(&scene, &meshes), &scene.triangles())
        };
        self.frames.iter().map(one).collect()
    }

    /// The mean of the frames' PSNR, dB.
    fn decibels(&self, draw: impl FnMut(&Scene<'_>, &Meshes) -> Picture<Gray8>) -> f64 {
        let all = self.measure(draw);
        all.iter().map(|measures| measures.psnr_db).sum::<f64>() / all.len() as f64
    }

    fn whole<S: Shade<1, L>, L: FromReference>(&self) -> f64 {
        self.decibels(|scene, meshes| library::draw::<_, S, 1, L>(scene, meshes).unwrap())
    }

    fn split<S: Shade<1, L>, L: FromReference>(&self, split: &impl Split<1, L>) -> f64 {
        self.decibels(|scene, meshes| library::draw_split::<_, S, 1, L>(scene, meshes, split).unwrap().0)
    }

    /// Gouraud, regular subdivision, highlight subdivision, Gouraud + Phong.
    fn methods<L: FromReference>(&self) -> [f64; 4] {
        let (regular, highlight) = (Regular { pixels: 32 }, AtHighlight::new(0.3));
        let all = [
            self.whole::<Gouraud, L>(),
            self.split::<Gouraud, L>(&regular),
            self.split::<Gouraud, L>(&highlight),
            self.whole::<GouraudPhong, L>(),
        ];
        println!("{:?}: {all:.2?}", self.case);
        all
    }
}

/// In dB, by what f64 arithmetic made of like scenes, less one.
#[test]
fn adaptive_shading_is_as_exact_as_it_can_be() {
    let bars = |shown: Shown, bars: [f64; 3]| {
        let [gouraud, adaptive @ ..] = match shown.case.light {
            Illumination::Directional => shown.methods::<Light>(),
            Illumination::Point => shown.methods::<SceneLight>(),
        };
        assert!(adaptive.iter().zip(bars).all(|(found, bar)| *found > gouraud + 1.0 && *found > bar - 1.0), "{adaptive:?}");
    };
    bars(Shown::new(Subject::T880, Illumination::Directional), [30.8, 30.5, 35.7]);
    bars(Shown::new(Subject::T880, Illumination::Point), [30.6, 30.1, 35.3]);
    bars(Shown::new(Subject::I80, Illumination::Directional), [36.8, 30.0, 36.9]);
    bars(Shown::new(Subject::I80, Illumination::Point), [40.6, 28.9, 37.7]);
}

/// The corners are dark, so Gouraud shading alone does not see the highlight. Near a point light, splitting helps Phong shading, too.
#[test]
fn a_highlight_inside_a_big_triangle_shows() {
    let [gouraud, regular, highlight, both] = Shown::new(Subject::Triangle, Illumination::Directional).methods::<Light>();
    assert!(gouraud < 14.0 && regular > 55.0 && highlight > 20.0 && both > 53.0);
    let shown = Shown::new(Subject::Triangle, Illumination::Point);
    let [gouraud, regular, highlight, _] = shown.methods::<SceneLight>();
    assert!(gouraud < 14.0 && regular > 55.0 && highlight > 22.0);
    let (phong, split) =
        (shown.whole::<DuffBarycentric, SceneLight>(), shown.split::<DuffBarycentric, SceneLight>(&Regular { pixels: 600 }));
    assert!(phong < 45.0 && split > 55.0, "{phong} {split}");
}

/// Cracks where a split triangle meets one that is not cost a pixel here and there.
#[test]
fn split_frames_cover_the_same_pixels() {
    fn wrong<L: FromReference>(subject: Subject, light: Illumination, split: &impl Split<1, L>) -> [usize; 2] {
        let shown = Shown::new(subject, light);
        let meshes = Meshes::of(&shown.case.scene(&shown.mesh, 0)).unwrap();
        let mut wrong = [0; 2];
        for frame in &shown.frames {
            let scene = shown.case.scene(&shown.mesh, *frame);
            let whole: Picture<Gray8> = library::draw::<_, Gouraud, 1, L>(&scene, &meshes).unwrap();
            let (parts, splits) = library::draw_split::<Gray8, Gouraud, 1, L>(&scene, &meshes, split).unwrap();
            let [Splits { split, parts: made, no_room, .. }] = splits[..] else { unreachable!("one object") };
            assert!(split > 0 && made > split && no_room == 0, "{splits:?}");
            let owners = || whole.owner.iter().zip(&parts.owner);
            wrong[0] += owners().filter(|(a, b)| a.is_some() != b.is_some()).count();
            wrong[1] += owners().filter(|(a, b)| a != b).count();
        }
        println!("{subject:?} {light:?}: of {} frames {wrong:?}", shown.frames.len());
        wrong
    }
    let [mut uncovered, mut other] = [0; 2];
    for subject in [Subject::T880, Subject::I80, Subject::Triangle] {
        for [a, b] in [
            wrong::<Light>(subject, Illumination::Directional, &Regular { pixels: 32 }),
            wrong::<SceneLight>(subject, Illumination::Point, &Regular { pixels: 100 }),
            wrong::<Light>(subject, Illumination::Directional, &AtHighlight::new(0.1)),
            wrong::<SceneLight>(subject, Illumination::Point, &AtHighlight::new(0.02)),
        ] {
            uncovered += a;
            other += b;
        }
    }
    // Of 52 frames.
    assert!(uncovered <= 13 && other <= 39, "{uncovered} {other}");
}

fn teapot() -> Quantized {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/models/teapot-880.obj");
    Model::load(file, &Options::default()).unwrap().quantize().unwrap()
}

/// The teapot in a frame of that size: what came of it, and the picture.
fn draw<const V: usize, const T: usize, const M: usize>(split: Option<&impl Split>) -> (Result<Splits, Full>, Picture<Gray8>) {
    let quantized = teapot();
    let mesh = quantized.mesh();
    let mut frame = Box::new(Frame::<'_, V, T, 240, 1, 1, M>::new());
    frame.begin(&Camera::new(Size::new(240, 240)).at_distance(2.45), &[Light::directional([-0.5, 0.7, 0.6])]).unwrap();
    let pose = Pose::turned(Rotation::x(Turn::degrees(25)));
    let result = match split {
        Some(split) => frame.add_split(&mesh, &pose, split),
        None => frame.add(&mesh, &pose).map(|()| Splits::default()),
    };
    let mut scanner = Box::<Scanner<400, Gouraud>>::default();
    (result, library::read(&mut scanner.start(frame.picture())))
}

#[test]
fn what_has_no_room_stays_whole_and_is_counted() {
    fn all_or_nothing(way: &impl Split) {
        let (result, whole) = draw::<481, 450, 0>(None::<&Regular>);
        result.unwrap();
        let (Ok(free), parts) = draw::<4000, 4000, 4000>(Some(way)) else { panic!("no room") };
        assert!(free.no_room == 0 && free.split > 0 && parts.color != whole.color, "{free:?}");
        let nothing = Ok(Splits { chosen: free.chosen, split: 0, parts: 0, no_room: free.split });
        // No triangles, no vertices, no places among those that are drawn: the picture of the whole triangles.
        for (result, picture) in [draw::<4000, 4000, 0>(Some(way)), draw::<481, 4000, 4000>(Some(way))] {
            assert!((result, &picture) == (nothing, &whole), "{result:?}");
        }
        // Some of them, which leaves no trace of those that failed.
        for (result, picture) in
            [draw::<4000, 4000, 60>(Some(way)), draw::<520, 4000, 4000>(Some(way)), draw::<4000, 470, 4000>(Some(way))]
        {
            let Ok(some) = result else { panic!("{result:?}") };
            assert!(some.split > 0 && some.no_room > 0 && some.parts < free.parts, "{some:?}");
            assert_eq!((some.chosen, some.split + some.no_room), (free.chosen, free.split));
            let missing = whole.owner.iter().zip(&picture.owner).filter(|(a, b)| a.is_some() != b.is_some()).count();
            assert!(missing <= 2, "{missing}");
        }
        // Too few for the whole triangles.
        assert!(matches!(draw::<4000, 400, 4000>(Some(way)).0, Err(Full::Triangles { fitted: 400, .. })));
    }
    all_or_nothing(&Regular { pixels: 16 });
    all_or_nothing(&AtHighlight::new(0.1));
}

/// A camera on the z axis, and a mesh of nothing, which lights are aimed at.
fn aim<L: LightSource>(light: &L, eye: [f32; 3]) -> L::Aim {
    static MATERIALS: [Material; 1] = [Material::new(beamshade::Color::WHITE)];
    let empty = MeshData {
        extent: I16F16::from_num(2),
        center: [0; 3],
        radius: 32768,
        positions: &[],
        normals: &[],
        triangles: &[],
        edges: &[],
        parts: &[],
        materials: &MATERIALS,
    };
    light.aim(&Camera::new(Size::new(64, 64)).at(eye), &Mesh::new(empty).unwrap(), &Pose::IDENTITY)
}

fn random_unit(rng: &mut fastrand::Rng) -> DVec3 {
    loop {
        let v = DVec3::new(rng.f64(), rng.f64(), rng.f64()) * 2.0 - 1.0;
        if v.length_squared() <= 1.0 && v.length_squared() > 1e-3 {
            return v.normalize();
        }
    }
}

fn single(v: DVec3) -> [f32; 3] {
    v.to_array().map(|c| c as f32)
}

fn q14(v: DVec3) -> [i16; 3] {
    v.to_array().map(|c| (c * 16384.0).round() as i16)
}

/// A normal that leans from z by up to that many radians.
fn leaning(rng: &mut fastrand::Rng, most: f64) -> DVec3 {
    (DVec3::Z + random_unit(rng) * most.tan() * rng.f64()).normalize()
}

/// Under a directional light the test misses no triangle with a highlight on it, and the centre is found; others pass seldom.
#[test]
fn the_test_misses_no_highlight_of_a_directional_light() {
    let mut rng = fastrand::Rng::with_seed(3);
    let (mut hits, mut passes, mut largest) = (0, [0; 2], 0.0_f64);
    let rounds = 40_000;
    for _ in 0..rounds {
        let light = leaning(&mut rng, 1.2);
        let aim = aim(&Light::directional(single(light)), [0.0, 0.0, 3.0]);
        let half = (light + DVec3::Z).normalize();
        let middle = (half + random_unit(&mut rng) * 0.4 * rng.f64()).normalize();
        let normals = [(); 3].map(|()| (middle + random_unit(&mut rng) * 0.4 * rng.f64()).normalize());
        let bent = Bent { positions: [[0; 3]; 3], normals: normals.map(q14) };
        let (passed, near) = (bent.is_potential(&[aim]), bent.is_near(&[aim]));
        assert!(near || !passed);
        passes = [passes[0] + u32::from(passed), passes[1] + u32::from(near)];
        // h = Σ λi ni, up to a positive factor.
        let [a, b, c] = normals;
        let volume = a.dot(b.cross(c));
        let shares = [half.dot(b.cross(c)), half.dot(c.cross(a)), half.dot(a.cross(b))].map(|share| share / volume);
        let sum: f64 = shares.iter().sum();
        let is_clear = volume.abs() > 1e-3 && light.distance(DVec3::Z) > 0.1;
        if is_clear && shares.iter().all(|share| share / sum > 0.01) && sum > 0.0 {
            hits += 1;
            assert!(passed, "{light} {normals:?}");
            let [x, y, z] = bent.center(&aim, [2, 0, 1]).expect("a centre").shares().map(|share| f64::from(share) / 32768.0);
            largest = largest.max((a * x + b * y + c * z).normalize().distance(half));
        }
    }
    println!("{hits} with a highlight; {passes:?} of {rounds} pass; centre off by up to {largest} rad");
    assert!(hits > 2000 && passes[0] < rounds / 3 && passes[1] < rounds * 3 / 4);
    assert!(largest < 3e-3, "{largest}");
}

/// With light and viewer in the scene the centre is found where the surface mirrors the light, nearly. With the light at one and a
/// half sides of the triangle and the viewer at four times that, the leans of many have the same side at all corners.
#[test]
fn the_center_is_near_the_brightest_place() {
    let [missed, median, most] = centers(1.5, 0.6);
    assert!(missed < 0.005 && median < 0.02 && most < 0.1);
    let [missed, median, most] = centers(6.0, 0.3);
    assert!(missed > 0.3 && missed < 0.45 && median < 0.04 && most < 0.3);
}

/// For a viewer at that distance and triangles so bent: the share of highlights missed, and by how many radians the others are off,
/// at the median and but for 1 %.
fn centers(distance: f64, bend: f64) -> [f64; 3] {
    let mut rng = fastrand::Rng::with_seed(4);
    let (mut inside, mut missed, mut errors) = (0, 0, Vec::new());
    for _ in 0..20_000 {
        // A triangle with sides of 1; positions in halves.
        let corners = [0.0, 120.0, 240.0_f64]
            .map(|angle| DVec3::new(angle.to_radians().cos(), angle.to_radians().sin(), 0.0) / 3f64.sqrt());
        let light = leaning(&mut rng, 1.0) * 1.5;
        let eye = leaning(&mut rng, 1.0) * distance;
        let middle = leaning(&mut rng, 0.3);
        let normals = corners.map(|corner| (middle + corner * bend + random_unit(&mut rng) * 0.1 * bend).normalize());
        let aim = aim(&SceneLight::point(single(light)), single(eye));
        let bent = Bent {
            positions: corners.map(|corner| corner.to_array().map(|c| (c * 16384.0).round() as i16)),
            normals: normals.map(q14),
        };
        // n·h at a place.
        let shine = |shares: [f64; 3]| {
            let at: DVec3 = corners.iter().zip(shares).map(|(corner, share)| *corner * share).sum();
            let normal: DVec3 = normals.iter().zip(shares).map(|(normal, share)| *normal * share).sum();
            let half = (light - at).normalize() + (eye - at).normalize();
            normal.normalize().dot(half.normalize())
        };
        let steps = 24;
        let places =
            (1..steps).flat_map(|i| (1..steps - i).map(move |j| [i, j, steps - i - j].map(|n| f64::from(n) / f64::from(steps))));
        let best = places.map(shine).fold(0.0, f64::max);
        if best < 0.9998 {
            continue;
        }
        inside += 1;
        if !bent.is_potential(&[aim]) {
            missed += 1;
            continue;
        }
        let center = bent.center(&aim, [0, 1, 2]).expect("a centre").shares();
        errors.push(shine(center.map(|share| f64::from(share) / 32768.0)).min(1.0).acos());
    }
    errors.sort_by(f64::total_cmp);
    let (median, most) = (errors[errors.len() / 2], errors[errors.len() * 99 / 100]);
    println!("viewer at {distance}: {inside} inside, {missed} missed; off by {median} rad, 1 % by more than {most}");
    assert!(inside > 500);
    [f64::from(missed) / f64::from(inside), median, most]
}
