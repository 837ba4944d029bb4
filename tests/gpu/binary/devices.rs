//! Do `devices`, `doctor` and `completions` say what is here, and what is missing?

use std::process::Command;

use serde_json::Value;

use super::{Place, Run, Tested, UMBER};

#[test]
fn help_version_and_completions_go_to_stdout() -> Tested {
    let place = Place::empty()?;
    let cases: [(&[&str], &str); 4] = [
        (&["--help"], "Exit codes"),
        (&["render", "--help"], "--lighting"),
        (&["--version"], concat!("umber ", env!("CARGO_PKG_VERSION"))),
        (&["completions", "bash"], "_umber"),
    ];
    for (arguments, expected) in cases {
        let run = place.umber(arguments)?.ends(0, &[expected]);
        assert_eq!(run.stderr, "", "{arguments:?}");
    }
    for shell in ["zsh", "fish", "powershell", "elvish"] {
        let run = place.umber(&["completions", shell])?.ends(0, &["umber"]);
        assert!(run.stdout.len() > 1000, "{shell}");
    }
    assert!(place.names()?.is_empty());
    Ok(())
}

#[test]
fn devices_are_listed_as_text_and_as_json() -> Tested {
    let place = Place::empty()?;
    let text = place.umber(&["devices"])?.ends(0, &["uuid", "Vulkan 1."]);
    let text = String::from_utf8(text.stdout)?;
    let printed = place.umber(&["devices", "--json"])?.ends(0, &[]).stdout;
    place
        .umber(&["devices", "--json=list.json"])?
        .ends(0, &[])
        .stdout
        .is_empty()
        .then_some(())
        .ok_or("with a file, stdout is left alone")?;
    let dash = place.umber(&["devices", "--json=-"])?.ends(0, &[]).stdout;
    assert_eq!(printed, std::fs::read(place.path("list.json"))?);
    assert_eq!(printed, dash);
    assert_eq!(place.names()?, ["list.json"]);
    let report: Value = serde_json::from_slice(&printed)?;
    assert_eq!(report["schema"], "umber.devices/1");
    let devices = report["devices"].as_array().ok_or("a list")?;
    for (device, index) in devices.iter().zip(0..) {
        assert_eq!(device["index"], index);
        assert!(device["missing"].is_array());
        for key in ["name", "type", "driver", "driver_version", "api", "uuid"] {
            let value = device[key].as_str().ok_or(key)?;
            assert!(text.contains(value), "{key} {value}: {text}");
        }
    }
    assert!(!devices.is_empty());
    Ok(())
}

#[test]
fn a_list_that_cannot_be_written_ends_with_6() -> Tested {
    let place = Place::empty()?;
    let run = place.umber(&["devices", "--json=missing/list.json"])?;
    let run = run.ends(6, &["missing/list.json"]);
    assert!(!run.stderr.contains(".umber-"), "{}", run.stderr);
    assert!(place.names()?.is_empty());
    Ok(())
}

#[test]
fn the_doctor_finds_all_that_a_render_needs() -> Tested {
    let place = Place::empty()?;
    let devices: Value =
        serde_json::from_slice(&place.umber(&["devices", "--json"])?.ends(0, &[]).stdout)?;
    let name = devices["devices"][0]["name"].as_str().ok_or("a name")?;
    let expected = ["loader: found", "validation: ", name, "all is here"];
    let run = place.umber(&["doctor"])?.ends(0, &expected);
    assert_eq!(run.stderr, "", "findings are data");
    Ok(())
}

/// The program, where the loader finds no driver.
fn without_driver(place: &Place) -> Command {
    let mut command = place.command(UMBER);
    command
        .env("VK_DRIVER_FILES", "/nowhere.json")
        .env("VK_ICD_FILENAMES", "/nowhere.json");
    command
}

#[test]
fn without_a_driver_each_verb_ends_with_3_and_the_line_that_installs_one() -> Tested {
    let place = Place::new()?;
    let verbs: [&[&str]; 5] = [
        &["render", "scene.toml"],
        &["render", "scene.toml", "--validation"],
        &["devices"],
        &["devices", "--json=list.json"],
        &["doctor"],
    ];
    for arguments in verbs {
        let output = without_driver(&place).args(arguments).output()?;
        Run::of(&format!("{arguments:?}"), &output).ends(3, &["mesa-vulkan-drivers"]);
        assert_eq!(place.names()?, ["scene.toml"], "{arguments:?}");
    }
    let output = without_driver(&place).arg("doctor").output()?;
    Run::of("doctor", &output).ends(3, &["VK_DRIVER_FILES=/nowhere.json"]);
    Ok(())
}

/// A library of the loader's name that is none stands in for a system without one.
#[test]
#[cfg(target_os = "linux")]
fn without_a_loader_each_verb_ends_with_3_and_says_so() -> Tested {
    let place = Place::new()?;
    place.write("libvulkan.so.1", "not a library")?;
    for arguments in [&["render", "scene.toml"][..], &["devices"], &["doctor"]] {
        let mut command = place.command(UMBER);
        command.args(arguments);
        let output = command
            .env("LD_LIBRARY_PATH", place.folder.path())
            .output()?;
        let words = ["no Vulkan loader", "mesa-vulkan-drivers"];
        Run::of(&format!("{arguments:?}"), &output).ends(3, &words);
    }
    assert_eq!(place.names()?, ["libvulkan.so.1", "scene.toml"]);
    Ok(())
}

#[test]
fn without_the_validation_layer_a_validated_render_ends_with_3() -> Tested {
    let place = Place::new()?;
    let without_layer = |arguments: &[&str]| {
        let mut command = place.command(UMBER);
        command.args(arguments).env("VK_LAYER_PATH", "/nowhere");
        command.output()
    };
    let output = without_layer(&["render", "scene.toml", "--validation"])?;
    Run::of("render", &output).ends(3, &["vulkan-validationlayers"]);
    assert_eq!(place.names()?, ["scene.toml"]);
    // The doctor tells, and a render without validation does not need it.
    let output = without_layer(&["doctor"])?;
    Run::of("doctor", &output).ends(0, &["vulkan-validationlayers", "all is here"]);
    Ok(())
}
