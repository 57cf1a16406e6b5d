//! Tests studies whose records are run with other signs, or once each: the same bytes for threads, shards and
//! interruptions, and what their tables have.

use std::fs;
use std::path::PathBuf;

use crate::command_line::{assert_has, content, fails, folder, printed, succeed};
use crate::ida::bytes;

/// A wall that rocks to one side, and one that is alike on both.
const STUDY: &str = r#"
models = ["CR"]
polarity = "POLARITY"
intensity = { measure = "Arias" }
levels = LEVELS
records = { synthetic = { count = 6, duration = 10, step = 0.01 } }
report = { fractions = [0.4, 1.0], resamples = 100 }

[[walls]]
name = "two-sided"
geometry = { height = 3, thickness = 0.3 }

[[walls]]
name = "one-sided"
geometry = { height = 3, thickness = 0.3 }
impact = { rocking = "one_sided_positive", restitution = 0.6 }
"#;

fn study(name: &str, polarity: &str, levels: &str) -> PathBuf {
    let folder = folder(name);
    let text = STUDY.replace("POLARITY", polarity).replace("LEVELS", levels);
    fs::write(folder.join("study.toml"), text).unwrap();
    folder
}

const GRID: &str = "{ method = \"grid\", values = [0.02, 0.1, 0.4, 1] }";
const CLOUD: &str = "{ method = \"cloud\", scale = 0.4 }";

#[test]
fn signs_and_clouds_have_the_same_bytes_by_any_way() {
    for (name, polarity, levels, rows) in [
        ("signs_both", "both", GRID, 2 * 12 * 4),
        ("signs_worst", "worst", GRID, 2 * 6 * 4),
        ("signs_reversed", "reversed", GRID, 2 * 6 * 4),
        ("signs_cloud", "worst", CLOUD, 2 * 6),
    ] {
        let folder = study(name, polarity, levels);
        succeed(&folder, &["study", "ida", "study.toml", "-o", "one", "--threads", "1"]);
        let whole = bytes(&folder.join("one"));
        assert_eq!(content(&folder, "one/levels.csv").lines().count(), rows + 1, "{name}");
        for shard in ["1/2", "2/2"] {
            let own = format!("shard{}", &shard[..1]);
            succeed(&folder, &["study", "ida", "study.toml", "--shard", shard, "-o", &own]);
        }
        succeed(&folder, &["study", "merge", "shard1", "shard2", "-o", "merged"]);
        assert!(bytes(&folder.join("merged")) == whole, "{name}: shards");
        // continued where a part is lost
        fs::remove_file(folder.join("merged/runs/0000/0000001.parquet")).unwrap();
        succeed(&folder, &["study", "ida", "study.toml", "-o", "merged", "--threads", "2"]);
        assert!(bytes(&folder.join("merged")) == whole, "{name}: resumed");
        let said = if polarity == "worst" { "demands more" } else { "reversed" };
        assert!(content(&folder, "one/study.html").contains(said), "{name}");
        // another sign is another study
        let other = content(&folder, "study.toml").replace(polarity, "as_recorded");
        fs::write(folder.join("study.toml"), other).unwrap();
        fails(
            &folder,
            &["study", "ida", "study.toml", "-o", "one"],
            &["holds results of another study", "polarity"],
        );
    }
}

/// A cloud has its regression as a table and on the page, and says what it does not know.
#[test]
fn a_cloud_shows_its_regression() {
    let folder = study("signs_regression", "as_recorded", CLOUD);
    let told = printed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    assert_has(&told, &["collapse Arias in m/s", "cloud.csv"]);
    let cloud = content(&folder, "out/cloud.csv");
    let names = "wall,model,records,collapsed,still,a,b,sigma";
    assert_eq!((cloud.lines().next(), cloud.lines().count()), (Some(names), 3));
    let page = content(&folder, "out/study.html");
    assert_has(&page, &["Clouds, with their regressions", "Tobin", "Arias (m/s)", "<h3>Regression"]);
    // every wall overturns
    let folder = study("signs_fallen", "as_recorded", "{ method = \"cloud\", scale = 50 }");
    let told = printed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    assert_has(&told, &["lacks 2 functions"]);
    assert!(content(&folder, "out/cloud.csv").lines().skip(1).all(|row| row.ends_with(",6,6,0,,,")));
    let message = "fewer than three walls stand";
    assert!(content(&folder, "out/study.html").contains(message));
}

#[test]
fn signs_without_effect_are_warned_of() {
    let folder = study("signs_alike", "both", GRID);
    let text = content(&folder, "study.toml");
    let (alike, _) = text.split_once("\n[[walls]]\nname = \"one-sided\"").unwrap();
    fs::write(folder.join("study.toml"), alike).unwrap();
    let told = succeed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    let told = String::from_utf8(told.stderr).unwrap();
    assert_has(&told, &["polarity = \"both\": both sides of every wall are alike"]);
}
