//! Is an output whole or absent, in the place that the user named?

use std::os::unix::fs::{PermissionsExt, symlink};
use std::os::unix::process::ExitStatusExt;
use std::process::Stdio;
use std::time::Duration;

use super::{Place, SQUARE, Tested, UMBER};

const SMALL: [&str; 3] = ["scene.toml", "--size", "8x8"];

fn render(place: &Place, arguments: &[&str]) -> std::io::Result<super::Run> {
    place.render(&[&SMALL, arguments].concat())
}

#[test]
fn a_place_that_cannot_be_written_ends_with_6_and_its_own_name() -> Tested {
    let place = Place::new()?;
    std::fs::create_dir(place.path("folder.png"))?;
    let before = place.names()?;
    let cases: [(&[&str], &str); 8] = [
        (&["-o", "missing/a.png"], "missing/a.png"),
        (&["-o", "/proc/a.png"], "/proc/a.png"),
        (&["-o", "scene.toml/a.png"], "scene.toml/a.png"),
        (
            &["-o", "folder.png"],
            "cannot write folder.png: is a directory",
        ),
        (&["--json=missing/a.json"], "missing/a.json"),
        (&["--json=/proc/a.json"], "/proc/a.json"),
        (
            &["--json=folder.png"],
            "cannot write folder.png: is a directory",
        ),
        (&["-o", "-", "--json=missing/a.json"], "missing/a.json"),
    ];
    for (arguments, expected) in cases {
        let run = render(&place, arguments)?.ends(6, &[expected]);
        assert!(!run.stderr.contains(".umber-"), "{}", run.stderr);
        assert!(run.stdout.is_empty(), "{arguments:?}");
        assert_eq!(place.names()?, before, "{arguments:?}: checked before work");
    }
    Ok(())
}

#[test]
fn a_failed_run_leaves_the_old_files_as_they_were() -> Tested {
    let place = Place::new()?;
    place.write("a.png", "old picture")?;
    place.write("a.json", "old report")?;
    place.write("broken.toml", "[camera")?;
    let both = ["-o", "a.png", "--json=a.json"];
    place
        .render(&[&["broken.toml"], &both[..]].concat())?
        .ends(6, &[]);
    render(
        &place,
        &["-o", "a.png", "--json=a.json", "--device", "voodoo"],
    )?
    .ends(3, &[]);
    assert_eq!(std::fs::read(place.path("a.png"))?, b"old picture");
    assert_eq!(std::fs::read(place.path("a.json"))?, b"old report");
    assert_eq!(
        place.names()?,
        ["a.json", "a.png", "broken.toml", "scene.toml"]
    );
    render(&place, &both)?.ends(0, &[]);
    assert_eq!(image::open(place.path("a.png"))?.width(), 8);
    serde_json::from_slice::<serde_json::Value>(&std::fs::read(place.path("a.json"))?)?;
    Ok(())
}

#[test]
fn a_link_is_followed_and_stays() -> Tested {
    let place = Place::new()?;
    std::fs::create_dir(place.path("there"))?;
    place.write("there/real.png", "old")?;
    symlink("there/real.png", place.path("a.png"))?;
    render(&place, &["-o", "a.png"])?.ends(0, &[]);
    assert!(place.path("a.png").symlink_metadata()?.is_symlink());
    assert_eq!(image::open(place.path("there/real.png"))?.width(), 8);
    let there: Vec<_> = std::fs::read_dir(place.path("there"))?.collect();
    assert_eq!(there.len(), 1, "{there:?}");
    assert_eq!(place.names()?, ["a.png", "scene.toml", "there"]);
    // A link to the scene is the scene.
    symlink("scene.toml", place.path("alias.png"))?;
    render(&place, &["-o", "alias.png"])?.ends(2, &["scene.toml: it would be overwritten"]);
    assert_eq!(std::fs::read_to_string(place.path("scene.toml"))?, SQUARE);
    Ok(())
}

#[test]
fn a_read_only_file_is_refused() -> Tested {
    let place = Place::new()?;
    for (name, option) in [("a.png", "--output=a.png"), ("a.json", "--json=a.json")] {
        place.write(name, "precious")?;
        let read_only = std::fs::Permissions::from_mode(0o444);
        std::fs::set_permissions(place.path(name), read_only)?;
        let run = render(&place, &[option])?.ends(6, &[name]);
        assert!(!run.stderr.contains(".umber-"), "{}", run.stderr);
        assert_eq!(std::fs::read(place.path(name))?, b"precious");
    }
    assert_eq!(place.names()?, ["a.json", "a.png", "scene.toml"]);
    Ok(())
}

/// Root writes to such a folder all the same, and so may the program.
#[test]
fn a_read_only_folder_ends_with_6_where_it_refuses_its_user() -> Tested {
    let place = Place::new()?;
    std::fs::create_dir(place.path("closed"))?;
    let set = |mode| {
        let rights = std::fs::Permissions::from_mode(mode);
        std::fs::set_permissions(place.path("closed"), rights)
    };
    set(0o555)?;
    let is_refused = std::fs::write(place.path("closed/by_hand"), "").is_err();
    for option in ["--output=closed/a.png", "--json=closed/a.json"] {
        let run = render(&place, &[option])?;
        if is_refused {
            let run = run.ends(6, &["cannot write closed/a."]);
            assert!(!run.stderr.contains(".umber-"), "{}", run.stderr);
        } else {
            run.ends(0, &[]);
        }
    }
    set(0o755)?;
    Ok(())
}

#[test]
fn a_new_file_has_the_rights_of_any_new_file() -> Tested {
    let place = Place::new()?;
    place.write("by_hand", "")?;
    render(&place, &["-o", "a.png", "--json=a.json"])?.ends(0, &[]);
    let mode =
        |name: &str| Ok::<_, std::io::Error>(place.path(name).metadata()?.permissions().mode());
    assert_eq!(mode("a.png")?, mode("by_hand")?);
    assert_eq!(mode("a.json")?, mode("by_hand")?);
    Ok(())
}

#[test]
#[cfg(target_os = "linux")]
fn a_device_file_is_written_to_and_never_replaced() -> Tested {
    let place = Place::new()?;
    symlink("/dev/null", place.path("null.png"))?;
    symlink("/dev/full", place.path("full.png"))?;
    let before = place.names()?;
    render(&place, &["-o", "null.png", "--json=/dev/null"])?.ends(0, &[]);
    render(&place, &["-o", "full.png"])?.ends(6, &["full.png", "No space"]);
    render(&place, &["-o", "null.png", "--json=/dev/full"])?.ends(6, &["/dev/full", "No space"]);
    render(&place, &["-o", "/dev/null"])?.ends(0, &[]);
    render(&place, &["-o", "/dev/full"])?.ends(6, &["/dev/full", "No space"]);
    assert_eq!(place.names()?, before);
    for name in ["null.png", "full.png"] {
        assert!(!place.path(name).metadata()?.is_file(), "{name}");
    }
    Ok(())
}

#[test]
fn a_pipe_gets_the_picture() -> Tested {
    let place = Place::new()?;
    let script = "mkfifo pipe.png; timeout 60 cat pipe.png > got.png & \
                  \"$UMBER\" render --validation scene.toml --size 8x8 -o pipe.png; \
                  code=$?; wait; exit $code";
    place.shell(script)?.ends(0, &[]);
    assert_eq!(image::open(place.path("got.png"))?.width(), 8);
    assert_eq!(place.names()?, ["got.png", "pipe.png", "scene.toml"]);
    Ok(())
}

#[test]
fn a_killed_render_leaves_nothing() -> Tested {
    let place = Place::empty()?;
    // As many lights as a scene may have, each evaluated for each of four million pixels.
    let lamp = |i: usize| {
        format!(
            "[light.extra_{i}]\nkind = \"directional\"\ndirection = [0.{i:03}, -1, 0]\nilluminance = 0.1\n"
        )
    };
    let lamps: String = (0..umber::scene::MAX_LIGHTS - 1).map(lamp).collect();
    place.write("scene.toml", &format!("{SQUARE}{lamps}"))?;
    // From where the program starts to where it renders; a fast device may have done before.
    let mut killed = 0;
    for milliseconds in [30, 300, 1000] {
        let mut child = place
            .command(UMBER)
            .args(["render", "scene.toml", "--validation"])
            .args(["--size", "2000x2000", "-o", "a.png", "--json=a.json"])
            .stderr(Stdio::null())
            .spawn()?;
        std::thread::sleep(Duration::from_millis(milliseconds));
        child.kill()?;
        if child.wait()?.signal().is_some() {
            killed += 1;
            assert_eq!(place.names()?, ["scene.toml"], "{milliseconds} ms");
        } else {
            assert_eq!(place.names()?, ["a.json", "a.png", "scene.toml"]);
            std::fs::remove_file(place.path("a.png"))?;
            std::fs::remove_file(place.path("a.json"))?;
        }
    }
    assert!(killed > 0, "none was killed in its work");
    Ok(())
}
