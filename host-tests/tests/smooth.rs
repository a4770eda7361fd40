//! Anti-aliased silhouettes against a reference of 16×16 samples a pixel.

use beamshade::{Color, DuffBarycentric, Light, Scanner};
use embedded_graphics::pixelcolor::{Gray8, GrayColor};
use host_tests::library::{self, Meshes};
use host_tests::reference::{render, Camera, Options, Scene};
use host_tests::scenes::{standard, teapot_880, WHITE};
use host_tests::{Owner, Picture};

/// A picture of so many samples a pixel each way, and which of its pixels a silhouette cuts.
struct Sampled {
    /// Grey, 0 to 255.
    levels: Vec<f64>,
    is_cut: Vec<bool>,
}

/// Draws the scene with `times`² samples a pixel.
fn sampled(scene: &Scene<'_>, times: usize) -> Sampled {
    let mut large = scene.clone();
    let (width, height) = (scene.camera.width, scene.camera.height);
    large.camera.width *= times;
    large.camera.height *= times;
    large.camera.focal *= times as f64;
    let picture = render(&large, Options::default());
    let triangles = scene.triangles();
    let share = |a: Owner, b: Owner| {
        let corners = |owner: Owner| triangles[owner.object as usize][owner.triangle as usize];
        a == b || a.object == b.object && corners(a).iter().any(|vertex| corners(b).contains(vertex))
    };
    let is_edge = |a: Option<Owner>, b: Option<Owner>| match (a, b) {
        (Some(a), Some(b)) => !share(a, b),
        (a, b) => a.is_some() != b.is_some(),
    };
    let mut result = Sampled { levels: Vec::new(), is_cut: Vec::new() };
    for pixel in 0..width * height {
        let (x, y) = (pixel % width * times, pixel / width * times);
        let at = |i: usize, j: usize| (y + j) * picture.width + x + i;
        let cells = (0..times * times).map(|n| (n % times, n / times));
        let sum: f64 = cells.clone().map(|(i, j)| picture.color[at(i, j)][0].clamp(0.0, 1.0)).sum();
        let owner = |i, j| picture.owner[at(i, j)];
        result.levels.push(255.0 * sum / (times * times) as f64);
        result.is_cut.push(
            cells
                .clone()
                .any(|(i, j)| i > 0 && is_edge(owner(i, j), owner(i - 1, j)) || j > 0 && is_edge(owner(i, j), owner(i, j - 1))),
        );
    }
    result
}

/// The library's picture, by plain lines.
fn plain(scene: &Scene<'_>) -> Picture<Gray8> {
    library::draw::<_, DuffBarycentric, 1, Light>(scene, &Meshes::of(scene).unwrap()).unwrap()
}

/// The same by smooth ones, from top to bottom or back.
fn smooth(scene: &Scene<'_>, is_back: bool) -> Vec<Gray8> {
    library::fine_frame::<_, 1, Light>(scene, &Meshes::of(scene).unwrap(), |picture| {
        let mut scanner = Box::<Scanner<256>>::default();
        let mut lines = scanner.start(picture);
        let Camera { width, height, .. } = scene.camera;
        let mut smooth = vec![Gray8::new(0); width * height];
        let mut colors = vec![Color::BLACK; 2 * width];
        let mut rows: Vec<_> = smooth.chunks_mut(width).enumerate().collect();
        if is_back {
            rows.reverse();
        }
        for (y, row) in rows {
            lines.smooth_line(y as u16, &mut colors, row);
        }
        smooth
    })
    .unwrap()
}

/// Root mean square and mean of the absolute errors of the pixels that a silhouette cuts, in levels.
fn errors(truth: &Sampled, levels: impl Iterator<Item = f64>) -> [f64; 2] {
    let cut = levels.zip(&truth.levels).zip(&truth.is_cut).filter(|(_, is_cut)| **is_cut);
    let differences: Vec<f64> = cut.map(|((level, truth), _)| (level - truth).abs()).collect();
    let mean = |f: fn(f64) -> f64| differences.iter().map(|d| f(*d)).sum::<f64>() / differences.len() as f64;
    [mean(|d| d * d).sqrt(), mean(|d| d)]
}

/// Of what a picture without smoothing is off at silhouettes, smooth lines leave a tenth; four samples a pixel leave a third.
#[test]
fn silhouettes_are_better_than_by_four_samples() {
    let mesh = teapot_880().unwrap();
    let mut sums = [[0.0; 2]; 3];
    for frame in [0, 7, 23, 41] {
        let scene = standard(&mesh, WHITE, frame);
        let truth = sampled(&scene, 16);
        let level = |pixel: &Gray8| f64::from(pixel.luma());
        let plain = errors(&truth, plain(&scene).color.iter().map(level));
        let smooth = errors(&truth, smooth(&scene, false).iter().map(level));
        let four = errors(&truth, sampled(&scene, 2).levels.into_iter());
        println!("frame {frame}: RMS and mean error: plain {plain:.2?}, smooth {smooth:.2?}, 4 samples {four:.2?}");
        for (sum, more) in sums.iter_mut().zip([plain, smooth, four]) {
            sum[0] += more[0];
            sum[1] += more[1];
        }
    }
    let [plain, smooth, four] = sums;
    assert!(smooth[1] < four[1] * 0.29 && smooth[1] < plain[1] * 0.101, "{smooth:?} {four:?} {plain:?}");
    assert!(smooth[0] < four[0] * 0.50 && smooth[0] < plain[0] * 0.176, "{smooth:?} {four:?} {plain:?}");
}

/// Away from silhouettes a line is shaded no worse than by plain lines, at the pixel's centre.
#[test]
fn what_no_silhouette_cuts_is_shaded_as_well() {
    let mesh = teapot_880().unwrap();
    let scene = standard(&mesh, WHITE, 7);
    let truth = sampled(&scene, 16);
    let (plain, smooth) = (plain(&scene).color, smooth(&scene, false));
    let width = scene.camera.width;
    let is_near = |pixel: usize| {
        let places = [pixel.wrapping_sub(2), pixel.wrapping_sub(1), pixel, pixel + 1, pixel + 2];
        let rows = [0, width, width.wrapping_neg()];
        rows.iter().any(|row| places.iter().any(|place| truth.is_cut.get(place.wrapping_add(*row)) == Some(&true)))
    };
    let far: Vec<_> = (0..plain.len()).filter(|pixel| !is_near(*pixel)).collect();
    let errors = |levels: &[Gray8]| {
        let errors = far.iter().map(|pixel| (f64::from(levels[*pixel].luma()) - truth.levels[*pixel]).abs());
        [errors.clone().sum::<f64>() / far.len() as f64, errors.fold(0.0, f64::max)]
    };
    let ([plain_mean, plain_most], [mean, most]) = (errors(&plain), errors(&smooth));
    assert!(mean < plain_mean && most < plain_most, "{mean} {most}");
}

#[test]
fn any_order_of_lines_gives_the_same() {
    let mesh = teapot_880().unwrap();
    let scene = standard(&mesh, WHITE, 23);
    assert_eq!(smooth(&scene, false), smooth(&scene, true));
}
