//! Light on a surface, in the library's integers and in f64.

use std::f64::consts::TAU;

use beamshade::{
    math::vector::{turned, unit},
    model::light::{Aim, LightSource, Rays},
    Camera, Light, Material, Mesh, MeshData, Pose, Rotation, SceneLight, Turn,
};
use embedded_graphics::geometry::Size;
use fixed::types::I16F16;
use glam::{DMat3, DQuat, DVec3};

static MATERIALS: [Material; 1] = [Material::new(beamshade::Color::WHITE)];

/// A mesh of nothing, of that extent.
fn mesh(extent: f64) -> Mesh<'static> {
    let data = MeshData {
        extent: I16F16::from_num(extent),
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

fn vector(v: [i32; 3]) -> DVec3 {
    DVec3::from_array(v.map(|c| f64::from(c) / 65536.0))
}

fn random_unit(rng: &mut fastrand::Rng) -> DVec3 {
    loop {
        let v = DVec3::new(rng.f64(), rng.f64(), rng.f64()) * 2.0 - 1.0;
        if v.length_squared() <= 1.0 && v.length_squared() > 1e-3 {
            return v.normalize();
        }
    }
}

#[test]
fn unit_vectors_are_as_exact_as_their_docs_say() {
    let mut rng = fastrand::Rng::with_seed(1);
    let mut largest: f64 = 0.0;
    for _ in 0..300_000 {
        let v: [i32; 3] = std::array::from_fn(|_| rng.i32(..) >> rng.u32(0..17));
        if v.iter().all(|c| c.unsigned_abs() < 1 << 14) {
            continue;
        }
        let exact = DVec3::from_array(v.map(f64::from)).normalize();
        largest = largest.max((vector(unit(v)) - exact).abs().max_element());
    }
    assert!(largest <= 5e-5 && largest > 4e-5, "{largest:.3e}");
    assert_eq!([unit([0; 3]), unit([0, -1, 0]), unit([0, 0, i32::MIN])], [[0; 3], [0, -65536, 0], [0, 0, -65536]]);
}

#[test]
fn turned_vectors_are_as_exact_as_their_docs_say() {
    let mut rng = fastrand::Rng::with_seed(3);
    let (mut largest, mut squares, mut count): (f64, f64, f64) = (0.0, 0.0, 0.0);
    let q16 = |v: DVec3| v.to_array().map(|c| (c * 65536.0).round() as i32);
    let q14 = |v: DVec3| v.to_array().map(|c| (c * 16384.0).round() as i16);
    for _ in 0..200_000 {
        let [v, from, to] = [0; 3].map(|_| random_unit(&mut rng));
        if from.dot(to) < -0.87 {
            continue;
        }
        let exact = DQuat::from_rotation_arc(from, to) * v;
        let found = DVec3::from_array(turned(q14(v), q16(from), q16(to)).map(|c| f64::from(c) / 16384.0));
        largest = largest.max((found - exact).abs().max_element());
        squares += (found - exact).length_squared();
        count += 3.0;
    }
    let rms = (squares / count).sqrt();
    assert!(largest <= 4.2e-4 && largest > 4e-4 && rms <= 3.9e-5, "{largest:.3e} {rms:.3e}");
    // Nearly opposite vectors, and none at all.
    let v = [9000, -9000, 10000];
    assert_eq!([turned(v, [65536, 0, 0], [-65536, 0, 0]), turned(v, [0; 3], [0; 3])], [v; 2]);
}

/// l, h, v and both products against their definitions, for lights at a place and in a direction.
#[test]
fn lights_in_the_scene_aim_from_where_they_are() {
    let mut rng = fastrand::Rng::with_seed(2);
    let mut largest: [f64; 4] = [0.0; 4];
    for round in 0..3000 {
        let (extent, scale) = (0.5 + 3.0 * rng.f64(), 0.2 + 2.0 * rng.f64());
        let (a, b) = (rng.u32(..), rng.u32(..));
        let radians = |turn: u32| f64::from(turn) / 4_294_967_296.0 * TAU;
        let shift = random_unit(&mut rng) * 2.0;
        let eye = random_unit(&mut rng) * 12.0;
        let place = random_unit(&mut rng) * 8.0;
        let single = |v: DVec3| v.to_array().map(|c| c as f32);
        let pose = Pose::turned(Rotation::x(Turn(a)) * Rotation::y(Turn(b))).scaled(scale as f32).at(single(shift));
        let camera = Camera::new(Size::new(64, 64)).at(single(eye));
        let is_point = round % 2 == 0;
        let light = if is_point { SceneLight::point(single(place)) } else { SceneLight::directional(single(place)) };
        let aim = light.intensity(0.75).aim(&camera, &mesh(extent), &pose);

        let position: [i16; 3] = std::array::from_fn(|_| rng.i16(-18000..18000));
        let turn = DMat3::from_rotation_x(radians(a)) * DMat3::from_rotation_y(radians(b));
        let there = turn * (DVec3::from_array(position.map(|c| f64::from(c) / 32768.0)) * extent * scale) + shift;
        let l = if is_point { (place - there).normalize() } else { place.normalize() };
        let v = (eye - there).normalize();
        let h = (l + v).normalize();
        let Rays { light, half, viewer } = aim.rays(position);
        let normal = random_unit(&mut rng);
        let world = turn * normal;
        let [diffuse, specular] = aim.dots(position, normal.to_array().map(|c| (c * 16384.0).round() as i16));
        let errors = [
            (turn * vector(light) - l).abs().max_element(),
            (turn * vector(viewer) - v).abs().max_element(),
            if (l + v).length() < 0.2 { 0.0 } else { (turn * vector(half) - h).abs().max_element() },
            if (l + v).length() < 0.2 {
                0.0
            } else {
                (f64::from(diffuse) / 16384.0 - 0.75 * world.dot(l))
                    .abs()
                    .max((f64::from(specular) / 16384.0 - world.dot(h)).abs())
            },
        ];
        largest = std::array::from_fn(|i| largest[i].max(errors[i]));
    }
    let [light, viewer, half, dots] = largest;
    assert!(light < 9e-5 && viewer < 9e-5 && half < 4e-4 && dots < 4e-4, "{largest:?}");
}

/// The farther the light, the more it is like a directional one.
#[test]
fn a_light_far_away_is_directional() {
    let camera = Camera::new(Size::new(64, 64)).at([0.0, 0.0, 500.0]);
    let pose = Pose::turned_y(Turn::degrees(20));
    let towards = [-0.5, 0.7, 0.6];
    let far = SceneLight::point(towards.map(|c| 16000.0 * c)).aim(&camera, &mesh(1.0), &pose);
    let directional = Light::directional(towards).aim(&camera, &mesh(1.0), &pose);
    for (a, b) in [far.dots([9000, 0, -9000], [16384, 0, 0]), far.dots([0; 3], [0, 11585, 11585])]
        .iter()
        .zip([directional.dots([9000, 0, -9000], [16384, 0, 0]), directional.dots([0; 3], [0, 11585, 11585])])
    {
        assert!(a[0].abs_diff(b[0]) <= 3 && a[1].abs_diff(b[1]) <= 20, "{a:?} {b:?}");
    }
}

/// A light at an object without size, and lights as far as numbers go, make no trouble.
#[test]
fn any_place_is_somewhere() {
    for scale in [0.0, 1e-9, -1.0, 1e30] {
        for place in [[0.0; 3], [f32::MAX, f32::MIN, f32::NAN], [1e-9; 3]] {
            let camera = Camera::new(Size::new(64, 64)).at(place);
            let aim = SceneLight::point(place).aim(&camera, &mesh(1.0), &Pose::IDENTITY.scaled(scale));
            for position in [[0; 3], [i16::MIN; 3], [i16::MAX, 0, i16::MIN]] {
                let Rays { light, half, viewer } = aim.rays(position);
                for ray in [light, half, viewer] {
                    assert!(vector(ray).length() < 1.001, "{ray:?}");
                }
            }
        }
    }
}
