//! How fast are files read and written, and does reading OBJ keep up with tobj alone?
//!
//! A torus of a million triangles whose coordinates have all their digits, as text in memory: what is timed is numbers and
//! words, not a disk. Beside the reader of OBJ stands bare `tobj::load_obj_buf` on the same bytes.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use vvmesh::glam::DVec3;
use vvmesh::io::{Loaded, read_obj, read_off, read_ply, read_stl, write_obj, write_off, write_ply, write_stl};
use vvmesh::soup::FaceList;
use vvmesh::{Mesh, shapes};

/// A torus turned out of the axes, so that no coordinate is short or stands twice.
fn torus() -> Mesh {
    let list = shapes::torus(1000, 500, 2.0, 1.0).to_face_list();
    let turned = |p: DVec3| DVec3::new(p.x + 0.3 * p.y, p.y - 0.7 * p.z, p.z + 0.1 * p.x);
    let mut turned = FaceList::new(list.positions.iter().map(|&p| turned(p)).collect());
    list.faces().for_each(|face| turned.push_face(face));
    Mesh::from_face_list(&turned).expect("a torus is a mesh")
}

/// The same faces with a texture coordinate and a normal at each corner.
fn with_attributes(obj: &str) -> String {
    let mut text = String::with_capacity(2 * obj.len());
    for line in obj.lines() {
        let mut words = line.split(' ');
        if words.next() == Some("f") {
            text.push('f');
            words.for_each(|corner| text.extend([" ", corner, "/", corner, "/", corner]));
        } else {
            text.extend([line, "\nvt 0.125 0.75\nvn 0.6 0 0.8"]);
        }
        text.push('\n');
    }
    text
}

/// The same as PLY in text.
fn ply_text(mesh: &Mesh) -> Vec<u8> {
    let mut off = Vec::new();
    write_off(&mut off, mesh).expect("writing to memory succeeds");
    let rows = off.split_inclusive(|&byte| byte == b'\n').skip(2).flatten();
    let (vertices, faces) = (mesh.vertex_count(), mesh.face_count());
    let header = format!(
        "ply\nformat ascii 1.0\nelement vertex {vertices}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    );
    header.bytes().chain(rows.copied()).collect()
}

/// The same as STL in text, with as many digits as single precision needs.
fn stl_text(mesh: &Mesh) -> Vec<u8> {
    let mut text = String::from("solid torus\n");
    for triangle in mesh.triangles() {
        text += "  facet normal 0 0 1\n    outer loop\n";
        for position in triangle.corners().map(|v| mesh.position(v).as_vec3()) {
            text += &format!("      vertex {:e} {:e} {:e}\n", position.x, position.y, position.z);
        }
        text += "    endloop\n  endfacet\n";
    }
    (text + "endsolid torus\n").into_bytes()
}

fn binary<E: std::fmt::Debug>(write: impl FnOnce(&mut Vec<u8>) -> Result<(), E>) -> Vec<u8> {
    let mut bytes = Vec::new();
    write(&mut bytes).expect("writing to memory succeeds");
    bytes
}

fn bare_tobj(mut text: &[u8]) -> tobj::LoadResult {
    tobj::load_obj_buf(&mut text, &tobj::LoadOptions::default(), |_| Err(tobj::LoadError::OpenFileFailed))
}

fn io(criterion: &mut Criterion) {
    let mesh = torus();
    let faces = mesh.face_count();
    let (mut off, mut obj) = (Vec::new(), Vec::new());
    write_off(&mut off, &mesh).expect("writing to memory succeeds");
    write_obj(&mut obj, &mesh).expect("writing to memory succeeds");
    let attributes = with_attributes(std::str::from_utf8(&obj).expect("it is plain ASCII")).into_bytes();

    let mut group = criterion.benchmark_group("io");
    group.sample_size(10).warm_up_time(Duration::from_secs(1));
    group.throughput(Throughput::Bytes(off.len() as u64));
    group.bench_function(BenchmarkId::new("read-off", faces), |bencher| {
        bencher.iter_with_large_drop(|| read_off(&off).expect("it was written so"));
    });
    for (name, text) in [("", &obj), ("-attributes", &attributes)] {
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function(BenchmarkId::new(format!("read-obj{name}"), faces), |bencher| {
            bencher.iter_with_large_drop(|| read_obj(text).expect("it was written so"));
        });
        group.bench_function(BenchmarkId::new(format!("bare-tobj{name}"), faces), |bencher| {
            bencher.iter_with_large_drop(|| bare_tobj(text).expect("it was written so"));
        });
    }
    let (ply, stl) = (binary(|out| write_ply(out, &mesh)), binary(|out| write_stl(out, &mesh)));
    type Reader = fn(&[u8]) -> Result<Loaded, vvmesh::error::ReadError>;
    for (name, read, bytes) in [
        ("ply-text", read_ply as Reader, &ply_text(&mesh)),
        ("ply-binary", read_ply, &ply),
        ("stl-text", read_stl, &stl_text(&mesh)),
        ("stl-binary", read_stl, &stl),
    ] {
        group.throughput(Throughput::Bytes(bytes.len() as u64));
        group.bench_function(BenchmarkId::new(format!("read-{name}"), faces), |bencher| {
            bencher.iter_with_large_drop(|| read(bytes).expect("it was written so"));
        });
    }
    let mut out = Vec::with_capacity(off.len().max(obj.len()));
    group.throughput(Throughput::Bytes(off.len() as u64));
    group.bench_function(BenchmarkId::new("write-off", faces), |bencher| {
        bencher.iter(|| {
            out.clear();
            write_off(&mut out, &mesh).expect("writing to memory succeeds");
        });
    });
    group.throughput(Throughput::Bytes(obj.len() as u64));
    group.bench_function(BenchmarkId::new("write-obj", faces), |bencher| {
        bencher.iter(|| {
            out.clear();
            write_obj(&mut out, &mesh).expect("writing to memory succeeds");
        });
    });
    group.throughput(Throughput::Bytes(ply.len() as u64));
    group.bench_function(BenchmarkId::new("write-ply", faces), |bencher| {
        bencher.iter(|| {
            out.clear();
            write_ply(&mut out, &mesh).expect("writing to memory succeeds");
        });
    });
    group.throughput(Throughput::Bytes(stl.len() as u64));
    group.bench_function(BenchmarkId::new("write-stl", faces), |bencher| {
        bencher.iter(|| {
            out.clear();
            write_stl(&mut out, &mesh).expect("writing to memory succeeds");
        });
    });
    group.finish();
}

criterion_group!(benches, io);
criterion_main!(benches);
