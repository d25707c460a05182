//! What the tests of file formats share: files of another program, bits, and faults at random.

#![allow(dead_code, reason = "each test file uses a part of it")]

use std::path::Path;

use vvmesh::error::ReadError;
use vvmesh::glam::DVec3;
use vvmesh::io::Loaded;
use vvmesh::soup::FaceList;

use super::random::Random;

/// A file of `tests/fixtures/formats`, and the corners of its faces as the program that made it reads them.
pub(crate) fn fixture(name: &str) -> (Vec<u8>, Vec<DVec3>) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/formats");
    let text = std::fs::read_to_string(folder.join("corners.txt")).expect("it is part of the repository");
    let part = text.split("file ").find_map(|part| part.strip_prefix(name)).expect("it names every file");
    let corner = |line: &str| {
        let bits = |word: &str| f64::from_bits(u64::from_str_radix(word, 16).expect("hexadecimal digits"));
        let values: Vec<f64> = line.split(' ').skip(1).map(bits).collect();
        DVec3::from_slice(&values)
    };
    let corners = part.lines().filter(|line| line.starts_with('c')).map(corner).collect();
    (std::fs::read(folder.join(name)).expect("it is part of the repository"), corners)
}

/// The positions of the corners of all faces.
pub(crate) fn corners(faces: &FaceList) -> Vec<DVec3> {
    faces.faces().flatten().map(|&v| faces.positions[v as usize]).collect()
}

/// Positions as bits, and faces.
pub(crate) fn bits(faces: &FaceList) -> (Vec<[u64; 3]>, Vec<Vec<u32>>) {
    let positions = faces.positions.iter().map(|position| position.to_array().map(f64::to_bits));
    (positions.collect(), faces.faces().map(<[u32]>::to_vec).collect())
}

/// Reads a file cut off at every place, and with bytes changed at random: whatever the answer, it comes.
///
/// What is made is not greater than the file could hold: a header alone must not be believed.
pub(crate) fn never_panics(bytes: &[u8], read: impl Fn(&[u8]) -> Result<Loaded, ReadError>) {
    let check = |bytes: &[u8]| {
        if let Ok(loaded) = read(bytes) {
            assert!(loaded.faces.vertex_count() <= bytes.len() && loaded.faces.face_count() <= bytes.len());
        }
    };
    for length in 0..bytes.len() {
        check(&bytes[..length]);
    }
    let mut random = Random::new(2027);
    for _ in 0..3000 {
        let mut bytes = bytes.to_vec();
        for _ in 0..=random.below(3) {
            let at = random.below(bytes.len());
            match random.below(4) {
                0 => bytes[at] = [0, 0xff, b'9', b'-', b' ', b'\n'][random.below(6)],
                1 => bytes[at] = random.below(256) as u8,
                2 => drop(bytes.remove(at)),
                _ => bytes.insert(at, b'0' + random.below(10) as u8),
            }
        }
        check(&bytes);
    }
}
