//! The command-line tool of vvmesh.

fn main() {}
