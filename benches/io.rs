//! How fast are files read and written, and does reading OBJ keep up with tobj alone?
//!
//! A torus of a million triangles whose coordinates have all their digits, as text in memory: what is timed is numbers and
//! words, not a disk. Beside the reader of OBJ stands bare `tobj::load_obj_buf` on the same bytes.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use vvmesh::glam::DVec3;
use vvmesh::io::{read_obj, read_off, write_obj, write_off};
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
    group.finish();
}

criterion_group!(benches, io);
criterion_main!(benches);
