//! What goes along with a step on a hierarchy.
//!
//! Of a vertex that moves a value is kept for each of its levels, as its positions are. A pass makes what is of one level,
//! from what is of the level before, and a last one puts what is shown where it is to be.
//!
//! **Deliberately not here**: what is given up again; that is not followed.

use super::patch::{Center, Patch, View};
use crate::id::VertexId;
use crate::scheme::{MaskSink, Scheme};
use crate::subdivide::ValueId;
use crate::subdivide::follow::MaskWriter;

/// Writes the masks by which was made what is new: `steps` as in [`Growth`](crate::split::hierarchy::Growth), and of each
/// vertex that is shown anew at which level.
pub(super) fn show<S: Scheme>(
    scheme: &S,
    view: View<'_>,
    steps: &[(VertexId, u8)],
    shown: impl Iterator<Item = (VertexId, u8)>,
    masks: &mut MaskWriter<'_>,
) {
    let hierarchy = view.levels.hierarchy();
    let mut steps: Vec<(u8, VertexId)> = steps.iter().map(|&(v, level)| (level, v)).collect();
    steps.sort_unstable();
    // Until the end these are shown where they were born, and the value of that level is not kept yet.
    let moves_first = |v| steps.binary_search(&(hierarchy.level(v) + 1, v)).is_ok();
    let name = |v, level| {
        if !view.has_moved(v) || (level == hierarchy.level(v) && moves_first(v)) {
            ValueId::Shown(v)
        } else {
            ValueId::Kept(v, level)
        }
    };
    let mut patch = Patch::default();
    for of_level in steps.chunk_by(|one, other| one.0 == other.0) {
        for &(level, v) in of_level {
            let below = level - 1;
            match hierarchy.birth(v).filter(|birth| birth.level == level) {
                Some(birth) => {
                    let (center, ends) = (Center::Edge(birth.parent), [birth.parent.p, birth.parent.q]);
                    masks.assign_value(ValueId::Shown(v), &ends, |mask| {
                        patch.mask(scheme, view, (center, below), |w| name(w, below), mask);
                    });
                }
                None if scheme.moves_even() => {
                    if below == hierarchy.level(v) {
                        masks.assign_value(ValueId::Kept(v, below), &[], |mask| mask.group(1.0, [ValueId::Shown(v)]));
                    }
                    masks.assign_value(ValueId::Kept(v, level), &[], |mask| {
                        patch.mask(scheme, view, (Center::Vertex(v), below), |w| name(w, below), mask);
                    });
                }
                None => {}
            }
        }
        masks.next_pass();
    }
    for (v, level) in shown.filter(|&(v, _)| view.has_moved(v)) {
        masks.assign_value(ValueId::Shown(v), &[], |mask| mask.group(1.0, [ValueId::Kept(v, level)]));
    }
}
