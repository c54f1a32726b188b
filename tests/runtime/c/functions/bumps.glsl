// Tilts the normal along the tangent, as a normal map of one texel does.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
void bumps(inout MaterialValues values, MaterialPoint point)
{
    vec2 slope = point.parameters[0].xy;
    vec3 mapped = vec3(slope, sqrt(1.0 - dot(slope, slope)));
    values.normal = normalize(point.tangent * mapped.x + point.bitangent * mapped.y + point.normal * mapped.z);
}
