//! The library's approximations against f64: each documents its largest and RMS error, and these are those very numbers.

use beamshade::math::{
    angle::Turn,
    power::Power,
    product::scale,
    reciprocal::{rough, Reciprocal},
    root::inverse_root,
    rotation::Rotation,
    screen::{area, first_at},
    vector::Vector,
};
use embedded_graphics::geometry::Point;

/// Largest and RMS of errors.
fn statistics(errors: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut largest, mut squares, mut count) = (0.0_f64, 0.0, 0);
    for error in errors {
        largest = largest.max(error.abs());
        squares += error * error;
        count += 1;
    }
    (largest, (squares / f64::from(count)).sqrt())
}

/// Asserts that an error is what its docs say: at most that, and not so much less that the docs mislead.
#[track_caller]
fn documented(what: &str, measured: f64, stated: f64) {
    assert!(measured <= stated && measured > 0.8 * stated, "{what}: measured {measured:.3e}, stated {stated:.3e}");
}

#[test]
fn sine_and_cosine() {
    let angles = || (0..1_000_003_u64).map(|i| (i * 4294) as u32);
    let radians = |turn: u32| f64::from(turn) / 4_294_967_296.0 * std::f64::consts::TAU;
    let one = f64::from(1 << 30);
    let sines = angles().map(|a| f64::from(Turn(a).sin_cos().0) / one - radians(a).sin());
    let cosines = angles().map(|a| f64::from(Turn(a).sin_cos().1) / one - radians(a).cos());
    let (largest, rms) = statistics(sines.chain(cosines));
    documented("largest", largest, 3.6e-9);
    documented("RMS", rms, 8e-10);
}

#[test]
fn angles_in_degrees_and_radians() {
    assert_eq!(Turn::degrees(90), Turn(1 << 30));
    assert_eq!(Turn::degrees(-90), Turn::degrees(270));
    assert_eq!(Turn::degrees(370), Turn::degrees(10));
    assert_eq!(Turn::radians(-std::f32::consts::FRAC_PI_2).0 >> 8, Turn::degrees(270).0 >> 8);
    assert_eq!(Turn::radians(f32::NAN), Turn(0));
}

#[test]
fn reciprocal() {
    let inputs = || (1..4096_u32).chain((0..2_000_000).map(|i| i * 2147 + 1)).chain((0..32).map(|k| 1 << k)).chain([u32::MAX]);
    let value = |x: u32| {
        let r = Reciprocal::of(x);
        assert!(r.mantissa > 1 << 30 && r.mantissa <= 1 << 31, "{x}");
        f64::from(r.mantissa) * f64::from(r.zeros - 62).exp2()
    };
    let (largest, rms) = statistics(inputs().map(|x| value(x) * f64::from(x) - 1.0));
    documented("largest", largest, 1.4e-7);
    documented("RMS", rms, 4e-8);
    let short = |x: u32| {
        let r = Reciprocal::of(x);
        f64::from(r.short()) * f64::from(r.zeros - 47).exp2()
    };
    let (largest, _) = statistics(inputs().map(|x| short(x) * f64::from(x) - 1.0));
    documented("largest of the short one", largest, 1.6e-5);
    assert_eq!(Reciprocal::of(0), Reciprocal::of(1));
}

#[test]
fn rough_reciprocal() {
    let errors = || (1 << 14..1 << 15).map(|x: u32| f64::from(rough(x)) * f64::from(x) / 32_f64.exp2() - 1.0);
    assert!(errors().all(|error| error <= 0.0));
    documented("largest", statistics(errors()).0, 1.5e-5);
}

#[test]
fn reciprocal_root() {
    let one = f64::from(1 << 28);
    let error = |u: i32| f64::from(inverse_root(u)) / 32768.0 * (1.0 - f64::from(u) / one).sqrt() - 1.0;
    let quarter = 1 << 26;
    let (largest, rms) = statistics((0..63 * (quarter / 16)).step_by(997).map(error));
    documented("largest", largest, 9e-5);
    documented("RMS", rms, 2.1e-5);
    let (largest, _) = statistics((0..2 * quarter).step_by(997).map(error));
    documented("largest up to 0.5", largest, 5.8e-5);
    assert_eq!([inverse_root(-1), inverse_root(i32::MIN), inverse_root(0)], [1 << 15; 3]);
    assert_eq!([inverse_root(3 * quarter), inverse_root(4 * quarter), inverse_root(i32::MAX)], [2 << 15, 8 << 15, 8 << 15]);
}

#[test]
fn power() {
    let (mut worst, mut worst_rms) = (0.0_f64, 0.0_f64);
    for exponent in 1..=256_u16 {
        let power = Power::new(exponent);
        let reach = (1_u32 << 31) - power.start();
        let error = |distance: u32| {
            let cosine = (1_u32 << 31) - distance;
            f64::from(power.at(cosine)) / 16384.0 - (f64::from(cosine) / f64::from(1_u32 << 31)).powi(i32::from(exponent))
        };
        let (largest, rms) = statistics((0..reach).step_by(reach as usize / 3001).map(error));
        worst = worst.max(largest);
        worst_rms = worst_rms.max(rms);
        // Out of reach nothing shows: a level of 255 is 1/255.
        if reach < 1 << 31 {
            assert!(error(reach).abs() < 1.0 / 400.0, "{exponent}");
        }
        assert_eq!(power.at(u32::MAX), power.at(1 << 31), "{exponent}");
        assert!(power.at(0) == 0, "{exponent}");
        // A height is a cosine, from the start on, in a unit of its own.
        for cosine in (0..=1_u32 << 31).step_by(9_999_991) {
            let height = (i64::from(cosine) - i64::from(power.start())) << power.zeros() >> 2;
            if let Ok(height) = i32::try_from(height) {
                assert_eq!(power.at_height(height), power.at(cosine), "{exponent} {cosine}");
            }
        }
    }
    documented("largest", worst, 1.36e-2);
    documented("RMS", worst_rms, 2.0e-3);
    assert_eq!(Power::new(0), Power::new(1));
}

#[test]
fn unit_vectors() {
    let one = f64::from(1 << 30);
    for components in [[-0.5, 0.7, 0.6], [0.0, 0.0, 3.0], [1e-3, -2e-2, 0.5], [100.0, -2000.0, 1.5]] {
        let length = components.iter().map(|c: &f64| c * c).sum::<f64>().sqrt();
        let unit = Vector::unit_f32(components.map(|c| c as f32)).unwrap();
        for (found, component) in unit.0.iter().zip(components) {
            assert!((f64::from(*found) / one - component / length).abs() < 1e-7, "{components:?}");
        }
    }
    assert_eq!(Vector::unit([0; 3]), None);
    assert_eq!(Vector::unit_f32([f32::NAN; 3]), None);
    assert!(Vector::unit([i64::MIN, i64::MAX, 1]).is_some());
}

#[test]
fn rotations_turn_the_right_way() {
    let [x, y, z] = Rotation::NONE.0;
    let quarter = Turn::degrees(90);
    assert_eq!(Rotation::x(quarter).turn(y), z);
    assert_eq!(Rotation::y(quarter).turn(z), x);
    assert_eq!(Rotation::z(quarter).turn(x), y);
    let both = Rotation::x(quarter) * Rotation::z(quarter);
    assert_eq!(both.turn(x), z, "the right one turns first");
    assert_eq!((both * both.inverse()), Rotation::NONE);
}

#[test]
fn pixels_are_covered_by_their_centres() {
    assert_eq!([-129, -128, 0, 127, 128, 129, 383, 384, 385].map(first_at), [-1, -1, 0, 0, 0, 1, 1, 1, 2]);
}

#[test]
fn areas_are_exact_whatever_the_size() {
    let points = [(0, 0), (32767, -32768), (-32768, 32767), (524_287, -524_288), (-524_288, 524_287), (3, 5), (-32768, -32768)];
    for a in points {
        for b in points {
            for c in points {
                let exact = i64::from(b.0 - a.0) * i64::from(c.1 - a.1) - i64::from(b.1 - a.1) * i64::from(c.0 - a.0);
                let [a, b, c] = [a, b, c].map(|(x, y)| Point::new(x, y));
                assert_eq!(area(a, b, c), exact, "{a:?} {b:?} {c:?}");
            }
        }
    }
}

#[test]
fn scaling_rounds_like_f64() {
    for (value, shift) in [(7, -1), (-7, -1), (1_000_001, -7), (-1_000_001, -7), (3, 5), (i32::MAX, -1), (i32::MIN, -31)] {
        let exact = (f64::from(value) * f64::from(shift).exp2() + 0.5).floor();
        assert_eq!(f64::from(scale(value, shift)), exact, "{value} {shift}");
    }
}
