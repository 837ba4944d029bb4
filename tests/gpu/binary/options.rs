//! Does each option do what its help says, and is a wrong one refused with 2?

use serde_json::Value;

use super::{Place, Tested};

#[test]
fn what_the_command_line_asks_wrongly_ends_with_2() -> Tested {
    let place = Place::new()?;
    let cases: &[(&[&str], &str)] = &[
        (&["--size", "0x10"], "at least one pixel"),
        (&["--size", "10x0"], "at least one pixel"),
        (&["--size", "16"], "WIDTHxHEIGHT"),
        (&["--size", "+8x8"], "WIDTHxHEIGHT"),
        (&["--size", "8x+8"], "WIDTHxHEIGHT"),
        (&["--size", "8 x8"], "WIDTHxHEIGHT"),
        (&["--size", "-8x8"], "-8"),
        (&["--size", "99999999999x8"], "WIDTHxHEIGHT"),
        (&["--size", "1000000x8"], "at most"),
        (&["--size", "8x1000000"], "at most"),
        (&["--samples", "3"], "1, 2, 4 or 8"),
        (&["--samples", "0"], "1, 2, 4 or 8"),
        (&["--lighting", "toon"], "corrected"),
        (&["--diffuse", "eom"], "'eon'"),
        (&["--specular", "ggx-multy"], "'ggx-multi'"),
        (&["--fresnel", "schlik"], "'schlick'"),
        (
            &["--lighting", "slides", "--fresnel", "f82"],
            "one whole model",
        ),
        (
            &["--lighting", "phong", "--diffuse", "eon"],
            "one whole model",
        ),
        (&["--specular", "slides", "--fresnel", "f82"], "scale"),
        (&["--set", "material.gold.metal='glod'"], "gold"),
        (&["--terms", "glitter"], "specular"),
        (&["--tone-mapping", "film"], "neutral"),
        (&["--exposure", "nan"], "-100 to 100"),
        (&["--exposure", "101"], "-100 to 100"),
        (&["--device", ""], "--device"),
        (&["-o", "picture.bmp"], "png"),
        (&["-o", "picture"], "png"),
        (&["-o", "-", "--json"], "same place"),
        (&["-o", "-", "--json=-"], "same place"),
        (&["-o", "a.png", "--json=a.png"], "same place"),
        (&["-o", "a.png", "--json=./a.png"], "same place"),
        (&["--json=scene.png"], "same place"),
        (&["--json=scene.toml"], "overwritten"),
        (&["--json=./scene.toml"], "overwritten"),
        (&["--set", "material.glod.roughness=1"], "gold"),
        (&["--set", "material.gold.roughness"], "--set"),
        (&["--set", "material.gold.roughness=2"], "roughness"),
        (&["--colour", "red"], "--colour"),
        (&["second.toml"], "second.toml"),
    ];
    for (arguments, expected) in cases {
        let run = place.render(&[&["scene.toml"], *arguments].concat())?;
        let run = run.ends(2, &[expected]);
        assert!(run.stdout.is_empty(), "{arguments:?}");
        assert_eq!(place.names()?, ["scene.toml"], "{arguments:?}");
    }
    for arguments in [&[][..], &["render"], &["paint"]] {
        place.umber(arguments)?.ends(2, &["Usage"]);
    }
    Ok(())
}

/// A limit on the program's memory stands in for a machine that is too small.
#[test]
#[cfg(target_os = "linux")]
fn a_size_that_memory_does_not_hold_ends_with_2() -> Tested {
    let place = Place::new()?;
    // 16384 x 16384 pixels of 16 bytes are all of the 4 GiB that are left to the program.
    let script = "ulimit -v 4194304; exec \"$UMBER\" render --validation scene.toml \
                  --size 16384x16384 --samples 1";
    let run = place.shell(script)?;
    // A device whose largest image is smaller refuses it by its limit.
    let is_memory = run.stderr.contains("memory");
    let run = run.ends(2, &[]);
    assert!(
        is_memory || run.stderr.contains("at most"),
        "{}",
        run.stderr
    );
    assert_eq!(place.names()?, ["scene.toml"]);
    Ok(())
}

#[test]
fn a_sample_count_works_or_the_device_lists_those_it_has() -> Tested {
    let place = Place::new()?;
    for samples in ["1", "2", "4", "8"] {
        let name = format!("{samples}.png");
        let arguments = ["scene.toml", "--size", "8x8", "--samples", samples];
        let run = place.render(&[&arguments[..], &["-o", &name, "--json"]].concat())?;
        let works = run.code == Some(0);
        if works {
            let report: Value = serde_json::from_slice(&run.stdout)?;
            assert_eq!(report["image"]["samples"].to_string(), samples);
        } else {
            // Vulkan promises 1 and 4.
            assert!(["2", "8"].contains(&samples), "{}", run.stderr);
            let lacks = format!("no {samples}x multisampling");
            run.ends(2, &[&lacks, "it has 1, "]);
        }
        assert_eq!(place.path(&name).exists(), works, "{name}");
    }
    Ok(())
}

#[test]
fn a_device_is_chosen_by_kind_index_uuid_or_part_of_its_name() -> Tested {
    let place = Place::new()?;
    let list = place.umber(&["devices", "--json"])?.ends(0, &[]).stdout;
    let list: Value = serde_json::from_slice(&list)?;
    let rendered_on = |selector: &str| -> Result<Value, Box<dyn std::error::Error>> {
        let arguments = [
            "scene.toml",
            "--size",
            "8x8",
            "--json",
            "--device",
            selector,
        ];
        let report = place.render(&arguments)?.ends(0, &[]).stdout;
        Ok(serde_json::from_slice::<Value>(&report)?["device"].clone())
    };
    let suitable = |device: &&Value| device["missing"] == serde_json::json!([]);
    let devices = list["devices"].as_array().ok_or("a list")?;
    for device in devices.iter().filter(suitable) {
        let text = |key: &str| device[key].as_str().unwrap_or_default().to_owned();
        let uuid = text("uuid");
        for selector in [
            device["index"].to_string(),
            uuid.clone(),
            uuid.replace('-', ""),
        ] {
            assert_eq!(rendered_on(&selector)?["uuid"], uuid, "{selector}");
        }
        // The first five letters, in the other case.
        let part: String = text("name").chars().take(5).collect();
        let part = part.to_uppercase();
        let name = rendered_on(&part)?["name"].to_string().to_uppercase();
        assert!(name.contains(&part), "{name}");
    }
    for (selector, wanted) in [("cpu", true), ("gpu", false)] {
        let is_here = |device: &Value| (device["type"] == "cpu") == wanted;
        if devices.iter().filter(suitable).any(is_here) {
            assert_eq!(rendered_on(selector)?["type"] == "cpu", wanted);
        } else {
            let run = place.render(&["scene.toml", "--device", selector])?;
            run.ends(3, &[&format!("no device fits '{selector}'")]);
        }
    }
    Ok(())
}

#[test]
fn a_device_that_is_not_here_ends_with_3_and_lists_those_that_are() -> Tested {
    let place = Place::new()?;
    let list = place.umber(&["devices", "--json"])?.ends(0, &[]).stdout;
    let list: Value = serde_json::from_slice(&list)?;
    let name = list["devices"][0]["name"].as_str().ok_or("a name")?;
    // One digit beside the real one.
    let uuid = list["devices"][0]["uuid"].as_str().ok_or("a UUID")?;
    let (most, last) = uuid.split_at(uuid.len() - 1);
    let other = format!("{most}{}", if last == "0" { "1" } else { "0" });
    for selector in ["voodoo", "99", &other] {
        let run = place.render(&["scene.toml", "--device", selector])?;
        let wanted = selector.replace('-', "");
        run.ends(3, &[&format!("no device fits '{wanted}'"), name]);
        assert_eq!(place.names()?, ["scene.toml"]);
    }
    Ok(())
}
