//! Triangles of degree 4 in the form of Bernstein and Bézier: what the Loop surface is where everything is regular.

use glam::DVec3;

use super::Evaluation;

/// A point of degree d has the place of its exponents (i, j, k), i + j + k = d: row j + k, and k in it. It does not depend
/// on d, so a step of de Casteljau's scheme works in place.
fn place([_, j, k]: [usize; 3]) -> usize {
    let row = j + k;
    row * (row + 1) / 2 + k
}

/// The 15 points of a triangle of degree 4.
#[derive(Clone, Debug)]
pub(super) struct Bezier(pub(super) [DVec3; 15]);

impl Bezier {
    /// The polynomial of a triangle whose corners are regular, by the 12 points around it.
    ///
    /// Every corner has the hexagon of its neighbours, from the next corner on. The weights are those of the quartic box
    /// spline, whose 12 basis functions in this form have whole numbers over 24.
    ///
    /// Source: `[stam1998]`, the basis functions of its appendix.
    pub(super) fn regular(corners: [(DVec3, [DVec3; 6]); 3]) -> Self {
        let mut points = [DVec3::ZERO; 15];
        for (c, (x, hexagon)) in corners.into_iter().enumerate() {
            let [y, z, beyond_z, outer_z, outer_y, beyond_y] = hexagon;
            let mut set = |[i, j, k]: [usize; 3], point: DVec3| {
                let mut exponents = [0; 3];
                for (of, exponent) in [i, j, k].into_iter().enumerate() {
                    exponents[(c + of) % 3] = exponent;
                }
                points[place(exponents)] = point / 24.0;
            };
            set([4, 0, 0], 12.0 * x + 2.0 * hexagon.iter().sum::<DVec3>());
            set([3, 1, 0], 12.0 * x + 4.0 * y + 3.0 * (z + beyond_y) + beyond_z + outer_y);
            set([3, 0, 1], 12.0 * x + 4.0 * z + 3.0 * (y + beyond_z) + beyond_y + outer_z);
            set([2, 2, 0], 8.0 * (x + y) + 4.0 * (z + beyond_y));
            set([2, 1, 1], 10.0 * x + 6.0 * (y + z) + beyond_y + beyond_z);
        }
        Self(points)
    }

    /// The value at barycentric coordinates and the derivatives by the first two of them, the third making up for them.
    pub(super) fn evaluate(&self, at: [f64; 3]) -> Evaluation {
        let mut b = self.0;
        for degree in [4, 3] {
            step(&mut b, degree, at);
        }
        let [xx, xy, xz, yy, yz, zz] = [b[0], b[1], b[2], b[3], b[4], b[5]];
        let second = [xx - 2.0 * xz + zz, xy - xz - yz + zz, yy - 2.0 * yz + zz].map(|difference| 12.0 * difference);
        step(&mut b, 2, at);
        let first = [b[0] - b[2], b[1] - b[2]].map(|difference| 4.0 * difference);
        step(&mut b, 1, at);
        Evaluation { position: b[0], first: Some(first), second: Some(second) }
    }
}

/// One step of de Casteljau's scheme, from a degree to the one below.
fn step(points: &mut [DVec3; 15], degree: usize, [x, y, z]: [f64; 3]) {
    for row in 0..degree {
        let (start, below) = (row * (row + 1) / 2, (row + 1) * (row + 2) / 2);
        for k in 0..=row {
            points[start + k] = x * points[start + k] + y * points[below + k] + z * points[below + k + 1];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The 12 points of the lattice around the triangle (0,0), (1,0), (0,1), each with the value of a function.
    fn lattice(value: impl Fn(f64, f64) -> f64) -> Bezier {
        const HEXAGON: [[i32; 2]; 6] = [[1, 0], [0, 1], [-1, 1], [-1, 0], [0, -1], [1, -1]];
        let at = |x: i32, y: i32| DVec3::splat(value(f64::from(x), f64::from(y)));
        let corner = |[x, y]: [i32; 2], first: usize| {
            let hexagon = std::array::from_fn(|j| {
                let [dx, dy] = HEXAGON[(first + j) % 6];
                at(x + dx, y + dy)
            });
            (at(x, y), hexagon)
        };
        Bezier::regular([corner([0, 0], 0), corner([1, 0], 2), corner([0, 1], 4)])
    }

    const SAMPLES: [[f64; 3]; 6] =
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.5, 0.5, 0.0], [0.2, 0.3, 0.5], [0.7, 0.1, 0.2]];

    #[test]
    fn each_basis_function_is_a_box_spline_and_they_add_to_one() {
        // (6x⁴ + 24x³z + ...)/12 of the paper at a corner, at the opposite corners, and outside.
        for (point, expected) in [([0, 0], [0.5, 1.0 / 12.0, 1.0 / 12.0]), ([1, -1], [1.0 / 12.0, 1.0 / 12.0, 0.0])] {
            let [px, py] = point.map(f64::from);
            let spike = lattice(|x, y| f64::from(u8::from(x == px && y == py)));
            for (at, value) in SAMPLES.into_iter().zip(expected) {
                assert!((spike.evaluate(at).position.x - value).abs() < 1e-15, "{point:?} {at:?}");
            }
        }
        // u⁴ + 2u³v over 12 of an outermost point, at (u, v, w) = (0.7, 0.1, 0.2).
        let outer = lattice(|x, y| f64::from(u8::from(x == 0.0 && y == -1.0)));
        let [u, v, _] = SAMPLES[5];
        assert!((outer.evaluate(SAMPLES[5]).position.x - (u.powi(4) + 2.0 * u.powi(3) * v) / 12.0).abs() < 1e-16);
        for at in SAMPLES {
            assert!((lattice(|_, _| 1.0).evaluate(at).position.x - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn linear_functions_come_back_with_their_derivatives() {
        let plane = lattice(|x, y| 2.0 * x - 3.0 * y + 1.0);
        for at in SAMPLES {
            let Evaluation { position, first, second } = plane.evaluate(at);
            assert!((position.x - (2.0 * at[1] - 3.0 * at[2] + 1.0)).abs() < 1e-14);
            let [du, dv] = first.expect("a polynomial has derivatives");
            assert!((du.x - 3.0).abs() < 1e-13 && (dv.x - 5.0).abs() < 1e-13);
            assert!(second.expect("and second ones").iter().all(|derivative| derivative.x.abs() < 1e-12));
        }
    }
}
