//! The command `fmu-pack`, run as a build runs it.

use crate::{BLOCK, Folder};
use fmu_export_build::Description;
use fmu_export_build::archive::Archive;
use fmu_export_build::sources::Sources;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A library of the block for a machine, as far as `fmu-pack` looks into it.
fn library(machine: &str) -> Vec<u8> {
    let elf = |class: u8, machine: u8| {
        let mut bytes = vec![0_u8; 64];
        bytes[..5].copy_from_slice(&[0x7f, b'E', b'L', b'F', class]);
        (bytes[16], bytes[18]) = (3, machine);
        bytes
    };
    let pe = |machine: [u8; 2]| {
        let mut bytes = vec![0_u8; 128];
        bytes[..2].copy_from_slice(b"MZ");
        bytes[0x3c] = 64;
        bytes[64..68].copy_from_slice(b"PE\0\0");
        bytes[68..70].copy_from_slice(&machine);
        bytes[87] = 0x20;
        bytes
    };
    let mach_o = |magic: u8, processor: u32, kind: u32| {
        [0xfeed_fa00 | u32::from(magic), processor, 0, kind].map(u32::to_le_bytes).concat()
    };
    let universal =
        [0xcafe_babe, 2, 0x0100_0007, 3, 0, 0, 14, 0x0100_000c, 0, 0, 0, 14].map(u32::to_be_bytes).concat();
    let mut bytes = match machine {
        "x86_64-linux" => elf(2, 62),
        "x86-linux" => elf(1, 3),
        "aarch64-linux" => elf(2, 183),
        "riscv64-linux" => elf(2, 243),
        "x86_64-windows" => pe([0x64, 0x86]),
        "x86-windows" => pe([0x4c, 0x01]),
        "x86_64-darwin" => mach_o(0xcf, 0x0100_0007, 6),
        "aarch64-darwin" => mach_o(0xcf, 0x0100_000c, 8),
        "x86-darwin" => mach_o(0xce, 7, 6),
        "program of darwin" => mach_o(0xcf, 0x0100_0007, 2),
        "universal" => universal,
        "wasm32-wasip2" => b"\0asm\x0d\0\x01\0fmi:fmi3/common@3.0.0".to_vec(),
        _ => unreachable!("{machine}"),
    };
    bytes.extend(b"\0fmi2GetVersion\0fmi3GetVersion\0");
    bytes.extend(Description::parse(BLOCK).unwrap().guid().bytes());
    bytes
}

/// The files of a build.
struct Build(Folder);

impl Build {
    fn new(name: &str) -> Self {
        let root = Folder::new(name);
        for (path, content) in [
            ("modelDescription.xml", BLOCK),
            ("model.png", "an icon"),
            ("documentation/index.html", "a page"),
            ("documentation/licenses/license.txt", "notices"),
            ("documentation/.gitignore", "*"),
            ("resources/scene.toml", "a scene"),
            ("extra/org.example/notes.txt", "notes"),
        ] {
            fs::create_dir_all(root.path(path).parent().unwrap()).unwrap();
            fs::write(root.path(path), content).unwrap();
        }
        fs::write(root.path("libblock.so"), library("x86_64-linux")).unwrap();
        Self(root)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path(name)
    }

    /// Runs the command on these files, with `extra` arguments.
    fn pack(&self, output: &Path, extra: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_fmu-pack"))
            .arg("--description")
            .arg(self.path("modelDescription.xml"))
            .arg("--binary")
            .arg(self.path("libblock.so"))
            .arg("--documentation")
            .arg(self.path("documentation"))
            .arg("--output")
            .arg(output)
            .args(extra)
            .output()
            .unwrap()
    }

    /// Runs the command, and opens what it writes without a word.
    fn packed(&self, output: &Path, extra: &[&str]) -> Archive {
        let done = self.pack(output, extra);
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        assert!(done.stdout.is_empty());
        Archive::open(output).unwrap()
    }
}

#[test]
fn an_fmu_has_its_files_in_their_places() {
    let build = Build::new("places");
    let (first, second) = (build.path("a.fmu"), build.path("b.fmu"));
    let resources = build.path("resources");
    let arguments = ["--resources", resources.to_str().unwrap()];
    let archive = build.packed(&first, &arguments);
    let names: Vec<_> = archive.names().collect();
    assert_eq!(
        names,
        [
            "binaries/linux64/block.so",
            "documentation/index.html",
            "documentation/licenses/license.txt",
            "extra/org.example/notes.txt",
            "model.png",
            "modelDescription.xml",
            "resources/scene.toml"
        ]
    );
    assert_eq!(archive.get("binaries/linux64/block.so"), Some(&library("x86_64-linux")[..]));
    let text = std::str::from_utf8(archive.get("modelDescription.xml").unwrap()).unwrap();
    let description = Description::parse(text).unwrap();
    assert_eq!(description.declared_guid(), Description::parse(BLOCK).unwrap().guid());
    assert!(build.pack(&second, &arguments).status.success());
    assert_eq!(fs::read(first).unwrap(), fs::read(second).unwrap());
}

#[test]
fn an_fmi_3_unit_has_its_own_places_and_what_it_was_made_from() {
    let build = Build::new("fmi3");
    fs::write(build.path("fmi3.xml"), "<fmi3 mightReturnEarlyFromDoStep=\"true\"/>").unwrap();
    fs::write(build.path("libblock.so"), library("universal")).unwrap();
    let mut archive = build.packed(&build.path("a.fmu"), &["--fmi", "3"]);
    let names: Vec<_> = archive.names().collect();
    assert_eq!(
        names,
        [
            "binaries/aarch64-darwin/block.dylib",
            "binaries/x86_64-darwin/block.dylib",
            "documentation/index.html",
            "documentation/licenses/license.txt",
            "extra/org.example/notes.txt",
            "modelDescription.xml",
            "resources/fmu-export/fmi3.xml",
            "resources/fmu-export/modelDescription.xml",
            "terminalsAndIcons/icon.png"
        ]
    );
    let guid = Description::parse(BLOCK).unwrap().guid();
    let text =
        |archive: &Archive| String::from_utf8(archive.get("modelDescription.xml").unwrap().to_vec()).unwrap();
    let whole = text(&archive);
    assert!(whole.contains(&format!("instantiationToken=\"{guid}\"")));
    assert!(whole.contains("mightReturnEarlyFromDoStep=\"true\""));
    // a unit made from it is described in the same way, and keeps no sources
    let sources = Sources::of(&archive).unwrap().unwrap();
    assert_eq!(sources.description.declared_guid(), guid);
    sources.describe(&sources.description, &mut archive).unwrap();
    assert_eq!(text(&archive), whole);
    assert!(Sources::of(&archive).is_none());
}

#[test]
fn a_component_goes_in_with_its_manifest() {
    let build = Build::new("component");
    fs::write(build.path("libblock.so"), library("wasm32-wasip2")).unwrap();
    let archive = build.packed(&build.path("a.fmu"), &["--fmi", "3"]);
    assert_eq!(archive.get("binaries/wasm32-wasip2/block.wasm"), Some(&library("wasm32-wasip2")[..]));
    // the draft's name, and that of FMI 3.0.2
    let [manifest, other] = ["manifest.xml", "fmi-ls-manifest.xml"]
        .map(|name| archive.get(&format!("extra/org.modelica.fmi-ls-wasm/{name}")).unwrap());
    assert_eq!(manifest, other);
    let text = std::str::from_utf8(manifest).unwrap();
    assert!(text.contains("fmi-ls-name=\"org.modelica.fmi-ls-wasm\""), "{text}");
}

#[test]
fn bad_input_gives_one_message_exit_code_2_and_no_file() {
    let build = Build::new("bad");
    let output = build.path("a.fmu");
    let refused = |extra: &[&str], message: &str| {
        let done = build.pack(&output, extra);
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(done.status.code(), Some(2), "{said}");
        assert!(said.starts_with("fmu-pack: ") && said.trim_end().ends_with(message), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(!output.exists());
    };
    refused(&["--fmi"], "--fmi needs a value; see --help");
    refused(&["--platform", "linux64"], "\"--platform\" is not an option; see --help");
    refused(&["--output", "b"], "--output is given twice");
    refused(&["--fmi", "1"], "--fmi 1: there are 2 and 3");
    let library = build.path("libblock.so");
    refused(&["--binary", library.to_str().unwrap()], "another library is binaries/linux64/block.so already");
    fs::write(build.path("fmi3.xml"), "\n<fmi2/>").unwrap();
    refused(&["--fmi", "3"], "fmi3.xml:2: expected <fmi3>, found <fmi2>");
    fs::create_dir_all(build.path("extra/notes")).unwrap();
    fs::write(build.path("extra/notes/notes.txt"), "notes").unwrap();
    refused(&[], "extra/notes/notes.txt: name what is in extra by a domain, as in org.example.notes");
    fs::remove_dir_all(build.path("extra")).unwrap();
    let licenses = build.path("documentation/licenses");
    fs::rename(licenses.join("license.txt"), licenses.join("notices.txt")).unwrap();
    let no_entry = "licenses: has no license.spdx, license.txt or license.html, where FMI 3.0 begins to read";
    refused(&[], no_entry);
    fs::rename(licenses.join("notices.txt"), licenses.join("license.html")).unwrap();
    fs::remove_file(build.path("documentation/index.html")).unwrap();
    refused(&[], "has no index.html, the page that importers open");
    fs::write(build.path("modelDescription.xml"), BLOCK.replace("start=\"3\"", "start=\"30\"")).unwrap();
    refused(&[], ":26: the start value 30 of `layers` is outside its limits 1 to 9");
    fs::remove_file(build.path("modelDescription.xml")).unwrap();
    assert_eq!(build.pack(&output, &[]).status.code(), Some(2));
}

/// A library goes into the folders of its machines, and into no other.
#[test]
fn a_library_belongs_to_its_platform() {
    const MACHINES: [(&str, &[&str], &[&str]); 9] = [
        ("x86_64-linux", &["linux64"], &["x86_64-linux"]),
        ("x86-linux", &["linux32"], &["x86-linux"]),
        ("aarch64-linux", &[], &["aarch64-linux"]),
        ("x86_64-windows", &["win64"], &["x86_64-windows"]),
        ("x86-windows", &["win32"], &["x86-windows"]),
        ("x86_64-darwin", &["darwin64"], &["x86_64-darwin"]),
        ("aarch64-darwin", &["darwin64"], &["aarch64-darwin"]),
        ("x86-darwin", &["darwin32"], &["x86-darwin"]),
        ("universal", &["darwin64"], &["aarch64-darwin", "x86_64-darwin"]),
    ];
    let build = Build::new("platforms");
    for (machine, of_2, of_3) in MACHINES {
        fs::write(build.path("libblock.so"), library(machine)).unwrap();
        for (version, folders) in [("2", of_2), ("3", of_3)] {
            let output = build.path(&format!("{machine}{version}.fmu"));
            let done = build.pack(&output, &["--fmi", version]);
            let said = String::from_utf8_lossy(&done.stderr).into_owned();
            if folders.is_empty() {
                let end = format!("is for {machine}, which FMI {version}.0 has no folder for\n");
                assert!(said.ends_with(&end) && !output.exists(), "{said}");
                continue;
            }
            let archive = Archive::open(&output).unwrap();
            let found = archive.names().filter_map(|name| name.strip_prefix("binaries/")?.split('/').next());
            assert_eq!(found.collect::<Vec<_>>(), folders, "{machine}: {said}");
        }
    }
}

#[test]
fn what_is_no_library_of_this_model_is_refused() {
    let build = Build::new("libraries");
    let guid = Description::parse(BLOCK).unwrap().guid();
    let without = |part: &str| {
        let mut bytes = library("x86_64-linux");
        let at = bytes.windows(part.len()).position(|window| window == part.as_bytes()).unwrap();
        bytes[at] = b'_';
        bytes
    };
    let no_library = "is neither a shared library of Linux, Windows or macOS nor a WebAssembly component";
    let mut relocatable = library("x86_64-linux");
    relocatable[16] = 1;
    let mut program = library("x86_64-windows");
    program[87] = 0;
    let java = [&0xcafe_babe_u32.to_be_bytes()[..], &[0, 0, 0, 65], b" Hello.java"].concat();
    for (bytes, fmi, message) in [
        (b"root:x:0:0:root:/root:/bin/bash\n".to_vec(), "2", no_library),
        (Vec::new(), "2", no_library),
        (b"\x7fELF".to_vec(), "2", no_library),
        (b"!<arch>\n".to_vec(), "2", no_library),
        (relocatable, "2", no_library),
        (program, "2", no_library),
        (library("program of darwin"), "2", no_library),
        (java, "2", no_library),
        (b"\0asm\x01\0\0\0".to_vec(), "3", no_library),
        (library("riscv64-linux"), "2", "is for another processor, which FMI 2.0 has no folder for"),
        (without("fmi2GetVersion"), "2", "does not export the functions of FMI 2.0; fmu_export::export_fmu!"),
        (without("fmi3GetVersion"), "3", "does not export the functions of FMI 3.0; fmu_export::export_fmu!"),
        (without(&guid), "2", "does not hold the guid {"),
    ] {
        let (output, path) = (build.path("a.fmu"), build.path("libblock.so"));
        fs::write(&path, bytes).unwrap();
        let done = build.pack(&output, &["--fmi", fmi]);
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(done.status.code(), Some(2), "{message}");
        assert!(said.starts_with(&format!("fmu-pack: {}: {message}", path.display())), "{said}");
        assert!(!output.exists());
    }
}

#[test]
fn help_names_every_option() {
    let done = Command::new(env!("CARGO_BIN_EXE_fmu-pack")).arg("--help").output().unwrap();
    let help = String::from_utf8(done.stdout).unwrap();
    assert!(done.status.success());
    for option in ["--description", "--binary", "--documentation", "--resources", "--fmi", "--output"] {
        assert!(help.contains(&format!("\n  {option} ")), "{option}");
    }
}
