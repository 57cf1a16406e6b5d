//! What a file that is to go into `binaries/` is: for which machines, by which functions, of which model.

/// Returns the platforms that the library in `bytes` is for, by their folders in FMI 3.0; `None` if it is no
/// shared library.
pub(crate) fn platforms(bytes: &[u8]) -> Option<Vec<&'static str>> {
    let found = match bytes.get(..4)? {
        [0x7f, b'E', b'L', b'F'] => vec![elf(bytes)?],
        [b'M', b'Z', ..] => vec![pe(bytes)?],
        [0xca, 0xfe, 0xba, 0xbe] => universal(bytes)?,
        [0xcf | 0xce, 0xfa, 0xed, 0xfe] => vec![mach_o(bytes)?],
        b"\0asm" if bytes.get(4..8)? == COMPONENT => vec!["wasm32-wasip2"],
        _ => return None,
    };
    Some(found)
}

/// Version and layer of a WebAssembly component; those of a module are 1 and 0.
const COMPONENT: [u8; 4] = [0x0d, 0, 1, 0];

/// A processor that FMI 3.0 has no folder for, or this crate does not know.
const UNKNOWN: &str = "another processor";

/// A shared object of Linux (`elf.h`).
fn elf(bytes: &[u8]) -> Option<&'static str> {
    const SHARED: u16 = 3;
    (half(bytes, 16)? == SHARED).then_some(match half(bytes, 18)? {
        3 => "x86-linux",
        62 => "x86_64-linux",
        183 => "aarch64-linux",
        _ => UNKNOWN,
    })
}

/// A DLL of Windows (`winnt.h`).
fn pe(bytes: &[u8]) -> Option<&'static str> {
    const DLL: u16 = 0x2000;
    let header = usize::try_from(word(bytes, 0x3c)?).ok()?;
    let is_dll = bytes.get(header..header + 4)? == b"PE\0\0" && half(bytes, header + 22)? & DLL != 0;
    is_dll.then_some(match half(bytes, header + 4)? {
        0x014c => "x86-windows",
        0x8664 => "x86_64-windows",
        _ => UNKNOWN,
    })
}

/// A library or bundle of macOS (`mach-o/loader.h`).
fn mach_o(bytes: &[u8]) -> Option<&'static str> {
    const LIBRARY: u32 = 6;
    const BUNDLE: u32 = 8;
    matches!(word(bytes, 12)?, LIBRARY | BUNDLE).then_some(processor(word(bytes, 4)?))
}

/// The parts of a universal file of macOS (`mach-o/fat.h`), whose header is big-endian.
fn universal(bytes: &[u8]) -> Option<Vec<&'static str>> {
    let number = |at: usize| word(bytes, at).map(u32::swap_bytes);
    // a class of Java begins with the same magic and its version, which is larger than this
    let count = usize::try_from(number(4)?).ok().filter(|count| (1..20).contains(count))?;
    (0..count).map(|part| number(8 + 20 * part).map(processor)).collect()
}

fn processor(number: u32) -> &'static str {
    match number {
        7 => "x86-darwin",
        0x0100_0007 => "x86_64-darwin",
        0x0100_000c => "aarch64-darwin",
        _ => UNKNOWN,
    }
}

fn half(bytes: &[u8], at: usize) -> Option<u16> {
    bytes.get(at..)?.first_chunk().copied().map(u16::from_le_bytes)
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().copied().map(u32::from_le_bytes)
}

/// Returns whether the library exports the functions of FMI 3.0, or else of FMI 2.0. The names of exported
/// functions stand in every format as texts that end with a NUL; the one looked for is named nowhere else. A
/// component is of FMI 3.0, and names the interfaces.
pub(crate) fn is_of_version(bytes: &[u8], fmi3: bool) -> bool {
    let name: &[u8] = match bytes {
        [0, b'a', b's', b'm', ..] => b"fmi:fmi3/",
        _ if fmi3 => b"fmi3GetVersion\0",
        _ => b"fmi2GetVersion\0",
    };
    contains(bytes, name)
}

/// Returns whether the library holds `guid`, which it compares with the importer's.
pub(crate) fn is_of_model(bytes: &[u8], guid: &str) -> bool {
    contains(bytes, guid.as_bytes())
}

fn contains(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}
