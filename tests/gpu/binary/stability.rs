//! Do `umber eval` and `umber stability` take, give and refuse what they promise?

use serde_json::Value;

use super::{Place, Tested};

/// A head, a comment and two inputs; seen along the normal, F is f0.
const INPUTS: &str = "nx,ny,nz,lx,ly,lz,ex,ey,ez,roughness,f0\n\
    # straight on\n\
    0,1,0, 0,1,0, 0,1,0, 0.5, 0.25\n\
    0,1,0, 0,1,0, 0,1,0, 0.5, 0.75\n";

#[test]
fn eval_answers_line_by_line() -> Tested {
    let place = Place::empty()?;
    place.write("in.csv", INPUTS)?;
    let arguments = ["eval", "schlick-f", "--validation", "--input", "in.csv"];
    let run = place.umber(&arguments)?.ends(0, &[]);
    let lines = String::from_utf8(run.stdout)?;
    assert_eq!(lines, "schlick-f\n2.5e-1\n7.5e-1\n");
    Ok(())
}

#[test]
fn eval_takes_and_gives_bytes() -> Tested {
    let place = Place::empty()?;
    let numbers = [0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.5, 0.25_f32];
    let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
    std::fs::write(place.path("in.bin"), &bytes)?;
    let arguments = ["eval", "schlick-f", "--binary", "--input", "in.bin"];
    let to_file = [&arguments[..], &["--output", "out.bin"]].concat();
    place.umber(&to_file)?.ends(0, &[]);
    assert_eq!(
        std::fs::read(place.path("out.bin"))?,
        0.25_f32.to_le_bytes()
    );
    std::fs::write(place.path("in.bin"), &bytes[1..])?;
    place.umber(&to_file)?.ends(6, &["in.bin", "43 bytes"]);
    Ok(())
}

#[test]
fn eval_refuses_what_it_cannot_take() -> Tested {
    let place = Place::empty()?;
    place.write("in.csv", INPUTS)?;
    place.write("bad.csv", "0,1,0\n")?;
    let eval = |rest: &[&str]| place.umber(&[&["eval"], rest].concat());
    eval(&["oren-nayer", "--input", "in.csv"])?.ends(2, &["'oren-nayar'"]);
    eval(&["oren-nayar", "--tier", "f32-comp"])?.ends(2, &["tier"]);
    let same = [
        "schlick-f",
        "--tier",
        "f32-compensated",
        "--input",
        "in.csv",
    ];
    eval(&same)?.ends(2, &["no dot product"]);
    let narrow = ["cook-torrance", "--tier", "f16", "--input", "in.csv"];
    eval(&narrow)?.ends(2, &["16 bits", "0.05"]);
    eval(&["oren-nayar", "--input", "bad.csv"])?.ends(6, &["bad.csv", "line 1"]);
    eval(&["oren-nayar", "--input", "none.csv"])?.ends(6, &["none.csv"]);
    let onto_itself = ["oren-nayar", "--input", "in.csv", "--output", "in.csv"];
    eval(&onto_itself)?.ends(2, &["overwritten"]);
    eval(&[])?.ends(2, &["FUNCTION"]);
    assert_eq!(std::fs::read_to_string(place.path("in.csv"))?, INPUTS);
    eval(&["--list"])?.ends(0, &["oren-nayar", "f32-compensated", "1/pi"]);
    Ok(())
}

#[test]
fn a_small_run_reports_by_its_layout() -> Tested {
    let place = Place::empty()?;
    let run = place
        .umber(&[
            "stability",
            "--validation",
            "--quiet",
            "--function",
            "oren-nayar,slides-oren-nayar",
            "--case",
            "generic,all-on-normal",
            "--inputs",
            "500",
            "--json",
        ])?
        .ends(0, &[]);
    let report: Value = serde_json::from_slice(&run.stdout)?;
    assert_eq!(report["schema"], "umber.stability/1");
    assert_eq!(
        (&report["plan"], &report["evaluations"]),
        (&"custom".into(), &4000.into())
    );
    let rows = report["rows"].as_array().ok_or("rows")?;
    assert_eq!(rows.len(), 8);
    for row in rows {
        assert_eq!(row["inputs"], 500);
        let counts = ["nan", "inf", "negative", "judged"].map(|key| row[key].as_u64());
        assert!(counts.iter().all(Option::is_some), "{row}");
        assert!(row["worst_input"].is_string(), "{row}");
    }
    let broken = |row: &&Value| row["nan"] != 0;
    let broken: Vec<_> = rows.iter().filter(broken).collect();
    assert_eq!(broken.len(), 1);
    assert_eq!(broken[0]["function"], "slides-oren-nayar");
    Ok(())
}

#[test]
fn stability_refuses_unknown_names_and_lists_known_ones() -> Tested {
    let place = Place::empty()?;
    let stability = |rest: &[&str]| place.umber(&[&["stability"], rest].concat());
    stability(&["--function", "cook-torance"])?.ends(2, &["'cook-torrance'"]);
    stability(&["--case", "headlights"])?.ends(2, &["'headlight'"]);
    stability(&["--quick", "--full"])?.ends(2, &["--full"]);
    stability(&["--list"])?.ends(0, &["light-opposite-eye", "pbrt-v4 #283"]);
    Ok(())
}

#[test]
fn a_report_is_read_again_and_set_beside_another() -> Tested {
    let place = Place::empty()?;
    let made = |name: &str, case: &str| {
        let json = format!("--json={name}");
        let fixed = ["stability", "--quiet", "--function", "slides-oren-nayar"];
        let own = ["--inputs", "500", "--case", case, &json];
        place.umber(&[&fixed[..], &own].concat())
    };
    made("one.json", "generic")?.ends(0, &[]);
    made("two.json", "all-on-normal")?.ends(0, &[]);
    let read = |rest: &[&str]| place.umber(&[&["stability", "--read", "one.json"], rest].concat());
    let run = read(&["--beside", "two.json", "--report", "page.html"])?.ends(0, &[]);
    let table = String::from_utf8(run.stdout)?;
    let beside = table
        .split_once("here: ")
        .ok_or("nothing is told of the other")?
        .1;
    let nan = |whose: &str| {
        let line = beside.lines().find(|line| line.starts_with(whose))?;
        line.split_whitespace().nth(3)
    };
    assert_eq!(nan("here   "), Some("0"), "{table}");
    assert_ne!(
        nan("there  ").ok_or("no line of the other")?,
        "0",
        "{table}"
    );
    let page = std::fs::read_to_string(place.path("page.html"))?;
    assert!(page.contains("Beside another report"));
    read(&["--json=again.json", "--beside", "one.json"])?.ends(0, &["both have, 0 have"]);
    let bytes = |name: &str| std::fs::read(place.path(name));
    assert_eq!(bytes("one.json")?, bytes("again.json")?);
    // Nothing that is read is overwritten.
    read(&["--json=one.json"])?.ends(2, &["one.json", "overwritten"]);
    read(&["--beside", "two.json", "--report", "two.json"])?.ends(2, &["two.json"]);
    read(&["--full"])?.ends(2, &["--full"]);
    place.write("text.json", "no report")?;
    read(&["--beside", "text.json"])?.ends(6, &["text.json", "no JSON"]);
    read(&["--beside", "absent.json"])?.ends(6, &["absent.json"]);
    Ok(())
}
