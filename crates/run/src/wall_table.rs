//! Tables of walls: CSV with a column `name` and one for each parameter that the walls do not leave at its
//! default. A column `scene` names scene files; other cells of a row count over its scene. Thousands of walls
//! take a tenth of the memory that they take as tables of a study file.

use std::path::Path;

use files::{FileError, read_text};
use ground_motion::columns::{Columns, Fault, Name, Numbers, Thousands};
use scene::{Curve, KINEMATICS, Scene, SceneError};

use crate::named_wall::NamedWall;
use crate::wall_columns::{choice, column, key_of_check};
use crate::wall_parameters::{check_parameter, wall_parameters};

/// Largest table that is read.
const MAX_FILE_BYTES: u64 = 256 << 20;

/// The column of the walls' names.
const NAME: &str = "name";

/// The column of scene files, beside the table.
const SCENE: &str = "scene";

/// A scene and the parameters that its file states.
pub(crate) type Stated = (Scene, Vec<&'static str>);

/// What stands for no name, and what names summaries below the walls, in small letters.
const NO_NAMES: &str = "nan na n/a none null total sum mean average count std totale somma media";

/// Parameters that every wall of a table has if one has it.
const WITHOUT_GAPS: [&str; 3] = ["height", "thickness", "density"];

/// Reads the walls of a table with the capacity curves of their scenes. An empty cell leaves its parameter at
/// the default, but for [`WITHOUT_GAPS`]; a row without any content is skipped, and one with a name and no
/// value refused. `scene_of` reads a scene.
pub(crate) fn read(
    path: &Path,
    scene_of: &mut dyn FnMut(&Path) -> Result<Stated, SceneError>,
) -> Result<Vec<(NamedWall, Option<Curve>)>, FileError> {
    let (file, folder) = (path.display().to_string(), path.parent().unwrap_or(Path::new(".")));
    let text = read_text(path, "a table of walls (CSV)", MAX_FILE_BYTES)?;
    parse(&file, &text, &mut |scene| scene_of(&folder.join(scene)))
}

/// Reads the walls from the text of a table; `file` stands for it in messages.
fn parse(
    file: &str,
    text: &str,
    scene_of: &mut dyn FnMut(&str) -> Result<Stated, SceneError>,
) -> Result<Vec<(NamedWall, Option<Curve>)>, FileError> {
    let fail = |line: usize, message: String| FileError::on_line(file, line, message);
    let in_file = |fault: Fault| fail(fault.line(), fault.to_string());
    let in_column = |column: &str, fault: &Fault| fail(fault.line(), format!("{column}: {fault}"));
    let forms = "a table of walls: a line of names with a column `name`, and a row for each wall";
    let columns = Columns::of_texts(text.trim_start_matches('\u{feff}'), forms).map_err(in_file)?;
    let names: Vec<&str> = columns.names().iter().map(Name::written).map(column).collect();
    check_twice(&names).map_err(|message| fail(columns.line(), message))?;
    check_names(&names).map_err(|message| fail(columns.line(), message))?;
    let (mut walls, mut scene, mut numbers) = (Vec::new(), Scene::default(), Numbers::new(&columns));
    let mut thousands = vec![Thousands::default(); names.len()];
    for row in columns.rows() {
        let row = row.map_err(in_file)?;
        let (mut wall, mut check) = (None, Vec::new());
        let mut cells = names.iter().zip(row.cells()).filter(|(_, cell)| !cell.is_empty());
        let of_scene = cells.find(|(name, _)| **name == SCENE).map(|(_, file)| scene_of(&file)).transpose();
        let (of_scene, mut stated) =
            of_scene.map_err(|error| fail(row.line, format!("scene: {error}")))?.unwrap_or_default();
        (scene.parameters, scene.floors, scene.curve) =
            (of_scene.parameters, of_scene.floors, of_scene.curve);
        let cells = names.iter().zip(&mut thousands).zip(row.cells());
        for ((&column, thousands), cell) in
            cells.filter(|((name, _), cell)| !cell.is_empty() && **name != SCENE)
        {
            if column == NAME {
                wall = Some(cell.into_owned());
                continue;
            }
            if let Some(key) = key_of_check(column) {
                check.push((key, value_of_check(&cell)));
                continue;
            }
            stated.extend(wall_parameters().chain([KINEMATICS]).find(|name| *name == column));
            if cell.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '−' | '.' | ',')) {
                let number = numbers.real(&cell, row.line);
                let number = number.map_err(|fault| in_column(column, &fault))?;
                thousands.push(&cell, row.line);
                scene.set(column, &number.to_string()).map_err(|error| fail(row.line, error.to_string()))?;
            } else {
                scene.set(column, choice(&cell)).map_err(|error| fail(row.line, error.to_string()))?;
            }
        }
        let wall = named(wall, &names, &stated).map_err(|message| fail(row.line, message))?;
        let (parameters, floors) = (scene.parameters.clone(), scene.floors.take());
        let wall = NamedWall::new(wall, parameters).stating(stated);
        walls.push((NamedWall { floors, check, ..wall }, scene.curve.take()));
    }
    for (column, thousands) in names.iter().zip(thousands) {
        thousands.check().map_err(|fault| in_column(column, &fault))?;
    }
    if walls.is_empty() {
        return Err(fail(
            columns.line(),
            "the table has no walls; write a row for each below this line".to_owned(),
        ));
    }
    Ok(walls)
}

/// Returns the name of a wall, whose row states these parameters.
///
/// # Errors
/// A row without a name, without a value, or with a gap that no default may fill.
fn named(wall: Option<String>, columns: &[&str], stated: &[&str]) -> Result<String, String> {
    let wall = wall.filter(|name| !NO_NAMES.split(' ').any(|none| name.eq_ignore_ascii_case(none)));
    let Some(wall) = wall else {
        return Err("the wall has no name, or one of a gap or a summary, such as `nan` and `mean`; write \
                    another in the column `name`, or delete the row"
            .to_owned());
    };
    if stated.is_empty() && columns.len() > 1 {
        return Err("the wall has a name and no value; write one in a column, or delete the row".to_owned());
    }
    match WITHOUT_GAPS.into_iter().find(|name| columns.contains(name) && !stated.contains(name)) {
        Some(gap) => {
            Err(format!("the wall {wall:?} has no {gap}; write it, or delete the row or the column"))
        }
        None => Ok(wall),
    }
}

/// What a cell states of the check, as TOML has it: a number with a point, or a choice.
fn value_of_check(cell: &str) -> String {
    let number = cell.replacen(',', ".", 1);
    match number.parse::<f64>() {
        Ok(_) => number,
        Err(_) => choice(cell).to_owned(),
    }
}

/// Refuses a name and its Italian in one table.
fn check_twice(names: &[&str]) -> Result<(), String> {
    let twice = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name));
    twice.map_or(Ok(()), |(_, name)| Err(format!("two columns state {name}; delete one")))
}

/// Refuses columns that are neither parameters nor read by a check, and a table without names of walls.
fn check_names(names: &[&str]) -> Result<(), String> {
    let of_wall = names.iter().filter(|name| key_of_check(name).is_none());
    of_wall.copied().try_for_each(|column| check_parameter(column, &[KINEMATICS, NAME, SCENE]))?;
    if names.contains(&NAME) { Ok(()) } else { Err("a table of walls needs a column \"name\"".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::{FileError, NamedWall, Scene};

    fn parse(file: &str, text: &str) -> Result<Vec<NamedWall>, FileError> {
        let scene_of = &mut |scene: &str| Ok((Scene::read(scene.as_ref())?, vec!["height"]));
        Ok(super::parse(file, text, scene_of)?.into_iter().map(|(wall, _)| wall).collect())
    }

    #[test]
    fn walls_of_a_table() {
        let text = "name, height,force_law\n\"a, \"\"b\"\"\",3.5,trilinear\n\nc,3.6,\n";
        let walls = parse("walls.csv", text).unwrap();
        assert_eq!((walls.len(), walls[0].name.as_str()), (2, "a, \"b\""));
        assert_eq!(walls[0].parameters.height, 3.5);
        let default = rocking_wall::wall::Parameters::default();
        assert_eq!(walls[1].parameters, rocking_wall::wall::Parameters { height: 3.6, ..default.clone() });
        // a table of names only has walls of the default
        assert_eq!(parse("walls.csv", "name\na\n").unwrap()[0].parameters, default);
    }

    #[test]
    fn tables_are_read_as_people_have_them() {
        let of = |text: &str| -> Vec<(String, f64, f64)> {
            let walls = parse("walls.csv", text).unwrap_or_else(|error| panic!("{text}: {error}"));
            let sizes = |p: &rocking_wall::wall::Parameters| (p.height, p.thickness);
            walls
                .iter()
                .map(|wall| (wall.name.clone(), wall.parameters.clone()))
                .map(|(name, p)| (name, sizes(&p).0, sizes(&p).1))
                .collect()
        };
        let expected = of("name,height,thickness\na,2.0,0.3\nb,3.0,0.25\n");
        assert_eq!(expected, [("a".to_owned(), 2.0, 0.3), ("b".to_owned(), 3.0, 0.25)]);
        for text in [
            "\u{feff}name;height;thickness\r\na;2,0;0,3\r\nb;3,0;0,25\r\n",
            "name\theight\tthickness\na\t2,0\t0,3\nb\t3,0\t0,25\n",
            "name height thickness\na 2.0 0.3\nb 3.0 0.25\n",
            "name,height,thickness\ra,2.0,0.3\rb,3.0,0.25\r",
            "\"name\",\"height\",\"thickness\"\n\"a\",\"2,0\",\"0,3\"\n\"b\",\"3,0\",\"0,25\"\n",
            "sep=;\n# of the north side\nname;height;thickness;\na;2;3D-1;\n;;\n\n% half\nb;3;0.25;\n;;;\n",
            ",,\n\n , ,\nname,height,thickness\na,2.0,0.3\nb,3.0,0.25\n",
            "name,height,thickness\na,2.0,0.3\n\n,,\nb,3.0,0.25\n , ,\n",
        ] {
            assert_eq!(of(text), expected, "{text}");
        }
        // a tab stands for an empty cell, too
        assert_eq!(of("name\ta1\theight\tthickness\na\t\t2\t0.3\n")[0].2, 0.3);
    }

    #[test]
    fn headers_may_be_italian_and_rows_state_their_check() {
        let text = "Parete;Meccanismo;Altezza;Spessore;Quota relativa;Cerniera;prima dell'attivazione\n\
                    P1;flessione verticale;3,4;0,4;0,83;più sfavorevole;legge\n\
                    P2;parapetto;1,2;0,3;1;;rigida\n";
        let walls = parse("walls.csv", text).unwrap();
        let stated = |index: usize| -> Vec<(&str, &str)> {
            walls[index].check.iter().map(|(key, value)| (*key, value.as_str())).collect()
        };
        assert_eq!((walls[0].name.as_str(), walls[0].parameters.height), ("P1", 3.4));
        let ratio = ("building.height_ratio", "0.83");
        assert_eq!(stated(0), [ratio, ("hinge", "worst"), ("before_activation", "law")]);
        assert_eq!(stated(1), [("building.height_ratio", "1"), ("before_activation", "rigid")]);
        let error = parse("walls.csv", "name;altezza;height\na;3;3\n").unwrap_err().to_string();
        assert!(error.contains("two columns state height; delete one"), "{error}");
    }

    #[test]
    fn what_cannot_be_used_is_refused_with_its_line() {
        for (text, words) in [
            ("", "a column `name`"),
            ("height\n3", "needs a column"),
            ("name,height\n", "line 1: the table has no walls"),
            ("name,height\n,\n", "line 1: the table has no walls"),
            ("name,height,a1\na,3,\nb,,\n", "line 3: the wall has a name and no value"),
            ("name,height,thickness\na,3,.3\nb,3,\n", "line 3: the wall \"b\" has no thickness; write it"),
            ("name,height,density\na,3,\n", "line 2: the wall \"a\" has no density; write it"),
            ("name;height;a1\na;;0,1\n", "line 2: the wall \"a\" has no height; write it"),
            (
                ",name,height\n0,a,3\n",
                "delete the first column, an index without a name (pandas: index=False)",
            ),
            ("name|height\na|3\n", "line 1: expected columns between commas, semicolons, tabs or blanks"),
            ("name,height\na,\u{2212}3\n", "write minus signs as `-`"),
            ("name,impact\na,none", "line 1: \"impact\" is not a parameter"),
            ("name,xi\na,11", "line 2: xi"),
            ("name,height\na,3\nb,-3", "line 3: height"),
            ("name,height\na", "line 2: expected one value for each column, 2 in all, found 1"),
            (
                "Name,height\na,3",
                "line 1: \"Name\" is not a parameter of a wall of a study (did you mean \"name\"?)",
            ),
            ("name,height [m]\na,3", "line 1: \"height [m]\""),
            ("name,height [m]\na,3", "(did you mean \"height\"?); write one of these alone"),
            ("name,height,height\na,3,4", "line 1: expected columns with names of their own"),
            ("name,height,height\na,3,4", "found two columns `height`"),
            ("name,height\na,3\n,4", "line 3: the wall has no name"),
            ("name,height\nnan,", "line 2: the wall has no name"),
            ("name,height\na,nan", "line 2: height"),
            ("name,height\na,3 m", "line 2: height: expected a finite number, found `3 m`"),
            ("name;height\na;1,2\nb;1.2", "line 3: height: expected `,` before the decimals, as on line 2"),
            (
                "name;overburden\na;931\nb;1.053\nc;850\nd;900\n",
                "line 3: overburden: expected numbers without marks between thousands, found `1.053`",
            ),
            ("// walls\nname,height\na,3", "comments start with # or %"),
            ("name,height\n#1,3", "line 2: expected a row or a comment, found `#1,3`"),
        ] {
            let error = parse("walls.csv", text).unwrap_err().to_string();
            assert!(error.starts_with("walls.csv") && error.contains(words), "{error}");
        }
    }
}
