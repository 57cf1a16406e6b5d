//! The run of a building as tables: the peaks of its floors and walls, and all histories.

use report::table::{Digits, Growing, Table};
use rocking_wall::wall::Wall;
use run::demands;
use serde_json::{Value, json};

use crate::coupled::Coupled;
use crate::histories::{History, Peak};
use crate::{Building, Parts};

/// A peak with its sign and its time, for people.
fn at(Peak { value, time }: Peak, scale: f64, digits: usize) -> String {
    format!("{:+.digits$} at {time:.2} s", scale * value)
}

/// Returns the peaks of each floor.
pub fn floors(building: &Building, run: &Coupled) -> Table {
    let any = Digits::AtMost(6);
    Table::over(building.floors.iter().zip(&run.floors))
        .text("", "floor", |(floor, _)| floor.name.clone())
        .number("", "acceleration [m/s²]", any, |(_, history)| at(history.acceleration.peak, 1.0, 3))
        .number("", "drift [mm]", any, |(_, history)| at(history.drift.peak, 1000.0, 2))
        .done()
}

/// Returns the peaks of each wall, and whether it overturned. Where ties may yield, it says how much longer
/// they are at the end, and when one first broke.
pub fn walls(building: &Building, parts: &Parts, run: &Coupled) -> Table {
    let (any, three) = (Digits::AtMost(6), Digits::Decimals(3));
    let rows = building.walls.iter().zip(&run.walls).zip(&parts.walls);
    let rows =
        rows.map(|((wall, history), own)| (wall, history, yields(own), history.reported(own, &run.times)));
    let has_yielding_ties = parts.walls.iter().any(yields);
    let table = Table::over(rows)
        .text("", "wall", |(wall, ..)| wall.name.clone())
        .number("", "u [mm]", any, |(.., (peak, _))| at(*peak, 1000.0, 1))
        .number("", "u/u_ins", three, |(.., (_, [_, ratio]))| *ratio)
        .number("", "bottom force [kN]", any, |(_, history, ..)| at(history.reaction_bottom.peak, 1e-3, 2))
        .number("", "top force [kN]", any, |(wall, history, ..)| {
            wall.top.map(|_| at(history.reaction_top.peak, 1e-3, 2))
        })
        .text("", "overturned", |(_, history, ..)| demands::overturned(history.fate(&run.times), 3));
    if !has_yielding_ties {
        return table.done();
    }
    table
        .number("", "tie longer by [mm]", Digits::Decimals(1), |(_, history, yields, _)| {
            yields.then_some(1e3 * history.tie_elongation)
        })
        .text("", "tie", |(_, history, ..)| match history.tie_break_time {
            Some(time) => format!("broke at {time:.3} s"),
            None if history.tie_elongation > 0.0 => "yielded".to_owned(),
            None => String::new(),
        })
        .done()
}

/// Returns whether a wall has a tie that may yield.
fn yields(wall: &Wall) -> bool {
    wall.ties().iter().any(|tie| tie.ultimate.is_some())
}

/// Returns all histories: a row for each sample of the record, and on at its step.
pub fn histories(building: &Building, run: &Coupled) -> Table {
    let mut shown: Vec<(String, &History)> = vec![("ground.acceleration_m_s2".into(), &run.ground)];
    for (floor, history) in building.floors.iter().zip(&run.floors) {
        shown.push((format!("{}.acceleration_m_s2", floor.name), &history.acceleration));
        shown.push((format!("{}.drift_m", floor.name), &history.drift));
    }
    for (wall, history) in building.walls.iter().zip(&run.walls) {
        let name = &wall.name;
        shown.push((format!("{name}.u_m"), &history.displacement));
        shown.push((format!("{name}.u_ratio"), &history.ratio));
        shown.push((format!("{name}.reaction_bottom_n"), &history.reaction_bottom));
        if wall.top.is_some() {
            shown.push((format!("{name}.reaction_top_n"), &history.reaction_top));
        }
    }
    // a time is a multiple of the step, but for its rounding
    let time = |row: &usize| (1e9 * run.times[*row]).round() / 1e9;
    let table = Table::over(0..run.times.len()).value("time_s", time);
    let add = |table: Growing<usize>, (name, history): (String, &History)| {
        table.value(name, |row| history.values[*row])
    };
    shown.into_iter().fold(table, add).done()
}

/// Returns the peaks of floors and walls in SI units.
pub fn json(building: &Building, parts: &Parts, run: &Coupled) -> Value {
    let peak = |history: &History| json!({ "value": history.peak.value, "time": history.peak.time });
    let floors = building.floors.iter().zip(&run.floors).map(|(floor, history)| {
        let (acceleration, drift) = (peak(&history.acceleration), peak(&history.drift));
        json!({ "name": floor.name, "acceleration": acceleration, "drift": drift })
    });
    let walls = building.walls.iter().zip(&run.walls).zip(&parts.walls).map(|((wall, history), own)| {
        let (at, [u_max, ratio]) = history.reported(own, &run.times);
        json!({
            "name": wall.name,
            "u_max": u_max,
            "u_ratio": { "value": ratio.copysign(at.value), "time": at.time },
            "reaction_bottom": peak(&history.reaction_bottom),
            "reaction_top": peak(&history.reaction_top),
            "overturn_time": history.overturn_time,
            "falls": history.fate(&run.times).falls(),
            "tie_elongation": yields(own).then_some(history.tie_elongation),
            "tie_break_time": history.tie_break_time,
        })
    });
    json!({
        "title": building.title,
        "step": run.step,
        "change": run.change,
        "floors": floors.collect::<Vec<_>>(),
        "walls": walls.collect::<Vec<_>>(),
    })
}
