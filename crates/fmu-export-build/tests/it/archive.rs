//! Archives: the same bytes for the same content, and what is refused.

use crate::Folder;
use fmu_export_build::archive::{Archive, ArchiveError};
use std::fs::{self, File};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

fn sample(order: [&str; 3]) -> Archive {
    let mut archive = Archive::default();
    for name in order {
        archive.insert(name, name.repeat(1000));
    }
    archive
}

#[test]
fn the_same_content_gives_the_same_bytes_and_reads_back() {
    let folder = Folder::new("same");
    let names = ["resources/scene.toml", "modelDescription.xml", "binaries/linux64/wall.so"];
    let archive = sample(names);
    let bytes = archive.to_bytes().unwrap();
    assert_eq!(sample([names[2], names[0], names[1]]).to_bytes().unwrap(), bytes);
    let path = folder.path("a.fmu");
    fs::write(&path, bytes).unwrap();
    let read = Archive::open(&path).unwrap();
    assert_eq!(read, archive);
    assert!(read.names().is_sorted());
}

#[test]
fn files_can_be_replaced_and_removed() {
    let mut archive = sample(["a", "b", "c"]);
    archive.insert("b", *b"new");
    assert_eq!(archive.get("b"), Some(&b"new"[..]));
    assert_eq!(archive.remove("a").map(|content| content.len()), Some(1000));
    assert_eq!(archive.names().collect::<Vec<_>>(), ["b", "c"]);
    assert_eq!(archive.get("a"), None);
    archive.insert("d/e", *b"");
    archive.insert("d/f/g", *b"");
    archive.insert("de", *b"");
    archive.remove_folder("d");
    assert_eq!(archive.names().collect::<Vec<_>>(), ["b", "c", "de"]);
}

#[test]
fn damaged_archives_are_refused() {
    let folder = Folder::new("damaged");
    let path = folder.path("a.fmu");
    assert!(matches!(Archive::open(&path), Err(ArchiveError::Read { .. })));
    fs::write(&path, "not a zip").unwrap();
    assert!(matches!(Archive::open(&path), Err(ArchiveError::Damaged { .. })));
    let mut archive = Archive::default();
    // Content that does not compress is stored as it is, so that a flipped byte is the content's.
    let noise = (0..4000_u32).map(|n| (n.wrapping_mul(2_654_435_761) >> 13).to_le_bytes()[0]);
    archive.insert("a", noise.collect::<Vec<u8>>());
    let mut bytes = archive.to_bytes().unwrap();
    bytes[1000] ^= 1;
    fs::write(&path, &bytes).unwrap();
    assert!(matches!(Archive::open(&path), Err(ArchiveError::Damaged { .. })));
}

#[test]
fn paths_that_lead_elsewhere_are_refused() {
    let folder = Folder::new("elsewhere");
    let path = folder.path("a.fmu");
    for name in ["../a", "/a", "a//b", "a\\b", "c:/a"] {
        let mut writer = ZipWriter::new(File::create(&path).unwrap());
        writer.start_file(name, SimpleFileOptions::default()).unwrap();
        writer.finish().unwrap();
        let error = Archive::open(&path).unwrap_err();
        assert!(matches!(error, ArchiveError::BadName { .. }), "{name}: {error}");
    }
}
