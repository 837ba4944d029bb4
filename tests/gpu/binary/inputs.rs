//! Does what is wrong with a scene, a model or a material library have its own message?

use super::{Place, SQUARE, Tested};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// Text files, the arguments of a render of them, and what the message must hold.
struct Case {
    files: &'static [(&'static str, &'static str)],
    scene: &'static str,
    words: &'static [&'static str],
}

const SCENES: &[Case] = &[
    Case {
        files: &[("broken.toml", "[camera\nposition = 1")],
        scene: "broken.toml",
        words: &["broken.toml:1:8"],
    },
    Case {
        files: &[(
            "late.toml",
            "[camera]\nposition = [0, 0, 1]\ntarget = [0, 0 0]\n",
        )],
        scene: "late.toml",
        words: &["late.toml:3:"],
    },
    Case {
        files: &[("typo.toml", "[camera]\npositoin = [0, 0, 1]")],
        scene: "typo.toml",
        words: &["typo.toml:2:1", "positoin", "'position'"],
    },
    Case {
        files: &[("absent.toml", "[model.a]\nfile = \"nothing.obj\"")],
        scene: "absent.toml",
        words: &["absent.toml:2", "nothing.obj"],
    },
    Case {
        files: &[("out.toml", "[model.a]\nfile = \"../model.obj\"")],
        scene: "out.toml",
        words: &["out.toml:2", "leads out of the folder"],
    },
    Case {
        files: &[("nothing.toml", "")],
        scene: "nothing.toml",
        words: &["nothing.toml"],
    },
    Case {
        files: &[("scene.txt", "")],
        scene: "scene.txt",
        words: &["scene.txt", ".toml", ".obj"],
    },
    Case {
        files: &[],
        scene: "nowhere.toml",
        words: &["nowhere.toml: there is no such file"],
    },
    Case {
        files: &[],
        scene: "/",
        words: &["/"],
    },
];

const MODELS: &[Case] = &[
    Case {
        files: &[("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")],
        scene: "far.obj",
        words: &["far.obj:4:", "vertex 9, out of range"],
    },
    Case {
        files: &[("back.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 -4\n")],
        scene: "back.obj",
        words: &["back.obj:5:", "out of range"],
    },
    Case {
        files: &[("nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n")],
        scene: "nan.obj",
        words: &["nan.obj:2:", "coordinate is nan"],
    },
    Case {
        files: &[("inf.obj", "v 0 0 0\nv 1 0 0\nv 0 inf 0\nf 1 2 3\n")],
        scene: "inf.obj",
        words: &["inf.obj:3:", "coordinate is inf"],
    },
    Case {
        files: &[("points.obj", TRIANGLE)],
        scene: "points.obj",
        words: &["points.obj: has no faces"],
    },
    Case {
        files: &[("empty.obj", "")],
        scene: "empty.obj",
        words: &["empty.obj: is empty"],
    },
    Case {
        files: &[(
            "thief.obj",
            "mtllib ../other.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        )],
        scene: "thief.obj",
        words: &["thief.obj:1: mtllib ../other.mtl: leads out of the folder"],
    },
    Case {
        files: &[(
            "absolute.obj",
            "mtllib /etc/passwd\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        )],
        scene: "absolute.obj",
        words: &["absolute.obj:1: mtllib /etc/passwd: leads out of the folder"],
    },
    Case {
        files: &[
            (
                "red.obj",
                "mtllib red.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            ),
            ("red.mtl", "newmtl red\nKd 1 nan 0\n"),
        ],
        scene: "red.obj",
        words: &["red.mtl:2: Kd is nan"],
    },
    Case {
        files: &[
            ("user.toml", "[model.a]\nfile = \"bad.obj\"\n"),
            ("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
        ],
        scene: "user.toml",
        words: &["bad.obj:4:", "out of range"],
    },
];

#[test]
fn each_fault_ends_with_6_and_its_place_and_leaves_nothing() -> Tested {
    for Case {
        files,
        scene,
        words,
    } in SCENES.iter().chain(MODELS)
    {
        let place = Place::empty()?;
        for (name, text) in *files {
            place.write(name, text)?;
        }
        let before = place.names()?;
        let run = place.render(&[scene, "-o", "a.png", "--json=a.json"])?;
        let run = run.ends(6, words);
        assert!(run.stdout.is_empty(), "{scene}: a failure is no data");
        assert!(run.stderr.starts_with("umber: "), "{}", run.stderr);
        assert_eq!(place.names()?, before, "{scene}");
    }
    Ok(())
}

#[test]
#[cfg(unix)]
fn a_material_library_behind_a_link_that_leads_out_is_refused() -> Tested {
    let outside = Place::empty()?;
    outside.write("secret.mtl", "newmtl red\n")?;
    let place = Place::empty()?;
    place.write("a.obj", &format!("mtllib a.mtl\n{TRIANGLE}f 1 2 3\n"))?;
    std::os::unix::fs::symlink(outside.path("secret.mtl"), place.path("a.mtl"))?;
    let run = place.render(&["a.obj"])?;
    run.ends(6, &["a.obj:1: mtllib a.mtl: is a link that leads out"]);
    assert_eq!(place.names()?, ["a.mtl", "a.obj"]);
    Ok(())
}

#[test]
fn a_missing_material_library_is_a_warning_and_the_default_material() -> Tested {
    let place = Place::empty()?;
    let text = format!("mtllib absent.mtl\nusemtl red\n{TRIANGLE}f 1 2 3\n");
    place.write("a.obj", &text)?;
    let small = ["a.obj", "--size", "16x16"];
    let run = place.render(&small)?.ends(0, &[]);
    for words in [
        "a.obj:1: mtllib absent.mtl: no such file",
        "a.obj:2: no MTL has a material 'red'",
    ] {
        assert!(run.stderr.contains(words), "{}", run.stderr);
    }
    assert_eq!(place.names()?, ["a.obj", "a.png"]);
    let quiet = place.render(&[&small[..], &["--quiet"]].concat())?;
    assert_eq!(quiet.ends(0, &[]).stderr, "", "a warning is no error");
    Ok(())
}

#[test]
fn a_scene_finds_its_models_beside_it_and_writes_where_the_user_is() -> Tested {
    let place = Place::empty()?;
    std::fs::create_dir(place.path("sub"))?;
    place.write("sub/a.obj", &format!("{TRIANGLE}f 1 2 3\n"))?;
    let scene = SQUARE.replace("shape = \"plane\"", "file = \"a.obj\"");
    place.write("sub/scene.toml", &scene)?;
    let run = place.render(&["sub/scene.toml", "--size", "16x16"])?;
    run.ends(0, &[]);
    assert_eq!(place.names()?, ["scene.png", "sub"]);
    Ok(())
}

/// A white PNG of this size.
fn png(width: u32, height: u32) -> Result<Vec<u8>, image::ImageError> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture = image::GrayImage::from_pixel(width, height, image::Luma([255]));
    picture.write_to(&mut bytes, image::ImageFormat::Png)?;
    Ok(bytes.into_inner())
}

/// `SQUARE` under a map.
fn mapped(file: &str) -> String {
    format!("{SQUARE}\n[material.plaster]\nbase_color_map = \"{file}\"\n")
}

#[test]
fn a_bad_map_ends_with_6_and_a_good_one_is_drawn() -> Tested {
    let place = Place::empty()?;
    let whole = png(16, 16)?;
    std::fs::write(place.path("whole.png"), &whole)?;
    std::fs::write(place.path("cut.png"), &whole[..whole.len() / 2])?;
    std::fs::write(place.path("empty.png"), [])?;
    let size = ["--size", "16x9", "--samples", "1"];
    for (file, words) in [
        ("cut.png", "cut.png"),
        ("empty.png", "empty.png"),
        ("missing.png", "missing.png"),
        ("../outside.png", "outside"),
        ("scene.toml", "scene.toml"),
    ] {
        place.write("scene.toml", &mapped(file))?;
        place
            .render(&[&["scene.toml"][..], &size].concat())?
            .ends(6, &[words]);
        assert!(!place.path("scene.png").exists(), "{file}");
    }
    place.write("scene.toml", &mapped("whole.png"))?;
    let run = place.render(&[&["scene.toml"][..], &size].concat())?;
    run.ends(0, &["base-color-map"]);
    Ok(())
}

/// A thin picture is small where it is counted, and large where it is made square.
#[test]
fn maps_that_grow_beyond_memory_end_with_6() -> Tested {
    let place = Place::empty()?;
    let mut scene = SQUARE.to_owned();
    for number in 0..9 {
        std::fs::write(place.path(&format!("{number}.png")), png(4096, 1)?)?;
        scene.push_str(&format!(
            "[material.m{number}]\nbase_color_map = \"{number}.png\"\n\
             [model.m{number}]\nshape = \"cube\"\nmaterial = \"m{number}\"\n"
        ));
    }
    place.write("scene.toml", &scene)?;
    let run = place.render(&["scene.toml", "--size", "16x9"])?;
    run.ends(6, &["too large", "square"]);
    Ok(())
}
