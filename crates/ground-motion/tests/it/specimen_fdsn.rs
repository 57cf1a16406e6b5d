//! Text of the data centres of the FDSN.

use super::columns;

const SERIES: &str = "sps, 2016-08-24T01:36:32.000000";

pub(crate) fn slist(samples: &[f64]) -> String {
    let rows = columns(samples, 6, |a| format!("{a:.3}\t"));
    format!(
        "TIMESERIES XX_STA1__HNE_D, {} samples, 100 {SERIES}, SLIST, FLOAT, CM/S**2\n{rows}",
        samples.len()
    )
}

/// A row for each sample: its time of day, what stands between, and the sample.
fn timed(samples: &[f64], between: &str) -> String {
    let row = |(i, a): (usize, &f64)| format!("2016-08-24T01:36:{:09.6}{between}{a:.3}\n", 0.01 * i as f64);
    samples.iter().enumerate().map(row).collect()
}

pub(crate) fn tspair(samples: &[f64]) -> String {
    let (count, rows) = (samples.len(), timed(samples, "  "));
    format!("TIMESERIES XX_STA1__HNE_D, {count} samples, 100 {SERIES}, TSPAIR, FLOAT, cm/s^2\n{rows}")
}

pub(crate) fn geocsv(samples: &[f64]) -> String {
    format!(
        "# dataset: GeoCSV 2.0\n# delimiter: ,\n# SID: XX_STA1__H_N_E\n# sample_count: {}\n\
         # sample_rate_hz: 100\n# field_unit: UTC, cm/s**2\n# field_type: datetime, FLOAT\nTime, Sample\n{}",
        samples.len(),
        timed(samples, "Z, ")
    )
}
