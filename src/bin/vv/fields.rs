//! The fields that an expression can name: the colours of the vertices, as red, green and blue.

use vvmesh::attributes::ObjAttributes;
use vvmesh::io::FaceAttributes;
use vvmesh::select::Expression;

use crate::console::{Failure, refuse};

const NAMES: [&str; 3] = ["red", "green", "blue"];

/// Tells an expression the colours of the mesh that was read. A field that is not among them is refused.
pub(crate) fn of_file(
    option: &str,
    expression: Expression,
    said: Option<&FaceAttributes>,
) -> Result<Expression, Failure> {
    let colors = said.map_or(&[][..], |said| &said.vertex_colors);
    let mut unknown = None;
    let expression = expression.with_fields(&mut |name| {
        let component = NAMES.iter().position(|known| *known == name).filter(|_| !colors.is_empty());
        let Some(component) = component else {
            unknown.get_or_insert_with(|| name.to_owned());
            return None;
        };
        Some(colors.iter().map(|color| color.map_or(f64::NAN, |color| color[component])).collect())
    });
    let known = if colors.is_empty() { "its vertices have no colours" } else { "there are red, green and blue" };
    match unknown {
        Some(name) => refuse(format!("{option}: the mesh has no field `{name}`: {known}")),
        None => Ok(expression),
    }
}

/// Tells an expression the colours that ride along, if they do.
pub(crate) fn of_run(expression: Expression, attributes: Option<&ObjAttributes>) -> Expression {
    let Some(colors) = attributes.and_then(|attributes| attributes.attributes().vertex_channel("color")) else {
        return expression;
    };
    expression.with_fields(&mut |name| {
        let component = NAMES.iter().position(|known| *known == name)?;
        Some(colors.values().map(|color| color[component]).collect())
    })
}
