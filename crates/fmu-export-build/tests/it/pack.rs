//! The command `fmu-pack`, run as a build runs it.

use crate::{BLOCK, Folder};
use fmu_export_build::Description;
use fmu_export_build::archive::Archive;
use fmu_export_build::sources::Sources;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The files of a build.
struct Build(Folder);

impl Build {
    fn new(name: &str) -> Self {
        let root = Folder::new(name);
        for (path, content) in [
            ("modelDescription.xml", BLOCK),
            ("model.png", "an icon"),
            ("libblock.so", "a library"),
            ("documentation/index.html", "a page"),
            ("documentation/licenses/notices.txt", "notices"),
            ("documentation/.gitignore", "*"),
            ("resources/scene.toml", "a scene"),
            ("extra/org.example/notes.txt", "notes"),
        ] {
            fs::create_dir_all(root.path(path).parent().unwrap()).unwrap();
            fs::write(root.path(path), content).unwrap();
        }
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
    let arguments = ["--platform", "linux64", "--resources", resources.to_str().unwrap()];
    let archive = build.packed(&first, &arguments);
    let names: Vec<_> = archive.names().collect();
    assert_eq!(
        names,
        [
            "binaries/linux64/block.so",
            "documentation/index.html",
            "documentation/licenses/notices.txt",
            "extra/org.example/notes.txt",
            "model.png",
            "modelDescription.xml",
            "resources/scene.toml"
        ]
    );
    assert_eq!(archive.get("binaries/linux64/block.so"), Some(&b"a library"[..]));
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
    let mut archive = build.packed(&build.path("a.fmu"), &["--platform", "darwin64", "--fmi", "3"]);
    let names: Vec<_> = archive.names().collect();
    assert_eq!(
        names,
        [
            "binaries/aarch64-darwin/block.dylib",
            "binaries/x86_64-darwin/block.dylib",
            "documentation/index.html",
            "documentation/licenses/notices.txt",
            "extra/fmu-export/fmi3.xml",
            "extra/fmu-export/modelDescription.xml",
            "extra/org.example/notes.txt",
            "modelDescription.xml",
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
    sources.describe(&sources.description, &guid, &mut archive).unwrap();
    assert_eq!(text(&archive), whole);
    assert!(Sources::of(&archive).is_none());
}

#[test]
fn a_component_goes_in_with_its_manifest() {
    let build = Build::new("component");
    let archive = build.packed(&build.path("a.fmu"), &["--platform", "wasm32-wasip2", "--fmi", "3"]);
    assert_eq!(archive.get("binaries/wasm32-wasip2/block.wasm"), Some(&b"a library"[..]));
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
    let platform = ["--platform", "linux64"];
    refused(&[], "1 --binary and 0 --platform: each library needs its platform; see --help");
    refused(&["--platform"], "--platform needs a value; see --help");
    refused(&["--platfrom", "linux64"], "\"--platfrom\" is not an option; see --help");
    refused(&["--platform", "linux64", "--output", "b"], "--output is given twice");
    refused(&["--platform", "linux64", "--fmi", "1"], "--fmi 1: there are 2 and 3");
    for name in ["linux", "aarch64-linux"] {
        let message = format!(
            "the platform {name:?} is not one of FMI 2.0's: linux64, win64, darwin64, linux32, win32, \
             darwin32; aarch64-linux and wasm32-wasip2 are for FMI 3.0"
        );
        refused(&["--platform", name], &message);
    }
    fs::write(build.path("fmi3.xml"), "\n<fmi2/>").unwrap();
    refused(&["--platform", "linux64", "--fmi", "3"], "fmi3.xml:2: expected <fmi3>, found <fmi2>");
    fs::remove_file(build.path("documentation/index.html")).unwrap();
    refused(&platform, "has no index.html, the page that importers open");
    fs::write(build.path("modelDescription.xml"), BLOCK.replace("start=\"3\"", "start=\"30\"")).unwrap();
    refused(&platform, ":26: the start value 30 of `layers` is outside its limits 1 to 9");
    fs::remove_file(build.path("modelDescription.xml")).unwrap();
    assert_eq!(build.pack(&output, &platform).status.code(), Some(2));
}

#[test]
fn help_names_every_option() {
    let done = Command::new(env!("CARGO_BIN_EXE_fmu-pack")).arg("--help").output().unwrap();
    let help = String::from_utf8(done.stdout).unwrap();
    assert!(done.status.success());
    for option in
        ["--description", "--binary", "--platform", "--documentation", "--resources", "--fmi", "--output"]
    {
        assert!(help.contains(&format!("\n  {option} ")), "{option}");
    }
}
