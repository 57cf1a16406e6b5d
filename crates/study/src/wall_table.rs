//! Tables of walls: CSV with a column `name` and one for each parameter that the walls do not leave at its
//! default. Thousands of walls take a tenth of the memory that they take as tables of a study file.

use std::path::Path;

use rocking_wall::scene::{KINEMATICS, Scene, SceneError, read_text, suggestion};
use rocking_wall::wall::Parameters;

use crate::document::wall_parameters;
use crate::ida::NamedWall;

/// Largest table that is read.
const MAX_FILE_BYTES: u64 = 256 << 20;

/// Reads the walls of a table. An empty cell leaves its parameter at the default.
pub(crate) fn read(path: &Path) -> Result<Vec<NamedWall>, SceneError> {
    let file = path.display().to_string();
    parse(&file, &read_text(path, "a table of walls (CSV)", MAX_FILE_BYTES)?)
}

/// Reads the walls from the text of a table; `file` stands for it in messages.
fn parse(file: &str, text: &str) -> Result<Vec<NamedWall>, SceneError> {
    let mut lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    let fail = |line: usize, message: String| SceneError::Line { file: file.to_owned(), line, message };
    let columns = lines.next().map(|(_, header)| cells(header)).unwrap_or_default();
    let Some(name_column) = columns.iter().position(|column| column == "name") else {
        let other = columns.iter().find(|column| !suggestion(column, ["name"]).is_empty());
        let meant = other.map_or_else(String::new, |other| format!(": did you mean \"name\" by {other:?}?"));
        return Err(fail(1, format!("a table of walls needs a column \"name\"{meant}")));
    };
    for column in columns.iter().filter(|column| *column != "name" && *column != KINEMATICS) {
        if !wall_parameters().any(|name| name == column) {
            let all: Vec<_> = wall_parameters().chain([KINEMATICS]).collect();
            let meant = suggestion(column, all.iter().copied());
            let known = all.join(", ");
            let message = format!("{column:?} is not a parameter of a wall of a study{meant}: {known}");
            return Err(fail(1, message));
        }
    }
    let mut walls = Vec::new();
    let mut scene = Scene::default();
    for (index, line) in lines.filter(|(_, line)| !line.trim().is_empty()) {
        let row = cells(line);
        if row.len() != columns.len() {
            let message = format!("expected {} cells, found {}", columns.len(), row.len());
            return Err(fail(index + 1, message));
        }
        scene.parameters = Parameters::default();
        let given = columns.iter().zip(&row).filter(|(column, cell)| *column != "name" && !cell.is_empty());
        for (column, cell) in given {
            scene.set(column, cell).map_err(|error| fail(index + 1, error.to_string()))?;
        }
        walls.push(NamedWall::new(row[name_column].clone(), scene.parameters.clone()));
    }
    Ok(walls)
}

/// Splits a line at its commas. A cell in quotes may contain some, and doubled quotes.
fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut is_quoted = false;
    let mut characters = line.chars().peekable();
    while let Some(character) = characters.next() {
        let Some(cell) = cells.last_mut() else { break };
        match character {
            '"' if is_quoted && characters.peek() == Some(&'"') => {
                characters.next();
                cell.push('"');
            }
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => cells.push(String::new()),
            _ => cell.push(character),
        }
    }
    cells.into_iter().map(|cell| cell.trim().to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn walls_of_a_table() {
        let text = "name, height,force_law\n\"a, \"\"b\"\"\",3.5,trilinear\n\nc,,\n";
        let walls = parse("walls.csv", text).unwrap();
        assert_eq!((walls.len(), walls[0].name.as_str()), (2, "a, \"b\""));
        assert_eq!(walls[0].parameters.height, 3.5);
        assert_eq!(walls[1].parameters, rocking_wall::wall::Parameters::default());
    }

    #[test]
    fn what_cannot_be_used_is_refused_with_its_line() {
        for (text, words) in [
            ("", "needs a column"),
            ("height\n3", "needs a column"),
            (
                "Name,Height\na,3",
                "line 1: a table of walls needs a column \"name\": did you mean \"name\" by",
            ),
            ("name,Height\na,3", "line 1: \"Height\" is not a parameter of a wall of a study (did you mean"),
            ("name,height\na,\"3,5\"", "line 2: height = 3,5: a number has a decimal point, not a comma"),
            ("name,xi\na,0.1", "line 1: \"xi\" is not a parameter"),
            ("name,height\na,3\nb,-3", "line 3: height"),
            ("name,height\na", "line 2: expected 2 cells, found 1"),
        ] {
            let error = parse("walls.csv", text).unwrap_err().to_string();
            assert!(error.starts_with("walls.csv") && error.contains(words), "{error}");
        }
    }
}
