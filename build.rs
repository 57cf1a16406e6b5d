//! Turns the model description into Rust variables; the library includes them as `choices` and `variables`.

fn main() -> std::process::ExitCode {
    fmu_export_build::build_script("modelDescription/modelDescription.xml")
}
