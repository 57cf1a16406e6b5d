//! Universal files of macOS: one for several processors.

use std::path::Path;

use crate::command::Result;

const MAGIC: u32 = 0xcafe_babe;
/// Each part begins at a multiple of 2¹⁴ bytes, the page of the newer processor.
const ALIGNMENT: u32 = 14;

/// Joins Mach-O files of different processors into a universal one: a header, then the files.
pub(crate) fn join(parts: &[&Path], output: &Path) -> Result<()> {
    let read = |path: &&Path| std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()));
    let contents = parts.iter().map(read).collect::<Result<Vec<_>>>()?;
    std::fs::write(output, joined(&contents)).map_err(|error| format!("{}: {error}", output.display()))
}

/// The header has magic and count, then for each file: processor, its variant, offset, size, alignment
/// (`mach-o/fat.h`), all big-endian.
fn joined(contents: &[Vec<u8>]) -> Vec<u8> {
    let mut header: Vec<u32> = vec![MAGIC, u32::try_from(contents.len()).expect("few files")];
    let mut body = Vec::new();
    let page = 1_usize << ALIGNMENT;
    for content in contents {
        // a Mach-O file begins with magic, processor and variant, little-endian
        let word = |at: usize| u32::from_le_bytes([0, 1, 2, 3].map(|byte| content[at + byte]));
        let offset = u32::try_from(page + body.len()).expect("files below 4 GB");
        let size = u32::try_from(content.len()).expect("files below 4 GB");
        header.extend([word(4), word(8), offset, size, ALIGNMENT]);
        body.extend_from_slice(content);
        body.resize(body.len().next_multiple_of(page), 0);
    }
    let mut file: Vec<u8> = header.into_iter().flat_map(u32::to_be_bytes).collect();
    file.resize(page, 0);
    file.append(&mut body);
    file
}
