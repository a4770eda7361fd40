//! The library's approximations against f64: each documents its largest and RMS error, and these are those very numbers.

use beamshade::math::{
    angle::Turn,
    arc::{arc_cosine, arc_tangent},
    piecewise::PiecewisePower,
    power::Power,
    product::scale,
    quotient::{floor, fraction, quotient},
    reciprocal::{rough, Reciprocal},
    root::{integer_root, inverse_root, near_inverse_root, square_root, ReciprocalRoot},
    rotation::Rotation,
    screen::{area, first_at},
    vector::Vector,
};
use beamshade::shade::linear_angle::{Angle, Byte, Fine};
use embedded_graphics::geometry::Point;
use std::ops::RangeInclusive;

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
fn short_cosine() {
    let one = f64::from(1 << 30);
    let error =
        |turn: u32| f64::from(Turn(turn).cosine()) / one - (f64::from(turn) / 4_294_967_296.0 * std::f64::consts::TAU).cos();
    let (largest, rms) = statistics((0..1_000_003_u64).map(|i| error((i * 4294) as u32)));
    documented("largest", largest, 7.7e-6);
    documented("RMS", rms, 1.4e-6);
    let (largest, _) = statistics((0..1 << 27).step_by(997).map(error));
    documented("largest near 0", largest, 1e-7);
    let right = 1 << 30;
    assert_eq!([0, 2 * right].map(|turn| Turn(turn).cosine()), [1 << 30, -1 << 30]);
    for turn in (0..right).step_by(99_991) {
        let cosine = Turn(turn).cosine();
        assert_eq!([-Turn(turn), Turn(turn + 2 * right), Turn(2 * right - turn)].map(Turn::cosine), [cosine, -cosine, -cosine]);
    }
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
fn near_reciprocal_root() {
    let one = f64::from(1 << 28);
    let error = |u: i32| f64::from(near_inverse_root(u)) / 32768.0 * (1.0 - f64::from(u) / one).sqrt() - 1.0;
    let quarter = 1 << 26;
    let (largest, rms) = statistics((0..3 * quarter).step_by(997).map(error));
    documented("largest", largest, 1e-3);
    documented("RMS", rms, 3e-4);
    let (largest, _) = statistics((0..2 * quarter).step_by(997).map(error));
    documented("largest up to 0.5", largest, 5.2e-4);
    assert!((3 * quarter..4 * quarter).step_by(997).all(|u| near_inverse_root(u) == inverse_root(u)));
    assert_eq!([near_inverse_root(-1), near_inverse_root(i32::MAX)], [near_inverse_root(0), 8 << 15]);
}

/// Numbers of all sizes, and those about powers of two.
fn words() -> impl Iterator<Item = u32> {
    let spread = (0..2_000_000).map(|i| i * 2147 + 1);
    (1..4096_u32)
        .chain(spread)
        .chain((0..32).flat_map(|k| [(1_u32 << k).wrapping_sub(1), 1 << k]))
        .chain([u32::MAX])
        .filter(|x| *x > 0)
}

#[test]
fn reciprocal_root_of_any_number() {
    let (largest, rms) = statistics(words().map(|x| {
        let r = ReciprocalRoot::of(x);
        assert!(r.mantissa >= 1 << 30 && r.mantissa <= 1 << 31, "{x}");
        f64::from(r.mantissa) * f64::from(r.half_zeros - 46).exp2() * f64::from(x).sqrt() - 1.0
    }));
    documented("largest", largest, 1.1e-8);
    documented("RMS", rms, 1.5e-9);
    assert_eq!(ReciprocalRoot::of(0), ReciprocalRoot::of(1));
    // It takes any number, if only to answer to some.
    let _ = (0..1 << 30).step_by(9973).map(ReciprocalRoot::mantissa).fold(0, u32::wrapping_add);
}

#[test]
fn square_roots() {
    let one = f64::from(1 << 30);
    let error = |x: u32| f64::from(square_root(x)) / one - (f64::from(x) / one).sqrt();
    let (largest, rms) = statistics((0..=1 << 30).step_by(997).map(error));
    documented("largest", largest, 9e-9);
    documented("RMS", rms, 1.4e-9);
    let (largest, _) = statistics(words().map(|x| (error(x).abs() - 0.5 / one).max(0.0) / (f64::from(x) / one).sqrt()));
    documented("largest part of the root", largest, 1.8e-8);
    assert_eq!([0, 1 << 28, 1 << 30].map(square_root), [0, 1 << 29, 1 << 30]);
}

const CIRCLE: f64 = 4_294_967_296.0;

/// Numbers at which something may go wrong: powers of two and of three, sums and products of them, each with its neighbours.
fn edgy() -> impl Iterator<Item = u64> + Clone {
    let powers = (0..64).map(|bits| 1 << bits).chain((0..40).map(|power| 3_u64.pow(power)));
    let sums = powers.clone().flat_map(|n| [n, n.wrapping_mul(n.wrapping_add(2)), n ^ 0x1234_5678_9abc_def0]);
    sums.flat_map(|n| [n.wrapping_sub(1), n, n.wrapping_add(1)])
}

#[test]
fn quotients_are_those_of_the_compiler() {
    for (n, d) in edgy().flat_map(|n| edgy().map(move |d| (n, d))) {
        assert_eq!(quotient(n, d), n.checked_div(d).unwrap_or(0), "{n} / {d}");
        let signed = n.cast_signed();
        if let Some(divisor) = i64::try_from(d).ok().filter(|divisor| *divisor > 1) {
            assert_eq!(floor(signed, d), signed.div_euclid(divisor), "{signed} / {d}");
        }
        if let (Ok(part @ ..=0x7fff_ffff), Ok(whole @ 1..=0x7fff_ffff)) = (u32::try_from(n.min(d)), u32::try_from(d)) {
            assert_eq!(u64::from(fraction(part, whole)), (u64::from(part) << 30) / u64::from(whole), "{part} / {whole}");
        }
    }
}

#[test]
fn integer_roots_are_those_of_the_compiler() {
    for x in edgy() {
        assert_eq!(u64::from(integer_root(x)), x.isqrt(), "{x}");
    }
}

#[test]
fn arc_cosines() {
    let one = 1 << 30;
    let exact = |cos: i32| (f64::from(cos) / f64::from(one)).acos() / std::f64::consts::TAU;
    let error = |cos: i32| f64::from(arc_cosine(cos)) / CIRCLE - exact(cos);
    let (largest, rms) = statistics((-one..=one).step_by(1009).map(error));
    documented("largest", largest, 8.5e-7);
    documented("RMS", rms, 2.0e-7);
    // Small angles, beside rounding, as parts of themselves; and what is missing of half a circle.
    let apart = |cos: i32| (error(cos).abs() - 1.0 / CIRCLE) / exact(cos.abs());
    let near = || (1..20_000).chain((20_000..one / 16).step_by(997));
    documented("relative, near one", statistics(near().map(|less| apart(one - less).max(0.0))).0, 1.4e-6);
    documented("relative, near minus one", statistics(near().map(|less| apart(less - one).max(0.0))).0, 1.4e-6);
    assert_eq!([one, one + 1, i32::MAX].map(arc_cosine), [0; 3]);
    assert_eq!([-one, -one - 1, i32::MIN].map(arc_cosine), [i32::MAX; 3]);
}

#[test]
fn arc_tangents() {
    let exact = |y: i32, x: i32| f64::from(y).atan2(f64::from(x)) / std::f64::consts::TAU;
    let error = |y: i32, x: i32| f64::from(arc_tangent(y, x)) / CIRCLE - exact(y, x);
    // All around, for vectors long and short.
    let directions = |length: f64| {
        (0..400_009).map(move |i| {
            let (sin, cos) = (f64::from(i) / 400_009.0 * std::f64::consts::TAU).sin_cos();
            error((sin * length) as i32, (cos * length) as i32)
        })
    };
    for length in [1_500_000_000.0, 1_048_576.0, 700.0, 3.0] {
        assert!(statistics(directions(length)).0 <= 4.3e-7, "{length}");
    }
    let (largest, rms) = statistics(directions(2_147_483_647.0));
    documented("largest", largest, 4.3e-7);
    documented("RMS", rms, 8.2e-8);
    let small = || (1..100_000).chain((100_000..1 << 27).step_by(9973));
    let flat = |y: i32, x: i32| (error(y, x).abs() - 1.0 / CIRCLE).max(0.0) / exact(y, x);
    documented("relative, near the x axis", statistics(small().map(|y| flat(y, i32::MAX))).0, 1.3e-6);
    for y in small() {
        // The same in all octants.
        let angle = arc_tangent(y, i32::MAX);
        assert_eq!([arc_tangent(-y, i32::MAX), arc_tangent(i32::MAX, y)], [-angle, (1 << 30) - angle]);
        assert_eq!(arc_tangent(y, -i32::MAX), (i32::MAX - angle).saturating_add(1));
    }
    let extreme = [i32::MIN, -1, 0, 1, i32::MAX];
    for (y, x) in extreme.iter().flat_map(|y| extreme.map(|x| (*y, x))).filter(|pair| *pair != (0, 0)) {
        assert!(error(y, x).abs() < 4.3e-7, "{y} {x}");
    }
    assert_eq!([(0, 0), (0, 7), (0, -7), (7, 0), (-7, 0)].map(|(y, x)| arc_tangent(y, x)), [0, 0, i32::MAX, 1 << 30, -1 << 30]);
}

/// Errors of Eq. 4 as printed, of its refit, and of the table, for one exponent from −90° to 90°, in levels of 255: each largest
/// and RMS.
fn power_errors(exponent: u16) -> [(f64, f64); 3] {
    let (printed, refit, table) = (PiecewisePower::printed(exponent), PiecewisePower::refit(exponent), Power::new(exponent));
    let right = 1 << 30;
    let angles = || (-right..=right).step_by(100_003);
    let cos = |angle: i32| (f64::from(angle) / CIRCLE * std::f64::consts::TAU).cos();
    let errors = |power: &dyn Fn(i32) -> u32| {
        statistics(angles().map(|angle| 255.0 * (f64::from(power(angle)) / 16384.0 - cos(angle).powi(exponent.into()))))
    };
    [
        errors(&|angle| printed.at(angle)),
        errors(&|angle| refit.at(angle)),
        errors(&|angle| table.at((cos(angle) * 2_147_483_648.0) as u32)),
    ]
}

#[test]
fn powers_in_levels() {
    // The table in the docs of `PiecewisePower`: printed, refit and table, each largest and RMS.
    let listed = [
        (1, [13.4, 3.5, 6.1, 4.0, 0.5, 0.15]),
        (2, [10.6, 5.1, 9.4, 4.5, 0.6, 0.22]),
        (5, [3.7, 1.9, 4.4, 1.9, 1.3, 0.40]),
        (10, [5.2, 2.1, 3.8, 1.6, 1.3, 0.33]),
        (20, [3.8, 1.5, 3.7, 1.5, 2.5, 0.55]),
        (32, [4.7, 1.5, 3.7, 1.4, 2.0, 0.39]),
        (50, [4.7, 1.3, 3.7, 1.3, 1.6, 0.27]),
        (100, [9.2, 2.1, 3.7, 1.1, 1.6, 0.23]),
        (125, [14.2, 3.2, 3.7, 1.0, 2.0, 0.27]),
        (256, [37.6, 8.4, 3.7, 0.9, 2.0, 0.23]),
    ];
    for (exponent, stated) in listed {
        let measured = power_errors(exponent).into_iter().flat_map(|(largest, rms)| [largest, rms]);
        for (measured, stated) in measured.zip(stated) {
            documented(&format!("n = {exponent}"), measured, stated);
        }
    }
    let worst = |exponents: RangeInclusive<u16>, which: usize| exponents.map(|n| power_errors(n)[which].0).fold(0.0, f64::max);
    documented("printed, n = 5 … 50", worst(5..=50, 0), 5.4);
    documented("refit, n = 10 … 256", worst(10..=256, 1), 3.8);
    documented("table", worst(1..=256, 2), 0.0136 * 255.0);
}

/// Eq. 4 in f64, with a and b in radians.
fn equation_4(angle: f64, a: f64, b: f64) -> f64 {
    let angle = angle.abs();
    if angle >= b {
        0.0
    } else if angle <= a {
        1.0 - angle * angle / (a * b)
    } else {
        (angle - b).powi(2) / (b * (b - a))
    }
}

/// a and b of Eq. 4 as printed, and of its refit.
fn knees_and_reaches(n: f64) -> [(f64, f64); 2] {
    let refit = match n {
        1.0 => (1.3545, 1.6861),
        _ => (0.755 / n.sqrt() * (1.0 + 0.65 / n), 2.99 / n.sqrt() * (1.0 - 0.47 / n)),
    };
    [((n + 5.6) / (n * (0.09 * n + 5.2)), (n + 65.0) / (5.0 * n + 31.7)), refit]
}

#[test]
fn equation_4_is_as_exact_as_its_errata_say() {
    let error = |n: u16, (a, b): (f64, f64)| {
        let angles = (0..=20_000).map(|i| f64::from(i) / 20_000.0 * std::f64::consts::FRAC_PI_2);
        255.0 * statistics(angles.map(|angle| equation_4(angle, a, b) - angle.cos().powi(n.into()))).0
    };
    let listed = [(1, 13.3), (5, 3.6), (10, 5.2), (20, 3.7), (50, 4.6), (100, 9.1), (125, 14.2), (256, 37.5)];
    for (n, levels) in listed {
        let found = error(n, knees_and_reaches(n.into())[0]);
        assert!((found - levels).abs() < 0.06, "{n}: {found}");
    }
    for n in 10..=256 {
        assert!(error(n, knees_and_reaches(n.into())[1]) < 3.75, "{n}");
    }
}

#[test]
fn parabolas_are_those_of_equation_4() {
    const RADIAN: f64 = CIRCLE / std::f64::consts::TAU;
    let (mut beside, mut stepped) = (vec![], vec![]);
    for exponent in 1..=256_u16 {
        let powers = [PiecewisePower::printed(exponent), PiecewisePower::refit(exponent)];
        for (power, (a, b)) in powers.iter().zip(knees_and_reaches(exponent.into())) {
            let [knee, reach] = [power.knee(), power.reach()];
            assert!((f64::from(knee) / RADIAN / a - 1.0).abs() < 1e-7 && (f64::from(reach) / RADIAN / b - 1.0).abs() < 1e-7);
            let exact = |angle: i64| equation_4(angle as f64 / RADIAN, a, b);
            for angle in (-reach..=reach).step_by(reach as usize / 1009) {
                beside.push(f64::from(power.at(angle)) - 16384.0 * exact(angle.into()));
                assert_eq!(power.at(angle), power.at(-angle));
            }
            assert_eq!([0, reach, reach - 1, i32::MIN, i32::MAX].map(|angle| power.at(angle)), [16384, 0, 0, 0, 0]);
            // Which of the parabolas an angle is on.
            let parabola = |angle: i64| [-reach, -knee, knee, reach].map(|end| angle > i64::from(end));
            for pixels in [3, 7, 256, 1024] {
                let step = 2 * i64::from(reach) / pixels;
                for part in -8..8 {
                    let start = i64::from(reach) * part / 8 + 1;
                    for (step, peak) in [(step, 16384_u32), (-step, 4915)] {
                        let mut along = power.along(start as i32, step as i32, peak);
                        let angles =
                            (0..pixels).map(|i| start + i * step).take_while(|angle| parabola(*angle) == parabola(start));
                        for angle in angles {
                            stepped.push(f64::from(along.next()) / f64::from(1 << 30) - f64::from(peak) / 16384.0 * exact(angle));
                        }
                    }
                }
            }
        }
    }
    let (largest, rms) = statistics(beside.into_iter());
    documented("largest, units of 2⁻¹⁴", largest, 2.6);
    documented("RMS, units of 2⁻¹⁴", rms, 0.65);
    let (largest, rms) = statistics(stepped.into_iter());
    documented("largest along a line", largest, 5.3e-5);
    documented("RMS along a line", rms, 8.5e-6);
}

#[test]
fn parabolas_take_anything() {
    const FIXED: PiecewisePower = PiecewisePower::refit(32);
    assert_eq!(FIXED, PiecewisePower::refit(32));
    assert_eq!([0, 300].map(PiecewisePower::printed), [1, 256].map(PiecewisePower::printed));
    assert_eq!(PiecewisePower::refit(0), PiecewisePower::refit(1));
    let mut random = fastrand::Rng::with_seed(4);
    for exponent in 0..=u16::MAX {
        let power = [PiecewisePower::printed(exponent), PiecewisePower::refit(exponent)];
        for power in power {
            assert!(0 < power.knee() && power.knee() < power.reach(), "{exponent}");
            let (angle, step, peak) = (random.i32(-power.reach()..power.reach()), random.i32(..), random.u32(..));
            assert!(power.at(angle) <= 16384, "{exponent} {angle}");
            let _ = [angle, i32::MIN, random.i32(..)].map(|angle| power.along(angle, step, peak));
        }
    }
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
        // Before the first place that shows all are fainter, from there on none is.
        let first = power.first(Power::FAINT);
        assert!((0..512).all(|place| (power.entry(place) < Power::FAINT) == (place < first)), "{exponent}");
        assert_eq!(power.first(Power::FAINT - 1), 0);
        assert_eq!(power.at_height(Power::height_of(first)), power.entry(first), "{exponent}");
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
fn cosines_of_linear_angles() {
    fn errors<A: Angle>() -> (f64, f64) {
        // Half degrees, from 0 to a little less than 126°.
        let error = |x: f64| {
            let word = ((2.0 * x + 2.5) * f64::from(1 << 24)) as i64 as i32;
            f64::from(A::cosine(word)) / 32768.0 - x.to_radians().cos().max(0.0)
        };
        assert!(
            (90_100..126_700).all(|milli| A::cosine(((f64::from(milli) / 500.0 + 2.5) * f64::from(1 << 24)) as i64 as i32) < 150)
        );
        assert_eq!([0, 1 << 24, 5 << 23].map(A::cosine), [A::cosine(5 << 23); 3]);
        statistics((0..90_000).map(|milli| error(f64::from(milli) / 1000.0)))
    }
    let [fine, byte] = [errors::<Fine>(), errors::<Byte>()];
    documented("largest, fine", fine.0, 1.2e-3);
    documented("RMS, fine", fine.1, 4.5e-4);
    documented("largest, byte", byte.0, 4.4e-3);
    documented("RMS, byte", byte.1, 1.8e-3);
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
