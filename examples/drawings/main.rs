//! Makes the drawings of the documentation: `cargo run --example drawings` writes them to `docs`.
//!
//! What they show is computed by the library: rings, disks, masks and steps, not lines put by hand. `tests/drawings.rs`
//! fails when a committed file is not what this program makes.

mod canvas;
mod cover;
pub mod criteria;
mod sheet;
mod solid;
mod steps;
mod words;

use std::error::Error;
use std::path::Path;

/// Every drawing: the name of its file, and the file.
pub fn all() -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let mut drawings = words::all();
    drawings.extend(steps::all()?);
    drawings.push(("cover", cover::cover()?));
    let mut drawings: Vec<_> = drawings.into_iter().map(|(name, file)| (name.to_owned(), file)).collect();
    for row in criteria::ROWS {
        drawings.push((format!("criteria/{}", row.name()), row.draw()?));
    }
    Ok(drawings)
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    for (name, drawing) in all()? {
        std::fs::write(folder.join(name).with_extension("svg"), drawing)?;
    }
    Ok(())
}
