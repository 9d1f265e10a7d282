//! Reading and writing.

use divan::counter::BytesCount;
use divan::{Bencher, black_box};
use riemap::io::{Format, Uv, parse, write};

use crate::fixture::{Mesh, meshes};

#[divan::bench(args = meshes())]
fn read_obj(bencher: Bencher, mesh: Mesh) {
    let bytes = written(mesh, "obj");
    bencher.counter(BytesCount::of_slice(&bytes)).bench_local(|| parse(black_box(&bytes), Format::Obj));
}

#[divan::bench(args = meshes())]
fn read_ply(bencher: Bencher, mesh: Mesh) {
    let bytes = written(mesh, "ply");
    bencher.counter(BytesCount::of_slice(&bytes)).bench_local(|| parse(black_box(&bytes), Format::Ply));
}

#[divan::bench(args = meshes())]
fn write_obj(bencher: Bencher, mesh: Mesh) {
    write_as(bencher, mesh, "obj");
}

#[divan::bench(args = meshes())]
fn write_ply(bencher: Bencher, mesh: Mesh) {
    write_as(bencher, mesh, "ply");
}

fn write_as(bencher: Bencher, mesh: Mesh, extension: &str) {
    let bytes = written(mesh, extension).len();
    let surface = mesh.input().surface;
    let uv = texture(surface.positions());
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join(format!("mesh.{extension}"));
    bencher.counter(BytesCount::new(bytes)).bench_local(|| write(&path, &surface, None, Some(Uv::PerVertex(&uv))));
}

fn written(mesh: Mesh, extension: &str) -> Vec<u8> {
    let surface = mesh.input().surface;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join(format!("mesh.{extension}"));
    write(&path, &surface, None, Some(Uv::PerVertex(&texture(surface.positions())))).expect("it can be written");
    std::fs::read(path).expect("it can be read")
}

/// Coordinates with all their digits, as a map has them.
fn texture(positions: &[[f64; 3]]) -> Vec<[f64; 2]> {
    positions.iter().map(|p| [p[0] / 3.0, p[2] / 7.0]).collect()
}
