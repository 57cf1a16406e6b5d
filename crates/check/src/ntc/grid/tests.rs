//! Grids by hand.

use super::*;

/// Nodes of a mesh that is turned a little, with `a_g` linear over the place at 30 years, and four times
/// that at 480.
fn grid(turn: f64) -> String {
    let mut text = "id;LON;lat;ag_30;F0_30;TC*_30;ag_480;F0_480;TC*_480\n".to_owned();
    for (i, j) in (0..5).flat_map(|i| (0..4).map(move |j| (f64::from(i), f64::from(j)))) {
        let (lon, lat) = (13.0 + 0.05 * (i - turn * j), 42.0 + 0.05 * (j + turn * i));
        let ag = ag(lon, lat);
        text += &format!("{i}{j};{lon};{lat};{ag};2.4;0.3;{};2.6;0.36\n", 4.0 * ag).replace('.', ",");
    }
    text
}

fn ag(lon: f64, lat: f64) -> f64 {
    0.1 * (1.0 + lon / 10.0 + lat / 100.0) / 3.0
}

fn at(turn: f64, site: [f64; 2]) -> Result<SiteHazard, String> {
    Grid::read(&grid(turn), 1.0).unwrap().at(site)
}

/// By hand: at the middle of a cell every node counts alike, and 120 years are half way between 30 and
/// 480 by their logarithms, so that `a_g` doubles, F0 is √(2.4 · 2.6) and
/// `T_C`* √(0.3 · 0.36).
#[test]
fn means_between_nodes_and_periods() {
    for turn in [0.0, 0.03, -0.03] {
        let middle = [1.5, 2.5];
        let lon = 13.0 + 0.05 * (middle[1] - turn * middle[0]);
        let lat = 42.0 + 0.05 * (middle[0] + turn * middle[1]);
        let found = at(turn, [lat, lon]).unwrap();
        assert_eq!(found.nodes.len(), 4);
        let Hazard { ag: found_ag, f0, tc } = found.hazard(120.0);
        // a_g is linear, and the nodes are as far in pairs; the cosine of each latitude is left out
        assert!((found_ag / (2.0 * ag(lon, lat)) - 1.0).abs() < 1e-4, "{found_ag}");
        assert!((f0 - (2.4_f64 * 2.6).sqrt()).abs() < 1e-12 && (tc - 0.108_f64.sqrt()).abs() < 1e-12);
        for (period, ag_of) in [(30.0, 1.0), (10.0, 1.0), (480.0, 4.0), (2475.0, 4.0)] {
            assert!((found.hazard(period).ag / found.hazard(30.0).ag / ag_of - 1.0).abs() < 1e-12);
        }
    }
}

/// At 0.3 and 0.4 of the sides the shares are those of 1/d.
#[test]
fn near_nodes_count_more() {
    let (x, y) = (0.3 * 0.05, 0.4 * 0.05);
    let found = at(0.0, [42.05 + y, 13.1 + x]).unwrap();
    let shrink = (42.05_f64 + y).to_radians().cos();
    let distance = |dx: f64, dy: f64| ((dx * shrink).powi(2) + dy * dy).sqrt();
    let corners = [(0.0, 0.0), (0.05, 0.0), (0.05, 0.05), (0.0, 0.05)];
    let weights = corners.map(|(dx, dy)| 1.0 / distance(x - dx, y - dy));
    let mean: f64 =
        corners.iter().zip(weights).map(|((dx, dy), w)| w * ag(13.1 + dx, 42.05 + dy)).sum::<f64>();
    let wanted = mean / weights.iter().sum::<f64>();
    assert!((found.hazard(30.0).ag / wanted - 1.0).abs() < 1e-12);
    // at a node it is that node
    let node = at(0.0, [42.05, 13.1]).unwrap();
    assert_eq!((node.nodes.len(), node.hazard(30.0).ag), (1, ag(13.1, 42.05)));
}

#[test]
fn every_place_inside_has_its_cell() {
    for turn in [0.0, 0.03, -0.05] {
        for k in 0..400 {
            let (i, j) = (0.1 + 3.8 * f64::from(k % 20) / 19.0, 0.1 + 2.8 * f64::from(k / 20) / 19.0);
            let site = [42.0 + 0.05 * (j + turn * i), 13.0 + 0.05 * (i - turn * j)];
            let found = at(turn, site).unwrap_or_else(|error| panic!("{i} {j}: {error}"));
            let nodes = found.nodes.len();
            assert!(nodes == 4 || nodes == 1, "{i} {j}");
        }
        for site in [[41.9, 13.1], [42.1, 12.9], [42.3, 13.1], [42.1, 13.4]] {
            let told = at(turn, site).unwrap_err();
            assert!(told.contains("in no cell of the grid; the nearest node is at lon"), "{told}");
        }
    }
}

#[test]
fn grids_that_cannot_be_are_refused_with_their_line() {
    let text = "lon,lat,ag_30,F0_30,TC_30,ag_475,F0_475,TC_475\n13,42,0.5,2.4,0.3,1.9,2.5,0.3\n";
    for (text, line, words) in [
        (text.to_owned(), 2, "a_g = 1.9 g is above 1.5 g; state the unit"),
        (text.replace("lat", "phi"), 1, "no column \"lat\""),
        (text.replace("_475", "_475y"), 1, "column ag_475y: \"475y\" is no return period in years"),
        (text.replace("F0_475", "F0"), 1, "no column \"f0_475\""),
        (text.replace("ag_475", "peak"), 1, "for two return periods in years or more"),
        (text.replace("_475", "_030"), 1, "columns ag_30 and ag_030 have the same return period"),
        (text.replace("1.9,2.5", "0.9,0"), 2, "must be above 0"),
        (text.replace("1.9", "x"), 2, "a finite number"),
        (text.replace("1.9", "1").clone() + "13,42,0.5,2.4,0.3,1,2.5,0.3\n", 3, "a second node"),
    ] {
        let (found, told) = Grid::read(&text, 1.0).unwrap_err();
        assert!(found == line && told.contains(words), "{found} {told}");
    }
    let grid = Grid::read(text, 0.1).unwrap();
    // the heads of the ministry
    let heads = ";;TR = 30;;;TR = 475;;\nLON;LAT;ag;Fo;TC*;ag;Fo;TC*\n";
    let ministry = heads.to_owned() + &text.lines().nth(1).unwrap().replace(',', ";").replace('.', ",");
    assert_eq!(Grid::read(&ministry, 0.1), Ok(grid.clone()));
    assert_eq!(Grid::read(&text.replace("F0", "Fo").replace("TC", "Tc*"), 0.1), Ok(grid.clone()));
    assert_eq!(Grid::read(&text.replace("F0", "Fo").replace('_', ""), 0.1), Ok(grid.clone()));
    let (line, told) = Grid::read(&ministry.replace("2,4", "x"), 0.1).unwrap_err();
    assert!(line == 3 && told.contains("found `x`"), "{line} {told}");
    // periods are found as they are written
    let others = text.replace("_30", "_030").replace("_475", "_475.0");
    assert_eq!(Grid::read(&others, 0.1), Ok(grid));
}
