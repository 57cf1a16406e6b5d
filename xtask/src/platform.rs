//! The machines that libraries and programs are built for, and zig, which links for all of them.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{Result, at, output, program, root, target, write};
use crate::python::Environment;

/// A machine that users have.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Platform {
    /// Rust's name for it.
    pub(crate) target: &'static str,
    /// The oldest C library that it may have, as a suffix of the target.
    glibc: &'static str,
    /// Its folder in FMI 2.0, which two processors may share and which some machines lack.
    pub(crate) fmi2: Option<&'static str>,
    /// Its folder in FMI 3.0.
    pub(crate) fmi3: &'static str,
    /// Beginning and ending of the name of a library.
    pub(crate) library: [&'static str; 2],
    /// Options of the linker, so that the bytes depend on no folder and no clock.
    link: &'static [&'static str],
}

const LINUX: Platform = Platform {
    target: "x86_64-unknown-linux-gnu",
    glibc: ".2.17",
    fmi2: Some("linux64"),
    fmi3: "x86_64-linux",
    library: ["lib", ".so"],
    link: &[],
};
const WINDOWS: Platform = Platform {
    target: "x86_64-pc-windows-gnu",
    glibc: "",
    fmi2: Some("win64"),
    fmi3: "x86_64-windows",
    library: ["", ".dll"],
    // zig leaves the time out of what it links as optimised
    link: &["-Clink-arg=-O2"],
};
const MACOS: Platform = Platform {
    target: "x86_64-apple-darwin",
    glibc: "",
    fmi2: Some("darwin64"),
    fmi3: "x86_64-darwin",
    library: ["lib", ".dylib"],
    // a library has a name of its own instead of the path of its build
    link: &["-Clink-arg=-Wl,-install_name,@rpath/library.dylib"],
};

/// Every platform.
const PLATFORMS: [Platform; 5] = [
    LINUX,
    Platform { target: "aarch64-unknown-linux-gnu", fmi2: None, fmi3: "aarch64-linux", ..LINUX },
    WINDOWS,
    MACOS,
    Platform { target: "aarch64-apple-darwin", fmi3: "aarch64-darwin", ..MACOS },
];

/// Oldest macOS that libraries and programs run on.
const OLDEST_MACOS: &str = "11.0";

impl Platform {
    /// Returns the platforms of a list of names such as `linux64,win64`, in the order of the table. A name is
    /// that of FMI 2.0 or of FMI 3.0.
    pub(crate) fn named(names: &str) -> Result<Vec<&'static Self>> {
        let is_named = |platform: &Self, name| platform.fmi2 == Some(name) || platform.fmi3 == name;
        for name in names.split(',') {
            if !PLATFORMS.iter().any(|platform| is_named(platform, name)) {
                let known = "linux64, win64, darwin64, or FMI 3.0's x86_64-linux, aarch64-linux, …";
                return Err(format!("`{name}` is not a platform: expected {known}"));
            }
        }
        let wanted = PLATFORMS.iter().filter(|one| names.split(',').any(|name| is_named(one, name)));
        let wanted: Vec<_> = wanted.collect();
        let targets = wanted.iter().map(|platform| platform.target);
        check_rust_libraries(targets, ", or choose other platforms with `--platforms`")?;
        Ok(wanted)
    }

    /// Prepares a job of cargo for this platform, linked with zig.
    pub(crate) fn cargo(&self, subcommand: &str) -> Result<Command> {
        let mut build = Environment::of("zig")?.program("cargo-zigbuild");
        build.args([subcommand, "--target", &format!("{}{}", self.target, self.glibc)]);
        self.link_with_zig(&mut build)?;
        Ok(build)
    }

    /// Lets a job of cargo or maturin find zig, and makes its bytes independent of the folder.
    pub(crate) fn link_with_zig(&self, build: &mut Command) -> Result<()> {
        let zig = Environment::of("zig")?;
        let mut path = zig.programs().into_os_string();
        if let Some(rest) = std::env::var_os("PATH") {
            path.push(":");
            path.push(rest);
        }
        build.env("PATH", path).env("MACOSX_DEPLOYMENT_TARGET", OLDEST_MACOS);
        // a list of the names that programs need, where zig has Apple's C library alone
        let frameworks = format!("-Clink-arg=-F{}", root().join("xtask/release/macos").display());
        let of_apple = self.target.contains("apple").then_some(frameworks.as_str());
        let link: Vec<_> = self.link.iter().copied().chain(of_apple).collect();
        reproducible(build, &link);
        Ok(())
    }
}

/// Checks that this machine has the Rust libraries for some targets; `or` is what else can be done where some
/// are missing.
pub(crate) fn check_rust_libraries<'a>(targets: impl IntoIterator<Item = &'a str>, or: &str) -> Result<()> {
    let mut missing = Vec::new();
    for target in targets {
        let mut rustc = program("rustc");
        rustc.args(["--print", "target-libdir", "--target", target]);
        if !Path::new(output(&mut rustc, "install Rust")?.trim()).is_dir() {
            missing.push(target);
        }
    }
    if missing.is_empty() {
        return Ok(());
    }
    let (listed, given) = (missing.join(", "), missing.join(" "));
    Err(format!("the Rust libraries for {listed} are missing: run `rustup target add {given}`{or}"))
}

/// Makes what a build gives independent of its folders, with more flags of the linker.
pub(crate) fn reproducible(build: &mut Command, link: &[&str]) {
    let cargo_home = std::env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| std::env::var_os("HOME").map(|home| Path::new(&home).join(".cargo")));
    let mut flags = vec![
        "-Cstrip=symbols".to_owned(),
        format!("--remap-path-prefix={}=/target", target().join("fmu").display()),
        format!("--remap-path-prefix={}=/rocking-wall", root().display()),
    ];
    flags.extend(cargo_home.map(|home| format!("--remap-path-prefix={}=/cargo", home.display())));
    flags.extend(link.iter().map(ToString::to_string));
    build.env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"));
}

/// Of a universal file of macOS: one for several processors.
const MAGIC: u32 = 0xcafe_babe;
/// Each part begins at a multiple of 2¹⁴ bytes, the page of the newer processor.
const ALIGNMENT: u32 = 14;

/// Joins Mach-O files of different processors into a universal one: a header, then the files.
pub(crate) fn join(parts: &[&Path], output: &Path) -> Result<()> {
    let read = |path: &&Path| std::fs::read(path).map_err(at(path));
    let contents = parts.iter().map(read).collect::<Result<Vec<_>>>()?;
    write(output, joined(&contents))
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
