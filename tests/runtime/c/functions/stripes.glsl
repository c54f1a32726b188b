// Paints stripes of the world, one red, one in the colour of the vertices.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
float stripe(vec3 position, vec4 parameters) { return fract(dot(position, parameters.xyz)); }

void stripes(inout MaterialValues values, MaterialPoint point)
{
    values.base_color = stripe(point.position, point.parameters[0]) < 0.5 ? vec3(1.0, 0.0, 0.0) : point.color;
}
