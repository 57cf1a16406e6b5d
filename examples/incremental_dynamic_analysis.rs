//! An incremental dynamic analysis of one wall: records scaled until it overturns, and the fragility of
//! collapse.
//!
//! ```text
//! cargo run --release --example incremental_dynamic_analysis
//! ```

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use std::error::Error;

use fragility::{Sample, fit};
use ground_motion::SyntheticMotion;
use rocking_wall::variables::DampingModel;
use rocking_wall::wall::Parameters;
use run::model::{EnergyLoss, Model};
use run::records::NamedRecord;
use run::walls::NamedWall;
use study::ida::{Crossing, IntensityMeasure, Levels, Study};

fn main() -> Result<(), Box<dyn Error>> {
    let parameters = Parameters { height: 3.0, thickness: 0.3, a1: 0.01, ..Parameters::default() };
    let walls = vec![NamedWall::new("parapet", parameters)];

    // Twenty synthetic motions stand for records.
    let record = |seed| -> Result<NamedRecord, Box<dyn Error>> {
        let motion = SyntheticMotion { seed, duration: 15.0, ..SyntheticMotion::default() }.motion()?;
        Ok(NamedRecord::new(format!("motion {seed}"), motion))
    };
    let records = (1..=20).map(record).collect::<Result<Vec<_>, _>>()?;

    let models = vec![Model::new(EnergyLoss::Restitution), Model::new(DampingModel::ConstantCoefficient)];
    let levels = Levels::HuntAndFill { first: 1.0, increase: 0.5, top: 60.0, resolution: 0.02, gap: 0.25 };
    let study = Study::new(walls, records, models, IntensityMeasure::Pga, levels)?;
    let curves = study.run(2)?;

    for (index, model) in study.models().iter().enumerate() {
        let of_model = (0..study.count()).filter(|&case| study.case(case).model == index);
        let of_model: Vec<_> = of_model.map(|case| curves[case].clone()).collect();
        let fragility = fit(&Sample::of_curves(&of_model, 1.0, Crossing::First, None))?;
        println!(
            "{}: median PGA {:.2} m/s², dispersion {:.2}",
            model.name, fragility.median, fragility.dispersion
        );
    }
    Ok(())
}
