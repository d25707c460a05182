//! Do the examples run, and print what they promise?

macro_rules! examples {
    ($($module:ident, $file:literal, $says:literal;)*) => {
        $(
            #[allow(dead_code, unreachable_pub, reason = "written as a program of its own, whose main is not called here")]
            #[path = $file]
            mod $module;
        )*

        /// Each example with what its output has to contain.
        fn all() -> Vec<(&'static str, Run, &'static str)> {
            vec![$(($file, $module::run as Run, $says)),*]
        }
    };
}

type Run = fn(&mut dyn std::io::Write) -> Result<(), Box<dyn std::error::Error>>;

examples! {
    rings, "../examples/01_rings.rs", "9 vertices - 16 edges + 8 faces = 1, with 1 boundary loop";
    masks, "../examples/02_masks.rs", "-0.06250 for";
    refine, "../examples/03_refine_a_region.rs", "incremental: ";
    paths, "../examples/04_paths.rs", "1 component";
    cage, "../examples/05_moving_cage.rs", "frame 3: ";
    texture, "../examples/06_texture_coordinates.rs", "5 of 5 vertices on the seam";
    limit, "../examples/07_limit.rs", "from its first corner";
    predict, "../examples/08_predict.rs", "is proven";
    finer, "../examples/09_sqrt3_and_four_eight.rs", "[192, 576, 1728, 5184] faces";
}

#[test]
fn the_examples_run() {
    for (file, run, says) in all() {
        let mut out = Vec::new();
        run(&mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        assert!(text.contains(says), "{file} printed:\n{text}");
    }
}

#[test]
fn every_numbered_example_is_here_and_short() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut numbered = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_string();
        if name.ends_with(".rs") {
            numbered += 1;
            assert!(all().iter().any(|(file, ..)| file.ends_with(&name)), "{name} is not run by this test");
            assert!(std::fs::read_to_string(&path).unwrap().lines().count() < 80, "{name} is too long");
        }
    }
    assert_eq!(numbered, all().len());
}
