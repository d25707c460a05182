//! What several test files share.

#![allow(dead_code, unreachable_pub, reason = "each test file is a crate and uses a part")]

#[cfg(feature = "cli")]
pub mod desk;
pub mod load;
pub mod random;
pub mod ride;
pub mod run;
pub mod step_model;

use std::path::{Path, PathBuf};

/// The folder of mesh files, if there is one: `VV_MESHES`, else `../shared/meshes` beside the repository.
///
/// Without it a test that needs it says so and passes, unless `VV_REQUIRE_MESHES` is 1.
#[allow(clippy::print_stderr, reason = "a test that is skipped must say so")]
pub(crate) fn meshes() -> Option<PathBuf> {
    let default = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/meshes");
    let folder = std::env::var_os("VV_MESHES").map_or_else(default, PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    let required = std::env::var_os("VV_REQUIRE_MESHES").is_some_and(|value| value == "1");
    assert!(!required, "there is no folder {}, and VV_REQUIRE_MESHES is 1", folder.display());
    eprintln!("skipped: there is no folder {}; name one in VV_MESHES", folder.display());
    None
}
