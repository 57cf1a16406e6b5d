//! Where tests find real records, which cannot be copied into the project.

use std::path::{Path, PathBuf};

/// The folder of records; a folder that was asked for must be there.
pub(crate) fn folder() -> Option<PathBuf> {
    if let Some(folder) = std::env::var_os("ROCKING_WALL_RECORDS").map(PathBuf::from) {
        assert!(
            folder.join("index.csv").is_file(),
            "ROCKING_WALL_RECORDS={} has no index.csv",
            folder.display()
        );
        return Some(folder);
    }
    // several packages have this file
    let mut folders = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
    let root = folders.find(|folder| folder.join("Cargo.lock").is_file()).expect("a workspace");
    let folder = root.join("../shared/records");
    folder.join("index.csv").is_file().then_some(folder)
}
