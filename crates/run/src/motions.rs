//! One wall under several motions: a row for each of them.

use report::counted;
use report::table::{Column, Digits, Table};
use rocking_wall::response::Summary;
use serde_json::{Value, json};

use crate::demands;

/// A motion, and what the wall did under it.
#[derive(Clone, Debug)]
pub struct Row {
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
pub fn table(rows: &[Row]) -> Table {
    let four = Digits::Decimals(4);
    let mut table = Table::new([
        Column::text("record", "record"),
        Column::number("", "sign", four),
        Column::number("sign", "", four),
        Column::number("pga_m_s2", "PGA [m/s²]", four),
        Column::number("u_max_m", "|u| [mm]", Digits::Decimals(2)).shown(1000.0),
        Column::number("u_ratio_max", "|u|/u_ins", four),
        Column::number("overturned", "", four),
        Column::number("overturn_time_s", "", four),
        Column::number("falls", "", four),
        Column::text("", "overturned"),
    ]);
    for Row { name, sign, peak_acceleration, summary } in rows {
        table.row([
            name.clone().into(),
            (*sign).into(),
            // one run stands for both signs
            (if *sign == "-" { "-1" } else { "+1" }).into(),
            (*peak_acceleration).into(),
            summary.u_max.into(),
            summary.u_ratio_max.into(),
            summary.overturned.into(),
            summary.overturn_time.into(),
            summary.fate.falls().into(),
            demands::overturned(summary.fate, 3).into(),
        ]);
    }
    table
}

/// Returns the rows in SI units, with the names of a summary.
pub fn json(rows: &[Row]) -> Value {
    let object = |Row { name, sign, peak_acceleration, summary }: &Row| {
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
pub fn overturned(rows: &[Row]) -> String {
    let count = |is: fn(&Summary) -> bool| rows.iter().filter(|row| is(&row.summary)).count();
    let overturned = count(|summary| summary.overturned);
    let back = overturned - count(|summary| summary.fate.falls());
    let back = if back > 0 { format!(", of which {back} came back") } else { String::new() };
    format!("overturned: {overturned} of {}{back}\n", counted(rows.len(), "run"))
}
