//! The methods by angles, against Eq. 4 and 5 of the report in f64 and against exact powers of cosines.

use std::f64::consts::{FRAC_PI_2, TAU};

use std::ops::Range;

use beamshade::{
    model::light::LightSource,
    shade::{
        angular::{Printed, Refit},
        angular_trapezia::{AngularTrapezia, Corner},
        trapezium::Facet,
        Surface,
    },
    AngularTriangle, Camera, Color, Frame, Intensity, Light, Material, Mesh, MeshData, Paint, Pose, Scanner, SceneLight, Shade,
    Turn,
};
use embedded_graphics::{
    geometry::{Point, Size},
    pixelcolor::{Gray8, Rgb888},
};
use fixed::types::I16F16;
use glam::{DQuat, DVec2, DVec3};
use host_tests::{
    accuracy::Method,
    library::Meshes,
    reference::{render, Options, Scene, Source, Viewer},
    scenes::{Case, Illumination, Subject},
    Measures, Picture,
};

/// Keeps the light that would be mixed to a pixel.
struct Keep;

impl Paint<Intensity> for Keep {
    fn mix(&self, intensity: Intensity) -> Intensity {
        intensity
    }
}

const EXPONENTS: [f64; 3] = [5.0, 20.0, 125.0];

static MATERIALS: [Material; 3] = [
    Material::new(Color::WHITE).exponent(5),
    Material::new(Color::WHITE).exponent(20),
    Material::new(Color::WHITE).exponent(125),
];

/// A mesh of nothing, four units wide.
fn nothing() -> Mesh<'static> {
    let data = MeshData {
        extent: I16F16::from_num(4),
        center: [0; 3],
        radius: 32768,
        positions: &[],
        normals: &[],
        triangles: &[],
        edges: &[],
        parts: &[],
        materials: &MATERIALS,
    };
    Mesh::new(data).expect("an empty mesh")
}

fn random_unit(rng: &mut fastrand::Rng) -> DVec3 {
    loop {
        let v = DVec3::from_array(std::array::from_fn(|_| rng.f64() * 2.0 - 1.0));
        if v.length_squared() <= 1.0 && v.length_squared() > 1e-3 {
            return v.normalize();
        }
    }
}

fn q14(v: DVec3) -> [i16; 3] {
    v.to_array().map(|c| (c * 16384.0).round() as i16)
}

fn unit(v: [i16; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from)).normalize()
}

/// The unit vector such a part of the way on the arc from one to another.
fn on_arc(a: DVec3, b: DVec3, part: f64) -> DVec3 {
    let side = b - a * a.dot(b);
    if side.length() < 1e-9 {
        return a;
    }
    let (sin, cos) = (part * a.cross(b).length().atan2(a.dot(b))).sin_cos();
    a * cos + side.normalize() * sin
}

/// cosⁿ γ · q(θ − α, n): a product along the arc from a to b at θ, by the refit of Eq. 4; by vectors, not by Eq. 6 to 8.
fn equation_5(a: DVec3, b: DVec3, part: f64, vector: DVec3, n: f64) -> f64 {
    let normal = on_arc(a, b, part);
    let axis = a.cross(b);
    if axis.length() < 1e-6 {
        return normal.dot(vector).max(0.0).powf(n);
    }
    let axis = axis.normalize();
    let nearest = vector - axis * axis.dot(vector);
    let gamma = nearest.length();
    let angle = axis.dot(nearest.cross(normal)).atan2(nearest.dot(normal)).abs();
    let (knee, reach) = match n {
        1.0 => (1.3545, 1.6861),
        _ => (0.755 / n.sqrt() * (1.0 + 0.65 / n), 2.99 / n.sqrt() * (1.0 - 0.47 / n)),
    };
    let power = if angle >= reach {
        0.0
    } else if angle <= knee {
        1.0 - angle * angle / (knee * reach)
    } else {
        (angle - reach).powi(2) / (reach * (reach - knee))
    };
    gamma.powf(n) * power
}

/// Where line y crosses the side between two corners, and how far down it is; none if it does not.
fn crossing(a: &Corner, b: &Corner, y: i32) -> Option<(f64, f64)> {
    let y = 256 * y + 128;
    if (a.point.y < y) == (b.point.y < y) {
        return None;
    }
    let part = f64::from(y - a.point.y) / f64::from(b.point.y - a.point.y);
    Some((f64::from(a.point.x) + part * f64::from(b.point.x - a.point.x), part))
}

/// x and normal at a line's left and right end.
type Ends = [(f64, DVec3); 2];

/// The ends of a line of a convex quadrilateral.
fn ends(corners: &[Corner; 4], y: i32) -> Option<Ends> {
    let sides = (0..4).map(|i| (&corners[i], &corners[(i + 1) % 4]));
    let mut ends: Vec<_> = sides
        .filter_map(|(a, b)| crossing(a, b, y).map(|(x, part)| (x / 256.0, on_arc(unit(a.normal), unit(b.normal), part))))
        .collect();
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ends: [_; 2] = ends.try_into().ok()?;
    Some(ends)
}

/// A convex quadrilateral about the middle of a 240×240 picture, up to `size` pixels across.
fn points(rng: &mut fastrand::Rng, size: f64) -> [Point; 4] {
    let (from, turning) = (rng.f64() * TAU, if rng.bool() { 1.0 } else { -1.0 });
    let radius = size / 2.0 * (0.2 + 0.8 * rng.f64());
    let squeeze = DVec2::new(1.0, 0.1 + 0.9 * rng.f64());
    let place = DVec2::new(120.0 + rng.f64(), 120.0 + rng.f64());
    std::array::from_fn(|i| {
        let angle = from + turning * (FRAC_PI_2 * i as f64 + rng.f64());
        let point = (place + DVec2::from_angle(angle) * squeeze * radius) * 256.0;
        Point::new(point.x.round() as i32, point.y.round() as i32)
    })
}

/// How the four normals lie to each other.
#[derive(Clone, Copy, Debug)]
enum Normals {
    /// Anywhere within so many radians of a direction.
    Spread(f64),
    /// All the same.
    Equal,
    /// On one great circle.
    OnePlane,
    /// Two, then two others: some side has constant normals.
    Pairs,
    /// Three the same.
    AllButOne,
}

fn normals(rng: &mut fastrand::Rng, kind: Normals) -> [[i16; 3]; 4] {
    let middle = random_unit(rng);
    let spread = if let Normals::Spread(spread) = kind { spread } else { 0.6 };
    let near = |rng: &mut fastrand::Rng| (middle + random_unit(rng) * spread * rng.f64()).normalize();
    let [a, b] = [near(rng), near(rng)];
    let any: [_; 4] = std::array::from_fn(|_| near(rng));
    match kind {
        Normals::Spread(_) => any,
        Normals::Equal => [a; 4],
        Normals::OnePlane => std::array::from_fn(|_| on_arc(a, b, rng.f64() * 2.0 - 0.5)),
        Normals::Pairs => [a, a, b, b],
        Normals::AllButOne => [a, b, b, b],
    }
    .map(q14)
}

/// Errors in Q14: a level of 255 is 64.
#[derive(Debug, Default)]
struct Errors {
    count: f64,
    largest: f64,
    squares: f64,
}

impl Errors {
    fn add(&mut self, error: f64) {
        self.count += 1.0;
        self.largest = self.largest.max(error.abs());
        self.squares += error * error;
    }

    fn rms(&self) -> f64 {
        (self.squares / self.count).sqrt()
    }
}

/// A quadrilateral under a light of 0.8, and its facet.
struct Lit {
    corners: [Corner; 4],
    facet: Facet<1, Light, 3>,
    /// l and h.
    vectors: [DVec3; 2],
}

/// Of the light.
const INTENSITY: f64 = 0.8;

impl Lit {
    fn new(rng: &mut fastrand::Rng, kind: Normals) -> Self {
        let size = [8.0, 40.0, 200.0][rng.usize(..3)];
        let (points, normals) = (points(rng, size), normals(rng, kind));
        let corners = std::array::from_fn(|i| Corner { point: points[i], normal: normals[i], position: [0; 3] });
        // So that there is light, and often a highlight.
        let l = (unit(normals[0]) + random_unit(rng) * 0.7).normalize();
        let light = Light::directional(l.to_array().map(|c| c as f32)).intensity(INTENSITY as f32);
        let aim = light.aim(&Camera::new(Size::new(240, 240)), &nothing(), &Pose::IDENTITY);
        let facet = AngularTrapezia::<Refit>::quadrilateral(&corners, &[aim], &[light.strength()]);
        Self { corners, facet, vectors: [l, (l + DVec3::Z).normalize()] }
    }

    /// The pixels of a line, and where it begins and ends.
    fn line(&self, y: i32) -> Option<(Range<i32>, Ends)> {
        let ends @ [(x0, _), (x1, _)] = ends(&self.corners, y)?;
        Some(((x0 - 0.5).ceil() as i32..(x1 - 0.5).ceil() as i32, ends))
    }

    /// The light on some pixels of a line.
    fn shade(&self, pixels: Range<i32>, y: i32, material: &Material) -> Vec<Intensity> {
        let mut row = vec![Intensity::default(); pixels.len()];
        let surface = Surface { material, intensities: &[(INTENSITY * 32768.0) as u16] };
        <AngularTrapezia as Shade<1>>::run(self.facet.start(pixels.start, y), &surface, &mut row, &Keep);
        row
    }
}

/// Diffuse and specular light on quadrilaterals with such normals, against Eq. 5; and the larger of both against exact cosines.
fn measure(kind: Normals) -> [Errors; 3] {
    let mut rng = fastrand::Rng::with_seed(7);
    let mut errors: [Errors; 3] = Default::default();
    for round in 0..600 {
        let (material, n) = (&MATERIALS[round % 3], EXPONENTS[round % 3]);
        let lit = Lit::new(&mut rng, kind);
        for y in 0..240 {
            let Some((pixels, [(x0, left), (x1, right)])) = lit.line(y) else { continue };
            for (x, found) in pixels.clone().zip(lit.shade(pixels, y, material)) {
                let part = (f64::from(x) + 0.5 - x0) / (x1 - x0);
                let normal = on_arc(left, right, part);
                for (i, (found, n)) in [(found.diffuse, 1.0), (found.specular, n)].into_iter().enumerate() {
                    let found = f64::from(found) / INTENSITY;
                    errors[i].add(found - 16384.0 * equation_5(left, right, part, lit.vectors[i], n));
                    errors[2].add(found - 16384.0 * normal.dot(lit.vectors[i]).max(0.0).powf(n));
                }
            }
        }
    }
    assert!(errors[0].count > 500_000.0);
    errors
}

/// In Q14, diffuse largest and RMS, specular largest and RMS, and the largest against cosines; 64 is a level of 255.
#[test]
fn quadrilaterals_are_lit_as_equation_5_says() {
    // Where Δθ is small, α is as good as its part in it: light at the ends is right, but not where on its parabolas it lies.
    let kinds = [
        (Normals::Spread(0.5), [310.0, 2.0, 160.0, 15.0, 400.0]),
        (Normals::Spread(0.1), [375.0, 5.0, 215.0, 16.0, 400.0]),
        (Normals::Spread(0.02), [385.0, 17.0, 230.0, 18.0, 420.0]),
        (Normals::Equal, [3.0, 1.2, 110.0, 14.0, 110.0]),
        (Normals::OnePlane, [380.0, 12.0, 300.0, 15.0, 450.0]),
        (Normals::Pairs, [380.0, 10.0, 230.0, 16.0, 400.0]),
        (Normals::AllButOne, [425.0, 8.0, 390.0, 18.0, 430.0]),
    ];
    for (kind, [diffuse, diffuse_rms, specular, specular_rms, cosine]) in kinds {
        let [d, s, c] = measure(kind);
        let found = [d.largest, d.rms(), s.largest, s.rms(), c.largest];
        let within = found.iter().zip([diffuse, diffuse_rms, specular, specular_rms, cosine]).all(|(found, most)| *found <= most);
        println!("{kind:?} {found:.1?}");
        assert!(within, "{kind:?} {found:.1?}");
    }
}

#[test]
fn a_line_begun_anywhere_is_the_same() {
    let mut rng = fastrand::Rng::with_seed(8);
    for round in 0..300 {
        let lit = Lit::new(&mut rng, if round % 4 == 0 { Normals::OnePlane } else { Normals::Spread(0.6) });
        for y in 0..240 {
            let Some((pixels, _)) = lit.line(y).filter(|(pixels, _)| !pixels.is_empty()) else { continue };
            let whole = lit.shade(pixels.clone(), y, &MATERIALS[round % 3]);
            let from = rng.i32(pixels.clone());
            let to = rng.i32(from..=pixels.end);
            let skipped = (from - pixels.start) as usize;
            let some = lit.shade(from..to, y, &MATERIALS[round % 3]);
            assert_eq!(some, whole[skipped..skipped + some.len()], "{round} {y}");
            // Registers differ in the pixel alone.
            let (first, later) = (lit.facet.start(pixels.start, y), lit.facet.start(from, y));
            assert_eq!((first.at + from - pixels.start, first.arcs), (later.at, later.arcs));
        }
    }
}

#[test]
fn any_quadrilateral_can_be_lit() {
    let mut rng = fastrand::Rng::with_seed(9);
    let camera = Camera::new(Size::new(240, 240));
    let far = [Light::directional([1.0, 2.0, 3.0]).aim(&camera, &nothing(), &Pose::IDENTITY)];
    let near = [SceneLight::point([0.3, 0.1, 0.2]).aim(&camera, &nothing(), &Pose::IDENTITY)];
    for _ in 0..20_000 {
        let number = |rng: &mut fastrand::Rng| if rng.bool() { rng.i32(..) >> rng.u32(..32) } else { rng.i32(-70_000..70_000) };
        let short = |rng: &mut fastrand::Rng| [0, 1, -1, 16384, i16::MIN, i16::MAX, rng.i16(..), rng.i16(..)][rng.usize(..8)];
        let corners: [Corner; 4] = std::array::from_fn(|_| Corner {
            point: Point::new(number(&mut rng), number(&mut rng)),
            normal: std::array::from_fn(|_| short(&mut rng)),
            position: std::array::from_fn(|_| short(&mut rng)),
        });
        let intensities = [rng.u16(..=1 << 15)];
        let surface = Surface { material: &MATERIALS[rng.usize(..3)], intensities: &intensities };
        let mut row = [Intensity::default(); 100];
        let (x, y) = (rng.i32(0..1024), rng.i32(0..1024));
        let far = AngularTrapezia::<Printed>::quadrilateral::<1, Light>(&corners, &far, &intensities);
        <AngularTrapezia<Printed> as Shade<1>>::run(far.start(x, y), &surface, &mut row, &Keep);
        let near = AngularTrapezia::<Refit>::quadrilateral::<1, SceneLight>(&corners, &near, &intensities);
        <AngularTrapezia as Shade<1, SceneLight>>::run(near.start(x, y), &surface, &mut row, &Keep);
    }
}

#[test]
fn any_triangle_can_be_lit_from_within_the_scene() {
    fn draw<S: Shade<1, SceneLight>>(picture: beamshade::Picture<'_, '_, 1, SceneLight>) {
        let mut scanner = Box::<Scanner<64, S, 1, SceneLight>>::default();
        let mut lines = scanner.start(picture);
        let _ = (0..64).map(|y| lines.line(y, &mut [Rgb888::default(); 64])).last();
    }
    let mut rng = fastrand::Rng::with_seed(10);
    for _ in 0..2000 {
        let short = |rng: &mut fastrand::Rng| [0, 1, -1, 16384, i16::MIN, i16::MAX, rng.i16(..), rng.i16(..)][rng.usize(..8)];
        let mut vectors = || -> Vec<[i16; 3]> { (0..12).map(|_| [0; 3].map(|_| short(&mut rng))).collect() };
        let (positions, normals) = (vectors(), vectors());
        let triangles: Vec<_> = (0..20).map(|_| [0; 3].map(|_| rng.u16(..12))).collect();
        let edges: Vec<_> = (0..20).map(|_| [0; 3].map(|_| if rng.bool() { rng.u16(..) } else { rng.u16(..2000) })).collect();
        let data = MeshData {
            extent: I16F16::ONE,
            center: [0; 3],
            radius: u16::MAX,
            positions: &positions,
            normals: &normals,
            triangles: &triangles,
            edges: &edges,
            parts: &[[20, 1]],
            materials: &MATERIALS,
        };
        let mesh = Mesh::new(data).unwrap();
        let mut frame = Box::<Frame<'_, 512, 256, 64, 1, 1, 128, SceneLight>>::default();
        let place = [0; 3].map(|_| rng.f32() * 2.0 - 1.0);
        frame.begin(&Camera::new(Size::new(64, 64)).at([0.0, 0.0, 2.0]), &[SceneLight::point(place)]).unwrap();
        let _ = frame.add(&mesh, &Pose::turned_y(Turn(rng.u32(..))));
        draw::<AngularTriangle>(frame.picture());
        draw::<AngularTrapezia>(frame.picture());
    }
}

/// What the methods make of a scene by their own model in f64: colours where the reference has them.
///
/// On a triangle, normals turn by equal angles down its sides and along its lines; in the scene (§3.5) each normal is turned first, by
/// the rotation that takes the l or h there to that at the middle corner.
fn model(scene: &Scene<'_>, reference: &Picture<[f64; 3]>) -> Picture<[f64; 3]> {
    let [object] = &scene.objects[..] else { panic!("one object") };
    let [light] = scene.lights[..] else { panic!("one light") };
    let (camera, material) = (&scene.camera, object.materials[0]);
    let mut picture = reference.clone();
    for (pixel, owner) in reference.owner.iter().enumerate().filter_map(|(pixel, owner)| Some((pixel, (*owner)?))) {
        let mut corners = object.mesh.triangles[owner.triangle as usize].map(|vertex| vertex as usize).map(|vertex| {
            let place = object.pose.position(object.mesh.positions[vertex]);
            let l = match light.source {
                Source::Direction(towards) => towards,
                Source::Point(point) => (point - place).normalize(),
            };
            let v = match light.viewer {
                Viewer::Infinity => camera.rotation.z_axis,
                Viewer::Eye => (camera.position - place).normalize(),
            };
            let normal = object.pose.rotation * object.mesh.normals[vertex];
            (camera.project(camera.view(place)), normal, [l, (l + v).normalize()])
        });
        corners.sort_by(|a, b| a.0.y.total_cmp(&b.0.y));
        let center = DVec2::new((pixel % picture.width) as f64 + 0.5, (pixel / picture.width) as f64 + 0.5);
        let [diffuse, specular] = [0, 1].map(|product| {
            let to = corners[1].2[product];
            let turned = corners.map(|(_, normal, from)| DQuat::from_rotation_arc(from[product], to) * normal);
            let mut ends: Vec<_> = [(0, 1), (1, 2), (0, 2)]
                .iter()
                .map(|&(i, j)| (corners[i].0, corners[j].0, turned[i], turned[j]))
                .filter(|(a, b, ..)| a.y <= center.y && center.y < b.y)
                .map(|(a, b, from, to)| {
                    let part = (center.y - a.y) / (b.y - a.y);
                    (a.lerp(b, part).x, on_arc(from, to, part))
                })
                .collect();
            ends.sort_by(|a, b| a.0.total_cmp(&b.0));
            let [(x0, left), (x1, right)] = ends[..] else { return 0.0 };
            let exponent = if product == 0 { 1.0 } else { material.exponent };
            equation_5(left, right, ((center.x - x0) / (x1 - x0)).clamp(0.0, 1.0), to, exponent)
        });
        let light = material.ambient + light.intensity * (material.diffuse * diffuse + material.specular * specular);
        picture.color[pixel] = [light.min(1.0); 3];
    }
    picture
}

/// Both methods against their model in f64, and that against the reference: what the integers cost is little beside what the model
/// does.
#[test]
fn pictures_are_those_of_the_model() {
    let methods = ["angular-triangle", "angular-trapezia"].map(|name| Method::named(name).unwrap());
    for (subject, frames, least) in
        [(Subject::T880, [0, 20], 50.0), (Subject::I80, [0, 14], 57.0), (Subject::Triangle, [7, 14], 50.0)]
    {
        let mesh = subject.mesh().unwrap();
        for light in Illumination::ALL {
            let case = Case { subject, light, exponent: 20 };
            let meshes = Meshes::of(&case.scene(&mesh, 0)).unwrap();
            for frame in frames {
                let scene = case.scene(&mesh, frame);
                let reference = render(&scene, Options::default());
                let model = model(&scene, &reference).round::<Gray8>();
                let reference = reference.round::<Gray8>();
                let truth = Measures::between(&reference, &model, &scene.triangles()).psnr_db;
                for method in &methods {
                    let drawn = method.draw(light, &scene, &meshes).unwrap();
                    let beside = Measures::between(&model, &drawn, &scene.triangles()).psnr_db;
                    let found = Measures::between(&reference, &drawn, &scene.triangles()).psnr_db;
                    println!(
                        "{} {light:?} {frame} {}: {beside:.1} beside the model, {found:.1} for {truth:.1}",
                        subject.name(),
                        method.name
                    );
                    assert!(beside >= least && (found - truth).abs() < 0.3, "{subject:?} {light:?} {beside} {found} {truth}");
                }
            }
        }
    }
}
