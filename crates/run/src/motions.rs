//! One wall under several motions: a row for each of them.

use report::counted;
use report::table::{Column, Digits, Table};
use scene::response::Summary;
use serde_json::{Value, json};

use crate::demands;

/// A motion, and what the wall did under it.
#[derive(Clone, Debug)]
pub struct MotionRow {
    /// Name of the record.
    pub name: String,
    /// Sign with which it was run: `+`, `-`, or `±` where one run stands for both.
    pub sign: &'static str,
    /// Peak acceleration \[m/s²\].
    pub peak_acceleration: f64,
    /// What the wall did.
    pub summary: Summary,
}

/// Returns a row for each motion.
pub fn table(rows: &[MotionRow]) -> Table {
    let four = Digits::Decimals(4);
    let millimetres = Column::number("u_max_m", "|u| [mm]", Digits::Decimals(2)).shown(1000.0);
    Table::over(rows)
        .text("record", "record", |row| row.name.clone())
        .number("", "sign", four, |row| row.sign)
        // one run stands for both signs
        .value("sign", |row| if row.sign == "-" { "-1" } else { "+1" })
        .number("pga_m_s2", "PGA [m/s²]", four, |row| row.peak_acceleration)
        .column(millimetres, |row| row.summary.u_max)
        .number("u_ratio_max", "|u|/u_ins", four, |row| row.summary.u_ratio_max)
        .value("overturned", |row| row.summary.overturned)
        .value("overturn_time_s", |row| row.summary.overturn_time)
        .value("falls", |row| row.summary.fate.falls())
        .text("", "overturned", |row| demands::overturned(row.summary.fate, 3))
        .done()
}

/// Returns the rows in SI units, with the names of a summary.
pub fn json(rows: &[MotionRow]) -> Value {
    let object = |MotionRow { name, sign, peak_acceleration, summary }: &MotionRow| {
        json!({
            "record": name,
            "sign": sign,
            "pga": peak_acceleration,
            "u_max": summary.u_max,
            "u_ratio_max": summary.u_ratio_max,
            "overturned": summary.overturned,
            "overturn_time": summary.overturn_time,
            "falls": summary.fate.falls(),
        })
    };
    rows.iter().map(object).collect()
}

/// Counts the runs that overturned, and those of them that came back, in a line.
pub fn overturned(rows: &[MotionRow]) -> String {
    let count = |is: fn(&Summary) -> bool| rows.iter().filter(|row| is(&row.summary)).count();
    let overturned = count(|summary| summary.overturned);
    let back = overturned - count(|summary| summary.fate.falls());
    let back = if back > 0 { format!(", of which {back} came back") } else { String::new() };
    format!("overturned: {overturned} of {}{back}\n", counted(rows.len(), "run"))
}
