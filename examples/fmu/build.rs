fn main() -> std::process::ExitCode {
    fmu_export_build::build_script("modelDescription.xml")
}
