//! Instructions of the stages on this machine, counted by callgrind: `cargo bench -p host-tests --bench instructions`.
//!
//! Needs valgrind and, in the version that Cargo.lock names, `cargo install gungraun-runner`.
#![allow(missing_docs, unreachable_pub, reason = "gungraun's macros make public items without")]

mod scene;

use beamshade::{DuffBarycentric, Flat, Gouraud, Hybrid, Mesh, Scanner, Shade};
use gungraun::{library_benchmark, library_benchmark_group, main};
use scene::{prepare, resolve, shade, teapot, Filled};
use std::hint::black_box;

/// The teapot, for as long as the program runs.
fn mesh() -> &'static Mesh<'static> {
    Box::leak(Box::new(Box::leak(Box::new(teapot())).mesh()))
}

fn empty() -> (&'static Mesh<'static>, Box<Filled<'static>>) {
    (mesh(), Box::new(Filled::new()))
}

fn filled<S: Shade<1>>() -> (Box<Filled<'static>>, Box<Scanner<96, S>>) {
    let (mesh, mut frame) = empty();
    prepare(mesh, &mut frame);
    (frame, Box::new(Scanner::new()))
}

#[library_benchmark]
#[bench::teapot(setup = empty)]
fn prepared((mesh, mut frame): (&'static Mesh<'static>, Box<Filled<'static>>)) -> Box<Filled<'static>> {
    prepare(black_box(mesh), &mut frame);
    frame
}

#[library_benchmark]
#[bench::teapot(setup = filled::<Flat>)]
fn resolved((frame, mut scanner): (Box<Filled<'static>>, Box<Scanner<96, Flat>>)) -> usize {
    resolve(black_box(&frame), &mut scanner)
}

macro_rules! shaded {
    ($($name:ident $method:ty,)*) => {
        $(
            #[library_benchmark]
            #[bench::teapot(setup = filled::<$method>)]
            fn $name((frame, mut scanner): (Box<Filled<'static>>, Box<Scanner<96, $method>>)) -> usize {
                shade(black_box(&frame), &mut scanner).len()
            }
        )*
    };
}

shaded! {
    shaded_flat Flat,
    shaded_gouraud Gouraud,
    shaded_hybrid Hybrid,
    shaded_duff_barycentric DuffBarycentric,
}

library_benchmark_group!(
    name = stages;
    benchmarks = prepared, resolved, shaded_flat, shaded_gouraud, shaded_hybrid, shaded_duff_barycentric
);

main!(library_benchmark_groups = stages);
