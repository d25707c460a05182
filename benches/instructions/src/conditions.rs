//! What a count depends on beside the program: compiler, valgrind, the C library, and the processor that valgrind shows.
//!
//! The C library allocates, and copies with the widest instructions that the processor has; so its version and the
//! features that it chooses by are conditions too.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::process::Command;

/// Conditions by name; empty where the machine does not tell.
pub(crate) type Conditions = BTreeMap<String, String>;

/// The argument with which this program, run by valgrind, tells [`processor_features`].
pub(crate) const PROBE: &str = "processor-features";

pub(crate) fn here() -> Conditions {
    let this_program = std::env::current_exe().unwrap_or_default();
    let probe = ["-q".as_ref(), "--tool=none".as_ref(), this_program.as_os_str(), PROBE.as_ref()];
    [
        ("compiler", told_by("rustc", ["--version"])),
        ("target", format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS)),
        ("valgrind", told_by("valgrind", ["--version"])),
        ("libc", told_by("getconf", ["GNU_LIBC_VERSION"])),
        ("processor", told_by("valgrind", probe)),
    ]
    .map(|(name, value)| (name.to_string(), value))
    .into()
}

/// The features by which the C library chooses how to copy, of the processor that this program sees.
pub(crate) fn processor_features() -> Vec<&'static str> {
    #[cfg(target_arch = "x86_64")]
    {
        let features = [
            ("avx", is_x86_feature_detected!("avx")),
            ("avx2", is_x86_feature_detected!("avx2")),
            ("avx512f", is_x86_feature_detected!("avx512f")),
            ("avx512vl", is_x86_feature_detected!("avx512vl")),
            ("bmi2", is_x86_feature_detected!("bmi2")),
            ("ermsb", is_x86_feature_detected!("ermsb")),
            ("fma", is_x86_feature_detected!("fma")),
            ("rtm", is_x86_feature_detected!("rtm")),
        ];
        features.into_iter().filter_map(|(name, is_there)| is_there.then_some(name)).collect()
    }
    #[cfg(not(target_arch = "x86_64"))]
    Vec::new()
}

/// The output of a command without the spaces around it; nothing if it fails.
fn told_by(program: &str, arguments: impl IntoIterator<Item = impl AsRef<OsStr>>) -> String {
    match Command::new(program).args(arguments).output() {
        Ok(output) if output.status.success() => String::from_utf8_lossy(&output.stdout).trim().to_string(),
        _ => String::new(),
    }
}
