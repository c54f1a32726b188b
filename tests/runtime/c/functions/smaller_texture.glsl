// Repeats the texture of the base colour, as a texture transform does.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
void smaller_texture(inout MaterialValues values, MaterialPoint point)
{
    SurfaceUv at = scaleUv(point.uv, point.parameters[0].xy, point.parameters[0].zw);
    values.base_color = point.color * sampleAt(base_color_texture, at).rgb;
}
