//! The files between the program and the peers: numbers as they lie in memory, least byte first.
//!
//! A mesh is the number of vertices and of faces in 8 bytes each, then the positions in doubles, then the corners in 4
//! bytes each. A result is doubles alone.

use std::fs;
use std::io;
use std::path::Path;

/// Positions and triangles.
pub(crate) struct RawMesh {
    pub(crate) positions: Vec<[f64; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl RawMesh {
    pub(crate) fn read(path: &Path) -> io::Result<Self> {
        let bytes = fs::read(path)?;
        let (head, rest) = bytes.split_at(16);
        let vertices = u64::from_le_bytes(head[..8].try_into().expect("8 bytes")) as usize;
        let (positions, corners) = rest.split_at(24 * vertices);
        let corners: Vec<u32> =
            corners.chunks_exact(4).map(|four| u32::from_le_bytes(four.try_into().expect("4 bytes"))).collect();
        Ok(Self { positions: numbers(positions).as_chunks().0.to_vec(), triangles: corners.as_chunks().0.to_vec() })
    }

    pub(crate) fn write(&self, path: &Path) -> io::Result<()> {
        let counts = [self.positions.len(), self.triangles.len()];
        let mut bytes: Vec<u8> = counts.iter().flat_map(|&count| (count as u64).to_le_bytes()).collect();
        bytes.extend(self.positions.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend(self.triangles.as_flattened().iter().flat_map(|k| k.to_le_bytes()));
        fs::write(path, bytes)
    }
}

pub(crate) fn read_result(path: &Path) -> io::Result<Vec<f64>> {
    Ok(numbers(&fs::read(path)?))
}

pub(crate) fn write_result(path: &Path, result: &[f64]) -> io::Result<()> {
    fs::write(path, result.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>())
}

fn numbers(bytes: &[u8]) -> Vec<f64> {
    bytes.chunks_exact(8).map(|eight| f64::from_le_bytes(eight.try_into().expect("8 bytes"))).collect()
}
