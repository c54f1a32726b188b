// Material function: paints the edge of a sign blue.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
void blue_edge(inout MaterialValues values, MaterialPoint point)
{
    vec2 from_middle = abs(point.uv.uv - 0.5);
    if (max(from_middle.x, from_middle.y) > 0.5 - point.parameters[0].x)
        values.base_color = vec3(0.0, 0.0, 1.0);
}
