//! The limit of the modified Butterfly scheme at vertices.

use std::f64::consts::{PI, TAU};

use super::two_ring::TwoRing;
use super::{Limit, butterfly};
use crate::id::VertexId;
use crate::mesh::{Neighborhood, VertexClass};
use crate::scheme::{MaskSink, ModifiedButterfly};

/// Limit positions, tangents and normals of [`ModifiedButterfly`].
///
/// Vertices are at their limit from the start. All tangents belong to the eigenvalue 1/2, but for the one across a crease
/// whose side is a single face, which belongs to 1/4. A vertex with less than two sharp edges is seen with its whole ring
/// and has one side, whatever its tag, as in the masks of the scheme.
///
/// At a corner a side of one face has the plane of its two curves. With more faces the inside of the sector shrinks by 1/2
/// in a third direction that the curves do not know: there is no tangent plane.
///
/// Source: `[zorin1996]`, `[zorin2000]`; the masks were derived.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct ModifiedButterflyLimit;

/// The tangent across a regular crease, in whole numbers: spokes 0 to 3, rims 0 to 2, far vertices 0 to 3.
const ACROSS_CREASE: [&[f64]; 3] = [&[-2.0, 30.0, 30.0, -2.0], &[-6.0, -20.0, -6.0], &[1.0, 4.0, 4.0, 1.0]];

/// The tangent across a crease at a dart of valence 6, in whole numbers: spokes, rims and far vertices from the sharp edge on.
const ACROSS_DART: [&[f64]; 3] = [
    &[0.0, 1680.0, 1728.0, 0.0, -1728.0, -1680.0],
    &[-336.0, -568.0, -288.0, 288.0, 568.0, 336.0],
    &[0.0, 155.0, 107.0, 0.0, -107.0, -155.0],
];

impl Limit for ModifiedButterflyLimit {
    fn mask(&self, _around: Neighborhood<'_>, v: VertexId, mask: &mut impl MaskSink) {
        mask.group(1.0, [v]);
    }

    fn side_count(&self, around: Neighborhood<'_>, v: VertexId) -> usize {
        match around.sharp_slots(v).len() {
            0 | 1 => usize::from(around.ring(v).valence() > 0),
            _ => around.sectors(v).len(),
        }
    }

    fn tangent_masks(
        &self,
        around: Neighborhood<'_>,
        v: VertexId,
        side: usize,
        first: &mut impl MaskSink,
        second: &mut impl MaskSink,
    ) -> bool {
        let count = self.side_count(around, v);
        assert!(side < count, "{v} has {count} sides, there is no side {side}");
        let mut sharp = around.sharp_slots(v);
        match (sharp.len(), sharp.next()) {
            (1, Some(slot)) => at_dart(&TwoRing::whole(ModifiedButterfly, around, v, slot), first, second),
            (0, _) => inside(&TwoRing::whole(ModifiedButterfly, around, v, 0), first, second),
            _ => {
                let sector = around.sectors(v).nth(side).expect("the side was counted");
                let star = TwoRing::sector(ModifiedButterfly, around, v, sector);
                match (around.class(v), sector.face_count()) {
                    (VertexClass::Crease, faces) => on_crease(&star, faces, first, second),
                    (_, 1) => {
                        end_of_curve(&star, 0, first);
                        end_of_curve(&star, 1, second);
                    }
                    _ => return false,
                }
            }
        }
        true
    }
}

type Star<'a> = TwoRing<'a, ModifiedButterfly>;

fn inside(star: &Star<'_>, first: &mut impl MaskSink, second: &mut impl MaskSink) {
    let n = star.len();
    if n == 6 {
        return butterfly::inside(star.row(first), star.row(second), n);
    }
    // The rule of an extraordinary vertex reads its ring alone, and has 1/2 for the first mode.
    weigh_spokes(star, |j| (TAU * j as f64 / n as f64).cos(), first);
    weigh_spokes(star, |j| (TAU * j as f64 / n as f64).sin(), second);
}

fn at_dart(star: &Star<'_>, first: &mut impl MaskSink, second: &mut impl MaskSink) {
    end_of_curve(star, 0, first);
    match star.len() {
        6 => weigh_all(star, ACROSS_DART, second),
        n => weigh_spokes(star, |j| (TAU * j as f64 / n as f64).sin(), second),
    }
}

fn on_crease(star: &Star<'_>, faces: usize, along: &mut impl MaskSink, across: &mut impl MaskSink) {
    // Along the curve, and for a single face across, the eigenvectors of the 4-point rule.
    let mut row = star.row(along);
    for (j, sign) in [(0, 1.0), (faces, -1.0)] {
        row.spoke(j, 8.0 * sign);
        row.far(j, -sign);
    }
    row.finish();
    match faces {
        1 => {
            let mut row = star.row(across);
            for j in [0, 1] {
                row.spoke(j, 4.0);
                row.far(j, -1.0);
            }
            row.finish();
        }
        3 => weigh_all(star, ACROSS_CREASE, across),
        _ => {
            let inner = |j: usize| if j < faces { (PI * j as f64 / faces as f64).sin() } else { 0.0 };
            weigh_spokes(star, inner, across);
        }
    }
}

/// The tangent of a curve that ends here, by the 4-point rule with its reflection.
fn end_of_curve(star: &Star<'_>, j: usize, mask: &mut impl MaskSink) {
    let mut row = star.row(mask);
    row.spoke(j, 8.0);
    row.far(j, -1.0);
    row.finish();
}

fn weigh_spokes(star: &Star<'_>, weight: impl Fn(usize) -> f64, mask: &mut impl MaskSink) {
    let mut row = star.row(mask);
    for j in 0..star.len() {
        row.spoke(j, weight(j));
    }
    row.finish();
}

fn weigh_all(star: &Star<'_>, [spokes, rims, far]: [&[f64]; 3], mask: &mut impl MaskSink) {
    let mut row = star.row(mask);
    for (j, &weight) in spokes.iter().enumerate() {
        row.spoke(j, weight);
    }
    for (j, &weight) in rims.iter().enumerate() {
        row.rim(j, weight);
    }
    for (j, &weight) in far.iter().enumerate() {
        row.far(j, weight);
    }
    row.finish();
}
