//! FMI 2.0 export layer: everything between the C functions of an FMU and a Rust model.
