//! Does the exit code stay that of the work when nobody can hear what is said?

use super::{Place, Tested};

/// Arguments of the program, and the code that it ends with.
const RUNS: &[(&str, i32)] = &[
    ("render --validation scene.toml --size 8x8", 0),
    ("render --validation scene.toml --size 8x8 --json=a.json", 0),
    ("render scene.toml --size 0x0", 2),
    ("render scene.toml --colour", 2),
    ("render scene.toml --device voodoo", 3),
    ("render nowhere.toml", 6),
    ("devices", 0),
    ("doctor", 0),
    ("--help", 0),
];

#[test]
fn a_stderr_that_is_closed_or_full_changes_no_exit_code() -> Tested {
    let place = Place::new()?;
    place.write(
        "absent.obj",
        "mtllib absent.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    )?;
    let warned = ("render --validation absent.obj --size 8x8", 0);
    for stderr in ["2>&-", "2>/dev/full"] {
        for (arguments, code) in RUNS.iter().chain([&warned]) {
            place
                .shell(&format!("exec \"$UMBER\" {arguments} {stderr}"))?
                .ends(*code, &[]);
        }
    }
    // A reader that has gone away.
    for (arguments, code) in RUNS.iter().chain([&warned]) {
        let script = format!("(\"$UMBER\" {arguments} 2>&3; echo $? >code) 3>&1 >out | true");
        place.shell(&script)?;
        let found = std::fs::read_to_string(place.path("code"))?;
        assert_eq!(found.trim(), code.to_string(), "{arguments}");
    }
    Ok(())
}

#[test]
fn data_that_stdout_does_not_take_ends_with_6() -> Tested {
    let place = Place::new()?;
    for arguments in [
        "render --validation scene.toml --size 8x8 --json",
        "render --validation scene.toml --size 8x8 --output -",
        "devices",
        "devices --json",
        "doctor",
        "completions bash",
    ] {
        let run = place.shell(&format!("exec \"$UMBER\" {arguments} >/dev/full"))?;
        run.ends(6, &["stdout", "No space"]);
    }
    Ok(())
}

#[test]
fn a_reader_that_has_read_enough_is_no_failure() -> Tested {
    let place = Place::new()?;
    for arguments in [
        "render --validation scene.toml --size 8x8 --json",
        "render --validation scene.toml --size 8x8 --output -",
        "devices",
        "doctor",
        "completions bash",
        "--help",
    ] {
        let script = format!("(\"$UMBER\" {arguments}; echo $? >code) | true");
        let run = place.shell(&script)?;
        let code = std::fs::read_to_string(place.path("code"))?;
        assert_eq!(code.trim(), "0", "{arguments}: {}", run.stderr);
    }
    Ok(())
}
