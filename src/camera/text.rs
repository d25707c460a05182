//! A camera from text.

use std::fmt;
use std::str::FromStr;

use glam::DVec3;

use super::Camera;
use crate::angle::Angle;
use crate::error::ConfigError;

/// What is told of a camera, in the order in which it prints.
const PARTS: [&str; 5] = ["eye", "at", "up", "fov", "size"];

/// `eye=x,y,z,at=x,y,z,up=x,y,z,fov=DEG,size=WxH`, in any order.
impl FromStr for Camera {
    type Err = ConfigError;

    fn from_str(text: &str) -> Result<Self, ConfigError> {
        let mut values: [Option<Vec<&str>>; 5] = Default::default();
        let mut place = None;
        for word in text.split(',').map(str::trim) {
            let value = match word.split_once('=') {
                None => word,
                Some((name, value)) => {
                    let known = PARTS.iter().position(|part| *part == name.trim_end());
                    let known = known.filter(|&known| values[known].is_none());
                    let Some(known) = known else {
                        return Err(refusal("camera", name.trim_end(), "eye, at, up, fov and size, each once"));
                    };
                    place = Some(known);
                    value.trim_start()
                }
            };
            match place {
                Some(place) => values[place].get_or_insert_default().push(value),
                None => return Err(refusal("camera", word, "eye=x,y,z,at=x,y,z,up=x,y,z,fov=DEG,size=WxH")),
            }
        }
        let of = |part: usize| {
            let missing = || refusal("camera", text, format!("{}= in it", PARTS[part]));
            values[part].as_deref().ok_or_else(missing)
        };
        let [eye, at, up] = [point("eye", of(0)?)?, point("at", of(1)?)?, point("up", of(2)?)?];
        Self::new(eye, at, up, degrees(of(3)?)?, size(of(4)?)?)
    }
}

fn point(name: &'static str, words: &[&str]) -> Result<DVec3, ConfigError> {
    let numbers: Option<Vec<f64>> = words.iter().map(|word| word.parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) => Ok(DVec3::new(x, y, z)),
        _ => Err(refusal(name, &words.join(","), "three numbers x,y,z")),
    }
}

fn degrees(words: &[&str]) -> Result<Angle, ConfigError> {
    let refused = || refusal("fov", &words.join(","), "a number of degrees");
    let [word] = words else { return Err(refused()) };
    word.parse().map(Angle::from_deg).map_err(|_| refused())
}

fn size(words: &[&str]) -> Result<[u32; 2], ConfigError> {
    let refused = || refusal("size", &words.join(","), "columns and rows of pixels, as in 1920x1080");
    let [word] = words else { return Err(refused()) };
    let (width, height) = word.split_once('x').ok_or_else(refused)?;
    Ok([width.parse().map_err(|_| refused())?, height.parse().map_err(|_| refused())?])
}

fn refusal(name: &'static str, value: &str, expected: impl fmt::Display) -> ConfigError {
    ConfigError { name, value: value.to_owned(), expected: format!("expected {expected}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_camera_is_refused_with_its_part() {
        let good = "eye=1,2,3,at=0,0,0,up=0,0,1,fov=40.5,size=640x480";
        let turned = " size = 640x480 ,fov=40.5, up=0,0,1e0, at=0, -0 ,0,eye=1,2,3";
        assert_eq!(good.parse::<Camera>().map(|camera| camera.to_string()).as_deref(), Ok(good));
        assert_eq!(turned.parse::<Camera>(), good.parse());
        let cases = [
            ("eye=1,2,3", "eye=1,2", "eye = 1,2: expected three numbers x,y,z"),
            ("eye=1,2,3", "eye=1,2,3,4", "eye = 1,2,3,4: expected three numbers x,y,z"),
            ("eye=1,2,3", "eye=1,nan,3", "eye = [1, NaN, 3]: expected finite coordinates"),
            ("eye=1,2,3", "eye=1,1e999,3", "eye = [1, inf, 3]: expected finite coordinates"),
            ("eye=1,2,3", "eye=0,0,0", "at = [0, 0, 0]: expected another point than the eye, not too far from it"),
            ("at=0,0,0", "at=1,2,3", "at = [1, 2, 3]: expected another point than the eye, not too far from it"),
            ("up=0,0,1", "up=-1,-2,-3", "up = [-1, -2, -3]: expected a direction across the line of sight"),
            ("up=0,0,1", "up=0,0,0", "up = [0, 0, 0]: expected a direction across the line of sight"),
            ("fov=40.5", "fov=0", "fov = 0: expected degrees above 0 and below 180"),
            ("fov=40.5", "fov=180", "fov = 180: expected degrees above 0 and below 180"),
            ("fov=40.5", "fov=NaN", "fov = NaN: expected degrees above 0 and below 180"),
            ("fov=40.5", "fov=40°", "fov = 40°: expected a number of degrees"),
            ("fov=40.5", "fov=40,5", "fov = 40,5: expected a number of degrees"),
            ("size=640x480", "size=640x0", "size = 640x0: expected at least 1x1 pixels"),
            ("size=640x480", "size=640", "size = 640: expected columns and rows of pixels, as in 1920x1080"),
            ("size=640x480", "size=640x-1", "size = 640x-1: expected columns and rows of pixels, as in 1920x1080"),
            ("fov=40.5", "eye=1,2,3", "camera = eye: expected eye, at, up, fov and size, each once"),
            ("fov=40.5", "zoom=2", "camera = zoom: expected eye, at, up, fov and size, each once"),
            ("eye=1,2,3", "1,2,3", "camera = 1: expected eye=x,y,z,at=x,y,z,up=x,y,z,fov=DEG,size=WxH"),
        ];
        for (part, other, expected) in cases {
            let text = good.replace(part, other);
            assert_eq!(text.parse::<Camera>().map_err(|error| error.to_string()), Err(expected.to_owned()), "{text}");
        }
        assert_eq!(
            "".parse::<Camera>().expect_err("nothing").to_string(),
            "camera = : expected eye=x,y,z,at=x,y,z,up=x,y,z,fov=DEG,size=WxH"
        );
        assert!("eye=1,2,3,at=0,0,0,up=0,0,1,fov=40.5".parse::<Camera>().is_err());
    }
}
