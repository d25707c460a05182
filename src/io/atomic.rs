//! Files that are there whole or not at all.

use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::error::{WriteError, WriteErrorKind};

/// Writes a file so that a reader sees the old content or the new, never a part of it.
///
/// `write` fills a temporary file in the same folder, which is then brought to the disk and renamed. A file that is
/// replaced hands its permissions on, a new one has those that the process gives to new files. A symbolic link stays and
/// its target is replaced; another name of the same file (a hard link) keeps the old content. What is no file, like
/// `/dev/stdout`, is written to directly.
///
/// # Errors
/// A folder or a read-only file at `path`, and whatever the file system or `write` says. Nothing is changed then and the
/// temporary file is gone.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("table.tsv");
/// use std::io::Write;
///
/// vvmesh::io::write_atomically(&path, |out| out.write_all(b"id\n0\n"))?;
/// assert_eq!(std::fs::read(&path)?, b"id\n0\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_atomically(
    path: impl AsRef<Path>,
    write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
) -> Result<(), WriteError> {
    let path = path.as_ref();
    replace(path, write).map_err(|kind| WriteError { path: path.to_owned(), kind })
}

fn replace(path: &Path, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> Result<(), WriteErrorKind> {
    let old = match fs::metadata(path) {
        Ok(old) => Some(old),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(WriteErrorKind::Io(error)),
    };
    match &old {
        Some(old) if old.is_dir() => return Err(WriteErrorKind::Folder),
        Some(old) if !old.is_file() => {
            let file = File::options().write(true).open(path).map_err(WriteErrorKind::Io)?;
            return fill(&file, write).map_err(WriteErrorKind::Io);
        }
        Some(old) if old.permissions().readonly() => return Err(WriteErrorKind::ReadOnly),
        _ => {}
    }
    write_beside(path, old.as_ref(), write).map_err(WriteErrorKind::Io)
}

fn write_beside(
    path: &Path,
    old: Option<&Metadata>,
    write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
) -> io::Result<()> {
    let target = target(path)?;
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if target.file_name().is_none() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "the path names no file"));
    }
    let temporary = new_file(folder)?;
    fill(temporary.as_file(), write)?;
    if let Some(old) = old {
        temporary.as_file().set_permissions(old.permissions())?;
    }
    // A disk that is full or gone may say so only now; after the renaming it would be too late.
    temporary.as_file().sync_all()?;
    temporary.persist(&target)?;
    Ok(())
}

fn fill(file: &File, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
    let mut out = BufWriter::new(file);
    write(&mut out)?;
    out.flush()
}

/// A temporary file with the permissions of a usual new file: `tempfile` alone would let nobody else read it.
fn new_file(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".vv-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666)).tempfile_in(folder)
    }
    #[cfg(not(unix))]
    builder.tempfile_in(folder)
}

/// Where symbolic links lead, also when nothing stands there yet.
fn target(path: &Path) -> io::Result<PathBuf> {
    /// As many as systems follow.
    const LINKS: usize = 40;
    let mut target = path.to_owned();
    for _ in 0..LINKS {
        match fs::symlink_metadata(&target) {
            Ok(metadata) if metadata.is_symlink() => {
                let link = fs::read_link(&target)?;
                target = target.parent().unwrap_or(Path::new("")).join(link);
            }
            _ => return Ok(target),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}
