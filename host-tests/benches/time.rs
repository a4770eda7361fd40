//! How long the stages take on this machine: `cargo bench -p host-tests --bench time`.

mod scene;

use beamshade::{Scanner, Shade};
use divan::{black_box, Bencher};
use scene::{prepare, resolve, shade, teapot, Filled};

fn main() {
    divan::main();
}

#[divan::bench]
fn prepared(bencher: Bencher<'_, '_>) {
    let teapot = teapot();
    let mesh = teapot.mesh();
    let mut frame = Box::new(Filled::new());
    bencher.bench_local(|| prepare(black_box(&mesh), &mut frame));
}

#[divan::bench]
fn resolved(bencher: Bencher<'_, '_>) {
    let teapot = teapot();
    let mesh = teapot.mesh();
    let mut frame = Box::new(Filled::new());
    prepare(&mesh, &mut frame);
    let mut scanner = Box::new(Scanner::new());
    bencher.bench_local(|| resolve(black_box(&frame), &mut scanner));
}

#[divan::bench(types = [
    beamshade::Flat,
    beamshade::Gouraud,
    beamshade::QuadraticIntensity,
    beamshade::Hybrid,
    beamshade::DuffBarycentric,
    beamshade::Phong,
])]
fn shaded<S: Shade<1>>(bencher: Bencher<'_, '_>) {
    let teapot = teapot();
    let mesh = teapot.mesh();
    let mut frame = Box::new(Filled::new());
    prepare(&mesh, &mut frame);
    let mut scanner = Box::new(Scanner::<96, S>::new());
    bencher.bench_local(|| shade(black_box(&frame), &mut scanner));
}
